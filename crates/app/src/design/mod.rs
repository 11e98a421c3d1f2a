//! `hexbench design`: which poses and readings determine the parameters best.

mod chosen_loads;
mod conditions;
mod page;
mod plan;
mod search;
mod sensors;

use std::path::Path;
use std::sync::Arc;

use hexbench_core::{Hexapod, StatedTolerances};
use hexbench_design::budget::{Amount, Budget};
use hexbench_design::nominal;
use hexbench_design::regressor::{ModelRegressor, SpringRegressor, Weights};
use hexbench_design::space::Setting;
use hexbench_design::space_file::read_space;
use hexbench_design::{Criterion, Space, Visit, noise_to_come};
use hexbench_model::effects::term::Term;
use hexbench_model::estimation::fit_named::term_named;
use hexbench_model::estimation::noise::Noise;
use hexbench_model::estimation::parameters::stiffness_name;
use hexbench_model::terms::catalogue;
use nalgebra::DMatrix;

use crate::Failure;
pub use page::page;
use search::Bench;
pub use search::StartedSearch;
pub use sensors::{ChosenSensors, SensorWish, choose_sensors};

/// Combinations of inputs that a search for a plan weighs: the errors that matter most. Its time grows with the square of parameters
/// and combinations. The uncertainties of what it finds weigh all of them.
const SEARCHED_INPUTS: usize = 12;

/// What somebody wants of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Wish {
    /// Number of poses, each read under every load and condition; 3 unless said.
    pub poses: Option<u16>,
    /// Readings of each pose under each load and condition.
    pub repeats: u16,
    /// Choose so many readings instead.
    pub readings: Option<u16>,
    /// Choose readings that together take so many hours.
    pub hours: Option<f64>,
    /// Poses to choose readings from.
    pub candidates: u16,
    /// What makes a plan good; O1 for poses, D for readings and hours unless said.
    pub criterion: Option<Criterion>,
    /// Terms of the catalogue that the plan has to determine too.
    pub terms: Vec<String>,
    /// Further terms whose conditions the plan varies.
    pub shown: Vec<String>,
    /// Searches from different starts; 16 unless said, 128 for poses whose inputs count as exact.
    pub starts: Option<u16>,
    /// Seed of the starts.
    pub seed: u32,
}

impl Default for Wish {
    fn default() -> Self {
        Self {
            poses: None,
            repeats: 3,
            readings: None,
            hours: None,
            candidates: 256,
            criterion: None,
            terms: Vec::new(),
            shown: Vec::new(),
            starts: None,
            seed: 1,
        }
    }
}

/// A plan found.
pub struct Designed {
    /// Name of the criterion.
    pub criterion: &'static str,
    /// Its value at the optimum.
    pub best: f64,
    /// Its value for the rounded poses.
    pub value: f64,
    /// Information matrix of the rounded poses; inputs count as exact.
    pub information: DMatrix<f64>,
    /// The same when joints, loads and axes are as good as the tolerances of the machine; none without a stated noise.
    pub within_tolerances: Option<DMatrix<f64>>,
    /// Those tolerances.
    pub tolerances: StatedTolerances,
    /// The parameters.
    pub parameters: Vec<Quantity>,
    /// Where poses were looked for.
    pub space: Space,
    /// Rounded poses with their readings.
    pub visits: Vec<Visit>,
    /// What the readings are taken under.
    pub settings: Vec<Setting>,
    /// Poses asked for, where their number was.
    pub poses_asked: Option<usize>,
    /// Which conditions of the space are not varied, and why.
    pub settled: Option<String>,
    /// What it may cost.
    pub budget: Budget,
    /// Poses chosen from.
    pub candidates: Option<usize>,
    /// Least share of the budget that the best plan needs for the same.
    pub efficiency: Option<f64>,
    /// Starts; those that ended at a plan; those that agree with the best.
    pub starts: [usize; 3],
    /// By which sensors everything is read, where the machine has some.
    pub read_by: Option<String>,
    /// True when rows are in units of the stated noise.
    pub weighted: bool,
    /// Seed of the starts.
    pub seed: u32,
}

/// A parameter; one column of the regressor is `size` of it.
pub struct Quantity {
    /// Name.
    pub name: String,
    /// Unit.
    pub unit: &'static str,
    /// Size in that unit.
    pub size: f64,
}

/// Searches a plan for a machine within a space file.
///
/// # Errors
/// [`Failure::File`], [`Failure::Usage`], [`Failure::Model`] for a term that does not exist, [`Failure::Cause`].
pub fn design(
    hexapod: &Hexapod,
    space: &Path,
    wish: &Wish,
    begun: &StartedSearch<'_>,
) -> Result<Designed, Failure> {
    let mut space = read_space(space, hexapod)?;
    if wish.poses.is_some() {
        space.budget.limit = None;
    }
    space.budget.limit = asked(wish)?.or(space.budget.limit);
    // An exchange takes readings one by one: it begins among the corners of what is chosen freely.
    let space = if space.budget.limit.is_some() { space.at_corners() } else { space };
    let terms = wanted(&wish.terms)?;
    let vary: Vec<Arc<dyn Term>> = terms.iter().cloned().chain(wanted(&wish.shown)?).collect();
    let mut space = space;
    let settled = conditions::settle(&mut space.conditions, &vary);
    let weights = weights(hexapod);
    let settings = space.settings();
    let stated = noise_to_come(hexapod);
    let noise = stated.unwrap_or(Noise::stated(1.0, 1.0));
    let nominal = nominal::compliance(hexapod);
    let exact = ModelRegressor::new(hexapod, nominal, noise, &terms, &settings, 1)?;
    let promised = springs(hexapod).into_iter().chain(sized(&terms, exact.sizes())).collect();
    // Without a noise, errors of inputs have nothing to be compared with.
    let within = |most| exact.clone().within_tolerances(&space, most);
    let all = stated.map(|_| within(usize::MAX)).transpose()?;
    let bench = Bench { wish, begun, hexapod, space: &space, inexact: all.as_ref() };
    let found = match &all {
        Some(_) if bench.criterion() != Criterion::O1 => bench.design(&within(SEARCHED_INPUTS)?, promised),
        // Closed forms are those of full poses.
        _ if terms.is_empty() && hexapod.sensors.is_empty() => {
            bench.design(&SpringRegressor::new(hexapod, &settings, 1, weights), promised)
        }
        _ => bench.design(&exact, promised),
    };
    found.map(|found| Designed { settled, ..found })
}

/// The budget that is asked for.
fn asked(wish: &Wish) -> Result<Option<Amount>, Failure> {
    const SECONDS: f64 = 3600.0;
    match wish.hours {
        Some(hours) if !(hours.is_finite() && hours > 0.0) => Err(Failure::usage(
            format!("--hours {hours}: a budget must be positive"),
            "Enter the available hours, for example --hours 3.",
        )),
        Some(hours) => Ok(Some(Amount::Time(hours * SECONDS))),
        None => Ok(wish.readings.map(|n| Amount::Readings(usize::from(n)))),
    }
}

/// The stiffnesses of the legs.
fn springs(hexapod: &Hexapod) -> Vec<Quantity> {
    let stiffness = nominal::stiffness(hexapod).map(|k| 1e-6 * k);
    (0..)
        .zip(stiffness)
        .map(|(leg, size)| Quantity { name: stiffness_name(leg), unit: "N/um", size })
        .collect()
}

/// The parameters of terms in their natural sizes (SI).
fn sized(terms: &[Arc<dyn Term>], sizes: impl Iterator<Item = f64>) -> Vec<Quantity> {
    let own = |t: &Arc<dyn Term>| {
        let info = t.info();
        info.parameters
            .iter()
            .map(|p| (format!("{}.{}", info.id, p.name), p.unit, p.per_si))
            .collect::<Vec<_>>()
    };
    let all = terms.iter().flat_map(own).zip(sizes);
    all.map(|((name, unit, per_si), size)| Quantity { name, unit, size: size * per_si }).collect()
}

fn wanted(ids: &[String]) -> Result<Vec<Arc<dyn Term>>, Failure> {
    let catalogue = catalogue();
    ids.iter().map(|id| term_named(id, &catalogue).map_err(Failure::of_name)).collect()
}

/// Rows in units of the stated noise, columns in relative changes of the nominal compliance; without a stated noise as in
/// the paper.
fn weights(hexapod: &Hexapod) -> Weights {
    let Some(metrology) = hexapod.metrology else { return Weights::UNWEIGHTED };
    Weights {
        translation: 1.0 / metrology.sigma_translation,
        rotation: 1.0 / metrology.sigma_rotation,
        compliance: nominal::compliance(hexapod).into(),
    }
}
