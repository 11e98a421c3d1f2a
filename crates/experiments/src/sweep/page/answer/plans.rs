//! Which plans do what is asked, and what they cost.

use crate::sweep::cells::{GridCell, Position};
use crate::sweep::cost::PlanCost;
use crate::sweep::precision::looks_of;
use crate::sweep::question::{ERROR, Question};
use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

/// What the bounds of an answer mean.
pub(super) const READING: &str = "Bounds hold for all plans together with 95 %. A plan does what is asked when its bounds say so, and \
                                  may do it when they leave it open: then more trials decide.";

/// Whether a plan does what is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Meets {
    /// Its bounds say so.
    Yes,
    /// They leave it open.
    Maybe,
    /// They say that it does not.
    No,
}

/// A plan and what was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AskedPlan {
    /// Number of its cell.
    pub cell: usize,
    /// Share or error, and its bounds.
    pub found: [f64; 3],
    /// Whether that is what is asked.
    pub meets: Meets,
    /// Its cost; none where no plan could be drawn.
    pub cost: Option<PlanCost>,
}

/// All plans for one machine, effect, size and noise, the cheapest first.
#[derive(Debug, Clone, PartialEq)]
pub struct AskedPlans {
    /// The plans.
    pub plans: Vec<AskedPlan>,
}

impl AskedPlans {
    /// The cheapest plan that does what is asked.
    pub fn cheapest(&self) -> Option<&AskedPlan> {
        self.plans.iter().find(|plan| plan.meets == Meets::Yes)
    }

    /// The cheapest plan that may do it.
    pub fn open(&self) -> Option<&AskedPlan> {
        self.plans.iter().find(|plan| plan.meets == Meets::Maybe)
    }

    /// The plan that comes closest; `sign` is 1 where more is better, else -1.
    pub fn best(&self, sign: f64) -> Option<&AskedPlan> {
        let known = self.plans.iter().filter(|plan| plan.found[0].is_finite());
        known.max_by(|a, b| (sign * a.found[0]).total_cmp(&(sign * b.found[0])))
    }
}

/// Axes of what is given: geometry, effect, size, noise, laboratory, tolerances. The others are what is chosen.
const GIVEN: [usize; 6] = [0, 5, 6, 7, 8, 9];

/// Plans by what is given; where a share is asked, cells that hide something.
pub fn groups(study: &SweepStudy, cells: &[CellStatistics]) -> Vec<AskedPlans> {
    let mut groups: Vec<([usize; 6], AskedPlans)> = Vec::new();
    for found in cells {
        let given = given(&study.axes.cell(found.cell).position);
        let Some(plan) = judged(study, found) else { continue };
        match groups.iter_mut().find(|(known, _)| *known == given) {
            Some((_, group)) => group.plans.push(plan),
            None => groups.push((given, AskedPlans { plans: vec![plan] })),
        }
    }
    let sorted = |(_, mut group): (_, AskedPlans)| {
        group
            .plans
            .sort_by(|a, b| cost_order(a).partial_cmp(&cost_order(b)).unwrap_or(std::cmp::Ordering::Equal));
        group
    };
    groups.into_iter().map(sorted).collect()
}

/// Hours, then readings; plans without any last.
fn cost_order(plan: &AskedPlan) -> (bool, Option<PlanCost>) {
    (plan.cost.is_none(), plan.cost)
}

fn given(position: &Position) -> [usize; 6] {
    GIVEN.map(|axis| position[axis])
}

/// What the trials of a cell say to the question; none where it is not asked of this cell. All cells, and all looks at a cell that
/// stops when it is decided, share the chance of error.
pub fn judged(study: &SweepStudy, found: &CellStatistics) -> Option<AskedPlan> {
    let question = study.question.filter(|question| is_asked(study, *question, found.cell))?;
    let asked = (0..study.axes.cells()).filter(|&cell| is_asked(study, question, cell)).count();
    let error = ERROR / (asked * looks_of(study)) as f64;
    Some(plan(question, found, error))
}

/// A share is asked of cells that hide something.
fn is_asked(study: &SweepStudy, question: Question, cell: usize) -> bool {
    !matches!(question, Question::Share(..)) || !study.axes.cell(cell).effects().is_empty()
}

fn plan(question: Question, found: &CellStatistics, error: f64) -> AskedPlan {
    let (value, meets) = match question {
        Question::Share(of, least) => {
            let share = found.answers.share(of);
            let [low, high] = share.interval(error);
            ([share.rate(), low, high], meets(low >= least, high < least))
        }
        Question::Error(most) => {
            let [rms, low, high] = found.springs.blocks.rms(error);
            // A plan that leaves stiffnesses open in some trials does not have their error.
            let all = found.done() == found.trials();
            ([rms, low, high], meets(all && high <= most, !all || low > most))
        }
        Question::Index => ([f64::NAN; 3], Meets::Maybe),
    };
    AskedPlan { cell: found.cell, found: value, meets, cost: found.cost }
}

fn meets(yes: bool, no: bool) -> Meets {
    match (yes, no) {
        (true, _) => Meets::Yes,
        (_, true) => Meets::No,
        _ => Meets::Maybe,
    }
}

/// The cell of a plan.
pub(super) fn cell<'a>(study: &'a SweepStudy, plan: &AskedPlan) -> GridCell<'a> {
    study.axes.cell(plan.cell)
}
