//! What every candidate would tell.

use std::sync::Arc;

use hexbench_core::parallel;
use hexbench_core::{Channel, Dataset, Hexapod, Sensor, StatedTolerances, Vector6};
use hexbench_model::effects::sizes::sizes;
use hexbench_model::effects::term::{Natural, Term};
use hexbench_model::effects::untestable::why_untestable;
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::natural;
use hexbench_model::estimation::linearization::{Linearization, ModelPoint, beside};
use hexbench_model::estimation::noise::stated_or_repeated;
use hexbench_model::estimation::nuisance::{ShownInputs, marginal};
use hexbench_model::estimation::parameters::stiffness_name;
use hexbench_model::estimation::tolerances::{InputKind, input_columns};
use nalgebra::{DMatrix, DVector};

use super::CandidateSensor;
use crate::{Criterion, DesignError, Objective};

/// Changes of leg force below this count as none, N.
const NO_FORCE_N: f64 = 1e-9;

/// Candidates with what each would tell of springs, terms and inputs, every one read in every row of a plan.
///
/// A spring counts in relative changes of its compliance, a parameter of a term in natural sizes, an input in its tolerance.
#[derive(Debug, Clone)]
pub struct Offer {
    /// Information of each candidate: parameters, then combinations of inputs.
    pub information: Vec<DMatrix<f64>>,
    /// What sensors tell that stand there anyway.
    pub known: DMatrix<f64>,
    /// Cost of each candidate.
    pub costs: Vec<f64>,
    /// Numbers that each candidate reads in all rows together.
    pub numbers: Vec<usize>,
    /// Rows of the plan.
    pub readings: usize,
    /// Names of the parameters.
    pub names: Vec<String>,
    /// Natural sizes of the parameters of each term, SI.
    pub sizes: Vec<Vec<f64>>,
    /// How well joints, loads and axes are assumed to be known.
    pub tolerances: StatedTolerances,
}

/// Machine and plan that sensors are to be added to.
struct Bench<'a> {
    hexapod: &'a Hexapod,
    plan: &'a Dataset,
    springs: Vector6,
    terms: &'a [(Arc<dyn Term>, Option<f64>)],
}

/// Some sensors linearized together.
struct Sensed {
    campaign: Campaign,
    lin: Linearization,
    natural: Natural,
    /// Rows of parameters and common inputs.
    common: DMatrix<f64>,
    /// Rows of the inputs of the sensors themselves.
    own: DMatrix<f64>,
}

impl Offer {
    /// Candidates for a machine whose legs have these compliances (m/N), beside the sensors that it has already; with terms, each at a
    /// shape, or at the middle one of those it would be tried with.
    ///
    /// # Errors
    /// [`DesignError::Model`]: a singular pose, or no row that changes the force of any leg; [`DesignError::CannotShow`] for a term
    /// that the plan cannot test at all.
    pub fn of(
        hexapod: &Hexapod,
        plan: &Dataset,
        springs: Vector6,
        terms: &[(Arc<dyn Term>, Option<f64>)],
        candidates: &[CandidateSensor],
    ) -> Result<Self, DesignError> {
        let bench = Bench { hexapod, plan, springs, terms };
        let sensors: Vec<Sensor> =
            candidates.iter().map(|c| c.sensor.clone()).chain(hexapod.sensors.iter().cloned()).collect();
        let blocks = in_blocks(&sensors);
        let first = bench.sensed(blocks[0])?;
        bench.refuse(&first)?;
        let each: Vec<Vec<DMatrix<f64>>> = parallel::try_map(&blocks, |b| bench.informations(b))?;
        let parameters = bench.parameters();
        let (mut information, combinations) = shown(&each.concat(), parameters);
        let known = information.split_off(candidates.len());
        let width = parameters + combinations;
        Ok(Self {
            known: known.iter().fold(DMatrix::zeros(width, width), |sum, m| sum + m),
            information,
            costs: candidates.iter().map(|c| c.cost).collect(),
            numbers: candidates.iter().map(|c| c.sensor.kind.numbers() * plan.observations.len()).collect(),
            readings: plan.observations.len(),
            names: bench.names(),
            sizes: bench
                .terms
                .iter()
                .map(|(t, shape)| sizes_of(t.as_ref(), *shape, &first.natural))
                .collect(),
            tolerances: StatedTolerances::from(&hexapod.tolerances),
        })
    }

    /// Candidates whose rows are given, one column for each parameter; all inputs exact, every cost 1.
    pub fn of_rows(rows: &[DMatrix<f64>]) -> Self {
        let p = rows.first().map_or(0, DMatrix::ncols);
        Self {
            information: rows.iter().map(|j| j.tr_mul(j)).collect(),
            known: DMatrix::zeros(p, p),
            costs: vec![1.0; rows.len()],
            numbers: rows.iter().map(DMatrix::nrows).collect(),
            readings: 1,
            names: (1..=p).map(|k| k.to_string()).collect(),
            sizes: Vec::new(),
            tolerances: StatedTolerances::from(&hexbench_core::Tolerances::default()),
        }
    }

    /// Number of candidates.
    pub fn candidates(&self) -> usize {
        self.information.len()
    }

    /// Number of parameters.
    pub fn parameters(&self) -> usize {
        self.names.len()
    }

    /// Number of combinations of inputs that are known to a tolerance only.
    pub fn inputs(&self) -> usize {
        self.known.nrows() - self.parameters()
    }

    /// Information of a set of candidates, and of the sensors there are.
    pub fn sum(&self, members: &[usize]) -> DMatrix<f64> {
        members.iter().fold(self.known.clone(), |sum, &k| sum + &self.information[k])
    }

    /// A criterion of the parameters; `B` of I is the mean information of all that the candidates could read, so that its value is the
    /// inverse summed variance of what a fit predicts for them, in units of their noise.
    pub fn objective(&self, criterion: Criterion) -> Objective {
        let p = self.parameters();
        let mean = || {
            let whole =
                self.information.iter().fold(DMatrix::zeros(p, p), |sum, m| sum + m.view((0, 0), (p, p)));
            whole / self.numbers.iter().sum::<usize>().max(1) as f64
        };
        criterion.over(mean, self.inputs())
    }
}

/// Sensors that fill six channels at most.
fn in_blocks(sensors: &[Sensor]) -> Vec<&[Sensor]> {
    let (mut blocks, mut first, mut numbers) = (Vec::new(), 0, 0);
    for (k, sensor) in sensors.iter().enumerate() {
        if numbers + sensor.kind.numbers() > 6 {
            blocks.push(&sensors[first..k]);
            (first, numbers) = (k, 0);
        }
        numbers += sensor.kind.numbers();
    }
    blocks.push(&sensors[first..]);
    blocks
}

impl Bench<'_> {
    fn parameters(&self) -> usize {
        6 + self.terms.iter().map(|(t, _)| t.info().parameters.len()).sum::<usize>()
    }

    fn names(&self) -> Vec<String> {
        let own = |(t, _): &(Arc<dyn Term>, Option<f64>)| {
            let info = t.info();
            info.parameters.iter().map(move |p| format!("{}.{}", info.id, p.name)).collect::<Vec<_>>()
        };
        (0..6).map(stiffness_name).chain(self.terms.iter().flat_map(own)).collect()
    }

    fn sensed(&self, sensors: &[Sensor]) -> Result<Sensed, DesignError> {
        let hexapod = Hexapod { sensors: sensors.to_vec(), ..self.hexapod.clone() };
        let rows = self.plan.to_be_read_by(sensors);
        let noise = stated_or_repeated(&hexapod, &rows).ok_or(ModelError::NoLoad)?;
        let campaign = Campaign::with_noise(&hexapod, &rows, noise)?;
        let point = ModelPoint { compliances: self.springs, ..ModelPoint::start(&campaign) };
        let lin = Linearization::at(&campaign, &point)?;
        let natural = natural(&point, &lin);
        let inputs = input_columns(&campaign, &point, &hexapod.tolerances)?;
        let mut parts = vec![
            lin.common_block() * DMatrix::from_diagonal(&DVector::from_column_slice(self.springs.as_slice())),
        ];
        parts.extend(
            self.terms.iter().map(|(term, shape)| scaled_block(&lin, &natural, term.as_ref(), *shape)),
        );
        parts.push(inputs.columns(0, InputKind::COLUMNS).into_owned());
        let own = inputs.columns(InputKind::COLUMNS, inputs.ncols() - InputKind::COLUMNS).into_owned();
        Ok(Sensed { campaign, lin, natural, common: beside(&parts), own })
    }

    /// Refuses a plan that tells nothing, of springs or of a term.
    fn refuse(&self, first: &Sensed) -> Result<(), DesignError> {
        if first.lin.conditions.iter().all(|c| c.force_change().amax() < NO_FORCE_N) {
            return Err(ModelError::NoLoad.into());
        }
        for (term, _) in self.terms {
            if let Some(why) = why_untestable(term.as_ref(), &first.campaign, &first.lin) {
                return Err(DesignError::CannotShow { term: term.info().id, why: why.to_string() });
            }
        }
        Ok(())
    }

    /// Information of each of some sensors; errors of its own place and direction are taken out.
    fn informations(&self, sensors: &[Sensor]) -> Result<Vec<DMatrix<f64>>, DesignError> {
        let sensed = self.sensed(sensors)?;
        let reads = |index: usize| {
            let is_it = move |channel: &Channel| matches!(channel, Channel::Sensor { sensor, .. } if *sensor == index);
            let groups = sensed.campaign.groups.iter().enumerate();
            groups.flat_map(move |(i, g)| {
                (0..6).filter(move |&k| is_it(&g.channels[k])).map(move |k| 6 * i + k)
            })
        };
        Ok((0..sensors.len())
            .map(|index| {
                let rows: Vec<usize> = reads(index).collect();
                let [a, u] = [&sensed.common, &sensed.own].map(|m| m.select_rows(&rows));
                without_own(&a, &u)
            })
            .collect())
    }
}

/// Natural sizes of a term with a shape, or without one.
fn sizes_of(term: &dyn Term, shape: Option<f64>, natural: &Natural) -> Vec<f64> {
    sizes(term, false, shape.unwrap_or(1.0), natural)
}

/// Columns of a term in natural sizes.
fn scaled_block(lin: &Linearization, natural: &Natural, term: &dyn Term, shape: Option<f64>) -> DMatrix<f64> {
    let middle = || {
        let grid = term.shape_grid(&lin.conditions);
        grid.get(grid.len() / 2).copied().unwrap_or(1.0)
    };
    let mut block = lin.term_block(term, false, shape.unwrap_or_else(middle));
    for (mut column, size) in block.column_iter_mut().zip(sizes_of(term, shape, natural)) {
        column *= size;
    }
    block
}

/// `A' (I + U U')^-1 A`.
fn without_own(a: &DMatrix<f64>, u: &DMatrix<f64>) -> DMatrix<f64> {
    let both = beside(&[a.clone(), u.clone()]);
    let own = marginal(&both.tr_mul(&both), a.ncols());
    (&own + own.transpose()) * 0.5
}

/// The same in combinations of inputs, those alone whose errors show in any candidate; how many there are.
fn shown(information: &[DMatrix<f64>], parameters: usize) -> (Vec<DMatrix<f64>>, usize) {
    let inputs = InputKind::COLUMNS;
    let of_inputs = |m: &DMatrix<f64>| m.view((parameters, parameters), (inputs, inputs)).into_owned();
    let whole = information.iter().fold(DMatrix::zeros(inputs, inputs), |sum, m| sum + of_inputs(m));
    let eigen = whole.symmetric_eigen();
    let root = DMatrix::from_diagonal(&eigen.eigenvalues.map(|l| l.max(0.0).sqrt()))
        * eigen.eigenvectors.transpose();
    let combinations = ShownInputs::of(&root).combinations;
    let width = parameters + combinations.ncols();
    let mut change = DMatrix::zeros(parameters + inputs, width);
    change.view_mut((0, 0), (parameters, parameters)).fill_with_identity();
    change.view_mut((parameters, parameters), combinations.shape()).copy_from(&combinations);
    let changed = parallel::map(information, |m| change.tr_mul(m) * &change);
    (changed, combinations.ncols())
}
