//! Units of a formula, as far as they can be known.
//!
//! Sizes of a term take whatever unit makes its formula right, and a bare number may stand for anything; what is checked is where a
//! length in the wrong unit would go unnoticed: lengths inside functions and beside bare numbers, and sums of different units.

use super::{FormulaError, Step};

/// Powers of newton, meter, kelvin and second; of a plain number all are zero.
pub type UnitPowers = [f64; 4];

/// A plain number.
pub const PLAIN: UnitPowers = [0.0; 4];

/// What is known of a value on the stack.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Known {
    /// Its unit.
    Unit(UnitPowers),
    /// A number without a unit.
    Bare,
    /// Nothing: a size, or a power that is not a number.
    Nothing,
}

impl Known {
    fn is_length(self) -> bool {
        matches!(self, Self::Unit([n, m, k, s]) if n == 0.0 && k == 0.0 && s == 0.0 && m != 0.0)
    }

    fn times(self, other: Self, sign: f64) -> Self {
        match (self, other) {
            (Self::Nothing, _) | (_, Self::Nothing) => Self::Nothing,
            (Self::Bare, Self::Bare) => Self::Bare,
            (a, b) => {
                let powers = |x: Self| if let Self::Unit(u) = x { u } else { PLAIN };
                let (a, b) = (powers(a), powers(b));
                Self::Unit(std::array::from_fn(|k| a[k] + sign * b[k]))
            }
        }
    }

    fn to_power(self, exponent: f64) -> Self {
        if let Self::Unit(u) = self { Self::Unit(u.map(|p| p * exponent)) } else { self }
    }
}

/// Equal powers; thirds are not exact.
fn same(a: &[f64], b: &[f64]) -> bool {
    const ROUNDING: f64 = 1e-9;
    a.iter().zip(b).all(|(x, y)| (x - y).abs() < ROUNDING)
}

/// `m`, `N^2`, `a plain number`.
fn shown(unit: UnitPowers) -> String {
    let names = ["N", "m", "K", "s"];
    let shown = names.into_iter().zip(unit).filter(|(_, p)| *p != 0.0);
    let all: Vec<String> = shown
        .map(|(name, p)| if same(&[p], &[1.0]) { name.to_owned() } else { format!("{name}^{p}") })
        .collect();
    if all.is_empty() { "a plain number".to_owned() } else { all.join(" ") }
}

/// Refuses a formula whose units cannot be right; `units`: of its variables, none for those whose unit is not known.
pub(super) fn check(steps: &[Step], units: &[Option<UnitPowers>]) -> Result<(), FormulaError> {
    let mut stack: Vec<(Known, Option<f64>)> = Vec::new();
    for step in steps {
        let next = match *step {
            Step::Push(number, unit) => (unit.map_or(Known::Bare, Known::Unit), Some(number)),
            Step::Load(k) => (units.get(k).copied().flatten().map_or(Known::Nothing, Known::Unit), None),
            Step::Unary(name, f) => {
                let (x, number) = stack.pop().unwrap_or((Known::Nothing, None));
                (unary(name, x)?, number.map(f))
            }
            Step::Binary(name, f) => {
                let (y, b) = stack.pop().unwrap_or((Known::Nothing, None));
                let (x, a) = stack.pop().unwrap_or((Known::Nothing, None));
                (binary(name, (x, a), (y, b))?, a.zip(b).map(|(a, b)| f(a, b)))
            }
        };
        stack.push(next);
    }
    Ok(())
}

fn unary(function: &'static str, x: Known) -> Result<Known, FormulaError> {
    match function {
        "-" | "abs" => Ok(x),
        "sign" | "step" => Ok(Known::Unit(PLAIN)),
        "sqrt" => Ok(x.to_power(0.5)),
        "cbrt" => Ok(x.to_power(1.0 / 3.0)),
        _ if x.is_length() => Err(FormulaError::LengthInside { function }),
        _ => Ok(if x == Known::Nothing { x } else { Known::Unit(PLAIN) }),
    }
}

fn binary(
    name: &str,
    (x, a): (Known, Option<f64>),
    (y, b): (Known, Option<f64>),
) -> Result<Known, FormulaError> {
    match name {
        "*" => return Ok(x.times(y, 1.0)),
        "/" => return Ok(x.times(y, -1.0)),
        "^" => return Ok(power(x, b)),
        _ => {}
    }
    match (x, y) {
        (Known::Unit(u), Known::Unit(v)) if !same(&u, &v) => {
            Err(FormulaError::MixedUnits { left: shown(u), right: shown(v) })
        }
        (Known::Bare, other) | (other, Known::Bare) if other.is_length() && a.or(b) != Some(0.0) => {
            Err(FormulaError::BareLength { number: a.or(b).unwrap_or(f64::NAN) })
        }
        (Known::Nothing, _) | (_, Known::Nothing) => Ok(Known::Nothing),
        (Known::Bare, other) | (other, _) => Ok(other),
    }
}

/// A power; of what has a unit, with an exponent that is a number.
fn power(x: Known, exponent: Option<f64>) -> Known {
    match (x, exponent) {
        (Known::Unit(_), Some(exponent)) => x.to_power(exponent),
        (Known::Unit(u), None) if !same(&u, &PLAIN) => Known::Nothing,
        _ => x,
    }
}
