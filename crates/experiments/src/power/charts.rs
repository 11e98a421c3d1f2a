//! Charts of a plan's power.

use hexbench_design::power::{Alike, EffectPower, NOTHING};
use hexbench_report::plot::{Axis, Chart, HeatMap, Panels, PlotError, Series};

use super::{Power, PowerCheck, Simulated};
use crate::calibration::NamedChart;

const PERCENT: f64 = 100.0;
/// Shares below this stay blank.
const SHOWN_PERCENT: f64 = 1.0;

/// All charts; the heat map of what is taken for what comes first.
///
/// # Errors
/// [`PlotError`].
pub fn pictures(power: &Power) -> Result<Vec<NamedChart>, PlotError> {
    let mut all = Vec::new();
    let mut add = |file, svg| all.push(NamedChart { file, svg });
    let alike = &power.study.alike;
    let shows = |e: &&EffectPower| e.shows();
    if power.study.effects.iter().any(|e| shows(&e)) {
        add("taken-for.svg", taken_for(alike)?);
        add("power.svg", curves(power)?);
    }
    if alike.cosine.iter().flatten().any(|c| *c > 0.0) {
        add("cosine.svg", cosines(alike)?);
    }
    Ok(all)
}

fn names(ids: &[&str]) -> Vec<String> {
    ids.iter().map(ToString::to_string).collect()
}

fn taken_for(alike: &Alike) -> Result<String, PlotError> {
    let shown: Vec<usize> = (0..alike.terms.len()).filter(|&k| !alike.taken_for[k].is_empty()).collect();
    let rows = shown.iter().map(|&k| alike.terms[k].to_owned()).collect();
    let columns = shown.iter().map(|&k| alike.terms[k]).chain([NOTHING]).collect::<Vec<_>>();
    let in_percent = |x: f64| if PERCENT * x < SHOWN_PERCENT { 0.0 } else { PERCENT * x };
    let row = |&k: &usize| {
        let places = shown.iter().copied().chain([alike.terms.len()]);
        places.map(|j| in_percent(alike.taken_for[k][j])).collect()
    };
    let title = "Best explanation of an effect of the size that is seen, percent";
    HeatMap::new(title, rows, names(&columns), shown.iter().map(row).collect())
        .with_axis_titles("At work", "Best explanation")
        .with_full_shade_at(PERCENT)
        .to_svg()
}

fn cosines(alike: &Alike) -> Result<String, PlotError> {
    let shown: Vec<usize> = (0..alike.terms.len()).filter(|&k| alike.cosine[k][k] > 0.0).collect();
    let ids: Vec<String> = shown.iter().map(|&k| alike.terms[k].to_owned()).collect();
    let row = |&i: &usize| shown.iter().map(|&j| alike.cosine[i][j]).collect();
    let title = "Likeness of signatures after the springs (cosine)";
    HeatMap::new(title, ids.clone(), ids, shown.iter().map(row).collect())
        .with_decimals(2)
        .with_cell_size(34.0, 24.0)
        .with_full_shade_at(1.0)
        .to_svg()
}

/// Power over the size of every effect that can be seen at all.
fn curves(power: &Power) -> Result<String, PlotError> {
    const COLUMNS: usize = 4;
    let seen = power.study.effects.iter().zip(&power.checks).filter(|(e, _)| e.shows());
    seen.map(|(e, check)| curve(e, check))
        .fold(Panels::new("Chance to see an effect over its size", COLUMNS), Panels::with)
        .with_panel_size(236.0, 190.0)
        .to_svg()
}

fn curve(effect: &EffectPower, check: &PowerCheck) -> Chart {
    let size = |scale: f64| scale * effect.usual_size;
    let x = Axis::new("", effect.unit).with_logarithm();
    let y = Axis::new("", "%").with_range(0.0, PERCENT).with_ticks(vec![0.0, 50.0, 90.0, 100.0]);
    let points = effect.curve.iter().map(|[s, p]| [size(*s), PERCENT * p]).collect();
    let usual = vec![[effect.usual_size, PERCENT * effect.power_at_usual_size.middle]];
    let mut chart = Chart::new(effect.term, x, y)
        .with(Series::line("computed", points).with_look(0))
        .with(Series::markers("at the usual size", usual).with_look(1));
    let simulated: Vec<&Simulated> = check.usual.iter().chain(&check.when_seen).collect();
    if !simulated.is_empty() {
        let points = simulated.iter().map(|s| [size(s.scale), PERCENT * s.seen.rate()]).collect();
        let half = |s: &&Simulated| {
            let [low, high] = s.seen.interval();
            PERCENT * (high - s.seen.rate()).max(s.seen.rate() - low)
        };
        let errors = simulated.iter().map(half).collect();
        chart = chart.with(Series::markers("simulated, 95 %", points).with_errors(errors).with_look(2));
    }
    chart
}
