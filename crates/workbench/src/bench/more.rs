//! Readings taken later, appended to the measurements.

use hexbench_core::files::{campaign_to_csv, parse_hexapod, read_campaign_from};
use hexbench_core::{Dataset, Hexapod};

use super::files::{Files, shown};
use super::refusal::{Refusal, RefusalKind};
use crate::wire::FileText;

impl Files {
    /// The same machine and holdout file, with more measurements.
    ///
    /// # Errors
    /// [`Refusal`] for a file that cannot be read, or whose readings are of another kind.
    pub(super) fn with_more(self, readings: &FileText) -> Result<Self, Refusal> {
        let hexapod = parse_hexapod(&self.hexapod, &self.names[0])?;
        let read = |text: &str, name: &str| {
            read_campaign_from(&hexapod, text.as_bytes(), name).map(|reading| reading.dataset)
        };
        let (old, new) = (read(&self.data, &self.names[1])?, read(&readings.text, &shown(&readings.name))?);
        let data = joined(&hexapod, &old, &new).ok_or_else(|| of_another_kind(&shown(&readings.name)))?;
        Ok(Self { data, ..self })
    }
}

fn of_another_kind(name: &str) -> Refusal {
    let rule = format!(
        "{name} cannot be appended to the measurements: it lacks some of their columns, or measures something else"
    );
    Refusal::new(RefusalKind::Conflict, rule, "Complete the run sheet made for these measurements.")
}

/// One table of both; every reading that was there stays in its line, by blank lines where there was something else.
fn joined(hexapod: &Hexapod, old: &Dataset, new: &Dataset) -> Option<String> {
    let all = old.joined(new).filter(|all| all.columns == old.columns && !all.has_other_readings())?;
    let mut table = Vec::new();
    campaign_to_csv(&mut table, hexapod, &all).ok()?;
    let table = String::from_utf8(table).ok()?;
    let (header, rows) = table.split_once('\n')?;
    let mut text = format!("{header}\n");
    let mut at = 1;
    for (k, row) in rows.lines().enumerate() {
        let line = old.observations.get(k).map_or(0, |o| o.line);
        while at + 1 < line {
            text.push('\n');
            at += 1;
        }
        text.push_str(row);
        text.push('\n');
        at += 1;
    }
    Some(text)
}
