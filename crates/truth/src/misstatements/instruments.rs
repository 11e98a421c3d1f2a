//! Instruments that show too much throughout: by a factor of their own, by an amount, or nothing at all; and loads that are not written down.

use hexbench_core::{Dataset, Hexapod};
use rand_pcg::Pcg64;

use super::numbers::{LAST, Numbers, scaled};
use super::{Misstatement, MisstatementEntry};

/// Shown over true where a calibration factor is wrong.
const TOO_MUCH: f64 = 1.15;
const FAR_TOO_MUCH: f64 = 1.5;
const TOO_LITTLE: f64 = 0.85;
/// A zero error over the noise of a reading.
const ZERO_SIGMAS: f64 = 10.0;

const FACTOR: &[&str] = &["unit"];
/// Loads have a tolerance, which is fitted.
const FACTOR_OF_LOADS: &[&str] = &["unit", "tolerance"];
const ZERO: &[&str] = &["zero-error"];
const IDLE: &[&str] = &["idle-column"];
/// The rows under them alone, or the column.
const NOT_WRITTEN: &[&str] = &["load", "idle-column"];

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "dx-factor" "The probe along x shows 15 % too much.", FACTOR
        => scaled(Numbers::Reading(&[0]), TOO_MUCH);
    Tables "dz-factor" "The probe along z shows 15 % too little.", FACTOR
        => scaled(Numbers::Reading(&[2]), TOO_LITTLE);
    Tables "rotations-factor" "Rotations are differences of probes that stand 15 % closer than written.",
        FACTOR => scaled(Numbers::Reading(LAST), TOO_LITTLE);
    Tables "fx-factor" "The load cell along x shows half as much again.", FACTOR_OF_LOADS
        => scaled(Numbers::Load(&[0]), FAR_TOO_MUCH);
    Tables "mx-factor" "The load cell about x shows 15 % too little.", FACTOR_OF_LOADS
        => scaled(Numbers::Load(&[3]), TOO_LITTLE);
    Tables "dx-zero" "The probe along x shows something where nothing has moved.", ZERO => Column::Off(0);
    Tables "dz-zero" "The probe along z shows something where nothing has moved.", ZERO => Column::Off(2);
    Tables "dgamma-zero" "The rotation about z shows something where nothing has moved.", ZERO
        => Column::Off(5);
    Tables "fx-not-written" "Forces along x were applied and not written down: their column holds zeros.",
        NOT_WRITTEN => scaled(Numbers::Load(&[0]), 0.0);
    Tables "mx-not-written" "Moments about x were applied and not written down: their column holds zeros.",
        NOT_WRITTEN => scaled(Numbers::Load(&[3]), 0.0);
    Tables "dy-dead" "The probe along y was not plugged in: its column holds zeros.", IDLE => Column::Dead;
    Tables "dx-copied" "The column of x was copied over that of y.", IDLE => Column::Copied;
];

/// What one column holds instead of its readings.
#[derive(Debug)]
enum Column {
    /// Its readings and a zero error.
    Off(usize),
    /// Zeros, along y.
    Dead,
    /// The numbers of x, along y.
    Copied,
}

impl Misstatement for Column {
    fn write(&self, data: &mut Dataset, hexapod: &Hexapod, _: &mut Pcg64) {
        let stated = hexapod.metrology.map_or([0.0; 2], |m| [m.sigma_translation, m.sigma_rotation]);
        for row in &mut data.observations {
            let measured = &mut row.measured;
            match *self {
                Self::Off(k) => measured[k] += ZERO_SIGMAS * stated[k / 3],
                Self::Dead => measured[1] = 0.0,
                Self::Copied => measured[1] = measured[0],
            }
        }
    }
}
