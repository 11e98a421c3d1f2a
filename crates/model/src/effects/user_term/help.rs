//! What may be written in a term file, for people who write one.

use super::file::UNITS;
use super::variables::{OF_LEG, OF_READING, meaning};
use crate::effects::formula;

/// A term file to begin with.
pub const EXAMPLE: &str = "\
format = \"term/1\"
id = \"my-effect\"
title = \"Legs soften with their length\"
elongation = \"size * (q - q_home) * df\"      # of each leg, m; everything in SI

[[parameters]]
name = \"size\"
unit = \"nm/(N mm)\"
per_si = 1e6              # how many of this unit make one SI unit, here 1/N
scale = 0.5            # its physically sensible size, in that unit
";

/// A variable of a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FormulaVariable {
    /// As written in formulas.
    pub name: &'static str,
    /// SI unit; empty for a plain number.
    pub unit: &'static str,
    /// What it stands for.
    pub meaning: &'static str,
    /// True when it differs from leg to leg, and so belongs into formulas of an elongation only.
    pub of_leg: bool,
}

/// All variables, those of a leg first.
pub fn variables() -> Vec<FormulaVariable> {
    let described = |name: &'static str, of_leg: bool| {
        let [unit, meaning] = meaning(name);
        FormulaVariable { name, unit, meaning, of_leg }
    };
    let of_reading = OF_READING.into_iter().map(|name| described(name, false));
    OF_LEG.into_iter().map(|name| described(name, true)).chain(of_reading).collect()
}

/// Names of the functions.
pub fn functions() -> Vec<&'static str> {
    formula::functions().collect()
}

/// Units whose size is known; any other needs `per_si`.
pub fn units() -> Vec<&'static str> {
    UNITS.iter().map(|(unit, _)| *unit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_variable_is_explained() {
        let unexplained: Vec<_> = variables().into_iter().filter(|v| v.meaning.is_empty()).collect();
        assert!(unexplained.is_empty(), "{unexplained:?}");
    }

    #[test]
    fn the_example_is_a_term() {
        let term = super::super::parse(EXAMPLE).unwrap();
        assert_eq!(term.info().id, "my-effect");
    }
}
