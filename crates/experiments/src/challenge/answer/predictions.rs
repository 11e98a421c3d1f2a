//! `predictions.csv`: one row for each of `predict.csv`.

use std::collections::BTreeMap;

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

/// A metre or a radian of deflection, ten metres or a full turn of pose: beyond, the unit is wrong. In units of the columns.
const LARGEST: [f64; 2] = [1e6, 1e4];

/// Names of the value columns and of those of their uncertainty.
pub fn columns(measurand: Measurand) -> [[String; 6]; 2] {
    const EULER: [&str; 6] = ["da", "db", "dc", "dalpha", "dbeta", "dgamma"];
    const ROTATION_VECTOR: [&str; 6] = ["da", "db", "dc", "drx", "dry", "drz"];
    const POSE: [&str; 6] = ["a", "b", "c", "alpha", "beta", "gamma"];
    const SMALL: [&str; 2] = ["um", "urad"];
    let (names, prefix, units) = match measurand {
        Measurand::DeflectionEuler => (EULER, "", SMALL),
        Measurand::DeflectionRotationVector => (ROTATION_VECTOR, "", SMALL),
        Measurand::AbsolutePose => (POSE, "predicted_", ["mm", "deg"]),
    };
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
const MOST_FAULTS: usize = 100;

/// The predictions, or everything that is wrong with them. Without a number of rows, that of the last row there is.
pub(super) fn read(
    text: &str,
    rows: Option<usize>,
    measurand: Measurand,
) -> Result<Vec<Predicted>, Vec<AnswerFault>> {
    let mut lines =
        (1..).zip(text.trim_start_matches('\u{feff}').lines()).filter(|(_, l)| !l.trim().is_empty());
    let Some((_, first)) = lines.next() else {
        return Err(vec![AnswerFault::new(PREDICTIONS, "", "the file is empty").then(example(measurand))]);
    };
    let header = Header::read(first, measurand)?;
    let (mut found, mut faults): (BTreeMap<usize, Predicted>, _) = (BTreeMap::new(), Vec::new());
    for (number, line) in lines {
        match header.row(number, line, rows) {
            Ok((row, predicted)) => {
                if found.insert(row, predicted).is_some() {
                    let rule = format!("row {} is predicted twice", row + 1);
                    let fault = AnswerFault::new(PREDICTIONS, &format!("line {number}"), &rule);
                    faults.push(fault.then("Keep one of them."));
                }
            }
            Err(of_line) => faults.extend(of_line),
        }
        if faults.len() >= MOST_FAULTS {
            return Err(faults);
        }
    }
    let rows = rows.unwrap_or_else(|| found.keys().last().map_or(1, |last| last + 1));
    if let (Some(row), true) = ((0..rows).find(|row| !found.contains_key(row)), faults.is_empty()) {
        let rule = format!("{} of {rows} rows are missing, the first is row {}", rows - found.len(), row + 1);
        let next = "Write one row for each row of predict.csv, with its number.";
        faults.push(AnswerFault::new(PREDICTIONS, "", &rule).then(next));
    }
    if faults.is_empty() { Ok(found.into_values().collect()) } else { Err(faults) }
}

fn example(measurand: Measurand) -> String {
    format!("Begin with the line: row,{}", columns(measurand)[0].join(","))
}

/// Which cell holds what.
struct Header {
    names: Vec<String>,
    row: usize,
    value: [usize; 6],
    sigma: Option<[usize; 6]>,
    measurand: Measurand,
}

impl Header {
    fn read(line: &str, measurand: Measurand) -> Result<Self, Vec<AnswerFault>> {
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
    fn row(
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

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "row,da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";

    fn in_micro(si: f64) -> i64 {
        format!("{:.0}", si * 1e6).parse().unwrap()
    }

    fn of(text: &str) -> Result<Vec<Predicted>, Vec<AnswerFault>> {
        read(text, Some(2), Measurand::DeflectionEuler)
    }

    #[test]
    fn rows_come_in_any_order_and_columns_too() {
        let found = of(&format!("{HEADER}\n2,1,2,3,4,5,6\r\n1,7,8,9,10,11,12\n\n")).unwrap();
        assert_eq!(found[0].value.map(in_micro), [7, 8, 9, 10, 11, 12]);
        let turned = "dgamma_urad,dbeta_urad,dalpha_urad,dc_um,db_um,da_um,row";
        let found = of(&format!("{turned}\n6,5,4,3,2,1,1\n6,5,4,3,2,1,2\n")).unwrap();
        assert_eq!(found[1].value.map(in_micro), [1, 2, 3, 4, 5, 6]);
    }

    #[test]
    fn poses_are_in_mm_and_deg_and_their_uncertainty_in_um_and_urad() {
        let [values, sigmas] = columns(Measurand::AbsolutePose);
        let text = format!("row,{},{}\n1,1,2,3,180,5,6,1,1,1,2,2,2\n", values.join(","), sigmas.join(","));
        let found = read(&text, Some(1), Measurand::AbsolutePose).unwrap()[0];
        assert!(
            (found.value[0] - 1e-3).abs() < 1e-15 && (found.value[3] - std::f64::consts::PI).abs() < 1e-15
        );
        assert!((found.sigma.unwrap()[5] - 2e-6).abs() < 1e-18);
    }

    #[test]
    fn every_fault_has_its_place() {
        let good = "1,1,2,3,4,5,6\n2,1,2,3,4,5,6\n";
        for (text, expected) in [
            (String::new(), "the file is empty"),
            (format!("{HEADER}\n"), "2 of 2 rows are missing, the first is row 1"),
            (format!("{HEADER}\n1,1,2,3,4,5,6\n"), "1 of 2 rows are missing, the first is row 2"),
            (format!("{HEADER}\n{good}1,1,2,3,4,5,6\n"), "line 4: row 1 is predicted twice"),
            (format!("{HEADER}\n{good}3,1,2,3,4,5,6\n"), "line 4: \"3\" is no row of predict.csv"),
            (format!("{HEADER}\n1,1,2\n"), "line 2: the row has 3 cells, the header 7"),
            (format!("{HEADER}\n1,1,nan,3,4,5,6\n"), "line 2, column 3 (db_um): \"nan\": NaN"),
            (format!("{HEADER}\n1,1,2,inf,4,5,6\n"), "line 2, column 4 (dc_um): \"inf\": NaN and infinity"),
            (format!("{HEADER}\n1,1,x,3,4,5,6\n"), "\"x\": this is not a number"),
            (format!("{HEADER}\n1,1,2,3,4,5,1e300\n"), "(dgamma_urad): \"1e300\": the number is too large"),
            (format!("{HEADER},sigma_da_um\n{good}"), "the column sigma_db_um is missing"),
            (good.to_owned(), "unknown column \"1\""),
            (HEADER.replace("dc_um", "db_um"), "the column db_um is there twice"),
            (HEADER.replace(",dc_um", ""), "the column dc_um is missing"),
        ] {
            let found = of(&text).unwrap_err()[0].to_string();
            assert!(found.starts_with(PREDICTIONS) && found.contains(expected), "{text}: {found}");
        }
    }
}
