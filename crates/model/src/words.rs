//! What the data do not determine, in words.

use nalgebra::DMatrix;

use crate::fit::Fit;
use crate::linearization::Point;

/// Weights below this share of the largest do not take part in a combination.
const TAKES_PART: f64 = 1e-3;
/// Combinations of more parameters than this are not spelled out.
const SPELLED_OUT: usize = 6;

/// Names of the columns of a fit: `leg 1` ... `leg 6`, frames, then `term.parameter`.
pub fn column_names(fit: &Fit) -> Vec<String> {
    let used: usize = fit.point.active.iter().map(active_columns).sum();
    names_at(&fit.point, fit.covariance.ncols() >= 18 + used)
}

/// The same at a point; `absolute` when frames are estimated.
pub fn names_at(point: &Point, absolute: bool) -> Vec<String> {
    let mut names: Vec<String> = (1..=6).map(|leg| format!("leg {leg}")).collect();
    for frame in ["metrology frame", "target frame"].into_iter().filter(|_| absolute) {
        names.extend(["x", "y", "z", "rx", "ry", "rz"].map(|axis| format!("{frame} {axis}")));
    }
    for a in &point.active {
        let id = a.id();
        names
            .extend(crate::estimate::parameter_names(a).into_iter().map(|(name, ..)| format!("{id}.{name}")));
        if let Some(shape) = a.term.info().shape.filter(|_| !a.term.shape_is_parameter()) {
            names.push(format!("{id}.{}", shape.name));
        }
    }
    names
}

fn active_columns(a: &crate::linearization::Active) -> usize {
    let shape = a.term.info().shape.is_some() && !a.term.shape_is_parameter();
    a.values.len() + usize::from(shape)
}

/// Sentences about the combinations spanned by the columns of `null_space` (parameters x combinations).
pub fn unobservable(null_space: &DMatrix<f64>, names: &[String]) -> Vec<String> {
    let all = reduced(null_space);
    let moves_frame = |v: &&Vec<f64>| (0..v.len()).any(|k| v[k].abs() > TAKES_PART && is_frame(names, k));
    let (frames, rest): (Vec<&Vec<f64>>, Vec<&Vec<f64>>) = all.iter().partition(moves_frame);
    let mut sentences: Vec<String> = rest.iter().map(|v| sentence(v, names)).collect();
    sentences.dedup();
    sentences.extend(gauge(&frames, names));
    sentences
}

fn is_frame(names: &[String], k: usize) -> bool {
    names.get(k).is_some_and(|n| n.starts_with("metrology frame") || n.starts_with("target frame"))
}

/// Combinations that move a frame are one fact, not many: where the machine stands in the room is a convention.
fn gauge(combinations: &[&Vec<f64>], names: &[String]) -> Option<String> {
    let count = combinations.len();
    let part = |k: &usize| combinations.iter().any(|v| v[*k].abs() > TAKES_PART) && !is_frame(names, *k);
    let groups = (0..names.len()).filter(part).filter_map(|k| names[k].split('.').next().map(str::to_owned));
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
pub fn sentence(weights: &[f64], names: &[String]) -> String {
    let largest = weights.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
    let part: Vec<usize> = (0..weights.len()).filter(|&k| weights[k].abs() > TAKES_PART * largest).collect();
    let name = |k: usize| names.get(k).map_or("?", String::as_str);
    let legs = part.iter().all(|k| *k < 6);
    match part.as_slice() {
        [] => "nothing is undetermined".to_owned(),
        [one] => format!("{} does not show in the data at all", name(*one)),
        [one, other] if legs => {
            format!("legs {} and {} cannot be told apart", one + 1, other + 1)
        }
        [one, other] => format!("{} and {} cannot be told apart", name(*one), name(*other)),
        many if legs => {
            let numbers: Vec<String> = many.iter().map(|k| (k + 1).to_string()).collect();
            format!("legs {} cannot be told apart", joined(&numbers))
        }
        many => {
            let mut all: Vec<String> = many.iter().take(SPELLED_OUT).map(|k| name(*k).to_owned()).collect();
            if many.len() > SPELLED_OUT {
                all.push(format!("{} more", many.len() - SPELLED_OUT));
            }
            format!("{} cannot be told apart", joined(&all))
        }
    }
}

/// `a, b and c`.
pub fn joined<S: AsRef<str>>(words: &[S]) -> String {
    joined_with(words, "and")
}

/// `a, b or c`.
pub fn joined_with<S: AsRef<str>>(words: &[S], last_joint: &str) -> String {
    match words {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [head @ .., last] => {
            let head: Vec<&str> = head.iter().map(AsRef::as_ref).collect();
            format!("{} {last_joint} {}", head.join(", "), last.as_ref())
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
    use super::*;

    #[test]
    fn lists_read_as_sentences() {
        assert_eq!(joined(&["a"]), "a");
        assert_eq!(joined_with(&["a", "b", "c"], "or"), "a, b or c");
    }

    fn names() -> Vec<String> {
        (1..=6).map(|l| format!("leg {l}")).chain(["creep.fraction".to_owned()]).collect()
    }

    fn space(vectors: &[[f64; 7]]) -> DMatrix<f64> {
        DMatrix::from_fn(7, vectors.len(), |i, j| vectors[j][i])
    }

    #[test]
    fn two_legs_that_look_alike_are_named() {
        let v = [0.7, 0.0, 0.0, -0.7, 0.0, 0.0, 0.0];
        assert_eq!(unobservable(&space(&[v]), &names()), ["legs 1 and 4 cannot be told apart"]);
    }

    #[test]
    fn mixed_basis_vectors_are_taken_apart() {
        let (a, b) = ([0.5, 0.0, 0.5, 0.0, 0.0, 0.5, -0.5], [0.5, 0.0, 0.5, 0.0, 0.0, -0.5, 0.5]);
        let found = unobservable(&space(&[a, b]), &names());
        assert_eq!(
            found,
            ["legs 1 and 3 cannot be told apart", "leg 6 and creep.fraction cannot be told apart"]
        );
    }

    #[test]
    fn motions_of_a_frame_are_told_in_one_sentence() {
        let names =
            ["leg 1", "metrology frame x", "metrology frame y", "joint-geometry.a", "joint-geometry.b"];
        let names: Vec<String> = names.map(str::to_owned).into();
        let v = DMatrix::from_column_slice(5, 2, &[0.0, 0.6, 0.0, 0.8, 0.0, 0.0, 0.0, 0.6, 0.0, 0.8]);
        let found = unobservable(&v, &names);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with("2 combinations of joint-geometry are"), "{found:?}");
    }

    #[test]
    fn a_silent_leg_is_named() {
        let v = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        assert_eq!(unobservable(&space(&[v]), &names()), ["leg 2 does not show in the data at all"]);
    }
}
