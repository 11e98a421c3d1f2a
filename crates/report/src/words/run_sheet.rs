//! The readings asked for, on paper: numbered rows with room to write what is read.

use hexbench_core::{Dataset, Observation};
use hexbench_model::results::diagnose::{NextReport, SeparationReport};

use super::next::{pose, promise, round, settings, way};
use crate::page::{Block, Definition, Page, PageColumn, Section, Table};

const READ: [&str; 6] = ["da (um)", "db (um)", "dc (um)", "dalpha (urad)", "dbeta (urad)", "dgamma (urad)"];
const READ_ABSOLUTE: [&str; 6] = ["a (mm)", "b (mm)", "c (mm)", "alpha (deg)", "beta (deg)", "gamma (deg)"];
/// Room for a number written by hand.
const ROOM: &str = "__________";

/// The sheet of a machine: a row for every reading, with what is to be set.
pub fn page(machine: &str, rows: &Dataset, next: &[NextReport], separation: &[SeparationReport]) -> Page {
    let read = if rows.is_absolute() { READ_ABSOLUTE } else { READ };
    let columns = std::iter::once(PageColumn::words("set")).chain(read.map(PageColumn::words));
    let line = |(k, o): (usize, &Observation)| {
        std::iter::once(format!("{}. {}", k + 1, set(o))).chain(read.map(|_| ROOM.to_owned()))
    };
    let table = Table::new(columns).rows(rows.observations.iter().enumerate().map(line));
    let frames = "Poses a, b, c in mm and alpha, beta, gamma in deg about the fixed axes x, y, z; wrenches on the platform at the \
                  mobile origin, fixed axes; deflections are loaded minus reference.";
    Page::new(format!("Run sheet: {machine}")).with(
        Section::new("Run sheet")
            .id("run-sheet")
            .remark(format!("{} readings, in this order", rows.observations.len()))
            .table(table)
            .with(Block::entries([
                Definition::new("foreseen", promise(next, separation)),
                Definition::new("frames", frames),
            ])),
    )
}

/// Everything that is set for a reading.
fn set(o: &Observation) -> String {
    let [wrench, reference] = [&o.wrench, &o.reference].map(|w| exactly(&w.to_array()));
    let way = way(o.approach, o.elapsed, o.delta_t, 1);
    let Observation { pose_id, repeat, .. } = o;
    format!(
        "Pose {pose_id}, repeat {repeat}: {}; load {wrench}; reference {reference}; {way}",
        pose(&settings(o))
    )
}

/// A wrench as it is to be set, to a thousandth of N and N m.
fn exactly(w: &[f64; 6]) -> String {
    let [fx, fy, fz, mx, my, mz] = w.map(round);
    format!("F ({fx}, {fy}, {fz}) N, M ({mx}, {my}, {mz}) N m")
}
