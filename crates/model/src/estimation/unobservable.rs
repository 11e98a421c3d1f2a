//! What the data do not determine, in words.

use hexbench_core::words::joined;
use nalgebra::DMatrix;

use crate::estimation::parameters::{ParameterPlace, Parameters};

/// Weights below this share of the largest do not take part in a combination.
const TAKES_PART: f64 = 1e-3;
/// Combinations of more parameters than this are not spelled out.
const SPELLED_OUT: usize = 6;

/// Sentences about the combinations spanned by the columns of `null_space` (parameters x combinations).
pub fn unobservable(null_space: &DMatrix<f64>, parameters: &Parameters) -> Vec<String> {
    let all = reduced(null_space);
    let moves_frame = |v: &&Vec<f64>| (0..v.len()).any(|k| v[k].abs() > TAKES_PART && parameters.is_frame(k));
    let (frames, rest): (Vec<&Vec<f64>>, Vec<&Vec<f64>>) = all.iter().partition(moves_frame);
    let mut sentences: Vec<String> = rest.iter().map(|v| sentence(v, parameters)).collect();
    sentences.dedup();
    sentences.extend(gauge(&frames, parameters));
    sentences
}

/// Combinations that move a frame are one fact, not many: where the machine stands in the room is a convention.
fn gauge(combinations: &[&Vec<f64>], parameters: &Parameters) -> Option<String> {
    let count = combinations.len();
    let takes_part = |k: usize| combinations.iter().any(|v| v[k].abs() > TAKES_PART);
    let part = (0..parameters.len()).filter(|&k| takes_part(k) && !parameters.is_frame(k));
    let groups = part.filter_map(|k| parameters[k].name.split('.').next().map(str::to_owned));
    let mut groups: Vec<String> = groups.collect();
    groups.dedup();
    let what = joined(&groups);
    (count > 0).then(|| {
        format!(
            "{count} combinations of {what} are the same as motions of the metrology or target frame; predictions do not \
             depend on them"
        )
    })
}

/// A sentence about one combination.
pub fn sentence(weights: &[f64], parameters: &Parameters) -> String {
    let largest = weights.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
    let part: Vec<usize> = (0..weights.len()).filter(|&k| weights[k].abs() > TAKES_PART * largest).collect();
    let name = |k: usize| parameters[k].name.as_str();
    let legs = part.iter().all(|&k| matches!(parameters[k].place, ParameterPlace::Spring(_)));
    match part.as_slice() {
        [] => "everything is determined".to_owned(),
        [one] => format!("{} has no effect on the data at all", name(*one)),
        [one, other] if legs => {
            format!("legs {} and {} cannot be separated", one + 1, other + 1)
        }
        [one, other] => format!("{} and {} cannot be separated", name(*one), name(*other)),
        many if legs => {
            let numbers: Vec<String> = many.iter().map(|k| (k + 1).to_string()).collect();
            format!("legs {} cannot be separated", joined(&numbers))
        }
        many => {
            let mut all: Vec<String> = many.iter().take(SPELLED_OUT).map(|k| name(*k).to_owned()).collect();
            if many.len() > SPELLED_OUT {
                all.push(format!("{} more", many.len() - SPELLED_OUT));
            }
            format!("{} cannot be separated", joined(&all))
        }
    }
}

/// The same space spanned by combinations of as few parameters as elimination reaches (reduced row echelon form).
fn reduced(null_space: &DMatrix<f64>) -> Vec<Vec<f64>> {
    let mut m = null_space.transpose();
    let (rows, columns) = m.shape();
    let mut top = 0;
    for column in 0..columns {
        if top == rows {
            break;
        }
        let pivot = (top..rows).max_by(|&i, &j| m[(i, column)].abs().total_cmp(&m[(j, column)].abs()));
        let Some(pivot) = pivot.filter(|&i| m[(i, column)].abs() > 1e-7) else { continue };
        m.swap_rows(top, pivot);
        let value = m[(top, column)];
        m.row_mut(top).scale_mut(1.0 / value);
        for i in (0..rows).filter(|&i| i != top) {
            let factor = m[(i, column)];
            let eliminated = m.row(i) - factor * m.row(top);
            m.set_row(i, &eliminated);
        }
        top += 1;
    }
    (0..top).map(|i| m.row(i).iter().copied().collect()).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use hexbench_core::Vector6;

    use super::*;
    use crate::estimation::fit_named::term_named;
    use crate::estimation::linearization::{Active, ModelPoint};
    use crate::machine::geometry::Machine;
    use crate::terms::catalogue;
    use crate::test_machine::machine;

    /// Six springs and the terms with these ids.
    fn parameters(ids: &[&str], absolute: bool) -> Parameters {
        let term = |id: &&str| term_named(id, &catalogue()).map(|t| Active::new(t, false, 1.0));
        let active = ids.iter().map(term).collect::<Result<_, _>>().unwrap();
        let machine = Machine::nominal(&machine());
        Parameters::at(&ModelPoint { compliances: Vector6::zeros(), active, machine }, absolute)
    }

    fn with_creep() -> Parameters {
        parameters(&["creep"], false)
    }

    fn space(vectors: &[[f64; 8]]) -> DMatrix<f64> {
        DMatrix::from_fn(8, vectors.len(), |i, j| vectors[j][i])
    }

    #[test]
    fn two_legs_that_look_alike_are_named() {
        let v = [0.7, 0.0, 0.0, -0.7, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(unobservable(&space(&[v]), &with_creep()), ["legs 1 and 4 cannot be separated"]);
    }

    #[test]
    fn mixed_basis_vectors_are_taken_apart() {
        let (a, b) = ([0.5, 0.0, 0.5, 0.0, 0.0, 0.5, -0.5, 0.0], [0.5, 0.0, 0.5, 0.0, 0.0, -0.5, 0.5, 0.0]);
        let found = unobservable(&space(&[a, b]), &with_creep());
        assert_eq!(
            found,
            ["legs 1 and 3 cannot be separated", "leg 6 and creep.fraction cannot be separated"]
        );
    }

    #[test]
    fn motions_of_a_frame_are_told_in_one_sentence() {
        let parameters = parameters(&["joint-geometry"], true);
        let mut v = DMatrix::zeros(parameters.len(), 2);
        let first = parameters.of_term(0).start;
        for (combination, frame) in [(0, 6), (1, 7)] {
            v[(frame, combination)] = 0.6;
            v[(first + combination, combination)] = 0.8;
        }
        let found = unobservable(&v, &parameters);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with("2 combinations of joint-geometry are"), "{found:?}");
    }

    #[test]
    fn a_silent_leg_is_named() {
        let v = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(unobservable(&space(&[v]), &with_creep()), ["leg 2 has no effect on the data at all"]);
    }
}
