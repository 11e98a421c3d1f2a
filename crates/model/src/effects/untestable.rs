//! Why data cannot speak about a term.

use hexbench_core::Columns;
use serde::{Serialize, Serializer};

use crate::effects::term::{Need, Term};
use crate::estimation::campaign::{Campaign, Condition};
use crate::estimation::foresight;
use crate::estimation::linearization::Linearization;

/// A term that cannot be tested.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS), ts(rename = "UntestableReport"))]
pub struct Untestable {
    /// Its id.
    pub term: &'static str,
    /// The reason.
    #[cfg_attr(feature = "typescript", ts(as = "String"))]
    pub why: Reason,
}

impl Untestable {
    /// Of a term.
    pub fn new(term: &dyn Term, why: Reason) -> Self {
        Self { term: term.info().id, why }
    }
}

/// Why a term cannot be tested.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Reason {
    /// Absolute poses estimate it with the target frame.
    #[error("it is part of the target frame, which is estimated for absolute poses anyway")]
    PartOfTargetFrame,
    /// Deflections do not show it.
    #[error("it needs absolute poses (measured_a_mm ...)")]
    OnlyAbsolutePoses,
    /// A covariate is not in the file.
    #[error("no {0} column")]
    NoColumn(&'static str),
    /// A covariate never differs from zero.
    #[error("{0} is zero in every row")]
    ZeroColumn(&'static str),
    /// The machine has no brackets.
    #[error("no legs share a bracket: state [legs] brackets")]
    NoBrackets,
    /// Nothing tells the loads apart.
    #[error("every row has the same load")]
    OneLoad,
    /// It has no value at a reading.
    #[error("line {line}: {what}")]
    Fault {
        /// Line of the file.
        line: u64,
        /// What is wrong there, in words.
        what: String,
    },
    /// It is too small to show in the readings.
    #[error("no plausible size would be detectable at these poses and loads")]
    TooFaint,
    /// It is too small to show in any reading a space allows.
    #[error("no plausible size would be detectable in this space")]
    TooFaintInSpace,
}

impl Serialize for Reason {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Terms of a model with the columns that they need and that rows to be predicted do not have: their numbers count as zero.
pub fn columns_missing<'a>(
    terms: impl Iterator<Item = &'a dyn Term>,
    columns: &Columns,
) -> Vec<(&'static str, &'static str)> {
    let of_term = |term: &'a dyn Term| {
        let info = term.info();
        info.needs.iter().filter_map(|need| column_missing(*need, columns)).map(|column| (info.id, column))
    };
    terms.flat_map(of_term).collect()
}

/// Why a term cannot be tested with a campaign, or `None` when it can.
pub fn why_untestable(term: &dyn Term, campaign: &Campaign, lin: &Linearization) -> Option<Reason> {
    if campaign.is_absolute() && term.is_part_of_target_frame() {
        return Some(Reason::PartOfTargetFrame);
    }
    let unmet = term.info().needs.iter().find_map(|need| unmet(*need, campaign, lin));
    unmet.or_else(|| {
        for shape in shapes(term, &lin.conditions) {
            foresight::of_conditions(term, false, shape, &lin.machine, &lin.conditions);
        }
        let mut pairs = lin.conditions.iter().zip(&campaign.groups);
        pairs.find_map(|(at, g)| {
            Some(Reason::Fault { line: g.mean.line, what: term.fault(&lin.machine, at)? })
        })
    })
}

/// Shapes at which a fault is looked for.
fn shapes(term: &dyn Term, conditions: &[Condition]) -> Vec<f64> {
    let grid = term.shape_grid(conditions);
    if grid.is_empty() { vec![1.0] } else { grid }
}

/// The column that a file lacks, where it is one that is needed.
fn column_missing(need: Need, columns: &Columns) -> Option<&'static str> {
    match need {
        Need::Approach => (!columns.approach && !columns.order).then_some("approach"),
        Need::DeltaT => (!columns.delta_t).then_some("delta_T_K"),
        Need::Elapsed => (!columns.elapsed).then_some("elapsed_s"),
        Need::Absolute | Need::Brackets | Need::Loads => None,
    }
}

fn unmet(need: Need, campaign: &Campaign, lin: &Linearization) -> Option<Reason> {
    let missing = column_missing(need, &campaign.columns);
    let no_column = missing.map(Reason::NoColumn);
    match need {
        Need::Absolute => (!campaign.is_absolute()).then_some(Reason::OnlyAbsolutePoses),
        Need::Approach => missing.map(|_| Reason::NoColumn("approach (or order)")),
        Need::DeltaT => no_column.or_else(|| zero("delta_T_K", lin.conditions.iter().map(|c| c.delta_t))),
        Need::Elapsed => no_column.or_else(|| zero("elapsed_s", lin.conditions.iter().map(|c| c.elapsed))),
        Need::Brackets => lin.machine.bracket_pairs.is_empty().then_some(Reason::NoBrackets),
        Need::Loads => (!several_loads(lin)).then_some(Reason::OneLoad),
    }
}

fn zero(column: &'static str, mut values: impl Iterator<Item = f64>) -> Option<Reason> {
    values.all(|x| x == 0.0).then_some(Reason::ZeroColumn(column))
}

fn several_loads(lin: &Linearization) -> bool {
    let first = lin.conditions.first().map(|c| c.wrench);
    lin.conditions.iter().any(|c| Some(c.wrench) != first)
}
