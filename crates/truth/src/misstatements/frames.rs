//! Wrenches or deflections in the axes of the platform instead of fixed ones.

use hexbench_core::{Dataset, Hexapod, Matrix3, Observation, Wrench};
use rand_pcg::Pcg64;

use super::rotations::{angles, states, translation, write};
use super::{Misstatement, MisstatementEntry};

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "wrench-in-mobile-axes" "Loads are in the axes of the platform.", &["wrench-frame"]
        => Loads { forces: true, moments: true };
    Tables "moments-in-mobile-axes" "Moments are in the axes of the platform, forces in fixed ones.",
        &["wrench-frame"] => Loads { forces: false, moments: true };
    Tables "deflections-in-mobile-axes" "Deflections are loaded poses relative to reference poses, in the axes of the platform.",
        &["deflection-frame"] => Deflections { rotations: true };
    Tables "translations-in-mobile-axes" "Translations are in the axes of the platform, rotations are differences of Euler angles.",
        &["deflection-frame"] => Deflections { rotations: false };
];

/// Loads in mobile axes.
#[derive(Debug)]
struct Loads {
    forces: bool,
    moments: bool,
}

impl Loads {
    fn of(&self, wrench: &Wrench, back: &Matrix3) -> Wrench {
        Wrench {
            force: if self.forces { back * wrench.force } else { wrench.force },
            moment: if self.moments { back * wrench.moment } else { wrench.moment },
        }
    }
}

impl Misstatement for Loads {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        for row in &mut data.observations {
            let back = row.pose.rotation().transpose();
            row.wrench = self.of(&row.wrench, &back);
            row.reference = self.of(&row.reference, &back);
        }
    }
}

/// Deflections in mobile axes.
#[derive(Debug)]
struct Deflections {
    /// True when rotations are too.
    rotations: bool,
}

impl Misstatement for Deflections {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        for row in &mut data.observations {
            relate(row, self.rotations);
        }
    }
}

fn relate(row: &mut Observation, rotations: bool) {
    let [reference, loaded] = states(row);
    let back = reference.transpose();
    let moved = back * translation(row);
    write(row, 0, &moved);
    if rotations {
        write(row, 3, &angles(&(back * loaded)));
    }
}
