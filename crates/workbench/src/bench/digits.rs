//! Numbers with as many digits as a chart can show: answers stay small.

/// Steps of a number in the unit of its list: 0.1 nm, 0.1 nrad, 0.1 mN.
const STEPS: f64 = 1e4;

/// A number without digits nobody sees.
pub(super) fn short(x: f64) -> f64 {
    (x * STEPS).round() / STEPS
}

/// Six of them.
pub(super) fn all_short(x: impl Into<[f64; 6]>) -> [f64; 6] {
    x.into().map(short)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_digits_are_written() {
        assert_eq!(serde_json::to_string(&short(1.234_567_89)).unwrap(), "1.2346");
        assert_eq!(
            serde_json::to_string(&all_short([0.0, 1.0, -1e-9, 1e5, 0.1, 2.5])).unwrap(),
            "[0.0,1.0,-0.0,100000.0,0.1,2.5]"
        );
    }
}
