//! A table in columns of text, made to fit a width.
//!
//! A table that is too wide gives way step by step: headings break into lines, bars shorten and then go (they repeat a number), words
//! wrap; what still does not fit stands row by row, a line for each cell.

use crate::page::{Cell, PageColumn, Table};

use super::TextStyle;
use super::layout::{bar, length, padded, wrapped};

/// Columns of the longest bar, and of one in a narrow table.
const BAR: usize = 24;
const SHORTEST_BAR: usize = 6;
/// Blanks between columns.
const GAP: usize = 2;
/// A column of words is not made narrower than this.
const NARROWEST: usize = 12;

/// The cells that are shown, with the widths of their columns.
pub(super) struct Grid<'a> {
    columns: Vec<&'a PageColumn>,
    rows: Vec<Vec<Option<&'a Cell>>>,
    header: bool,
    widths: Vec<usize>,
}

impl<'a> Grid<'a> {
    /// The first `shown` rows of a table, details only when `verbose`, within `room` columns.
    pub(super) fn lines(
        table: &'a Table,
        shown: usize,
        verbose: bool,
        room: usize,
        style: TextStyle,
    ) -> Vec<String> {
        let mut kept: Vec<usize> =
            (0..table.columns.len()).filter(|&k| verbose || !table.columns[k].detail).collect();
        let grid = Self::of(table, shown, &kept);
        if let Some(fitted) = grid.fitted(room) {
            return fitted.drawn(style);
        }
        kept.retain(|&k| !table.rows.iter().any(|row| matches!(row.get(k), Some(Cell::Bar { .. }))));
        let grid = Self::of(table, shown, &kept);
        match grid.fitted(room) {
            Some(fitted) => fitted.drawn(style),
            None => Self::of(table, shown, &kept).stacked(room),
        }
    }

    fn of(table: &'a Table, shown: usize, kept: &[usize]) -> Self {
        let cells = |row: &'a Vec<Cell>| kept.iter().map(|&k| row.get(k)).collect();
        let mut grid = Self {
            columns: kept.iter().map(|&k| &table.columns[k]).collect(),
            rows: table.rows[..shown].iter().map(cells).collect(),
            header: table.has_header(),
            widths: Vec::new(),
        };
        grid.widths = (0..kept.len()).map(|k| grid.natural(k)).collect();
        grid
    }

    /// Width of the longest cell of a column.
    fn content(&self, column: usize) -> usize {
        let width = |row: &Vec<Option<&Cell>>| match row[column] {
            Some(Cell::Text(text)) => length(text),
            Some(Cell::Bar { .. }) => BAR,
            None => 0,
        };
        self.rows.iter().map(width).max().unwrap_or(0)
    }

    fn natural(&self, column: usize) -> usize {
        let heading = if self.header { length(&self.columns[column].title) } else { 0 };
        self.content(column).max(heading)
    }

    fn holds_bars(&self, column: usize) -> bool {
        self.rows.iter().any(|row| matches!(row[column], Some(Cell::Bar { .. })))
    }

    /// The narrowest a column can be.
    fn least(&self, column: usize) -> usize {
        let heading = longest_word(&self.columns[column].title);
        match (self.holds_bars(column), self.columns[column].words) {
            (true, _) => SHORTEST_BAR,
            (_, true) => self.natural(column).min(NARROWEST).max(heading).max(self.longest_piece(column)),
            _ => self.content(column).max(heading),
        }
    }

    /// Length of the longest part of a cell that does not break.
    fn longest_piece(&self, column: usize) -> usize {
        let cells = self.rows.iter().filter_map(|row| row[column].map(Cell::text));
        cells.map(|text| longest_word(&breakable(text, 0))).max().unwrap_or(0)
    }

    fn total(&self) -> usize {
        self.widths.iter().map(|w| w + GAP).sum::<usize>().saturating_sub(GAP)
    }

    /// The grid within so many columns, if it can be: numbers give way first, then bars, then the widest words.
    fn fitted(mut self, room: usize) -> Option<Self> {
        let all = 0..self.columns.len();
        let numbers = |grid: &Self, k: usize| !grid.columns[k].words;
        for takes in [numbers, Self::holds_bars] {
            for k in all.clone().filter(|&k| takes(&self, k)).collect::<Vec<_>>() {
                let over = self.total().saturating_sub(room);
                self.widths[k] = self.widths[k].saturating_sub(over).max(self.least(k));
            }
        }
        while self.total() > room {
            let slack = |k: &usize| self.widths[*k].saturating_sub(self.least(*k));
            let widest = all.clone().filter(|k| slack(k) > 0).max_by_key(|&k| (self.widths[k], k))?;
            self.widths[widest] -= 1;
        }
        Some(self)
    }

    fn drawn(&self, style: TextStyle) -> Vec<String> {
        let titles = self.columns.iter().map(|c| Cell::Text(c.title.clone())).collect::<Vec<_>>();
        let header = titles.iter().map(Some).collect::<Vec<_>>();
        let heading = self.header.then(|| self.row(&header, style));
        heading.into_iter().chain(self.rows.iter().map(|row| self.row(row, style))).flatten().collect()
    }

    /// A row, of as many lines as its longest cell.
    fn row(&self, row: &[Option<&Cell>], style: TextStyle) -> Vec<String> {
        let cells: Vec<Vec<String>> =
            row.iter().enumerate().map(|(k, cell)| self.cell(k, *cell, style)).collect();
        let lines = cells.iter().map(Vec::len).max().unwrap_or(0).max(1);
        let line = |i: usize| {
            let part =
                |(k, cell): (usize, &Vec<String>)| cell.get(i).cloned().unwrap_or(" ".repeat(self.widths[k]));
            cells.iter().enumerate().map(part).collect::<Vec<_>>().join(&" ".repeat(GAP))
        };
        (0..lines).map(line).collect()
    }

    fn cell(&self, column: usize, cell: Option<&Cell>, style: TextStyle) -> Vec<String> {
        let (width, left) = (self.widths[column], self.columns[column].words);
        match cell {
            None => Vec::new(),
            Some(Cell::Text(text)) if length(text) <= width => vec![padded(text, width, left)],
            Some(Cell::Text(text)) => {
                wrapped(&breakable(text, width), width).iter().map(|line| padded(line, width, left)).collect()
            }
            Some(Cell::Bar { bar: share, mood, mark }) => {
                let bar = bar(*share, *mark, width.min(BAR));
                let gap = " ".repeat(width.saturating_sub(length(&bar)));
                vec![style.mood(*mood, &bar) + &gap]
            }
        }
    }

    /// Row by row: the first cell, then a line for each other one.
    fn stacked(&self, room: usize) -> Vec<String> {
        let mut lines = Vec::new();
        for row in &self.rows {
            for (k, cell) in row.iter().enumerate().filter_map(|(k, cell)| Some((k, (*cell)?))) {
                let title = &self.columns[k].title;
                let label = if k == 0 || title.is_empty() { String::new() } else { format!("{title}: ") };
                let blanks = if k == 0 { "" } else { "  " };
                let text = wrapped(&format!("{label}{}", cell.text()), room - blanks.len());
                lines.extend(text.iter().map(|line| format!("{blanks}{line}")));
            }
        }
        lines
    }
}

/// A text whose words longer than `width` may break behind a dot: names of parameters are long.
fn breakable(text: &str, width: usize) -> String {
    let word = |word: &str| {
        if length(word) > width { word.replace('.', ". ").trim_end().to_owned() } else { word.to_owned() }
    };
    text.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

fn longest_word(text: &str) -> usize {
    text.split_whitespace().map(length).max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(table: &Table, room: usize) -> Vec<String> {
        let lines = Grid::lines(table, table.rows.len(), false, room, TextStyle::default());
        assert!(lines.iter().all(|l| length(l) <= room), "{lines:#?}");
        lines
    }

    #[test]
    fn headings_break_before_words_do() {
        let columns =
            [PageColumn::words("model"), PageColumn::number("translation um"), PageColumn::number("x noise")];
        let table = Table::new(columns).rows([["springs alone", "0.65", "1.52"]]);
        let narrow = lines(&table, 34);
        assert_eq!(narrow[0].trim_end(), "model          translation       x");
        assert_eq!(narrow[1].trim_end(), "                        um   noise");
        assert_eq!(narrow[2].trim_end(), "springs alone         0.65    1.52");
    }

    #[test]
    fn bars_shorten_then_go() {
        let table = |n: usize| {
            let columns = [PageColumn::words("model"), PageColumn::number("x"), PageColumn::bars()];
            Table::new(columns).rows([["m".repeat(n).into(), "1.5".into(), Cell::bar(1.0)]])
        };
        assert!(lines(&table(12), 40)[1].ends_with(&"#".repeat(21)));
        assert!(!lines(&table(33), 40)[1].contains('#'));
    }

    #[test]
    fn a_long_name_breaks_behind_its_dot() {
        let table =
            Table::named(["parameter", "value"]).rows([["base-compliance.translation-x", "1.25 +- 0.5"]]);
        let narrow = lines(&table, 32);
        assert!(
            narrow[1].starts_with("base-compliance. ") && narrow[2].starts_with("translation-x "),
            "{narrow:?}"
        );
    }

    #[test]
    fn what_does_not_fit_stands_row_by_row() {
        let titles = ["model", "translation", "rotation", "temperature", "periodicity"];
        let table = Table::named(titles).rows([["springs", "1", "2", "3", "4"]]);
        let stacked = lines(&table, 24);
        assert_eq!(stacked[..2], ["springs", "  translation: 1"]);
    }
}
