//! A plan as the model sees it before anything is measured.

use hexbench_core::{Dataset, Hexapod, StatedTolerances, Vector6};
use hexbench_model::effects::term::{Natural, Term};
use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::natural;
use hexbench_model::estimation::linearization::{Linearization, ModelPoint};
use hexbench_model::estimation::noise::Noise;
use hexbench_model::estimation::tolerances::within_tolerances_at;
use hexbench_model::inference::absorption::Absorption;
use nalgebra::DVector;

use crate::DesignError;

/// Changes of leg force below this count as none, N.
const NO_FORCE_N: f64 = 1e-9;

/// A plan linearized at what plain springs would let it read, by inputs as good as the tolerances of the machine.
pub struct Planned {
    /// The plan with the readings expected of springs alone.
    pub campaign: Campaign,
    /// Springs, nothing else.
    pub point: ModelPoint,
    /// The model there.
    pub lin: Linearization,
    /// Sizes natural to machine and plan.
    pub natural: Natural,
    /// What springs (and frames) absorb.
    pub absorption: Absorption,
}

impl Planned {
    /// A plan for a machine whose legs have these compliances (m/N), read with this noise. Measured values of the plan do not
    /// matter.
    ///
    /// # Errors
    /// [`DesignError::Model`]: a singular pose, or no row that changes the force of any leg.
    pub fn new(
        hexapod: &Hexapod,
        plan: &Dataset,
        springs: Vector6,
        noise: Noise,
    ) -> Result<Self, DesignError> {
        let undeflected = with_readings(plan, |_| [0.0; 6]);
        let first = linearized(hexapod, &undeflected, springs, noise)?;
        let deflections = deflections(&first, plan.observations.len());
        let expected = with_readings(plan, |row| deflections[row].into());
        let (campaign, point, lin) = linearized(hexapod, &expected, springs, noise)?;
        if lin.conditions.iter().all(|c| c.force_change().amax() < NO_FORCE_N) {
            return Err(ModelError::NoLoad.into());
        }
        Self::of(within_tolerances_at(campaign, &point), point)
    }

    /// The same plan as if every input were exact.
    ///
    /// # Errors
    /// As [`Planned::new`].
    pub fn with_exact_inputs(&self) -> Result<Self, DesignError> {
        Self::of(Campaign { inexact: None, ..self.campaign.clone() }, self.point.clone())
    }

    fn of(campaign: Campaign, point: ModelPoint) -> Result<Self, DesignError> {
        let lin = Linearization::at(&campaign, &point)?;
        let (natural, absorption) = (natural(&point, &lin), Absorption::of(&lin));
        Ok(Self { campaign, point, lin, natural, absorption })
    }

    /// The tolerances that the plan assumes; none where inputs count as exact, because no error of them shows or poses are absolute.
    pub fn tolerances(&self) -> Option<StatedTolerances> {
        self.campaign.assumed_tolerances()
    }

    /// Condition number of the whitened columns of the springs (and frames) at unit length.
    pub fn condition(&self) -> f64 {
        let mut columns = self.lin.common_block();
        columns.column_iter_mut().for_each(|mut c| {
            c.normalize_mut();
        });
        let singular = columns.singular_values();
        singular.max() / singular.min()
    }

    /// Whitened signature of parameter values (SI) of a term at a shape, springs included.
    pub fn signature(&self, term: &dyn Term, shape: f64, values: &[f64]) -> DVector<f64> {
        self.lin.term_block(term, false, shape) * DVector::from_column_slice(values)
    }
}

/// The plan with what is added to the undeflected reading of each row.
fn with_readings(plan: &Dataset, deflection: impl Fn(usize) -> [f64; 6]) -> Dataset {
    let absolute = plan.is_absolute();
    let mut expected = plan.clone();
    for (row, o) in expected.observations.iter_mut().enumerate() {
        let still = if absolute { o.pose.to_array() } else { [0.0; 6] };
        let added = deflection(row);
        o.measured = std::array::from_fn(|k| still[k] + added[k]);
    }
    expected
}

type Linearized = (Campaign, ModelPoint, Linearization);

fn linearized(
    hexapod: &Hexapod,
    plan: &Dataset,
    springs: Vector6,
    noise: Noise,
) -> Result<Linearized, DesignError> {
    let campaign = Campaign::with_noise(hexapod, plan, noise)?;
    let point = ModelPoint { compliances: springs, ..ModelPoint::start(&campaign) };
    let lin = Linearization::at(&campaign, &point)?;
    Ok((campaign, point, lin))
}

/// What springs let every row read, m and rad.
fn deflections((campaign, _, lin): &Linearized, rows: usize) -> Vec<Vector6> {
    let predicted = lin.predictions();
    let mut all = vec![Vector6::zeros(); rows];
    for (i, (group, at)) in campaign.groups.iter().zip(&lin.conditions).enumerate() {
        let reading = at.weights.numbers(predicted.fixed_rows::<6>(6 * i).into_owned());
        group.rows.iter().for_each(|&row| all[row as usize] = reading);
    }
    all
}
