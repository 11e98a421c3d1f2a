//! How one effect fares under a plan.

use hexbench_model::effects::sizes::{WIDEST, sizes};
use hexbench_model::inference::absorption::bias_percent;
use nalgebra::DVector;
use serde::Serialize;

use super::{EffectSizes, Example, Planned, PowerSettings, PreparedTest, Reference};

/// Multiples of the usual size beyond this are not looked for.
const MOST: f64 = 1e5;
/// Steps of a power curve.
const STEPS: i32 = 24;
/// A power curve reaches from this share of the size that is seen, or from the usual size, to ...
const CURVE_FROM: f64 = 0.1;
/// ... this multiple of it.
const CURVE_TO: f64 = 3.0;
/// Steps in which the size that is seen is first looked for.
const STRIDE: f64 = 4.0;
/// The same for effects whose signature changes its form with their size: friction that holds all legs leaves none.
const SHORT_STRIDE: f64 = 1.15;

/// Least, middle and most of something over the examples of an effect.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Range {
    /// Smallest.
    pub least: f64,
    /// Of the middle example.
    pub middle: f64,
    /// Largest; infinite values are absent in JSON.
    pub most: f64,
}

/// Whether an effect shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Visibility {
    /// At its usual size.
    Seen,
    /// Only when larger than usual.
    SeenWhenLarger,
    /// At no size that makes physical sense.
    TooFaint,
    /// Springs of other stiffness explain all of it.
    Absorbed,
    /// It does not act in this plan.
    NoTrace,
}

/// The size of one parameter that shows alone.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParameterReach {
    /// Its name.
    pub name: &'static str,
    /// Unit of the size.
    pub unit: &'static str,
    /// Size seen with the wanted power, all other parameters zero; none when no sensible size is.
    pub size: Option<f64>,
}

/// How one effect fares under a plan.
#[derive(Debug, Clone, Serialize)]
pub struct EffectPower {
    /// Id of the term.
    pub term: &'static str,
    /// Whether it shows.
    pub verdict: Visibility,
    /// What multiples of the size refer to.
    pub reference: Reference,
    /// Usual size of the middle example: root mean square of the parameters that have the unit of the first one.
    pub usual_size: f64,
    /// Its unit.
    pub unit: &'static str,
    /// Multiple of the usual size that is seen with the wanted power; over the examples.
    pub seen_at: Range,
    /// The same of the middle example if every input were exact; absent where inputs count as exact anyway, or where none is.
    pub seen_at_with_exact_inputs: Option<f64>,
    /// Largest multiple of the usual size that makes physical sense.
    pub sensible: f64,
    /// Chance to be seen at the usual size.
    pub power_at_usual_size: Range,
    /// Determined parameters: degrees of freedom of the test.
    pub parameters_determined: usize,
    /// Shapes the test tries.
    pub shapes: usize,
    /// Drop of chi-square that counts as seen.
    pub threshold: f64,
    /// Share of the signature (of its sum of squares) that springs absorb, at the usual size.
    pub absorbed: f64,
    /// Change of the leg stiffnesses at the usual size when the effect is left out, percent.
    pub bias_at_usual_size_percent: [f64; 6],
    /// The same at the size that is seen; absent when none is.
    pub bias_when_seen_percent: Option<[f64; 6]>,
    /// Every parameter alone.
    pub parameters: Vec<ParameterReach>,
    /// Multiple of the usual size and power.
    pub curve: Vec<[f64; 2]>,
    /// The middle example at its usual size.
    pub example: Example,
    /// Which of the examples that is.
    #[serde(skip)]
    pub example_index: usize,
}

impl EffectPower {
    /// The effect of a subject under a plan, by its test when there is one.
    pub(super) fn of(
        planned: &Planned,
        subject: &EffectSizes,
        test: Option<&PreparedTest>,
        settings: &PowerSettings,
    ) -> Self {
        let judge = Judge { planned, subject, test, wanted: settings.power };
        let sizes: Vec<f64> = subject.examples.iter().map(|e| judge.seen_at(e)).collect();
        let (index, seen_at) = middle(&sizes);
        let example = &subject.examples[index];
        let info = subject.term.info();
        let unit = info.parameters[0].unit;
        let at_usual = subject.signature(planned, example, 1.0);
        let sensible = subject.sensible(planned, example);
        let verdict = judge.verdict(&at_usual, seen_at.middle, sensible);
        let shows = matches!(verdict, Visibility::Seen | Visibility::SeenWhenLarger);
        Self {
            term: info.id,
            verdict,
            reference: subject.reference,
            usual_size: subject.size(example),
            unit,
            seen_at,
            seen_at_with_exact_inputs: None,
            sensible,
            power_at_usual_size: judge.power_at_usual_size(index),
            parameters_determined: test.map_or(0, PreparedTest::parameters),
            shapes: test.map_or(0, PreparedTest::shapes),
            threshold: test.map_or(f64::INFINITY, PreparedTest::threshold),
            absorbed: planned.absorption.share(&at_usual),
            bias_at_usual_size_percent: judge.bias(example, 1.0),
            bias_when_seen_percent: shows.then(|| judge.bias(example, seen_at.middle)),
            parameters: judge.parameters(example),
            curve: if seen_at.middle.is_finite() { judge.curve(example, seen_at.middle) } else { Vec::new() },
            example: example.clone(),
            example_index: index,
        }
    }

    /// Adds what the same plan would show of the middle example if every input were exact.
    pub(super) fn compare_with_exact(
        &mut self,
        exact: &Planned,
        subject: &EffectSizes,
        settings: &PowerSettings,
    ) {
        let test = PreparedTest::new(exact, subject.term.as_ref(), settings);
        let judge = Judge { planned: exact, subject, test: test.as_ref(), wanted: settings.power };
        let seen_at = judge.seen_at(&self.example);
        self.seen_at_with_exact_inputs = Some(seen_at).filter(|s| s.is_finite());
    }

    /// True when it shows at some sensible size.
    pub fn shows(&self) -> bool {
        matches!(self.verdict, Visibility::Seen | Visibility::SeenWhenLarger)
    }

    /// Size that is seen, in its unit.
    pub fn size_seen(&self) -> Option<f64> {
        self.shows().then_some(self.usual_size * self.seen_at.middle)
    }
}

/// Index of the middle value, and the range.
fn middle(values: &[f64]) -> (usize, Range) {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let at = |k: usize| values[order[k]];
    let half = (order.len() - 1) / 2;
    (order[half], Range { least: at(0), middle: at(half), most: at(order.len() - 1) })
}

/// A subject before its test.
struct Judge<'a> {
    planned: &'a Planned,
    subject: &'a EffectSizes,
    test: Option<&'a PreparedTest>,
    wanted: f64,
}

impl Judge<'_> {
    fn rest(&self, example: &Example, scale: f64) -> DVector<f64> {
        self.planned.absorption.rest(&self.subject.signature(self.planned, example, scale))
    }

    /// Chance to see an example as a function of its scale.
    fn chance_of<'b>(&'b self, example: &'b Example) -> impl Fn(f64) -> f64 + 'b {
        let unit = self.rest(example, 1.0);
        move |scale| {
            let Some(test) = self.test else { return 0.0 };
            if self.subject.is_its_own_shape() {
                test.chance(&self.rest(example, scale))
            } else {
                test.chance(&(&unit * scale))
            }
        }
    }

    /// Multiple of an example that is seen with the wanted power; infinite when none is.
    fn seen_at(&self, example: &Example) -> f64 {
        let stride = if self.subject.is_its_own_shape() { SHORT_STRIDE } else { STRIDE };
        smallest(self.chance_of(example), self.wanted, stride)
    }

    fn verdict(&self, at_usual: &DVector<f64>, seen_at: f64, sensible: f64) -> Visibility {
        if self.test.is_none() || seen_at.is_infinite() {
            return if at_usual.norm() > 0.0 { Visibility::Absorbed } else { Visibility::NoTrace };
        }
        match seen_at {
            s if s > sensible => Visibility::TooFaint,
            s if s > 1.0 => Visibility::SeenWhenLarger,
            _ => Visibility::Seen,
        }
    }

    fn power_at_usual_size(&self, index: usize) -> Range {
        let chances: Vec<f64> = self.subject.examples.iter().map(|e| self.chance_of(e)(1.0)).collect();
        let by = |f: fn(f64, f64) -> f64| chances.iter().copied().reduce(f).unwrap_or(0.0);
        Range { least: by(f64::min), middle: chances[index], most: by(f64::max) }
    }

    fn bias(&self, example: &Example, scale: f64) -> [f64; 6] {
        let signature = self.subject.signature(self.planned, example, scale);
        let shift = self.planned.absorption.shift(&signature);
        shift.map_or([f64::NAN; 6], |shift| bias_percent(&self.planned.point.compliances, &shift))
    }

    fn parameters(&self, middle: &Example) -> Vec<ParameterReach> {
        let natural = sizes(self.subject.term.as_ref(), false, middle.shape, &self.planned.natural);
        let alone = |k: usize| Example {
            values: natural.iter().enumerate().map(|(i, n)| if i == k { *n } else { 0.0 }).collect(),
            shape: middle.shape,
        };
        let parameters = self.subject.term.info().parameters.iter().enumerate();
        let reach = |(k, p): (usize, &hexbench_model::effects::term::ParameterInfo)| {
            let scale = self.seen_at(&alone(k));
            ParameterReach {
                name: p.name,
                unit: p.unit,
                size: (scale <= WIDEST).then_some(scale * natural[k] * p.per_si),
            }
        };
        parameters.map(reach).collect()
    }

    fn curve(&self, example: &Example, seen_at: f64) -> Vec<[f64; 2]> {
        let chance = self.chance_of(example);
        let (from, to) = ((CURVE_FROM * seen_at).min(1.0), CURVE_TO * seen_at.max(1.0));
        let scale = |step: i32| from * (to / from).powf(f64::from(step) / f64::from(STEPS));
        (0..=STEPS).map(scale).map(|s| [s, chance(s)]).collect()
    }
}

/// Smallest scale at which a chance reaches a value, looked for in strides from a hundredth on; infinite when none does.
fn smallest(chance: impl Fn(f64) -> f64, wanted: f64, stride: f64) -> f64 {
    const ROUNDS: usize = 40;
    let (mut low, mut high) = (0.0, 0.01);
    while chance(high) < wanted {
        low = high;
        high *= stride;
        if high > MOST {
            return f64::INFINITY;
        }
    }
    for _ in 0..ROUNDS {
        let middle = f64::midpoint(low, high);
        if chance(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
