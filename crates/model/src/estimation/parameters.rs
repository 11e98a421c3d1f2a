//! The parameter vector: which numbers a model has, in which order, where each acts and what is known of it beforehand.
//!
//! Everything with one entry per number follows from it: the columns of the regressor, the covariance, the names in files
//! and messages. The values themselves are where they act, in the `ModelPoint`.

use hexbench_core::pairs_of_six;
use nalgebra::{DMatrix, DVector};

use crate::effects::term::{Rich, Term};
use crate::estimation::fit::TermSpec;
use crate::estimation::linearization::{Active, ModelPoint};

/// Number of legs: their springs come first.
const LEGS: usize = 6;
/// Numbers of the two frames of the instrument, after the springs.
const FRAMES: usize = 12;
/// Names of the components of a small motion.
const AXES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
/// Prior standard deviation of the logarithm of a shape about its start.
const SHAPE_PRIOR: f64 = 0.7;
/// Farthest a logarithm of a shape moves in one step: its columns are far from linear in it.
const LARGEST_SHAPE_STEP: f64 = 0.3;
/// N/m to N/um.
const STIFFNESS_PER_SI: f64 = 1e-6;

/// Where a parameter acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterPlace {
    /// Compliance of a leg, counted from zero, m/N.
    Spring(usize),
    /// Component of the small motions `[metrology frame; target frame]`, m and rad.
    Frames(usize),
    /// Value of a term, SI.
    Value {
        /// Which term of the model.
        term: usize,
        /// Which of its values.
        index: usize,
    },
    /// Logarithm of the shape of a term.
    Shape {
        /// Which term of the model.
        term: usize,
    },
}

/// What is known of a parameter before the data: a Gaussian about a value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// SI; of a shape the shape itself, not its logarithm.
    pub center: f64,
    /// Standard deviation, SI; of a shape that of its logarithm.
    pub width: f64,
}

/// One number of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// As in the covariance of a model file: `leg 1`, `metrology frame rx`, `base-compliance.rotation-x`.
    pub name: String,
    /// Unit of the number that people read.
    pub unit: &'static str,
    /// That number = SI value * `per_si`; of a spring it is the stiffness.
    pub per_si: f64,
    /// Where it acts.
    pub place: ParameterPlace,
    /// None for what only the data may tell.
    pub prior: Option<Prior>,
}

/// A number as people read it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shown {
    /// In the unit of the parameter.
    pub value: f64,
    /// Standard uncertainty, likewise.
    pub std: f64,
}

impl Parameter {
    /// Name of the number that people read; none for frames, which are a convention.
    pub fn quantity(&self) -> Option<String> {
        match self.place {
            ParameterPlace::Spring(leg) => Some(stiffness_name(leg)),
            ParameterPlace::Frames(_) => None,
            ParameterPlace::Value { .. } | ParameterPlace::Shape { .. } => Some(self.name.clone()),
        }
    }

    /// The number that people read, from its SI value and the standard deviation in the covariance: `k = 1 / c` with
    /// `std(k) = std(c) k^2`; of a shape the covariance holds the logarithm.
    pub fn shown(&self, value: f64, std: f64) -> Shown {
        let (value, std) = match self.place {
            ParameterPlace::Spring(_) => (1.0 / value, std * (1.0 / value) * (1.0 / value)),
            ParameterPlace::Frames(_) | ParameterPlace::Value { .. } => (value, std),
            ParameterPlace::Shape { .. } => (value, std * value),
        };
        Shown { value: value * self.per_si, std: std * self.per_si }
    }

    /// SI value at a point; zero for frames, whose motions start anew at every point.
    pub fn value(&self, point: &ModelPoint) -> f64 {
        match self.place {
            ParameterPlace::Spring(leg) => point.compliances[leg],
            ParameterPlace::Frames(_) => 0.0,
            ParameterPlace::Value { term, index } => point.active[term].values[index],
            ParameterPlace::Shape { term } => point.active[term].shape,
        }
    }

    /// Distance from the center of the prior in its widths; zero without one.
    fn surprise(&self, point: &ModelPoint) -> f64 {
        let Some(Prior { center, width }) = self.prior else { return 0.0 };
        let value = self.value(point);
        match self.place {
            ParameterPlace::Shape { .. } => (value / center).ln() / width,
            ParameterPlace::Spring(_) | ParameterPlace::Frames(_) | ParameterPlace::Value { .. } => {
                (value - center) / width
            }
        }
    }
}

/// The numbers of a model: springs, in absolute mode the two frames, then values and shape of each term.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Parameters(Vec<Parameter>);

impl Parameters {
    /// Those of the terms at a point, without priors; `absolute` when the frames of the instrument are estimated.
    pub fn at(point: &ModelPoint, absolute: bool) -> Self {
        let mut all: Vec<Parameter> = (0..LEGS).map(spring).collect();
        all.extend((0..common_count(absolute) - LEGS).map(frame_component));
        for (term, active) in point.active.iter().enumerate() {
            all.extend(of_active(term, active));
        }
        Self(all)
    }

    /// The same with the priors that come with the terms.
    #[must_use]
    pub fn with_priors(mut self, terms: &[TermSpec]) -> Self {
        for p in &mut self.0 {
            p.prior = match p.place {
                ParameterPlace::Spring(_) | ParameterPlace::Frames(_) => None,
                ParameterPlace::Value { term, index } => {
                    Some(Prior { center: 0.0, width: terms[term].prior[index] })
                }
                ParameterPlace::Shape { term } => {
                    Some(Prior { center: terms[term].shape, width: SHAPE_PRIOR })
                }
            };
        }
        self
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// True when there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// In the order of the columns.
    pub fn iter(&self) -> std::slice::Iter<'_, Parameter> {
        self.0.iter()
    }

    /// Columns of the values and the shape of a term.
    pub fn of_term(&self, term: usize) -> std::ops::Range<usize> {
        let is_of = |p: &Parameter| match p.place {
            ParameterPlace::Value { term: of, .. } | ParameterPlace::Shape { term: of } => of == term,
            ParameterPlace::Spring(_) | ParameterPlace::Frames(_) => false,
        };
        let first = self.0.iter().position(is_of).unwrap_or(self.len());
        first..first + self.0[first..].iter().take_while(|p| is_of(p)).count()
    }

    /// Columns of the values of a term, without its shape.
    pub fn values_of_term(&self, term: usize) -> std::ops::Range<usize> {
        let all = self.of_term(term);
        all.start..self.shape_of_term(term).unwrap_or(all.end)
    }

    /// Column of the shape of a term, when it has one.
    pub fn shape_of_term(&self, term: usize) -> Option<usize> {
        self.of_term(term).find(|&k| matches!(self.0[k].place, ParameterPlace::Shape { .. }))
    }

    /// True for the column of a frame: where the machine stands in the room is a convention.
    pub fn is_frame(&self, column: usize) -> bool {
        self.0.get(column).is_some_and(|p| matches!(p.place, ParameterPlace::Frames(_)))
    }

    /// The priors as equations of unit weight, `(value - center + x) / width = 0`: rows and right-hand sides.
    pub fn prior_equations(&self, point: &ModelPoint) -> (DMatrix<f64>, DVector<f64>) {
        let known: Vec<(usize, &Parameter, f64)> = self.0.iter().enumerate().filter_map(with_width).collect();
        let mut rows = DMatrix::zeros(known.len(), self.len());
        for (i, (column, _, width)) in known.iter().enumerate() {
            rows[(i, *column)] = 1.0 / width;
        }
        (rows, DVector::from_iterator(known.len(), known.iter().map(|(_, p, _)| -p.surprise(point))))
    }

    /// Number of parameters that the priors hold and not the data: `sum variance / width^2`, each at most one.
    pub fn held_by_priors(&self, covariance: &DMatrix<f64>) -> f64 {
        let known = self.0.iter().enumerate().filter_map(with_width);
        known.map(|(k, _, width)| (covariance[(k, k)] / width.powi(2)).clamp(0.0, 1.0)).sum()
    }

    /// What the priors add to chi-square.
    pub fn penalty(&self, point: &ModelPoint) -> f64 {
        self.0.iter().map(|p| p.surprise(point).powi(2)).sum()
    }

    /// A point moved by the increments of all parameters.
    pub fn moved(&self, point: &ModelPoint, increments: &[f64]) -> ModelPoint {
        let mut next = point.clone();
        let mut frames = [0.0; FRAMES];
        for (p, &step) in self.0.iter().zip(increments) {
            match p.place {
                ParameterPlace::Spring(leg) => next.compliances[leg] += step,
                ParameterPlace::Frames(k) => frames[k] = step,
                ParameterPlace::Value { term, index } => next.active[term].values[index] += step,
                ParameterPlace::Shape { term } => {
                    let active = &mut next.active[term];
                    let step = step.clamp(-LARGEST_SHAPE_STEP, LARGEST_SHAPE_STEP);
                    move_shape(active, active.shape * step.exp());
                }
            }
        }
        if self.0.iter().any(|p| matches!(p.place, ParameterPlace::Frames(_))) {
            next.move_frames(&frames);
        }
        next.active.iter_mut().for_each(keep_shape);
        next
    }
}

impl std::ops::Index<usize> for Parameters {
    type Output = Parameter;

    fn index(&self, column: usize) -> &Parameter {
        &self.0[column]
    }
}

impl<'a> IntoIterator for &'a Parameters {
    type Item = &'a Parameter;
    type IntoIter = std::slice::Iter<'a, Parameter>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

fn with_width((column, p): (usize, &Parameter)) -> Option<(usize, &Parameter, f64)> {
    p.prior.map(|prior| (column, p, prior.width))
}

/// A shape that is a value stays equal to it, as far as its bounds allow.
fn keep_shape(active: &mut Active) {
    if active.term.shape_is_parameter() {
        move_shape(active, active.values[0]);
    }
}

/// To a value, or the bound on the way there.
fn move_shape(active: &mut Active, to: f64) {
    let [low, high] = active.term.shape_bounds(active.shape);
    active.shape = to.clamp(low, high);
}

/// Numbers that every model has.
pub fn common_count(absolute: bool) -> usize {
    if absolute { LEGS + FRAMES } else { LEGS }
}

/// Name of the stiffness of a leg, counted from zero.
pub fn stiffness_name(leg: usize) -> String {
    format!("leg-{}.stiffness", leg + 1)
}

/// The leg, counted from zero, of a name that [`stiffness_name`] gives.
pub fn leg_of_stiffness(name: &str) -> Option<usize> {
    (0..LEGS).find(|&leg| stiffness_name(leg) == name)
}

/// True when the shape of a term is a column of its own.
pub fn has_shape_column(term: &dyn Term) -> bool {
    term.info().shape.is_some() && !term.shape_is_parameter()
}

fn spring(leg: usize) -> Parameter {
    Parameter {
        name: format!("leg {}", leg + 1),
        unit: "N/um",
        per_si: STIFFNESS_PER_SI,
        place: ParameterPlace::Spring(leg),
        prior: None,
    }
}

fn frame_component(k: usize) -> Parameter {
    let (frame, axis) = (["metrology frame", "target frame"][k / LEGS], k % LEGS);
    let (unit, per_si) = if axis < 3 { ("um", 1e6) } else { ("urad", 1e6) };
    Parameter {
        name: format!("{frame} {}", AXES[axis]),
        unit,
        per_si,
        place: ParameterPlace::Frames(k),
        prior: None,
    }
}

fn of_active(term: usize, active: &Active) -> Vec<Parameter> {
    let id = active.id();
    let value = |(index, (name, unit, per_si)): (usize, (String, &'static str, f64))| Parameter {
        name: format!("{id}.{name}"),
        unit,
        per_si,
        place: ParameterPlace::Value { term, index },
        prior: None,
    };
    let mut all: Vec<Parameter> = parameter_names(active).into_iter().enumerate().map(value).collect();
    if let Some(shape) = active.term.info().shape.filter(|_| has_shape_column(active.term.as_ref())) {
        all.push(Parameter {
            name: format!("{id}.{}", shape.name),
            unit: shape.unit,
            per_si: shape.per_si,
            place: ParameterPlace::Shape { term },
            prior: None,
        });
    }
    all
}

/// Name, unit and factor from SI of every linear parameter of an active term, ideal ones first.
pub fn parameter_names(a: &Active) -> Vec<(String, &'static str, f64)> {
    let ideal = a.term.info().parameters;
    let of_ideal = ideal.iter().map(|p| (p.name.to_owned(), p.unit, p.per_si));
    let richer = (0..a.values.len().saturating_sub(ideal.len())).map(|k| rich_parameter(a, k));
    of_ideal.chain(richer).collect()
}

/// Name, unit and conversion of the parameters of a richer form.
fn rich_parameter(a: &Active, k: usize) -> (String, &'static str, f64) {
    let info = a.term.info();
    if info.rich == Rich::PerLeg {
        let p = &info.parameters[0];
        return (format!("leg-{}.{}", k + 1, p.name), p.unit, p.per_si);
    }
    let (i, j) = cross_pair(k);
    let (unit, per_si) = match (i < 3, j < 3) {
        (true, true) => ("nm/N", 1e9),
        (false, false) => ("urad/(N m)", 1e6),
        _ => ("urad/N", 1e6),
    };
    (format!("cross-{}-{}", AXES[i], AXES[j]), unit, per_si)
}

/// Indices of the k-th off-diagonal element of a symmetric 6x6 matrix, row by row.
fn cross_pair(k: usize) -> (usize, usize) {
    pairs_of_six().nth(k).unwrap_or((0, 1))
}
