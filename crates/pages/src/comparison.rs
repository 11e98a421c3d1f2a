//! The page of a comparison.

use hexbench_model::compare::Comparison;
use hexbench_model::compare::adequacy::{Adequacy, Test};
use hexbench_model::compare::design::Design;
use hexbench_model::words::joined;
use hexbench_report::number::{rounded, significant};

use crate::text::{Ink, Paper, Table};

/// Rows of a list shown; the rest is in the JSON file.
const SHOWN: usize = 6;

/// The whole page.
pub fn page(c: &Comparison, ink: Ink) -> String {
    let mut paper = Paper::new(ink);
    head(&mut paper, c);
    coordinates(&mut paper, c);
    adequacy(&mut paper, &c.adequacy);
    worst(&mut paper, c);
    legs(&mut paper, c);
    follows(&mut paper, c);
    design(&mut paper, &c.design);
    hidden(&mut paper, c);
    paper.into_text()
}

fn head(paper: &mut Paper, c: &Comparison) {
    let with = if c.terms.is_empty() { String::new() } else { format!(" + {}", joined(&c.terms)) };
    let how = if c.fitted_here { "fitted to these readings" } else { "as saved, nothing fitted here" };
    paper.heading(&format!("Compared: leg springs{with}"), how);
    let mut table = Table::default();
    table.row(["", "translation um", "rotation urad", "reduced chi2"]);
    let errors = [("readings", Some(&c.error)), ("held-out readings", c.holdout.as_ref())];
    for (name, e) in errors.into_iter().filter_map(|(name, e)| Some((name, e?))) {
        let (t, r) = (significant(e.rms.translation_um, 3), significant(e.rms.rotation_urad, 3));
        table.row([format!("{name} ({})", e.count / 6), t, r, significant(e.chi2_reduced, 3)]);
    }
    table.lines().iter().for_each(|line| paper.line(line));
}

fn coordinates(paper: &mut Paper, c: &Comparison) {
    paper.heading("Coordinates", &format!("root mean square beside the noise ({})", c.noise_source));
    let mut table = Table::default();
    table.row(["", "rms", "noise", "ratio", "bias", "t", "chance", "unit"]);
    for x in &c.coordinates {
        let t = x.t.map_or("-".to_owned(), |t| rounded(t, 1.0));
        let p = x.p.map_or("-".to_owned(), chance);
        let ratio = significant(x.rms / x.noise, 3);
        let cells =
            [significant(x.rms, 3), significant(x.noise, 3), ratio, rounded(x.bias, x.noise / 10.0), t, p];
        table.row(std::iter::once(x.name.to_owned()).chain(cells).chain([x.unit.to_owned()]));
    }
    table.lines().iter().for_each(|line| paper.line(line));
}

fn adequacy(paper: &mut Paper, a: &Adequacy) {
    paper.heading("Is the model adequate?", "chance of a worse result if it is right");
    let mut table = Table::default();
    for (name, t) in tests(a) {
        table.row([name.to_owned(), statistic(&t), chance(t.p)]);
    }
    table.lines().iter().for_each(|line| paper.line(line));
    paper.paragraph(2, Answer::of(a).sentence());
}

/// Name and result of every test that the data allow.
pub(crate) fn tests(a: &Adequacy) -> Vec<(&'static str, Test)> {
    let all = [
        ("averages against the stated noise", a.lack_of_fit_chi2),
        ("averages against repeats (F)", a.lack_of_fit_f),
        ("repeats against the stated noise", a.repeats_chi2),
    ];
    all.into_iter().filter_map(|(name, t)| Some((name, t?))).collect()
}

/// What the tests say of the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Answer {
    Adequate,
    NotAdequate,
    Open,
}

impl Answer {
    pub(crate) fn of(a: &Adequacy) -> Self {
        const LEAST_CHANCE: f64 = 0.01;
        let best =
            [a.lack_of_fit_f, a.lack_of_fit_chi2].into_iter().flatten().map(|t| t.p).fold(1.0, f64::min);
        match (best < LEAST_CHANCE, tests(a).is_empty()) {
            (true, _) => Self::NotAdequate,
            (_, true) => Self::Open,
            _ => Self::Adequate,
        }
    }

    pub(crate) fn sentence(self) -> &'static str {
        match self {
            Self::NotAdequate => "No: something is missing. `hexbench diagnose` looks for it.",
            Self::Open => "No noise level is stated and nothing is repeated: nothing can be said.",
            Self::Adequate => "Yes, as far as these readings tell.",
        }
    }
}

pub(crate) fn statistic(t: &Test) -> String {
    match t.dof_noise {
        Some(noise) => format!("F({:.0}, {noise:.0}) = {}", t.dof, significant(t.statistic, 3)),
        None => format!("chi2({:.0}) = {}", t.dof, significant(t.statistic, 4)),
    }
}

/// A chance without false precision.
pub(crate) fn chance(p: f64) -> String {
    match p {
        p if p < 1e-12 => "< 1e-12".to_owned(),
        p if p < 1e-3 => format!("{p:.0e}"),
        p => significant(p, 2),
    }
}

fn worst(paper: &mut Paper, c: &Comparison) {
    paper.heading("Worst poses", "root mean square in units of the noise");
    for w in &c.worst_poses {
        let text =
            format!("  pose {} (line {}, {} readings)  {:.2}", w.pose, w.line, w.readings, w.whitened_rms);
        paper.line(&text);
    }
    if c.outliers.is_empty() {
        paper.line("  No single reading stands out.");
        return;
    }
    paper.line("  Readings that stand out (kept in everything above):");
    for o in c.outliers.iter().take(SHOWN) {
        paper.line(&format!("  line {}: {:.1} times the noise, chance {}", o.line, o.z, chance(o.p)));
    }
    more(paper, c.outliers.len());
}

fn legs(paper: &mut Paper, c: &Comparison) {
    paper.heading("Legs", "elongation each leg would need to explain the residuals, um");
    let mut table = Table::default();
    table.row(std::iter::once("leg".to_owned()).chain(c.legs.iter().map(|l| l.leg.to_string())));
    table.row(std::iter::once("rms".to_owned()).chain(c.legs.iter().map(|l| significant(l.rms_um, 3))));
    table.row(
        std::iter::once("noise alone".to_owned()).chain(c.legs.iter().map(|l| significant(l.noise_um, 3))),
    );
    table.lines().iter().for_each(|line| paper.line(line));
}

fn follows(paper: &mut Paper, c: &Comparison) {
    paper.heading("What they follow", "chance corrected for the number of questions");
    let mut table = Table::default();
    for a in c.associations.iter().take(SHOWN) {
        let who = format!("{} of {}", a.of, who(a.leg));
        let rank = format!("rank {:+.2}", a.rank_correlation);
        table.row([who, a.variable.to_owned(), rank, format!("F {}", significant(a.f, 3)), chance(a.p)]);
    }
    table.lines().iter().for_each(|line| paper.line(line));
    more(paper, c.associations.len());
    match &c.period {
        Some(p) => {
            let (period, chance) = (significant(p.period_mm, 3), chance(p.false_alarm));
            let text = format!(
                "The {} of {} repeats with leg length every {period} mm (chance {chance}).",
                p.of,
                who(p.leg)
            );
            paper.paragraph(2, &text);
        }
        None if c.associations.is_empty() => paper.line("  Nothing beyond chance."),
        None => paper.line("  No period in leg length beyond chance."),
    }
}

pub(crate) fn who(leg: Option<usize>) -> String {
    leg.map_or("all legs".to_owned(), |l| format!("leg {l}"))
}

fn more(paper: &mut Paper, count: usize) {
    if count > SHOWN {
        paper.line(&format!("  and {} more (--json)", count - SHOWN));
    }
}

fn design(paper: &mut Paper, d: &Design) {
    paper.heading("What the plan lets be seen", "");
    let condition = d.condition.map_or("infinite".to_owned(), |c| significant(c, 3));
    paper.line(&format!("  rank {} of {}, condition {condition}", d.rank, d.parameters));
    if let Some(o) = &d.paper {
        paper.line(&format!("  observability index O1 {:.4e} (the paper's eq. 14, m and rad per m/N)", o.o1));
    }
    for text in &d.unobservable {
        paper.paragraph(2, &format!("Not determined: {text}."));
    }
    if let Some(text) = &d.weakest {
        paper.paragraph(2, &format!("Weakest: {text}."));
    }
}

fn hidden(paper: &mut Paper, c: &Comparison) {
    if c.hidden.is_empty() {
        return;
    }
    paper.heading("What could hide in the springs", "bias of each leg stiffness, percent");
    paper.paragraph(
        2,
        "By an effect of the size that these readings would just show (* : would not show at all).",
    );
    let mut table = Table::default();
    table.row(["leg", "size", "1", "2", "3", "4", "5", "6"]);
    for h in c.hidden.iter().take(SHOWN) {
        let star = if h.would_show { "" } else { "*" };
        let size = format!("{} {}{star}", significant(h.size, 2), h.unit);
        let bias = h.bias_of_leg_stiffness_percent.map(|b| format!("{b:.1}"));
        table.row([h.term.clone(), size].into_iter().chain(bias));
    }
    table.lines().iter().for_each(|line| paper.line(line));
    more(paper, c.hidden.len());
}
