//! What differs from condition to condition while repeats agree: laws in the legs without a name, and loads that scatter about what is
//! written.
//!
//! First by the likelihood of what the catalogue leaves of the readings; where both explain it nearly as well, by the restricted one of
//! the readings themselves, since the catalogue takes more of one than of the other.

use hexbench_core::Vector6;
use nalgebra::Matrix6;

use super::remainder::Remainder;
use super::restricted::Restricted;
use super::scatter::{Judge, Kind, Statement};
use crate::estimation::load_response::{LoadResponse, LoadScatter};
use crate::estimation::noise::Structure;

/// Chance that loads scatter about what is written; likewise, that a temperature is not written that matters.
const SCATTERED: f64 = 0.02;
/// Share of theirs by which loads are usually off at most.
const USUAL_SHARE: f64 = 0.03;
/// Scatter of moments over that of forces, beside the radius of the platform.
const ARMS: [f64; 5] = [1.0, 0.1, 0.3, 3.0, 10.0];
/// Size of an unknown law in the legs, over the noise.
const SIZES: [f64; 10] = [0.2, 0.35, 0.5, 0.7, 1.0, 1.5, 2.5, 5.0, 10.0, 30.0];
/// The same of files that contradict the model, or themselves, on the whole.
const WIDE_SIZES: [f64; 3] = [300.0, 3e3, 3e4];
/// Factors by which sizes are made larger and smaller on the way to the best.
const STEPS: [f64; 4] = [1.6, 1.25, 1.1, 1.04];
/// Share of what the best statement explains by which loads may be behind it to be compared in full.
const CLOSE: f64 = 0.1;

/// Statements about conditions.
pub(super) struct OfConditions {
    /// The best law in the legs.
    pub(super) law: Statement,
    /// One far larger than the noise.
    pub(super) wide_law: Statement,
    /// Loads that scatter by some size, and by a share of theirs, where that can be told at all.
    pub(super) loads: Vec<Statement>,
    /// Temperatures that nobody wrote down, likewise.
    pub(super) warmth: Option<Statement>,
}

/// The statements about conditions; `stated`, `others`: evidence of the noise as stated, and of the best statement about anything else.
pub(super) fn of_conditions(rest: &Remainder<'_>, judge: &Judge, [stated, others]: [f64; 2]) -> OfConditions {
    let readers = rest.lin.elongation_readers();
    let mut of_legs = shapes_of_laws(rest, &readers);
    let by_length = Shapes::new(of_all(&readers, |g| rest.lin.conditions[g].legs.lengths));
    // Where the temperature is written down, what lengthens all legs alike is a law.
    let mut temperatures = rest.data.observations.iter().map(|o| o.delta_t);
    let first = temperatures.next();
    let warmth = if temperatures.any(|other| Some(other) != first) {
        of_legs.push((by_length, &TOGETHER));
        None
    } else {
        warmth(judge, &by_length)
    };
    let [law, wide] = [&SIZES[..], &WIDE_SIZES].map(|sizes| Law::best(judge, &of_legs, sizes));
    let mut loads = Vec::new();
    if let Some(mut by_size) = Loads::best(rest, judge) {
        let best = law.evidence.max(others);
        if by_size.evidence > best - CLOSE * (best.max(by_size.evidence) - stated) {
            told_apart(rest, &law, &mut by_size);
        }
        loads = by_size.statements(judge);
    }
    OfConditions { law: law.statement(), wide_law: wide.statement(), loads, warmth }
}

/// Compares a law and loads with all that the catalogue could explain fitted beside them, which gives the size of the loads' scatter too;
/// the evidence of the law stays.
fn told_apart(rest: &Remainder<'_>, law: &Law<'_>, loads: &mut Loads<'_>) {
    let exact = Restricted::of(rest);
    let of_law = |[size]: [f64; 1]| exact.evidence(|g| law.shapes.scaled(g, law.way) * size);
    let of_loads = |sizes: [f64; 2]| exact.evidence(|g| loads.scattered(g, LoadScatter::Sizes(sizes)));
    let (Some((best_law, _)), Some((best_loads, sizes))) =
        (climbed([law.size], of_law), climbed(loads.sizes, of_loads))
    else {
        return;
    };
    loads.sizes = sizes;
    loads.evidence = law.evidence + exact.of_all(best_loads - best_law) + SCATTERED.ln() - Law::prior();
}

/// The top of a likelihood near some sizes, and the sizes there: each is tried larger and smaller in ever smaller steps.
fn climbed<const N: usize>(
    start: [f64; N],
    evidence: impl Fn([f64; N]) -> Option<f64>,
) -> Option<(f64, [f64; N])> {
    let mut best = (evidence(start)?, start);
    for step in STEPS {
        for (k, factor) in (0..N).flat_map(|k| [(k, step), (k, step.recip())]) {
            let mut sizes = best.1;
            sizes[k] *= factor;
            best = evidence(sizes).filter(|found| *found > best.0).map_or(best, |found| (found, sizes));
        }
    }
    Some(best)
}

/// Temperatures that nobody wrote down, by which all legs lengthen alike.
fn warmth(judge: &Judge, by_length: &Shapes) -> Option<Statement> {
    if !judge.knows_noise() {
        return None;
    }
    let (best, strain) = by_length.best(judge, Some(0))?;
    let evidence = best + SCATTERED.ln() - judge.penalty(1.0);
    Some(Statement { kind: Kind::Common(Structure::Lengths { strain }), level: 1.0, evidence })
}

/// What numbers of a reading gain, at every condition, per unit of six things that scatter.
struct Shapes {
    by_condition: Vec<Matrix6<f64>>,
    /// Mean over conditions of what each number gains.
    size: f64,
}

/// Which of six things scatters; none: all of them.
type Way = Option<usize>;
/// All, or any of them alone.
const EACH: [Way; 7] = [None, Some(0), Some(1), Some(2), Some(3), Some(4), Some(5)];
/// The first: the only one.
const TOGETHER: [Way; 1] = [Some(0)];

/// Shapes of laws in the legs, and the ways in which each may scatter: of elongations of each leg by itself, of the same size everywhere or in
/// proportion to the change of its force, and of all legs together in that proportion.
fn shapes_of_laws(rest: &Remainder<'_>, readers: &[Matrix6<f64>]) -> Vec<(Shapes, &'static [Way])> {
    let force = |g: usize| rest.lin.conditions[g].force_change();
    let sum: f64 = (0..readers.len()).map(|g| force(g).abs().sum()).sum();
    let mean = (sum / (6.0 * readers.len().max(1) as f64)).max(1e-12);
    let forces = |g: usize| force(g) / mean;
    vec![
        (Shapes::new(of_each(readers, |_| Vector6::repeat(1.0))), &EACH),
        (Shapes::new(of_each(readers, forces)), &EACH),
        (Shapes::new(of_all(readers, forces)), &TOGETHER),
    ]
}

impl Shapes {
    fn new(by_condition: Vec<Matrix6<f64>>) -> Self {
        let sum: f64 = by_condition.iter().map(Matrix6::norm).sum();
        let size = (sum / (6.0_f64.sqrt() * by_condition.len() as f64)).max(1e-300);
        Self { by_condition, size }
    }

    /// The top of the likelihood in one of the ways, and the size there.
    fn best(&self, judge: &Judge, way: Way) -> Option<(f64, f64)> {
        let evidence = |size: f64| judge.scattered_by(&self.by_condition, way, size);
        let sizes = SIZES.map(|share| share / self.size);
        let start = sizes.into_iter().max_by(|a, b| evidence(*a).total_cmp(&evidence(*b)))?;
        climbed([start], |[size]| Some(evidence(size))).map(|(best, [size])| (best, size))
    }

    /// At one condition, what scatters in one of the ways.
    fn scaled(&self, condition: usize, way: Way) -> Matrix6<f64> {
        let only = |k: usize| f64::from(u8::from(way.is_none_or(|one| one == k)));
        self.by_condition[condition] * Matrix6::from_diagonal(&Vector6::from_fn(|k, _| only(k)))
    }
}

/// Every leg changes by an amount of its own.
fn of_each(readers: &[Matrix6<f64>], scale: impl Fn(usize) -> Vector6) -> Vec<Matrix6<f64>> {
    let scaled = |(g, reader): (usize, &Matrix6<f64>)| reader * Matrix6::from_diagonal(&scale(g));
    readers.iter().enumerate().map(scaled).collect()
}

/// All legs change by one amount, as where warmth, time or the pose acts on all alike.
fn of_all(readers: &[Matrix6<f64>], scale: impl Fn(usize) -> Vector6) -> Vec<Matrix6<f64>> {
    let first = |(g, reader): (usize, &Matrix6<f64>)| (reader * scale(g)).fixed_resize::<6, 6>(0.0);
    readers.iter().enumerate().map(first).collect()
}

/// Extra elongations of one leg or of all.
struct Law<'a> {
    shapes: &'a Shapes,
    way: Way,
    size: f64,
    evidence: f64,
}

impl<'a> Law<'a> {
    fn best(judge: &Judge, of_legs: &'a [(Shapes, &[Way])], sizes: &[f64]) -> Self {
        let mut best = Self { shapes: &of_legs[0].0, way: None, size: 0.0, evidence: f64::NEG_INFINITY };
        for (shapes, ways) in of_legs {
            for &way in *ways {
                for size in sizes.iter().map(|share| share / shapes.size) {
                    let evidence = judge.scattered_by(&shapes.by_condition, way, size) - judge.penalty(2.0)
                        + Self::prior();
                    if evidence > best.evidence {
                        best = Self { shapes, way, size, evidence };
                    }
                }
            }
        }
        best
    }

    /// One of all ways.
    fn prior() -> f64 {
        -16.0_f64.ln()
    }

    fn statement(&self) -> Statement {
        Statement { kind: Kind::Law, level: 1.0, evidence: self.evidence }
    }
}

/// Loads that scatter about what is written.
struct Loads<'a> {
    rest: &'a Remainder<'a>,
    /// What numbers gain per newton of every force, and per newton meter of every moment.
    by_load: Vec<Matrix6<f64>>,
    /// Standard deviations of each force, N, and of each moment, N m.
    sizes: [f64; 2],
    evidence: f64,
}

impl<'a> Loads<'a> {
    /// None where neither repeats nor a stated noise tell that there is more: physics without a name looks the same.
    fn best(rest: &'a Remainder<'a>, judge: &Judge) -> Option<Self> {
        // Where conditions scatter by no more than the noise, loads do not scatter.
        let expected = rest.lin.numbers();
        if !judge.knows_noise() || judge.between() < expected + (2.0 * expected).sqrt() {
            return None;
        }
        let radius = rest.campaign.hexapod.platform_radius();
        let by_load = rest.lin.load_readers();
        let mut best = Self { rest, by_load, sizes: [0.0; 2], evidence: f64::NEG_INFINITY };
        let mut sizes = SIZES.to_vec();
        for (k, arm) in ARMS.map(|share| share * radius).into_iter().enumerate() {
            let shapes = best.shapes(LoadScatter::Sizes([1.0, arm]));
            for force in sizes.iter().map(|size| size / shapes.size) {
                let evidence = judge.scattered_by(&shapes.by_condition, None, force) + SCATTERED.ln()
                    - judge.penalty(2.0);
                if evidence > best.evidence {
                    (best.sizes, best.evidence) = ([force, force * arm], evidence);
                }
            }
            if k == 0 {
                sizes = [0.6, 1.0, 1.7].map(|factor| factor * best.sizes[0] * shapes.size).to_vec();
            }
        }
        Some(best)
    }

    /// What the numbers of one condition gain.
    fn scattered(&self, condition: usize, scatter: LoadScatter) -> Matrix6<f64> {
        self.by_load[condition] * scatter.of(&self.rest.lin.conditions[condition].wrench.to_vector())
    }

    fn shapes(&self, scatter: LoadScatter) -> Shapes {
        Shapes::new((0..self.by_load.len()).map(|g| self.scattered(g, scatter)).collect())
    }

    /// By a share of every component, or of all together, and the evidence.
    fn by_share(&self, judge: &Judge) -> (LoadScatter, f64) {
        let ways = [(LoadScatter::Shares as fn(f64) -> LoadScatter, None), (LoadScatter::Factor, Some(0))];
        let of_way = |(scatter, way): (fn(f64) -> LoadScatter, Way)| {
            let shapes = self.shapes(scatter(1.0));
            let usual = |share: f64| -0.5 * (share / USUAL_SHARE).powi(2);
            shapes.best(judge, way).map(|(evidence, share)| (evidence + usual(share), scatter(share)))
        };
        let best = ways.into_iter().filter_map(of_way).max_by(|a, b| a.0.total_cmp(&b.0));
        let (evidence, scatter) = best.unwrap_or((f64::NEG_INFINITY, LoadScatter::Factor(0.0)));
        (scatter, evidence + (SCATTERED / 2.0).ln() - judge.penalty(2.0))
    }

    fn statements(&self, judge: &Judge) -> Vec<Statement> {
        let response = LoadResponse::of(self.rest.lin, &self.rest.point.compliances);
        let told = |(scatter, evidence)| {
            let kind = Kind::Common(Structure::Loads { scatter, response });
            Statement { kind, level: 1.0, evidence }
        };
        [(LoadScatter::Sizes(self.sizes), self.evidence), self.by_share(judge)].map(told).to_vec()
    }
}
