//! Suspect readings and warnings.

use hexbench_core::Sensor;
use hexbench_core::words::joined;
use hexbench_model::results::diagnose::Diagnosis;
use hexbench_model::results::outliers::SuspiciousReading;

use crate::number::significant;
use crate::page::Section;

/// Most readings listed.
const MOST_SUSPECTS: usize = 5;

/// What to look at before trusting the numbers.
pub(super) fn section(d: &Diagnosis) -> Option<Section> {
    let suspects = (!d.suspects.is_empty()).then(|| suspects(d));
    look_at(suspects.into_iter().chain(d.warnings.iter().cloned()))
}

/// The same of any result; none where there is nothing.
pub(super) fn look_at(sentences: impl IntoIterator<Item = String>) -> Option<Section> {
    Section::new("Look at this").id("look-at").list(sentences).unless_empty()
}

/// Frames and signs.
const CONVENTIONS: &str = "Axes are the fixed axes of the base unless marked mobile; wrenches act on the platform at the mobile \
                           origin; deflection = loaded minus reference; tension is positive.";

/// Frames and signs, the same on every page.
pub(super) fn conventions() -> Section {
    Section::new("Conventions").paragraph(CONVENTIONS)
}

/// By which sensors a plan is read, where a machine has some.
pub fn read_by(sensors: &[Sensor]) -> Option<String> {
    let names: Vec<String> = sensors.iter().map(|sensor| sensor.name.clone()).collect();
    (!names.is_empty()).then(|| {
        format!(
            "Every reading is taken by {} of the hexapod file, with the noise stated for each sensor.",
            joined(&names)
        )
    })
}

/// Readings far from every prediction, in a sentence.
fn suspects(d: &Diagnosis) -> String {
    format!("{}; to do: check the record, or leave a line out with `--exclude LINE`", outlying(&d.suspects))
}

/// Readings that stand out and count all the same, the worst first.
pub(super) fn outlying(suspects: &[SuspiciousReading]) -> String {
    let mut worst: Vec<_> = suspects.iter().collect();
    worst.sort_by(|a, b| b.z.total_cmp(&a.z));
    let listed: Vec<String> = worst
        .iter()
        .take(MOST_SUSPECTS)
        .map(|s| format!("line {} (up to {} sigma)", s.row, significant(s.z, 2)))
        .collect();
    let more = if worst.len() > MOST_SUSPECTS { ", ..." } else { "" };
    let count = worst.len();
    let noun = if count == 1 { "reading is" } else { "readings are" };
    // Six numbers may be far off together, none of which is so alone.
    format!("{count} {noun} outlying as a whole but kept in the fit: {}{more}", listed.join(", "))
}
