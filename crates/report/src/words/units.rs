//! Lengths and angles: only those that are read are shown.

use crate::number::significant;

/// Units of a length and of an angle, as pages write them.
const UNITS: [&str; 2] = ["um", "urad"];

/// `0.30 um and 3.1 urad`: a length in um and an angle in urad, each where there is one.
pub(super) fn both(levels: [Option<f64>; 2], digits: i32) -> String {
    let one = |(level, unit): (Option<f64>, &str)| Some(format!("{} {unit}", significant(level?, digits)));
    levels.into_iter().zip(UNITS).filter_map(one).collect::<Vec<_>>().join(" and ")
}

/// Which columns a table of lengths and angles has.
#[derive(Clone, Copy)]
pub(super) struct UnitsRead([bool; 2]);

impl UnitsRead {
    /// Those of which some row has a value.
    pub(super) fn of(rows: impl IntoIterator<Item = [Option<f64>; 2]>) -> Self {
        Self(rows.into_iter().fold([false; 2], |[a, b], [x, y]| [a || x.is_some(), b || y.is_some()]))
    }

    /// Of two things, of lengths and of angles, those that are shown.
    pub(super) fn of_both<T>(self, both: [T; 2]) -> impl Iterator<Item = T> {
        both.into_iter().zip(self.0).filter_map(|(x, is_read)| is_read.then_some(x))
    }

    /// The values of a row, a dash where it has none.
    pub(super) fn values(self, row: [Option<f64>; 2]) -> impl Iterator<Item = String> {
        self.of_both(row.map(|x| x.map_or("-".to_owned(), |x| significant(x, 3))))
    }
}
