//! The charts of the study.

use hexbench_core::statistics::Proportion;
use hexbench_report::plot::{Axis, Chart, HeatMap, Panels, PlotError, Series};
use hexbench_truth::campaign::CaseKind;

use super::sheets::visible_confusion;
use super::{
    CalibrationRecord, Claim, ClaimBin, Claims, Curve, DISTANCES, DistanceRange, Fate, Mix, WELL_VISIBLE,
    bins,
};

/// Claims below which a bin is not drawn: its bounds would span most of the diagram.
const LEAST_CLAIMS: usize = 10;

/// One chart with the name of its file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedChart {
    /// Name of the file, without folder.
    pub file: &'static str,
    /// SVG text.
    pub svg: String,
}

/// All charts of the study.
///
/// # Errors
/// [`PlotError`]; of an empty study.
pub fn pictures(records: &[CalibrationRecord]) -> Result<Vec<NamedChart>, PlotError> {
    let power = |title, kind, second: &Kept| power(title, &Curve::of_each(records, kind), second);
    let all = [
        ("confusion.svg", confusion(records)?),
        ("reliability.svg", reliability(records)?),
        ("reliability-by-kind.svg", reliability_by_kind(records)?),
        (
            "power.svg",
            power("One effect of the catalogue: how often it is named", CaseKind::Single, &HONEST)?,
        ),
        (
            "outside.svg",
            power(
                "Effects outside the catalogue: how often \"outside\" is said",
                CaseKind::Outside,
                &DOUBTFUL,
            )?,
        ),
    ];
    Ok(all.map(|(file, svg)| NamedChart { file, svg }).to_vec())
}

fn confusion(records: &[CalibrationRecord]) -> Result<String, PlotError> {
    const PERCENT: f64 = 100.0;
    // A share below half a percent would be printed as zero.
    const SHOWN: f64 = 0.005;
    let confusion = visible_confusion(records);
    let in_percent = |x: f64| if x < SHOWN { 0.0 } else { PERCENT * x };
    let values = confusion.shares().into_iter().map(|row| row.into_iter().map(in_percent).collect());
    let title = format!("What was hidden (distance {WELL_VISIBLE} or more) and what was said, percent");
    HeatMap::new(title, confusion.hidden.clone(), confusion.answers.clone(), values.collect())
        .with_axis_titles("Hidden", "Said")
        .with_full_shade_at(PERCENT)
        .to_svg()
}

fn reliability(records: &[CalibrationRecord]) -> Result<String, PlotError> {
    let (drawn, expected) = (Mix::as_drawn(), Mix::as_expected(records));
    let panel = |claims: Claims| {
        let [drawn, expected] = [&drawn, &expected].map(|mix| filled(&claims.of(records, mix)));
        let panel = reliability_panel(claims.title(), &drawn)?;
        let points = expected.iter().map(|b| [b.stated, b.observed]).collect();
        Some(panel.with(Series::marked_line("truths as often as expected", points).with_look(1)))
    };
    Claims::ALL
        .into_iter()
        .filter_map(panel)
        .fold(Panels::new("Do probabilities mean what they say?", 4), Panels::with)
        .with_panel_size(250.0, 240.0)
        .to_svg()
}

fn reliability_by_kind(records: &[CalibrationRecord]) -> Result<String, PlotError> {
    let panel = |kind: CaseKind| {
        let of_kind: Vec<&CalibrationRecord> = records.iter().filter(|r| r.kind == kind).collect();
        let title = format!("{} ({} trials)", kind.name(), of_kind.len());
        reliability_panel(&title, &filled(&Claims::Presence.of(of_kind, &Mix::as_drawn())))
    };
    CaseKind::ALL
        .into_iter()
        .filter_map(panel)
        .fold(Panels::new("Presence of an effect, by kind of campaign", 4), Panels::with)
        .with_panel_size(250.0, 240.0)
        .to_svg()
}

/// Bins with enough claims to say something.
fn filled(claims: &[Claim]) -> Vec<ClaimBin> {
    bins(claims).into_iter().filter(|b| b.came_true.of >= LEAST_CLAIMS).collect()
}

/// Points of stated against observed with their bounds; `None` without claims.
fn reliability_panel(title: &str, bins: &[ClaimBin]) -> Option<Chart> {
    let bounds = |x: f64, p: Proportion| [x, p.interval()[0], p.interval()[1]];
    let band = bins.iter().map(|b| bounds(b.stated, b.came_true)).collect();
    let points = bins.iter().map(|b| [b.stated, b.observed]).collect();
    let axis = |title| Axis::new(title, "").with_range(0.0, 1.0).with_ticks(vec![0.0, 0.25, 0.5, 0.75, 1.0]);
    (!bins.is_empty()).then(|| {
        Chart::new(title, axis("Stated"), axis("Came true"))
            .with(Series::line("as it should be", vec![[0.0, 0.0], [1.0, 1.0]]).as_reference())
            .with(Series::band("95 % bounds", band).with_look(0))
            .with(Series::marked_line("truths as drawn", points).with_look(0))
    })
}

/// Fates that count beside "right" in a second line, and its name.
struct Kept {
    name: &'static str,
    fates: [Fate; 2],
}

const HONEST: Kept = Kept { name: "right or honestly ambiguous", fates: [Fate::Right, Fate::Honest] };
const DOUBTFUL: Kept = Kept { name: "right or ambiguous", fates: [Fate::Right, Fate::Undecided] };

/// Shares over the distance, one panel for each effect.
fn power(title: &str, curves: &[Curve], second: &Kept) -> Result<String, PlotError> {
    curves
        .iter()
        .filter_map(|curve| power_panel(curve, second))
        .fold(Panels::new(title, 4), Panels::with)
        .with_panel_size(232.0, 190.0)
        .to_svg()
}

fn power_panel(curve: &Curve, second: &Kept) -> Option<Chart> {
    let steps: Vec<&DistanceRange> = curve.steps.iter().filter(|s| s.share(&[]).of > 0).collect();
    let line = |fates: &[Fate]| -> Vec<[f64; 2]> {
        steps.iter().map(|s| [s.middle(), 100.0 * s.share(fates).rate()]).collect()
    };
    let band = steps.iter().map(|s| {
        let [low, high] = s.share(&[Fate::Right]).interval();
        [s.middle(), 100.0 * low, 100.0 * high]
    });
    let ticks = vec![2.0, 5.0, 10.0, 20.0, 50.0];
    let x =
        Axis::new("Distance", "").with_logarithm().with_range(DISTANCES[0], DISTANCES[1]).with_ticks(ticks);
    let y = Axis::new("Share", "%").with_range(0.0, 100.0).with_ticks(vec![0.0, 25.0, 50.0, 75.0, 100.0]);
    let not_false = [Fate::Right, Fate::Honest, Fate::Undecided, Fate::Missed];
    (!steps.is_empty()).then(|| {
        Chart::new(curve.title.clone(), x, y)
            .with(Series::band("95 % bounds", band.collect()).with_look(0))
            .with(Series::marked_line("right", line(&[Fate::Right])).with_look(0))
            .with(Series::marked_line(second.name, line(&second.fates)).with_look(1))
            .with(Series::line("nothing false said", line(&not_false)).as_reference())
    })
}
