//! The panels that carry the story: residual elongations over what they follow most significantly, one panel for each thing followed.
//!
//! Each panel has its points, means of bins with their standard uncertainty, and the course that the F test asks about: a parabola
//! through the points (two means for the approach).

use hexbench_core::statistics::mean;
use nalgebra::{Matrix3, Vector3};

use super::JudgedModel;
use super::association::{Association, COMPLIANCE, spearman};
use super::follows::Follows;
use crate::estimation::campaign::Condition;

/// Panels that carry the story.
pub const STORY_PANELS: usize = 3;
/// Rank correlation from which two variables are one thing.
const ONE_THING: f64 = 0.95;
/// Changes of leg force below this share of the largest tell nothing of a compliance.
const LEAST_FORCE: f64 = 0.2;
/// Bins of a panel, and the least points of each.
const BINS: usize = 8;
const FEWEST_IN_A_BIN: usize = 4;
/// Places at which a course is given.
const PLACES: usize = 25;

/// One leg under one condition in a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StoryPoint {
    /// Index of the condition.
    pub condition: usize,
    /// Leg, from zero.
    pub leg: usize,
    /// What is followed, in [`StoryPanel::unit`].
    pub x: f64,
    /// Residual elongation, um; per change of leg force, nm/N, where a compliance is asked about.
    pub y: f64,
    /// What an elongation in um is divided by to be drawn beside `y`.
    pub per: f64,
}

/// A mean of a panel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StoryBin {
    /// Mean of what is followed.
    pub x: f64,
    /// Mean residual.
    pub mean: f64,
    /// Its standard uncertainty, from the scatter within the bin.
    pub std: f64,
}

/// Residuals over what they follow.
#[derive(Debug, Clone, PartialEq)]
pub struct StoryPanel {
    /// What is followed, and how significantly.
    pub association: Association,
    /// Words for what is followed.
    pub title: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Every leg and condition of the question.
    pub points: Vec<StoryPoint>,
    /// Means of bins.
    pub bins: Vec<StoryBin>,
    /// The course asked about.
    pub course: Vec<[f64; 2]>,
    /// Changes of leg force of which less tells nothing of a compliance, N.
    least_force: f64,
}

impl StoryPanel {
    /// Where a leg under a condition stands in the panel: along what is followed, and what its elongation in um is divided by. None where
    /// the panel does not show it.
    pub fn place(&self, at: &Condition, leg: usize) -> Option<[f64; 2]> {
        let follows = Follows::named(self.association.variable)?;
        let asked = self.association.leg.is_none_or(|only| only == leg + 1);
        let change = at.force_change()[leg];
        let per = if self.is_compliance() { 1e-3 * change } else { 1.0 };
        (asked && (!self.is_compliance() || change.abs() > self.least_force))
            .then(|| [follows.drawn(at, leg), per])
    }

    /// True when the compliance of the legs follows, not their length.
    pub fn is_compliance(&self) -> bool {
        self.association.of == COMPLIANCE
    }
}

/// The most significant associations as panels: variables that say the same get one.
pub fn story(judged: &JudgedModel<'_>, associations: &[Association]) -> Vec<StoryPanel> {
    let mut panels: Vec<StoryPanel> = Vec::new();
    for association in associations {
        let Some(panel) = StoryPanel::of(judged, association) else { continue };
        if panels.len() < STORY_PANELS && !panels.iter().any(|known| is_one_thing(judged, known, &panel)) {
            panels.push(panel);
        }
    }
    panels
}

/// True when two panels ask about one variable, or about two that go together in these readings.
fn is_one_thing(judged: &JudgedModel<'_>, a: &StoryPanel, b: &StoryPanel) -> bool {
    if a.association.variable == b.association.variable {
        return true;
    }
    let [Some(x), Some(y)] = [a, b].map(|panel| Follows::named(panel.association.variable)) else {
        return false;
    };
    let of = |follows: Follows| -> Vec<f64> {
        let conditions = judged.space.determined().into_iter().map(|i| &judged.lin.conditions[i]);
        conditions.flat_map(|c| (0..6).map(|leg| follows.value(c, leg)).collect::<Vec<_>>()).collect()
    };
    spearman(&of(x), &of(y)).abs() > ONE_THING
}

impl StoryPanel {
    fn of(judged: &JudgedModel<'_>, association: &Association) -> Option<Self> {
        let follows = Follows::named(association.variable)?;
        let (title, unit) = follows.shown();
        let asked = |leg: &usize| association.leg.is_none_or(|only| only == leg + 1);
        let conditions = judged.space.determined();
        let all = || conditions.iter().flat_map(|&i| (0..6).filter(asked).map(move |leg| (i, leg)));
        let force = |(i, leg): (usize, usize)| judged.lin.conditions[i].force_change()[leg].abs();
        let least_force = LEAST_FORCE * all().map(force).fold(0.0, f64::max);
        let (association, points, bins, course) = (association.clone(), Vec::new(), Vec::new(), Vec::new());
        let mut panel = Self { association, title, unit, points, bins, course, least_force };
        panel.points = all().filter_map(|(i, leg)| panel.point(judged, i, leg)).collect();
        panel.bins = bins_of(&panel.points);
        if follows != Follows::Approach {
            panel.course = course_through(&panel.points);
        }
        (!panel.points.is_empty()).then_some(panel)
    }

    fn point(&self, judged: &JudgedModel<'_>, condition: usize, leg: usize) -> Option<StoryPoint> {
        let [x, per] = self.place(&judged.lin.conditions[condition], leg)?;
        let y = judged.space.elongation[condition][leg] * 1e6 / per;
        Some(StoryPoint { condition, leg, x, y, per })
    }
}

/// Means of as many points each, along what is followed; equal places are not parted.
fn bins_of(points: &[StoryPoint]) -> Vec<StoryBin> {
    let mut sorted: Vec<[f64; 2]> = points.iter().map(|p| [p.x, p.y]).collect();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let size = sorted.len().div_ceil(BINS).max(FEWEST_IN_A_BIN);
    let mut all = Vec::new();
    let mut from = 0;
    while from < sorted.len() {
        let mut to = (from + size).min(sorted.len());
        while to < sorted.len() && sorted[to][0] <= sorted[to - 1][0] {
            to += 1;
        }
        all.extend(bin(&sorted[from..to]));
        from = to;
    }
    all
}

fn bin(of: &[[f64; 2]]) -> Option<StoryBin> {
    let n = of.len() as f64;
    let [x, y] = [0, 1].map(|k| mean(of.iter().map(|p| p[k])));
    let (x, y) = (x?, y?);
    let variance = of.iter().map(|p| (p[1] - y).powi(2)).sum::<f64>() / (n - 1.0);
    (of.len() >= FEWEST_IN_A_BIN).then(|| StoryBin { x, mean: y, std: (variance / n).sqrt() })
}

/// The parabola through the points.
fn course_through(points: &[StoryPoint]) -> Vec<[f64; 2]> {
    let ends = points.iter().fold([f64::MAX, f64::MIN], |[l, h], p| [l.min(p.x), h.max(p.x)]);
    let along = |x: f64| 2.0 * (x - ends[0]) / (ends[1] - ends[0]) - 1.0;
    let mut normal = Matrix3::zeros();
    let mut right = Vector3::zeros();
    for p in points {
        let row = Vector3::new(1.0, along(p.x), along(p.x).powi(2));
        normal += row * row.transpose();
        right += row * p.y;
    }
    let Some(c) = normal.cholesky().map(|l| l.solve(&right)) else { return Vec::new() };
    let place = |k: usize| ends[0] + (ends[1] - ends[0]) * k as f64 / (PLACES - 1) as f64;
    let value = |x: f64| c[0] + c[1] * along(x) + c[2] * along(x).powi(2);
    (0..PLACES).map(place).map(|x| [x, value(x)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: f64, y: f64) -> StoryPoint {
        StoryPoint { condition: 0, leg: 0, x, y, per: 1.0 }
    }

    #[test]
    fn a_parabola_is_its_own_course() {
        let of = |x: f64| 3.0 - 2.0 * x + 0.5 * x * x;
        let points: Vec<StoryPoint> = (0..30).map(f64::from).map(|x| point(x, of(x))).collect();
        for [x, y] in course_through(&points) {
            assert!((y - of(x)).abs() < 1e-9, "{x} {y}");
        }
    }

    #[test]
    fn bins_keep_equal_places_together_and_tell_their_scatter() {
        let points: Vec<StoryPoint> =
            (0..48).map(|k| point(f64::from(k / 16), if k % 2 == 0 { 1.0 } else { 3.0 })).collect();
        let found = bins_of(&points);
        assert_eq!(found.len(), 3);
        for (k, bin) in found.iter().enumerate() {
            // Sixteen values of 1 and 3: variance 16/15.
            assert!((bin.x - k as f64).abs() < 1e-12 && (bin.mean - 2.0).abs() < 1e-12);
            assert!((bin.std - (16.0_f64 / 15.0 / 16.0).sqrt()).abs() < 1e-12);
        }
    }
}
