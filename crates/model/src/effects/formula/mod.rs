//! Formulas in the usual notation: numbers, names, `+ - * / ^`, parentheses and the usual functions.
//!
//! The usual rules apply: `-x^2` is `-(x^2)`, `2^3^2` is `2^(3^2)`, `1.5e-3` is a number. There are no loops, no
//! assignments and no calls into the program, so evaluation always ends. Text is at most [`MOST_CHARACTERS`] long and
//! nested at most [`MOST_DEPTH`] deep, both checked before anything is parsed.

mod dimension;
mod parser;
mod token;

pub use dimension::{PLAIN, UnitPowers};
use thiserror::Error;

/// Longest formula, in characters.
pub const MOST_CHARACTERS: usize = 2000;
/// Deepest nesting of parentheses, signs and powers.
pub const MOST_DEPTH: usize = 64;

/// Why a text is not a formula.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FormulaError {
    /// No text.
    #[error("the formula is empty")]
    Empty,
    /// Too much text.
    #[error("the formula has {length} characters; at most {MOST_CHARACTERS} are allowed")]
    TooLong {
        /// Its length.
        length: usize,
    },
    /// Nested too deeply.
    #[error("the formula is nested deeper than {MOST_DEPTH} levels")]
    TooDeep,
    /// A character that has no meaning in a formula.
    #[error("character {position} is `{character}`, which has no meaning in a formula")]
    Character {
        /// The character.
        character: char,
        /// Its place from 1.
        position: usize,
    },
    /// A number that is none.
    #[error("`{text}` at character {position} is not a number")]
    Number {
        /// As written.
        text: String,
        /// Its place from 1.
        position: usize,
    },
    /// Something else belongs there.
    #[error("at character {position} {expected} is expected, but there is {found}")]
    Expected {
        /// What belongs there.
        expected: &'static str,
        /// What stands there.
        found: String,
        /// Its place from 1.
        position: usize,
    },
    /// A length where a plain number belongs.
    #[error(
        "the argument of {function} is a length; divide it by a length with its unit, as in `{function}(2*pi*q/(8 mm))`, or by a shape \
         whose unit is a length"
    )]
    LengthInside {
        /// The function.
        function: &'static str,
    },
    /// A number beside a length that does not say its unit.
    #[error(
        "{number} is combined with a length but has no unit; write it, as in `{number} mm` or `{number} m`"
    )]
    BareLength {
        /// The number, as far as it is known.
        number: f64,
    },
    /// A sum or a comparison of unlike things.
    #[error("{left} and {right} cannot be added or compared; everything in a formula is SI")]
    MixedUnits {
        /// Unit on the left.
        left: String,
        /// Unit on the right.
        right: String,
    },
    /// A name nobody knows.
    #[error("`{name}` is not a known variable, parameter or function{}", suggestion.as_ref().map(|s| format!("; did you mean `{s}`?")).unwrap_or_default())]
    Unknown {
        /// As written.
        name: String,
        /// The nearest known name.
        suggestion: Option<String>,
    },
}

type Unary = fn(f64) -> f64;
type Binary = fn(f64, f64) -> f64;

/// One step of evaluation on a stack.
#[derive(Debug, Clone, Copy)]
enum Step {
    /// A number with the unit it was written with.
    Push(f64, Option<UnitPowers>),
    Load(usize),
    /// A function or a sign, with its name.
    Unary(&'static str, Unary),
    /// A function or an operator, with its name.
    Binary(&'static str, Binary),
}

/// A formula over named variables, ready to evaluate.
#[derive(Debug, Clone)]
pub struct Formula {
    text: String,
    steps: Vec<Step>,
    /// Numbers that wait at once.
    depth: usize,
}

/// Numbers that may wait at once without memory of their own.
const SHALLOW: usize = 16;

fn depth(steps: &[Step]) -> usize {
    let (mut waiting, mut most) = (0_usize, 1);
    for step in steps {
        match step {
            Step::Push(..) | Step::Load(_) => waiting += 1,
            Step::Unary(..) => {}
            Step::Binary(..) => waiting -= 1,
        }
        most = most.max(waiting);
    }
    most
}

impl Formula {
    /// Parse a text in which the names may be those of `variables`.
    ///
    /// # Errors
    /// [`FormulaError`] with the place in the text.
    pub fn parse(text: &str, variables: &[&str]) -> Result<Self, FormulaError> {
        let length = text.chars().count();
        if length > MOST_CHARACTERS {
            return Err(FormulaError::TooLong { length });
        }
        let tokens = token::tokens(text)?;
        if tokens.is_empty() {
            return Err(FormulaError::Empty);
        }
        let steps = parser::parse(&tokens, length, variables)?;
        let depth = depth(&steps);
        Ok(Self { text: text.trim().to_owned(), steps, depth })
    }

    /// Value for these values of the variables, in the order in which they were named; may be infinite or NaN.
    pub fn value(&self, variables: &[f64]) -> f64 {
        let mut shallow = [f64::NAN; SHALLOW];
        let mut deep = Vec::new();
        let stack = if self.depth <= SHALLOW {
            &mut shallow[..]
        } else {
            deep.resize(self.depth, f64::NAN);
            &mut deep[..]
        };
        let mut top = 0;
        for step in &self.steps {
            match *step {
                Step::Push(number, _) => {
                    stack[top] = number;
                    top += 1;
                }
                Step::Load(k) => {
                    stack[top] = variables.get(k).copied().unwrap_or(f64::NAN);
                    top += 1;
                }
                Step::Unary(_, f) => stack[top - 1] = f(stack[top - 1]),
                Step::Binary(_, f) => {
                    top -= 1;
                    stack[top - 1] = f(stack[top - 1], stack[top]);
                }
            }
        }
        stack[0]
    }

    /// Refuses units that cannot be right; `units`: of the variables, none for those that may have any.
    ///
    /// # Errors
    /// [`FormulaError::LengthInside`], [`FormulaError::BareLength`], [`FormulaError::MixedUnits`].
    pub fn check_units(&self, units: &[Option<UnitPowers>]) -> Result<(), FormulaError> {
        dimension::check(&self.steps, units)
    }

    /// True when the formula mentions a variable.
    pub fn uses(&self, variable: usize) -> bool {
        self.steps.iter().any(|s| matches!(s, Step::Load(k) if *k == variable))
    }

    /// As written.
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// Functions of one argument.
static UNARY: [(&str, Unary); 17] = [
    ("abs", f64::abs),
    ("sign", |x| if x == 0.0 { 0.0 } else { x.signum() }),
    ("sqrt", f64::sqrt),
    ("cbrt", f64::cbrt),
    ("exp", f64::exp),
    ("ln", f64::ln),
    ("log10", f64::log10),
    ("sin", f64::sin),
    ("cos", f64::cos),
    ("tan", f64::tan),
    ("asin", f64::asin),
    ("acos", f64::acos),
    ("atan", f64::atan),
    ("sinh", f64::sinh),
    ("cosh", f64::cosh),
    ("tanh", f64::tanh),
    ("step", |x| if x > 0.0 { 1.0 } else { 0.0 }),
];

/// Functions of two arguments.
static BINARY: [(&str, Binary); 4] =
    [("min", f64::min), ("max", f64::max), ("atan2", f64::atan2), ("hypot", f64::hypot)];

/// Names with a fixed value.
static CONSTANTS: [(&str, f64); 2] = [("pi", std::f64::consts::PI), ("tau", std::f64::consts::TAU)];

const NEWTON: UnitPowers = [1.0, 0.0, 0.0, 0.0];
const METRE: UnitPowers = [0.0, 1.0, 0.0, 0.0];
const KELVIN: UnitPowers = [0.0, 0.0, 1.0, 0.0];
const SECOND: UnitPowers = [0.0, 0.0, 0.0, 1.0];

/// Units that may stand behind a number, `8 mm`, how many of each make one SI unit, and what they measure.
static UNITS: [(&str, f64, UnitPowers); 12] = [
    ("m", 1.0, METRE),
    ("mm", 1e3, METRE),
    ("um", 1e6, METRE),
    ("nm", 1e9, METRE),
    ("N", 1.0, NEWTON),
    ("kN", 1e-3, NEWTON),
    ("K", 1.0, KELVIN),
    ("s", 1.0, SECOND),
    ("min", 1.0 / 60.0, SECOND),
    ("rad", 1.0, PLAIN),
    ("mrad", 1e3, PLAIN),
    ("deg", 180.0 / std::f64::consts::PI, PLAIN),
];

/// What a unit of a variable or a shape measures; none for a unit that is not known here.
pub fn dimension_of(unit: &str) -> Option<UnitPowers> {
    match unit {
        "" | "1" | "%" | "urad" => Some(PLAIN),
        "N m" | "Nm" => Some([1.0, 1.0, 0.0, 0.0]),
        "m/N" => Some([-1.0, 1.0, 0.0, 0.0]),
        "N/m" => Some([1.0, -1.0, 0.0, 0.0]),
        simple => UNITS.iter().find(|u| u.0 == simple).map(|u| u.2),
    }
}

/// Names of all functions.
pub fn functions() -> impl Iterator<Item = &'static str> {
    UNARY.iter().map(|f| f.0).chain(BINARY.iter().map(|f| f.0))
}

/// True when a name means something in every formula. `tau` is free: a time constant may be called so, and then is no number.
pub fn is_reserved(name: &str) -> bool {
    name == "pi" || functions().any(|known| known == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> f64 {
        Formula::parse(text, &["x", "f0", "elapsed"]).unwrap().value(&[2.0, 3.0, 0.5])
    }

    #[test]
    fn the_rules_of_school_hold() {
        let table = [
            ("-x^2", -4.0),
            ("2^3^2", 512.0),
            ("2^-x", 0.25),
            ("1.5e-3*x", 3e-3),
            ("1E2 + .5", 100.5),
            ("10 - 4 - 3", 3.0),
            ("16/4/2", 2.0),
            ("(1 + x)*f0", 9.0),
            ("max(x, f0) - min(x, f0)", 1.0),
            ("2*-x", -4.0),
            ("exp(-elapsed/0.5)", (-1.0_f64).exp()),
            ("abs(-x)*sign(x - 3)", -2.0),
            ("+x", 2.0),
            ("cos(pi)", -1.0),
            ("x/8 mm", 250.0),
            ("2 min + 1 s", 121.0),
            ("sin(90 deg)", 1.0),
        ];
        for (text, expected) in table {
            assert!(
                (value(text) - expected).abs() < 4.0 * f64::EPSILON * expected.abs(),
                "{text}: {}",
                value(text)
            );
        }
    }

    #[test]
    fn what_is_no_formula_says_why() {
        let table = [
            ("", "empty"),
            ("   ", "empty"),
            ("x +", "end of the formula"),
            ("(x", "`)`"),
            ("x)", "end of the formula"),
            ("x y", "operator"),
            ("2 x", "operator"),
            ("elapsd", "did you mean `elapsed`"),
            ("max(x)", "`,`"),
            ("sin x", "`(`"),
            ("x ; y", "no meaning"),
            ("1.2.3", "not a number"),
            ("1e", "not a number"),
            ("sin", "`(`"),
            ("\u{b5}*x", "no meaning"),
        ];
        for (text, part) in table {
            let message = Formula::parse(text, &["x", "f0", "elapsed"]).unwrap_err().to_string();
            assert!(message.contains(part), "{text:?}: {message}");
        }
    }

    #[test]
    fn hostile_text_is_refused_before_it_is_parsed() {
        let parse = |text: &str| Formula::parse(text, &["x"]).unwrap_err();
        assert_eq!(parse(&"(".repeat(100_000)), FormulaError::TooLong { length: 100_000 });
        for text in ["(".repeat(1999), "-".repeat(1999), "2^".repeat(999), "sin(".repeat(400)] {
            assert_eq!(parse(&text), FormulaError::TooDeep);
        }
        assert!(Formula::parse(&format!("{}x{}", "(".repeat(60), ")".repeat(60)), &["x"]).is_ok());
        assert!(Formula::parse(&format!("x{}", "+x".repeat(999)), &["x"]).is_ok());
    }
}
