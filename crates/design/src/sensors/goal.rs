//! What makes a set of sensors good.

use std::sync::Arc;

use hexbench_model::effects::term::Term;
use hexbench_model::estimation::nuisance::marginal;
use nalgebra::{DMatrix, DVector};

use super::Offer;
use crate::power::EffectSizes;
use crate::{DesignError, Objective};

/// What a set of sensors is chosen for; larger is better.
#[derive(Debug, Clone)]
pub enum Goal {
    /// A criterion of all parameters.
    Fit(Objective),
    /// An effect beside springs.
    See(Sought),
}

/// An effect that is to be seen beside springs.
///
/// With `S` the information on its parameters that springs and errors of inputs leave, and `s` its parameters at usual size,
///
/// ```text
/// value = sqrt(mean of s' S s)
/// ```
///
/// over effects of all directions: how many standard deviations it stands out. The smallest size that is seen falls as it grows.
#[derive(Debug, Clone)]
pub struct Sought {
    /// Mean of `s s'` in natural sizes.
    spread: DMatrix<f64>,
    inputs: usize,
}

/// Parameters of the springs.
const SPRINGS: usize = 6;

impl Sought {
    /// The term of an effect with the shape of its middle example.
    pub fn term(effect: &EffectSizes) -> (Arc<dyn Term>, Option<f64>) {
        let shape = effect.examples.get(effect.examples.len() / 2).map(|e| e.shape);
        (Arc::clone(&effect.term), shape.filter(|_| effect.term.info().shape.is_some()))
    }

    /// An effect whose term is the only one of an offer.
    pub fn of(effect: &EffectSizes, offer: &Offer) -> Self {
        let sizes = &offer.sizes[0];
        let mut spread = DMatrix::zeros(sizes.len(), sizes.len());
        for example in &effect.examples {
            let s = DVector::from_iterator(sizes.len(), example.values.iter().zip(sizes).map(|(v, n)| v / n));
            spread += &s * s.transpose() / effect.examples.len() as f64;
        }
        Self { spread, inputs: offer.inputs() }
    }

    fn value(&self, information: &DMatrix<f64>) -> f64 {
        let all = information.nrows() - self.inputs;
        let known = marginal(information, all);
        let cross = known.view((0, SPRINGS), (SPRINGS, all - SPRINGS));
        let own = known.view((SPRINGS, SPRINGS), (all - SPRINGS, all - SPRINGS));
        let Some(springs) = known.view((0, 0), (SPRINGS, SPRINGS)).into_owned().cholesky() else {
            return 0.0;
        };
        let left = own - cross.tr_mul(&springs.solve(&cross));
        left.dot(&self.spread).max(0.0).sqrt()
    }
}

impl Goal {
    /// Value for the information of a set read in so many rows; zero where it determines nothing.
    pub fn value(&self, information: &DMatrix<f64>, readings: usize) -> f64 {
        match self {
            Self::Fit(objective) => objective.value(information, readings),
            Self::See(sought) => sought.value(information),
        }
    }

    /// Information on the parameters that have to be determined: all for a criterion, the springs alone for an effect.
    pub fn of_parameters(&self, offer: &Offer, information: &DMatrix<f64>) -> DMatrix<f64> {
        let known = marginal(information, offer.parameters());
        let wanted = match self {
            Self::Fit(_) => offer.parameters(),
            Self::See(_) => SPRINGS,
        };
        known.view((0, 0), (wanted, wanted)).into_owned()
    }

    /// Names of these parameters.
    pub fn names<'a>(&self, offer: &'a Offer) -> &'a [String] {
        match self {
            Self::Fit(_) => &offer.names,
            Self::See(_) => &offer.names[..SPRINGS],
        }
    }

    /// Name of its value.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Fit(objective) => objective.criterion().name(),
            Self::See(_) => "standard deviations seen",
        }
    }
}

/// Refuses candidates that determine nothing even when all are taken (`whole`: their information), or show nothing of an effect.
///
/// # Errors
/// [`DesignError::SensorsNeverDetermine`], [`DesignError::CannotShow`].
pub(super) fn require_any(goal: &Goal, offer: &Offer, whole: &DMatrix<f64>) -> Result<(), DesignError> {
    let names = goal.names(offer);
    let missing = crate::determined::undetermined(&goal.of_parameters(offer, whole));
    if !missing.is_empty() {
        return Err(DesignError::SensorsNeverDetermine {
            candidates: offer.candidates(),
            names: missing.into_iter().map(|k| names[k].clone()).collect(),
        });
    }
    if goal.value(whole, offer.readings) > 0.0 {
        return Ok(());
    }
    let term = offer.names.get(SPRINGS).and_then(|n| n.split_once('.')).map_or("", |n| n.0).to_owned();
    Err(DesignError::NoCandidateShows { term })
}
