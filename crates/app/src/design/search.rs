//! The search of `hexbench design`: few poses, or readings within a budget.

use hexbench_core::{Hexapod, Pose, StatedTolerances, Vector6, Wrench};
use hexbench_design::budget::Amount;
use hexbench_design::determined::require_determined;
use hexbench_design::exchange::bound::efficiency;
use hexbench_design::exchange::{Candidates, Exchange, ExchangedPlan};
use hexbench_design::refine::{information, refine};
use hexbench_design::regressor::{ModelRegressor, PoseRegressor, SettingRegressor};
use hexbench_design::space::Loading;
use hexbench_design::{Criterion, DesignError, Objective, PoseProblem, PoseSearch, Space, Visit};
use hexbench_model::estimation::nuisance::marginal;
use hexbench_report::words::notes::read_by;
use nalgebra::DMatrix;

use super::{Designed, Quantity, Wish};
use crate::Failure;

/// Hears how many starts there are, and gives what hears of the end of each.
pub type StartedSearch<'a> = dyn Fn(u64) -> Box<dyn Fn() + Sync> + 'a;

/// Starts of a search whose rows have closed forms with exact derivatives.
const MANY_STARTS: u16 = 128;
/// Starts of any other.
const FEW_STARTS: u16 = 16;

/// What the search is made of.
pub(super) struct Bench<'a> {
    pub(super) wish: &'a Wish,
    pub(super) begun: &'a StartedSearch<'a>,
    pub(super) hexapod: &'a Hexapod,
    pub(super) space: &'a Space,
    /// With inputs as good as their tolerances, where a noise is stated.
    pub(super) inexact: Option<&'a ModelRegressor<'a>>,
}

impl Bench<'_> {
    /// What makes a plan good: as wished, else O1 as in the paper for poses, D for a budget.
    pub(super) fn criterion(&self) -> Criterion {
        let usual = if self.space.budget.limit.is_some() { Criterion::D } else { Criterion::O1 };
        self.wish.criterion.unwrap_or(usual)
    }

    /// The plan with rounded poses.
    pub(super) fn design<R: SettingRegressor>(
        &self,
        regressor: &R,
        promised: Vec<Quantity>,
    ) -> Result<Designed, Failure> {
        let criterion = self.criterion().objective(self.hexapod, self.space, regressor)?;
        let found = match self.space.budget.limit {
            None => self.few_poses(regressor, &criterion)?,
            Some(amount) => self.within(amount, regressor, &criterion)?,
        };
        let best = information(&found.visits, &regressor.under(&self.space.settings_of(&found.loads)))?;
        let space = self.space.under(found.loads).with_rounded_loads();
        let settings = space.settings();
        let rounded_pose = |v: Visit| Visit { pose: space.rounded(self.hexapod, &v.pose), ..v };
        let visits = merged(found.visits.into_iter().map(rounded_pose));
        let rounded = information(&visits, &regressor.under(&settings))?;
        let p = regressor.parameters();
        let weighed = |inexact: &ModelRegressor<'_>| -> Result<DMatrix<f64>, Failure> {
            if space.load_ranges.is_empty() {
                return Ok(marginal(&information(&visits, inexact)?, p));
            }
            // Which errors of inputs show depends on the loads.
            let there = inexact.under(&settings).within_tolerances(&space, usize::MAX)?;
            Ok(marginal(&information(&visits, &there)?, p))
        };
        let within_tolerances = self.inexact.map(weighed).transpose()?;
        let readings = visits.iter().flat_map(|v| &v.counts).sum();
        Ok(Designed {
            criterion: criterion.criterion().name(),
            best: criterion.value(&best, readings),
            value: criterion.value(&rounded, readings),
            within_tolerances,
            tolerances: StatedTolerances::from(&self.hexapod.tolerances),
            information: rounded.view((0, 0), (p, p)).into_owned(),
            parameters: promised,
            space,
            visits,
            settings,
            poses_asked: found.poses_asked,
            settled: None,
            budget: self.space.budget,
            candidates: found.candidates,
            efficiency: found.efficiency,
            starts: found.starts,
            read_by: read_by(&self.hexapod.sensors),
            weighted: self.inexact.is_some(),
            seed: self.wish.seed,
        })
    }

    /// So many poses, every setting read as often at each.
    fn few_poses<R: SettingRegressor>(&self, regressor: &R, criterion: &Objective) -> Result<Found, Failure> {
        let counts = vec![usize::from(self.wish.repeats); self.space.settings().len()];
        let problem = PoseProblem {
            hexapod: self.hexapod,
            space: self.space,
            regressor: &regressor.repeated(&counts),
            criterion,
            poses: usize::from(self.wish.poses.unwrap_or(3)),
            known: None,
        };
        let is_closed = regressor.inputs() == 0 && self.hexapod.sensors.is_empty();
        let (starts, ended) = self.starts(if is_closed { MANY_STARTS } else { FEW_STARTS });
        let found = problem.search(starts, self.wish.seed, &*ended);
        let found = found.map_err(|cause| self.with_what_it_lacks(cause, regressor));
        let PoseSearch { best, starts, ended, agreeing } = found?;
        let visit = |pose: Pose| Visit { pose, counts: counts.clone() };
        Ok(Found {
            visits: best.poses.into_iter().map(visit).collect(),
            loads: best.loads,
            starts: [starts, ended, agreeing],
            poses_asked: Some(problem.poses),
            candidates: None,
            efficiency: None,
        })
    }

    /// Readings out of candidates within a budget, then their poses refined.
    fn within<R: SettingRegressor>(
        &self,
        amount: Amount,
        regressor: &R,
        criterion: &Objective,
    ) -> Result<Found, Failure> {
        let Wish { seed, candidates: count, .. } = *self.wish;
        let (hexapod, space) = (self.hexapod, self.space);
        let (mut candidates, mut poses) =
            Candidates::spread(hexapod, space, regressor, amount, usize::from(count), seed)?;
        require_determined(&candidates.whole(), &regressor.names())
            .map_err(|cause| self.with_what_it_lacks(cause, regressor))?;
        let (starts, ended) = self.starts(FEW_STARTS);
        let ExchangedPlan { members, agreeing, .. } =
            Exchange::new(&candidates, criterion).search(starts, seed.into(), &*ended)?;
        let mut visits = candidates.visits(&poses, &members);
        let loads = refine(hexapod, &space.choosing_of(&visits), regressor, criterion, &mut visits)?;
        // The bound counts the refined poses and loads among the candidates.
        let refined = regressor.under(&space.settings_of(&loads));
        let members = candidates.extend(&mut poses, &visits, &refined)?;
        let efficiency = efficiency(&candidates, criterion, &members);
        Ok(Found {
            visits,
            loads,
            starts: [starts, starts, agreeing],
            poses_asked: None,
            candidates: Some(poses.len()),
            efficiency,
        })
    }

    /// The same cause with the components of load that the space lacks, where those are what it lacks.
    fn with_what_it_lacks<R: SettingRegressor>(&self, cause: DesignError, regressor: &R) -> DesignError {
        let DesignError::NeverDetermined { names, .. } = cause else { return cause };
        let mut lacks: Vec<usize> = (0..6).collect();
        if self.determines_with(&lacks, regressor) {
            for component in 0..6 {
                let fewer: Vec<usize> = lacks.iter().copied().filter(|k| *k != component).collect();
                if self.determines_with(&fewer, regressor) {
                    lacks = fewer;
                }
            }
        } else {
            lacks.clear();
        }
        DesignError::NeverDetermined { names, lacks: lacks.into_iter().map(|k| Wrench::NAMES[k]).collect() }
    }

    /// True where the space with a load more for each of these components would determine everything.
    fn determines_with<R: SettingRegressor>(&self, components: &[usize], regressor: &R) -> bool {
        const POSES: usize = 32;
        let force = self.space.loads.iter().map(|l| l.load.force.norm()).fold(1.0, f64::max);
        let reference = self.space.loads.first().map(|l| l.reference).unwrap_or_default();
        let with = |&k: &usize| {
            let size = if k < 3 { force } else { force * self.hexapod.platform_radius() };
            let load = reference.to_vector() + Vector6::ith(k, size);
            Loading { reference, load: Wrench::from_array(load.into()) }
        };
        let loads = self.space.loads.iter().copied().chain(components.iter().map(with));
        let space = self.space.with_loads_fixed().under(loads.collect());
        let there = regressor.under(&space.settings());
        let amount = Amount::Readings(1);
        Candidates::spread(self.hexapod, &space, &there, amount, POSES, self.wish.seed)
            .is_ok_and(|(all, _)| require_determined(&all.whole(), &regressor.names()).is_ok())
    }

    fn starts(&self, usual: u16) -> (usize, Box<dyn Fn() + Sync>) {
        let starts = self.wish.starts.unwrap_or(usual);
        (usize::from(starts), (self.begun)(starts.into()))
    }
}

/// A plan found, with how it was found.
struct Found {
    visits: Vec<Visit>,
    loads: Vec<Loading>,
    starts: [usize; 3],
    candidates: Option<usize>,
    efficiency: Option<f64>,
    poses_asked: Option<usize>,
}

/// Visits of one pose put together.
fn merged(visits: impl Iterator<Item = Visit>) -> Vec<Visit> {
    let mut different: Vec<Visit> = Vec::new();
    for visit in visits {
        match different.iter_mut().find(|known| known.pose == visit.pose) {
            Some(known) => known.counts.iter_mut().zip(&visit.counts).for_each(|(n, more)| *n += more),
            None => different.push(visit),
        }
    }
    different
}
