//! Many readings from candidates: exchange, then excursions, within a budget.
//!
//! From a random plan every member is exchanged for the candidate that helps most until nothing helps (Fedorov 1972, in the form
//! of Cook and Nachtsheim 1980); then excursions lead out of poor optima: more is added than the budget allows and the least
//! useful taken away again (DETMAX, Mitchell 1974), poses are exchanged with all their readings, or left. What a change leaves
//! of the budget is filled by gain per cost. The whole is repeated from several starts.
//!
//! Every criterion is supported: candidates are ranked by its gradient, the foremost evaluated exactly. [`bound`] limits the
//! distance of a plan from the optimum.

pub mod bound;
mod candidates;
mod plan;

pub use candidates::Candidates;

use hexbench_core::parallel;
use hexbench_core::streams::{Purpose, stream};
use nalgebra::DMatrix;
use rand::RngExt;
use rand_pcg::Pcg64;

use crate::determined::undetermined;
use crate::{DesignError, Objective};
use plan::{By, Draft};

/// Largest excursion: members added before as many are taken away.
const LONGEST_EXCURSION: usize = 4;
/// Relative gain below which an exchange is rounding.
const LEAST_GAIN: f64 = 1e-9;
/// Relative difference below which two values count as the same.
const SAME: f64 = 1e-4;
/// Share of the mean information that keeps a start invertible until it determines everything.
const RIDGE: f64 = 1e-9;
/// Rounds of exchanges and excursions, far more than a plan that determines everything takes.
const MOST_ROUNDS: usize = 200;
/// Members drawn in vain before a random plan counts as full.
const PATIENCE: usize = 50;

/// An exchange among candidates.
pub struct Exchange<'a> {
    candidates: &'a Candidates,
    criterion: &'a Objective,
    ridge: DMatrix<f64>,
}

/// A plan found.
#[derive(Debug, Clone, PartialEq)]
pub struct ExchangedPlan {
    /// Indices of the candidates, ascending; one that occurs twice is repeated.
    pub members: Vec<usize>,
    /// Value of the criterion, as for one reading.
    pub value: f64,
    /// Starts that ended at this value, to four digits.
    pub agreeing: usize,
}

impl<'a> Exchange<'a> {
    /// Prepares candidates.
    pub fn new(candidates: &'a Candidates, criterion: &'a Objective) -> Self {
        let size = RIDGE / candidates.information.len().max(1) as f64;
        let ridge = DMatrix::from_diagonal(&(candidates.whole().diagonal() * size));
        Self { candidates, criterion, ridge }
    }

    /// The best plan out of several starts; `done` is called after each.
    ///
    /// # Errors
    /// [`DesignError::NoReading`], [`DesignError::NotDetermined`].
    pub fn search(
        &self,
        starts: usize,
        seed: u64,
        done: &(dyn Fn() + Sync),
    ) -> Result<ExchangedPlan, DesignError> {
        let c = self.candidates;
        if c.costs.iter().all(|cost| c.pose_cost + cost > c.budget) {
            return Err(DesignError::NoReading);
        }
        let end = |start: usize| {
            let plan = self.climb(self.start(&mut stream(seed, Purpose::ExchangeStart, [start as u64])));
            done();
            plan
        };
        let ends: Vec<ExchangedPlan> = parallel::map_range(starts, &end);
        // The first of equals, so that the order of threads does not matter.
        let best = ends.iter().cloned().reduce(|a, b| if b.value > a.value { b } else { a });
        let determines = |plan: &ExchangedPlan| {
            undetermined(&self.criterion.of_parameters(&self.candidates.sum(&plan.members))).is_empty()
        };
        let Some(mut best) = best.filter(determines) else {
            return Err(self.not_determined("allow more readings or more time"));
        };
        best.agreeing = ends.iter().filter(|e| e.value >= (1.0 - SAME) * best.value).count();
        Ok(best)
    }

    fn not_determined(&self, hint: &'static str) -> DesignError {
        DesignError::NotDetermined { parameters: self.criterion.parameters(&self.ridge), hint }
    }

    /// A random plan, with few or many poses when going to a pose costs something.
    fn start(&self, rng: &mut Pcg64) -> Draft<'_, 'a> {
        let c = self.candidates;
        let dearest = c.costs.iter().copied().fold(0.0, f64::max);
        let affordable = |n: &usize| *n as f64 * (c.pose_cost + dearest) <= c.budget;
        let most = rng.random_range(1..=(1..=c.poses()).take_while(affordable).count().max(1));
        let few: Vec<usize> = (0..most).map(|_| rng.random_range(0..c.poses())).collect();
        let mut draft = Draft::new(self, Vec::new());
        let mut vain = 0;
        while vain < PATIENCE {
            let pose = if c.pose_cost > 0.0 {
                few[rng.random_range(0..most)]
            } else {
                rng.random_range(0..c.poses())
            };
            let candidate = pose * c.costs.len() + rng.random_range(0..c.costs.len());
            if draft.affords(candidate) {
                draft.add(candidate);
            } else {
                vain += 1;
            }
        }
        draft
    }

    /// Exchanges and excursions until neither helps.
    fn climb<'s>(&'s self, mut draft: Draft<'s, 'a>) -> ExchangedPlan {
        fill(&mut draft);
        let mut rounds = 0;
        loop {
            rounds += 1;
            // Sums are made anew from time to time, so that rounding does not pile up.
            draft = Draft::new(self, draft.members);
            while exchange_all(&mut draft) || move_poses(&mut draft) {}
            let out = (1..=LONGEST_EXCURSION).any(|length| excursion(&mut draft, length));
            // Where a plan determines too little, rounding goes on looking like a gain.
            if rounds >= MOST_ROUNDS || (!out && !leave_a_pose(&mut draft)) {
                let value = draft.value();
                draft.members.sort_unstable();
                return ExchangedPlan { members: draft.members, value, agreeing: 1 };
            }
        }
    }

    fn value(&self, information: &DMatrix<f64>) -> f64 {
        self.criterion.value(information, 1)
    }
}

/// Adds what helps most for its cost until nothing can be afforded.
fn fill(draft: &mut Draft<'_, '_>) {
    while let Some(candidate) = draft.best_addition(By::Rate) {
        draft.add(candidate);
    }
}

/// Replaces a plan by a trial that is better.
fn keep_better<'a, 'c>(draft: &mut Draft<'a, 'c>, trial: Draft<'a, 'c>) -> bool {
    let better = trial.fits() && trial.value() > draft.value() * (1.0 + LEAST_GAIN);
    if better {
        *draft = trial;
    }
    better
}

/// Exchanges each member for its best replacement; true when one helped.
fn exchange_all(draft: &mut Draft<'_, '_>) -> bool {
    let mut helped = false;
    for position in (0..draft.members.len()).rev() {
        let mut trial = draft.clone();
        let member = trial.remove(position);
        let Some(candidate) = trial.best_addition(By::Value) else { continue };
        if candidate != member {
            trial.add(candidate);
            fill(&mut trial);
            helped |= keep_better(draft, trial);
        }
    }
    helped
}

/// Exchanges each pose, with all its readings, for its best replacement; true when one helped.
fn move_poses(draft: &mut Draft<'_, '_>) -> bool {
    let mut helped = false;
    for pose in draft.visited() {
        let mut trial = draft.clone();
        let settings = trial.leave(pose);
        let Some(other) = trial.best_pose(&settings) else { continue };
        if other != pose {
            trial.visit(other, &settings);
            fill(&mut trial);
            helped |= keep_better(draft, trial);
        }
    }
    helped
}

/// Adds the best `length` candidates, then takes the least useful away until the budget is kept.
fn excursion(draft: &mut Draft<'_, '_>, length: usize) -> bool {
    let mut trial = draft.clone();
    let all = draft.candidate_count();
    for _ in 0..length {
        let Some(candidate) = trial.best_of((0..all).collect(), By::Rate) else { return false };
        trial.add(candidate);
    }
    while !trial.fits() {
        let Some(position) = trial.least_useful() else { return false };
        trial.remove(position);
    }
    fill(&mut trial);
    keep_better(draft, trial)
}

/// Leaves a pose out and spends its time elsewhere.
fn leave_a_pose(draft: &mut Draft<'_, '_>) -> bool {
    draft.visited().into_iter().any(|pose| {
        let mut trial = draft.clone();
        trial.leave(pose);
        fill(&mut trial);
        keep_better(draft, trial)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Criterion;

    /// Rows `1, x, x^2, ...` of points.
    fn rows(points: &[f64], degree: usize) -> Vec<DMatrix<f64>> {
        let powers = |x: f64| std::iter::successors(Some(1.0), move |p| Some(p * x)).take(degree + 1);
        points.iter().map(|&x| DMatrix::from_iterator(1, degree + 1, powers(x))).collect()
    }

    fn best(rows: &[DMatrix<f64>], size: usize, starts: usize) -> ExchangedPlan {
        let candidates = Candidates::of_rows(rows, size);
        Exchange::new(&candidates, &Objective::from(Criterion::D)).search(starts, 1, &|| ()).unwrap()
    }

    /// Exact D-optimal designs of a quadratic on {-1, 0, 1}: det X'X for 3 to 7 points.
    /// Source: classical theory (Kiefer and Wolfowitz 1960), recomputed by enumeration.
    #[test]
    fn quadratics_on_three_points_reach_the_known_determinants() {
        let candidates = rows(&[-1.0, 0.0, 1.0], 2);
        for (n, det) in [(3, 4.0), (4, 8.0), (5, 16.0), (6, 32.0), (7, 48.0_f64)] {
            let found = best(&candidates, n, 4).value.powi(3);
            assert!((found / det - 1.0).abs() < 1e-6, "{n} points: {found}, not {det}");
        }
    }

    /// Guest 1958: the D-optimal points of a polynomial are the extrema of the Legendre polynomial.
    #[test]
    fn polynomials_take_the_legendre_points() {
        let points: Vec<f64> = (-1000..=1000).map(|i| f64::from(i) * 1e-3).collect();
        for (degree, inner) in [(3, 0.447_213_595_5), (4, 0.654_653_670_7), (5, 0.765_055_323_9)] {
            let candidates = rows(&points, degree);
            let plan = best(&candidates, degree + 1, 4);
            let second = points[plan.members[1]];
            assert!((second + inner).abs() <= 1e-3, "degree {degree}: {second}");
        }
    }

    /// Hotelling 1944: eight weighings of eight objects with signs reach det X'X = 8^8.
    #[test]
    fn weighings_reach_the_hadamard_determinant() {
        let sign = |code: usize, k: usize| if code >> k & 1 == 1 { 1.0 } else { -1.0 };
        let candidates: Vec<DMatrix<f64>> =
            (0..256).map(|code| DMatrix::from_fn(1, 8, |_, k| sign(code, k))).collect();
        let plan = best(&candidates, 8, 12);
        assert!((plan.value - 8.0).abs() < 1e-6, "{}", plan.value);
    }

    #[test]
    fn too_few_readings_are_refused() {
        let candidates = rows(&[-1.0, 0.0, 1.0], 2);
        let candidates = Candidates::of_rows(&candidates, 2);
        let found = Exchange::new(&candidates, &Objective::from(Criterion::D)).search(4, 1, &|| ());
        assert!(matches!(found, Err(DesignError::NotDetermined { .. })));
    }

    #[test]
    fn a_budget_for_no_reading_is_refused_before_the_search() {
        let mut candidates = Candidates::of_rows(&rows(&[-1.0, 0.0, 1.0], 2), 2);
        candidates.pose_cost = 2.0;
        let found = Exchange::new(&candidates, &Objective::from(Criterion::D)).search(4, 1, &|| ());
        assert!(found.is_err_and(|error| error.to_string().contains("a single reading")));
    }
}
