//! Is a formula linear in its parameters? Checked by numbers at made-up readings.

use super::UserTermError;
use crate::effects::formula::Formula;
use crate::effects::term::{ParameterInfo, Scale};

/// Readings tried.
pub(super) const TRIALS: usize = 48;
/// Readings at which the formula must have a value.
pub(super) const ENOUGH: usize = 6;
/// Largest relative departure from linearity put down to rounding.
const TOLERANCE: f64 = 1e-9;

/// Refuse a formula that is not proportional to each parameter and additive in them.
///
/// `variables` values come first in the formula's list of names, then the parameters, then the shape when there is one.
pub(super) fn check(
    formula: &Formula,
    variables: &[&str],
    parameters: &[ParameterInfo],
    shapes: &[f64],
) -> Result<(), UserTermError> {
    let (mut evaluated, mut last) = (0, String::new());
    for trial in 0..TRIALS {
        let mut values: Vec<f64> =
            variables.iter().enumerate().map(|(k, name)| sample(name, trial, k)).collect();
        let first = values.len();
        values.extend(parameters.iter().map(|_| 0.0));
        values.extend(shapes.get(trial % shapes.len().max(1)));
        let mut at = |sizes: &[f64]| {
            values[first..first + sizes.len()].copy_from_slice(sizes);
            formula.value(&values)
        };
        let outcome = departure(&mut at, parameters, trial);
        match outcome {
            Some(Ok(())) => evaluated += 1,
            Some(Err(parameter)) => {
                return Err(UserTermError::NotLinear {
                    formula: formula.text().to_owned(),
                    parameter: parameter.to_owned(),
                });
            }
            None => last = super::variables::describe(variables, &values, |k| formula.uses(k)),
        }
    }
    if evaluated < ENOUGH {
        return Err(UserTermError::NoValue { formula: formula.text().to_owned(), at: last });
    }
    Ok(())
}

/// `None` when the formula has no finite value here, `Err` with the parameter (or "0") that breaks linearity.
fn departure<'a>(
    at: &mut impl FnMut(&[f64]) -> f64,
    parameters: &'a [ParameterInfo],
    trial: usize,
) -> Option<Result<(), &'a str>> {
    let n = parameters.len();
    let mut units = Vec::with_capacity(n);
    for (k, p) in parameters.iter().enumerate() {
        let unit = at(&one(n, k, 1.0));
        let size = scale(p);
        for factor in [size, -0.37 * size, 2.9 * size] {
            let value = at(&one(n, k, factor));
            if !(unit.is_finite() && value.is_finite()) {
                return None;
            }
            let linear = unit * factor;
            if (value - linear).abs() > TOLERANCE * value.abs().max(linear.abs()) {
                return Some(Err(p.name));
            }
        }
        units.push(unit);
    }
    let sizes: Vec<f64> =
        parameters.iter().enumerate().map(|(k, p)| scale(p) * random(trial, 100 + k)).collect();
    let (together, zero) = (at(&sizes), at(&vec![0.0; n]));
    let apart: f64 = units.iter().zip(&sizes).map(|(u, s)| u * s).sum();
    let largest: f64 = units.iter().zip(&sizes).map(|(u, s)| (u * s).abs()).sum();
    let additive = (together - apart).abs() <= TOLERANCE * largest.max(together.abs());
    Some(if zero == 0.0 && additive { Ok(()) } else { Err(parameters[0].name) })
}

fn scale(p: &ParameterInfo) -> f64 {
    if let Scale::Fixed(value) = p.scale { value } else { 1.0 }
}

fn one(n: usize, k: usize, value: f64) -> Vec<f64> {
    let mut all = vec![0.0; n];
    all[k] = value;
    all
}

/// A believable value of a variable, SI.
pub(super) fn sample(name: &str, trial: usize, k: usize) -> f64 {
    let r = random(trial, k);
    match name {
        "f" | "f0" | "df" | "fx" | "fy" | "fz" | "ref_fx" | "ref_fy" | "ref_fz" => 200.0 * r,
        "mx" | "my" | "mz" | "ref_mx" | "ref_my" | "ref_mz" => 20.0 * r,
        name if name.starts_with("df_") || name.starts_with("f_") => 200.0 * r,
        "c_i" => 2e-7 + 1e-7 * r,
        "k_i" => 5e6 + 2e6 * r,
        "q" => 0.2 + 0.05 * r,
        "q_home" => 0.2,
        "leg" => 1.0 + (trial % 6) as f64,
        "approach" => {
            if trial.is_multiple_of(2) {
                1.0
            } else {
                -1.0
            }
        }
        "elapsed" => 150.0 + 140.0 * r,
        "a" | "b" | "c" => 0.03 * r,
        "alpha" | "beta" | "gamma" => 0.2 * r,
        _ => r,
    }
}

/// A fixed sequence in (-1, 1): fractional parts of multiples of the golden ratio (Weyl sequence).
fn random(trial: usize, k: usize) -> f64 {
    let x = (trial as f64 + 0.5) * 0.618_033_988_749_894_9 + (k as f64 + 1.0) * 0.754_877_666_246_692_7;
    2.0 * x.fract() - 1.0
}
