//! The study as a page.

use std::collections::BTreeSet;

use hexbench_core::statistics::Proportion;
use hexbench_report::words::written_by;
use hexbench_report::{Block, Page, Section};

use super::protocol::{DISTANCES, DiscoveryProtocol};
use super::{DiscoveryRecord, LawFate, fate, sheets};
use crate::harness::Study;
use crate::pages::tabled;
use crate::shares::in_words;

/// All trials of a protocol.
pub type DiscoveryTrials = Study<DiscoveryProtocol>;

/// The page.
pub fn page(study: &DiscoveryTrials) -> Page {
    let records = &study.records;
    Page::new("Laws that no catalogue lists: found, and only where there are any")
        .with(introduction(study).detail())
        .with(Section::new("In short").list(headlines(records)))
        .with(tabled("What was hidden, what was found", FATES, sheets::fates(records)))
        .with(tabled("By distance", DISTANCE, sheets::distances(records)))
        .with(tabled("Stated probability and what came true", STATED, sheets::stated(records)))
        .with(study.unanswered())
        .with(again(study).detail())
}

/// The figures everything else explains, one sentence each.
pub fn headlines(records: &[DiscoveryRecord]) -> Vec<String> {
    let of = |what: fn(&DiscoveryRecord) -> bool| records.iter().filter(move |r| what(r));
    let is_clean = |r: &DiscoveryRecord| r.hidden.is_empty();
    let is_listed = |r: &DiscoveryRecord| !r.hidden.is_empty() && r.outside().is_none();
    let is_unsayable = |r: &DiscoveryRecord| r.outside().is_some() && !r.is_sayable();
    let good = |r: &&DiscoveryRecord| matches!(r.fate(), LawFate::Right | LawFate::Equivalent);
    vec![
        format!(
            "Where a law of the grammar is hidden, it or one that predicts alike is found in {}; a wrong one in {}, {} of them with the \
             formula of the hidden effect.",
            in_words(Proportion::count(of(DiscoveryRecord::is_sayable), good)),
            in_words(Proportion::count(of(DiscoveryRecord::is_sayable), |r| r.fate() == LawFate::Wrong)),
            of(DiscoveryRecord::is_right_and_uncertain).count(),
        ),
        format!(
            "Where what is hidden is no law of the grammar, one that predicts alike is found in {}, a wrong one in {}.",
            in_words(Proportion::count(of(is_unsayable), good)),
            in_words(Proportion::count(of(is_unsayable), |r| r.fate() == LawFate::Wrong)),
        ),
        format!(
            "On clean machines a law is invented in {}.",
            in_words(Proportion::count(of(is_clean), |r| r.found))
        ),
        format!(
            "Where the catalogue has the hidden effect, a law is named in its place in {}.",
            in_words(Proportion::count(of(is_listed), |r| r.found))
        ),
    ]
}

fn introduction(study: &DiscoveryTrials) -> Section {
    let p = &study.protocol;
    let hidden: BTreeSet<&str> = study.records.iter().filter_map(DiscoveryRecord::outside).collect();
    Section::lead().paragraph(written_by("hexbench validate discover --markdown FILE")).paragraph(format!(
        "{} campaigns with an effect outside the catalogue, {} with one of the catalogue and {} on clean machines went through \
         `hexbench discover` with their held-out poses (seed {}, distances {} to {}; {} gave no answer). Machines, plans and effects are \
         those of the calibration, made by the simulated world, which knows nothing of the grammar: {} of its {} effects outside the \
         catalogue that are drawn are products of building blocks.",
        p.outside,
        p.listed,
        p.clean,
        p.seed,
        DISTANCES[0],
        DISTANCES[1],
        study.failures.len(),
        fate::sayable(),
        hidden.len(),
    ))
}

const FATES: &str = "Right: the law found, or one it says it cannot be told from, is that of the hidden effect, and the final model \
foresees held-out readings: what it leaves of them, as they would be without noise, is at most a third of the noise of a reading, which \
raises the error of readings by a twentieth. Equivalent: another formula that foresees them. Wrong: a law that does not. Nothing: no law \
and no effect is named. Catalogue: no law; effects of the catalogue are. Invented: a law where nothing outside the catalogue is hidden.";

const DISTANCE: &str = "Effects that a law of the grammar describes. Distance: how many standard deviations of all readings together the effect \
stands beyond what the springs absorb.";

const STATED: &str = "The probability that some law is at work, before held-out poses are asked.";

fn again(study: &DiscoveryTrials) -> Section {
    let p = &study.protocol;
    Section::new("Again")
        .with(Block::code(format!(
            "hexbench validate discover --seed {} --outside {} --listed {} --clean {} -o DIR --markdown docs/results/discover.md",
            p.seed, p.outside, p.listed, p.clean
        )))
        .paragraph("The same seed gives the same bytes on any number of threads.")
}
