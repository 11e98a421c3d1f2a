//! The numbers of a comparison: errors, coordinates, tests, what the residuals follow, what stands out, what could hide.

use hexbench_model::compare::Comparison;
use hexbench_model::compare::absorbed::HiddenBias;
use hexbench_model::compare::association::Association;
use hexbench_model::compare::coordinates::Coordinate;
use hexbench_report::html::{Block, Cell, Mood, Section};
use hexbench_report::number::{rounded, significant};

use crate::comparison::{Answer, chance, statistic, tests, who};

/// Is the model adequate, in a sentence.
pub(crate) fn verdict(c: &Comparison) -> Section {
    let answer = Answer::of(&c.adequacy);
    let (word, mood) = match answer {
        Answer::Adequate => ("ADEQUATE", Mood::Good),
        Answer::NotAdequate => ("NOT ADEQUATE", Mood::Bad),
        Answer::Open => ("OPEN", Mood::Doubt),
    };
    let how = if c.fitted_here { "fitted to these readings" } else { "as saved, nothing fitted here" };
    let model = std::iter::once("leg springs").chain(c.terms.iter().map(String::as_str));
    let title = format!("Compared: {}", model.collect::<Vec<_>>().join(" + "));
    let text = match answer {
        Answer::NotAdequate => "Something is missing in this model: its error is beyond the noise.",
        Answer::Adequate => "As far as these readings tell, the error of this model is noise.",
        Answer::Open => answer.sentence(),
    };
    let word = word.to_owned();
    Section::new("verdict", title, how).with(Block::Verdict { word, mood, text: text.to_owned() })
}

/// Error over all readings, fitted and held out.
pub(crate) fn errors(c: &Comparison) -> Section {
    let all = [("readings", Some(&c.error)), ("held-out readings", c.holdout.as_ref())];
    let largest = all.iter().filter_map(|(_, e)| Some(e.as_ref()?.chi2_reduced.sqrt())).fold(1.0, f64::max);
    let rows = all.into_iter().filter_map(|(name, e)| Some((name, e?))).map(|(name, e)| {
        let times = e.chi2_reduced.sqrt();
        let sizes = [e.rms.translation_um, e.rms.rotation_urad].map(|x| Cell::new(significant(x, 3)));
        let head = [Cell::new(format!("{name} ({})", e.count / 6)), Cell::new(significant(times, 3))];
        head.into_iter().chain([Cell::bar(times / largest)]).chain(sizes).collect()
    });
    let noise = vec![Cell::new("noise"), Cell::new("1"), Cell::bar(1.0 / largest)];
    let header = ["", "x noise", "", "um", "urad"];
    Section::new("errors", "The error", "Root mean square; bars in units of the noise of one reading.")
        .with(Block::table(header, rows.chain([noise])))
}

/// Every coordinate beside its noise.
pub(crate) fn coordinates(c: &Comparison) -> Section {
    let ratio = |x: &Coordinate| x.rms / x.noise;
    let largest = c.coordinates.iter().map(ratio).fold(1.0, f64::max);
    let row = |x: &Coordinate| {
        vec![
            Cell::new(x.name),
            Cell::new(significant(x.rms, 3)),
            Cell::new(significant(x.noise, 3)),
            Cell::new(x.unit),
            Cell::new(significant(ratio(x), 3)),
            Cell::bar(ratio(x) / largest),
            Cell::new(rounded(x.bias, x.noise / 10.0)),
            Cell::new(x.t.map_or("-".to_owned(), |t| rounded(t, 1.0))),
            Cell::new(x.p.map_or("-".to_owned(), chance)),
        ]
    };
    let header = ["", "rms", "noise", "unit", "ratio", "", "mean", "t", "chance"];
    let remark = format!(
        "Residuals of single readings beside the noise ({}); mean over conditions with its t test against zero.",
        c.noise_source
    );
    Section::new("coordinates", "Coordinates", remark)
        .with(Block::table(header, c.coordinates.iter().map(row)))
}

/// Tests of the model as a whole.
pub(crate) fn adequacy(c: &Comparison) -> Section {
    let row = |(name, t): (&str, _)| vec![Cell::new(name), Cell::new(statistic(&t)), Cell::new(chance(t.p))];
    let section =
        Section::new("adequacy", "Is the model adequate?", "Chance of a worse result if it is right.");
    let all = tests(&c.adequacy);
    let section = if all.is_empty() {
        section
    } else {
        section.with(Block::table(["test", "statistic", "chance"], all.into_iter().map(row)))
    };
    section.with(Block::paragraph(Answer::of(&c.adequacy).sentence().replace('`', "")))
}

/// Variables that the residual elongations follow.
pub(crate) fn follows(c: &Comparison) -> Section {
    let row = |a: &Association| {
        vec![
            Cell::new(format!("{} of {}", a.of, who(a.leg))),
            Cell::new(a.variable),
            Cell::new(format!("{:+.2}", a.rank_correlation)),
            Cell::new(significant(a.f, 3)),
            Cell::new(chance(a.p)),
        ]
    };
    let remark = "Linear and quadratic; chance by noise, corrected for the number of questions asked.";
    let section = Section::new("follows", "What the residuals follow", remark);
    let section = if c.associations.is_empty() {
        section.with(Block::paragraph("They follow no variable beyond chance."))
    } else {
        let header = ["what", "follows", "rank correlation", "F", "chance"];
        section.with(Block::table(header, c.associations.iter().map(row)))
    };
    let period = c.period.as_ref().map_or("No period in leg length is beyond chance.".to_owned(), |p| {
        let (period, chance) = (significant(p.period_mm, 3), chance(p.false_alarm));
        format!("The {} of {} repeats with leg length every {period} mm (chance {chance}).", p.of, who(p.leg))
    });
    section.with(Block::paragraph(period))
}

/// Poses and readings that stand out.
pub(crate) fn stands_out(c: &Comparison) -> Section {
    let largest = c.worst_poses.first().map_or(1.0, |w| w.whitened_rms);
    let poses = c.worst_poses.iter().map(|w| {
        vec![
            Cell::new(w.pose.to_string()),
            Cell::new(w.line.to_string()),
            Cell::new(w.readings.to_string()),
            Cell::new(significant(w.whitened_rms, 3)),
            Cell::bar(w.whitened_rms / largest),
        ]
    });
    let header = ["worst poses", "first line", "readings", "x noise", ""];
    let section =
        Section::new("stands-out", "What stands out", "Nothing was left out of what is said above.")
            .with(Block::table(header, poses));
    if c.outliers.is_empty() {
        return section.with(Block::paragraph("No single reading is beyond chance."));
    }
    let readings = c.outliers.iter().map(|o| {
        vec![Cell::new(format!("line {}", o.line)), Cell::new(significant(o.z, 2)), Cell::new(chance(o.p))]
    });
    section.with(Block::table(["readings beyond chance", "x noise", "chance"], readings))
}

/// What the plan determines.
pub(crate) fn plan(c: &Comparison) -> Section {
    let d = &c.design;
    let condition = d.condition.map_or("infinite".to_owned(), |c| significant(c, 3));
    let mut items = vec![format!("Rank {} of {}, condition {condition}.", d.rank, d.parameters)];
    let index = |o1: f64| format!("Observability index O1 {o1:.4e} (the paper's eq. 14, m and rad per m/N).");
    items.extend(d.paper.as_ref().map(|o| index(o.o1)));
    items.extend(d.unobservable.iter().map(|text| format!("Not determined: {text}.")));
    items.extend(d.weakest.iter().map(|text| format!("Weakest: {text}.")));
    Section::new("plan", "What the plan lets be seen", "").with(Block::list(items))
}

/// Effects that could hide in the springs.
pub(crate) fn hidden(c: &Comparison) -> Option<Section> {
    if c.hidden.is_empty() {
        return None;
    }
    let row = |h: &HiddenBias| {
        let star = if h.would_show { "" } else { " *" };
        let head = [Cell::new(&h.term), Cell::new(format!("{} {}{star}", significant(h.size, 2), h.unit))];
        let bias = h.bias_of_leg_stiffness_percent.map(|b| Cell::new(format!("{b:+.1}")));
        head.into_iter().chain(bias).collect()
    };
    let remark = "Bias of each leg stiffness in percent by an effect of the size that these readings would just show \
                  (*: not even its largest sensible size would show).";
    let header = ["effect", "size", "leg 1", "2", "3", "4", "5", "6"];
    let section = Section::new("hidden", "What could hide in the springs", remark);
    Some(section.with(Block::table(header, c.hidden.iter().map(row))))
}
