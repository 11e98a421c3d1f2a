//! What the poses and loads let be seen: condition, rank, undetermined combinations in words, the paper's index.

use serde::Serialize;

use super::JudgedModel;
use crate::estimation::fit::columns;
use crate::estimation::lsq::Triangle;
use crate::estimation::paper::regressor;
use crate::estimation::parameters::Parameters;
use crate::estimation::unobservable::{sentence, unobservable};
use crate::machine::observability::Observability;

/// Condition beyond which the weakest combination is told.
const WEAK: f64 = 30.0;
/// Shares of the weakest combination below this fraction of the largest are left out of the sentence.
const SHARE: f64 = 0.3;

/// Design of the measurement as the model sees it.
#[derive(Debug, Clone, Serialize)]
pub struct Design {
    /// Parameters of the model.
    pub parameters: usize,
    /// Combinations of them the data determine.
    pub rank: usize,
    /// Condition number of the regressor with columns of unit length; absent when combinations are undetermined.
    pub condition: Option<f64>,
    /// Undetermined combinations in words.
    pub unobservable: Vec<String>,
    /// The worst determined combination in words, when it is much worse than the best.
    pub weakest: Option<String>,
    /// Indices of the paper's unweighted regressor (deflections): m and rad per m/N.
    pub paper: Option<Observability>,
}

/// Check the design.
pub fn design(judged: &JudgedModel<'_>) -> Design {
    let a = columns(&judged.lin, judged.point);
    let parameters = Parameters::at(judged.point, judged.campaign.is_absolute());
    let mut triangle = Triangle::new(a.ncols());
    let solution = triangle.push(&a, &judged.lin.residuals()).and_then(|()| triangle.solve());
    let Ok(solution) = solution else {
        let unobservable =
            vec!["no statement is possible: a number in the regressor is not finite".to_owned()];
        return Design {
            parameters: a.ncols(),
            rank: 0,
            condition: None,
            unobservable,
            weakest: None,
            paper: None,
        };
    };
    let condition = Some(solution.condition()).filter(|c| c.is_finite());
    Design {
        parameters: a.ncols(),
        rank: solution.rank,
        condition,
        unobservable: unobservable(&solution.null_space, &parameters),
        weakest: condition.filter(|c| *c > WEAK).map(|_| weakest(&a, &parameters)),
        paper: paper(judged),
    }
}

/// The direction of the smallest singular value of the column-scaled regressor, in words.
fn weakest(a: &nalgebra::DMatrix<f64>, parameters: &Parameters) -> String {
    let mut scaled = a.clone();
    for mut c in scaled.column_iter_mut() {
        let norm = c.norm();
        if norm > 0.0 {
            c /= norm;
        }
    }
    let eigen = (scaled.tr_mul(&scaled)).symmetric_eigen();
    let least = eigen.eigenvalues.imin();
    let direction = eigen.eigenvectors.column(least);
    let largest = direction.amax();
    let strong: Vec<f64> =
        direction.iter().map(|w| if w.abs() >= SHARE * largest { *w } else { 0.0 }).collect();
    sentence(&strong, parameters).replace("cannot be separated", "are hardest to separate")
}

fn paper(judged: &JudgedModel<'_>) -> Option<Observability> {
    let a = regressor(&judged.campaign.hexapod, judged.data).ok()?;
    let eigen = a.tr_mul(&a).symmetric_eigenvalues();
    let values = eigen.iter().map(|l| l.max(0.0).sqrt());
    Some(Observability::new(values.collect::<Vec<_>>(), judged.data.observations.len()))
}
