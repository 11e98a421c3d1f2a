//! A campaign book as a table: what its charts show.

use hexbench_model::results::book::{CampaignBook, ChartPoint, ControlChart};
use hexbench_report::table::{DataColumn, Frame, TableValues};

/// One row per number and campaign.
pub(crate) fn frame(book: &CampaignBook) -> Frame {
    let rows: Vec<(&ControlChart, &ChartPoint)> =
        book.charts.iter().flat_map(|c| c.points.iter().map(move |p| (c, p))).collect();
    let texts = |of: &dyn Fn(&ControlChart, &ChartPoint) -> String| {
        TableValues::Texts(rows.iter().map(|(c, p)| of(c, p)).collect())
    };
    let numbers =
        |of: &dyn Fn(&ChartPoint) -> f64| TableValues::Numbers(rows.iter().map(|(_, p)| of(p)).collect());
    let campaign = |p: &ChartPoint| &book.campaigns[p.campaign - 1];
    let counted = TableValues::Integers(
        rows.iter().map(|(_, p)| i64::try_from(p.campaign).unwrap_or(i64::MAX)).collect(),
    );
    let alarms = rows.iter().map(|(_, p)| if p.alarm { "yes" } else { "no" }).collect();
    let date = |p: &ChartPoint| campaign(p).date.map(|d| d.to_string()).unwrap_or_default();
    let columns = [
        ("number", "", "what is followed", texts(&|c, _| c.name.clone())),
        ("campaign", "1", "number of the campaign, from one", counted),
        ("date", "", "its date; empty without", texts(&|_, p| date(p))),
        ("file", "", "its result", texts(&|_, p| campaign(p).file.clone())),
        ("unit", "", "unit of the numbers of the row", texts(&|c, _| c.unit.clone())),
        ("value", "", "value", numbers(&|p| p.value)),
        ("std", "", "standard uncertainty (k = 1)", numbers(&|p| p.std)),
        ("level", "", "level with the changes found", numbers(&|p| p.level)),
        ("band_low", "", "lower end of what noise allows about the first level", numbers(&|p| p.band[0])),
        ("band_high", "", "upper end of it", numbers(&|p| p.band[1])),
        ("alarm", "", "yes: at another level than the first campaigns", TableValues::Words(alarms)),
    ];
    let columns = columns.map(|(name, unit, meaning, values)| DataColumn::new(name, unit, meaning, values));
    Frame { format: "book-table/1", origin: Vec::new(), columns: columns.into() }
}
