//! Small dense linear equations without allocation.

/// Largest number of unknowns: six legs and three bodies.
pub(crate) const MOST: usize = 24;

/// Square matrix with room for the largest system; only the leading block is used.
pub(crate) type Square = [[f64; MOST]; MOST];

/// Solves `a x = b` in place for the leading `n` unknowns by elimination with row pivoting.
///
/// Returns the smallest pivot over the largest one; `b` then holds the solution (meaningless when the ratio is zero).
pub(crate) fn solve(a: &mut Square, b: &mut [f64; MOST], n: usize) -> f64 {
    let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
    for k in 0..n {
        let pivot_row = (k..n).fold(k, |best, i| if a[i][k].abs() > a[best][k].abs() { i } else { best });
        a.swap(k, pivot_row);
        b.swap(k, pivot_row);
        let pivot = a[k][k].abs();
        smallest = smallest.min(pivot);
        largest = largest.max(pivot);
        if pivot == 0.0 || !pivot.is_finite() {
            return 0.0;
        }
        eliminate_below(a, b, k, n);
    }
    substitute_back(a, b, n);
    smallest / largest
}

fn eliminate_below(a: &mut Square, b: &mut [f64; MOST], k: usize, n: usize) {
    let top = a[k];
    for i in k + 1..n {
        let factor = a[i][k] / top[k];
        if factor != 0.0 {
            for (x, y) in a[i][k + 1..n].iter_mut().zip(&top[k + 1..n]) {
                *x -= factor * y;
            }
            b[i] -= factor * b[k];
        }
    }
}

fn substitute_back(a: &Square, b: &mut [f64; MOST], n: usize) {
    for i in (0..n).rev() {
        let known: f64 = (i + 1..n).map(|j| a[i][j] * b[j]).sum();
        b[i] = (b[i] - known) / a[i][i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_exchanged_where_the_diagonal_is_zero() {
        let (mut a, mut b) = ([[0.0; MOST]; MOST], [0.0; MOST]);
        (a[0][1], a[0][2], a[1][0], a[2][1], a[2][2]) = (2.0, 1.0, 4.0, 1.0, 3.0);
        (b[0], b[1], b[2]) = (7.0, 8.0, 11.0);
        assert!(solve(&mut a, &mut b, 3) > 0.1);
        assert!([2.0, 2.0, 3.0].iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-14));
    }
}
