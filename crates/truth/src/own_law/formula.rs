//! Formulas of the simulated world: the operator-precedence method (Dijkstra's shunting yard, 1961) puts words into the order in which a
//! stack works them off.
//!
//! The grammar is that of formulas of term files, read here a second time by another method: what makes the truth shares nothing with
//! what explains it. Units are factors of numbers, not checked: `8 mm` is `8 * 1e-3`.

use std::fmt;

/// Longest formula, in characters.
const MOST_CHARACTERS: usize = 2000;

/// Units behind a number, each in SI.
const UNITS: [(&str, f64); 13] = [
    ("m", 1.0),
    ("mm", 1e-3),
    ("um", 1e-6),
    ("nm", 1e-9),
    ("N", 1.0),
    ("kN", 1e3),
    ("K", 1.0),
    ("s", 1.0),
    ("min", 60.0),
    ("rad", 1.0),
    ("mrad", 1e-3),
    ("urad", 1e-6),
    ("deg", std::f64::consts::PI / 180.0),
];
const CONSTANTS: [(&str, f64); 2] = [("pi", std::f64::consts::PI), ("tau", std::f64::consts::TAU)];

type OfOne = fn(f64) -> f64;
type OfTwo = fn(f64, f64) -> f64;

const FUNCTIONS: [(&str, OfOne); 17] = [
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
const FUNCTIONS_OF_TWO: [(&str, OfTwo); 4] =
    [("min", f64::min), ("max", f64::max), ("atan2", f64::atan2), ("hypot", f64::hypot)];

/// A formula, ready to be worked off.
#[derive(Clone)]
pub struct LawFormula {
    text: String,
    steps: Vec<Step>,
}

#[derive(Clone, Copy)]
enum Step {
    Number(f64),
    Variable(usize),
    One(OfOne),
    Two(OfTwo),
}

impl fmt::Debug for LawFormula {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.text.fmt(out)
    }
}

impl PartialEq for LawFormula {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

/// What waits for its right side.
#[derive(Clone, Copy)]
enum Waiting {
    Parenthesis,
    Sign,
    Operator(char),
    Function(OfOne),
    FunctionOfTwo { of: OfTwo, has_both: bool },
}

impl LawFormula {
    /// Reads a formula in these variables.
    ///
    /// # Errors
    /// What is wrong, with the place of the character from 1.
    pub fn new(text: &str, variables: &[&str]) -> Result<Self, String> {
        if text.chars().count() > MOST_CHARACTERS {
            return Err(format!("a formula has at most {MOST_CHARACTERS} characters"));
        }
        let steps = Yard { variables, steps: Vec::new(), waiting: Vec::new(), at: 1 }.worked_off(text)?;
        Ok(Self { text: text.to_owned(), steps })
    }

    /// Its value for the values of the variables, in their order.
    pub fn value(&self, variables: &[f64]) -> f64 {
        let mut stack: Vec<f64> = Vec::with_capacity(8);
        for step in &self.steps {
            let right = match *step {
                Step::Number(number) => number,
                Step::Variable(k) => variables[k],
                Step::One(of) => of(stack.pop().unwrap_or(f64::NAN)),
                Step::Two(of) => {
                    let right = stack.pop().unwrap_or(f64::NAN);
                    of(stack.pop().unwrap_or(f64::NAN), right)
                }
            };
            stack.push(right);
        }
        stack.pop().unwrap_or(f64::NAN)
    }
}

/// Words that have come, and operators that wait for those to come.
struct Yard<'a> {
    variables: &'a [&'a str],
    steps: Vec<Step>,
    waiting: Vec<Waiting>,
    at: usize,
}

impl Yard<'_> {
    fn worked_off(mut self, text: &str) -> Result<Vec<Step>, String> {
        let characters: Vec<char> = text.chars().collect();
        let mut place = 0;
        // True where a number, a name or a parenthesis has to come.
        let mut wants_value = true;
        while place < characters.len() {
            self.at = place + 1;
            let rest = &characters[place..];
            place += match rest[0] {
                c if c.is_whitespace() => 1,
                '0'..='9' | '.' if wants_value => {
                    wants_value = false;
                    self.number(rest)?
                }
                'a'..='z' | 'A'..='Z' | '_' if wants_value => {
                    let (length, is_value) = self.name(rest)?;
                    wants_value = !is_value;
                    length
                }
                'a'..='z' | 'A'..='Z' | '_' => {
                    self.unit(rest)?;
                    word_length(rest)
                }
                '(' if wants_value => {
                    self.waiting.push(Waiting::Parenthesis);
                    1
                }
                ')' if !wants_value => {
                    self.close()?;
                    1
                }
                ',' if !wants_value => {
                    wants_value = true;
                    self.comma()?;
                    1
                }
                '-' if wants_value => {
                    self.waiting.push(Waiting::Sign);
                    1
                }
                '+' if wants_value => 1,
                symbol @ ('+' | '-' | '*' | '/' | '^') if !wants_value => {
                    wants_value = true;
                    self.operator(symbol);
                    1
                }
                other => {
                    return Err(format!("character {} is `{other}`, which does not belong there", self.at));
                }
            };
        }
        if wants_value {
            return Err("the formula ends where a number or a name is expected".to_owned());
        }
        self.end()
    }

    fn number(&mut self, rest: &[char]) -> Result<usize, String> {
        let digits =
            |from: usize| rest[from..].iter().take_while(|c| c.is_ascii_digit() || **c == '.').count();
        let mut length = digits(0);
        if matches!(rest.get(length), Some('e' | 'E')) {
            let sign = usize::from(matches!(rest.get(length + 1), Some('+' | '-')));
            let exponent = digits(length + 1 + sign);
            length += if exponent > 0 { 1 + sign + exponent } else { 0 };
        }
        let word: String = rest[..length].iter().collect();
        let number =
            word.parse().map_err(|_| format!("`{word}` at character {} is not a number", self.at))?;
        self.steps.push(Step::Number(number));
        Ok(length)
    }

    /// A variable or constant, or a function with its parenthesis; how many characters, and whether a value stands there now.
    fn name(&mut self, rest: &[char]) -> Result<(usize, bool), String> {
        let length = word_length(rest);
        let word: String = rest[..length].iter().collect();
        if let Some(k) = self.variables.iter().position(|name| *name == word) {
            self.steps.push(Step::Variable(k));
            return Ok((length, true));
        }
        if let Some((_, value)) = CONSTANTS.iter().find(|(name, _)| *name == word) {
            self.steps.push(Step::Number(*value));
            return Ok((length, true));
        }
        let one = FUNCTIONS.iter().find(|(name, _)| *name == word).map(|(_, of)| Waiting::Function(*of));
        let two = FUNCTIONS_OF_TWO.iter().find(|(name, _)| *name == word);
        let two = two.map(|(_, of)| Waiting::FunctionOfTwo { of: *of, has_both: false });
        let Some(function) = one.or(two) else {
            let known = self.variables.join(", ");
            return Err(format!("`{word}` at character {} is unknown; variables are {known}", self.at));
        };
        let spaces = rest[length..].iter().take_while(|c| c.is_whitespace()).count();
        if rest.get(length + spaces) != Some(&'(') {
            return Err(format!("behind `{word}` at character {} a parenthesis is expected", self.at));
        }
        self.waiting.extend([function, Waiting::Parenthesis]);
        Ok((length + spaces + 1, false))
    }

    /// A unit behind a number: nothing binds tighter.
    fn unit(&mut self, rest: &[char]) -> Result<(), String> {
        let word: String = rest[..word_length(rest)].iter().collect();
        let factor = UNITS.iter().find(|(name, _)| *name == word).map(|(_, factor)| *factor);
        match (factor, self.steps.last_mut()) {
            (Some(factor), Some(Step::Number(number))) => {
                *number *= factor;
                Ok(())
            }
            _ => Err(format!(
                "between `{word}` at character {} and what stands before an operator is missing",
                self.at
            )),
        }
    }

    fn operator(&mut self, symbol: char) {
        let rank = rank(symbol);
        while let Some(waiting) = self.waiting.last() {
            let goes_first = match waiting {
                // A sign binds as a product does: -x^2 is -(x^2). Powers go from right to left.
                Waiting::Sign => rank <= self::rank('*'),
                Waiting::Operator(before) => {
                    self::rank(*before) > rank || (self::rank(*before) == rank && symbol != '^')
                }
                _ => false,
            };
            if !goes_first {
                break;
            }
            self.finish_one();
        }
        self.waiting.push(Waiting::Operator(symbol));
    }

    fn finish_one(&mut self) {
        let step = match self.waiting.pop() {
            Some(Waiting::Sign) => Step::One(|x| -x),
            Some(Waiting::Operator(symbol)) => Step::Two(operation(symbol)),
            _ => return,
        };
        self.steps.push(step);
    }

    fn back_to_parenthesis(&mut self) -> Result<(), String> {
        loop {
            match self.waiting.last() {
                Some(Waiting::Sign | Waiting::Operator(_)) => self.finish_one(),
                Some(Waiting::Parenthesis) => return Ok(()),
                _ => return Err(format!("character {} has no parenthesis that it belongs to", self.at)),
            }
        }
    }

    fn comma(&mut self) -> Result<(), String> {
        self.back_to_parenthesis()?;
        let function = self.waiting.len().checked_sub(2).map(|k| &mut self.waiting[k]);
        match function {
            Some(Waiting::FunctionOfTwo { has_both, .. }) if !*has_both => {
                *has_both = true;
                Ok(())
            }
            _ => Err(format!("the comma at character {} belongs to no function of two numbers", self.at)),
        }
    }

    fn close(&mut self) -> Result<(), String> {
        self.back_to_parenthesis()?;
        self.waiting.pop();
        match self.waiting.last().copied() {
            Some(Waiting::Function(of)) => {
                self.waiting.pop();
                self.steps.push(Step::One(of));
            }
            Some(Waiting::FunctionOfTwo { of, has_both }) => {
                if !has_both {
                    return Err(format!("the function that ends at character {} takes two numbers", self.at));
                }
                self.waiting.pop();
                self.steps.push(Step::Two(of));
            }
            _ => {}
        }
        Ok(())
    }

    fn end(mut self) -> Result<Vec<Step>, String> {
        while let Some(waiting) = self.waiting.last() {
            if matches!(waiting, Waiting::Parenthesis) {
                return Err("a parenthesis is not closed".to_owned());
            }
            self.finish_one();
        }
        Ok(self.steps)
    }
}

fn word_length(rest: &[char]) -> usize {
    rest.iter().take_while(|c| c.is_ascii_alphanumeric() || **c == '_').count()
}

fn rank(symbol: char) -> u8 {
    match symbol {
        '^' => 3,
        '*' | '/' => 2,
        _ => 1,
    }
}

fn operation(symbol: char) -> OfTwo {
    match symbol {
        '+' => |x, y| x + y,
        '-' => |x, y| x - y,
        '*' => |x, y| x * y,
        '/' => |x, y| x / y,
        _ => f64::powf,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> f64 {
        LawFormula::new(text, &["x", "y"]).unwrap_or_else(|why| panic!("{text}: {why}")).value(&[3.0, -2.0])
    }

    #[test]
    fn formulas_follow_the_rules_of_school() {
        let all = [
            ("1 + 2*3", 7.0),
            ("(1 + 2)*3", 9.0),
            ("8 - 3 - 2", 3.0),
            ("16/4/2", 2.0),
            ("-x^2", -9.0),
            ("2^3^2", 512.0),
            ("2^-1", 0.5),
            ("-2*-x", 6.0),
            ("+x - -y", 1.0),
            ("x*y^2", 12.0),
            ("abs(y)*sign(y)", -2.0),
            ("max(x, y) - min(x, y)", 5.0),
            ("hypot(x + 1, abs(y) + 1)", 5.0),
            ("atan2(0, -1)", std::f64::consts::PI),
            ("1.5e-3", 1.5e-3),
            ("8 mm", 8e-3),
            ("2 min * x", 360.0),
            ("sin(2*pi*x/(8 mm))", (std::f64::consts::TAU * 3.0 / 8e-3).sin()),
            ("step(x) + step(y) + step(0)", 1.0),
            ("sqrt(16) + cbrt(27)", 7.0),
        ];
        for (text, expected) in all {
            assert!((value(text) - expected).abs() <= 1e-14 * expected.abs(), "{text} = {}", value(text));
        }
    }

    #[test]
    fn what_is_no_formula_is_told_with_its_place() {
        let all = [
            ("", "ends where"),
            ("1 +", "ends where"),
            ("1 + * 2", "character 5 is `*`"),
            ("(1", "not closed"),
            ("1)", "character 2 has no parenthesis"),
            ("z", "`z` at character 1 is unknown; variables are x, y"),
            ("sin x", "a parenthesis is expected"),
            ("min(x)", "takes two numbers"),
            ("min(x, y, x)", "belongs to no function of two"),
            ("sin(x, y)", "belongs to no function of two"),
            ("x y", "an operator is missing"),
            ("1.2.3", "not a number"),
            ("x # y", "`#`"),
        ];
        for (text, part) in all {
            let why = LawFormula::new(text, &["x", "y"]).unwrap_err();
            assert!(why.contains(part), "{text}: {why}");
        }
    }
}
