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
use crate::estimation::load_response::{LoadResponse, sizes_of_load};
use crate::estimation::noise::Structure;

/// Chance that loads scatter about what is written.
const SCATTERED: f64 = 0.02;
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
    /// Loads that scatter, where that can be told at all.
    pub(super) loads: Option<Statement>,
}

/// The statements about conditions; `stated`, `others`: evidence of the noise as stated, and of the best statement about anything else.
pub(super) fn of_conditions(rest: &Remainder<'_>, judge: &Judge, [stated, others]: [f64; 2]) -> OfConditions {
    let of_legs = Shapes::of_legs(rest);
    let [law, wide] = [&SIZES[..], &WIDE_SIZES].map(|sizes| Law::best(judge, &of_legs, sizes));
    let mut loads = Loads::best(rest, judge);
    if let Some(loads) = &mut loads {
        let best = law.evidence.max(others);
        if loads.evidence > best - CLOSE * (best.max(loads.evidence) - stated) {
            told_apart(rest, &law, loads);
        }
    }
    let loads = loads.map(|loads| loads.statement(rest));
    OfConditions { law: law.statement(), wide_law: wide.statement(), loads }
}

/// Compares a law and loads with all that the catalogue could explain fitted beside them, which gives the size of the loads' scatter too;
/// the evidence of the law stays.
fn told_apart(rest: &Remainder<'_>, law: &Law<'_>, loads: &mut Loads) {
    let exact = Restricted::of(rest);
    let of_law = |[size]: [f64; 1]| exact.evidence(|g| law.shapes.scaled(g, law.way) * size);
    let of_loads = |[force, moment]: [f64; 2]| {
        let sizes = Matrix6::from_diagonal(&sizes_of_load(force, moment));
        exact.evidence(|g| loads.by_load[g] * sizes)
    };
    let (Some((best_law, _)), Some((best_loads, [force, moment]))) =
        (climbed([law.size], of_law), climbed([loads.force, loads.moment], of_loads))
    else {
        return;
    };
    (loads.force, loads.moment) = (force, moment);
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

/// What numbers of a reading gain, at every condition, per unit of six things that scatter.
struct Shapes {
    by_condition: Vec<Matrix6<f64>>,
    /// Which of the six may scatter: each of these, or, for none, all of them.
    ways: &'static [Option<usize>],
    /// Mean over conditions of what each number gains.
    size: f64,
}

/// All, or any of them alone.
const EACH: [Option<usize>; 7] = [None, Some(0), Some(1), Some(2), Some(3), Some(4), Some(5)];
/// The first: the only one.
const TOGETHER: [Option<usize>; 1] = [Some(0)];

impl Shapes {
    fn new(by_condition: Vec<Matrix6<f64>>, ways: &'static [Option<usize>]) -> Self {
        let sum: f64 = by_condition.iter().map(Matrix6::norm).sum();
        let size = (sum / (6.0_f64.sqrt() * by_condition.len() as f64)).max(1e-300);
        Self { by_condition, ways, size }
    }

    /// Of elongations of the legs, of the same size everywhere or in proportion to the change of leg force; of each leg by itself, or of
    /// all together.
    fn of_legs(rest: &Remainder<'_>) -> [Self; 4] {
        let readers = rest.lin.elongation_readers();
        let force = |g: usize| rest.lin.conditions[g].force_change();
        let sum: f64 = (0..readers.len()).map(|g| force(g).abs().sum()).sum();
        let mean = (sum / (6.0 * readers.len().max(1) as f64)).max(1e-12);
        let ones = |_: usize| Vector6::repeat(1.0);
        let forces = |g: usize| force(g) / mean;
        [
            Self::new(of_each(&readers, ones), &EACH),
            Self::new(of_each(&readers, forces), &EACH),
            Self::new(of_all(&readers, ones), &TOGETHER),
            Self::new(of_all(&readers, forces), &TOGETHER),
        ]
    }

    /// At one condition, what scatters in one of the ways.
    fn scaled(&self, condition: usize, way: Option<usize>) -> Matrix6<f64> {
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
    let first = |(g, reader): (usize, &Matrix6<f64>)| {
        let mut shape = Matrix6::zeros();
        shape.set_column(0, &(reader * scale(g)));
        shape
    };
    readers.iter().enumerate().map(first).collect()
}

/// Extra elongations of one leg or of all.
struct Law<'a> {
    shapes: &'a Shapes,
    way: Option<usize>,
    size: f64,
    evidence: f64,
}

impl<'a> Law<'a> {
    fn best(judge: &Judge, of_legs: &'a [Shapes], sizes: &[f64]) -> Self {
        let mut best = Self { shapes: &of_legs[0], way: None, size: 0.0, evidence: f64::NEG_INFINITY };
        for shapes in of_legs {
            for &way in shapes.ways {
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
struct Loads {
    /// What numbers gain per newton of every force, and per newton meter of every moment.
    by_load: Vec<Matrix6<f64>>,
    /// Standard deviation of each force, N.
    force: f64,
    /// That of each moment, N m.
    moment: f64,
    evidence: f64,
}

impl Loads {
    /// None where neither repeats nor a stated noise tell that there is more: physics without a name looks the same.
    fn best(rest: &Remainder<'_>, judge: &Judge) -> Option<Self> {
        let expected = rest.lin.numbers();
        if !judge.knows_noise() || judge.between() < expected + (2.0 * expected).sqrt() {
            return None;
        }
        let by_load = rest.lin.load_readers();
        let radius = rest.campaign.hexapod.platform_radius();
        let mut best = Self { by_load, force: 0.0, moment: 0.0, evidence: f64::NEG_INFINITY };
        let mut sizes = SIZES.to_vec();
        for (k, arm) in ARMS.map(|share| share * radius).into_iter().enumerate() {
            let unit = Matrix6::from_diagonal(&sizes_of_load(1.0, arm));
            let shapes = Shapes::new(best.by_load.iter().map(|shape| shape * unit).collect(), &EACH);
            for force in sizes.iter().map(|size| size / shapes.size) {
                let evidence = judge.scattered_by(&shapes.by_condition, None, force) + SCATTERED.ln()
                    - judge.penalty(2.0);
                if evidence > best.evidence {
                    (best.force, best.moment, best.evidence) = (force, force * arm, evidence);
                }
            }
            if k == 0 {
                sizes = [0.6, 1.0, 1.7].map(|factor| factor * best.force * shapes.size).to_vec();
            }
        }
        Some(best)
    }

    fn statement(&self, rest: &Remainder<'_>) -> Statement {
        let response = LoadResponse::of(&rest.lin, &rest.point.compliances);
        let Self { force, moment, evidence, .. } = *self;
        let kind = Kind::Common(Structure::Loads { force, moment, response });
        Statement { kind, level: 1.0, evidence }
    }
}
