//! `balls.csv` and `balls.toml`: what a measuring machine wrote down, and where the balls should be.

use std::fmt::Write as _;
use std::io::{self, Write};

use hexbench_core::Vector3;

use super::{Instrument, Measured};
use crate::metrology::CmmRecord;

/// States of a row in the order of its records.
const STATES: [&str; 2] = ["reference", "loaded"];

/// The line with the names of the columns.
pub(super) fn header(out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "record,state,pose,repeat,ball,x_mm,y_mm,z_mm")
}

/// The records of a row; those of row `index` (from 0) follow those of the rows before.
pub(super) fn rows(out: &mut dyn Write, index: u64, row: &Measured) -> io::Result<()> {
    let count = row.records.len() as u64;
    let states = STATES.iter().skip(STATES.len() - row.records.len().min(STATES.len()));
    for ((number, record), state) in (index * count + 1..).zip(&row.records).zip(states) {
        let o = &row.observation;
        let start = format!("{number},{state},{},{}", o.pose_id, o.repeat);
        balls(out, &start, record)?;
    }
    Ok(())
}

fn balls(out: &mut dyn Write, start: &str, record: &CmmRecord) -> io::Result<()> {
    let of = |prefix: &'static str, points: &[Vector3]| -> Vec<(String, Vector3)> {
        points.iter().zip(1..).map(|(p, number)| (format!("{prefix}{number}"), *p)).collect()
    };
    for (ball, point) in of("P", &record.platform).into_iter().chain(of("B", &record.base)) {
        let [x, y, z] = [point.x, point.y, point.z].map(|metres| metres * 1e3);
        writeln!(out, "{start},{ball},{x:.7},{y:.7},{z:.7}")?;
    }
    Ok(())
}

/// The balls of an instrument in the format `balls/1`.
pub(super) fn nominal(instrument: &Instrument) -> Option<String> {
    let Instrument::Balls(cmm) = instrument else { return None };
    let mut text = String::from("format = \"balls/1\"\n");
    // Writing into a String cannot fail.
    let _ = writeln!(text, "sigma_um = {:?}", shortest(cmm.platform.sigma * 1e6));
    add(&mut text, "platform", "P", &cmm.platform.centres);
    if let Some(base) = &cmm.base {
        add(&mut text, "base", "B", &base.centres);
    }
    Some(text)
}

fn add(text: &mut String, side: &str, prefix: &str, centres: &[Vector3]) {
    for (centre, number) in centres.iter().zip(1..) {
        let [x, y, z] = [centre.x, centre.y, centre.z].map(|metres| shortest(metres * 1e3));
        let _ =
            writeln!(text, "\n[[{side}]]\nball = \"{prefix}{number}\"\ncenter_mm = [{x:?}, {y:?}, {z:?}]");
    }
}

/// A number without the rounding of the change of unit.
fn shortest(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}
