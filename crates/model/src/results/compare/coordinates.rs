//! Error of every measured coordinate or sensor beside the noise, and its bias.

use hexbench_core::statistics::{mean, root_mean_square, standard_deviation};
use hexbench_core::{Channel, NumberKind, Observation};
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::estimation::campaign::{Campaign, row_sigma};
use crate::estimation::linearization::Linearization;
use crate::estimation::residuals::Residual;

/// One measured coordinate, or one number of a sensor; um or urad.
#[derive(Debug, Clone, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Coordinate {
    /// Name: that of its column, without unit.
    pub name: String,
    /// Unit of the numbers.
    pub unit: &'static str,
    /// How often it was read.
    pub readings: usize,
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

/// All of them, in the order of the columns.
pub fn coordinates(
    campaign: &Campaign,
    rows: &[Residual],
    readings: &[Observation],
    lin: &Linearization,
) -> Vec<Coordinate> {
    let channels = campaign.blocks.iter().flatten().copied().filter(|channel| *channel != Channel::Nothing);
    channels.map(|channel| coordinate(campaign, rows, readings, lin, channel)).collect()
}

fn coordinate(
    campaign: &Campaign,
    rows: &[Residual],
    readings: &[Observation],
    lin: &Linearization,
    channel: Channel,
) -> Coordinate {
    let groups = &campaign.groups;
    let place = |group: usize| groups[group].channels.iter().position(|c| *c == channel);
    let read: Vec<(f64, f64)> = rows
        .iter()
        .filter_map(|r| Some((r, place(r.condition)?)))
        .filter(|(r, k)| r.kinds[*k] != NumberKind::Unread)
        .map(|(r, k)| (r.value[k], row_sigma(&readings[r.row], &campaign.noise)[k]))
        .collect();
    let of_group = |i: usize| {
        let k = place(i).filter(|&k| groups[i].reads[k] > 0)?;
        Some(lin.conditions[i].weights.numbers(lin.residual(i))[k])
    };
    let means: Vec<f64> = (0..groups.len()).filter_map(of_group).collect();
    let (bias, t, p) = bias(&means);
    let noise = root_mean_square(read.iter().map(|r| r.1));
    Coordinate {
        name: channel.name(&campaign.hexapod.sensors, campaign.measurand),
        unit: channel.unit(&campaign.hexapod.sensors),
        readings: read.len(),
        rms: root_mean_square(read.iter().map(|r| r.0)).unwrap_or(0.0) * 1e6,
        noise: noise.unwrap_or(0.0) * 1e6,
        bias: bias * 1e6,
        t,
        p,
    }
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
