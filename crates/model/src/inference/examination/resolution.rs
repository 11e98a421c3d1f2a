//! Readings rounded to a step that matters beside their noise.
//!
//! Every value of a column is then a whole multiple of one decimal step `q`. Rounding errs evenly within half a step on either side,
//! which adds `q^2 / 12` to the variance of a reading (Widrow and Kollar 2008, Quantization Noise, chapter 4). Differences of rounded
//! readings are multiples of the step too. Where the noise is smaller than the step, repeats are rounded alike: with a noise `s` they
//! share the variance of the mean rounding error,
//!
//! ```text
//! q^2 / (2 pi^2)  sum over h = 1, 2, ... of exp(-4 pi^2 h^2 s^2 / q^2) / h^2
//! ```

use std::f64::consts::PI;

use hexbench_core::statistics::{mean, root_mean_square};
use hexbench_core::{Dataset, Measurand};

use super::finding::{Finding, FindingKind};
use crate::estimation::campaign::row_sigma;
use crate::estimation::noise::Noise;

/// Least readings that can tell a step: by chance all of them are multiples of twice the true one in `2^-n` of all cases.
const LEAST_READINGS: usize = 10;
/// A step of fewer standard deviations of the noise adds less than a twelfth to its variance.
const MATTERS: f64 = 1.0;
/// Distance from a whole multiple that decimal fractions have in binary, in steps; beyond it a value is no multiple.
const WHOLE: f64 = 1e-6;
/// Decades below the largest value of a column in which its step is sought.
const DECADES: i32 = 9;
/// Steps within a decade, largest first.
const MANTISSAS: [f64; 3] = [5.0, 2.0, 1.0];

/// A column with the unit in which its file counts.
struct Column {
    name: &'static str,
    unit: &'static str,
    /// SI units in one of it.
    size: f64,
}

impl Column {
    const fn new(name: &'static str, unit: &'static str, size: f64) -> Self {
        Self { name, unit, size }
    }

    /// The six columns of readings of a kind.
    fn all(measurand: Measurand) -> [Self; 6] {
        let [um, urad] = [|name| Self::new(name, "um", 1e-6), |name| Self::new(name, "urad", 1e-6)];
        let mm = |name| Self::new(name, "mm", 1e-3);
        let deg = |name| Self::new(name, "deg", 1_f64.to_radians());
        match measurand {
            Measurand::DeflectionEuler => {
                [um("da"), um("db"), um("dc"), urad("dalpha"), urad("dbeta"), urad("dgamma")]
            }
            Measurand::DeflectionRotationVector => {
                [um("da"), um("db"), um("dc"), urad("drx"), urad("dry"), urad("drz")]
            }
            Measurand::AbsolutePose => [
                mm("measured_a"),
                mm("measured_b"),
                mm("measured_c"),
                deg("measured_alpha"),
                deg("measured_beta"),
                deg("measured_gamma"),
            ],
        }
    }
}

/// Harmonics of the rounding error that are summed: without noise they have 98 % of its variance.
const HARMONICS: i32 = 30;

/// Variance that readings of one true value share when they are rounded to `step` beside a noise `sigma`.
fn shared_variance(step: f64, sigma: f64) -> f64 {
    let harmonic = |h: i32| (-(2.0 * PI * f64::from(h) * sigma / step).powi(2)).exp() / f64::from(h * h);
    if step > 0.0 { step * step / (2.0 * PI * PI) * (1..=HARMONICS).map(harmonic).sum::<f64>() } else { 0.0 }
}

/// Steps of the columns, SI; zero where there is none that matters.
pub(super) struct Resolution {
    steps: [f64; 6],
    /// Share of the variance of a reading that its repeats have in common by rounding.
    pub(super) shared: f64,
    measurand: Measurand,
    readings: usize,
}

impl Resolution {
    /// Of readings with this noise; none when no step matters.
    pub(super) fn of(data: &Dataset, noise: &Noise) -> Option<Self> {
        let rows = &data.observations;
        if rows.len() < LEAST_READINGS || data.has_other_readings() {
            return None;
        }
        let columns = Column::all(data.measurand);
        let sigma = |k: usize| root_mean_square(rows.iter().map(|o| row_sigma(o, noise)[k])).unwrap_or(0.0);
        let step = |k: usize| {
            let values: Vec<f64> = rows.iter().map(|o| o.measured[k] / columns[k].size).collect();
            step(&values).map(|q| q * columns[k].size).filter(|q| *q > MATTERS * sigma(k)).unwrap_or(0.0)
        };
        let steps: [f64; 6] = std::array::from_fn(step);
        let share = |k: usize| {
            let (q, sigma) = (steps[k], sigma(k));
            shared_variance(q, sigma) / (sigma * sigma + q * q / 12.0).max(f64::MIN_POSITIVE)
        };
        let shared = mean((0..6).map(share)).unwrap_or(0.0);
        let any = steps.iter().any(|q| *q > 0.0);
        any.then_some(Self { steps, shared, measurand: data.measurand, readings: rows.len() })
    }

    /// Readings and noise with what rounding adds. Noise taken from repeats or residuals has it already, as far as it shows there.
    pub(super) fn apply(&self, data: &mut Dataset, noise: &mut Noise) {
        let is_stated = noise.is_stated();
        let wider = |sigma: f64, rounding: f64| {
            if is_stated { sigma.hypot(rounding) } else { sigma.max(rounding) }
        };
        let rounding = self.steps.map(|q| q / 12_f64.sqrt());
        for row in &mut data.observations {
            row.sigma = row.sigma.map(|sigma| std::array::from_fn(|k| wider(sigma[k], rounding[k])));
        }
        let of =
            |range: std::ops::Range<usize>| root_mean_square(rounding[range].iter().copied()).unwrap_or(0.0);
        noise.translation = wider(noise.translation, of(0..3));
        noise.rotation = wider(noise.rotation, of(3..6));
    }

    pub(super) fn finding(&self) -> Finding {
        let size = self.sizes().join(", ");
        Finding {
            probability: 1.0 - (-(self.readings as f64)).exp2(),
            text: format!(
                "the readings are rounded to a step that is larger than their noise: {size}; a twelfth of its square is added to their \
                 variance"
            ),
            size,
            next: "record readings with all the digits of the instrument; if it has no more, vary the load slightly between repeats"
                .to_owned(),
            ..Finding::of(FindingKind::Resolution)
        }
    }

    /// `1 um in da, db, dc`, a part for each step.
    fn sizes(&self) -> Vec<String> {
        let columns = Column::all(self.measurand);
        let mut parts: Vec<(String, Vec<&str>)> = Vec::new();
        for (column, q) in columns.iter().zip(self.steps).filter(|(_, q)| *q > 0.0) {
            // Two digits are enough for a step of one.
            let size = format!("{} {}", (q / column.size * 1e12).round() / 1e12, column.unit);
            match parts.iter_mut().find(|(known, _)| *known == size) {
                Some((_, names)) => names.push(column.name),
                None => parts.push((size, vec![column.name])),
            }
        }
        parts.into_iter().map(|(size, names)| format!("{size} in {}", names.join(", "))).collect()
    }
}

/// Largest decimal step (1, 2 or 5 times a power of ten) of which all values are whole multiples; none for zeros alone.
fn step(values: &[f64]) -> Option<f64> {
    let largest = values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    if largest <= 0.0 || !largest.is_finite() {
        return None;
    }
    #[allow(clippy::cast_possible_truncation, reason = "the logarithm of a finite number is small")]
    let top = largest.log10().floor() as i32;
    let steps = (0..=DECADES).flat_map(|down| MANTISSAS.map(|m| m * 10_f64.powi(top - down)));
    let is_whole = |q: f64| values.iter().all(|x| (x / q - (x / q).round()).abs() < WHOLE);
    steps.filter(|q| *q <= largest * (1.0 + WHOLE)).find(|q| is_whole(*q))
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Hexapod, Metrology};

    use super::*;
    use crate::estimation::campaign::Campaign;
    use crate::test_machine::readings;

    #[test]
    fn repeats_share_the_rounding_that_their_noise_does_not_spread() {
        let whole = 4.0 / 12.0;
        assert!((shared_variance(2.0, 0.0) / whole - 1.0).abs() < 0.03);
        assert!(shared_variance(2.0, 1.0) < 1e-3 * whole);
        assert!(shared_variance(0.0, 1.0).abs() < f64::EPSILON);
    }

    #[test]
    fn the_step_of_a_column_is_the_largest_decimal_one_that_fits_all_values() {
        assert_eq!(step(&[0.0, -3.0, 5.0, 12.0]), Some(1.0));
        assert_eq!(step(&[0.0, -10.0, 40.0]), Some(10.0));
        assert_eq!(step(&[-0.5, 1.5, 2.0]), Some(0.5));
        assert_eq!(step(&[0.1, 0.7, 12.3]).map(|q| (q * 1e3).round()), Some(100.0));
        assert_eq!(step(&[0.0, 0.0]), None);
        assert_eq!(step(&[std::f64::consts::PI, std::f64::consts::E]), None);
    }

    #[test]
    fn a_step_matters_from_one_standard_deviation_of_the_noise_on() {
        for (sigma, matters) in [(0.95e-6, true), (1.05e-6, false)] {
            let metrology = Some(Metrology { sigma_translation: sigma, sigma_rotation: 1e-4 });
            let (machine, mut data) = readings(Measurand::DeflectionRotationVector, Vec::new());
            data.observations.extend(data.observations.clone());
            for (row, k) in data.observations.iter_mut().zip(1_u8..) {
                row.measured = std::array::from_fn(|i| 1e-5 * (f64::from(k) * (1.3 + i as f64)).sin());
                row.measured[0] = 1e-6 * f64::from(k);
            }
            let noise = Campaign::new(&Hexapod { metrology, ..machine }, &data).unwrap().noise;
            let found = Resolution::of(&data, &noise);
            assert_eq!(found.map(|r| r.sizes()), matters.then(|| vec!["1 um in da".to_owned()]), "{sigma}");
        }
        assert_ne!(step(&[1.0, 2.0 + 1.5e-6]), Some(1.0), "off by more than a millionth of a step");
    }
}
