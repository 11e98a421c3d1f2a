//! The changes of one chart.

use nalgebra::{DMatrix, DVector};
use serde::{Serialize, Serializer};
use statrs::distribution::{ChiSquared, ContinuousCDF, Normal};

use super::build::BookRule;

/// Changes of one chart beyond which nothing is explained any more.
const MOST_CHANGES: usize = 2;
/// Rise of chi-square within which the beginning of a step is left open: 95 % of one number.
const OPEN: f64 = 3.84;

/// How the level of a chart changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChangeKind {
    /// Another level from a campaign on.
    Step,
    /// Another level in one campaign only.
    Alone,
    /// A straight line.
    Drift,
}

impl ChangeKind {
    /// Its word on pages and in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Step => "step",
            Self::Alone => "alone",
            Self::Drift => "drift",
        }
    }
}

impl Serialize for ChangeKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word())
    }
}

/// A change that chance does not explain.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ChartChange {
    /// How the level changes.
    pub kind: ChangeKind,
    /// Number of the campaign, from one: the first of the new level, the one that stands alone, the first of a drift.
    pub campaign: usize,
    /// Campaigns with which a step may begin: first and last of those that explain the numbers nearly as well.
    pub between: [usize; 2],
    /// New level minus old one, in the unit of the chart; of a drift from the first campaign to the last.
    pub size: f64,
    /// Its standard uncertainty.
    pub std: f64,
    /// Both divided.
    pub sigmas: f64,
    /// Chance that noise gives one as large anywhere in the book, at most.
    pub chance: f64,
}

/// A number of a chart: where it stands, what it is, how sure.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    /// Number of the campaign, from one.
    pub(super) campaign: usize,
    /// Days since the first campaign, or the number of the campaign.
    pub(super) place: f64,
    pub(super) value: f64,
    pub(super) std: f64,
}

/// What became of a chart.
pub(super) struct Judged {
    /// Changes, the largest in uncertainties first.
    pub(super) changes: Vec<ChartChange>,
    /// Level of every entry with the changes.
    pub(super) levels: Vec<f64>,
    /// Level before any change.
    pub(super) base: f64,
    /// Scatter about these levels in stated uncertainties, where it is too large.
    pub(super) scatter: Option<f64>,
}

/// A change that is tried: how, and at which entry.
type Tried = (ChangeKind, usize);

/// Every change that entries can show.
pub(super) fn tried(entries: &[Entry]) -> Vec<Tried> {
    let n = entries.len();
    if n < 2 {
        return Vec::new();
    }
    let steps = (1..n).map(|at| (ChangeKind::Step, at));
    // The first alone is a step behind it, the last alone one that begins with it.
    let alone = (1..n - 1).map(|at| (ChangeKind::Alone, at));
    let drift = (n > 2 && entries[n - 1].place > entries[0].place).then_some((ChangeKind::Drift, 0));
    steps.chain(alone).chain(drift).collect()
}

/// Tests of a chart: every change, and the scatter.
pub(super) fn tests(entries: &[Entry]) -> usize {
    tried(entries).len() + 1
}

/// Find the changes of a chart.
pub(super) fn judge(entries: &[Entry], rule: &BookRule) -> Judged {
    let mut chosen: Vec<Tried> = Vec::new();
    loop {
        let fit = Levels::of(entries, &chosen);
        let is_scattered = fit.chance_of_scatter(entries.len()) < rule.chance_each;
        let best = largest(entries, &chosen, &fit).filter(|(_, sigmas)| *sigmas > rule.sigmas);
        let room = chosen.len() < MOST_CHANGES && entries.len() > chosen.len() + 2;
        match best {
            Some((change, _)) if room => chosen.push(change),
            None if !is_scattered => return judged(entries, &chosen, &fit, None, rule),
            _ => return scattered(entries, &chosen, &fit, rule),
        }
    }
}

/// What stays of the changes when the rest scatters too much: those that stand out of that scatter.
fn scattered(entries: &[Entry], chosen: &[Tried], fit: &Levels, rule: &BookRule) -> Judged {
    let spread = fit.spread(entries.len()).max(1.0);
    let stands = |k: &usize| fit.sigmas(k + 1) > rule.sigmas * spread;
    let kept: Vec<Tried> = (0..chosen.len()).filter(stands).map(|k| chosen[k]).collect();
    let fit = Levels::of(entries, &kept);
    let spread = fit.spread(entries.len());
    judged(entries, &kept, &fit, Some(spread), rule)
}

fn judged(
    entries: &[Entry],
    chosen: &[Tried],
    fit: &Levels,
    scatter: Option<f64>,
    rule: &BookRule,
) -> Judged {
    let mut changes: Vec<ChartChange> =
        (0..chosen.len()).map(|k| change(entries, chosen, k, fit, rule)).collect();
    changes.sort_by(|a, b| b.sigmas.abs().total_cmp(&a.sigmas.abs()));
    Judged { changes, levels: fit.fitted.clone(), base: fit.coefficients[0], scatter }
}

fn change(entries: &[Entry], chosen: &[Tried], k: usize, fit: &Levels, rule: &BookRule) -> ChartChange {
    let (kind, at) = chosen[k];
    let (size, std) = (fit.coefficients[k + 1], fit.stds[k + 1]);
    let sigmas = size / std;
    let chance = (2.0 * rule.tests as f64 * Normal::standard().sf(sigmas.abs())).min(1.0);
    let between = open(entries, chosen, k, fit).map(|at| entries[at].campaign);
    ChartChange { kind, campaign: entries[at].campaign, between, size, std, sigmas, chance }
}

/// Entries with which a step may begin: those that leave hardly more.
fn open(entries: &[Entry], chosen: &[Tried], k: usize, fit: &Levels) -> [usize; 2] {
    let at = chosen[k].1;
    if chosen[k].0 != ChangeKind::Step {
        return [at; 2];
    }
    let leaves = |at: &usize| {
        let mut other = chosen.to_vec();
        other[k] = (ChangeKind::Step, *at);
        Levels::of(entries, &other).chi2 <= fit.chi2 + OPEN
    };
    let first = (1..=at).rev().take_while(leaves).last().unwrap_or(at);
    let last = (at..entries.len()).take_while(leaves).last().unwrap_or(at);
    [first, last]
}

/// The change that explains most of what the chosen ones leave, with its size in uncertainties.
fn largest(entries: &[Entry], chosen: &[Tried], fit: &Levels) -> Option<(Tried, f64)> {
    let gain = |one: Tried| {
        let with: Vec<Tried> = chosen.iter().copied().chain([one]).collect();
        (one, (fit.chi2 - Levels::of(entries, &with).chi2).max(0.0).sqrt())
    };
    let all = tried(entries).into_iter().filter(|one| !chosen.contains(one)).map(gain);
    all.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// A weighted least-squares fit of levels.
struct Levels {
    /// The level before any change, then the size of each change.
    coefficients: Vec<f64>,
    stds: Vec<f64>,
    fitted: Vec<f64>,
    chi2: f64,
}

impl Levels {
    fn of(entries: &[Entry], chosen: &[Tried]) -> Self {
        let columns = chosen.len() + 1;
        let entry = |i: usize, j: usize| if j == 0 { 1.0 } else { column(entries, chosen[j - 1], i) };
        let design = DMatrix::from_fn(entries.len(), columns, entry);
        let weighted = DMatrix::from_fn(entries.len(), columns, |i, j| design[(i, j)] / entries[i].std);
        // About the first value: levels of a stiff machine differ in the last digits only.
        let origin = entries.first().map_or(0.0, |e| e.value);
        let values = DVector::from_fn(entries.len(), |i, _| (entries[i].value - origin) / entries[i].std);
        let inverse = weighted.tr_mul(&weighted).cholesky().map(|c| c.inverse());
        // Columns that say the same explain nothing more.
        let inverse = inverse.unwrap_or_else(|| DMatrix::zeros(columns, columns));
        let found = &inverse * weighted.tr_mul(&values);
        let chi2 = (&weighted * &found - &values).norm_squared();
        let mut coefficients: Vec<f64> = found.iter().copied().collect();
        coefficients[0] += origin;
        let fitted = (&design * &found).iter().map(|x| x + origin).collect();
        let stds = (0..columns).map(|k| inverse[(k, k)].max(0.0).sqrt()).collect();
        Self { coefficients, stds, fitted, chi2 }
    }

    fn sigmas(&self, column: usize) -> f64 {
        (self.coefficients[column] / self.stds[column]).abs()
    }

    fn dof(&self, entries: usize) -> f64 {
        entries.saturating_sub(self.coefficients.len()) as f64
    }

    /// Scatter about the levels in stated uncertainties.
    fn spread(&self, entries: usize) -> f64 {
        (self.chi2 / self.dof(entries).max(1.0)).sqrt()
    }

    fn chance_of_scatter(&self, entries: usize) -> f64 {
        ChiSquared::new(self.dof(entries)).map_or(1.0, |law| law.sf(self.chi2))
    }
}

/// What a change adds to an entry, in its size.
fn column(entries: &[Entry], (kind, at): Tried, i: usize) -> f64 {
    let [first, last] = [entries[0].place, entries[entries.len() - 1].place];
    match kind {
        ChangeKind::Step => f64::from(u8::from(i >= at)),
        ChangeKind::Alone => f64::from(u8::from(i == at)),
        ChangeKind::Drift => (entries[i].place - first) / (last - first),
    }
}
