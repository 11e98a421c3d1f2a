//! Work on all cores when there is enough of it.

use rayon::prelude::*;

/// Below this many items the hand-over to other threads costs more than the work.
const WORTH_SHARING: usize = 512;

/// `f` of every item, in order.
pub(crate) fn map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync + Send) -> Vec<R> {
    if items.len() < WORTH_SHARING {
        items.iter().map(f).collect()
    } else {
        items.par_iter().map(f).collect()
    }
}

/// `f` of every item, in order; the first error in order wins.
pub(crate) fn try_map<T: Sync, R: Send, E: Send>(
    items: &[T],
    f: impl Fn(&T) -> Result<R, E> + Sync + Send,
) -> Result<Vec<R>, E> {
    map(items, f).into_iter().collect()
}
