//! Numbers in a unit that is not that of their column.

use hexbench_core::{Dataset, Hexapod, Observation};
use rand_pcg::Pcg64;

use super::numbers::{ALL, FIRST, LAST, Numbers, scaled};
use super::{Misstatement, MisstatementEntry};

/// Standard gravity, m/s2: a kilogram-force in N.
pub(super) const KGF_N: f64 = 9.806_65;
/// A pound-force in N.
const LBF_N: f64 = 4.448_221_615_260_5;
const INCH_MM: f64 = 25.4;
const DEG_PER_RAD: f64 = 57.295_779_513_082_32;
const ARCSEC_PER_RAD: f64 = 206_264.806_247_096_36;
const UNIT: &[&str] = &["unit"];

/// Its entries in the registry. A factor is the number as the file is read over the number that is meant.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "translations-um-as-mm" "Translations in um are declared mm.", UNIT
        => scaled(Numbers::Reading(FIRST), 1e3);
    Tables "translations-mm-as-um" "Translations in mm are declared um.", UNIT
        => scaled(Numbers::Reading(FIRST), 1e-3);
    Tables "dz-mm-as-um" "One translation in mm is declared um as the others are.", UNIT
        => scaled(Numbers::Reading(&[2]), 1e-3);
    Tables "rotations-urad-as-mrad" "Rotations in urad are declared mrad.", UNIT
        => scaled(Numbers::Reading(LAST), 1e3);
    Tables "rotations-deg-as-urad" "Rotations in deg are declared urad.", UNIT
        => scaled(Numbers::Reading(LAST), DEG_PER_RAD * 1e-6);
    Tables "rotations-arcsec-as-urad" "Rotations in seconds of arc are declared urad.", UNIT
        => scaled(Numbers::Reading(LAST), ARCSEC_PER_RAD * 1e-6);
    Tables "rotations-deg-as-rad" "Rotations in deg are declared rad.", UNIT
        => scaled(Numbers::Reading(LAST), DEG_PER_RAD);
    Tables "readings-mm-as-um" "All readings, in mm and mrad, are declared um and urad.", UNIT
        => scaled(Numbers::Reading(ALL), 1e-3);
    Tables "readings-um-as-mm" "All readings, in um and urad, are declared mm and mrad.", UNIT
        => scaled(Numbers::Reading(ALL), 1e3);
    Tables "pose-angles-rad-as-deg" "Angles of poses in rad are declared deg.", UNIT
        => scaled(Numbers::Pose(LAST), 1.0 / DEG_PER_RAD);
    Tables "pose-positions-m-as-mm" "Positions of poses in m are declared mm.", UNIT
        => scaled(Numbers::Pose(FIRST), 1e-3);
    Tables "pose-positions-inch-as-mm" "Positions of poses in inches are declared mm.", UNIT
        => scaled(Numbers::Pose(FIRST), 1.0 / INCH_MM);
    Tables "pose-positions-cm-as-mm" "Positions of poses in cm are declared mm.", UNIT
        => scaled(Numbers::Pose(FIRST), 0.1);
    Tables "moments-nmm-as-nm" "Moments in N mm are declared N m.", UNIT => scaled(Numbers::Load(LAST), 1e3);
    Tables "forces-kg-as-n" "Forces are the masses that were hung up, in kg, declared N.", UNIT
        => scaled(Numbers::Load(FIRST), 1.0 / KGF_N);
    Tables "forces-lbf-as-n" "Forces in pounds are declared N.", UNIT
        => scaled(Numbers::Load(FIRST), 1.0 / LBF_N);
    Tables "forces-kn-as-n" "Forces in kN are declared N.", UNIT => scaled(Numbers::Load(FIRST), 1e-3);
    Tables "fz-kg-as-n" "Weights in kg stand beside lateral forces in N.", UNIT
        => scaled(Numbers::Load(&[2]), 1.0 / KGF_N);
    Tables "loads-kgf-as-n" "All loads, in kgf and kgf m, are declared N and N m.", UNIT
        => scaled(Numbers::Load(ALL), 1.0 / KGF_N);
    Tables "elapsed-min-as-s" "Waiting times in minutes are declared seconds.", UNIT
        => Surroundings { of: |row| &mut row.elapsed, factor: 1.0 / 60.0 };
    Tables "temperature-fahrenheit-as-kelvin" "Changes of temperature in degrees Fahrenheit are declared K.",
        UNIT => Surroundings { of: |row| &mut row.delta_t, factor: 1.8 };
    Machine "joints-inch-as-mm" "Joints in inches are declared mm.", &["unit", "geometry"]
        => Joints { base: 1.0 / INCH_MM, platform: 1.0 / INCH_MM };
    Machine "base-joints-cm-as-mm" "Base joints in cm are declared mm as the platform joints are.",
        &["unit", "geometry"] => Joints { base: 0.1, platform: 1.0 };
    Machine "platform-joints-inch-as-mm" "Platform joints in inches are declared mm as the base joints are.",
        &["unit", "geometry"] => Joints { base: 1.0, platform: 1.0 / INCH_MM };
    Machine "sigma-um-as-mm" "The stated standard deviations, in um and urad, are declared mm and mrad.",
        &["unit", "noise-level"] => Sigma { factor: 1e3 };
    Machine "sigma-mm-as-um" "The stated standard deviations, in mm and mrad, are declared um and urad.",
        &["unit", "noise-level"] => Sigma { factor: 1e-3 };
];

/// A circumstance in another unit.
#[derive(Debug)]
struct Surroundings {
    of: fn(&mut Observation) -> &mut f64,
    factor: f64,
}

impl Misstatement for Surroundings {
    fn write(&self, data: &mut Dataset, _: &Hexapod, _: &mut Pcg64) {
        for row in &mut data.observations {
            *(self.of)(row) *= self.factor;
        }
    }
}

/// Joints in another unit.
#[derive(Debug)]
struct Joints {
    base: f64,
    platform: f64,
}

impl Misstatement for Joints {
    fn describe(&self, hexapod: &mut Hexapod, _: &mut Pcg64) {
        hexapod.base_joints = hexapod.base_joints.map(|a| a * self.base);
        hexapod.platform_joints = hexapod.platform_joints.map(|b| b * self.platform);
    }
}

/// The stated noise in another unit.
#[derive(Debug)]
struct Sigma {
    factor: f64,
}

impl Misstatement for Sigma {
    fn describe(&self, hexapod: &mut Hexapod, _: &mut Pcg64) {
        if let Some(metrology) = &mut hexapod.metrology {
            metrology.sigma_translation *= self.factor;
            metrology.sigma_rotation *= self.factor;
        }
    }
}
