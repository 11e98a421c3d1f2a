//! Limits as people read them.

use hexbench_report::{Section, Table};

/// What a row says of a limit.
pub trait LimitRow {
    /// Title, figure now, figure of the baseline, chance, what would be noticed.
    fn cells(&self) -> [String; 5];
}

/// A section with a row for each limit; none without limits.
pub fn section<T: LimitRow>(title: &str, limits: &[&T]) -> Option<Section> {
    let table = Table::named(["limit", "now", "baseline", "by chance", "would notice"]);
    (!limits.is_empty()).then(|| Section::new(title).table(table.rows(limits.iter().map(|l| l.cells()))))
}
