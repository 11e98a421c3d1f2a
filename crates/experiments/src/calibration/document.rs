//! The study as a page.

use hexbench_core::statistics::Proportion;
use hexbench_report::number::hundredths;
use hexbench_report::words::written_by;
use hexbench_report::{Block, Page, Section};
use hexbench_truth::campaign::CaseKind;

use super::sheets;
use super::trust::{CREDIBLE, MOST_BEHIND, MOST_FALSE_NAMES, overlooked};
use super::{
    Calibration, CalibrationRecord, Curve, DISTANCES, WELL_VISIBLE, credible_coverage, false_names,
    false_names_among_named, false_outside, is_well_visible, prediction_coverage, stiffness_coverage,
};
use crate::calibration::Fate;
use crate::pages::tabled;
use crate::shares::in_words;

/// The page: figures, tables and the charts of a folder beside it.
pub fn page(study: &Calibration, charts: &str) -> Page {
    let records = &study.records;
    let chart = |title: &str, file: &str, words: String| {
        Section::new(title).paragraph(words).figure(format!("{charts}/{file}"), title).detail()
    };
    Page::new("How far the diagnosis can be trusted")
        .with(introduction(study).detail())
        .with(Section::new("In short").list(headlines(records)))
        .with(tabled("What became of the truths", FATES, sheets::fates(records)))
        .with(chart("What was hidden and what was said", "confusion.svg", confusion_words()))
        .with(reliability(
            records,
            charts,
            chart("Do probabilities mean what they say", "reliability.svg", RELIABILITY.to_owned()),
        ))
        .with(power(records, chart("How large an effect must be", "power.svg", POWER.to_owned())))
        .with(outside(records, chart("Noticing what the catalogue lacks", "outside.svg", OUTSIDE.to_owned())))
        .with(tabled("Credible sets", COVERAGE, sheets::coverage(records)).detail())
        .with(tabled("Intervals of the final model", INTERVALS, sheets::intervals(records)).detail())
        .with(tabled("Numbers of the final model", NUMBERS, sheets::numbers(records)).detail())
        .with(tabled("Where it goes wrong", MISTAKES, sheets::mistakes_table(records)))
        .with(study.unanswered())
        .with(again(study).detail())
}

/// The figures everything else explains, one sentence each.
pub fn headlines(records: &[CalibrationRecord]) -> Vec<String> {
    let of_all = false_names(records);
    let visible = || records.iter().filter(|r| r.distance.is_some() && is_well_visible(r));
    let right = |kind: CaseKind| {
        let of_kind = visible().filter(move |r| r.kind == kind);
        Proportion::count(of_kind, |r| r.fate == Fate::Right)
    };
    let right_answers = || records.iter().filter(|r| r.fate == Fate::Right);
    vec![
        format!(
            "An effect that is not there was named in {}; at most {} % with 95 % confidence (limit {} %).",
            in_words(of_all),
            hundredths(of_all.upper_bound()),
            hundredths(MOST_FALSE_NAMES)
        ),
        format!(
            "Of the answers that name anything, {} name something false.",
            in_words(false_names_among_named(records))
        ),
        format!("\"Outside\" was said wrongly in {}.", in_words(false_outside(records))),
        format!(
            "One effect at distance {WELL_VISIBLE} or more was named in {}.",
            in_words(right(CaseKind::Single))
        ),
        format!(
            "Two effects, each at {WELL_VISIBLE} or more, were both named in {}.",
            in_words(right(CaseKind::Pair))
        ),
        format!(
            "Three effects, each at {WELL_VISIBLE} or more, were all named in {}.",
            in_words(right(CaseKind::Triple))
        ),
        format!(
            "Where two or three effects were hidden and some were named, the hidden ones themselves fitted the readings better by more \
             than {MOST_BEHIND} in chi-square in {}.",
            in_words(overlooked(records))
        ),
        format!(
            "Something outside the catalogue at {WELL_VISIBLE} or more was noticed as such in {}.",
            in_words(right(CaseKind::Outside))
        ),
        format!(
            "The springs were called adequate although effects at {WELL_VISIBLE} or more were hidden in {}.",
            in_words(Proportion::count(visible(), |r| r.fate == Fate::Missed))
        ),
        format!(
            "Credible sets (which claim {} %) hold the whole truth in {}, where it is well visible in {}.",
            hundredths(CREDIBLE),
            in_words(credible_coverage(records)),
            in_words(credible_coverage(records.iter().filter(|r| is_well_visible(r))))
        ),
        format!(
            "Where the answer is right, {} leg stiffnesses lie within 1.96 of their stated standard deviations.",
            in_words(stiffness_coverage(right_answers().filter(|r| !r.is_outside())))
        ),
        format!(
            "Where something outside the catalogue was rightly noticed, {} do, and {} held-out numbers lie within 1.96 standard \
             deviations of prediction and noise.",
            in_words(stiffness_coverage(right_answers().filter(|r| r.is_outside()))),
            in_words(prediction_coverage(right_answers().filter(|r| r.is_outside())))
        ),
    ]
}

fn introduction(study: &Calibration) -> Section {
    let [low, high] = DISTANCES;
    let counts: Vec<String> =
        study.protocol.portions.iter().map(|p| format!("{} {}", p.trials, p.kind.name())).collect();
    Section::lead()
        .paragraph(written_by("hexbench validate calibration --markdown FILE"))
        .paragraph(format!(
            "{} simulated campaigns with a known truth went through the diagnosis (seed {}; {} gave no answer): {}.",
            study.protocol.trials(),
            study.protocol.seed,
            study.failures.len(),
            counts.join(", "),
        ))
        .list([
            "Machines: seven families, from the rings of the paper to irregular ones. Plans: the rich plan with tilts and lateral \
             loads in 60 %, else other loads, few poses, vertical loads only or no reference load; the plan of the paper (kind \
             seed-protocol); absolute poses."
                .to_owned(),
            format!(
                "Size: the *distance* of an effect is the length of its signature in standard deviations of the noise, after six \
                 springs have explained what they can: the square root of the noncentrality of a chi-square test. Each effect is \
                 scaled to a distance drawn log-uniformly from {low} to {high}; a campaign in which no sensible size reaches it is \
                 drawn again with another machine and plan. Effects of absolute campaigns have their usual size."
            ),
            "Kinds: single (one effect of the catalogue), pair (two), triple (three), outside (one the catalogue lacks), clean (none), \
             seed-protocol (one, under the plan of the paper), absolute (joint geometry, alone or with one more), rich-form (a \
             base or plate that yields as a full 6x6 compliance; the right answer is its name)."
                .to_owned(),
            "Bounds of shares are exact binomial 95 % bounds (Clopper and Pearson).".to_owned(),
        ])
}

/// Stated probabilities from which bins are listed.
const NEARLY_SURE: f64 = 0.9;

const FATES: &str = "Right: exactly the truth is said. Honest: ambiguous, with the whole truth among what is kept. \
Undecided: ambiguous without that, or although nothing or something outside is hidden. Missed: the springs are called \
adequate, as they must be where an effect is too small to see. Incomplete: only true effects are named, but not all. False \
outside, false name: something is claimed that is not so.";

const COVERAGE: &str = "A credible set is the smallest set of effects that holds 95 % of the probability; `none` and \
`outside` may be in it. It holds the truth when every hidden effect (or `none`, or `outside`) is in it or named. An \
effect too small to see leaves the set `none`: that is why sets hold the truth less often where effects of all sizes \
are counted.";

const NUMBERS: &str = "Held-out chi-square is per number, 1 is noise. Stiffnesses are compared with the true ones in \
their own stated standard deviations; answers \"outside\" come with a model that is known to lack something.";

const INTERVALS: &str = "Stiffnesses are compared with the true ones, predictions of the final model with held-out readings. \
What the model leaves of the legs beyond the noise is part of both uncertainties.";

const MISTAKES: &str = "Answers that state something false, in groups, the largest first; with the highest probability \
that was stated for such an answer. Any trial can be written out as files with `--case`.";

fn confusion_words() -> String {
    format!(
        "Kinds single, rich-form, outside and clean; effects at distance {WELL_VISIBLE} or more. Rows sum to 100 %; a \
         blank cell is below half a percent. Names that begin with `out:` are effects the catalogue lacks."
    )
}

const RELIABILITY: &str = "Of all claims stated with about the same probability, how many came true. Exactly what is named: the \
verdict \"named\", with the probability of exactly this set of effects. Any verdict: the same, or nothing hidden, or something outside. \
First candidate: the best first addition, where that is an effect. Presence: every effect the file can test, alone or with others. Beside \
\"outside\", presence says what helps to fit an unknown effect, not what is at work: do not read it as such.";

const MIX: &str = "The shares depend on the mix of truths. Counted once each (\"as drawn\"), few campaigns are clean and many effects are \
too small to see, so that \"nothing hidden\" must come true less often than stated. The second line and the lower half of the table weigh \
the trials to the shares the diagnosis itself expects before any data (\"as expected\": none 45 %, one 38 %, two 13 %, outside 4 %); the \
sizes stay as drawn. Calibration error: mean distance of stated from observed over the bins. Scores: 0 is perfect.";

const POWER: &str = "Share of the trials of kind single in which exactly the hidden effect is named, and in which the answer is that or \
honestly ambiguous. The rest below the dashed line says \"adequate\" or is undecided; only what lies above the dashed line is a false \
statement.";

const OUTSIDE: &str = "Share of the trials of kind outside in which \"outside\" is said. An answer that names effects of the catalogue \
instead is above the dashed line; between the lines the springs are called adequate.";

fn reliability(records: &[CalibrationRecord], charts: &str, section: Section) -> Section {
    section
        .paragraph(MIX)
        .table(sheets::all_scores(records))
        .paragraph("Where 90 % or more was stated, every trial counted once:")
        .table(sheets::reliability(records, NEARLY_SURE))
        .figure(format!("{charts}/reliability-by-kind.svg"), "Presence of an effect by kind")
        .table(sheets::scores_by_kind(records))
}

fn power(records: &[CalibrationRecord], section: Section) -> Section {
    let right = |kind| sheets::right_by_size(&Curve::of_each(records, kind));
    section
        .paragraph("Percent right by distance:")
        .table(right(CaseKind::Single))
        .paragraph("Under the plan of the paper (kind seed-protocol), percent right:")
        .table(right(CaseKind::SeedProtocol))
}

fn outside(records: &[CalibrationRecord], section: Section) -> Section {
    let table = sheets::right_by_size(&Curve::of_each(records, CaseKind::Outside));
    section.paragraph("Percent right by distance:").table(table)
}

fn again(study: &Calibration) -> Section {
    let (seed, trials) = (study.protocol.seed, study.protocol.trials());
    Section::new("Again")
        .with(Block::code(format!(
            "hexbench validate calibration --seed {seed} --trials {trials} -o DIR --markdown docs/results/calibration.md\n\
             hexbench validate calibration --seed {seed} --case pair-0007 -o DIR"
        )))
        .paragraph(
            "The first writes every trial (`trials.csv`), the tables, the charts and this page; the second writes one campaign as \
             files for `hexbench diagnose`. The same seed gives the same bytes on any number of threads.",
        )
}
