//! What a book follows: stiffnesses, effects, the error.

use serde::Serialize;

use super::build::BookRule;
use super::change::{ChangeKind, ChartChange, Entry, Judged, judge};
use crate::estimation::parameters::leg_of_stiffness;
use crate::results::runs::Run;

/// Standard deviations below which nine in ten of a normal law lie: a change of the stated size is noticed so often.
const NOTICED: f64 = 1.281_551_565_545;

/// What a chart is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum ChartSubject {
    /// The stiffness of a leg.
    Stiffness,
    /// A number of an effect.
    Effect,
    /// The error on held-out readings, in every campaign; else that on fitted ones.
    Error,
}

/// A number of a campaign.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ChartPoint {
    /// Number of the campaign, from one.
    pub campaign: usize,
    /// Value, in the unit of the chart.
    pub value: f64,
    /// Standard uncertainty (k = 1).
    pub std: f64,
    /// Level with the changes found.
    pub level: f64,
    /// Ends of what noise allows a campaign with this uncertainty about the level before any change.
    pub band: [f64; 2],
    /// The campaign is at another level than the first ones.
    pub alarm: bool,
}

/// Smallest changes that this chart reports nine times of ten, in its unit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct VisibleChange {
    /// One that comes with the last campaign.
    pub last: f64,
    /// One that lasts, begun where it is seen best.
    pub lasting: f64,
}

/// One number over the campaigns.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ControlChart {
    /// `leg-1.stiffness`, `base-compliance.rotation-x`, ..., `error`.
    pub name: String,
    /// Unit of all its numbers.
    pub unit: String,
    /// What it is about.
    pub about: ChartSubject,
    /// Campaigns that have the number.
    pub points: Vec<ChartPoint>,
    /// Changes, the most significant first.
    pub changes: Vec<ChartChange>,
    /// Scatter about the levels in stated uncertainties, where chance does not explain it; a sound chart has about 1.
    pub scatter: Option<f64>,
    /// Smallest changes it shows.
    pub visible: VisibleChange,
}

impl ControlChart {
    /// True when chance does not explain the numbers of the chart.
    pub fn is_alarmed(&self) -> bool {
        !self.changes.is_empty() || self.scatter.is_some()
    }

    /// The level before any change.
    pub fn base(&self) -> f64 {
        self.points.first().map_or(0.0, |p| f64::midpoint(p.band[0], p.band[1]))
    }
}

/// A number over the campaigns, before it is judged.
pub(super) struct Followed {
    name: String,
    unit: String,
    about: ChartSubject,
    pub(super) entries: Vec<Entry>,
}

impl Followed {
    /// The chart, by the rule of the book.
    pub(super) fn chart(self, rule: &BookRule) -> ControlChart {
        let Judged { changes, levels, base, scatter } = judge(&self.entries, rule);
        let point = |(entry, level): (&Entry, f64)| {
            let half = rule.sigmas * entry.std;
            let alarm = changes.iter().any(|c| concerns(c, entry.campaign));
            let (campaign, value, std) = (entry.campaign, entry.value, entry.std);
            ChartPoint { campaign, value, std, level, band: [base - half, base + half], alarm }
        };
        let points = self.entries.iter().zip(levels).map(point).collect();
        let visible = visible(&self.entries, rule);
        let Self { name, unit, about, .. } = self;
        ControlChart { name, unit, about, points, changes, scatter, visible }
    }
}

/// True when a campaign is at the new level of a change.
fn concerns(change: &ChartChange, campaign: usize) -> bool {
    match change.kind {
        ChangeKind::Step => campaign >= change.campaign,
        ChangeKind::Alone => campaign == change.campaign,
        ChangeKind::Drift => campaign > change.campaign,
    }
}

fn visible(entries: &[Entry], rule: &BookRule) -> VisibleChange {
    let weight = |some: &[Entry]| some.iter().map(|e| e.std.powi(-2)).sum::<f64>();
    let std = |at: usize| (weight(&entries[..at]).recip() + weight(&entries[at..]).recip()).sqrt();
    let size = |std: f64| (rule.sigmas + NOTICED) * std;
    let n = entries.len();
    let lasting = (1..n).map(std).fold(f64::INFINITY, f64::min);
    VisibleChange { last: size(std(n - 1)), lasting: size(lasting) }
}

/// Every number that at least so many campaigns have: legs first, then effects, then the error.
pub(super) fn followed(runs: &[Run], places: &[f64], fewest: usize) -> Vec<Followed> {
    let mut all: Vec<Followed> = Vec::new();
    for (i, run) in runs.iter().enumerate() {
        for p in run.parameters.iter().filter(|p| p.std > 0.0 && p.value.is_finite() && p.std.is_finite()) {
            let entry = Entry { campaign: i + 1, place: places[i], value: p.value, std: p.std };
            match all.iter_mut().find(|f| f.name == p.name && f.unit == p.unit) {
                Some(known) => known.entries.push(entry),
                None => all.push(Followed {
                    name: p.name.clone(),
                    unit: p.unit.clone(),
                    about: about(&p.name),
                    entries: vec![entry],
                }),
            }
        }
    }
    all.retain(|f| f.entries.len() >= fewest);
    all.sort_by_key(|f| (f.about != ChartSubject::Stiffness, leg_of_stiffness(&f.name)));
    all.extend(errors(runs, places));
    all
}

fn about(name: &str) -> ChartSubject {
    if leg_of_stiffness(name).is_some() { ChartSubject::Stiffness } else { ChartSubject::Effect }
}

/// The error of the final models, held out in all of them or in none; its uncertainty is that of the mean error, so that
/// a lucky campaign does not count for more.
fn errors(runs: &[Run], places: &[f64]) -> Option<Followed> {
    let last = runs.iter().map(|run| run.steps.last()).collect::<Option<Vec<_>>>()?;
    let held_out = last.iter().all(|step| step.holdout.is_some());
    let error = |k: usize| if held_out { last[k].error() } else { &last[k].fitted };
    let mean = (0..runs.len()).map(|k| error(k).times_noise()).sum::<f64>() / runs.len().max(1) as f64;
    let entry = |k: usize| {
        let e = error(k);
        Entry { campaign: k + 1, place: places[k], value: e.times_noise(), std: mean * e.band() }
    };
    let entries: Vec<Entry> = (0..runs.len()).map(entry).collect();
    let is_usable = mean > 0.0 && entries.iter().all(|e| e.value.is_finite());
    let name = if held_out { "error" } else { "fitted-error" };
    let unit = "x noise".to_owned();
    is_usable.then(|| Followed { name: name.to_owned(), unit, about: ChartSubject::Error, entries })
}
