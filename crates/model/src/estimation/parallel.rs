//! Work on all cores when there is enough of it.

use std::convert::Infallible;
use std::ops::{AddAssign, Range};

use hexbench_core::parallel;
use nalgebra::allocator::Allocator;
use nalgebra::{DMatrix, DMatrixView, DVector, DefaultAllocator, Dim, Dyn, OMatrix};

/// Below this many items the hand-over to other threads costs more than the work.
const WORTH_SHARING: usize = 512;

/// `f` of every item, in order.
pub(crate) fn map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    map_through(items, items.len(), f)
}

/// The same of items for each of which `f` goes through so many others.
pub(crate) fn map_through<T: Sync, R: Send>(
    items: &[T],
    others: usize,
    f: impl Fn(&T) -> R + Sync + Send,
) -> Vec<R> {
    if others < WORTH_SHARING { items.iter().map(f).collect() } else { parallel::map(items, f) }
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

/// Columns up to which products of one column with another are faster than kernels for blocks, which want the narrower side transposed.
const FEW_COLUMNS: usize = 5;

/// So many rows in strips.
pub(crate) fn strips(rows: usize) -> Vec<Range<usize>> {
    (0..rows).step_by(STRIP_ROWS).map(|first| first..(first + STRIP_ROWS).min(rows)).collect()
}

/// `A' B` of tall matrices, strip by strip on all cores; the same bytes on any number of them.
pub(crate) fn products<'a, 'b>(
    a: impl Into<DMatrixView<'a, f64>>,
    b: impl Into<DMatrixView<'b, f64>>,
) -> DMatrix<f64> {
    let (a, b) = (a.into(), b.into());
    let strip = |rows: &Range<usize>| {
        let (first, rows) = (rows.start, rows.len());
        let (a, b) = (a.rows(first, rows), b.rows(first, rows));
        match (a.ncols(), b.ncols()) {
            (m, n) if m.min(n) <= FEW_COLUMNS => a.tr_mul(&b),
            (m, n) if m <= n => a.transpose() * b,
            _ => (b.transpose() * a).transpose(),
        }
    };
    sum_in_order(&strips(a.nrows()), strip).unwrap_or_else(|| DMatrix::zeros(a.ncols(), b.ncols()))
}

/// Takes `Z B` off tall columns, strip by strip on all cores; the same bytes on any number of them.
pub(crate) fn take_product<C: Dim>(a: &mut OMatrix<f64, Dyn, C>, z: &DMatrix<f64>, b: &OMatrix<f64, Dyn, C>)
where
    DefaultAllocator: Allocator<Dyn, C, Buffer<f64>: Send + Sync>,
{
    if z.nrows() <= STRIP_ROWS {
        return a.gemm(-1.0, z, b, 1.0);
    }
    let strips = strips(z.nrows());
    let rest = parallel::map(&strips, |rows| rows_without(a, z, b, rows));
    for (rows, strip) in strips.into_iter().zip(rest) {
        a.rows_mut(rows.start, strip.nrows()).copy_from(&strip);
    }
}

/// Some rows, column by column: nalgebra's `into_owned` takes them number by number.
pub(crate) fn copied_rows<C: Dim>(a: &OMatrix<f64, Dyn, C>, rows: &Range<usize>) -> OMatrix<f64, Dyn, C>
where
    DefaultAllocator: Allocator<Dyn, C>,
{
    let mut strip = OMatrix::zeros_generic(Dyn(rows.len()), a.shape_generic().1);
    strip.copy_from(&a.rows(rows.start, rows.len()));
    strip
}

/// Some rows of `A - Z B`.
pub(crate) fn rows_without<C: Dim>(
    a: &OMatrix<f64, Dyn, C>,
    z: &DMatrix<f64>,
    b: &OMatrix<f64, Dyn, C>,
    rows: &Range<usize>,
) -> OMatrix<f64, Dyn, C>
where
    DefaultAllocator: Allocator<Dyn, C>,
{
    let mut strip = copied_rows(a, rows);
    strip.gemm(-1.0, &z.rows(rows.start, rows.len()), b, 1.0);
    strip
}

/// `A' x` of a tall matrix, strip by strip on all cores; the same bytes on any number of them.
pub(crate) fn product(a: &DMatrix<f64>, x: &DVector<f64>) -> DVector<f64> {
    let strip = |rows: &Range<usize>| a.rows(rows.start, rows.len()).tr_mul(&x.rows(rows.start, rows.len()));
    sum_in_order(&strips(a.nrows()), strip).unwrap_or_else(|| DVector::zeros(a.ncols()))
}

/// Sum of a matrix per item, added in order whatever thread made it; `None` for no items.
pub(crate) fn sum_in_order<T: Sync, M: AddAssign + Send>(
    items: &[T],
    f: impl Fn(&T) -> M + Sync + Send,
) -> Option<M> {
    let mut total: Option<M> = None;
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
