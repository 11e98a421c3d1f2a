//! Criteria of a plan, and how they change with its information matrix.
//!
//! With `s_1 >= ... >= s_p` the singular values of the regressor `J` of N readings and `l_i = s_i^2` the eigenvalues of
//! `M = J'J`:
//!
//! | name | value, larger is better | source |
//! |---|---|---|
//! | O1 | `(s_1 ... s_p)^(1/p) / sqrt(N)` | Borm and Menq 1991; exponent 1/p as in Sun and Hollerbach 2008, eq. 7 |
//! | O2 | `s_p / s_1` | Driels and Pathre 1990 |
//! | O3 | `s_p` | Nahvi, Hollerbach and Hayward 1994 |
//! | O4 | `s_p^2 / s_1` | Nahvi and Hollerbach 1996 |
//! | O5 | `1 / sum(1 / s_i)` | Sun and Hollerbach 2008 |
//! | D | `det(M)^(1/p)` | Wald 1943 |
//! | A | `p / trace(M^-1)` | Elfving 1952 |
//! | E | `l_p` | Ehrenfeld 1955 |
//! | I | `1 / trace(B M^-1)`, `B` the mean of `J'J` over the workspace | Box and Draper 1959 |
//!
//! Some authors take 1/N for the exponent of O1: the same name, another number. O2, O4 and all criteria but O1 and D depend on
//! the units of the parameters; the columns of `J` here belong to relative changes, see [`crate::regressor`].
//!
//! Where joints, loads and axes count as known to a tolerance only, `M` is the information that is left of the parameters
//! ([`hexbench_model::estimation::nuisance`]).

use hexbench_core::Hexapod;
use hexbench_core::statistics::mean;
use hexbench_model::estimation::nuisance::{marginal, slope_of_whole};
use nalgebra::{DMatrix, DVector};

use crate::regressor::PoseRegressor;
use crate::{DesignError, Space};

/// What makes a plan good; `B` is what criterion I needs beside its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Criterion<B = ()> {
    /// Geometric mean of the singular values over the root of the number of readings.
    O1,
    /// Inverse condition number.
    O2,
    /// Smallest singular value.
    O3,
    /// Smallest singular value times the inverse condition number.
    O4,
    /// Harmonic: inverse of the sum of the inverse singular values.
    O5,
    /// Volume of the confidence ellipsoid.
    D,
    /// Mean variance of the parameters.
    A,
    /// Longest axis of the confidence ellipsoid.
    E,
    /// Mean variance of a prediction.
    I(B),
}

/// A criterion ready to be computed: I holds the mean information `B` (p x p) over the workspace.
type Ready = Criterion<DMatrix<f64>>;

/// A criterion of the parameters for information matrices that hold parameters first and then inputs that are known to a tolerance
/// only: errors of the inputs are taken out before anything is computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Objective {
    criterion: Ready,
    inputs: usize,
}

/// Eigenvalues below this share of the largest count as zero: the plan does not determine all parameters.
const DETERMINED: f64 = 1e-13;

impl<B> Criterion<B> {
    /// Name, option of a command, and what it is.
    fn words(&self) -> [&'static str; 3] {
        match self {
            Self::O1 => ["O1", "o1", "Geometric mean of the singular values, as in the paper"],
            Self::O2 => ["O2", "o2", "Inverse condition number"],
            Self::O3 => ["O3", "o3", "Smallest singular value"],
            Self::O4 => ["O4", "o4", "Smallest singular value times the inverse condition number"],
            Self::O5 => ["O5", "o5", "Inverse sum of the inverse singular values"],
            Self::D => ["D", "d", "Volume of the confidence ellipsoid"],
            Self::A => ["A", "a", "Mean variance of the parameters"],
            Self::E => ["E", "e", "Longest axis of the confidence ellipsoid"],
            Self::I(_) => ["I", "i", "Mean variance of a prediction over the workspace"],
        }
    }

    /// Short name, as in tables and study files.
    pub fn name(&self) -> &'static str {
        self.words()[0]
    }

    /// The same criterion beside another `B`.
    fn with<C, F>(self, other: impl FnOnce(B) -> Result<C, F>) -> Result<Criterion<C>, F> {
        Ok(match self {
            Self::O1 => Criterion::O1,
            Self::O2 => Criterion::O2,
            Self::O3 => Criterion::O3,
            Self::O4 => Criterion::O4,
            Self::O5 => Criterion::O5,
            Self::D => Criterion::D,
            Self::A => Criterion::A,
            Self::E => Criterion::E,
            Self::I(b) => Criterion::I(other(b)?),
        })
    }
}

impl Criterion {
    /// All of them.
    pub const ALL: [Self; 9] =
        [Self::O1, Self::O2, Self::O3, Self::O4, Self::O5, Self::D, Self::A, Self::E, Self::I(())];

    /// The name as an option of a command.
    pub fn option(self) -> &'static str {
        self.words()[1]
    }

    /// The criterion of an option, when there is one.
    pub fn of_option(option: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|c| c.option() == option)
    }

    /// What it is, in a few words.
    pub fn meaning(self) -> &'static str {
        self.words()[2]
    }

    /// The criterion for information matrices that end with so many inputs known to a tolerance only; `mean` is the `B` of I (p x p).
    pub fn over(self, mean: impl FnOnce() -> DMatrix<f64>, inputs: usize) -> Objective {
        let criterion = match self.with(|()| Ok::<_, std::convert::Infallible>(mean())) {
            Ok(criterion) => criterion,
            Err(never) => match never {},
        };
        Objective { criterion, inputs }
    }

    /// The criterion for a machine, a space and a regressor. `B` of I is the mean information of poses spread evenly over the
    /// space, so that its value is the inverse mean of the summed variance of the predictions there.
    ///
    /// # Errors
    /// For I, a space without poses, or a singular one in it.
    pub fn objective<R: PoseRegressor + ?Sized>(
        self,
        hexapod: &Hexapod,
        space: &Space,
        regressor: &R,
    ) -> Result<Objective, DesignError> {
        let criterion = self.with(|()| mean_information(hexapod, space, regressor))?;
        Ok(Objective { criterion, inputs: regressor.inputs() })
    }
}

fn mean_information<R: PoseRegressor + ?Sized>(
    hexapod: &Hexapod,
    space: &Space,
    regressor: &R,
) -> Result<DMatrix<f64>, DesignError> {
    const POSES: usize = 256;
    const SEED: u32 = 0;
    let (p, width) = (regressor.parameters(), regressor.width());
    let mut mean = DMatrix::zeros(width, width);
    for pose in space.poses(hexapod, POSES, SEED)? {
        regressor.inform(&pose, &mut mean)?;
    }
    Ok(mean.view((0, 0), (p, p)) / POSES as f64)
}

impl From<Ready> for Objective {
    /// For information matrices without inputs: all are exact.
    fn from(criterion: Ready) -> Self {
        Self { criterion, inputs: 0 }
    }
}

impl Objective {
    /// The same for information matrices whose last rows are so many inputs that are known to a tolerance only.
    #[must_use]
    pub fn with_inputs(self, inputs: usize) -> Self {
        Self { inputs, ..self }
    }

    /// The criterion.
    pub fn criterion(&self) -> &Criterion<DMatrix<f64>> {
        &self.criterion
    }

    /// Number of parameters of an information matrix.
    pub fn parameters(&self, information: &DMatrix<f64>) -> usize {
        information.nrows() - self.inputs
    }

    /// Information of the parameters (p x p), inputs being as good as their tolerances.
    pub fn of_parameters(&self, information: &DMatrix<f64>) -> DMatrix<f64> {
        marginal(information, self.parameters(information))
    }

    /// Slope of a function by the whole information, from that by the information of the parameters.
    pub fn of_whole(&self, information: &DMatrix<f64>, slope: &DMatrix<f64>) -> DMatrix<f64> {
        slope_of_whole(information, self.parameters(information), slope)
    }

    /// Value for the information matrix of a plan with `readings` readings; zero when it does not determine all parameters.
    pub fn value(&self, information: &DMatrix<f64>, readings: usize) -> f64 {
        self.criterion.value(&self.of_parameters(information), readings)
    }

    /// Value, and the symmetric matrix `G` with `d value = trace(G dM)`. `G` is zero where the value is.
    ///
    /// The smallest and largest eigenvalues have no derivative where two of them meet; one of the two is then followed.
    pub fn gradient(&self, information: &DMatrix<f64>, readings: usize) -> (f64, DMatrix<f64>) {
        let (value, slope) = self.criterion.gradient(&self.of_parameters(information), readings);
        (value, self.of_whole(information, &slope))
    }
}

impl Ready {
    /// As [`Objective::value`] for the information of the parameters.
    fn value(&self, information: &DMatrix<f64>, readings: usize) -> f64 {
        match self {
            Self::D => of_cholesky(information, |l| mean_log(l).exp()),
            Self::O1 => {
                of_cholesky(information, |l| (0.5 * mean_log(l)).exp() / (readings.max(1) as f64).sqrt())
            }
            Self::I(mean) => {
                information.clone().cholesky().map_or(0.0, |c| 1.0 / c.solve(mean).trace()).max(0.0)
            }
            _ => self.spectral(&information.symmetric_eigenvalues()).0,
        }
    }

    /// As [`Objective::gradient`] for the information of the parameters.
    fn gradient(&self, information: &DMatrix<f64>, readings: usize) -> (f64, DMatrix<f64>) {
        let nothing = || (0.0, DMatrix::zeros(information.nrows(), information.ncols()));
        if let Self::I(mean) = self {
            let Some(c) = information.clone().cholesky() else { return nothing() };
            let inverse = c.inverse();
            let spread = &inverse * mean * &inverse;
            let value = 1.0 / (mean * &inverse).trace();
            return (value, spread * (value * value));
        }
        if matches!(self, Self::O1 | Self::D) {
            // det(M)^power
            let Some(c) = information.clone().cholesky() else { return nothing() };
            let power = if *self == Self::O1 { 0.5 } else { 1.0 } / information.nrows() as f64;
            let value = self.value(information, readings);
            return (value, c.inverse() * (value * power));
        }
        let eigen = information.clone().symmetric_eigen();
        let (value, slopes) = self.spectral(&eigen.eigenvalues);
        let v = &eigen.eigenvectors;
        (value, v * DMatrix::from_diagonal(&slopes) * v.transpose())
    }

    /// Value as a function of the eigenvalues, and its derivatives by them; O1, D and I need no eigenvalues.
    fn spectral(&self, l: &DVector<f64>) -> (f64, DVector<f64>) {
        let n = l.len();
        let (first, last) = (l.imax(), l.imin());
        let (large, small) = (l[first], l[last]);
        let mut slopes = DVector::zeros(n);
        if small <= DETERMINED * large || small.is_nan() {
            return (0.0, slopes);
        }
        let p = n as f64;
        let value = match self {
            Self::A => {
                let sum: f64 = l.iter().map(|x| 1.0 / x).sum();
                slopes = l.map(|x| p / (sum * sum * x * x));
                p / sum
            }
            Self::O5 => {
                let sum: f64 = l.iter().map(|x| x.sqrt().recip()).sum();
                slopes = l.map(|x| 0.5 / (sum * sum * x * x.sqrt()));
                1.0 / sum
            }
            Self::E => {
                slopes[last] = 1.0;
                small
            }
            Self::O3 => {
                slopes[last] = 0.5 / small.sqrt();
                small.sqrt()
            }
            Self::O2 => {
                let value = (small / large).sqrt();
                slopes[last] += 0.5 * value / small;
                slopes[first] -= 0.5 * value / large;
                value
            }
            Self::O4 => {
                let value = small / large.sqrt();
                slopes[last] += 1.0 / large.sqrt();
                slopes[first] -= 0.5 * value / large;
                value
            }
            Self::O1 | Self::D | Self::I(_) => 0.0,
        };
        (value, slopes)
    }
}

fn of_cholesky(information: &DMatrix<f64>, value: impl Fn(&DVector<f64>) -> f64) -> f64 {
    information.clone().cholesky().map_or(0.0, |c| value(&c.l_dirty().diagonal()))
}

/// Mean logarithm of the eigenvalues from the diagonal of the Cholesky factor.
fn mean_log(diagonal: &DVector<f64>) -> f64 {
    2.0 * mean(diagonal.iter().map(|x| x.ln())).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(p: usize) -> [Ready; 9] {
        let mean = DMatrix::from_fn(p, p, |i, j| if i == j { 1.0 + i as f64 } else { 0.2 });
        Criterion::ALL.map(|criterion| criterion.with(|()| Ok::<_, ()>(mean.clone())).unwrap())
    }

    /// Singular values 4, 2, 1, four poses.
    #[test]
    fn the_criteria_of_known_singular_values() {
        let m = DMatrix::from_diagonal(&DVector::from_vec(vec![4.0, 16.0, 1.0]));
        let i = 1.0 / (2.0 / 4.0 + 1.0 / 16.0 + 3.0);
        let expected = [1.0, 0.25, 1.0, 0.25, 1.0 / 1.75, 4.0, 3.0 / (1.0 + 0.25 + 0.0625), 1.0, 0.0];
        for (criterion, wanted) in all(3).iter().zip(expected) {
            let found = criterion.value(&m, 4);
            if let Criterion::I(_) = criterion {
                let diagonal = Criterion::I(DMatrix::from_diagonal(&DVector::from_vec(vec![2.0, 1.0, 3.0])));
                assert!((diagonal.value(&m, 4) - i).abs() < 1e-15);
            } else {
                assert!(
                    (found - wanted).abs() < 8.0 * f64::EPSILON * wanted,
                    "{}: {found}",
                    criterion.name()
                );
            }
        }
    }

    #[test]
    fn gradients_agree_with_differences() {
        const STEP: f64 = 1e-6;
        let m = DMatrix::from_row_slice(3, 3, &[5.0, 0.7, -0.3, 0.7, 2.0, 0.4, -0.3, 0.4, 0.9]);
        let turn = DMatrix::from_row_slice(3, 3, &[0.3, -0.2, 0.5, -0.2, 0.8, 0.1, 0.5, 0.1, -0.4]);
        for criterion in all(3) {
            let (value, gradient) = criterion.gradient(&m, 4);
            let along = |s: f64| criterion.value(&(&m + &turn * s), 4);
            let difference = (along(STEP) - along(-STEP)) / (2.0 * STEP);
            let exact = (gradient * &turn).trace();
            assert!((value - criterion.value(&m, 4)).abs() < 1e-14, "{}", criterion.name());
            assert!((exact - difference).abs() < 1e-8, "{}: {exact} {difference}", criterion.name());
        }
    }

    #[test]
    fn an_undetermined_plan_is_worth_nothing() {
        let m = DMatrix::from_diagonal(&DVector::from_vec(vec![4.0, 0.0, 1.0]));
        for criterion in all(3) {
            assert!(criterion.value(&m, 1) == 0.0, "{}", criterion.name());
        }
    }
}
