//! Bars of text.

/// A bar of `share` of `width` columns, rounded.
pub fn bar(share: f64, width: usize) -> String {
    let length = share * width as f64;
    (0..width).take_while(|k| *k as f64 + 0.5 <= length).map(|_| '#').collect()
}

#[cfg(test)]
mod tests {
    use super::bar;

    #[test]
    fn a_bar_is_as_long_as_its_share() {
        assert_eq!(bar(0.5, 10), "#####");
        assert_eq!(bar(0.0, 10), "");
        assert_eq!(bar(7.0, 3), "###");
        assert_eq!(bar(f64::NAN, 3), "");
    }
}
