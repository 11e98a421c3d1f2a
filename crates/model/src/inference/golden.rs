//! The top of a peak, by golden sections.

const RATIO: f64 = 0.618_033_988_749_894_9;

/// Place between two ends where a function with one peak is largest, after so many steps.
///
/// # Errors
/// Those of the function.
pub(crate) fn golden<E>(
    ends: [f64; 2],
    steps: usize,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let (mut low, mut high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
    let (mut x, mut y) = (high - RATIO * (high - low), low + RATIO * (high - low));
    let (mut fx, mut fy) = (f(x)?, f(y)?);
    for _ in 0..steps {
        if fx > fy {
            (high, y, fy) = (y, x, fx);
            x = high - RATIO * (high - low);
            fx = f(x)?;
        } else {
            (low, x, fx) = (x, y, fy);
            y = low + RATIO * (high - low);
            fy = f(y)?;
        }
    }
    Ok(f64::midpoint(low, high))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_top_of_a_peak_is_found_between_its_neighbors() {
        for top in [0.1, 0.5, 0.8] {
            let found = golden([1.0, 0.0], 20, |x: f64| Ok::<_, String>(-(x - top).powi(2))).unwrap();
            assert!((found - top).abs() < 1e-4, "{top}: {found}");
        }
        let failed = golden([0.0, 1.0], 20, |_| Err("no value".to_owned()));
        assert_eq!(failed, Err("no value".to_owned()));
    }
}
