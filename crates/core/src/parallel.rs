//! Work on all cores, in order. Rayon's hand-over between threads is compiled once for each type of result here, not once for each
//! function: where every caller had its own, it was a seventh of what the compiler read.

use rayon::prelude::*;

/// `f` of every number below `count`, in order.
pub fn map_range<R: Send>(count: usize, f: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
    (0..count).into_par_iter().map(f).collect()
}

/// `f` of every item, in order.
pub fn map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    map_range(items.len(), &|at| f(&items[at]))
}

/// `f` of every item, in order.
///
/// # Errors
/// The first error in the order of the items.
pub fn try_map<T: Sync, R: Send, E: Send>(
    items: &[T],
    f: impl Fn(&T) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E> {
    map(items, f).into_iter().collect()
}

/// What `f` makes of the items, in order, without those of which it makes nothing.
pub fn filter_map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> Option<R> + Sync) -> Vec<R> {
    map(items, f).into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_made_stands_in_the_order_of_the_items() {
        let items: Vec<usize> = (0..1000).rev().collect();
        assert_eq!(map(&items, |k| 2 * k), items.iter().map(|k| 2 * k).collect::<Vec<_>>());
        let odd = filter_map(&items, |k| (k % 2 == 1).then_some(*k));
        assert_eq!(odd, items.iter().copied().filter(|k| k % 2 == 1).collect::<Vec<_>>());
        assert_eq!(try_map(&items, |k| Ok::<_, usize>(2 * k)), Ok(map(&items, |k| 2 * k)));
        assert_eq!(try_map(&items, |k| if k % 7 == 3 { Err(*k) } else { Ok(*k) }), Err(997));
        assert_eq!(map_range(3, &|k| k), [0, 1, 2]);
        assert!(map_range(0, &|k| k).is_empty());
    }
}
