//! The page of `hexbench design`.

use hexbench_core::statistics::median;
use hexbench_core::{Measurand, Wrench};
use hexbench_design::budget::Amount;
use hexbench_design::determined::unit_diagonal;
use hexbench_design::space::Setting;
use hexbench_model::machine::observability::Observability;
use hexbench_report::{Block, Page, PageColumn, Section, Table, number};
use nalgebra::DMatrix;

use super::chosen_loads::chosen_loads;
use super::{Designed, Quantity, Visit};

/// Correlations told at most, and the smallest worth telling.
const MOST_TOLD: usize = 4;
const WORTH_TELLING: f64 = 0.5;

impl Designed {
    fn readings(&self) -> usize {
        self.visits.iter().flat_map(|v| &v.counts).sum()
    }

    /// Information by inputs as good as they are known.
    fn known(&self) -> &DMatrix<f64> {
        self.within_tolerances.as_ref().unwrap_or(&self.information)
    }

    /// Seconds that the plan takes.
    fn time(&self) -> f64 {
        let all = self.visits.iter().flat_map(|v| self.settings.iter().zip(&v.counts));
        self.budget.time(self.visits.len(), all.flat_map(|(s, &n)| std::iter::repeat_n(s, n)))
    }
}

/// The page.
pub fn page(plan: &Designed) -> Page {
    let (readings, passed) = settings(plan);
    let passed = (passed > 0).then(|| Block::paragraph(format!("{passed} others get no reading.")));
    Page::default()
        .with(
            Section::new("Plan")
                .remark("mm and deg; fixed axes")
                .table(poses(plan))
                .table(readings)
                .with(passed)
                .with_all(chosen_loads(plan))
                .paragraph(total(plan))
                .with(coinciding(plan).map(Block::paragraph))
                .with(plan.settled.as_ref().map(Block::paragraph)),
        )
        .with(quality(plan))
        .with(sure(plan))
        .with(plan.weighted.then(|| uncertainty(plan)).flatten())
        .with(correlations(plan))
}

fn poses(plan: &Designed) -> Table {
    let row = |(k, visit): (usize, &Visit)| {
        let x = visit.pose.to_array();
        let cell = |i: usize| format!("{:.3}", if i < 3 { x[i] * 1e3 } else { x[i].to_degrees() } + 0.0);
        let count = visit.counts.iter().sum::<usize>().to_string();
        std::iter::once((k + 1).to_string()).chain((0..6).map(cell)).chain([count]).collect::<Vec<_>>()
    };
    let header = ["pose"].into_iter().chain(Measurand::AbsolutePose.names()).chain(["readings"]);
    Table::named(header).rows(plan.visits.iter().enumerate().map(row))
}

/// Name of a condition, and its value in a setting.
type Condition = (&'static str, fn(&Setting) -> f64);

/// How often each setting is read, all poses together, and how many settings are not read at all.
fn settings(plan: &Designed) -> (Table, usize) {
    let varies = |of: fn(&Setting) -> f64| {
        plan.settings.iter().any(|s| of(s).total_cmp(&of(&plan.settings[0])).is_ne())
    };
    let columns: [Condition; 3] =
        [("approach", |s| s.approach.sign()), ("delta_T K", |s| s.delta_t), ("wait s", |s| s.elapsed)];
    let shown: Vec<_> = columns.into_iter().filter(|(_, of)| varies(*of)).collect();
    let names = shown.iter().map(|(name, _)| *name);
    let mut table = Table::named(std::iter::once("load (reference)").chain(names).chain(["readings"]));
    let counts = (0..plan.settings.len()).map(|k| plan.visits.iter().map(|v| v.counts[k]).sum::<usize>());
    let (read, passed): (Vec<_>, Vec<_>) =
        plan.settings.iter().zip(counts).partition(|(_, count)| *count > 0);
    for (setting, count) in read {
        let loading = format!("{} ({})", wrench(&setting.loading.load), wrench(&setting.loading.reference));
        let cells = shown.iter().map(|(_, of)| of(setting).to_string());
        table.row(std::iter::once(loading).chain(cells).chain([count.to_string()]));
    }
    (table, passed.len())
}

/// The components of a wrench that are not zero.
pub(super) fn wrench(wrench: &Wrench) -> String {
    let parts = Wrench::NAMES.iter().zip(wrench.to_array()).enumerate().filter(|(_, (_, x))| *x != 0.0);
    let text: Vec<String> = parts
        .map(|(k, (name, x))| {
            format!("{name} {} {}", number::significant(x, 4), if k < 3 { "N" } else { "Nm" })
        })
        .collect();
    if text.is_empty() { "none".to_owned() } else { text.join(", ") }
}

fn total(plan: &Designed) -> String {
    let (readings, poses, time) = (plan.readings(), plan.visits.len(), plan.time());
    let took = format!("{readings} readings at {}", number::counted(poses, "pose"));
    match plan.budget.limit {
        Some(Amount::Time(most)) => format!("{took}: {} of {}.", hours(time), hours(most)),
        _ if time > 0.0 => format!("{took}: {}.", hours(time)),
        _ => format!("{took}."),
    }
}

/// `6 poses asked, 1 distinct: the others coincide.`
fn coinciding(plan: &Designed) -> Option<String> {
    let (asked, distinct) = (plan.poses_asked?, plan.visits.len());
    (distinct < asked).then(|| {
        format!("{} asked, {distinct} distinct: the others coincide.", number::counted(asked, "pose"))
    })
}

fn hours(seconds: f64) -> String {
    let minutes = (seconds / 60.0).ceil();
    format!("{} h {:02} min", (minutes / 60.0).floor(), minutes % 60.0)
}

fn quality(plan: &Designed) -> Section {
    let observability = |information: &DMatrix<f64>| {
        let eigen = information.symmetric_eigenvalues();
        Observability::new(eigen.iter().map(|l| l.max(0.0).sqrt()), plan.readings())
    };
    let (paper, o) = (observability(&plan.information), observability(plan.known()));
    let chosen = format!("{} = {}", plan.criterion, number::significant(plan.value, 6));
    let units = if plan.weighted {
        "rows in units of the noise, columns in relative changes"
    } else {
        "m and rad unweighted, as in the paper; state [metrology] to weight them"
    };
    let values = [paper.o1, o.o2, o.o3, o.o4, o.o5, 1.0 / o.o2].map(|v| number::significant(v, 4));
    let columns = ["O1", "O2", "O3", "O4", "O5", "condition"].map(PageColumn::number);
    Section::new("How good")
        .paragraph(format!("{chosen} ({units})."))
        .table(Table::new(columns).rows([values]))
        .with(tolerances(plan).map(Block::paragraph))
        .with(plan.read_by.as_ref().map(Block::paragraph))
}

/// What is assumed of the inputs, and what it costs; none where they count as exact.
fn tolerances(plan: &Designed) -> Option<String> {
    let uncertainties = |m: &DMatrix<f64>| Some(m.clone().cholesky()?.inverse().diagonal().map(f64::sqrt));
    let (inexact, exact) =
        (uncertainties(plan.within_tolerances.as_ref()?)?, uncertainties(&plan.information)?);
    let grown = median(inexact.iter().zip(&exact).map(|(a, b)| a / b))?;
    Some(format!(
        "Tolerances: {}; uncertainties are larger than with exact inputs by a factor of {} in the median. O1 takes inputs as exact, as in the \
         paper; everything else accounts for their tolerances, as a diagnosis does.",
        plan.tolerances,
        number::significant(grown, 3),
    ))
}

fn sure(plan: &Designed) -> Section {
    let [starts, ended, agreeing] = plan.starts;
    let lost = if ended < starts { format!(", {} within no limits", starts - ended) } else { String::new() };
    Section::new("How certain the optimum is")
        .paragraph(format!(
            "{agreeing} of {starts} starts reached this value to four digits, {} ended at a worse one{lost} (seed {}). Rounding the \
             poses{} changes it by {}.",
            ended - agreeing,
            plan.seed,
            if plan.space.load_ranges.is_empty() { "" } else { " and loads" },
            change(plan.value / plan.best - 1.0),
        ))
        .with(plan.candidates.map(|candidates| Block::paragraph(bound(plan, candidates))))
}

/// How far the plan may be from the best one.
fn bound(plan: &Designed, candidates: usize) -> String {
    let Some(share) = plan.efficiency.map(floored) else {
        return format!("No bound is known for {}, a ratio of eigenvalues.", plan.criterion);
    };
    let free = match plan.budget.limit {
        Some(Amount::Time(_)) if plan.budget.pose_change > 0.0 => ", even if changing poses took no time,",
        _ => "",
    };
    let loads = if plan.space.load_ranges.is_empty() { "" } else { " and the loads tried" };
    format!(
        "{}-efficiency at least {share:.1} %: any plan over these {candidates} poses{loads}{free} needs at least {share:.1} % of the \
         budget to do as well.",
        plan.criterion,
    )
}

/// A relative change in percent; small ones only as small.
fn change(relative: f64) -> String {
    const SMALL: f64 = 1e-4;
    if relative.abs() < SMALL {
        "less than 0.01 %".to_owned()
    } else {
        format!("{} %", number::significant(100.0 * relative, 2))
    }
}

/// Percent, rounded down to a tenth: a bound stays one.
fn floored(share: f64) -> f64 {
    (share * 1e3).floor() / 10.0
}

/// Standard uncertainties that the plan promises.
fn uncertainty(plan: &Designed) -> Option<Section> {
    let covariance = plan.known().clone().cholesky()?.inverse();
    let shares: Vec<f64> = covariance.diagonal().iter().map(|v| v.sqrt()).collect();
    Some(determined(&plan.parameters, &shares))
}

/// Standard uncertainties as shares of the sizes of parameters.
pub(super) fn determined(parameters: &[Quantity], shares: &[f64]) -> Section {
    let columns = [
        PageColumn::words(""),
        PageColumn::number("uncertainty"),
        PageColumn::words("unit"),
        PageColumn::number("share"),
        PageColumn::number("assumed"),
    ];
    let rows = parameters.iter().zip(shares).map(|(quantity, share)| {
        [
            quantity.name.clone(),
            number::significant(share * quantity.size, 2),
            quantity.unit.to_owned(),
            format!("{} %", number::significant(100.0 * share, 2)),
            number::significant(quantity.size, 3),
        ]
    });
    Section::new("What it will determine")
        .remark("standard uncertainty, k = 1")
        .table(Table::new(columns).rows(rows))
        .paragraph("Shares of a nominal stiffness, or of the usual size of an effect.")
}

/// The pairs of parameters that the plan separates worst.
fn correlations(plan: &Designed) -> Option<Section> {
    let correlation = unit_diagonal(&plan.known().clone().cholesky()?.inverse());
    let p = plan.parameters.len();
    let mut pairs: Vec<(usize, usize)> = (0..p).flat_map(|i| (i + 1..p).map(move |j| (i, j))).collect();
    pairs.sort_by(|a, b| correlation[*b].abs().total_cmp(&correlation[*a].abs()));
    let worth = |pair: &(usize, usize)| correlation[*pair].abs() >= WORTH_TELLING;
    let row = |(i, j): (usize, usize)| {
        let [a, b] = [i, j].map(|k| plan.parameters[k].name.clone());
        [a, b, format!("{:+.3}", correlation[(i, j)])]
    };
    let columns = [PageColumn::words(""), PageColumn::words(""), PageColumn::number("")];
    let table = Table::new(columns).rows(pairs.into_iter().take(MOST_TOLD).filter(worth).map(row));
    let section = Section::new("Most correlated estimates").remark("correlation of the estimates");
    Some(if table.rows.is_empty() {
        section.paragraph(format!("No two estimates correlate by {WORTH_TELLING} or more."))
    } else {
        section.table(table)
    })
}
