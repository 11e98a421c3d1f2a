//! Units a file may state in its column names and keys, and their value in SI.

use std::f64::consts::PI;

/// The physical kind of a quantity; any unit of the same kind may stand in for another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// A plain number without unit.
    Number,
    /// Length, SI unit m.
    Length,
    /// Angle, SI unit rad.
    Angle,
    /// Force, SI unit N.
    Force,
    /// Moment, SI unit N m.
    Moment,
    /// Difference of temperatures, SI unit K.
    TemperatureDifference,
    /// Time, SI unit s.
    Time,
    /// Stiffness of a leg, SI unit N/m.
    Stiffness,
}

impl Kind {
    /// The kind in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Number => "plain number",
            Self::Length => "length",
            Self::Angle => "angle",
            Self::Force => "force",
            Self::Moment => "moment",
            Self::TemperatureDifference => "temperature difference",
            Self::Time => "time",
            Self::Stiffness => "stiffness",
        }
    }

    /// The kind with its article: `a length`, `an angle`.
    pub fn with_article(self) -> String {
        let article = if self == Self::Angle { "an" } else { "a" };
        format!("{article} {}", self.name())
    }

    /// Every unit of this kind, in the order of [`UNITS`].
    pub fn units(self) -> impl Iterator<Item = &'static Unit> {
        UNITS.iter().filter(move |unit| unit.kind == self)
    }

    /// The names of the units of this kind, for a message: `m, mm, um, nm, in`.
    pub fn unit_names(self) -> String {
        self.units().map(|unit| unit.name).collect::<Vec<_>>().join(", ")
    }
}

/// A unit: its name in files and its value in SI, kept as a fraction so that 0.1 mm is exactly 0.1 / 1000.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Name as written in files, for example `um`.
    pub name: &'static str,
    /// What it measures.
    pub kind: Kind,
    multiplier: f64,
    divisor: f64,
}

impl Unit {
    const fn new(name: &'static str, kind: Kind, multiplier: f64, divisor: f64) -> Self {
        Self { name, kind, multiplier, divisor }
    }

    /// A value in this unit, in SI.
    pub fn to_si(&self, value: f64) -> f64 {
        value * self.multiplier / self.divisor
    }

    /// An SI value in this unit: the shortest decimal that [`to_si`](Self::to_si) turns back into `si`, when there
    /// is one, else the nearest number (one rounding away).
    pub fn from_si(&self, si: f64) -> f64 {
        let value = si * self.divisor / self.multiplier;
        let shorter = |digits: usize| format!("{value:.digits$e}").parse::<f64>().ok();
        let returns = |candidate: &f64| self.to_si(*candidate).to_bits() == si.to_bits();
        (13..=15).filter_map(shorter).find(returns).unwrap_or(value)
    }
}

/// The unit of a plain number.
pub(crate) const PLAIN: Unit = Unit::new("", Kind::Number, 1.0, 1.0);

/// Every unit known to the files. The first of a kind is its SI unit.
pub const UNITS: &[Unit] = &[
    Unit::new("m", Kind::Length, 1.0, 1.0),
    Unit::new("mm", Kind::Length, 1.0, 1e3),
    Unit::new("um", Kind::Length, 1.0, 1e6),
    Unit::new("nm", Kind::Length, 1.0, 1e9),
    Unit::new("in", Kind::Length, 0.0254, 1.0),
    Unit::new("rad", Kind::Angle, 1.0, 1.0),
    Unit::new("mrad", Kind::Angle, 1.0, 1e3),
    Unit::new("urad", Kind::Angle, 1.0, 1e6),
    Unit::new("deg", Kind::Angle, PI, 180.0),
    Unit::new("arcmin", Kind::Angle, PI, 10_800.0),
    Unit::new("arcsec", Kind::Angle, PI, 648_000.0),
    Unit::new("N", Kind::Force, 1.0, 1.0),
    Unit::new("mN", Kind::Force, 1.0, 1e3),
    Unit::new("kN", Kind::Force, 1e3, 1.0),
    Unit::new("MN", Kind::Force, 1e6, 1.0),
    Unit::new("Nm", Kind::Moment, 1.0, 1.0),
    Unit::new("mNm", Kind::Moment, 1.0, 1e3),
    Unit::new("Nmm", Kind::Moment, 1.0, 1e3),
    Unit::new("kNm", Kind::Moment, 1e3, 1.0),
    Unit::new("MNm", Kind::Moment, 1e6, 1.0),
    Unit::new("K", Kind::TemperatureDifference, 1.0, 1.0),
    Unit::new("degC", Kind::TemperatureDifference, 1.0, 1.0),
    Unit::new("s", Kind::Time, 1.0, 1.0),
    Unit::new("ms", Kind::Time, 1.0, 1e3),
    Unit::new("min", Kind::Time, 60.0, 1.0),
    Unit::new("h", Kind::Time, 3600.0, 1.0),
    Unit::new("N_per_m", Kind::Stiffness, 1.0, 1.0),
    Unit::new("N_per_mm", Kind::Stiffness, 1e3, 1.0),
    Unit::new("N_per_um", Kind::Stiffness, 1e6, 1.0),
    Unit::new("kN_per_mm", Kind::Stiffness, 1e6, 1.0),
];

/// The unit written as `text`: its exact name first, else its name in any case when only one unit can be meant
/// (`MM` is mm; `mn` could be mN or MN and is none; `Nm` is never a length).
///
/// `µ` stands for u, `°` for deg; dots, middle dots and blanks inside a product and the slash of a quotient are
/// understood (`N·m`, `N/um`).
pub fn unit_named(text: &str, expected: Kind) -> Option<&'static Unit> {
    let plain = plain_spelling(text);
    let exact = UNITS.iter().find(|unit| unit.name == plain);
    exact.or_else(|| only_one(expected.units(), &plain)).or_else(|| only_one(UNITS.iter(), &plain))
}

fn only_one(mut units: impl Iterator<Item = &'static Unit>, plain: &str) -> Option<&'static Unit> {
    let is_meant = |unit: &&Unit| unit.name.eq_ignore_ascii_case(plain);
    let first = units.find(is_meant)?;
    units.find(is_meant).is_none().then_some(first)
}

fn plain_spelling(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for symbol in text.trim().chars() {
        match symbol {
            'µ' | 'μ' => plain.push('u'),
            '°' => plain.push_str("deg"),
            '/' => plain.push_str("_per_"),
            '.' | '·' | '⋅' | '*' | ' ' => {}
            other => plain.push(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    fn si(text: &str, kind: Kind) -> f64 {
        let unit = unit_named(text, kind).unwrap_or_else(|| panic!("{text} is a unit"));
        assert_eq!(unit.kind, kind, "{text}");
        unit.to_si(1.0)
    }

    #[test]
    fn every_unit_has_its_si_value() {
        let table = [
            ("m", Kind::Length, 1.0),
            ("mm", Kind::Length, 1e-3),
            ("um", Kind::Length, 1e-6),
            ("µm", Kind::Length, 1e-6),
            ("μm", Kind::Length, 1e-6),
            ("nm", Kind::Length, 1e-9),
            ("in", Kind::Length, 0.0254),
            ("rad", Kind::Angle, 1.0),
            ("mrad", Kind::Angle, 1e-3),
            ("urad", Kind::Angle, 1e-6),
            ("µrad", Kind::Angle, 1e-6),
            ("deg", Kind::Angle, PI / 180.0),
            ("°", Kind::Angle, PI / 180.0),
            ("arcmin", Kind::Angle, PI / 180.0 / 60.0),
            ("arcsec", Kind::Angle, PI / 180.0 / 3600.0),
            ("N", Kind::Force, 1.0),
            ("mN", Kind::Force, 1e-3),
            ("kN", Kind::Force, 1e3),
            ("MN", Kind::Force, 1e6),
            ("Nm", Kind::Moment, 1.0),
            ("N.m", Kind::Moment, 1.0),
            ("N·m", Kind::Moment, 1.0),
            ("N m", Kind::Moment, 1.0),
            ("mNm", Kind::Moment, 1e-3),
            ("Nmm", Kind::Moment, 1e-3),
            ("kNm", Kind::Moment, 1e3),
            ("K", Kind::TemperatureDifference, 1.0),
            ("°C", Kind::TemperatureDifference, 1.0),
            ("degC", Kind::TemperatureDifference, 1.0),
            ("s", Kind::Time, 1.0),
            ("ms", Kind::Time, 1e-3),
            ("min", Kind::Time, 60.0),
            ("h", Kind::Time, 3600.0),
            ("N/um", Kind::Stiffness, 1e6),
            ("N/µm", Kind::Stiffness, 1e6),
            ("kN/mm", Kind::Stiffness, 1e6),
        ];
        for (text, kind, expected) in table {
            let value = si(text, kind);
            assert!(
                (value - expected).abs() <= 4.0 * f64::EPSILON * expected,
                "{text}: {value} not {expected}"
            );
        }
    }

    #[test]
    fn case_matters_only_where_two_units_differ_by_it() {
        assert_eq!(unit_named("MM", Kind::Length).map(|u| u.name), Some("mm"));
        assert_eq!(unit_named("URad", Kind::Angle).map(|u| u.name), Some("urad"));
        assert_eq!(unit_named("n", Kind::Force).map(|u| u.name), Some("N"));
        assert_eq!(unit_named("mn", Kind::Force), None);
        assert_eq!(unit_named("Nm", Kind::Length).map(|u| u.kind), Some(Kind::Moment));
    }

    #[test]
    fn a_short_decimal_comes_back_as_the_same_short_decimal() {
        for (name, kind) in [("mm", Kind::Length), ("deg", Kind::Angle), ("urad", Kind::Angle)] {
            let unit = unit_named(name, kind).unwrap();
            for value in [146.722_14, -31.186_753_6, 0.1, 3.0, 5.231_809_37, 0.0] {
                assert_eq!(unit.from_si(unit.to_si(value)).to_bits(), f64::to_bits(value), "{value} {name}");
            }
        }
    }
}
