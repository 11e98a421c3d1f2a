//! Scans over periods, thresholds and legs: one candidate at a time beside everything found so far.

use std::convert::Infallible;
use std::ops::Range;

use hexbench_core::Vector6;
use hexbench_core::parallel;
use nalgebra::{DMatrix, DVector};

use crate::effects::chain::Action;
use crate::effects::period::period_grid;
use crate::effects::term::Term;
use crate::estimation::basis::{orthonormal, project};
use crate::estimation::campaign::Campaign;
use crate::estimation::linearization::{Linearization, ModelPoint, beside};
use crate::inference::candidates::target;
use crate::inference::elongations::Elongations;
use crate::inference::evidence::drop_of;
use crate::inference::golden::golden;
use crate::inference::leg_sums::{ElongationSpace, LawColumns, WhitenedTwice};
use crate::inference::pattern::{Course, LegPattern, Pattern, PatternVariable, spread};

/// Variables a pattern may follow.
const VARIABLES: [PatternVariable; 6] = [
    PatternVariable::Elapsed,
    PatternVariable::DeltaT,
    PatternVariable::LegLength,
    PatternVariable::LegForce,
    PatternVariable::Tilt,
    PatternVariable::Height,
];
/// Conditions looked at by scans.
pub(crate) const SCANNED_CONDITIONS: usize = 400;
/// Relative difference of the drops of patterns up to which they are alike.
const ALIKE: f64 = 1e-9;
/// Kinds of which the products are formed at once.
const KINDS_AT_ONCE: usize = 16;
/// Steps of the search for the top of a peak.
const GOLDEN_STEPS: usize = 20;
/// Most places of the file where a change is looked for at first; between those beside the best, all are.
const CUTS: usize = 48;
/// Conditions before a change and after it, at least: fewer are wrong rows.
const BESIDE_A_CHANGE: usize = 4;

/// The residual and the columns that any further effect has to share it with.
pub(crate) struct Scanner<'a> {
    lin: &'a Linearization,
    basis: DMatrix<f64>,
    residual: DVector<f64>,
    space: ElongationSpace,
    spreads: Vec<(PatternVariable, f64)>,
}

impl<'a> Scanner<'a> {
    /// `point`: the terms at which `lin` was made; `except`: one that is to be explained anew.
    pub(crate) fn new(lin: &'a Linearization, point: &ModelPoint, except: Option<&str>) -> Self {
        let mut columns = vec![lin.common_block()];
        let kept = point.active.iter().filter(|a| Some(a.id()) != except);
        columns.extend(kept.map(|a| lin.term_block(a.term.as_ref(), a.rich, a.shape)));
        let basis = orthonormal(beside(&columns));
        let mut residual = target(lin, point);
        project(&basis, &mut residual);
        let twice = WhitenedTwice::of(lin, basis.clone(), residual.clone());
        // Drops of chi-square are the same in any unit.
        let space = ElongationSpace::of(&lin.elongation_readers(), &twice, 1.0);
        let spreads = VARIABLES
            .into_iter()
            .chain([PatternVariable::Line])
            .map(|v| (v, spread(v, &lin.conditions)))
            .collect();
        Self { lin, basis, residual, space, spreads }
    }

    /// Drop of chi-square when these columns are added.
    fn drop(&self, columns: &DMatrix<f64>) -> f64 {
        let overlap = self.basis.tr_mul(columns);
        let b = columns.tr_mul(&self.residual);
        drop_of(columns.tr_mul(columns) - overlap.tr_mul(&overlap), &b)
    }

    /// Shape of a term with the largest drop: the best of the grid, refined between its neighbors.
    pub(crate) fn best_shape(&self, term: &dyn Term, grid: &[f64]) -> f64 {
        let elongations = Elongations::beside(self.lin, &self.basis, &self.residual);
        let alone = |s: f64| elongations.as_ref().and_then(|all| all.drop(term, s));
        let drop = |s: f64| alone(s).unwrap_or_else(|| self.drop(&self.lin.term_block(term, false, s)));
        let waves = elongations.as_ref().and_then(|all| all.drops_of_waves(term, grid));
        let scores = waves.unwrap_or_else(|| parallel::map(grid, |&s| drop(s)));
        let Some(best) = highest(&scores) else { return 1.0 };
        top([grid[best.saturating_sub(1)], grid[(best + 1).min(grid.len() - 1)]], drop)
    }

    /// The best pattern of every family, with the number of patterns it was chosen from: waves common to all legs, waves
    /// in single legs, courses, steps, changes within the file.
    pub(crate) fn patterns(&self, campaign: &Campaign) -> Vec<(Pattern, usize)> {
        let periods = period_grid(&self.lin.conditions);
        let wave = |p: &f64| (PatternVariable::LegLength, Course::Periodic(*p), true);
        let waves: Vec<Kind> = periods.iter().map(wave).collect();
        let variables = variables(campaign, self.lin);
        let courses: Vec<Kind> = variables.iter().flat_map(|v| courses(*v)).collect();
        let steps: Vec<Kind> = variables.iter().flat_map(|v| steps(*v, self.lin)).collect();
        let [waves, courses, steps] = [waves, courses, steps].map(|kinds| self.family(kinds));
        let (common, single) = (0..1, 1..7);
        let families = [(&waves, common), (&waves, single), (&courses, 0..7), (&steps, 0..7)];
        let found = families.into_iter().filter_map(|(family, legs)| self.best_of(family, legs));
        found.chain(follows_the_file(campaign).then(|| self.best_change()).flatten()).collect()
    }

    /// A leg or all legs that yield more or less from one line of the file on, unless readings that are shifted from that line on explain
    /// more.
    fn best_change(&self) -> Option<(Pattern, usize)> {
        let found = self.best_of(&self.family(coarse(&self.cuts())), 0..7)?;
        let (Pattern::Leg(LegPattern { leg, course: Course::Step(at), .. }), _) = found else { return None };
        let by_change = self.drops(change(at))[leg.map_or(0, |leg| leg + 1)];
        (by_change > self.drop_by_shift(at)).then_some(found)
    }

    /// Drop of chi-square where all readings after a line are off by the same twist.
    fn drop_by_shift(&self, cut: f64) -> f64 {
        self.drop(&self.lin.block_of(6, |c, out| {
            let after = f64::from(PatternVariable::Line.value(c, 0) > cut);
            out.extend((0..6).map(|k| Action::Reading(Vector6::ith(k, after))));
        }))
    }

    /// Drops of all kinds.
    fn family(&self, kinds: Vec<Kind>) -> Family {
        let chunks: Vec<&[Kind]> = kinds.chunks(KINDS_AT_ONCE).collect();
        let drops = parallel::map(&chunks, |chunk| self.drops_of(chunk)).concat();
        Family { kinds, drops }
    }

    /// The pattern with the largest drop among kinds and legs (0: all alike), and the number tried.
    fn best_of(&self, Family { kinds, drops }: &Family, legs: Range<usize>) -> Option<(Pattern, usize)> {
        let tried = kinds.len() * legs.len();
        let all = (0..kinds.len()).flat_map(|k| legs.clone().map(move |l| (k, l)));
        let mut unknown = all.filter(|&(k, l)| l > 0 || !in_catalogue(&kinds[k]));
        let largest = unknown.clone().map(|(k, l)| drops[k][l]).fold(0.0, f64::max);
        // Where few readings tell them apart some are alike, and rounding must not choose.
        let (k, l) = unknown.find(|&(k, l)| drops[k][l] >= (1.0 - ALIKE) * largest)?;
        let kind = self.refined(kinds[k], l);
        let leg = l.checked_sub(1);
        let pattern = LegPattern { leg, variable: kind.0, course: kind.1, compliance: kind.2 };
        Some((Pattern::Leg(pattern), tried))
    }

    /// Drop of chi-square when all legs follow a course alike, and when each leg alone does.
    fn drops(&self, kind: Kind) -> [f64; 7] {
        self.drops_of(&[kind])[0]
    }

    /// The same of several kinds.
    fn drops_of(&self, kinds: &[Kind]) -> Vec<[f64; 7]> {
        let columns: Vec<LawColumns> = kinds.iter().map(|kind| self.columns(*kind)).collect();
        let sums = self.space.sums(&columns);
        let legs = |k: usize| std::array::from_fn(|leg| i8::from(k == 0 || leg + 1 == k));
        sums.iter().map(|sums| std::array::from_fn(|k| sums.drop(legs(k)))).collect()
    }

    /// Elongations of the legs by a course; none where its variable does not vary.
    fn columns(&self, (variable, course, compliance): Kind) -> LawColumns {
        let range = self.spreads.iter().find(|s| s.0 == variable).map_or(0.0, |s| s.1);
        if range <= 0.0 {
            return Vec::new();
        }
        let pattern = LegPattern { leg: None, variable, course, compliance };
        let mut columns = vec![Vec::with_capacity(self.lin.conditions.len()); pattern.width()];
        let (mut before, mut courses) = (None, [Vector6::zeros(); 2]);
        for c in &self.lin.conditions {
            // Loads at one pose follow one another.
            let values = pattern.values(c);
            if before != Some(values) {
                (before, courses) = (Some(values), pattern.courses(&values, range));
            }
            for (column, elongations) in columns.iter_mut().zip(pattern.carried(c, courses)) {
                column.push(elongations.into());
            }
        }
        columns
    }

    /// Lines of the file between which the machine may have changed.
    fn cuts(&self) -> Vec<f64> {
        let lines: Vec<f64> = self.lin.conditions.iter().map(|c| PatternVariable::Line.value(c, 0)).collect();
        let inner = BESIDE_A_CHANGE..(lines.len() + 1).saturating_sub(BESIDE_A_CHANGE);
        inner.map(|first| lines[first] - 0.5).collect()
    }

    /// A wave with its period between the grid points on both sides; a change at the best line between those tried.
    fn refined(&self, kind: Kind, leg: usize) -> Kind {
        if let (PatternVariable::Line, Course::Step(at)) = (kind.0, kind.1) {
            return self.refined_change(at, leg);
        }
        let Course::Periodic(period) = kind.1 else { return kind };
        let grid = period_grid(&self.lin.conditions);
        let place = grid.iter().position(|&p| p <= period).unwrap_or(0);
        let (longer, shorter) = (grid[place.saturating_sub(1)], grid[(place + 1).min(grid.len() - 1)]);
        let with = |p: f64| (kind.0, Course::Periodic(p), kind.2);
        with(top([shorter, longer], |p| self.drops(with(p))[leg]))
    }

    fn refined_change(&self, at: f64, leg: usize) -> Kind {
        let cuts = self.cuts();
        let (place, step) = (cuts.partition_point(|&cut| cut < at), cuts.len().div_ceil(CUTS));
        let near = place.saturating_sub(step)..(place + step).min(cuts.len());
        let near = self.family(cuts[near].iter().map(|&cut| change(cut)).collect());
        let of_leg: Vec<f64> = near.drops.iter().map(|drops| drops[leg]).collect();
        highest(&of_leg).map_or(change(at), |best| near.kinds[best])
    }
}

/// Variable, course, and whether it is a compliance.
type Kind = (PatternVariable, Course, bool);

/// Kinds that compete with one another, with their drops of chi-square, for all legs alike and for each alone.
struct Family {
    kinds: Vec<Kind>,
    drops: Vec<[f64; 7]>,
}

fn highest(scores: &[f64]) -> Option<usize> {
    (0..scores.len()).max_by(|&a, &b| scores[a].total_cmp(&scores[b]))
}

/// Place of the top of a peak between two points.
fn top(ends: [f64; 2], f: impl Fn(f64) -> f64) -> f64 {
    let Ok(found) = golden(ends, GOLDEN_STEPS, |x| Ok::<_, Infallible>(f(x)));
    found
}

/// Variables that vary in these data.
fn variables(campaign: &Campaign, lin: &Linearization) -> Vec<PatternVariable> {
    let is_stated = |v: &PatternVariable| match v {
        PatternVariable::Elapsed => campaign.columns.elapsed,
        PatternVariable::DeltaT => campaign.columns.delta_t,
        _ => true,
    };
    let varies = |v: &PatternVariable| spread(*v, &lin.conditions) > 0.0;
    VARIABLES.into_iter().filter(|v| is_stated(v) && varies(v)).collect()
}

fn courses(variable: PatternVariable) -> Vec<Kind> {
    let courses = [Course::Linear, Course::Quadratic];
    courses.into_iter().flat_map(|c| [(variable, c, false), (variable, c, true)]).collect()
}

/// What all legs do and a term describes: compliance in proportion to length, length to temperature.
fn in_catalogue(&(variable, course, compliance): &Kind) -> bool {
    let known = [(PatternVariable::LegLength, true), (PatternVariable::DeltaT, false)];
    course == Course::Linear && known.contains(&(variable, compliance))
}

fn steps(variable: PatternVariable, lin: &Linearization) -> Vec<Kind> {
    use PatternVariable::{Height, LegForce, Tilt};
    if matches!(variable, LegForce | Tilt | Height) {
        return Vec::new();
    }
    let cuts = thresholds(variable, lin);
    cuts.into_iter()
        .flat_map(|at| [(variable, Course::Step(at), false), (variable, Course::Step(at), true)])
        .collect()
}

/// A compliance that is another one from this line of the file on.
fn change(cut: f64) -> Kind {
    (PatternVariable::Line, Course::Step(cut), true)
}

/// Changes at some of these cuts, evenly.
fn coarse(cuts: &[f64]) -> Vec<Kind> {
    cuts.iter().step_by(cuts.len().div_ceil(CUTS).max(1)).map(|&cut| change(cut)).collect()
}

/// True where the repeats of every condition stand together, so that the conditions have the order of the readings.
fn follows_the_file(campaign: &Campaign) -> bool {
    let stands_together = |rows: &[u32]| rows.windows(2).all(|pair| pair[1] == pair[0] + 1);
    campaign.groups.iter().all(|group| stands_together(&group.rows))
}

/// Values between which a step may lie: the twentieths of the variable.
fn thresholds(variable: PatternVariable, lin: &Linearization) -> Vec<f64> {
    let per_leg = |c| (0..6).map(move |leg| variable.value(c, leg));
    let mut values: Vec<f64> = lin.conditions.iter().flat_map(per_leg).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    let n = values.len();
    if n < 4 {
        return Vec::new();
    }
    let mut cuts: Vec<f64> = (1..20).map(|k| values[(k * n / 20).min(n - 2)]).collect();
    cuts.dedup();
    cuts
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Hexapod, Measurand, Metrology};

    use super::*;
    use crate::estimation::tolerances::within_tolerances;
    use crate::test_machine::readings;

    #[test]
    fn patterns_drop_chi_square_beside_errors_of_inputs_as_their_columns_do() {
        let metrology = Some(Metrology { sigma_translation: 0.3e-6, sigma_rotation: 2e-6 });
        let (machine, mut data) = readings(Measurand::DeflectionEuler, Vec::new());
        for (o, k) in data.observations.iter_mut().zip(1_u8..) {
            o.measured[usize::from(k) % 6] += 2e-6;
        }
        let campaign = within_tolerances(Campaign::new(&Hexapod { metrology, ..machine }, &data).unwrap());
        let point = ModelPoint { compliances: Vector6::repeat(1e-7), ..ModelPoint::start(&campaign) };
        let lin = Linearization::at(&campaign, &point).unwrap();
        assert!(lin.whitened_out().is_some_and(|taken| taken.ncols() > 10));
        let scanner = Scanner::new(&lin, &point, None);
        let kinds = [
            (PatternVariable::LegLength, Course::Periodic(0.004), true),
            (PatternVariable::LegForce, Course::Quadratic, false),
        ];
        for (kind, drops) in kinds.into_iter().zip(scanner.drops_of(&kinds)) {
            let range = spread(kind.0, &lin.conditions);
            for (k, drop) in drops.into_iter().enumerate() {
                let pattern = LegPattern {
                    leg: k.checked_sub(1),
                    variable: kind.0,
                    course: kind.1,
                    compliance: kind.2,
                };
                let columns = lin.block_of(pattern.width(), |at, out| pattern.actions(at, range, out));
                let expected = scanner.drop(&columns);
                // What errors of inputs leave of so few readings is a four-thousandth, and what a column keeps at least is a share of all.
                assert!((drop / expected - 1.0).abs() < 1e-4, "{kind:?} {k}: {drop} {expected}");
            }
        }
    }
}
