//! The study as a page.

use hexbench_core::statistics::Proportion;
use hexbench_report::number::hundredths;
use hexbench_report::words::written_by;
use hexbench_report::{Page, Section};
use hexbench_truth::laboratory;

use super::{DISTANCE, Robustness, RobustnessProtocol, RobustnessRecord, Violation, sheets};
use crate::calibration::MOST_FALSE_NAMES;
use crate::pages::{again, chosen, extremes, tabled};
use crate::shares::in_words;

/// The page.
pub fn page(study: &Robustness) -> Page {
    let records = &study.records;
    Page::new("What faults of the laboratory do to the diagnosis")
        .with(introduction(study).detail())
        .with(Section::new("In short").list(headlines(records)))
        .with(tabled("Fault by fault", FAULTS, sheets::violations(records)))
        .with(tabled("Findings", FINDINGS, sheets::findings(records)))
        .with(tabled("Counts and bounds", COUNTS, sheets::counts(records)).detail())
        .with(tabled("Verdicts", VERDICTS, sheets::verdicts(records)).detail())
        .with(tabled("Where it goes wrong", MISTAKES, sheets::mistakes_table(records)))
        .with(study.unanswered())
        .with(commands(study).detail())
}

/// The figures everything else explains, one sentence each.
pub fn headlines(records: &[RobustnessRecord]) -> Vec<String> {
    let is_control = |r: &&RobustnessRecord| r.fault == laboratory::CAREFUL.id;
    let faulty = || records.iter().filter(|r| !is_control(r));
    let named = |r: &&RobustnessRecord| r.names_falsely();
    let right = |r: &&RobustnessRecord| r.is_right();
    vec![
        format!(
            "With a fault, clean machines are called clean in {}, hidden effects are named first in {}; without one in {} and {}.",
            in_words(Proportion::count(faulty().filter(|r| r.is_clean()), right)),
            in_words(Proportion::count(faulty().filter(|r| !r.is_clean()), right)),
            in_words(Proportion::count(records.iter().filter(is_control).filter(|r| r.is_clean()), right)),
            in_words(Proportion::count(records.iter().filter(is_control).filter(|r| !r.is_clean()), right)),
        ),
        format!(
            "With a fault, an effect that is not there is named in {} (limit of calibration: {} %); without one in {}.",
            in_words(Proportion::count(faulty(), named)),
            hundredths(MOST_FALSE_NAMES),
            in_words(Proportion::count(records.iter().filter(is_control), named)),
        ),
        weakest(records, "Clean machines are most often not called clean under", Violation::clean_right),
        weakest(records, "Hidden effects are most often not named first under", Violation::effect_right),
        weakest(records, "Stiffness intervals hold the truth least often under", Violation::stiffness),
    ]
}

/// The three faults under which a share is lowest.
fn weakest<'a>(
    records: &'a [RobustnessRecord],
    words: &str,
    share: fn(&Violation<'a>) -> Proportion,
) -> String {
    const LISTED: usize = 3;
    let all = Violation::of_each(records);
    let shares = all.iter().map(|v| (v.fault.title.to_owned(), share(v))).filter(|(_, p)| p.of > 0);
    let listed: Vec<String> = extremes(shares.collect(), false, LISTED).collect();
    format!("{words}: {}.", listed.join("; "))
}

fn introduction(study: &Robustness) -> Section {
    let faults = study.protocol.faults.iter().filter(|id| **id != laboratory::CAREFUL.id).count();
    Section::lead()
        .paragraph(written_by("hexbench validate robustness --markdown FILE"))
        .paragraph(format!(
            "Calibration keeps to the assumptions of the diagnosis: joints, loads and poses exactly as written, independent Gaussian \
             noise of exactly the stated size. Laboratories do not. {} simulated campaigns, half of them on clean machines and half with \
             one effect of the catalogue at distance {DISTANCE}, went through the diagnosis as a careful laboratory measures them and \
             with each of {faults} faults (seed {}; {} of {} gave no answer). Machine, plan, effect and noise of a campaign are the same \
             under every fault.",
            study.protocol.trials,
            study.protocol.seed,
            study.failures.len(),
            study.records.len() + study.failures.len(),
        ))
        .list([
            "Machines and plans are drawn as for the calibration: seven families; the rich plan in 60 %, else other loads, few poses, \
             vertical loads only or no reference load. Effects go through the catalogue in turn.",
            "Faults of noise, geometry, loads and temperature are in the measurements to learn from and in the held-out ones; single \
             wrong numbers, rows, poses and loads in the former only.",
            "Bounds of shares are exact binomial 95 % bounds (Clopper and Pearson). The six stiffnesses of a campaign are counted as if \
             they were independent.",
        ])
}

const FAULTS: &str = "Percent. Clean right: a machine without effects is called adequate, or only its data are blamed (verdict \
measurement). Effect right: the hidden effect is the first one named, whatever is found beside it. Named falsely: any effect is named, \
for sure or among others, that is not there. Outside: physics that no catalogue knows is claimed; there is none. Fault told: a finding \
calls the fault by its name; a dash where the format has no word for it. Other told: a finding speaks of a fault that is not there. \
Stiffness: intervals that hold the true stiffness, without the answers \"outside\". Where the temperature acts and is not recorded, \
a hidden thermal expansion cannot be named.";

const FINDINGS: &str = "Found: in the campaigns whose fault is best called so. False alarms: in the campaigns, with another fault or with \
none, that must not be called so.";

const COUNTS: &str = "The same shares as counts with bounds; stiffness intervals of all answers, those \"outside\" among them; median of the \
held-out chi-square per number of the final model, in the stated noise.";

const VERDICTS: &str = "Answers on clean machines / on machines with one effect.";

const MISTAKES: &str = "Answers that are wrong about the machine, in groups, the largest first. An open answer that keeps the hidden effect \
is honest and not listed. A trial is written out as files with `--case FAULT/clean-NUMBER` or `--case FAULT/single-NUMBER`.";

fn commands(study: &Robustness) -> Section {
    let (seed, trials) = (study.protocol.seed, study.protocol.trials);
    let chosen = chosen("fault", &study.protocol.faults, &RobustnessProtocol::default().faults);
    again(format!(
        "hexbench validate robustness --seed {seed} --trials {trials}{chosen} -o DIR --markdown docs/results/robustness.md\n\
         hexbench validate robustness --seed {seed} --case outlier-20/clean-0003 -o DIR"
    ))
}
