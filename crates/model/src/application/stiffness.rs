//! Cartesian stiffness and compliance of the loaded platform: what a unit of force or moment moves, with its uncertainty.
//!
//! The twist `[v; omega]` of a point of the platform under small wrenches `[F; M]` at that point is `C [F; M]`, and `K = C^-1`. For
//! springs alone `C = J diag(c) J'` (J: platform Jacobian), a sum over the legs; effects of the model add theirs. Column j of `C` is half
//! the difference of two predictions, for the load plus and minus a small one along axis j, so that effects whose slope changes
//! with the load (contact, play, nonlinear springs) count as they act around it. Under a load `K` is not quite
//! symmetric: the load keeps its direction while the platform turns.
//!
//! Uncertainties follow to first order from the covariance of the model's parameters: `dK = -K dC K`.

use hexbench_core::{Matrix3, Matrix6, Measurand, Observation, Pose, Vector3, Vector6, Wrench};
use nalgebra::{DMatrix, SymmetricEigen};

use crate::application::model_file::Model;
use crate::application::predict::{Answer, PredictError, Uncertain, kept_covariance, predict_with_slopes};
use crate::error::ModelError;
use crate::estimation::frames::ReadingAxes;

/// Predictions of a row: six axes, two signs.
const STATES: usize = 12;

/// Axes of twists and wrenches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum StiffnessAxes {
    /// Of the fixed frame.
    #[default]
    Fixed,
    /// Of the mobile frame at the pose.
    Mobile,
}

hexbench_core::worded! {
    /// Name in files and in Python.
    StiffnessAxes::word { Fixed => "fixed", Mobile => "mobile" }
}

/// Where and how a stiffness is asked for, beside the poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StiffnessPoint {
    /// Point of the platform, mobile frame, m.
    pub point: Vector3,
    /// Axes.
    pub axes: StiffnessAxes,
    /// Size of the small forces, N; moments are as large times the radius of the platform joints.
    pub amplitude: f64,
}

impl Default for StiffnessPoint {
    /// The mobile origin, fixed axes, 1 N.
    fn default() -> Self {
        Self { point: Vector3::zeros(), axes: StiffnessAxes::Fixed, amplitude: 1.0 }
    }
}

/// Stiffness along one direction when nothing else is held.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalStiffness {
    /// N/m of a force, N m/rad of a moment.
    pub stiffness: f64,
    /// Its standard uncertainty (k = 1).
    pub std: f64,
    /// Unit vector in the axes asked for.
    pub direction: Vector3,
}

/// Stiffness of the platform at one pose and load. SI: m and rad per N and N m, and the other way round.
#[derive(Debug, Clone, PartialEq)]
pub struct CartesianStiffness {
    /// `C`: twist `[v; omega]` of the point per wrench `[F; M]` at the point.
    pub compliance: Matrix6,
    /// Standard uncertainty of each number of `C`.
    pub compliance_std: Matrix6,
    /// `K = C^-1`.
    pub stiffness: Matrix6,
    /// Standard uncertainty of each number of `K`.
    pub stiffness_std: Matrix6,
    /// Softest direction first: a force through the point, the platform free to turn.
    pub of_forces: [PrincipalStiffness; 3],
    /// Softest direction first: a moment, the platform free to shift.
    pub of_moments: [PrincipalStiffness; 3],
    /// By how much what a small load moves along its own axis differs from what the opposite one does, relative to the larger of both;
    /// largest of the axes. Friction, play and contacts make it large, and the numbers above a mean of both.
    pub lopsided: f64,
}

/// Stiffness at the pose and under the load (`wrench`) of every row.
///
/// # Errors
/// [`PredictError`] with the first row that is singular or does not settle, or whose compliance has no inverse.
pub fn cartesian_stiffness(
    model: &Model,
    rows: &[Observation],
    at: &StiffnessPoint,
) -> Result<Vec<CartesianStiffness>, PredictError> {
    let model = model.without_metrology();
    let moment = at.amplitude * model.hexapod.platform_radius();
    let sizes = Vector6::from_fn(|k, _| if k < 3 { at.amplitude } else { moment });
    let small = rows.iter().flat_map(|row| small_loads(row, at, &sizes)).collect::<Vec<_>>();
    let answers = twists(&model, &small)?;
    let covariance = kept_covariance(&model, Uncertain::Parameters);
    let one = |(row, answers): (&Observation, &[Answer])| {
        let slopes = Slopes::of(answers, &carry(&row.pose, at), &sizes);
        slopes.stiffness(&covariance).map_err(|cause| PredictError { line: row.line, cause })
    };
    rows.iter().zip(answers.chunks(STATES)).map(one).collect()
}

/// What small loads move, rotations as rotation vectors in fixed axes; of absolute poses only differences mean something.
fn twists(model: &Model, rows: &[Observation]) -> Result<Vec<Answer>, PredictError> {
    if !model.is_absolute() {
        return predict_with_slopes(model, rows, Measurand::DeflectionRotationVector, Uncertain::Parameters);
    }
    let bare = model.in_machine_frames();
    let mut answers = predict_with_slopes(&bare, rows, Measurand::AbsolutePose, Uncertain::Parameters)?;
    for (rows, answers) in rows.chunks(STATES).zip(answers.chunks_mut(STATES)) {
        // One matrix for all: differences between its answers count. At beta = +-90 deg angles say nothing of rotations.
        let cause = ModelError::SingularPose { pose: rows[0].pose, has_no_height: false };
        let rates = ReadingAxes::default().rates(&answers[0].value).try_inverse();
        let rates = rates.ok_or(PredictError { line: rows[0].line, cause })?;
        for answer in answers {
            let [a, b, c, x, y, z] = answer.value;
            let turn = rates * Vector3::new(x, y, z);
            answer.value = [a, b, c, turn.x, turn.y, turn.z];
            let turns = rates * answer.reader.rows(3, 3);
            answer.reader.rows_mut(3, 3).copy_from(&turns);
        }
    }
    Ok(answers)
}

/// From twists of the mobile origin in fixed axes to those of the point in the axes asked for; its transpose brings wrenches back.
fn carry(pose: &Pose, at: &StiffnessPoint) -> Matrix6 {
    let rotation = pose.rotation();
    let axes = if at.axes == StiffnessAxes::Mobile { rotation.transpose() } else { Matrix3::identity() };
    let mut carry = Matrix6::zeros();
    carry.fixed_view_mut::<3, 3>(0, 0).copy_from(&axes);
    carry.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-axes * (rotation * at.point).cross_matrix()));
    carry.fixed_view_mut::<3, 3>(3, 3).copy_from(&axes);
    carry
}

/// The load of a row plus and minus a small one along each of six axes, each against the load itself.
fn small_loads(row: &Observation, at: &StiffnessPoint, sizes: &Vector6) -> Vec<Observation> {
    let carry = carry(&row.pose, at);
    let load = row.wrench.to_vector();
    let one = |axis: usize, sign: f64| {
        let wrench = load + carry.transpose() * Vector6::ith(axis, sign * sizes[axis]);
        let there = Observation::unread(row.pose, Wrench::from_array(wrench.into()), row.wrench);
        Observation { line: row.line, ..there }
    };
    (0..6).flat_map(|axis| [one(axis, 1.0), one(axis, -1.0)]).collect()
}

/// A compliance and what a unit of each parameter does to it.
struct Slopes {
    compliance: Matrix6,
    by_parameter: Vec<Matrix6>,
    lopsided: f64,
}

impl Slopes {
    /// From the answers to the small loads of one row.
    fn of(answers: &[Answer], carry: &Matrix6, sizes: &Vector6) -> Self {
        let column = |axis: usize, number: &dyn Fn(&Answer) -> Vector6| {
            carry * (number(&answers[2 * axis]) - number(&answers[2 * axis + 1])) / (2.0 * sizes[axis])
        };
        let matrix = |number: &dyn Fn(&Answer) -> Vector6| {
            Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|axis| column(axis, number)))
        };
        let parameters = answers[0].reader.ncols();
        let slope = |p: usize| matrix(&|a: &Answer| a.reader.fixed_view::<6, 1>(0, p).into_owned());
        let along = |axis: usize, answer: &Answer| (carry * Vector6::from(answer.value))[axis].abs();
        let lopsided = |axis: usize| {
            let [one, other] = [0, 1].map(|sign| along(axis, &answers[2 * axis + sign]));
            let larger = one.max(other);
            if larger > 0.0 { (one - other).abs() / larger } else { 0.0 }
        };
        Self {
            lopsided: (0..6).map(lopsided).fold(0.0, f64::max),
            compliance: matrix(&|a: &Answer| Vector6::from(a.value)),
            by_parameter: (0..parameters).map(slope).collect(),
        }
    }

    fn stiffness(&self, covariance: &DMatrix<f64>) -> Result<CartesianStiffness, ModelError> {
        let compliance = self.compliance;
        let stiffness = compliance
            .try_inverse()
            .filter(|k| k.iter().all(|x| x.is_finite()))
            .ok_or(ModelError::NotFinite { what: "the stiffness" })?;
        let of_compliance = self.spread(covariance, |dc| *dc);
        let of_stiffness = self.spread(covariance, |dc| stiffness * dc * stiffness);
        Ok(CartesianStiffness {
            compliance,
            compliance_std: of_compliance,
            stiffness,
            stiffness_std: of_stiffness,
            of_forces: self.principal(0, covariance),
            of_moments: self.principal(3, covariance),
            lopsided: self.lopsided,
        })
    }

    /// Standard uncertainties of numbers that are linear in the change of the compliance.
    fn spread(&self, covariance: &DMatrix<f64>, change: impl Fn(&Matrix6) -> Matrix6) -> Matrix6 {
        let columns = self.by_parameter.iter().map(change).collect::<Vec<_>>();
        let slopes = DMatrix::from_fn(36, columns.len(), |k, p| columns[p][(k % 6, k / 6)]);
        let reached = &slopes * covariance;
        let variance = |k: usize| reached.row(k).dot(&slopes.row(k)).max(0.0);
        Matrix6::from_fn(|i, j| variance(i + 6 * j).sqrt())
    }

    /// Stiffnesses of forces (from the first row 0) or moments (3) alone, the softest first.
    fn principal(&self, first: usize, covariance: &DMatrix<f64>) -> [PrincipalStiffness; 3] {
        let block = |c: &Matrix6| {
            let block = c.fixed_view::<3, 3>(first, first);
            (block + block.transpose()) * 0.5
        };
        let eigen = SymmetricEigen::new(block(&self.compliance));
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        order.map(|k| {
            let direction = eigen.eigenvectors.column(k).into_owned();
            let stiffness = eigen.eigenvalues[k].recip();
            let along = |c: &Matrix6| direction.dot(&(block(c) * direction));
            let slopes =
                DMatrix::from_iterator(1, self.by_parameter.len(), self.by_parameter.iter().map(along));
            let variance = (&slopes * covariance * slopes.transpose())[(0, 0)].max(0.0);
            PrincipalStiffness {
                stiffness,
                std: stiffness.powi(2) * variance.sqrt(),
                direction: upward(direction),
            }
        })
    }
}

/// Of the two unit vectors of an axis the one whose largest number is positive.
fn upward(axis: Vector3) -> Vector3 {
    if axis[axis.iamax()] < 0.0 { -axis } else { axis }
}
