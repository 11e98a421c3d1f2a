//! A comparison and a baseline as pages.

use hexbench_report::number::{hundredths, significant};
use hexbench_report::{Block, Mood, Page, PageColumn, Section, Table};

use super::cases::update;
use super::comparison::{GateChange, GateComparison, GateOutcome};
use super::figure::FIGURES;
use super::notice::{Noticed, SHARE, noticed};
use super::work::CONFIRMED;
use super::{GateBaseline, GateEntrant};
use crate::alarm::same_cases::{FigureKind, SAME_CASES};
use crate::alarm::table::{LimitRow, section};
use crate::alarm::{LimitVerdict, POWER, probability, share_of_level};
use crate::shares::or_dash;

/// Changes told one by one.
const SHOWN: usize = 12;
/// What the files of a function do not show.
const UNSEEN: &str = "A function in its own process: modules that it imports, values that it takes from outside itself and other versions of packages do not \
                      show in its files, unless they are named as what it depends on.";
/// Digits of a figure.
const DIGITS: i32 = 3;

/// The page of a check: the verdict, what is worse with what to do, the cases, the other figures, the rule.
pub fn page(c: &GateComparison) -> Page {
    let [worse, better, same] = [LimitVerdict::Worse, LimitVerdict::Better, LimitVerdict::Same]
        .map(|verdict| c.of(verdict).collect::<Vec<&GateOutcome>>());
    let update = update(c.inside);
    let meant = format!("Meant? `{update}` makes this the baseline.");
    let steps =
        worse.iter().map(|f| format!("{}: {} {} {}", f.title, f.figure().why, elsewhere(f), f.figure().next));
    Page::new("Gate")
        .with(Section::lead().with(verdict(c)).with_all(notes(c).into_iter().map(Block::paragraph)))
        .with(section("Worse", &worse))
        .with(Section::new("What to do").list(steps).paragraph(meant).when(c.fails()))
        .with(changed(c))
        .with(section("Better", &better).map(|s| s.remark(format!("`{update}` makes them the baseline"))))
        .with(section("As before", &same))
        .with(Section::new("The rule").list(rule(c)))
}

/// What the cases that moved say of other cases.
fn elsewhere(f: &GateOutcome) -> String {
    let [worse, better] = f.moved;
    format!(
        "{worse} cases are worse, {better} better (by chance on other cases: {}).",
        probability(f.elsewhere)
    )
}

fn verdict(c: &GateComparison) -> Block {
    let failed: Vec<&str> = c.of(LimitVerdict::Worse).map(|f| f.title.as_str()).collect();
    let improved = c.of(LimitVerdict::Better).count();
    let (word, mood, what) = match (failed.is_empty(), improved) {
        (true, _) if c.same => ("passed", Mood::Good, "every case has the scores of the baseline".to_owned()),
        (true, 0) => ("passed", Mood::Good, "no figure is worse than the baseline allows".to_owned()),
        (true, n) => ("passed", Mood::Good, format!("no figure is worse, {n} are better: consider --update")),
        (false, _) => ("failed", Mood::Bad, format!("worse: {}", failed.join("; "))),
    };
    let [_, runs] = c.runs;
    let runs = if runs == 1 { "one run".to_owned() } else { format!("{runs} runs") };
    let about = format!("{} cases of {}, {runs}: {what}.", c.cases, c.suite);
    Block::Verdict { word: word.to_owned(), mood, sentences: vec![about] }
}

fn notes(c: &GateComparison) -> Vec<String> {
    let update = c.baseline.as_ref().map(|u| {
        format!("Baseline of {}, hexbench {}, {} runs: {}.", u.date, u.hexbench, u.runs, u.reason())
    });
    let files = match c.changed_files.as_slice() {
        [] => "The files of the program are those of the baseline.".to_owned(),
        changed => format!("Files of the program that changed since: {}.", changed.join(", ")),
    };
    let scattered = (!c.scattered.is_empty()).then(|| {
        let shown: Vec<&str> = c.scattered.iter().take(SHOWN).map(String::as_str).collect();
        format!(
            "{} cases gave other scores in each run, though those of the baseline did not ({}): the best of {CONFIRMED} runs counts. Record the \
             baseline again when the program is meant to be random.",
            c.scattered.len(),
            shown.join(", ")
        )
    });
    let unseen = c.inside.then(|| UNSEEN.to_owned());
    update.into_iter().chain([files]).chain(unseen).chain(scattered).collect()
}

/// The rule in words, with its chances.
fn rule(c: &GateComparison) -> Vec<String> {
    let tolerance = format!("{:.0}", 100.0 * (SAME_CASES - 1.0));
    let of_chance = match c.level {
        None => format!(
            "All {} runs of the baseline gave the same scores, so a change is no chance. Cases that differ are run {CONFIRMED} times and count \
             as worse only when they are so each time: an unchanged program fails with a probability of {} at most.",
            c.runs[0],
            probability(c.false_alarm)
        ),
        Some(level) => format!(
            "The runs of the baseline differ: what chance does in each case is taken from its {} runs. A figure fails only when so much worse \
             has a probability of {} by chance; an unchanged program fails with {} at most.",
            c.runs[0],
            probability(level),
            probability(c.false_alarm)
        ),
    };
    vec![
        format!("The same cases are compared, one by one. Bad cases may not become more; a mean may grow by {tolerance} %."),
        of_chance,
        "By chance on other cases: how probable it is that as many more get worse than better when each way is as probable (sign test).".to_owned(),
    ]
}

/// A figure of a finding: 0 the baseline, 1 now; in words where no case has one.
pub fn figure(f: &GateOutcome, k: usize) -> String {
    let value = f.figures[k];
    if !value.is_finite() {
        return "no answer has it".to_owned();
    }
    match f.figure().kind {
        FigureKind::Hit => format!("{} of {}", count(value), f.cases),
        FigureKind::Size { .. } => short(value),
    }
}

/// A number of cases, which is a mean over runs.
fn count(value: f64) -> String {
    if value.fract() == 0.0 { format!("{value:.0}") } else { format!("{value:.1}") }
}

/// What would be noticed, in words.
pub fn notice(noticed: &Noticed) -> String {
    match noticed {
        Noticed::Nothing => "nothing".to_owned(),
        Noticed::Size { factor } => format!("x {factor:.2}"),
        Noticed::Hits { cases, share, .. } => {
            let share = share
                .map_or("no share of them surely".to_owned(), |p| format!("{} % of them", hundredths(p)));
            let word = if *cases == 1 { "case" } else { "cases" };
            format!("{cases} {word} more; {share}")
        }
    }
}

impl LimitRow for GateOutcome {
    fn cells(&self) -> [String; 5] {
        let chance = or_dash(self.chance, probability);
        [self.title.clone(), figure(self, 1), figure(self, 0), chance, notice(&self.noticed)]
    }
}

fn changed(c: &GateComparison) -> Option<Section> {
    let mut cases: Vec<Vec<&GateChange>> = Vec::new();
    for change in &c.changes {
        match cases.iter_mut().find(|of_case| of_case[0].case == change.case) {
            Some(of_case) => of_case.push(change),
            None => cases.push(vec![change]),
        }
    }
    let columns = ["case", "group", "hidden", "what got worse", "said"].map(PageColumn::words);
    let table = Table::new(columns).rows(cases.iter().take(SHOWN).map(|of_case| row(of_case)));
    let more = cases.len().saturating_sub(SHOWN);
    let section = Section::new("Cases that got worse").table(table);
    let section =
        if more == 0 { section } else { section.paragraph(format!("{more} more are in the JSON.")) };
    section.when(!cases.is_empty())
}

/// All that got worse of a case.
fn row(of_case: &[&GateChange]) -> Vec<String> {
    let first = of_case[0];
    let hidden = if first.effects.is_empty() { "nothing".to_owned() } else { first.effects.join(" + ") };
    let what: Vec<String> = of_case.iter().map(|change| got_worse(change)).collect();
    let told = of_case.iter().find_map(|change| change.told.clone()).unwrap_or_default();
    vec![first.case.clone(), first.group.clone(), hidden, what.join("; "), told]
}

fn got_worse(change: &GateChange) -> String {
    let word = change.figure.replace('-', " ");
    let is_hit = FIGURES.iter().any(|f| f.id == change.figure && f.kind == FigureKind::Hit);
    let is_whole = change.before == 0.0 && change.now >= 1.0;
    if is_hit && is_whole {
        return word;
    }
    format!("{word} {} -> {}", short(change.before), short(change.now))
}

/// Three digits; what is next to nothing as a power of ten.
fn short(value: f64) -> String {
    const LEAST: f64 = 1e-6;
    if value > 0.0 && value < LEAST { format!("{value:.0e}") } else { significant(value, DIGITS) }
}

/// The page of a baseline: what it was made of, its figures, what a check would notice.
pub fn recorded(baseline: &GateBaseline) -> Page {
    let GateEntrant { program, files, .. } = &baseline.entrant;
    let level = (!baseline.steady).then(|| share_of_level(FIGURES.len()));
    let now_runs = if baseline.steady { 1 } else { baseline.repeats };
    let table = Table::named(["figure", "baseline", "would notice"]).words_in(2);
    let rows = FIGURES.iter().filter_map(|f| {
        let before = baseline.figures.runs(f.id)?;
        let seen = noticed(f.kind, &before, now_runs, level);
        let judged = crate::alarm::same_cases::judge(f.kind, &before, &before, level);
        let value = match f.kind {
            FigureKind::Hit => format!("{} of {}", count(judged.figures[0]), judged.cases),
            FigureKind::Size { .. } => short(judged.figures[0].exp()),
        };
        Some([f.title.to_owned(), value, notice(&seen)])
    });
    let scatter = if baseline.steady {
        format!("All {} runs gave the same scores: every case that becomes bad is noticed.", baseline.repeats)
    } else if baseline.repeats == 1 {
        "One run says nothing about the program's own scatter: with more --repeats, smaller changes are noticed."
            .to_owned()
    } else {
        format!(
            "The {} runs differ; a check takes as many. With more --repeats, smaller changes are noticed.",
            baseline.repeats
        )
    };
    Page::new("Gate: the baseline")
        .about("program", program.join(" "))
        .about("files", files.keys().cloned().collect::<Vec<_>>().join(", "))
        .about("cases", format!("{} of {}", baseline.cases.len(), baseline.suite.in_words()))
        .with(
            Section::lead()
                .paragraph(scatter)
                .paragraph(three_percent(baseline, now_runs, level))
                .with(baseline.entrant.inside.then(|| Block::paragraph(UNSEEN))),
        )
        .with(Section::new("Figures").table(table.rows(rows)))
}

/// Would the gate notice that some hundredths of the answers become confidently wrong?
fn three_percent(baseline: &GateBaseline, now_runs: usize, level: Option<f64>) -> String {
    let values = ["confidently-wrong", "stiffness-far-off", "prediction-far-off", "unanswered"]
        .iter()
        .find_map(|id| baseline.figures.runs(id));
    match noticed(FigureKind::Hit, &values.unwrap_or_default(), now_runs, level) {
        Noticed::Hits { cases, of, chance, needed, .. } => format!(
            "When each of the {of} answers that are not confidently wrong becomes so with a probability of {:.0} %, a check notices it with \
             {:.0} %: {} enough. With {needed} such cases it would be {:.0} %.",
            100.0 * SHARE,
            100.0 * chance,
            if cases == 1 { "one of them is".to_owned() } else { format!("{cases} of them are") },
            100.0 * POWER,
        ),
        _ => "The program states neither probabilities nor uncertainties: only errors and missing answers are compared.".to_owned(),
    }
}
