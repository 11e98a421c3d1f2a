//! Errors of what is found.

use super::{CHI2, ERRORS, fits, fits_of, share, slug, values};
use crate::calibration::Fate;
use crate::recovery::scene::HiddenSubject;
use crate::regress::limit::{LimitGroup, LimitTest, RegressLimit};

/// Over all campaigns.
pub(super) fn general() -> Vec<RegressLimit> {
    limits! { LimitGroup::Accuracy;
        "stiffness-error" "leg stiffness: relative error"
            ["Leg stiffness is what everything else is for."]
            ERRORS => |t| fits(t, |f| f.stiffness_error);
        "holdout" "held-out chi-square of the right model"
            ["A right model predicts readings it has not seen as well as the noise allows."]
            CHI2 => |t| fits(t, |f| Some(f.holdout));
        "holdout-after-diagnosis" "held-out chi-square of the diagnosed model where the answer is right"
            ["What is named must also predict."]
            CHI2 => |t| values(t, |r| (r.fate == Fate::Right && !r.is_outside()).then_some(r.holdout[1]).flatten());
        "left-open" "campaigns in which numbers are left open by the data"
            ["A number that is no longer determined has no error and no interval: it would leave all other limits unseen."]
            LimitTest::Share => |t| fits(t, |f| Some(share(f.open > 0)));
        "without-answer" "campaigns without an answer"
            ["A campaign that cannot be made, fitted or diagnosed would leave all other limits unseen."]
            LimitTest::Share => |t| {
                let fits = t.fits.iter().map(|f| f.found.is_none());
                let answers = t.answers.iter().map(Option::is_none);
                let laboratories = t.laboratories.iter().map(Option::is_none);
                fits.chain(answers).chain(laboratories).map(share).collect()
            };
    }
}

/// Numbers of one effect.
pub(super) fn of_effect(s: HiddenSubject) -> RegressLimit {
    RegressLimit::new(
        (format!("error:{}", slug(s.name)), LimitGroup::Accuracy),
        format!("{}: relative error of its numbers", s.name),
        "The sizes and shapes of an effect are told to people: they must be right.",
        ERRORS,
        move |t| fits_of(t, s, |f| f.effect_error),
    )
}
