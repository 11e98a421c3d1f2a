//! The page of `hexbench design`.

use hexbench_core::Wrench;
use hexbench_design::budget::Amount;
use hexbench_design::determined::unit_diagonal;
use hexbench_design::space::Setting;
use hexbench_model::observability::Observability;
use hexbench_pages::text::{Ink, Paper, Table};
use hexbench_report::number;

use super::Designed;

/// Correlations told at most, and the smallest worth telling.
const MOST_TOLD: usize = 4;
const WORTH_TELLING: f64 = 0.5;

impl Designed {
    fn readings(&self) -> usize {
        self.visits.iter().flat_map(|v| &v.counts).sum()
    }

    /// Seconds that the plan takes.
    fn time(&self) -> f64 {
        let all = self.visits.iter().flat_map(|v| self.settings.iter().zip(&v.counts));
        self.budget.time(self.visits.len(), all.flat_map(|(s, &n)| std::iter::repeat_n(s, n)))
    }
}

/// The page.
pub fn page(plan: &Designed, ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    paper.heading("Plan", "mm and deg; fixed axes");
    poses(&mut paper, plan);
    settings(&mut paper, plan);
    paper.paragraph(2, &total(plan));
    paper.heading("How good", "");
    quality(&mut paper, plan);
    paper.heading("How sure of the optimum", "");
    sure(&mut paper, plan);
    if plan.weighted {
        uncertainty(&mut paper, plan);
    }
    correlations(&mut paper, plan);
    paper.into_text()
}

fn poses(paper: &mut Paper, plan: &Designed) {
    let mut table = Table::default();
    table.row(["pose", "a", "b", "c", "alpha", "beta", "gamma", "readings"]);
    for (k, visit) in plan.visits.iter().enumerate() {
        let x = visit.pose.to_array();
        let cell = |i: usize| format!("{:.3}", if i < 3 { x[i] * 1e3 } else { x[i].to_degrees() } + 0.0);
        let count = visit.counts.iter().sum::<usize>().to_string();
        table.row(std::iter::once((k + 1).to_string()).chain((0..6).map(cell)).chain([count]));
    }
    table.lines().iter().for_each(|line| paper.line(line));
}

/// Name of a condition, and its value in a setting.
type Column = (&'static str, fn(&Setting) -> f64);

/// How often each setting is read, all poses together.
fn settings(paper: &mut Paper, plan: &Designed) {
    let varies = |of: fn(&Setting) -> f64| {
        plan.settings.iter().any(|s| of(s).total_cmp(&of(&plan.settings[0])).is_ne())
    };
    let columns: [Column; 3] =
        [("approach", |s| s.approach), ("delta_T K", |s| s.delta_t), ("wait s", |s| s.elapsed)];
    let shown: Vec<_> = columns.into_iter().filter(|(_, of)| varies(*of)).collect();
    paper.line("");
    let mut table = Table::default();
    let names = shown.iter().map(|(name, _)| (*name).to_owned());
    table.row(std::iter::once("load (reference)".to_owned()).chain(names).chain(["readings".to_owned()]));
    let counts = (0..plan.settings.len()).map(|k| plan.visits.iter().map(|v| v.counts[k]).sum::<usize>());
    let (read, passed): (Vec<_>, Vec<_>) =
        plan.settings.iter().zip(counts).partition(|(_, count)| *count > 0);
    for (setting, count) in read {
        let loading = format!("{} ({})", wrench(&setting.loading.load), wrench(&setting.loading.reference));
        let cells = shown.iter().map(|(_, of)| of(setting).to_string());
        table.row(std::iter::once(loading).chain(cells).chain([count.to_string()]));
    }
    table.lines().iter().for_each(|line| paper.line(line));
    if !passed.is_empty() {
        paper.line(&format!("  {} others are not worth a reading", passed.len()));
    }
}

/// The components of a wrench that are not zero.
fn wrench(wrench: &Wrench) -> String {
    let names = ["fx", "fy", "fz", "mx", "my", "mz"];
    let parts = names.iter().zip(wrench.to_array()).enumerate().filter(|(_, (_, x))| *x != 0.0);
    let text: Vec<String> = parts
        .map(|(k, (name, x))| {
            format!("{name} {} {}", number::significant(x, 4), if k < 3 { "N" } else { "Nm" })
        })
        .collect();
    if text.is_empty() { "none".to_owned() } else { text.join(", ") }
}

fn total(plan: &Designed) -> String {
    let (readings, poses, time) = (plan.readings(), plan.visits.len(), plan.time());
    let s = if poses == 1 { "" } else { "s" };
    let took = format!("{readings} readings at {poses} pose{s}");
    match plan.budget.limit {
        Some(Amount::Time(most)) => format!("{took}: {} of {}.", hours(time), hours(most)),
        _ if time > 0.0 => format!("{took}: {}.", hours(time)),
        _ => format!("{took}."),
    }
}

fn hours(seconds: f64) -> String {
    let minutes = (seconds / 60.0).ceil();
    format!("{} h {:02} min", (minutes / 60.0).floor(), minutes % 60.0)
}

fn quality(paper: &mut Paper, plan: &Designed) {
    let eigen = plan.information.clone().symmetric_eigenvalues();
    let o = Observability::new(eigen.iter().map(|l| l.max(0.0).sqrt()), plan.readings());
    let chosen = format!("{} = {}", plan.criterion, number::significant(plan.value, 6));
    let units = if plan.weighted {
        "rows in units of the noise, columns in relative changes"
    } else {
        "m and rad side by side, as in the paper; state [metrology] to weigh them"
    };
    paper.paragraph(2, &format!("{chosen} ({units})."));
    let mut table = Table::default();
    table.row(["", "O1", "O2", "O3", "O4", "O5", "condition"]);
    let values = [o.o1, o.o2, o.o3, o.o4, o.o5, 1.0 / o.o2];
    table.row(std::iter::once(String::new()).chain(values.map(|v| number::significant(v, 4))));
    table.lines().iter().for_each(|line| paper.line(line));
}

fn sure(paper: &mut Paper, plan: &Designed) {
    let [starts, ended, agreeing] = plan.starts;
    let lost = if ended < starts { format!(", {} within no limits", starts - ended) } else { String::new() };
    paper.paragraph(2, &format!(
        "{agreeing} of {starts} starts reached this value to four digits, {} a worse one{lost} (seed {}). Rounding the poses \
         changes it by {}.",
        ended - agreeing,
        plan.seed,
        change(plan.value / plan.best - 1.0),
    ));
    let Some(candidates) = plan.candidates else { return };
    let Some(share) = plan.efficiency.map(floored) else {
        paper.paragraph(2, &format!("No bound is known for {}, a ratio of eigenvalues.", plan.criterion));
        return;
    };
    let free = match plan.budget.limit {
        Some(Amount::Time(_)) if plan.budget.pose_change > 0.0 => ", even if changing poses took no time,",
        _ => "",
    };
    paper.paragraph(2, &format!(
        "{}-efficiency at least {share:.1} %: for the same, any plan over these {candidates} poses{free} needs {share:.1} % of \
         the budget or more.",
        plan.criterion,
    ));
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
fn uncertainty(paper: &mut Paper, plan: &Designed) {
    let Some(factor) = plan.information.clone().cholesky() else { return };
    let covariance = factor.inverse();
    paper.heading("What it will determine", "standard uncertainty, k = 1");
    let mut table = Table::default();
    table.row(["", "uncertainty", "unit", "share", "of"]);
    for (k, quantity) in plan.parameters.iter().enumerate() {
        let relative = covariance[(k, k)].sqrt();
        table.row([
            quantity.name.clone(),
            number::significant(relative * quantity.size, 2),
            quantity.unit.to_owned(),
            format!("{} %", number::significant(100.0 * relative, 2)),
            number::significant(quantity.size, 3),
        ]);
    }
    table.left(2).lines().iter().for_each(|line| paper.line(line));
    paper.paragraph(2, "Shares of a nominal stiffness, or of the usual size of an effect.");
}

/// The pairs of parameters that the plan separates worst.
fn correlations(paper: &mut Paper, plan: &Designed) {
    let Some(factor) = plan.information.clone().cholesky() else { return };
    let correlation = unit_diagonal(&factor.inverse());
    let p = plan.parameters.len();
    let mut pairs: Vec<(usize, usize)> = (0..p).flat_map(|i| (i + 1..p).map(move |j| (i, j))).collect();
    pairs.sort_by(|a, b| correlation[*b].abs().total_cmp(&correlation[*a].abs()));
    paper.heading("What it separates worst", "correlation of the estimates");
    let mut table = Table::default();
    for (i, j) in pairs.into_iter().take(MOST_TOLD).filter(|pair| correlation[*pair].abs() >= WORTH_TELLING) {
        let [a, b] = [i, j].map(|k| plan.parameters[k].name.clone());
        table.row([a, b, format!("{:+.3}", correlation[(i, j)])]);
    }
    let lines = table.left(1).lines();
    if lines.is_empty() {
        paper.paragraph(2, &format!("No two estimates correlate by {WORTH_TELLING} or more."));
    }
    for line in &lines {
        paper.line(line);
    }
}
