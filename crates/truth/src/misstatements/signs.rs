//! The opposite sign: other definitions of a deflection, of who loads whom, of which way is positive.

use super::MisstatementEntry;
use super::numbers::{ALL, FIRST, LAST, Numbers, Scaled, scaled};

const fn negated(numbers: Numbers) -> Scaled {
    scaled(numbers, -1.0)
}

/// What turns every deflection against its load: no reading tells which of the three it was.
pub(super) const AGAINST: &[&str] = &["deflection-sign", "wrench-sign", "states-exchanged"];

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    Tables "deflection-negated" "Deflections are reference minus loaded.", AGAINST
        => negated(Numbers::Reading(ALL));
    Tables "wrench-negated" "Wrenches are those of the platform on the load.", AGAINST
        => negated(Numbers::Load(ALL));
    Tables "translations-negated" "Translations, but not rotations, are reference minus loaded.",
        &["deflection-sign", "axes"] => negated(Numbers::Reading(FIRST));
    Tables "rotations-negated" "Rotations are positive clockwise.", &["rotation-sign"]
        => negated(Numbers::Reading(LAST));
    Tables "dz-negated" "The vertical deflection is positive downwards.", &["deflection-sign", "axes"]
        => negated(Numbers::Reading(&[2]));
    Tables "dx-negated" "One lateral probe points the other way.", &["deflection-sign", "axes"]
        => negated(Numbers::Reading(&[0]));
    Tables "dgamma-negated" "The rotation about z is positive clockwise.", &["rotation-sign"]
        => negated(Numbers::Reading(&[5]));
    Tables "dalpha-negated" "The rotation about x is positive clockwise.", &["rotation-sign"]
        => negated(Numbers::Reading(&[3]));
    Tables "forces-negated" "Forces, but not moments, are those of the platform on the load.",
        &["wrench-sign", "moment-sign", "axes"] => negated(Numbers::Load(FIRST));
    Tables "fz-negated" "Weights are positive downwards.", &["wrench-sign", "axes"]
        => negated(Numbers::Load(&[2]));
    Tables "fx-negated" "The lateral force along x is positive the other way.", &["wrench-sign", "axes"]
        => negated(Numbers::Load(&[0]));
    Tables "moments-negated" "Moments are positive clockwise.", &["moment-sign"]
        => negated(Numbers::Load(LAST));
    Tables "mx-negated" "The moment about x is positive clockwise.", &["moment-sign"]
        => negated(Numbers::Load(&[3]));
];
