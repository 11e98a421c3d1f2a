//! `predictions.csv`: one row for each of `predict.csv`.

use std::collections::BTreeMap;

use hexbench_core::Measurand;

use super::AnswerFault;
use super::header::{Header, MOST_FAULTS, Predicted, example};
use crate::challenge::folder::PREDICTIONS;

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::challenge::answer::columns;

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
