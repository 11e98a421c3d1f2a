//! A table of measurements as cells.

/// Names and rows of a file with commas.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Table {
    pub(super) names: Vec<String>,
    pub(super) rows: Vec<Vec<String>>,
}

fn cells(line: &str) -> Vec<String> {
    line.split(',').map(str::to_owned).collect()
}

impl Table {
    pub(super) fn of(text: &str) -> Self {
        let mut lines = text.lines();
        Self { names: cells(lines.next().unwrap()), rows: lines.map(cells).collect() }
    }

    pub(super) fn text(&self) -> String {
        let lines = std::iter::once(&self.names).chain(&self.rows);
        lines.map(|line| line.join(",") + "\n").collect()
    }

    pub(super) fn column(&self, name: &str) -> usize {
        self.names.iter().position(|other| other == name).unwrap_or_else(|| panic!("{name}"))
    }

    /// With another text in a cell.
    pub(super) fn with(&self, row: usize, column: usize, text: &str) -> Self {
        let mut table = self.clone();
        text.clone_into(&mut table.rows[row][column]);
        table
    }

    /// With columns of numbers multiplied.
    pub(super) fn scaled(&self, names: &[&str], factor: f64) -> Self {
        let mut table = self.clone();
        for column in names.iter().map(|name| self.column(name)) {
            table.rows.iter_mut().for_each(|row| row[column] = (number(&row[column]) * factor).to_string());
        }
        table
    }

    /// With the columns of each group exchanged and reversed: number k becomes sign k times number `order[k]`.
    pub(super) fn turned(&self, groups: &[[&str; 3]], order: [usize; 3], signs: [f64; 3]) -> Self {
        let mut table = self.clone();
        for group in groups {
            let columns = group.map(|name| self.column(name));
            for (row, old) in table.rows.iter_mut().zip(&self.rows) {
                for k in 0..3 {
                    row[columns[k]] = (signs[k] * number(&old[columns[order[k]]])).to_string();
                }
            }
        }
        table
    }

    /// True where nothing is wrong that a reader could see: the names of the other, as many cells in every row, and numbers in them.
    pub(super) fn is_sound_beside(&self, other: &Self) -> bool {
        let is_number = |cell: &String| cell.trim().parse::<f64>().is_ok_and(f64::is_finite);
        self.names == other.names
            && self.rows.iter().all(|row| row.len() == self.names.len() && row.iter().all(is_number))
    }
}

pub(super) fn number(cell: &str) -> f64 {
    cell.parse().unwrap()
}
