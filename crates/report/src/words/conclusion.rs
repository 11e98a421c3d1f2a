//! The verdict in a sentence or two.

use hexbench_core::words::{joined, joined_with, lower_first};
use hexbench_model::effects::term::Rich;
use hexbench_model::estimation::estimate::Estimate;
use hexbench_model::inference::examination::FindingKind;
use hexbench_model::inference::explanation::Explanation;
use hexbench_model::inference::gain::{GainOutcome, WORTH_NAMING};
use hexbench_model::inference::selection::HeldOut;
use hexbench_model::inference::verdict::{DOUBT, NAMED, Verdict};
use hexbench_model::results::diagnose::{Diagnosis, OtherReading, OutsideReport, StepReport};
use hexbench_model::results::discover::{HeldOutFall, LawReport};
use hexbench_model::terms::catalogue;

use super::findings::undoes_what_was_asked;
use crate::number::{hundredths, multiple, percent};
use crate::page::{Block, Mood, Section};

/// A leg whose size is so many times that of the next one has most of an effect.
const MOST_OF_IT: f64 = 3.0;

/// Share of the held-out error above the noise that a law takes off at least, if it is reported.
const LEAST_FALL: f64 = 0.1;

/// Smallest share of the held-out error that is not shown as zero.
const LEAST_SHARE: f64 = 0.0005;

/// Least probability of an explanation named in a sentence.
const LEAST_LIKELY: f64 = 0.01;

/// Most explanations named in a sentence; the table of probabilities has them all.
const MOST_OPEN: usize = 5;

/// The verdict.
pub fn section(d: &Diagnosis) -> Section {
    let mood = match d.verdict {
        Verdict::Adequate | Verdict::Named => Mood::Good,
        Verdict::Ambiguous | Verdict::Measurement | Verdict::Undecided => Mood::Doubt,
        Verdict::Outside => Mood::Bad,
    };
    Section::new("Verdict").with(Block::Verdict {
        word: d.verdict.word().to_uppercase(),
        mood,
        sentences: sentences(d),
    })
}

/// The verdict in a sentence or two.
pub fn sentences(d: &Diagnosis) -> Vec<String> {
    let mut all = verdict(d);
    all.extend(withdrawn(d));
    all.extend(left_by_springs(d));
    all.extend(shares(d));
    all.extend(d.steps.iter().filter_map(|step| held_out_remark(d, step)));
    all.extend(d.outside.as_ref().filter(|_| d.verdict != Verdict::Outside).map(small_outside));
    all
}

fn small_outside(outside: &OutsideReport) -> String {
    format!(
        "An effect outside the catalogue is certain, but accounts for less than {} % of the error: {}.",
        hundredths(WORTH_NAMING),
        outside.text
    )
}

/// The verdict itself.
fn verdict(d: &Diagnosis) -> Vec<String> {
    match d.verdict {
        Verdict::Adequate if d.outside.is_some() => {
            vec!["The springs alone are sufficient: what is missing is too small to matter.".to_owned()]
        }
        Verdict::Adequate if !d.small.is_empty() => {
            vec!["The springs alone are sufficient: no effect is large enough to be named.".to_owned()]
        }
        Verdict::Adequate => vec![
            "The springs alone explain these measurements: these data show no missing effect. Effects that these \
             data could not show are listed below."
                .to_owned(),
        ],
        Verdict::Undecided => vec![
            "These data are not enough to judge the machine: there are too few readings, the noise is known only \
             from the residuals, or no effect of its usual size would show. Take repeats, more poses and loads, or \
             state the noise in [metrology]."
                .to_owned(),
        ],
        Verdict::Named => {
            [lacks(&d.added)].into_iter().chain(richer_forms(d)).chain([error_statement(&d.steps, d.added.len())]).collect()
        }
        Verdict::Ambiguous => ambiguous(d),
        Verdict::Outside => outside(d),
        Verdict::Measurement if d.findings.iter().any(|f| f.kind == FindingKind::Inconsistent) => vec![
            "The readings contradict each other, as stated above. Until these lines are corrected, there is no \
             conclusion about the machine: no effect is compared and no stiffness is reported."
                .to_owned(),
        ],
        Verdict::Measurement if undoes_what_was_asked(d) => vec![
            "Read as requested, the files do not mean what they say. Until they are read as they are written, there is no \
             conclusion about the machine: no effect is compared and no stiffness is reported."
                .to_owned(),
        ],
        Verdict::Measurement if d.other_reading.is_some() => d.other_reading.iter().flat_map(read_so).collect(),
        Verdict::Measurement if d.is_misread() => vec![
            "The files do not seem to mean what they say, as stated above. Until they are corrected, or read \
             differently with --read-as, there is no conclusion about the machine: no effect is compared and no \
             stiffness is reported."
                .to_owned(),
        ],
        Verdict::Measurement if d.keep_all => vec![
            "The fault is in the data, as reported above. Even with all readings kept, the springs alone explain \
             these measurements: they show no missing effect."
                .to_owned(),
        ],
        Verdict::Measurement => vec![
            "The fault is in the data, as reported above. Without it, the springs alone explain these \
             measurements: they show no missing effect."
                .to_owned(),
        ],
    }
}

/// What misread files say of the machine, read as they seem to be meant.
fn read_so(other: &OtherReading) -> [String; 2] {
    let said = match other.verdict {
        Verdict::Named => {
            let lacks = lower_first(lacks(&other.added).trim_end_matches('.'));
            let falls = other.times_noise.map(|[before, after]| {
                let [before, after] = [before, after].map(multiple);
                format!("; the error on held-out poses falls from {before} to {after} times the noise")
            });
            format!("{lacks}{}", falls.unwrap_or_default())
        }
        Verdict::Adequate | Verdict::Measurement => "the springs alone explain these measurements".to_owned(),
        Verdict::Ambiguous => "several effects may be missing".to_owned(),
        Verdict::Outside => {
            "something is missing that none of the effects in the catalogue explains".to_owned()
        }
        Verdict::Undecided => "these data are not enough to judge the machine".to_owned(),
    };
    [
        "The files do not seem to mean what they say, as stated above. Until they are corrected, or read differently \
         with --read-as, nothing is certain about the machine and no stiffness is reported."
            .to_owned(),
        format!("Read with the first correction above ({}), {said}.", other.read_as.join(", ")),
    ]
}

/// Readings fitted that ask for something outside the catalogue, of which held-out poses show nothing.
fn withdrawn(d: &Diagnosis) -> Option<String> {
    let is_asked_for = d.candidates.iter().any(|c| c.term == Explanation::Outside && c.probability > DOUBT);
    let text = "The residuals of the fitted readings exceed the noise, and nothing in the catalogue explains them; \
                held-out poses do not confirm this, so no conclusion is drawn.";
    let is_open = matches!(d.verdict, Verdict::Adequate | Verdict::Ambiguous) && d.outside.is_none();
    (is_asked_for && is_open).then(|| text.to_owned())
}

/// How far from the noise springs that are good enough are, with the chance of an error like theirs.
fn left_by_springs(d: &Diagnosis) -> Option<String> {
    let step = d.steps.first().filter(|_| d.verdict == Verdict::Adequate && d.small.is_empty())?;
    let left = multiple(step.holdout?.times_noise());
    // Nothing was added to them that could still leave something.
    let rest = if step.is_at_the_noise() {
        beside_the_noise(step)
    } else {
        let check = match d.holdout {
            HeldOut::File => "compare the noise and the loads of both files",
            HeldOut::PosesInTurn => "check the noise stated",
        };
        format!(", somewhat above it{}; no effect explains the rest: {check}", chance(step))
    };
    Some(format!("The error of the springs on held-out poses is {left} times the noise{rest}."))
}

/// What each of several effects is worth.
fn shares(d: &Diagnosis) -> Option<String> {
    let worth = |id: &String| d.steps.iter().find(|s| s.terms.last() == Some(id))?.worth;
    let all: Vec<(&String, f64)> =
        d.added.iter().filter_map(|id| worth(id).map(|worth| (id, worth.share))).collect();
    let takes_off = |share: f64| share >= LEAST_SHARE;
    let said = |(id, share): &(&String, f64)| {
        if takes_off(*share) { format!("{id} {} %", hundredths(*share)) } else { format!("{id} not at all") }
    };
    let they = if all.iter().all(|(_, share)| takes_off(*share)) { "each reduces" } else { "they reduce" };
    let text = || {
        let said: Vec<String> = all.iter().map(said).collect();
        format!("Added in this order, {they} the remaining held-out error: {}.", said.join(", "))
    };
    (all.len() > 1 && d.verdict == Verdict::Named).then(text)
}

/// What held-out poses say of the effect of a step, where that is less than the readings fitted say.
fn held_out_remark(d: &Diagnosis, step: &StepReport) -> Option<String> {
    let id = step.terms.last()?;
    if d.small.contains(id) {
        let share = hundredths(step.worth?.share.max(0.0));
        return Some(format!(
            "{id} is certain, but reduces the error on held-out poses by only {share} %: it stays in the model and \
             is not named."
        ));
    }
    let gain = step.gain?;
    if d.added.contains(id) {
        let rests =
            format!("Held-out poses do not confirm {id} significantly: it rests on the fitted readings.");
        return (gain.outcome == GainOutcome::Open).then_some(rests);
    }
    let is_sure = d.present.get(id).is_some_and(|p| *p >= NAMED) && d.verdict == Verdict::Ambiguous;
    let unnamed = format!(
        "The fitted readings favor {id}, but it does not improve the prediction of held-out poses: it is not named."
    );
    (is_sure && gain.nats <= 0.0).then_some(unnamed)
}

/// `The model lacks one effect: the foundation yields (base-compliance).`
pub fn lacks(ids: &[String]) -> String {
    let names: Vec<String> = ids.iter().map(|id| described(id)).collect();
    match ids.len() {
        1 => format!("The model lacks one effect: {}.", names[0]),
        n => format!("The model lacks {n} effects: {}.", joined(&names)),
    }
}

/// What is special about effects named that need their richer form.
fn richer_forms(d: &Diagnosis) -> impl Iterator<Item = String> {
    let form = |id: &String| catalogue().iter().find(|t| t.info().id == id).map(|t| t.info().rich);
    d.added.iter().filter(|id| d.richer.contains(id)).filter_map(move |id| match form(id)? {
        Rich::PerLeg => {
            Some(format!("The size of {id} differs from leg to leg{}.", leg_that_has_most(&d.parameters, id)))
        }
        Rich::Full => Some(format!("Six springs do not describe {id} here: it is a full 6x6 compliance.")),
        Rich::None => None,
    })
}

/// `: leg 3 has most of it`, where that is plain to see.
fn leg_that_has_most(parameters: &[Estimate], id: &str) -> String {
    let of_leg = |p: &Estimate| {
        let (leg, _) = p.name.strip_prefix(id)?.strip_prefix(".leg-")?.split_once('.')?;
        Some((p.value.abs(), leg.to_owned()))
    };
    let mut sizes: Vec<(f64, String)> = parameters.iter().filter_map(of_leg).collect();
    sizes.sort_by(|a, b| b.0.total_cmp(&a.0));
    match sizes.as_slice() {
        [most, next, ..] if most.0 >= MOST_OF_IT * next.0 => format!(": leg {} has most of it", most.1),
        _ => String::new(),
    }
}

/// `the foundation yields (base-compliance)`.
pub fn described(id: &str) -> String {
    let terms = catalogue();
    let title = terms.iter().find(|t| t.info().id == id).map(|t| t.info().title);
    title.map_or_else(|| id.to_owned(), |title| format!("{} ({id})", lower_first(title)))
}

/// How the held-out error falls, in multiples of the noise, with all effects of the model; `named`: how many of them were named before.
pub fn error_statement(steps: &[StepReport], named: usize) -> String {
    let ends = || Some((steps.first()?.holdout?, steps.last()?, steps.last()?.holdout?));
    let Some((before, last, after)) = ends() else { return "No poses could be held out.".to_owned() };
    let them = match last.terms.len() {
        1 => "it".to_owned(),
        all if all == named => "them".to_owned(),
        _ => joined(&last.terms),
    };
    if after.times_noise() > (1.0 - WORTH_NAMING) * before.times_noise() {
        let (left, noise) = (multiple(after.times_noise()), beside_the_noise(last));
        return format!(
            "Adding {them} leaves the error on held-out poses at {left} times the noise{noise}. Without {them}, errors of joints and \
             loads would have to make up for it."
        );
    }
    format!(
        "Adding {them} brings the error on held-out poses from {} to {} times the noise{}.",
        multiple(before.times_noise()),
        multiple(after.times_noise()),
        beside_the_noise(last)
    )
}

/// `, which is at the level of the noise (chance 31 %)`, or `, above the noise (chance 1 %)`. Inputs within their tolerances may give more than the noise.
fn beside_the_noise(step: &StepReport) -> String {
    let place = match (step.is_at_the_noise(), step.error().is_at_the_noise()) {
        (true, true) => ", which is at the level of the noise",
        (true, false) => ", no more than noise and input tolerances can cause",
        (false, _) => ", still above the noise",
    };
    format!("{place}{}", chance(step))
}

/// ` (chance 31 %)`: of an error like this from noise alone.
fn chance(step: &StepReport) -> String {
    step.chance.map_or(String::new(), |p| format!(" (chance {})", percent(p)))
}

/// Of a model whose effects are all sure, and whose predictions fail.
const MORE_OR_NOISE: &str = "Something more is missing, or the noise of the held-out poses is larger than stated: these \
                             data do not determine which.";

fn ambiguous(d: &Diagnosis) -> Vec<String> {
    let open: Vec<&Explanation> =
        d.credible_set.iter().filter(|e| !d.added.iter().any(|id| e.is_term(id))).collect();
    let something = likely(d, open.iter().copied().filter(|e| **e != Explanation::Nothing));
    let sure = (!d.added.is_empty()).then(|| lacks(&d.added));
    let may_be_none = open.contains(&&Explanation::Nothing);
    let is_above_the_noise = d.steps.last().is_some_and(|step| !step.is_at_the_noise());
    let undecided = match (something.as_slice(), d.added.is_empty()) {
        ([], true) => "The data do not determine what is missing.".to_owned(),
        ([], false) if is_above_the_noise => MORE_OR_NOISE.to_owned(),
        ([], false) => "These data do not determine whether something more is missing.".to_owned(),
        ([one], true) if may_be_none => format!("These data cannot decide whether {one} is present."),
        ([one], true) => format!("The data point to {one}, but not with enough certainty to name it."),
        ([one], false) => format!("These data cannot decide whether {one} is present as well."),
        (_, true) if may_be_none => {
            format!(
                "These data cannot decide whether anything is missing: it may be {}, or nothing.",
                one_of(&something)
            )
        }
        (_, true) => format!("These data cannot decide what is missing: it may be {}.", one_of(&something)),
        (_, false) => format!("Beyond that it may be {}: these data cannot decide.", one_of(&something)),
    };
    let separated =
        (!d.next.is_empty()).then(|| "The next readings listed below are chosen to decide.".to_owned());
    sure.into_iter().chain([undecided]).chain(separated).collect()
}

/// Explanations with their probabilities, the most probable first, as far as the page tells more of them than that they are improbable.
fn likely<'a>(d: &Diagnosis, open: impl Iterator<Item = &'a Explanation>) -> Vec<String> {
    let probability = |e: &Explanation| match e.term() {
        Some(id) => d.present.get(id).copied().unwrap_or(0.0),
        None => d.candidates.iter().find(|c| c.term == *e).map_or(0.0, |c| c.probability),
    };
    let mut all: Vec<(&Explanation, f64)> = open.map(|e| (e, probability(e))).collect();
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let shown = all.iter().filter(|(_, p)| *p >= LEAST_LIKELY).count().max(1);
    all.truncate(shown);
    all.into_iter().map(|(e, p)| format!("{} ({})", in_words(e), percent(p))).collect()
}

/// `a, b or c`; of many, the first few and how many others.
fn one_of(all: &[String]) -> String {
    if all.len() <= MOST_OPEN {
        return joined_with(all, "or");
    }
    let shown = all.iter().take(MOST_OPEN - 1).cloned();
    let others = format!("one of {} others", all.len() - (MOST_OPEN - 1));
    joined_with(&shown.chain([others]).collect::<Vec<_>>(), "or")
}

/// A credible explanation in words.
pub fn in_words(explanation: &Explanation) -> &str {
    match explanation {
        Explanation::Nothing => "nothing beyond the springs",
        Explanation::Outside => "something outside the catalogue",
        Explanation::Term(id) => id,
    }
}

fn outside(d: &Diagnosis) -> Vec<String> {
    let mut all = vec!["Something is missing that none of the effects in the catalogue explains.".to_owned()];
    if !d.model.is_empty() {
        all.push(format!(
            "The fitted model also contains {}, which may only absorb part of what is missing; this does not \
             prove {} presence.",
            joined(&d.model),
            if d.model.len() == 1 { "its" } else { "their" }
        ));
    }
    all.push(telling_law(d).map_or_else(|| pattern(d), law));
    all
}

/// The law found, where it takes something off the error on held-out poses.
pub(super) fn telling_law(d: &Diagnosis) -> Option<&LawReport> {
    let takes_off = |held: &HeldOutFall| held.before - held.after >= LEAST_FALL * (held.before - 1.0);
    d.law.as_ref().filter(|law| law.held_out.as_ref().is_none_or(takes_off))
}

fn pattern(d: &Diagnosis) -> String {
    let text = d.outside.as_ref().map_or("no simple pattern describes it", |o| o.text.as_str());
    format!("What the measurements show: {text}.")
}

/// The law in words, how sure it is, and what it does to the error.
fn law(law: &LawReport) -> String {
    let fall = law.held_out.map_or_else(String::new, |held| {
        let [before, after] = [held.before, held.after].map(multiple);
        format!(" With it, the error on held-out poses falls from {before} to {after} times the noise.")
    });
    let (text, probability) = (&law.text, percent(law.probability));
    let alike = if law.alike.is_empty() { "" } else { " These readings cannot separate it from other laws." };
    let explains = if law.probability < 0.5 { "may explain" } else { "explains" };
    format!("A law outside the catalogue {explains} it (probability {probability}): {text}.{fall}{alike}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes(all: &[(&str, f64)]) -> Vec<Estimate> {
        let size = |&(name, value): &(&str, f64)| Estimate {
            name: name.to_owned(),
            value,
            std: 1.0,
            unit: String::new(),
        };
        all.iter().map(size).collect()
    }

    #[test]
    fn a_leg_is_named_only_if_it_stands_out_among_those_of_the_effect() {
        let [one, another] = ["creep.leg-1.fraction", "creep.leg-4.fraction"];
        for (all, said) in [
            (vec![(one, 2.0), (another, -6.5), ("leg-2.stiffness", 50.0)], ": leg 4 has most of it"),
            (vec![(one, 2.5), (another, -6.5)], ""),
            (vec![(another, 6.5), ("creep-2.leg-1.size", 1.0)], ""),
        ] {
            assert_eq!(leg_that_has_most(&sizes(&all), "creep"), said, "{all:?}");
        }
    }

    #[test]
    fn of_many_explanations_a_sentence_names_the_first_few() {
        let of = |names: &str| one_of(&names.chars().map(String::from).collect::<Vec<_>>());
        assert_eq!(of("abcde"), "a, b, c, d or e");
        assert_eq!(of("abcdefg"), "a, b, c, d or one of 3 others");
    }
}
