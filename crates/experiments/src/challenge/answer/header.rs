//! The columns of `predictions.csv`, and one line in them.

use hexbench_core::Measurand;
use hexbench_core::files::instead_of;

use super::AnswerFault;
use crate::challenge::folder::PREDICTIONS;

/// What is predicted for one row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Predicted {
    /// m and rad.
    pub value: [f64; 6],
    /// Standard uncertainty, m and rad, when stated.
    pub sigma: Option<[f64; 6]>,
}

/// A meter or a radian of deflection, ten meters or a full turn of pose: beyond, the unit is wrong. In units of the columns.
const LARGEST: [f64; 2] = [1e6, 1e4];

/// Names of the value columns and of those of their uncertainty.
pub fn columns(measurand: Measurand) -> [[String; 6]; 2] {
    const SMALL: [&str; 2] = ["um", "urad"];
    let names = measurand.names();
    let (prefix, units) =
        if measurand == Measurand::AbsolutePose { ("predicted_", ["mm", "deg"]) } else { ("", SMALL) };
    let six = |prefix: &str, [translation, rotation]: [&str; 2]| {
        std::array::from_fn(|k| {
            format!("{prefix}{}_{}", names[k], if k < 3 { translation } else { rotation })
        })
    };
    [six(prefix, units), six("sigma_", SMALL)]
}

const MICRO: f64 = 1e-6;
/// Rows that are taken where nobody says how many there are.
const MOST_ROWS: usize = 100_000;

fn to_si(measurand: Measurand, k: usize) -> f64 {
    match (measurand, k < 3) {
        (Measurand::AbsolutePose, true) => 1e-3,
        (Measurand::AbsolutePose, false) => 1f64.to_radians(),
        _ => MICRO,
    }
}

/// Faults of one file that are told; a file that is another thing altogether has one in every line.
pub(super) const MOST_FAULTS: usize = 100;

pub(super) fn example(measurand: Measurand) -> String {
    format!("Begin with the line: row,{}", columns(measurand)[0].join(","))
}

/// Which cell holds what.
pub(super) struct Header {
    names: Vec<String>,
    row: usize,
    value: [usize; 6],
    sigma: Option<[usize; 6]>,
    measurand: Measurand,
}

impl Header {
    pub(super) fn read(line: &str, measurand: Measurand) -> Result<Self, Vec<AnswerFault>> {
        let names: Vec<String> = line.split(',').map(|name| name.trim().to_owned()).collect();
        let [values, sigmas] = columns(measurand);
        let mut faults = Vec::new();
        let mut fault = |column: Option<usize>, rule: String, next: String| {
            let place = column.map_or("line 1".to_owned(), |k| format!("line 1, column {}", k + 1));
            faults.push(AnswerFault::new(PREDICTIONS, &place, &rule).then(next));
        };
        let known: Vec<&str> =
            std::iter::once("row").chain(values.iter().chain(&sigmas).map(String::as_str)).collect();
        for (k, name) in names.iter().enumerate().take(MOST_FAULTS) {
            if !known.contains(&name.as_str()) {
                let rule =
                    format!("unknown column \"{}\"; the columns are row,{}", shown(name), values.join(","));
                fault(Some(k), rule, instead_of(name, &known));
            }
            if names[..k].contains(name) {
                fault(
                    Some(k),
                    format!("the column {} is there twice", shown(name)),
                    "Keep one of them.".to_owned(),
                );
            }
        }
        let place = |wanted: &str| names.iter().position(|name| name == wanted);
        let has_sigma = sigmas.iter().any(|name| place(name).is_some());
        let needed = std::iter::once("row").chain(values.iter().map(String::as_str));
        for wanted in needed.chain(sigmas.iter().filter(|_| has_sigma).map(String::as_str)) {
            if place(wanted).is_none() {
                let next = if sigmas.iter().any(|name| name == wanted) {
                    "Write all six standard uncertainties, or none.".to_owned()
                } else {
                    example(measurand)
                };
                fault(None, format!("the column {wanted} is missing"), next);
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let six = |wanted: &[String; 6]| std::array::from_fn(|k| place(&wanted[k]).unwrap_or(0));
        Ok(Self {
            row: place("row").unwrap_or(0),
            value: six(&values),
            sigma: has_sigma.then(|| six(&sigmas)),
            measurand,
            names,
        })
    }

    /// Index of the row, from 0, and what is predicted for it; else everything that is wrong with the line.
    pub(super) fn row(
        &self,
        number: usize,
        line: &str,
        rows: Option<usize>,
    ) -> Result<(usize, Predicted), Vec<AnswerFault>> {
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        let at_line = format!("line {number}");
        if cells.len() != self.names.len() {
            let rule = format!("the row has {} cells, the header {}", cells.len(), self.names.len());
            let next = "Write one number for each column, with a decimal point.";
            return Err(vec![AnswerFault::new(PREDICTIONS, &at_line, &rule).then(next)]);
        }
        let mut faults = Vec::new();
        let last = rows.unwrap_or(MOST_ROWS);
        let row = cells[self.row].parse::<usize>().ok().filter(|n| (1..=last).contains(n));
        if row.is_none() {
            let rule =
                format!("\"{}\" is no row of predict.csv; they are 1 to {last}", shown(cells[self.row]));
            faults.push(
                AnswerFault::new(PREDICTIONS, &at_line, &rule)
                    .then("Write the number in the column row of predict.csv."),
            );
        }
        let mut number =
            |place: usize, rule: &dyn Fn(f64) -> bool| match self.number(&at_line, &cells, place, rule) {
                Ok(number) => number,
                Err(fault) => {
                    faults.push(fault);
                    f64::NAN
                }
            };
        let mut value = [0.0; 6];
        for (k, v) in value.iter_mut().enumerate() {
            *v = number(self.value[k], &|x| x.abs() <= self.largest()) * to_si(self.measurand, k);
        }
        let mut sigma = self.sigma.map(|_| [0.0; 6]);
        if let (Some(places), Some(sigma)) = (self.sigma, &mut sigma) {
            for (s, place) in sigma.iter_mut().zip(places) {
                *s = number(place, &|x| x > 0.0 && x <= LARGEST[0]) * MICRO;
            }
        }
        match row {
            Some(row) if faults.is_empty() => Ok((row - 1, Predicted { value, sigma })),
            _ => Err(faults),
        }
    }

    fn largest(&self) -> f64 {
        LARGEST[usize::from(self.measurand == Measurand::AbsolutePose)]
    }

    fn number(
        &self,
        at_line: &str,
        cells: &[&str],
        place: usize,
        rule: &dyn Fn(f64) -> bool,
    ) -> Result<f64, AnswerFault> {
        let fault = |rule: &str, next: &str| {
            let at = format!("{at_line}, column {} ({})", place + 1, self.names[place]);
            AnswerFault::new(PREDICTIONS, &at, &format!("\"{}\": {rule}", shown(cells[place]))).then(next)
        };
        let number: f64 = cells[place].parse().map_err(|_| {
            fault("this is not a number", "Write a number with a decimal point, without unit.")
        })?;
        if !number.is_finite() {
            return Err(fault(
                "NaN and infinity are not predictions",
                "Predict something: zero, if nothing is known.",
            ));
        }
        if !rule(number) {
            let is_sigma = self.names[place].starts_with("sigma_");
            return Err(if is_sigma {
                let rule = "a standard uncertainty is positive, and below a metre";
                fault(rule, "Write it in the unit of the column, or leave all six columns out.")
            } else {
                let next = "Write it in the unit that the name of the column ends with.";
                fault("the number is too large; probably the unit is wrong", next)
            });
        }
        Ok(number)
    }
}

/// Text from outside, short enough for a message.
fn shown(text: &str) -> String {
    const MOST: usize = 40;
    text.chars().take(MOST).map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}
