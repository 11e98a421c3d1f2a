//! Error of every measured coordinate beside the noise, and its bias.

use hexbench_core::statistics::{mean, root_mean_square, standard_deviation};
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::{JudgedModel, coordinate_names};

/// One measured coordinate; um or urad.
#[derive(Debug, Clone, Serialize)]
pub struct Coordinate {
    /// Name.
    pub name: &'static str,
    /// Unit of the numbers.
    pub unit: &'static str,
    /// Root mean square residual of single readings.
    pub rms: f64,
    /// Standard deviation of one reading.
    pub noise: f64,
    /// Mean residual over conditions.
    pub bias: f64,
    /// Bias over its standard error, from the scatter of the conditions.
    pub t: Option<f64>,
    /// Chance of a bias this far from zero by scatter alone.
    pub p: Option<f64>,
}

/// All six.
pub fn coordinates(judged: &JudgedModel<'_>) -> Vec<Coordinate> {
    let names = coordinate_names(judged.campaign.measurand);
    let noise = judged.campaign.noise.sigma();
    (0..6).map(|k| coordinate(judged, k, names[k], noise[k])).collect()
}

fn coordinate(judged: &JudgedModel<'_>, k: usize, name: &'static str, noise: f64) -> Coordinate {
    let rms = root_mean_square(judged.rows.iter().map(|r| r.value[k])).unwrap_or(0.0);
    let groups = &judged.campaign.groups;
    let means: Vec<f64> = (0..groups.len()).map(|i| judged.lin.residual(i)[k] * groups[i].sigma[k]).collect();
    let (bias, t, p) = bias(&means);
    let unit = if k < 3 { "um" } else { "urad" };
    Coordinate { name, unit, rms: rms * 1e6, noise: noise * 1e6, bias: bias * 1e6, t, p }
}

/// Mean, t-value and two-sided p of a sample against zero.
fn bias(x: &[f64]) -> (f64, Option<f64>, Option<f64>) {
    let n = x.len() as f64;
    let mean = mean(x.iter().copied()).unwrap_or(0.0);
    let Some(deviation) = standard_deviation(x.iter().copied()).filter(|_| x.len() > 2) else {
        return (mean, None, None);
    };
    let t = mean * n.sqrt() / deviation;
    let law = StudentsT::new(0.0, 1.0, n - 1.0).ok().filter(|_| t.is_finite());
    (mean, Some(t).filter(|t| t.is_finite()), law.map(|law| 2.0 * law.sf(t.abs())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_t_test_of_a_textbook_sample() {
        // SciPy 1.17, ttest_1samp([1, 2, 3, 4, 5], 0): t = 4.242640687, p = 0.013235...
        let (mean, t, p) = bias(&[1.0, 2.0, 3.0, 4.0, 5.0]);
        assert!((mean - 3.0).abs() < 1e-15);
        assert!((t.unwrap() - 4.242_640_687).abs() < 1e-9);
        assert!((p.unwrap() - 0.013_235_6).abs() < 1e-6, "{}", p.unwrap());
    }
}
