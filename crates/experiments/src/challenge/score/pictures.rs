//! Charts of the leaderboard: do probabilities and intervals mean what they say, and how large must an effect be to be found?

use hexbench_core::statistics::Proportion;
use hexbench_report::Figure;
use hexbench_report::plot::{Axis, Chart, Panels, PlotError, Series};
use statrs::distribution::{ContinuousCDF, Normal};

use super::EntrantScore;
use super::case::CaseScore;

/// Stated probabilities of a chart's bins.
const BORDERS: [f64; 6] = [0.0, 0.5, 0.8, 0.95, 0.99, 1.0 + 1e-9];
/// Shares that stated intervals claim to hold.
const CLAIMED: [f64; 6] = [0.5, 0.68, 0.8, 0.9, 0.95, 0.99];
/// Points of a power curve.
const STEPS: usize = 5;
/// Cases of a point at least.
const LEAST_CASES: usize = 4;

const RELIABILITY: &str = "How often the explanation that a program finds most probable is true, over the probability stated for it, where at most one effect \
is hidden. Below the dashed line: surer than it may be.";

const INTERVALS: &str = "Stated intervals of the leg stiffnesses: the share that holds the truth, over the share they claim. Below the dashed line: too narrow.";

/// Is the most probable explanation true as often as is stated? One panel for each program; none where nobody states any.
pub(super) fn reliability(entrants: &[EntrantScore]) -> Result<Option<Figure>, PlotError> {
    let panels: Vec<Chart> = entrants.iter().filter_map(of_entrant).collect();
    if panels.is_empty() {
        return Ok(None);
    }
    let columns = panels.len().min(3);
    let grid = Panels::new("", columns).with_panel_size(240.0, 220.0);
    let grid = panels.into_iter().fold(grid, Panels::with);
    Figure::in_panels(&grid, RELIABILITY).map(Some)
}

fn of_entrant(entrant: &EntrantScore) -> Option<Chart> {
    // Where one probability is the largest, that of the truth is it or the first statement is false.
    let claims: Vec<(f64, bool)> = entrant
        .cases
        .iter()
        .filter_map(|c| Some((c.confidence?, (c.forecast?.stated - c.confidence?).abs() < 1e-12)))
        .collect();
    let bins: Vec<(f64, Proportion)> =
        BORDERS.windows(2).filter_map(|b| bin(&claims, [b[0], b[1]])).collect();
    let bounds = |(stated, p): &(f64, Proportion)| [*stated, p.interval()[0], p.interval()[1]];
    let axis = |title| Axis::new(title, "").with_range(0.0, 1.0).with_ticks(vec![0.0, 0.25, 0.5, 0.75, 1.0]);
    let chart = Chart::new(entrant.name.as_str(), axis("Stated"), axis("Came true"));
    (!bins.is_empty()).then(|| {
        chart
            .with(Series::line("as it should be", vec![[0.0, 0.0], [1.0, 1.0]]).as_reference())
            .with(Series::band("95 % bounds", bins.iter().map(bounds).collect()).with_look(0))
            .with(
                Series::marked_line("first explanation", bins.iter().map(|(s, p)| [*s, p.rate()]).collect())
                    .with_look(0),
            )
    })
}

fn bin(claims: &[(f64, bool)], [low, high]: [f64; 2]) -> Option<(f64, Proportion)> {
    let inside: Vec<&(f64, bool)> = claims.iter().filter(|(p, _)| (low..high).contains(p)).collect();
    let stated = inside.iter().map(|(p, _)| p).sum::<f64>() / inside.len() as f64;
    let came_true = Proportion::count(inside, |(_, is_true)| *is_true);
    (came_true.of >= LEAST_CASES).then_some((stated.min(1.0), came_true))
}

/// Do stated intervals of the leg stiffnesses hold as often as they claim? None where nobody states any.
pub(super) fn intervals(entrants: &[EntrantScore]) -> Result<Option<Figure>, PlotError> {
    let axis =
        |title| Axis::new(title, "%").with_range(40.0, 100.0).with_ticks(vec![40.0, 60.0, 80.0, 95.0, 100.0]);
    let ideal = Series::line("as it should be", vec![[40.0, 40.0], [100.0, 100.0]]).as_reference();
    let mut chart = Chart::new("", axis("Claimed"), axis("Held")).with(ideal).with_size(560.0, 380.0);
    let mut any = false;
    for (number, entrant) in entrants.iter().enumerate() {
        let z: Vec<f64> =
            entrant.cases.iter().flat_map(|c| c.legs.iter().flatten().filter_map(|l| l.z)).collect();
        if !z.is_empty() {
            any = true;
            let points = CLAIMED.map(|claimed| [100.0 * claimed, 100.0 * held(&z, claimed)]).to_vec();
            chart = chart.with(Series::marked_line(entrant.name.as_str(), points).with_look(number));
        }
    }
    any.then(|| Ok(Figure::laid_out(chart.laid_out()?, INTERVALS))).transpose()
}

fn held(z: &[f64], claimed: f64) -> f64 {
    let half = Normal::new(0.0, 1.0).map_or(f64::NAN, |law| law.inverse_cdf(0.5 * (1.0 + claimed)));
    Proportion::count(z, |z| z.abs() <= half).rate()
}

/// How often a single effect is named, over its distance; none without such cases or diagnoses.
pub(super) fn power(entrants: &[EntrantScore]) -> Result<Option<Figure>, PlotError> {
    let single = |c: &&CaseScore| c.effects.len() == 1 && c.distance > 0.0;
    let mut distances: Vec<f64> =
        entrants.first().map_or(Vec::new(), |e| e.cases.iter().filter(single).map(|c| c.distance).collect());
    distances.sort_by(f64::total_cmp);
    let size = distances.len() / STEPS;
    if size < LEAST_CASES {
        return Ok(None);
    }
    let edges: Vec<[f64; 2]> =
        distances.chunks(distances.len().div_ceil(STEPS)).map(|c| [c[0], c[c.len() - 1]]).collect();
    let x = Axis::new("Distance of the effect, in standard deviations", "").with_logarithm();
    let y = Axis::new("Right", "%").with_range(0.0, 100.0).with_ticks(vec![0.0, 25.0, 50.0, 75.0, 100.0]);
    let mut chart = Chart::new("", x, y).with_size(560.0, 340.0);
    let mut any = false;
    for (number, entrant) in entrants.iter().enumerate().filter(|(_, e)| e.all.outcomes.is_some()) {
        any = true;
        let point = |[low, high]: &[f64; 2]| {
            let inside: Vec<&CaseScore> = entrant
                .cases
                .iter()
                .filter(single)
                .filter(|c| (*low..=*high).contains(&c.distance))
                .collect();
            let right = Proportion::count(&inside, |c| c.outcome == Some("right"));
            [(low * high).sqrt(), 100.0 * right.rate()]
        };
        chart = chart.with(
            Series::marked_line(entrant.name.as_str(), edges.iter().map(point).collect()).with_look(number),
        );
    }
    let caption = format!(
        "Cases with one hidden effect whose diagnosis is right, over the length of the effect's signature in standard deviations of the noise. A point \
         stands for {size} cases or one more: one case moves it by {:.0} %.",
        100.0 / size as f64
    );
    any.then(|| Ok(Figure::laid_out(chart.laid_out()?, caption))).transpose()
}
