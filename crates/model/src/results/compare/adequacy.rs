//! Is the model adequate? Chi-square against the stated noise, and lack of fit against pure error.
//!
//! With repeats, the residual sum of squares splits into pure error (scatter of readings under equal conditions) and lack
//! of fit (distance of their means from the model). The ratio of their mean squares follows F when the model is right,
//! whatever the noise level. Source: Draper and Smith, Applied Regression Analysis, 3rd ed. 1998, ch. 2.

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

use super::JudgedModel;
use crate::estimation::foreseen::Misfit;
use crate::estimation::noise::{NoiseLevel, NoiseSource};

/// A test with its chance under a right model.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct AdequacyTest {
    /// Chi-square or F.
    pub statistic: f64,
    /// Degrees of freedom (of the numerator for F).
    pub dof: f64,
    /// Degrees of freedom of the denominator of F.
    pub dof_noise: Option<f64>,
    /// Chance of a larger statistic if the model is right.
    pub p: f64,
}

/// Tests of the model as a whole.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Adequacy {
    /// Averaged readings against the stated noise, which is known to its tolerance; absent when no level is stated.
    pub lack_of_fit_chi2: Option<AdequacyTest>,
    /// Averaged readings against the scatter of repeats; absent without repeats.
    pub lack_of_fit_f: Option<AdequacyTest>,
    /// Scatter of repeats against the stated noise: does the statement hold?
    pub repeats_chi2: Option<AdequacyTest>,
}

/// What the tests say of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AdequacyAnswer {
    /// The error is noise, as far as the readings tell.
    Adequate,
    /// Something is missing.
    NotAdequate,
    /// The error is noise on the readings compared, and more on those held out.
    NotHeldOut,
    /// Nothing can be said: no noise level is stated and nothing is repeated.
    Open,
}

/// Chance below which a model is not adequate.
const LEAST_CHANCE: f64 = 0.01;

impl Adequacy {
    /// Name and result of every test that the data allow.
    pub fn tests(&self) -> impl Iterator<Item = (&'static str, AdequacyTest)> {
        let all = [
            ("averages against the stated noise", self.lack_of_fit_chi2),
            ("averages against repeats (F)", self.lack_of_fit_f),
            ("repeats against the stated noise", self.repeats_chi2),
        ];
        all.into_iter().filter_map(|(name, t)| Some((name, t?)))
    }

    /// What they say together.
    pub fn answer(&self) -> AdequacyAnswer {
        let of_fit = [self.lack_of_fit_f, self.lack_of_fit_chi2].into_iter().flatten();
        let least = of_fit.map(|t| t.p).fold(1.0, f64::min);
        match self.tests().next() {
            _ if least < LEAST_CHANCE => AdequacyAnswer::NotAdequate,
            None => AdequacyAnswer::Open,
            Some(_) => AdequacyAnswer::Adequate,
        }
    }
}

/// All tests the data allow.
pub fn adequacy(judged: &JudgedModel<'_>) -> Adequacy {
    let lack = judged.lin.residuals().norm_squared();
    let dof = judged.lin.numbers() - judged.rank;
    let (pure, pure_dof) = (judged.campaign.pure_error, judged.campaign.pure_error_dof);
    let noise = judged.campaign.noise;
    let campaign = judged.campaign;
    let against = |square, dof, level| noise.is_stated().then(|| chi2_test(square, dof, level)).flatten();
    let by_repeats = (noise.source == NoiseSource::Repeats).then(|| f_test(lack, dof, noise.dof, noise.dof));
    Adequacy {
        lack_of_fit_chi2: against(lack, dof, campaign.noise_level()),
        lack_of_fit_f: by_repeats.unwrap_or_else(|| f_test(lack, dof, pure, pure_dof)),
        repeats_chi2: against(pure, pure_dof, campaign.stated_level()),
    }
}

/// Chi-square test against a noise of which so much is known.
pub fn chi2_test(statistic: f64, dof: f64, level: NoiseLevel) -> Option<AdequacyTest> {
    let usable = dof > 0.0 && statistic.is_finite();
    let p = usable.then(|| Misfit { chi2: statistic, numbers: dof }.chance(level).ok()).flatten()?;
    Some(AdequacyTest { statistic, dof, dof_noise: None, p })
}

/// F test of two sums of squares.
pub fn f_test(above: f64, dof: f64, below: f64, dof_noise: f64) -> Option<AdequacyTest> {
    let statistic = (above / dof) / (below / dof_noise);
    let usable = dof > 0.0 && dof_noise > 0.0 && below > 0.0 && statistic.is_finite();
    let law = FisherSnedecor::new(dof, dof_noise).ok().filter(|_| usable)?;
    Some(AdequacyTest { statistic, dof, dof_noise: Some(dof_noise), p: law.sf(statistic) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tests_meet_their_tables() {
        // 5 % points of the tables: chi-square(10) 18.307, F(4, 20) 2.866.
        assert!((chi2_test(18.307, 10.0, NoiseLevel::EXACT).unwrap().p - 0.05).abs() < 1e-5);
        // A level that 20 degrees of freedom tell: the same F.
        let level = NoiseLevel { sum: 20.0, dof: 20.0 };
        assert!((chi2_test(4.0 * 2.866, 4.0, level).unwrap().p - 0.05).abs() < 1e-4);
        assert!((f_test(4.0 * 2.866, 4.0, 20.0, 20.0).unwrap().p - 0.05).abs() < 1e-4);
        assert!(f_test(1.0, 4.0, 0.0, 20.0).is_none());
    }
}
