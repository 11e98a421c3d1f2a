//! Units a file may state in its column names and keys, and their value in SI.

use std::f64::consts::PI;

/// The physical kind of a quantity; any unit of the same kind may stand in for another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Dimension {
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
    /// Mass, SI unit kg.
    Mass,
}

impl Dimension {
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
            Self::Mass => "mass",
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
    pub kind: Dimension,
    multiplier: f64,
    divisor: f64,
}

impl Unit {
    const fn new(name: &'static str, kind: Dimension, multiplier: f64, divisor: f64) -> Self {
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
pub(crate) const PLAIN: Unit = Unit::new("", Dimension::Number, 1.0, 1.0);

/// Every unit known to the files. The first of a kind is its SI unit.
pub const UNITS: &[Unit] = &[
    Unit::new("m", Dimension::Length, 1.0, 1.0),
    Unit::new("mm", Dimension::Length, 1.0, 1e3),
    Unit::new("um", Dimension::Length, 1.0, 1e6),
    Unit::new("nm", Dimension::Length, 1.0, 1e9),
    Unit::new("in", Dimension::Length, 0.0254, 1.0),
    Unit::new("mil", Dimension::Length, 25.4e-6, 1.0),
    Unit::new("uin", Dimension::Length, 25.4e-9, 1.0),
    Unit::new("rad", Dimension::Angle, 1.0, 1.0),
    Unit::new("mrad", Dimension::Angle, 1.0, 1e3),
    Unit::new("urad", Dimension::Angle, 1.0, 1e6),
    Unit::new("deg", Dimension::Angle, PI, 180.0),
    Unit::new("arcmin", Dimension::Angle, PI, 10_800.0),
    Unit::new("arcsec", Dimension::Angle, PI, 648_000.0),
    Unit::new("N", Dimension::Force, 1.0, 1.0),
    Unit::new("mN", Dimension::Force, 1.0, 1e3),
    Unit::new("daN", Dimension::Force, 10.0, 1.0),
    Unit::new("kN", Dimension::Force, 1e3, 1.0),
    Unit::new("MN", Dimension::Force, 1e6, 1.0),
    Unit::new("kgf", Dimension::Force, 9.806_65, 1.0),
    Unit::new("lbf", Dimension::Force, 4.448_221_615_260_5, 1.0),
    Unit::new("Nm", Dimension::Moment, 1.0, 1.0),
    Unit::new("mNm", Dimension::Moment, 1.0, 1e3),
    Unit::new("Nmm", Dimension::Moment, 1.0, 1e3),
    Unit::new("kNm", Dimension::Moment, 1e3, 1.0),
    Unit::new("MNm", Dimension::Moment, 1e6, 1.0),
    Unit::new("kgfm", Dimension::Moment, 9.806_65, 1.0),
    Unit::new("lbfin", Dimension::Moment, 4.448_221_615_260_5 * 0.0254, 1.0),
    Unit::new("lbfft", Dimension::Moment, 4.448_221_615_260_5 * 0.3048, 1.0),
    Unit::new("K", Dimension::TemperatureDifference, 1.0, 1.0),
    Unit::new("degC", Dimension::TemperatureDifference, 1.0, 1.0),
    Unit::new("s", Dimension::Time, 1.0, 1.0),
    Unit::new("ms", Dimension::Time, 1.0, 1e3),
    Unit::new("min", Dimension::Time, 60.0, 1.0),
    Unit::new("h", Dimension::Time, 3600.0, 1.0),
    Unit::new("N_per_m", Dimension::Stiffness, 1.0, 1.0),
    Unit::new("N_per_mm", Dimension::Stiffness, 1e3, 1.0),
    Unit::new("N_per_um", Dimension::Stiffness, 1e6, 1.0),
    Unit::new("kN_per_mm", Dimension::Stiffness, 1e6, 1.0),
    Unit::new("kg", Dimension::Mass, 1.0, 1.0),
    Unit::new("g", Dimension::Mass, 1.0, 1e3),
    Unit::new("lb", Dimension::Mass, 0.453_592_37, 1.0),
];

/// The unit written as `text`: its exact name first, else its name in any case when only one unit can be meant
/// (`MM` is mm; `mn` could be mN or MN and is none; `Nm` is never a length).
///
/// `µ` stands for u, `°` for deg; dots, middle dots and blanks inside a product and the slash of a quotient are
/// understood (`N·m`, `N/um`).
pub fn unit_named(text: &str, expected: Dimension) -> Option<&'static Unit> {
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
            '°' | 'º' | '˚' => plain.push_str("deg"),
            '′' => plain.push_str("arcmin"),
            '″' => plain.push_str("arcsec"),
            '/' => plain.push_str("_per_"),
            '.' | '·' | '⋅' | '∙' | '*' | ' ' | '\u{a0}' => {}
            other => plain.push(other),
        }
    }
    match plain.to_ascii_lowercase().as_str() {
        "inch" | "inches" => "in".to_owned(),
        "micron" | "microns" => "um".to_owned(),
        "degree" | "degrees" => "deg".to_owned(),
        // Products are written with an underscore where a name stands in a header: lbf_in.
        _ if !plain.contains("_per_") => plain.replace('_', ""),
        _ => plain,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn si(text: &str, kind: Dimension) -> f64 {
        let unit = unit_named(text, kind).unwrap_or_else(|| panic!("{text} is a unit"));
        assert_eq!(unit.kind, kind, "{text}");
        unit.to_si(1.0)
    }

    #[test]
    fn every_unit_has_its_si_value() {
        let table = [
            ("m", Dimension::Length, 1.0),
            ("mm", Dimension::Length, 1e-3),
            ("um", Dimension::Length, 1e-6),
            ("µm", Dimension::Length, 1e-6),
            ("μm", Dimension::Length, 1e-6),
            ("nm", Dimension::Length, 1e-9),
            ("in", Dimension::Length, 0.0254),
            ("rad", Dimension::Angle, 1.0),
            ("mrad", Dimension::Angle, 1e-3),
            ("urad", Dimension::Angle, 1e-6),
            ("µrad", Dimension::Angle, 1e-6),
            ("deg", Dimension::Angle, PI / 180.0),
            ("°", Dimension::Angle, PI / 180.0),
            ("arcmin", Dimension::Angle, PI / 180.0 / 60.0),
            ("arcsec", Dimension::Angle, PI / 180.0 / 3600.0),
            ("N", Dimension::Force, 1.0),
            ("mN", Dimension::Force, 1e-3),
            ("daN", Dimension::Force, 10.0),
            ("kN", Dimension::Force, 1e3),
            ("″", Dimension::Angle, PI / 180.0 / 3600.0),
            ("º", Dimension::Angle, PI / 180.0),
            ("MN", Dimension::Force, 1e6),
            ("Nm", Dimension::Moment, 1.0),
            ("N.m", Dimension::Moment, 1.0),
            ("N·m", Dimension::Moment, 1.0),
            ("N m", Dimension::Moment, 1.0),
            ("mNm", Dimension::Moment, 1e-3),
            ("Nmm", Dimension::Moment, 1e-3),
            ("kNm", Dimension::Moment, 1e3),
            ("K", Dimension::TemperatureDifference, 1.0),
            ("°C", Dimension::TemperatureDifference, 1.0),
            ("degC", Dimension::TemperatureDifference, 1.0),
            ("s", Dimension::Time, 1.0),
            ("ms", Dimension::Time, 1e-3),
            ("min", Dimension::Time, 60.0),
            ("h", Dimension::Time, 3600.0),
            ("N/um", Dimension::Stiffness, 1e6),
            ("inch", Dimension::Length, 0.0254),
            ("mil", Dimension::Length, 25.4e-6),
            ("microns", Dimension::Length, 1e-6),
            ("kgf", Dimension::Force, 9.806_65),
            ("lbf", Dimension::Force, 4.448_221_615_260_5),
            ("lbf in", Dimension::Moment, 0.112_984_829_027_616_7),
            ("lbf_ft", Dimension::Moment, 1.355_817_948_331_400_4),
            ("kgf m", Dimension::Moment, 9.806_65),
            ("g", Dimension::Mass, 1e-3),
            ("lb", Dimension::Mass, 0.453_592_37),
            ("N/µm", Dimension::Stiffness, 1e6),
            ("kN/mm", Dimension::Stiffness, 1e6),
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
        assert_eq!(unit_named("MM", Dimension::Length).map(|u| u.name), Some("mm"));
        assert_eq!(unit_named("URad", Dimension::Angle).map(|u| u.name), Some("urad"));
        assert_eq!(unit_named("n", Dimension::Force).map(|u| u.name), Some("N"));
        assert_eq!(unit_named("mn", Dimension::Force), None);
        assert_eq!(unit_named("Nm", Dimension::Length).map(|u| u.kind), Some(Dimension::Moment));
    }

    #[test]
    fn a_short_decimal_comes_back_as_the_same_short_decimal() {
        for (name, kind) in [("mm", Dimension::Length), ("deg", Dimension::Angle), ("urad", Dimension::Angle)]
        {
            let unit = unit_named(name, kind).unwrap();
            for value in [146.722_14, -31.186_753_6, 0.1, 3.0, 5.231_809_37, 0.0] {
                assert_eq!(unit.from_si(unit.to_si(value)).to_bits(), f64::to_bits(value), "{value} {name}");
            }
        }
    }
}
