//! Uncertainties against errors.
//!
//! Over all effects together: the few campaigns of one effect, with an outlier now and then, follow no law of which the tail
//! could be trusted.

use hexbench_core::statistics::mean;

use super::{CHI2, fits, share, values};
use crate::calibration::{CalibrationRecord, Fate};
use crate::regress::distance::PulledDistance;
use crate::regress::fitted::Fitted;
use crate::regress::limit::{LimitGroup, LimitTest, RegressLimit};

fn outside(distance: Option<PulledDistance>) -> Option<f64> {
    distance.map(|d| share(d.is_outside()))
}

/// Over all campaigns.
pub(super) fn general() -> Vec<RegressLimit> {
    let per_number = |d: Option<PulledDistance>| d.map(|d| d.per_number());
    limits! { LimitGroup::Honesty;
        "stiffness-pulls" "leg stiffness: mean squared pull of six legs in their covariance"
            ["An honest covariance gives 1; a factor 1.5 on it gives 1.5."]
            LimitTest::Spread => move |t| fits(t, |f| per_number(f.springs));
        "all-pulls" "all numbers: mean squared pull in their covariance"
            ["Leg stiffness and effects together: what is wrong with every uncertainty shows here first."]
            LimitTest::Spread => |t| fits(t, both);
        "stiffness-coverage" "leg stiffness: truth outside the 95 % region of six legs"
            ["A region that claims 95 % must hold the truth in 95 % of the campaigns."]
            LimitTest::Share => |t| fits(t, |f| outside(f.springs));
        "effect-pulls" "effects: mean squared pull in their covariance"
            ["The same for the numbers of effects."]
            LimitTest::Spread => move |t| fits(t, |f| per_number(f.effect));
        "effect-coverage" "effects: truth outside the 95 % region of their numbers"
            ["The same for the numbers of effects."]
            LimitTest::Share => |t| fits(t, |f| outside(f.effect));
        "prediction-coverage" "predictions: held-out readings outside their 95 % region"
            ["Noise and uncertainty of the model together must say how far off a prediction can be."]
            LimitTest::Share => |t| fits(t, |f| Some(share(f.prediction_missed)));
        "fit-chi2" "chi-square of the right model on what it was fitted to"
            ["A solver that stops early, or a term that is slightly wrong, leaves more than the noise."]
            CHI2 => |t| fits(t, |f| Some(f.chi2_reduced));
        "misfits" "campaigns that the right model does not fit"
            ["A misfit has no uncertainties; it would leave the other limits of honesty unseen."]
            LimitTest::Share => |t| fits(t, |f| Some(share(f.misfit)));
        "stiffness-pulls-after-diagnosis" "leg stiffness after a right diagnosis: mean squared pull"
            ["What people read comes from the diagnosis, averaged over shapes and chosen by the search."]
            LimitTest::Spread => |t| values(t, |r| (r.fate == Fate::Right).then(|| mean_square(r)).flatten());
    }
}

fn mean_square(r: &CalibrationRecord) -> Option<f64> {
    mean(r.stiffness_z.iter().flatten().map(|z| z * z)).filter(|_| !r.is_outside())
}

/// Leg compliances and the numbers of the effect.
fn both(f: &Fitted) -> Option<f64> {
    match (f.springs, f.effect) {
        (Some(a), Some(b)) => Some(a.and(b).per_number()),
        (a, b) => a.or(b).map(|d| d.per_number()),
    }
}
