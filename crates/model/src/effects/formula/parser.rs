//! From words to steps: recursive descent with a limit on depth.

use super::token::{Token, TokenKind};
use super::{BINARY, CONSTANTS, FormulaError, MOST_DEPTH, PLAIN, Step, UNARY, UNITS, UnitPowers};
use hexbench_core::files::nearest;

/// Steps of a whole formula.
pub(super) fn parse(tokens: &[Token], length: usize, variables: &[&str]) -> Result<Vec<Step>, FormulaError> {
    let mut parser = Parser { tokens, at: 0, depth: 0, end: length + 1, variables, steps: Vec::new() };
    parser.sum()?;
    if parser.at < tokens.len() {
        return Err(parser.expected("an operator or the end of the formula"));
    }
    Ok(parser.steps)
}

struct Parser<'a> {
    tokens: &'a [Token],
    at: usize,
    depth: usize,
    end: usize,
    variables: &'a [&'a str],
    steps: Vec<Step>,
}

impl Parser<'_> {
    /// `product + product - ...`
    fn sum(&mut self) -> Result<(), FormulaError> {
        self.deeper(|p| {
            p.product()?;
            while let Some(symbol) = p.take_any(&['+', '-']) {
                p.product()?;
                p.steps.push(if symbol == '+' {
                    Step::Binary("+", |x, y| x + y)
                } else {
                    Step::Binary("-", |x, y| x - y)
                });
            }
            Ok(())
        })
    }

    /// `signed * signed / ...`
    fn product(&mut self) -> Result<(), FormulaError> {
        self.signed()?;
        while let Some(symbol) = self.take_any(&['*', '/']) {
            self.signed()?;
            self.steps.push(if symbol == '*' {
                Step::Binary("*", |x, y| x * y)
            } else {
                Step::Binary("/", |x, y| x / y)
            });
        }
        Ok(())
    }

    /// `-power`: a sign binds less than a power.
    fn signed(&mut self) -> Result<(), FormulaError> {
        match self.take_any(&['-', '+']) {
            Some('-') => {
                self.deeper(Self::signed)?;
                self.steps.push(Step::Unary("-", |x| -x));
                Ok(())
            }
            Some(_) => self.deeper(Self::signed),
            None => self.power(),
        }
    }

    /// `atom ^ signed`, from right to left.
    fn power(&mut self) -> Result<(), FormulaError> {
        self.atom()?;
        if self.take_any(&['^']).is_some() {
            self.deeper(Self::signed)?;
            self.steps.push(Step::Binary("^", power));
        }
        Ok(())
    }

    fn atom(&mut self) -> Result<(), FormulaError> {
        match self.tokens.get(self.at).map(|t| &t.kind) {
            Some(TokenKind::Number(number)) => {
                self.at += 1;
                let unit = self.take_unit();
                let si = unit.map_or(*number, |(per_si, _)| number / per_si);
                self.steps.push(Step::Push(si, unit.map(|u| u.1)));
                Ok(())
            }
            Some(TokenKind::Name(name)) => {
                self.at += 1;
                self.name(name)
            }
            Some(TokenKind::Symbol('(')) => {
                self.at += 1;
                self.sum()?;
                self.need(')', "`)`")
            }
            _ => Err(self.expected("a number, a name or `(`")),
        }
    }

    /// The unit behind a number: how many of it make one SI unit, and what it measures.
    fn take_unit(&mut self) -> Option<(f64, UnitPowers)> {
        let Some(TokenKind::Name(name)) = self.tokens.get(self.at).map(|t| &t.kind) else { return None };
        let (_, per_si, dimension) = UNITS.iter().find(|unit| unit.0 == name)?;
        self.at += 1;
        Some((*per_si, *dimension))
    }

    fn name(&mut self, name: &str) -> Result<(), FormulaError> {
        if let Some(k) = self.variables.iter().position(|v| *v == name) {
            self.steps.push(Step::Load(k));
        } else if let Some((_, value)) = CONSTANTS.iter().find(|c| c.0 == name) {
            self.steps.push(Step::Push(*value, Some(PLAIN)));
        } else if let Some((name, function)) = UNARY.iter().find(|f| f.0 == name) {
            self.need('(', "`(`")?;
            self.sum()?;
            self.need(')', "`)`")?;
            self.steps.push(Step::Unary(name, *function));
        } else if let Some((name, function)) = BINARY.iter().find(|f| f.0 == name) {
            self.need('(', "`(`")?;
            self.sum()?;
            self.need(',', "`,`")?;
            self.sum()?;
            self.need(')', "`)`")?;
            self.steps.push(Step::Binary(name, *function));
        } else {
            return Err(self.unknown(name));
        }
        Ok(())
    }

    fn unknown(&self, name: &str) -> FormulaError {
        let functions = UNARY.iter().map(|f| f.0).chain(BINARY.iter().map(|f| f.0));
        let known = self.variables.iter().copied().chain(functions);
        FormulaError::Unknown { name: name.to_owned(), suggestion: nearest(name, known).map(str::to_owned) }
    }

    fn deeper(
        &mut self,
        inner: impl FnOnce(&mut Self) -> Result<(), FormulaError>,
    ) -> Result<(), FormulaError> {
        self.depth += 1;
        if self.depth > MOST_DEPTH {
            return Err(FormulaError::TooDeep);
        }
        inner(self)?;
        self.depth -= 1;
        Ok(())
    }

    fn take_any(&mut self, symbols: &[char]) -> Option<char> {
        match self.tokens.get(self.at).map(|t| &t.kind) {
            Some(TokenKind::Symbol(c)) if symbols.contains(c) => {
                self.at += 1;
                Some(*c)
            }
            _ => None,
        }
    }

    fn need(&mut self, symbol: char, shown: &'static str) -> Result<(), FormulaError> {
        self.take_any(&[symbol]).map(drop).ok_or_else(|| self.expected(shown))
    }

    fn expected(&self, expected: &'static str) -> FormulaError {
        let (found, position) = match self.tokens.get(self.at) {
            None => ("the end of the formula".to_owned(), self.end),
            Some(Token { kind: TokenKind::Number(n), position }) => (format!("`{n}`"), *position),
            Some(Token { kind: TokenKind::Name(n), position }) => (format!("`{n}`"), *position),
            Some(Token { kind: TokenKind::Symbol(c), position }) => (format!("`{c}`"), *position),
        };
        FormulaError::Expected { expected, found, position }
    }
}

/// Squares are by far the most common powers, and a product is cheaper.
fn power(base: f64, exponent: f64) -> f64 {
    // Exactly two, as it was written.
    #[allow(clippy::float_cmp, reason = "a number of the formula, not the outcome of a sum")]
    if exponent == 2.0 { base * base } else { base.powf(exponent) }
}
