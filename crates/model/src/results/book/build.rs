//! A book of campaigns.

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, Normal};

use super::change::tests;
use super::charts::{ControlChart, followed};
use super::day::CampaignDay;
use super::warnings::warnings;
use crate::inference::verdict::Verdict;
use crate::results::runs::{Incompatible, Run, same_subject};

/// Chance that a book of a machine that does not change has any alarm.
pub const FALSE_ALARM: f64 = 0.01;
/// Campaigns without which there is no chart.
pub const FEWEST_CAMPAIGNS: usize = 3;

/// A result, and when its readings were taken.
#[derive(Debug, Clone)]
pub struct DatedRun {
    /// The result.
    pub run: Run,
    /// The day; campaigns without one stand in the order given.
    pub day: Option<CampaignDay>,
}

/// One campaign of a book.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BookCampaign {
    /// Its file.
    pub file: String,
    /// Its day.
    pub date: Option<CampaignDay>,
    /// Days since the first campaign; its number, from one, where the book has no dates.
    pub place: f64,
    /// Answer of a diagnosis.
    pub verdict: Option<Verdict>,
    /// Effects named, or terms of the fit.
    pub added: Vec<String>,
}

/// When a chart alarms.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct BookRule {
    /// Chance of any alarm where nothing changed, at most.
    pub false_alarm: f64,
    /// Tests of all charts.
    pub tests: usize,
    /// Share of the chance of each test.
    pub chance_each: f64,
    /// Standard uncertainties beyond which a change alarms.
    pub sigmas: f64,
}

/// Control charts of one machine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CampaignBook {
    /// `book/1`.
    pub format: &'static str,
    /// Name of the machine; empty where no file says it.
    pub machine: String,
    /// The campaigns, the first first.
    pub campaigns: Vec<BookCampaign>,
    /// When a chart alarms.
    pub rule: BookRule,
    /// Stiffness of each leg, size of each effect, the error.
    pub charts: Vec<ControlChart>,
    /// What to know before reading the charts.
    pub warnings: Vec<String>,
}

impl CampaignBook {
    /// True when any chart alarms.
    pub fn is_alarmed(&self) -> bool {
        self.charts.iter().any(ControlChart::is_alarmed)
    }

    /// True when all campaigns have a date.
    pub fn is_dated(&self) -> bool {
        self.campaigns.iter().all(|c| c.date.is_some())
    }
}

impl BookRule {
    fn of(tests: usize) -> Self {
        let chance_each = FALSE_ALARM / tests.max(1) as f64;
        let sigmas = Normal::standard().inverse_cdf(1.0 - 0.5 * chance_each);
        Self { false_alarm: FALSE_ALARM, tests, chance_each, sigmas }
    }
}

/// Put campaigns of one machine into a book: by their dates where all have one, else in the order given.
///
/// # Errors
/// [`Incompatible`]: other machines, other kinds of readings or of results; fewer than [`FEWEST_CAMPAIGNS`].
pub fn book(mut campaigns: Vec<DatedRun>) -> Result<CampaignBook, Incompatible> {
    if campaigns.len() < FEWEST_CAMPAIGNS {
        return Err(Incompatible::Few { campaigns: campaigns.len(), fewest: FEWEST_CAMPAIGNS });
    }
    let is_dated = campaigns.iter().all(|c| c.day.is_some());
    if is_dated {
        campaigns.sort_by_key(|c| c.day);
    }
    let days: Vec<Option<CampaignDay>> = campaigns.iter().map(|c| c.day).collect();
    let runs: Vec<Run> = campaigns.into_iter().map(|c| c.run).collect();
    for run in &runs[1..] {
        same_subject(&runs[0], run)?;
    }
    let places: Vec<f64> = (0..runs.len())
        .map(|k| days[k].zip(days[0]).filter(|_| is_dated).map_or(k as f64 + 1.0, |(a, b)| a.days_after(b)))
        .collect();
    let all = followed(&runs, &places, FEWEST_CAMPAIGNS);
    let rule = BookRule::of(all.iter().map(|f| tests(&f.entries)).sum());
    let machine = runs.iter().find_map(|r| r.origin.as_ref()).map(|o| o.machine.clone());
    Ok(CampaignBook {
        format: "book/1",
        machine: machine.unwrap_or_default(),
        warnings: warnings(&runs, is_dated, &days),
        charts: all.into_iter().map(|f| f.chart(&rule)).collect(),
        rule,
        campaigns: runs.iter().zip(days).zip(places).map(|((r, d), x)| campaign(r, d, x)).collect(),
    })
}

fn campaign(run: &Run, date: Option<CampaignDay>, place: f64) -> BookCampaign {
    BookCampaign { file: run.file.clone(), date, place, verdict: run.verdict, added: run.added.clone() }
}
