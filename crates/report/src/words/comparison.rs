//! The page of a comparison.

use hexbench_core::words::joined;
use hexbench_model::estimation::noise::NoiseSource;
use hexbench_model::estimation::residuals::ErrorSummary;
use hexbench_model::results::compare::Comparison;
use hexbench_model::results::compare::absorbed::HiddenBias;
use hexbench_model::results::compare::adequacy::{AdequacyAnswer, AdequacyTest};
use hexbench_model::results::compare::association::Association;
use hexbench_model::results::compare::coordinates::Coordinate;
use hexbench_model::results::compare::legs::LegResidual;
use hexbench_model::results::compare::rows::Outlier;

use super::notes;
use super::units::UnitsRead;
use crate::number::{chance, multiple, rounded, significant};
use crate::page::{Block, Cell, Definition, Mood, Page, PageColumn, Section, Table};

/// Rows of a list where there is little room.
const BRIEF: usize = 6;

/// Why errors of a fit that ran out of iterations are no verdict, and what to look at.
const NOT_CONVERGED: &str = "The fit did not converge, so its residuals say nothing about the machine. Check units, axes, signs and the \
                             angle convention of the file, then single outlying readings.";

/// Where residuals cannot be told as elongations of the legs.
const NOT_IN_LEGS: &str = "These readings do not determine the elongations of the legs: that takes six numbers in every row that together \
                           measure every motion of the platform. Correlations of the elongations are therefore not shown; \
                           `hexbench diagnose` does not need elongations.";

/// The comparison; `subject` says what of.
pub fn comparison(machine: &str, subject: Vec<Definition>, c: &Comparison) -> Page {
    Page { subject, ..Page::new(format!("Comparison of {machine}")) }
        .with(verdict(c))
        .with(errors(c))
        .with(coordinates(c))
        .with(adequacy(c))
        .with(worst(c))
        .with(outliers(c))
        .with(legs(c))
        .with(follows(c))
        .with(plan(c))
        .with(hidden(c))
        .with(notes::conventions())
}

fn verdict(c: &Comparison) -> Section {
    let with = if c.terms.is_empty() { String::new() } else { format!(" + {}", joined(&c.terms)) };
    let how = if c.fitted_here { "fitted to these readings" } else { "as saved, nothing fitted here" };
    let (word, mood, sentence) = match c.answer() {
        _ if !c.settled => ("NOT CONVERGED", Mood::Doubt, NOT_CONVERGED),
        AdequacyAnswer::Adequate => {
            ("ADEQUATE", Mood::Good, "As far as these readings show, the error of this model is noise alone.")
        }
        AdequacyAnswer::NotAdequate => (
            "NOT ADEQUATE",
            Mood::Bad,
            "The error of this model exceeds the noise: something is missing in it, or in what the files say of noise and loads. \
             `hexbench diagnose` looks for it.",
        ),
        AdequacyAnswer::NotHeldOut => (
            "NOT ADEQUATE",
            Mood::Bad,
            "The error of this model is noise on the readings compared, but exceeds the noise on the held-out readings: it does not foresee them, \
             or they were read differently.",
        ),
        AdequacyAnswer::Open => {
            ("OPEN", Mood::Doubt, "Neither a noise level nor repeats are given: adequacy cannot be judged.")
        }
    };
    Section::new(format!("Compared: leg springs{with}")).id("verdict").remark(how).with(Block::Verdict {
        word: word.to_owned(),
        mood,
        sentences: vec![sentence.to_owned()],
    })
}

fn errors(c: &Comparison) -> Section {
    let all = [("readings", Some(&c.error)), ("held-out readings", c.holdout.as_ref())];
    let known: Vec<(&str, &ErrorSummary)> =
        all.into_iter().filter_map(|(name, e)| Some((name, e?))).collect();
    let largest = known.iter().map(|(_, e)| e.times_noise()).fold(1.0, f64::max);
    let of_poses = c.noise_source != NoiseSource::Sensors;
    let units = UnitsRead::of(known.iter().map(|(_, e)| e.rms.both()));
    let titles = units.of_both(if of_poses { ["translation um", "rotation urad"] } else { ["um", "urad"] });
    let columns = std::iter::once(PageColumn::words(""))
        .chain(titles.chain(["reduced chi2", "x noise"]).map(PageColumn::number))
        .chain([PageColumn::bars()]);
    let mut table = Table::new(columns);
    for (name, e) in known {
        let sizes = units.values(e.rms.both()).chain([significant(e.chi2_reduced, 3)]).map(Cell::from);
        let times = [multiple(e.times_noise()).into(), Cell::times_noise(e.times_noise(), largest)];
        let count = if of_poses { (e.count / 6).to_string() } else { format!("{} numbers", e.count) };
        let name = Cell::from(format!("{name} ({count})"));
        table.row(std::iter::once(name).chain(sizes).chain(times));
    }
    Section::new("The error")
        .id("errors")
        .remark("root mean square; the line across the bars is the noise")
        .table(table)
}

fn coordinates(c: &Comparison) -> Section {
    let remark = format!(
        "root mean square compared with the noise ({}), the line across the bars; bias with its t test",
        c.noise_source.word()
    );
    let title = if c.noise_source == NoiseSource::Sensors { "Sensors" } else { "Coordinates" };
    Section::new(title).remark(remark).table(coordinate_table(&c.coordinates))
}

/// Error of every coordinate or sensor beside its noise.
pub(super) fn coordinate_table(coordinates: &[Coordinate]) -> Table {
    let ratio = |x: &Coordinate| x.rms / x.noise;
    // A column without a reading has no error.
    let read = coordinates.iter().filter(|x| ratio(x).is_finite());
    let largest = read.clone().map(ratio).fold(1.0, f64::max);
    let names = ["rms", "noise", "ratio", "bias", "t", "chance"].map(PageColumn::number);
    let columns = std::iter::once(PageColumn::words("")).chain(names);
    let columns = columns.chain([PageColumn::words("unit"), PageColumn::bars().detail()]);
    let row = |x: &Coordinate| {
        let numbers = [
            significant(x.rms, 3),
            significant(x.noise, 3),
            significant(ratio(x), 3),
            rounded(x.bias, x.noise / 10.0),
            x.t.map_or("-".to_owned(), |t| rounded(t, 1.0)),
            x.p.map_or("-".to_owned(), chance),
        ];
        let numbers = numbers.map(Cell::from).into_iter();
        std::iter::once(Cell::from(x.name.clone()))
            .chain(numbers)
            .chain([x.unit.into(), Cell::times_noise(ratio(x), largest)])
    };
    Table::new(columns).rows(read.map(row))
}

fn adequacy(c: &Comparison) -> Option<Section> {
    let row = |(name, t): (&str, AdequacyTest)| [name.to_owned(), statistic(&t), chance(t.p)];
    let table = Table::named(["test", "statistic", "chance"]).rows(c.adequacy.tests().map(row));
    let section = Section::new("Is the model adequate?")
        .id("adequacy")
        .remark("chance of a worse result if it is right");
    (!table.rows.is_empty()).then(|| section.table(table))
}

fn statistic(t: &AdequacyTest) -> String {
    match t.dof_noise {
        Some(noise) => format!("F({:.0}, {noise:.0}) = {}", t.dof, significant(t.statistic, 3)),
        None => format!("chi2({:.0}) = {}", t.dof, significant(t.statistic, 4)),
    }
}

fn worst(c: &Comparison) -> Section {
    let largest = c.worst_poses.first().map_or(1.0, |w| w.whitened_rms.max(1.0));
    let columns = ["pose", "first line", "readings", "x noise"].map(PageColumn::number);
    let rows = c.worst_poses.iter().map(|w| {
        let numbers = [
            w.pose.to_string(),
            w.line.to_string(),
            w.readings.to_string(),
            format!("{:.2}", w.whitened_rms),
        ];
        numbers.map(Cell::from).into_iter().chain([Cell::times_noise(w.whitened_rms, largest)])
    });
    Section::new("Worst poses")
        .remark("root mean square in units of the noise, the line across the bars")
        .table(Table::new(columns.into_iter().chain([PageColumn::bars()])).rows(rows))
}

fn outliers(c: &Comparison) -> Section {
    let section = Section::new("Outlying readings").id("outliers").remark("kept in everything above");
    if c.outliers.is_empty() {
        return section.paragraph("No single reading is significantly off.");
    }
    let row = |o: &Outlier| [o.line.to_string(), format!("{:.1}", o.z), chance(o.p)];
    let table = Table::named(["line", "times the noise", "chance"]).rows(c.outliers.iter().map(row));
    section.table(table.brief(BRIEF))
}

fn legs(c: &Comparison) -> Section {
    let section = Section::new("Legs");
    if c.legs.is_empty() {
        return section.paragraph(NOT_IN_LEGS);
    }
    let row = |name: &str, cell: fn(&LegResidual) -> String| {
        std::iter::once(name.to_owned()).chain(c.legs.iter().map(cell)).collect::<Vec<_>>()
    };
    let table = Table::named(row("leg", |l| l.leg.to_string()))
        .rows([row("rms", |l| significant(l.rms_um, 3)), row("noise alone", |l| significant(l.noise_um, 3))]);
    section.remark("elongation of each leg that would explain the residuals, um").table(table)
}

fn follows(c: &Comparison) -> Option<Section> {
    if c.legs.is_empty() {
        return None;
    }
    let row = |a: &Association| {
        [
            format!("{} of {}", a.of, who(a.leg)),
            a.variable.to_owned(),
            format!("{:+.2}", a.rank_correlation),
            significant(a.f, 3),
            chance(a.p),
        ]
    };
    let columns = [PageColumn::words("what"), PageColumn::words("follows")];
    let columns = columns.into_iter().chain(["rank correlation", "F", "chance"].map(PageColumn::number));
    let table = Table::new(columns).rows(c.associations.iter().map(row)).brief(BRIEF);
    let found = if c.associations.is_empty() {
        Block::paragraph("They correlate significantly with no variable.")
    } else {
        Block::Table(table)
    };
    let period = c.period.as_ref().map_or("No period in leg length is significant.".to_owned(), |p| {
        let (period, chance) = (significant(p.period_mm, 3), chance(p.false_alarm));
        format!("The {} of {} repeats with leg length every {period} mm (chance {chance}).", p.of, who(p.leg))
    });
    let section = Section::new("What the residuals follow")
        .id("follows")
        .remark("chance corrected for the number of tests");
    Some(section.with(found).paragraph(period))
}

/// `leg 3`, or all.
pub(crate) fn who(leg: Option<usize>) -> String {
    leg.map_or("all legs".to_owned(), |l| format!("leg {l}"))
}

fn plan(c: &Comparison) -> Section {
    let d = &c.design;
    let condition = d.condition.map_or("infinite".to_owned(), |c| significant(c, 3));
    let index = |o1: f64| {
        let o1 = significant(o1, 4);
        format!("Observability index O1 {o1} (the paper's eq. 14, m and rad per m/N).")
    };
    let items = std::iter::once(format!("Rank {} of {}, condition {condition}.", d.rank, d.parameters))
        .chain(d.paper.as_ref().map(|o| index(o.o1)))
        .chain(d.unobservable.iter().map(|text| format!("Not determined: {text}.")))
        .chain(d.weakest.iter().map(|text| format!("Weakest: {text}.")));
    Section::new("What the plan determines").id("plan").list(items)
}

fn hidden(c: &Comparison) -> Option<Section> {
    let row = |h: &HiddenBias| {
        let star = if h.would_show { "" } else { " *" };
        let size = format!("{} {}{star}", significant(h.size, 2), h.unit);
        let bias = h.bias_of_leg_stiffness_percent.map(|b| format!("{b:+.1}"));
        [h.term.clone(), size].into_iter().chain(bias).collect::<Vec<_>>()
    };
    let header = ["effect", "size", "leg 1", "2", "3", "4", "5", "6"];
    let section = Section::new("What the springs could absorb")
        .id("hidden")
        .remark("bias of each leg stiffness, percent")
        .paragraph(
            "Bias from an effect of the smallest detectable size (*: not detectable even at its largest plausible size).",
        )
        .table(Table::named(header).rows(c.hidden.iter().map(row)).brief(BRIEF));
    (!c.hidden.is_empty()).then_some(section)
}
