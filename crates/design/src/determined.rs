//! Which parameters a plan leaves undetermined.

use nalgebra::{DMatrix, DVector};

use crate::DesignError;

/// Eigenvalues of the information with unit diagonal below this count as zero. Regressors with derivatives by differences are
/// good to about ten digits.
const DETERMINED: f64 = 1e-9;
/// Share of a parameter in a direction of no information from which it counts as affected.
const SHARE: f64 = 0.05;

/// Indices of the parameters that an information matrix does not determine, alone or because only a combination is seen.
pub fn undetermined(information: &DMatrix<f64>) -> Vec<usize> {
    let scaled = unit_diagonal(information);
    let eigen = scaled.symmetric_eigen();
    let mut affected = DVector::<f64>::zeros(information.nrows());
    for (k, value) in eigen.eigenvalues.iter().enumerate() {
        // Without a number there is no information either.
        if value.is_nan() || *value <= DETERMINED {
            let direction = eigen.eigenvectors.column(k).map(f64::abs);
            affected = affected.sup(&direction);
        }
    }
    (0..affected.len()).filter(|&k| affected[k] > SHARE).collect()
}

/// Refuses parameters that a sum over everything a space offers leaves undetermined. What follows the named ones, inputs known to a
/// tolerance, makes a parameter less well known, never undetermined.
///
/// # Errors
/// [`DesignError::NeverDetermined`] with their names.
pub fn require_determined(information: &DMatrix<f64>, names: &[String]) -> Result<(), DesignError> {
    let parameters = names.len();
    let missing = undetermined(&information.view((0, 0), (parameters, parameters)).into_owned());
    if missing.is_empty() {
        return Ok(());
    }
    let names = missing.into_iter().map(|k| names[k].clone()).collect();
    Err(DesignError::NeverDetermined { names, lacks: Vec::new() })
}

/// Divided by the roots of its diagonal; a parameter without any information keeps zeros.
pub fn unit_diagonal(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let scale = matrix.diagonal().map(|x| if x > 0.0 { 1.0 / x.sqrt() } else { 0.0 });
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| matrix[(i, j)] * scale[i] * scale[j])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parameter_that_is_not_seen_and_two_that_look_alike_are_found() {
        let m = DMatrix::from_row_slice(
            4,
            4,
            &[
                4.0, 0.0, 0.0, 0.0, //
                0.0, 0.0, 0.0, 0.0, //
                0.0, 0.0, 9.0, 3.0, //
                0.0, 0.0, 3.0, 1.0,
            ],
        );
        assert_eq!(undetermined(&m), [1, 2, 3]);
        assert!(undetermined(&DMatrix::identity(3, 3)).is_empty());
    }
}
