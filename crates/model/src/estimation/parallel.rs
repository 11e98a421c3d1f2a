//! Work on all cores when there is enough of it.

use std::convert::Infallible;
use std::ops::Range;

use hexbench_core::parallel;
use nalgebra::{DMatrix, DVector};

/// Below this many items the hand-over to other threads costs more than the work.
const WORTH_SHARING: usize = 512;

/// `f` of every item, in order.
pub(crate) fn map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    if items.len() < WORTH_SHARING { items.iter().map(f).collect() } else { parallel::map(items, f) }
}

/// `f` of every item, in order; the first error in order wins.
pub(crate) fn try_map<T: Sync, R: Send, E: Send>(
    items: &[T],
    f: impl Fn(&T) -> Result<R, E> + Sync + Send,
) -> Result<Vec<R>, E> {
    map(items, f).into_iter().collect()
}

/// Rows taken at a time: few enough for all columns of a strip of them to stay in the cache.
const STRIP_ROWS: usize = 1536;

/// So many rows in strips.
pub(crate) fn strips(rows: usize) -> Vec<Range<usize>> {
    (0..rows).step_by(STRIP_ROWS).map(|first| first..(first + STRIP_ROWS).min(rows)).collect()
}

/// `A' B` of tall matrices, strip by strip on all cores; the same bytes on any number of them.
pub(crate) fn products(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let strip = |rows: &Range<usize>| {
        let (first, rows) = (rows.start, rows.len());
        let mut product = DMatrix::zeros(a.ncols(), b.ncols());
        // The product of a transposed copy has kernels of its own, that of a transposed view goes number by number.
        product.gemm(1.0, &a.rows(first, rows).transpose(), &b.rows(first, rows), 0.0);
        product
    };
    sum_in_order(&strips(a.nrows()), strip).unwrap_or_else(|| DMatrix::zeros(a.ncols(), b.ncols()))
}

/// Takes `Z B` off a tall matrix, strip by strip on all cores; the same bytes on any number of them.
pub(crate) fn take_product(a: &mut DMatrix<f64>, z: &DMatrix<f64>, b: &DMatrix<f64>) {
    if z.nrows() <= STRIP_ROWS {
        return a.gemm(-1.0, z, b, 1.0);
    }
    let strips = strips(z.nrows());
    let rest: Vec<DMatrix<f64>> = parallel::map(&strips, |rows| {
        let mut strip = a.rows(rows.start, rows.len()).into_owned();
        strip.gemm(-1.0, &z.rows(rows.start, rows.len()), b, 1.0);
        strip
    });
    for (rows, strip) in strips.into_iter().zip(rest) {
        a.rows_mut(rows.start, strip.nrows()).copy_from(&strip);
    }
}

/// `A' x` of a tall matrix, strip by strip on all cores; the same bytes on any number of them.
pub(crate) fn product(a: &DMatrix<f64>, x: &DVector<f64>) -> DVector<f64> {
    let strip = |rows: &Range<usize>| a.rows(rows.start, rows.len()).tr_mul(&x.rows(rows.start, rows.len()));
    let mut total = DVector::zeros(a.ncols());
    let Ok(()) =
        try_take_in_order(&strips(a.nrows()), |rows| Ok::<_, Infallible>(strip(rows)), |one| total += one);
    total
}

/// Takes `Z b` off a tall column, as [`take_product`] does.
pub(crate) fn take_from(x: &mut DVector<f64>, z: &DMatrix<f64>, b: &DVector<f64>) {
    let strips = strips(z.nrows());
    if strips.len() < 2 {
        return x.gemv(-1.0, z, b, 1.0);
    }
    let rest: Vec<DVector<f64>> = parallel::map(&strips, |rows| {
        let mut strip = x.rows(rows.start, rows.len()).into_owned();
        strip.gemv(-1.0, &z.rows(rows.start, rows.len()), b, 1.0);
        strip
    });
    for (rows, strip) in strips.into_iter().zip(rest) {
        x.rows_mut(rows.start, strip.nrows()).copy_from(&strip);
    }
}

/// Sum of a matrix per item, added in order whatever thread made it; `None` for no items.
pub(crate) fn sum_in_order<T: Sync>(
    items: &[T],
    f: impl Fn(&T) -> DMatrix<f64> + Sync + Send,
) -> Option<DMatrix<f64>> {
    let mut total: Option<DMatrix<f64>> = None;
    let add = |piece| match &mut total {
        Some(sum) => *sum += piece,
        None => total = Some(piece),
    };
    let Ok(()) = try_take_in_order(items, |item| Ok::<_, Infallible>(f(item)), add);
    total
}

/// Hands over what is made of each item, in order whatever thread made it; the first error in order ends it. A batch at a time, so that
/// memory does not grow with the number of items.
pub(crate) fn try_take_in_order<T: Sync, R: Send, E: Send>(
    items: &[T],
    f: impl Fn(&T) -> Result<R, E> + Sync + Send,
    mut take: impl FnMut(R),
) -> Result<(), E> {
    for batch in items.chunks(4 * rayon::current_num_threads().max(1)) {
        let pieces: Vec<Result<R, E>> =
            if batch.len() == 1 { vec![f(&batch[0])] } else { parallel::map(batch, &f) };
        for piece in pieces {
            take(piece?);
        }
    }
    Ok(())
}
