//! An axis: title with unit, range, ticks.

use crate::number::fixed;

/// An axis with its title and unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    title: String,
    unit: String,
    range: Option<[f64; 2]>,
    ticks: Option<Vec<f64>>,
    logarithmic: bool,
}

impl Axis {
    /// An axis whose range follows the data; an empty unit is not shown.
    pub fn new(title: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { title: title.into(), unit: unit.into(), range: None, ticks: None, logarithmic: false }
    }

    /// The axis over a fixed range; data beyond it widen it.
    #[must_use]
    pub fn with_range(self, low: f64, high: f64) -> Self {
        Self { range: Some([low, high]), ..self }
    }

    /// The axis with ticks at these values only.
    #[must_use]
    pub fn with_ticks(self, ticks: Vec<f64>) -> Self {
        Self { ticks: Some(ticks), ..self }
    }

    /// The axis with equal steps for equal ratios; its numbers must be positive.
    #[must_use]
    pub fn with_logarithm(self) -> Self {
        Self { logarithmic: true, ..self }
    }

    /// True when numbers on it must be positive.
    pub(super) fn is_logarithmic(&self) -> bool {
        self.logarithmic
    }

    /// Title and unit as printed.
    pub(super) fn label(&self) -> String {
        match (self.title.as_str(), self.unit.as_str()) {
            (title, "") => title.to_owned(),
            ("", unit) => unit.to_owned(),
            (title, unit) => format!("{title} ({unit})"),
        }
    }

    /// The numbers that fix the axis beside the data.
    pub(super) fn fixed(&self) -> impl Iterator<Item = &f64> {
        self.range.iter().flatten().chain(self.ticks.iter().flatten())
    }

    /// The axis with its range and ticks settled, for finite `data` and at most `most` ticks.
    pub(super) fn scale(&self, data: impl IntoIterator<Item = f64>, most: usize) -> Scale {
        const AIR: f64 = 0.05;
        let [low, high] = extremes(data);
        let [low, high] = match self.range {
            Some([a, b]) => [a.min(b).min(low), a.max(b).max(high)],
            None if low > high => [0.0, 1.0],
            None if self.logarithmic => [low, high],
            None => [low - AIR * (high - low), high + AIR * (high - low)],
        };
        let [low, high] = if high > low { [low, high] } else { around(low) };
        let scale = Scale::new([low, high], self.ticks.as_deref(), most);
        if self.logarithmic { scale.with_logarithm(self.ticks.is_some()) } else { scale }
    }
}

/// A range about a single value.
fn around(value: f64) -> [f64; 2] {
    const SHARE: f64 = 0.1;
    let half = if value == 0.0 { 1.0 } else { SHARE * value.abs() };
    [value - half, value + half]
}

fn extremes(data: impl IntoIterator<Item = f64>) -> [f64; 2] {
    data.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)])
}

/// A settled axis.
pub(super) struct Scale {
    range: [f64; 2],
    /// Where ticks are, in the unit of the axis.
    pub(super) ticks: Vec<f64>,
    decimals: Option<usize>,
    logarithmic: bool,
}

impl Scale {
    fn new(range: [f64; 2], ticks: Option<&[f64]>, most: usize) -> Self {
        let within = |x: &f64| (range[0]..=range[1]).contains(x);
        let ticks: Vec<f64> = match ticks {
            Some(ticks) => ticks.iter().copied().filter(within).collect(),
            None => round_numbers(range, most),
        };
        let decimals = decimals(&ticks);
        Self { range, ticks, decimals, logarithmic: false }
    }

    fn with_logarithm(self, has_ticks: bool) -> Self {
        let ticks = if has_ticks { self.ticks } else { round_ratios(self.range) };
        Self { decimals: decimals(&ticks), ticks, logarithmic: true, ..self }
    }

    /// Place of a value between two ends in px.
    pub(super) fn place(&self, value: f64, [from, to]: [f64; 2]) -> f64 {
        let along = |x: f64| if self.logarithmic { x.ln() } else { x };
        let [low, high] = self.range.map(along);
        let share = (along(value) - low) / (high - low);
        from + share * (to - from)
    }

    /// Text of a tick, with as many decimals as all ticks of the axis need.
    pub(super) fn text(&self, tick: f64) -> String {
        match self.decimals {
            Some(decimals) => number(tick, decimals),
            None if tick == 0.0 => "0".to_owned(),
            None => signed(&format!("{tick:.1e}")),
        }
    }
}

/// Multiples of 1, 2, 2.5 or 5 times a power of ten within a range: the finest step with at most so many.
fn round_numbers([low, high]: [f64; 2], most: usize) -> Vec<f64> {
    const STEPS: [f64; 5] = [1.0, 2.0, 2.5, 5.0, 10.0];
    const EDGE: f64 = 1e-9;
    let rough = (high - low) / most as f64;
    let decade = 10.0_f64.powf(rough.log10().floor());
    let multiples = |step: f64| {
        let (first, last) = ((low / step - EDGE).ceil(), (high / step + EDGE).floor());
        let count = (last - first).max(-1.0) + 1.0;
        (first, count)
    };
    let fits = |step: &f64| multiples(*step).1 <= most as f64;
    let step = STEPS.iter().map(|s| s * decade).find(fits).unwrap_or(10.0 * decade);
    let (first, count) = multiples(step);
    let mut ticks = Vec::new();
    while (ticks.len() as f64) < count {
        ticks.push((first + ticks.len() as f64) * step);
    }
    ticks
}

/// 1, 2 and 5 times the powers of ten within a range of positive numbers.
fn round_ratios([low, high]: [f64; 2]) -> Vec<f64> {
    const MOST_DECADES: f64 = 12.0;
    let first = low.log10().floor();
    let decades = (high.log10().ceil() - first).clamp(1.0, MOST_DECADES);
    let decade = |k: usize| 10.0_f64.powf(first + k as f64);
    let all = (0..)
        .take_while(|&k| (k as f64) < decades)
        .flat_map(|k| [1.0, 2.0, 5.0, 10.0].map(|m| m * decade(k)));
    let mut ticks: Vec<f64> = all.filter(|x| (low..=high).contains(x)).collect();
    ticks.dedup();
    ticks
}

/// Fewest decimals that tell the ticks exactly; none when they are too large or too small for plain numbers.
fn decimals(ticks: &[f64]) -> Option<usize> {
    const MOST: usize = 5;
    const LARGE: f64 = 1e6;
    const EXACT: f64 = 1e-6;
    let step = ticks.windows(2).map(|t| t[1] - t[0]).fold(f64::INFINITY, f64::min);
    let whole = |d: &usize| {
        let factor = 10.0_f64.powi(i32::try_from(*d).unwrap_or(0));
        ticks.iter().all(|t| (t * factor - (t * factor).round()).abs() < EXACT * (step * factor).min(1.0))
    };
    if ticks.iter().any(|t| t.abs() >= LARGE) { None } else { (0..=MOST).find(whole) }
}

/// A number with so many decimals and a true minus sign.
pub(super) fn number(value: f64, decimals: usize) -> String {
    signed(&fixed(value, i32::try_from(decimals).unwrap_or(0)))
}

fn signed(text: &str) -> String {
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_as_many_as_fit() {
        assert_eq!(round_numbers([-5.2, 5.4], 3), [-5.0, 0.0, 5.0]);
        assert_eq!(round_numbers([0.0, 300.0], 7), [0.0, 50.0, 100.0, 150.0, 200.0, 250.0, 300.0]);
        assert_eq!(round_numbers([1.0e-6, 2.0e-6], 4).len(), 3);
    }

    #[test]
    fn equal_ratios_are_equal_steps_on_a_logarithmic_axis() {
        let scale = Axis::new("", "").with_logarithm().with_range(1.0, 100.0).scale([], 5);
        assert!((scale.place(10.0, [0.0, 1.0]) - 0.5).abs() < 1e-12);
        assert_eq!(scale.ticks, [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0]);
    }

    #[test]
    fn labels_have_the_decimals_that_all_ticks_need() {
        let scale = Axis::new("", "").with_range(0.0, 1.0).scale([], 5);
        let texts: Vec<String> = scale.ticks.iter().map(|&t| scale.text(t)).collect();
        assert_eq!(texts, ["0.00", "0.25", "0.50", "0.75", "1.00"]);
        let small = Axis::new("", "").scale([1.0e-9, 2.0e-9], 3);
        assert_eq!(small.text(small.ticks[0]), "1.0e\u{2212}9");
        assert_eq!(number(-0.001, 1), "0.0");
        assert_eq!(number(-2.5, 1), "\u{2212}2.5");
    }
}
