//! The estimator of the paper, by name: `A x = dX`, unweighted, minimum norm.
//!
//! ```text
//! A_ij = Jbar_ij sum_k J_kj dF_k        (eq. 12, 13; one 6x6 block per reading)
//! x    = A^+ dX = [1/k_1 ... 1/k_6]     (eq. 11)
//! ```
//!
//! The paper prints both Jacobians alike, but they differ: `J` (column j: twist `[v; omega]` per elongation of leg j) is
//! the *geometric* platform Jacobian, because forces and moments are conjugate to twists; `Jbar` maps to dX and is the
//! *analytic* one, with Euler rates in its last three rows. Rows are in SI units (m, rad), meters and radians side by side
//! without weights, at the commanded pose. For the rotation-vector form of the readings `Jbar` is `J`.
//!
//! Source: Kalas et al. 2018, eq. 3 to 14.

use hexbench_core::{Dataset, Hexapod, Matrix6, Measurand, Observation, Vector6};
use nalgebra::{DMatrix, DVector};

use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, row_sigma};
use crate::estimation::fit::Fit;
use crate::estimation::linearization::{Linearization, ModelPoint};
use crate::estimation::lsq::{RANK_TOLERANCE, Solution};
use crate::estimation::parameters::Parameters;
use crate::estimation::trust_region::{SearchEffort, Termination};
use crate::machine::kinematics::{Legs, euler_rate_matrix};
use crate::machine::observability::Observability;

/// What the paper's method gives.
#[derive(Debug, Clone)]
pub struct PaperFit {
    /// Compliance of each leg, m/N.
    pub compliances: Vector6,
    /// Covariance of the compliances under the noise of the campaign, (m/N)^2: `A^+ Sigma A^+'`.
    pub covariance: Matrix6,
    /// Singular values of `A`, largest first, and the indices made of them.
    pub observability: Observability,
    /// Number of combinations of compliances the readings determine.
    pub rank: usize,
    /// Undetermined combinations, orthonormal columns.
    pub null_space: DMatrix<f64>,
}

/// The 6x6 block of `A` of one reading: m (rows 1-3) and rad (rows 4-6) per m/N.
///
/// # Errors
/// [`ModelError::SingularPose`] at the commanded pose.
pub fn block(hexapod: &Hexapod, reading: &Observation, measurand: Measurand) -> Result<Matrix6, ModelError> {
    let legs = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &reading.pose)?;
    let change = reading.wrench.to_vector() - reading.reference.to_vector();
    let mut block = legs.platform_jacobian;
    if measurand == Measurand::DeflectionEuler {
        let rates = euler_rate_matrix(&reading.pose.angles)
            .try_inverse()
            .ok_or(ModelError::SingularPose { pose: reading.pose, has_no_height: false })?;
        let rotations = rates * block.fixed_rows::<3>(3);
        block.fixed_rows_mut::<3>(3).copy_from(&rotations);
    }
    let force_change = legs.forces(&change);
    Ok(Matrix6::from_fn(|i, j| block[(i, j)] * force_change[j]))
}

/// `A` of all readings, six rows each in file order.
///
/// # Errors
/// As [`block`]; [`ModelError::Mismatch`] for absolute poses, and for anything else than full poses, which the method does not cover.
pub fn regressor(hexapod: &Hexapod, data: &Dataset) -> Result<DMatrix<f64>, ModelError> {
    let not_covered = if data.is_absolute() {
        Some("absolute poses need")
    } else if data.has_other_readings() {
        Some("sensors and poses with empty cells need")
    } else {
        None
    };
    if let Some(need) = not_covered {
        let why =
            format!("the paper's estimator needs deflections read as full poses; {need} the estimator `gls`");
        return Err(ModelError::Mismatch(why));
    }
    let mut a = DMatrix::zeros(6 * data.observations.len(), 6);
    for (i, reading) in data.observations.iter().enumerate() {
        a.fixed_view_mut::<6, 6>(6 * i, 0).copy_from(&block(hexapod, reading, data.measurand)?);
    }
    Ok(a)
}

/// Compliances by the paper's method; `campaign` is the same data with its noise, for the uncertainty.
///
/// # Errors
/// As [`regressor`]; [`ModelError::NoLoad`] when no leg changes its force.
pub fn fit_paper(campaign: &Campaign, data: &Dataset) -> Result<PaperFit, ModelError> {
    let a = regressor(&campaign.hexapod, data)?;
    let size = a.amax();
    if !size.is_finite() {
        return Err(ModelError::NotFinite { what: "the regressor" });
    }
    if size <= 0.0 {
        return Err(ModelError::NoLoad);
    }
    let y = DVector::from_iterator(a.nrows(), data.observations.iter().flat_map(|o| o.measured));
    let svd = (&a / size)
        .try_svd(true, true, f64::EPSILON, 10_000)
        .ok_or(ModelError::NotFinite { what: "the singular value decomposition" })?;
    let (Some(u), Some(v_t)) = (svd.u, svd.v_t) else {
        return Err(ModelError::NotFinite { what: "the singular value decomposition" });
    };
    let cut = RANK_TOLERANCE * svd.singular_values.max();
    let mut inverse = DMatrix::zeros(6, a.nrows());
    let mut lost = Vec::new();
    for (k, &s) in svd.singular_values.iter().enumerate() {
        let v = v_t.row(k).transpose();
        if s > cut {
            inverse += (v / (s * size)) * u.column(k).transpose();
        } else {
            lost.push(v);
        }
    }
    let x = &inverse * y;
    let sigma = data.observations.iter().flat_map(|o| row_sigma(o, &campaign.noise));
    for (mut column, s) in inverse.column_iter_mut().zip(sigma) {
        column *= s;
    }
    let covariance = &inverse * inverse.transpose();
    let null_space = if lost.is_empty() { DMatrix::zeros(6, 0) } else { DMatrix::from_columns(&lost) };
    Ok(PaperFit {
        compliances: Vector6::from_fn(|i, _| x[i]),
        covariance: Matrix6::from_fn(|i, j| covariance[(i, j)]),
        observability: Observability::new(
            svd.singular_values.iter().map(|s| s * size),
            data.observations.len(),
        ),
        rank: 6 - null_space.ncols(),
        null_space,
    })
}

impl PaperFit {
    /// The same as a fit of springs alone, for prediction, comparison and the model file. Residuals are whitened with the
    /// noise of the campaign; the springs are left as the paper's method gives them.
    ///
    /// # Errors
    /// [`ModelError::SingularPose`].
    pub fn into_fit(self, campaign: &Campaign) -> Result<Fit, ModelError> {
        let point = ModelPoint { compliances: self.compliances, ..ModelPoint::start(campaign) };
        let state = Linearization::at(campaign, &point)?;
        let lack_of_fit = state.residuals().norm_squared();
        let rank = self.rank as f64;
        let covariance = DMatrix::from_fn(6, 6, |i, j| self.covariance[(i, j)]);
        let solution = Solution {
            x: DVector::from_column_slice(self.compliances.as_slice()),
            covariance: covariance.clone(),
            rss: lack_of_fit,
            rank: self.rank,
            singular_values: DVector::from_column_slice(&self.observability.singular_values),
            null_space: self.null_space,
            column_norms: DVector::from_element(6, 1.0),
        };
        Ok(Fit {
            parameters: Parameters::at(&point, false),
            point,
            covariance,
            chi2: lack_of_fit + campaign.pure_error,
            dof: campaign.numbers as f64 - rank,
            lack_of_fit,
            lack_of_fit_dof: state.numbers() - rank,
            solution,
            effort: SearchEffort { iterations: 1, tried: 1 },
            termination: Termination::Settled,
        })
    }
}
