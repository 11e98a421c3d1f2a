//! Orders in which names may have been given to balls.

/// Most balls of which every order is tried; of more, every exchange of two.
const MOST_IN_ALL_ORDERS: usize = 5;

/// Orders of so many balls; the first leaves them as they are.
pub(super) fn orders(count: usize) -> Vec<Vec<usize>> {
    let as_named: Vec<usize> = (0..count).collect();
    if count > MOST_IN_ALL_ORDERS {
        let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
        let exchanged = pairs.map(|(i, j)| {
            let mut order = as_named.clone();
            order.swap(i, j);
            order
        });
        return std::iter::once(as_named.clone()).chain(exchanged).collect();
    }
    let mut all = vec![Vec::new()];
    for _ in 0..count {
        let longer = |begun: Vec<usize>| {
            let left = as_named.iter().filter(|k| !begun.contains(k)).copied().collect::<Vec<_>>();
            left.into_iter().map(move |k| begun.iter().copied().chain([k]).collect())
        };
        all = all.into_iter().flat_map(longer).collect();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::orders;

    #[test]
    fn all_orders_of_few_and_all_exchanges_of_many() {
        assert_eq!(orders(4).len(), 24);
        assert_eq!(orders(4)[0], [0, 1, 2, 3]);
        assert_eq!(orders(7).len(), 22);
    }
}
