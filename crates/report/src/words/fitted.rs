//! The page of a fit: quality, values with uncertainty, correlations, errors.

use hexbench_core::words::joined;
use hexbench_model::application::model_file::Estimator;
use hexbench_model::effects::term::Rich;
use hexbench_model::estimation::estimate::{Estimate, Estimates};
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::fit_named::{asked_as, effects, look_alikes};
use hexbench_model::estimation::linearization::Active;
use hexbench_model::estimation::noise::NoiseSource;
use hexbench_model::estimation::residuals::ErrorSummary;
use hexbench_model::inference::selection::{FitWithErrors, HeldOut, JudgedTask};
use hexbench_model::results::diagnose::{LegRemainder, NoiseReport};
use hexbench_model::results::fit::{FitQuality, REPORTED_CORRELATION};
use hexbench_model::results::outliers::outliers;

use super::PlusMinus;
use super::notes::outlying;
use super::remainder::of_legs;
use super::units::UnitsRead;
use crate::number::{multiple, significant, with_uncertainty};
use crate::page::{Block, Mood, Page, PageColumn, Section, Table};

/// Chance of an error by noise below which something is missing.
const PROOF: f64 = 1e-3;
/// Most correlations where there is little room.
const BRIEF: usize = 10;

/// The fit; every plus-minus as wide as `coverage` says.
pub fn page(
    task: &JudgedTask<'_>,
    judged: &FitWithErrors,
    estimator: Estimator,
    coverage: PlusMinus,
) -> Page {
    Page::default()
        .with(conclusion(task, judged))
        .with(quality(task, judged, estimator))
        .with(values(&judged.estimates(), coverage, task.campaign.noise.dof_beside(judged.fit.dof)))
        .with(remainder(judged))
        .with(correlations(&judged.fit))
        .with(errors(task, judged))
}

/// Whether the model explains the readings, and what to do where it does not.
fn conclusion(task: &JudgedTask<'_>, judged: &FitWithErrors) -> Section {
    let error = judged.error();
    let (times, is_at_the_noise) = (multiple(error.times_noise()), judged.is_at_the_noise());
    let suspects = outliers(&judged.residuals, task.data);
    let sentence = if !task.campaign.noise.allows_verdict() {
        "The noise is known from the residuals only: this fit cannot tell whether anything is missing. State it in [metrology].".to_owned()
    } else if is_at_the_noise {
        format!("This model explains the readings: its error is {times} times the noise.")
    } else if let Some(chance) = doubtful(judged) {
        format!(
            "The error on held-out readings is {times} times the noise; noise alone gives as much with a chance of {} %. That is a doubt and no \
             proof: further held-out readings decide.",
            significant(100.0 * chance, 2)
        )
    } else {
        format!(
            "This model does not explain the readings: its error is {times} times the noise. What it lacks biases the values below, beyond \
             their uncertainties. {}",
            to_do(&judged.fit)
        )
    };
    let kept = (!suspects.is_empty()).then(|| {
        format!(
            "{}. `hexbench diagnose` finds wrong readings and, with `-o model.toml`, saves the model without them.",
            outlying(&suspects)
        )
    });
    let is_good = is_at_the_noise && suspects.is_empty();
    let mood = if is_good { Mood::Good } else { Mood::Doubt };
    Section::lead().with(Block::colored(mood, sentence)).with(kept.map(|kept| Block::colored(mood, kept)))
}

/// Chance of the error on held-out readings where it is no proof: the readings fitted are explained.
fn doubtful(judged: &FitWithErrors) -> Option<f64> {
    let chance = judged.held_out.as_ref().and_then(|held_out| held_out.chance);
    chance.filter(|chance| *chance > PROOF && judged.fitted.is_at_the_noise())
}

fn quality(task: &JudgedTask<'_>, judged: &FitWithErrors, estimator: Estimator) -> Section {
    let fit = &judged.fit;
    let terms: Vec<String> = fit.point.active.iter().map(|a| asked_as(a.id(), a.rich)).collect();
    let with = if terms.is_empty() { String::new() } else { format!(" + {}", effects(&terms)) };
    let method = match estimator {
        Estimator::Gls => "generalized least squares",
        Estimator::Paper => "the paper's unweighted minimum-norm least squares",
    };
    let quality = FitQuality::of(task, judged);
    let table = Table::named(["", ""]).rows([
        ["readings", &quality.readings.to_string()],
        ["equations", &quality.equations.to_string()],
        ["parameters (effective)", &format!("{:.1}", quality.effective_parameters)],
        ["chi-square", &significant(quality.chi2, 6)],
        ["degrees of freedom", &format!("{:.1}", quality.dof)],
        ["reduced chi-square", &significant(quality.chi2_reduced, 4)],
        ["AIC", &significant(quality.aic, 6)],
        ["BIC", &significant(quality.bic, 6)],
    ]);
    let provisional = "The fit did not converge; treat its numbers as provisional, and check units, axes and angles of the file.";
    Section::new(format!("Fit: leg springs{with}"))
        .id("fit")
        .remark(method)
        .table(table)
        .with((!fit.is_settled()).then(|| Block::paragraph(provisional)))
}

fn values(all: &Estimates, coverage: PlusMinus, dof: f64) -> Section {
    let plus_minus = coverage.of(dof);
    let row = |e: &Estimate| {
        let wide = plus_minus.factor * e.std;
        let [value, std] = with_uncertainty(e.value, wide);
        let share = 100.0 * (wide / e.value).abs();
        let share = if share.is_finite() { format!("({} %)", significant(share, 2)) } else { String::new() };
        [e.name.clone(), value, format!("+- {std}"), share, e.unit.clone()]
    };
    let columns = [
        PageColumn::words(""),
        PageColumn::number(""),
        PageColumn::number(""),
        PageColumn::number(""),
        PageColumn::words(""),
    ];
    let open = (!all.not_determined.is_empty())
        .then(|| format!("Not determined by these data: {}.", joined(&all.not_determined)));
    Section::new("Values")
        .remark(plus_minus.remark())
        .table(Table::new(columns).rows(all.determined.iter().map(row)))
        .with(open.map(Block::paragraph))
}

fn remainder(judged: &FitWithErrors) -> Option<Section> {
    judged.left.is_any().then(|| of_legs(judged.error().beyond_noise(), &LegRemainder::all(&judged.left)))
}

fn correlations(fit: &Fit) -> Option<Section> {
    let pairs = look_alikes(fit, REPORTED_CORRELATION);
    let row = |(a, b, r): &(String, String, f64)| [format!("{r:+.3}"), format!("{a}, {b}")];
    let table =
        Table::new([PageColumn::number(""), PageColumn::words("")]).rows(pairs.iter().map(row)).brief(BRIEF);
    let section =
        Section::new("Correlations").remark("above 0.7: parameters that the data can barely separate");
    (!pairs.is_empty()).then(|| section.table(table))
}

fn errors(task: &JudgedTask<'_>, judged: &FitWithErrors) -> Section {
    let noise = NoiseReport::of(task.campaign);
    let units = UnitsRead::of([noise.both(), judged.fitted.rms.both()]);
    let cells = |name: &str, both: [Option<f64>; 2], chi2: String| {
        std::iter::once(name.to_owned()).chain(units.values(both)).chain([chi2]).collect::<Vec<_>>()
    };
    let row = |name: &str, e: &ErrorSummary| cells(name, e.rms.both(), significant(e.chi2_reduced, 3));
    let held_out = match task.held_out() {
        HeldOut::File => "held-out readings",
        HeldOut::PosesInTurn => "poses left out in turn",
    };
    let of_poses = noise.source != NoiseSource::Sensors;
    let titles = units.of_both(if of_poses { ["translation um", "rotation urad"] } else { ["um", "urad"] });
    let table = Table::named(std::iter::once("").chain(titles).chain(["reduced chi2"]))
        .rows([row("fitted readings", &judged.fitted)])
        .rows(judged.held_out.iter().map(|e| row(held_out, &e.summary)))
        .rows([cells(&format!("noise ({})", noise.source.word()), noise.both(), "1".to_owned())]);
    // Beside a chi-square that allows for more than noise, the reader would see two numbers that contradict each other.
    let alone = if task.campaign.inexact.is_some() {
        "; chi2 against the noise alone, without input tolerances"
    } else {
        ""
    };
    Section::new("Errors").remark(format!("root mean square{alone}")).table(table)
}

/// What to do about an error that the noise does not explain.
fn to_do(fit: &Fit) -> String {
    let could_be_richer = |a: &&Active| !a.rich && a.term.info().rich != Rich::None;
    let richer =
        |a: &Active| format!("`--add {}` fits the richer form of this effect", asked_as(a.id(), true));
    let richer: Vec<String> = fit.point.active.iter().filter(could_be_richer).map(richer).collect();
    let or_richer = if richer.is_empty() { String::new() } else { format!(" {}.", joined(&richer)) };
    format!("`hexbench diagnose` names it.{or_richer}")
}
