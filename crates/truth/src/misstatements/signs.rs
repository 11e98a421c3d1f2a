//! The opposite sign: other definitions of a deflection, of who loads whom, of which way is positive.

use super::numbers::{ALL, FIRST, LAST, Numbers, Scaled, scaled};
use super::{MisstatementEntry, tables};

const fn negated(numbers: Numbers) -> Scaled {
    scaled(numbers, -1.0)
}

/// What turns every deflection against its load: no reading tells which of the three it was.
pub(super) const AGAINST: &[&str] = &["deflection-sign", "wrench-sign", "states-exchanged"];

/// Its entries in the registry.
pub(super) const MISSTATEMENTS: &[MisstatementEntry] = entries![
    tables "deflection-negated" "Deflections are reference minus loaded.", AGAINST
        => negated(Numbers::Reading(ALL));
    tables "wrench-negated" "Wrenches are those of the platform on the load.", AGAINST
        => negated(Numbers::Load(ALL));
    tables "translations-negated" "Translations, but not rotations, are reference minus loaded.",
        &["deflection-sign", "axes"] => negated(Numbers::Reading(FIRST));
    tables "rotations-negated" "Rotations are positive clockwise.", &["rotation-sign"]
        => negated(Numbers::Reading(LAST));
    tables "dz-negated" "The vertical deflection is positive downwards.", &["deflection-sign", "axes"]
        => negated(Numbers::Reading(&[2]));
    tables "dx-negated" "One lateral probe points the other way.", &["deflection-sign", "axes"]
        => negated(Numbers::Reading(&[0]));
    tables "dgamma-negated" "The rotation about z is positive clockwise.", &["rotation-sign"]
        => negated(Numbers::Reading(&[5]));
    tables "dalpha-negated" "The rotation about x is positive clockwise.", &["rotation-sign"]
        => negated(Numbers::Reading(&[3]));
    tables "forces-negated" "Forces, but not moments, are those of the platform on the load.",
        &["wrench-sign", "moment-sign", "axes"] => negated(Numbers::Load(FIRST));
    tables "fz-negated" "Weights are positive downwards.", &["wrench-sign", "axes"]
        => negated(Numbers::Load(&[2]));
    tables "fx-negated" "The lateral force along x is positive the other way.", &["wrench-sign", "axes"]
        => negated(Numbers::Load(&[0]));
    tables "moments-negated" "Moments are positive clockwise.", &["moment-sign"]
        => negated(Numbers::Load(LAST));
    tables "mx-negated" "The moment about x is positive clockwise.", &["moment-sign"]
        => negated(Numbers::Load(&[3]));
];
