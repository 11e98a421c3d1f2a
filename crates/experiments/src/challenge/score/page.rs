//! Scores as a page: text or Markdown, programs side by side.

use hexbench_report::{Page, Section, Table};

use super::cells::{chance, counts, differences, exact, gained, number, percent, ratios, share, with_error};
use super::figures::Figures;
use super::paired::{Differences, Exchanges, Ratios};
use super::{CaseGroup, ChallengeScores, EntrantScore};
use crate::challenge::run::RunLimits;
use crate::shares::{dash, or_dash};

/// Failures told one by one of each program.
const MOST_TOLD: usize = 12;

/// The page: the whole, each group, failures, how it was run.
pub fn page(scores: &ChallengeScores) -> Page {
    Page::new(format!("Challenge {}, version {}", scores.suite, scores.version))
        .with(Section::lead().paragraph(lead(scores)))
        .with_all(figures(scores))
}

/// What was asked, of how many cases.
pub(super) fn lead(scores: &ChallengeScores) -> String {
    format!("{}. {} cases, {}.", scores.title, cases(scores), seed(scores))
}

/// All figures, programs side by side.
pub(super) fn figures(scores: &ChallengeScores) -> Vec<Section> {
    let failed = scores.entrants.iter().flat_map(failures);
    let side_by_side =
        Section::new("Side by side").table(table(scores, "", whole(scores))).paragraph(explained(scores));
    [Some(side_by_side), Some(by_group(scores)), better(scores)]
        .into_iter()
        .chain([
            Section::new("Cases without answer").list(failed).unless_empty(),
            Some(how_it_was_run(scores)),
        ])
        .flatten()
        .collect()
}

fn seed(scores: &ChallengeScores) -> String {
    scores.seed.map_or("of a seed that the organiser keeps".to_owned(), |seed| format!("seed {seed}"))
}

/// What nobody states has no table.
fn by_group(scores: &ChallengeScores) -> Section {
    let is_stated = |cell: &Cell| {
        let mut figures = scores.entrants.iter().flat_map(|e| &e.groups).map(|g| cell(&g.figures));
        figures.any(|figure| figure != dash())
    };
    let stated = BY_GROUP.iter().filter(|(_, _, cell)| is_stated(cell));
    stated.fold(Section::new("By group of cases"), |section, (title, words, cell)| {
        let rows = scores.groups.iter().enumerate().map(|(g, CaseGroup { name, cases })| {
            let label = format!("{name} ({cases})");
            row(&label, scores, |e| cell(&e.groups[g].figures))
        });
        section.paragraph(format!("{title}. {words}")).table(table(scores, "group (cases)", rows))
    })
}

fn how_it_was_run(scores: &ChallengeScores) -> Section {
    Section::new("How it was run").list(scores.entrants.iter().map(how)).paragraph(format!(
        "Challenge made by hexbench {}, scored by hexbench {}; SHA-256 of challenge.toml: {}.",
        scores.made_by, scores.hexbench, scores.challenge_sha256
    ))
}

const EXPLAINED: &str = "Errors of stiffness: root mean square over the legs of a case, median over cases. Chi-square: held-out \
readings minus prediction in standard deviations of one reading, per number; 1 is noise. Error against the truth: prediction minus the \
noise-free reading, in the same unit; 0 is perfect. Intervals: how many of the stated 95 % intervals hold the truth, with exact binomial bounds \
(legs and readings of a case are not independent, so these are somewhat narrow). Right: exactly what is hidden is said; honest: ambiguous, \
with all that is hidden among what is kept; wrong: anything else. CRPS and interval score: proper scores of \
numbers with their uncertainty, means with their standard errors; 0 is perfect, too wide costs as too narrow does, and without an uncertainty \
the CRPS is the absolute error. Of effects: in the root mean square of their true numbers, in cases whose hidden effects are all stated in full. Log and Brier scores: of the stated probabilities where at most \
one effect is hidden, with the standard error; 0 is perfect. A dash: not stated.";

/// Of figures that several programs have.
const COMPARED: &str = " \"Times the best\": geometric mean over the cases that all answered, with its 95 % interval from the differences case \
by case. More often than the first: in percentage points, from the cases in which only one of both is so, with the exact 95 % interval and the \
chance of so uneven an exchange between equals (McNemar). Above the best: mean difference case by case, with its standard error.";

fn has_rivals(scores: &ChallengeScores) -> bool {
    scores.entrants.len() > 1
}

fn explained(scores: &ChallengeScores) -> String {
    format!("{EXPLAINED}{}", if has_rivals(scores) { COMPARED } else { "" })
}

type Cell = fn(&Figures) -> String;

const BY_GROUP: [(&str, &str, Cell); 5] = [
    ("Error against the truth, in noise", "Median over the cases of the group.", |f| {
        number(f.error_in_noise)
    }),
    ("Error of the leg stiffnesses, %", "Median over the cases of the group.", |f| {
        number(f.stiffness_error.map(|share| 100.0 * share))
    }),
    ("95 % intervals of leg stiffnesses that hold, %", "All legs of the group.", |f| {
        share(f.stiffness_covered)
    }),
    ("95 % intervals of predictions that hold, %", "All numbers of the group.", |f| {
        share(f.predictions_covered)
    }),
    ("Diagnoses", "Right / honest / wrong.", |f| counts(f.outcomes)),
];

fn cases(scores: &ChallengeScores) -> usize {
    scores.groups.iter().map(|g| g.cases).sum()
}

/// Every figure; those that compare programs where there are several.
fn whole(scores: &ChallengeScores) -> impl Iterator<Item = Vec<String>> {
    let entrants = &scores.entrants;
    let stiffness = Ratios::of(entrants, super::CaseScore::stiffness_error);
    let prediction = Ratios::of(entrants, |c| c.prediction.map(|p| p.error_in_noise));
    let stiffness_crps = Differences::of(entrants, |c| c.stiffness.map(|s| 100.0 * s.crps));
    let effects_crps = Differences::of(entrants, |c| c.effect_numbers.map(|s| 100.0 * s.crps));
    let predicted_crps = Differences::of(entrants, |c| c.prediction.map(|p| p.proper.crps));
    let log = Differences::of(entrants, |c| c.forecast.map(|f| f.log));
    let brier = Differences::of(entrants, |c| c.forecast.map(|f| f.brier));
    let plain = |label: &str, cell: Cell| Some(row(label, scores, |e| cell(&e.all)));
    let beside = |cells: Vec<String>| has_rivals(scores).then_some(cells);
    let compared = |label: &str, cases: usize, cells: Vec<String>| {
        beside(std::iter::once(format!("{label} ({cases} cases)")).chain(cells).collect())
    };
    let outcome = |label: &str, word: &str, told: fn(&Exchanges) -> Option<String>| {
        beside(row(label, scores, |e| exchanged(scores, e, word, told)))
    };
    [
        plain("cases answered", |f| format!("{} of {}", f.answered, f.cases)),
        plain("leg stiffness: error, %", |f| number(f.stiffness_error.map(|share| 100.0 * share))),
        compared("leg stiffness: times the best", stiffness.cases, ratios(&stiffness)),
        plain("leg stiffness: z, root mean square", |f| number(f.stiffness_z)),
        plain("leg stiffness: 95 % intervals hold, %", |f| share(f.stiffness_covered)),
        plain("leg stiffness: CRPS, %", |f| exact(percent(f.stiffness_crps))),
        compared(
            "leg stiffness: CRPS above the best",
            stiffness_crps.cases,
            differences(&stiffness_crps, exact),
        ),
        plain("leg stiffness: interval score, %", |f| exact(percent(f.stiffness_interval))),
        plain("effects: CRPS of their numbers, %", |f| exact(percent(f.effects_crps))),
        compared("effects: CRPS above the best", effects_crps.cases, differences(&effects_crps, exact)),
        plain("effects: interval score, %", |f| exact(percent(f.effects_interval))),
        plain("predictions: chi-square", |f| number(f.chi2_reduced)),
        plain("predictions: error against the truth, in noise", |f| number(f.error_in_noise)),
        compared("predictions: times the best", prediction.cases, ratios(&prediction)),
        plain("predictions: error, um", |f| number(f.rms_um)),
        plain("predictions: error, urad", |f| number(f.rms_urad)),
        plain("predictions: 95 % intervals hold, %", |f| share(f.predictions_covered)),
        plain("predictions: CRPS, in noise", |f| exact(f.predictions_crps)),
        compared(
            "predictions: CRPS above the best",
            predicted_crps.cases,
            differences(&predicted_crps, exact),
        ),
        plain("predictions: interval score, in noise", |f| exact(f.predictions_interval)),
        plain("diagnoses: right / honest / wrong", |f| counts(f.outcomes)),
        plain("diagnoses: right, %", |f| share(f.outcome_shares.map(|s| s[0]))),
        plain("diagnoses: wrong, %", |f| share(f.outcome_shares.map(|s| s[2]))),
        outcome("diagnoses: right more often than the first, %", "right", gained),
        outcome("diagnoses: chance of that between equals", "right", chance),
        outcome("diagnoses: wrong more often than the first, %", "wrong", gained),
        outcome("diagnoses: chance of that between equals", "wrong", chance),
        plain("probabilities: log score, nats", |f| with_error(f.log)),
        compared("probabilities: log above the best", log.cases, differences(&log, with_error)),
        plain("probabilities: Brier score", |f| with_error(f.brier)),
        compared("probabilities: Brier above the best", brier.cases, differences(&brier, with_error)),
        plain("time of a case, median, s", |f| number(f.wall_s)),
        plain("time of a case, longest, s", |f| number(f.longest_s)),
        plain("memory, most, MB", |f| or_dash(f.peak_memory_mb, |mb| format!("{mb:.0}"))),
    ]
    .into_iter()
    .flatten()
}

fn table(scores: &ChallengeScores, corner: &str, rows: impl IntoIterator<Item = Vec<String>>) -> Table {
    let names = scores.entrants.iter().map(|e| e.name.as_str());
    Table::named(std::iter::once(corner).chain(names)).rows(rows)
}

fn row(label: &str, scores: &ChallengeScores, cell: impl Fn(&EntrantScore) -> String) -> Vec<String> {
    std::iter::once(label.to_owned()).chain(scores.entrants.iter().map(cell)).collect()
}

/// How an outcome moves case by case beside the first; the first against itself, and without common cases: a dash.
fn exchanged(
    scores: &ChallengeScores,
    entrant: &EntrantScore,
    word: &str,
    told: fn(&Exchanges) -> Option<String>,
) -> String {
    let Some(first) = scores.entrants.first().filter(|first| first.name != entrant.name) else {
        return dash();
    };
    let is = |c: &super::CaseScore| c.outcome.map(|outcome| outcome == word);
    let found = Exchanges::count(entrant.cases.iter().zip(&first.cases).map(|(a, b)| (is(a), is(b))));
    told(&found).unwrap_or_else(dash)
}

fn better(scores: &ChallengeScores) -> Option<Section> {
    let (first, rivals) = scores.entrants.split_first().filter(|(_, rivals)| !rivals.is_empty())?;
    let section = Section::new(format!("Where another is ahead of {}", first.name)).paragraph(
        "Geometric mean of its errors over those of the first entrant, on the cases of a group that both answered, with the 95 % interval; \
         an interval that holds 1 may be chance. And groups in which it is right more often.",
    );
    let found = super::better::found(scores, first, rivals);
    Some(if found.is_empty() { section.paragraph("Nowhere.") } else { section.list(found) })
}

fn failures(entrant: &EntrantScore) -> Vec<String> {
    let all: Vec<String> =
        entrant.failures().map(|(id, why)| format!("{}, {id}: {why}", entrant.name)).collect();
    let more = all.len().saturating_sub(MOST_TOLD);
    let rest = (more > 0).then(|| format!("{}: {more} more", entrant.name));
    all.into_iter().take(MOST_TOLD).chain(rest).collect()
}

/// Name, call and limits; of a path only the name, which means something elsewhere.
fn how(entrant: &EntrantScore) -> String {
    let short = |word: &String| word.rsplit('/').next().unwrap_or(word).to_owned();
    let words: Vec<String> = entrant.program.iter().map(short).collect();
    if entrant.limits == RunLimits::NONE {
        return format!(
            "{}: {}, in its own process without limits; {}",
            entrant.name,
            words.join(" "),
            entrant.system
        );
    }
    let l = entrant.limits;
    format!(
        "{}: `{} CASE OUT`; at most {} s, {} MB of memory, {} MB of output a case; {}",
        entrant.name,
        words.join(" "),
        l.time_s,
        l.memory_mb,
        l.output_mb,
        entrant.system
    )
}
