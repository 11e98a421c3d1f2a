//! Whether a misstatement matters: springs alone fitted to the files as meant and as written.

use hexbench_model::error::ModelError;
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::inference::selection::{FitWithErrors, JudgedTask};
use serde::{Deserialize, Serialize};

use super::files::ReadFiles;

/// Share by which a chi-square or a standard deviation changes that does not stay the same.
const MISFIT: f64 = 0.2;
/// Standard deviations by which a stiffness moves that does not stay the same ...
const SIGMAS: f64 = 5.0;
/// ... and the share of it.
const SHARE: f64 = 0.02;

/// Six springs fitted to the readings to learn from.
#[derive(Debug)]
pub(super) struct PlainFit {
    chi2: [f64; 2],
    compliances: [f64; 6],
    std: [f64; 6],
    copies: usize,
}

impl PlainFit {
    pub(super) fn of(files: &ReadFiles) -> Result<Self, ModelError> {
        let campaign = Campaign::new(&files.hexapod, &files.measurements)?;
        let task = JudgedTask {
            hexapod: &files.hexapod,
            data: &files.measurements,
            campaign: &campaign,
            holdout: Some(&files.holdout),
        };
        let FitWithErrors { fit, held_out, .. } = task.fit(&[])?;
        Ok(Self {
            chi2: [fit.chi2_reduced(), held_out.map_or(f64::NAN, |errors| errors.summary.chi2_reduced)],
            compliances: fit.point.compliances.into(),
            std: std::array::from_fn(|leg| fit.std(leg)),
            copies: files.copies(),
        })
    }
}

/// What a misstatement changes of the plain answer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlainChange {
    /// Chi-square of the springs per degree of freedom, on the readings to learn from and per number on those held out, as meant.
    pub meant: [f64; 2],
    /// The same as written.
    pub written: [f64; 2],
    /// True when a compliance moves by more than five of its standard deviations and 2 %.
    pub moves_stiffness: bool,
    /// True when the standard deviation of a compliance changes by more than 20 %.
    pub moves_std: bool,
    /// True when a compliance falls below zero that was above.
    pub turns_sign: bool,
    /// True when readings repeat others to the last digit that did not.
    pub copies: bool,
}

impl PlainChange {
    pub(super) fn between(meant: &PlainFit, written: &PlainFit) -> Self {
        let any = |test: &dyn Fn(usize) -> bool| (0..6).any(test);
        let moved = |leg: usize| (written.compliances[leg] - meant.compliances[leg]).abs();
        let is_moved = |leg: usize| {
            moved(leg) > SIGMAS * meant.std[leg] && moved(leg) > SHARE * meant.compliances[leg].abs()
        };
        Self {
            meant: meant.chi2,
            written: written.chi2,
            moves_stiffness: any(&is_moved),
            moves_std: any(&|leg| differs(meant.std[leg], written.std[leg])),
            turns_sign: any(&|leg| meant.compliances[leg] > 0.0 && written.compliances[leg] < 0.0),
            copies: written.copies > meant.copies,
        }
    }

    /// True when chi-square changes by more than 20 %, on the readings to learn from or on those held out.
    pub fn changes_misfit(&self) -> bool {
        (0..2).any(|k| differs(self.meant[k], self.written[k]))
    }

    /// True when the answer is another one, or readings pass for more than they are. Else no data can show the misstatement.
    pub fn matters(&self) -> bool {
        self.changes_misfit() || self.moves_stiffness || self.moves_std || self.copies
    }

    /// True when it matters and leaves no trace in the misfit, in signs or in copies: the answer is wrong, and looks right.
    pub fn looks_right(&self) -> bool {
        self.matters() && !self.changes_misfit() && !self.turns_sign && !self.copies
    }
}

/// True when two positive numbers are more than 20 % apart, or only one of them is a number.
fn differs(a: f64, b: f64) -> bool {
    match (a.is_finite(), b.is_finite()) {
        (true, true) => a.max(b) > (1.0 + MISFIT) * a.min(b),
        (one, other) => one != other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fit(chi2: f64, compliances: [f64; 6]) -> PlainFit {
        PlainFit { chi2: [chi2, 1.0], compliances, std: [1e-3; 6], copies: 0 }
    }

    #[test]
    fn a_fifth_of_the_misfit_or_five_sigma_of_a_stiffness_matters_and_less_does_not() {
        let meant = fit(1.0, [1.0; 6]);
        let with = |written: &PlainFit| PlainChange::between(&meant, written);
        assert!(!with(&fit(1.1, [1.001; 6])).matters());
        assert!(with(&fit(1.3, [1.0; 6])).changes_misfit() && with(&fit(0.7, [1.0; 6])).changes_misfit());
        let moved = with(&fit(1.0, [1.0, 1.0, 1.03, 1.0, 1.0, 1.0]));
        assert!(moved.matters() && moved.looks_right());
        let turned = with(&fit(1.0, [-1.0; 6]));
        assert!(turned.matters() && !turned.looks_right());
    }

    #[test]
    fn many_sigmas_of_less_than_two_percent_do_not_matter() {
        let meant = PlainFit { std: [1e-6; 6], ..fit(1.0, [1.0; 6]) };
        let written = PlainFit { std: [1e-6; 6], ..fit(1.0, [1.01; 6]) };
        assert!(!PlainChange::between(&meant, &written).matters());
    }

    #[test]
    fn a_misfit_that_is_no_number_differs_from_any() {
        assert!(differs(f64::NAN, 1.0) && !differs(f64::NAN, f64::NAN) && differs(1.0, f64::INFINITY));
    }
}
