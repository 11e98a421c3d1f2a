//! The readings asked for, on paper: numbered, with room to write what is read.

use hexbench_core::{Dataset, Observation};
use hexbench_model::results::diagnose::{NextReport, SeparationReport};

use super::next::{pose, promise, round, settings, way};
use crate::page::{Block, Definition, Page, Section};

const READ: [&str; 6] = ["da (um)", "db (um)", "dc (um)", "dalpha (urad)", "dbeta (urad)", "dgamma (urad)"];
const READ_ABSOLUTE: [&str; 6] = ["a (mm)", "b (mm)", "c (mm)", "alpha (deg)", "beta (deg)", "gamma (deg)"];
/// Room for a number written by hand.
const ROOM: &str = "______________";

/// The sheet of a machine: every reading with what is to be set, and what is foreseen of all of them.
pub fn page(machine: &str, rows: &Dataset, next: &[NextReport], separation: &[SeparationReport]) -> Page {
    let names = if rows.is_absolute() { READ_ABSOLUTE } else { READ };
    let frames = "Poses a, b, c and alpha, beta, gamma about the fixed axes x, y, z; wrenches on the platform at the mobile origin, \
                  fixed axes; deflections are loaded minus reference.";
    let readings = rows.observations.iter().enumerate();
    let section = Section::new("Readings to take")
        .id("run-sheet")
        .remark("in this order; enter the readings in run-sheet.csv")
        .with_all(readings.map(|(k, o)| Block::numbered(k + 1, reading(o, names))))
        .with(Block::entries([
            Definition::new("expected", promise(next, separation)),
            Definition::new("frames", frames),
        ]));
    Page::new(format!("Run sheet: {machine}")).with(section)
}

fn reading(o: &Observation, names: [&str; 6]) -> Vec<Definition> {
    let Observation { pose_id, repeat, .. } = o;
    let [wrench, reference] = [&o.wrench, &o.reference].map(|w| exactly(&w.to_array()));
    let read = names.map(|name| format!("{name} {ROOM}"));
    vec![
        Definition::new("row", format!("pose {pose_id}, repeat {repeat}")),
        Definition::new("pose", pose(&settings(o))),
        Definition::new("load", wrench),
        Definition::new("reference", reference),
        Definition::new("how", way(o.approach, o.elapsed, o.delta_t, 1)),
        Definition::new("read", read.join("; ")),
    ]
}

/// A wrench as it is to be set, to a thousandth of N and N m.
fn exactly(w: &[f64; 6]) -> String {
    let [fx, fy, fz, mx, my, mz] = w.map(round);
    format!("F ({fx}, {fy}, {fz}) N, M ({mx}, {my}, {mz}) N m")
}
