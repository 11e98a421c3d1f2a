//! The study as a page.

use hexbench_core::statistics::Proportion;
use hexbench_report::words::written_by;
use hexbench_report::{Page, Section, Table};

use super::false_alarms::blamed;
use super::{Misread, MisreadFate, MisreadGroup, MisreadProtocol, MisreadRecord, sheets};
use crate::pages::{again, chosen, extremes, tabled};
use crate::shares::in_words;

/// The page.
pub fn page(study: &Misread) -> Page {
    let records = &study.records;
    let by = |title: &'static str, word: fn(&MisreadRecord) -> &str| {
        sheets::groups(title, &MisreadGroup::of_each(records, word))
    };
    Page::new("How a file that does not say what is meant is found")
        .with(introduction(study).detail())
        .with(Section::new("In short").list(headlines(records)))
        .with(tabled("Misstatement by misstatement", MISSTATEMENTS, sheets::misstatements(records)))
        .with(
            tabled("Machines, plans and effects", GROUPS, by("family", |r| &r.campaign.family))
                .table(by("plan", |r| &r.campaign.plan))
                .table(by("machine", |r| &r.campaign.kind)),
        )
        .with(tabled("False alarms", ALARMS, sheets::false_alarms(records)))
        .with_all(unless_empty("False alarms one by one", ONE_BY_ONE, sheets::alarms(records)))
        .with_all(unless_empty("Refused", REFUSED, sheets::refusals(records)))
        .with(study.unanswered())
        .with(commands(study).detail())
}

/// None without rows.
fn unless_empty(title: &str, words: &str, table: Table) -> Option<Section> {
    (!table.rows.is_empty()).then(|| tabled(title, words, table).detail())
}

/// The figures everything else explains, one sentence each.
pub fn headlines(records: &[MisreadRecord]) -> Vec<String> {
    let all = MisreadGroup::of_all(records);
    let share = |fate| in_words(all.share(fate));
    let shown = all.shown_by_the_data();
    let each_shown: Vec<MisreadGroup<'_>> =
        MisreadGroup::of_each_misstatement(records).iter().map(MisreadGroup::shown_by_the_data).collect();
    vec![
        format!("A misstatement matters in {}; elsewhere no data can show it.", in_words(all.matters())),
        format!(
            "Where it matters, a right cause is named first in {}, among others in {}; only wrong causes in {}.",
            share(MisreadFate::Named),
            share(MisreadFate::AmongOthers),
            share(MisreadFate::WrongCause),
        ),
        format!(
            "Noticed without a cause: {}; refused: {}; silent: {}.",
            share(MisreadFate::Noticed),
            share(MisreadFate::Refused),
            share(MisreadFate::Silent),
        ),
        format!(
            "The answer is wrong and looks right in {}: as written, the file is that of another sound machine, and no data can show it. \
             These are {}.",
            in_words(all.looks_right()),
            listed(MisreadGroup::of_each_misstatement(records).iter().map(|g| (g, g.looks_right())))
        ),
        format!(
            "Where the data can show it, a right cause is named first in {}, and {} stay silent ({}).",
            in_words(shown.share(MisreadFate::Named)),
            in_words(shown.share(MisreadFate::Silent)),
            listed(each_shown.iter().map(|g| (g, g.share(MisreadFate::Silent)))),
        ),
        format!("Files of sound campaigns are blamed in {}.", in_words(blamed(records, |_| true))),
        listed_extremes(records, "Least often named first", MisreadFate::Named, false),
        listed_extremes(records, "Most often called by a wrong cause", MisreadFate::WrongCause, true),
        listed_extremes(records, "Most often silent", MisreadFate::Silent, true),
    ]
}

/// `loads-kgf-as-n 7, pose-angles-yxz 6`: groups that have any.
fn listed<'a>(groups: impl Iterator<Item = (&'a MisreadGroup<'a>, Proportion)>) -> String {
    let any = groups.filter(|(_, share)| share.hits > 0);
    let words: Vec<String> = any.map(|(group, share)| format!("{} {}", group.name, share.hits)).collect();
    if words.is_empty() { "none".to_owned() } else { words.join(", ") }
}

/// The five misstatements in which a fate is most or least frequent.
fn listed_extremes(records: &[MisreadRecord], words: &str, fate: MisreadFate, most: bool) -> String {
    const LISTED: usize = 5;
    let all = MisreadGroup::of_each_misstatement(records);
    let shares = all.into_iter().map(|group| (group.name.clone(), group.share(fate)));
    let any = shares.filter(|(_, share)| share.of > 0 && (share.hits > 0 || !most));
    let listed: Vec<String> = extremes(any.collect(), most, LISTED).collect();
    format!("{words}: {}.", if listed.is_empty() { "none".to_owned() } else { listed.join(", ") })
}

fn introduction(study: &Misread) -> Section {
    let MisreadProtocol { seed, trials, sound, misstatements, scenes } = &study.protocol;
    Section::lead()
        .paragraph(written_by("hexbench validate misread --markdown FILE"))
        .paragraph(LIMITS)
        .paragraph(format!(
            "Files were written wrongly in {} ways as users do it, {trials} campaigns each, read again as any file is, and diagnosed; \
             beside them {sound} sound campaigns{} (seed {seed}; {} of {} could not be made).",
            misstatements.len(),
            if scenes.is_empty() { String::new() } else { format!(", some of them in {} scenes", scenes.len()) },
            study.failures.len(),
            study.records.len() + study.failures.len(),
        ))
        .list([
            "Machines and plans are drawn as for the calibration; the misread campaigns go through the seven families in turn, clean and \
             with one effect of the catalogue at its usual size (distance 22), or, of absolute poses, with joints out of place, alone or with an \
             effect more. However it is written, the same number is the same campaign.",
            "Sound campaigns are of all kinds of the calibration: clean, one effect, two, one outside the catalogue, richer forms, the plan \
             of the paper, absolute poses, and in the bundled scenes with another seed; effects at the usual size, at 3 and at 10 times, or as large as machine and plan allow.",
            "A mass that nobody counted (out:load-mass-error) is a load left out of the file: `reference-missing` is true of it, and no false alarm.",
            "A misstatement matters when six springs fitted to the files as written differ from those fitted to the files as meant: \
             chi-square per degree of freedom, in the fit or held out, by more than 20 %; a stiffness by more than 5 of its standard \
             deviations and 2 %; a standard deviation of one by more than 20 %; when readings repeat others to the last digit; or when \
             nothing can be fitted.",
            "Bounds of shares are exact binomial 95 % bounds (Clopper and Pearson).",
        ])
}

const LIMITS: &str = "Limits: simulated readings with a stated noise and one misstatement at a time, of the size that users make it; most \
misstatements are of deflections, and no file states a nominal stiffness.";

const MISSTATEMENTS: &str = "Counts, then percent of the campaigns in which the misstatement matters. Right words: those of \
`findings[].kind` that are right, several where readings cannot tell them apart, and effects of the catalogue that say the same. Looks \
right: it matters, but neither the misfit of the springs nor a sign nor a copy shows it. Named: the first finding about the whole file is \
right, or the message that refuses the files names it. Noticed: the verdict is measurement, outside, ambiguous or undecided, without a \
cause. Refused: a message instead of an answer. Silent: the springs are called adequate or effects are named without a word about the \
file. Most often: the first finding about the file, else the verdict.";

const GROUPS: &str = "The same figures over all misstatements.";

const ALARMS: &str =
    "Sound campaigns with a finding about the whole file, by kind and by the size of the effects.";

const ONE_BY_ONE: &str = "Any of them is written as files with `--case`.";

const REFUSED: &str = "Files that are not read, or from which nothing can be computed.";

fn commands(study: &Misread) -> Section {
    let MisreadProtocol { seed, trials, sound, misstatements, scenes } = &study.protocol;
    let chosen = chosen("misstatement", misstatements, &MisreadProtocol::default().misstatements);
    let scenes = if scenes.is_empty() { "" } else { " --scenes scenes/*/" };
    again(format!(
        "hexbench validate misread --seed {seed} --trials {trials} --sound {sound}{chosen}{scenes} -o DIR --markdown docs/results/misread.md\n\
         hexbench validate misread --seed {seed} --case fz-negated/ring_a-clean-0000 -o DIR"
    ))
}
