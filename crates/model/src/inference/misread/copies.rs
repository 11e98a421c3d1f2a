//! Rows that are copies of others: they make repeats agree that were never read.

use std::collections::HashMap;

use hexbench_core::{Dataset, Observation};

use crate::inference::examination::{Finding, FindingKind};

/// Fewer rows may be alike by chance, where readings are rounded.
const FEWEST: usize = 2;
/// Rows of fewer numbers are not compared.
const LEAST_NUMBERS: usize = 3;
/// Rounding alone may explain this share of the copies at most.
const ROUNDED_SHARE: f64 = 0.02;
/// Share of held-out readings that stand in the measurements, beyond which the file holds nothing out.
const SAME_FILE: f64 = 0.1;

/// Rows whose six numbers are those of an earlier row, digit by digit.
pub fn copies(data: &Dataset) -> Option<Finding> {
    let mut first: HashMap<[u64; 6], u64> = HashMap::new();
    let mut rows: Vec<(u64, u64)> = Vec::new();
    for row in data.observations.iter().filter(|o| says_something(o)) {
        match first.get(&digits(row)) {
            Some(&line) => rows.push((row.line, line)),
            None => {
                first.insert(digits(row), row.line);
            }
        }
    }
    let all = data.observations.len();
    if rows.len() < FEWEST || alike_by_rounding(data) > ROUNDED_SHARE * rows.len() as f64 {
        return None;
    }
    let (line, of) = rows[0];
    Some(Finding {
        rows: rows.iter().map(|(line, _)| *line).collect(),
        size: format!("{} of {all} rows", rows.len()),
        text: format!(
            "{} of {all} rows have the six numbers of an earlier row, digit for digit: line {line} those of line {of}; repeated readings \
             never agree like that",
            rows.len()
        ),
        next: "remove the copies from the file, or measure these conditions again".to_owned(),
        ..Finding::of(FindingKind::Copies)
    })
}

/// Held-out readings that are readings of the measurements too.
pub fn held_in(data: &Dataset, holdout: &Dataset) -> Option<Finding> {
    let known: HashMap<[u64; 6], u64> = data.observations.iter().map(|o| (digits(o), o.line)).collect();
    let same = holdout.observations.iter().filter(|o| says_something(o) && known.contains_key(&digits(o)));
    let (same, all) = (same.count(), holdout.observations.len());
    (same as f64 > SAME_FILE * all as f64).then(|| Finding {
        size: format!("{same} of {all} rows"),
        text: format!(
            "{same} of {all} readings of the held-out file are readings of the measurements: it holds out nothing, so poses of the \
             measurements are left out in turn instead"
        ),
        next: "use readings at other poses, which no fit has seen, as the holdout file".to_owned(),
        ..Finding::of(FindingKind::Holdout)
    })
}

fn digits(row: &Observation) -> [u64; 6] {
    row.measured.map(|x| (x + 0.0).to_bits())
}

fn says_something(row: &Observation) -> bool {
    // Few numbers agree by chance.
    row.numbers() >= LEAST_NUMBERS && row.measured.iter().any(|x| *x != 0.0)
}

/// Readings of one condition that are alike by their rounding alone: pairs of neighbors, times the chance that six numbers agree when
/// single ones agree as often as they do.
fn alike_by_rounding(data: &Dataset) -> f64 {
    let same_condition = |a: &Observation, b: &Observation| {
        a.pose == b.pose && a.wrench == b.wrench && a.reference == b.reference
    };
    let (mut pairs, mut agree) = (0.0, 0.0);
    for pair in data.observations.windows(2).filter(|p| same_condition(&p[0], &p[1])) {
        let (a, b) = (digits(&pair[0]), digits(&pair[1]));
        if a != b {
            pairs += 1.0;
            agree += (0..6).filter(|&k| a[k] == b[k]).count() as f64;
        }
    }
    if pairs == 0.0 { 0.0 } else { pairs * (agree / (6.0 * pairs)).powi(6) }
}

#[cfg(test)]
mod tests {
    use hexbench_core::Measurand;

    use super::*;
    use crate::test_machine::readings;

    #[test]
    fn a_tenth_of_the_held_out_readings_may_be_known() {
        let (_, data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        for (known, is_told) in [(2, false), (3, true)] {
            let mut held = Dataset { observations: vec![data.observations[0]; 20], ..data.clone() };
            for (row, off) in held.observations[known..].iter_mut().zip(1_u8..) {
                row.measured[0] += 1e-3 * f64::from(off);
            }
            assert_eq!(held_in(&data, &held).is_some(), is_told, "{known} of 20");
        }
    }

    #[test]
    fn rows_are_copies_where_rounding_does_not_make_readings_agree() {
        let (_, data) = readings(Measurand::DeflectionRotationVector, Vec::new());
        // Eleven readings of one condition that have so many numbers of the one before, then the first two again.
        let told = |agreeing: [usize; 2]| {
            let mut rows = vec![data.observations[0]; 11];
            for i in 1..11 {
                let alike = agreeing[i % 2];
                let before = rows[i - 1].measured;
                rows[i].measured =
                    std::array::from_fn(|k| if k < alike { before[k] } else { 1e-6 * (7 * i + k) as f64 });
            }
            rows.extend([rows[0], rows[1]]);
            copies(&Dataset { observations: rows, ..data.clone() })
        };
        // Of 12 pairs of neighbors, by the sixth power of their chance: 0.06 and 0.0003 rows for two copies.
        assert!(told([2, 3]).is_none() && told([1, 1]).is_some());
    }
}
