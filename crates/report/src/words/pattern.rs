//! What to look for when the pattern has no name.

use hexbench_model::results::diagnose::{Diagnosis, OutsideReport};

use super::conclusion::telling_law;
use crate::page::Section;

/// Where a pattern outside the catalogue points to, and the law behind it.
pub(super) fn section(d: &Diagnosis) -> Option<Section> {
    let outside = d.outside.as_ref()?;
    let section = Section::new("What to look for").id("look-for");
    Some(match telling_law(d) {
        Some(law) => {
            section.list(law.look_at.map(str::to_owned)).paragraph(OR_THE_DATA).paragraph(ADD_THE_LAW)
        }
        // Laws act on the machine, not on what it is read from.
        None if outside.pattern == Some("moving-frame") => section.paragraph(hint(outside)),
        None => section.paragraph(hint(outside)).paragraph(OR_THE_DATA).paragraph(SEARCH_A_LAW),
    })
}

const OR_THE_DATA: &str = "Check the measurement as well: an instrument that sticks or reads one axis wrongly, a reference reading, a load or                            temperature that differs from the file, or a change of the setup during the measurement can leave such a pattern.";

const ADD_THE_LAW: &str = "To add the law, run `hexbench discover` with the same files and `-o term.toml`, then the same `hexbench diagnose` with \
                           `--term term.toml`, which compares the law like any effect of the catalogue.";
const SEARCH_A_LAW: &str = "`hexbench discover` with the same files searches for the law behind it, writes it as a \
                            term (-o term.toml) that `hexbench diagnose --term term.toml` compares like any other, \
                            and shows whether the held-out error falls.";

const MOVING_FRAME: &str = "The stand of the instrument, its targets or the reference it reads against grows warm: watch a target that does not \
                            move while the temperature changes.";
const OTHER_LEG: &str = "A leg feels the force of another one: look for what they share, a bracket, a part of the frame, an amplifier, and \
                         check which leg is which.";

const UNSTATED_LOAD: &str = "Look for something that is applied with every load but missing in the list of loads: a shackle, a hook, a \
                             tray, a cable. Check the zero of the load cell too.";
const BESIDE_THE_LEGS: &str = "Part of the load bypasses the legs: look for a cable, a hose, bellows or a cover that touches the \
                               platform.";
const READ_AGAIN: &str = "Look at the readings with the largest residuals first, and repeat some of them.";

fn hint(outside: &OutsideReport) -> String {
    match outside.pattern {
        Some("moving-frame") => MOVING_FRAME.to_owned(),
        Some("other-leg") => OTHER_LEG.to_owned(),
        Some("unstated-load") => UNSTATED_LOAD.to_owned(),
        Some("stiffness-beside-the-legs") => BESIDE_THE_LEGS.to_owned(),
        Some(_) => of_legs(outside),
        None => READ_AGAIN.to_owned(),
    }
}

/// Where what legs follow points to.
fn of_legs(outside: &OutsideReport) -> String {
    let who = outside.leg.map_or("every leg".to_owned(), |leg| format!("leg {leg}"));
    match (outside.variable, outside.period) {
        (Some("leg_length"), Some(period)) => format!(
            "Something in {who} repeats every {period:.3} mm of leg length: compare with the lead of the screw, the \
             balls and the nut, the gear and the encoder."
        ),
        (Some("leg_length"), None) => {
            format!("Something in {who} depends on its extension: guides, seals, contact of the screw.")
        }
        (Some("elapsed_s"), _) => {
            format!(
                "Something in {who} changes with time: a warming drive, settling joints, a drifting sensor."
            )
        }
        (Some("line"), _) => format!(
            "Something about {who} changed while the file was measured: a screw that came loose, a joint or mount that settled, a \
             part that was exchanged. Diagnose the readings before and after that line as two files."
        ),
        (Some("delta_T_K"), _) => format!("Something in {who} depends on the temperature."),
        (Some("leg_force"), _) => format!("Something in {who} depends on its force: contact, preload, play."),
        (Some("tilt"), _) => {
            format!(
                "Something in {who} depends on the tilt: joints near their limit, covers, hoses, a guide that binds."
            )
        }
        (Some(variable), _) => format!("Something in {who} depends on the {variable}."),
        (None, _) => READ_AGAIN.to_owned(),
    }
}
