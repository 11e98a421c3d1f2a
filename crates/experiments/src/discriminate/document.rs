//! The study as a page.

use hexbench_report::words::written_by;
use hexbench_report::{Block, Page, Section};

use hexbench_core::statistics::{Proportion, mean};

use super::sheets::{asked, before, mean_readings, open, proposed, rounded, share};
use super::{DiscriminateRecord, Discrimination, READINGS};
use crate::trial::Outcome;

/// The page.
pub fn page(study: &Discrimination) -> Page {
    let again = format!(
        "hexbench validate discriminate --trials {} --seed {}",
        study.protocol.trials, study.protocol.seed
    );
    Page::new("Whether proposed readings tell effects apart")
        .with(introduction(study).detail())
        .with(Section::new("In short").list(headlines(study)))
        .with(Section::new("The confusing plans alone").paragraph(BEFORE).table(before(study)).detail())
        .with(
            Section::new("After the readings that the diagnosis proposes")
                .paragraph(PROPOSED)
                .table(proposed(study)),
        )
        .with(
            Section::new("After readings chosen for the pair")
                .paragraph(asked_words())
                .table(asked(study))
                .detail(),
        )
        .with(Section::new("Run it again").with(Block::code(again)).detail())
}

/// The figures everything else explains, one sentence each.
pub fn headlines(study: &Discrimination) -> Vec<String> {
    let records = study.records();
    let all = || records.iter();
    let open: Vec<&DiscriminateRecord> = open(&records).collect();
    let after = |stage, o| rounded(share(open.iter().copied(), stage, o));
    let readings = mean_readings(&open, |r| r.readings);
    vec![
        format!(
            "By the confusing plans alone {} of the answers are right and {} wrong; the rest is honestly open.",
            rounded(share(all(), |r| r.before, Outcome::Right)),
            rounded(share(all(), |r| r.before, Outcome::Wrong))
        ),
        format!(
            "Where the diagnosis proposes readings ({} trials, {readings:.1} readings each), {} become right; with as many readings \
             drawn at random {}. Wrong become {} and {}.",
            open.len(),
            after(|r| r.proposed, Outcome::Right),
            after(|r| r.proposed_random, Outcome::Right),
            after(|r| r.proposed, Outcome::Wrong),
            after(|r| r.proposed_random, Outcome::Wrong)
        ),
        versus("proposed", &open, |r| r.proposed == Outcome::Right, |r| r.proposed_random == Outcome::Right),
        format!(
            "With readings chosen for the pair itself (at most {READINGS} in every trial) {} are right, with as many at random {}.",
            rounded(share(all(), |r| r.asked, Outcome::Right)),
            rounded(share(all(), |r| r.asked_random, Outcome::Right))
        ),
        format!(
            "Those readings promise that the evidence will favor the truth over the other of the pair in {:.0} % on average; it does so in {}.",
            100.0 * mean(all().map(|r| r.promised).filter(|chance| chance.is_finite())).unwrap_or(0.0),
            rounded(Proportion::count(all(), |r| r.favoured))
        ),
        versus(
            "chosen for the pair",
            &all().collect::<Vec<_>>(),
            |r| r.asked == Outcome::Right,
            |r| r.asked_random == Outcome::Right,
        ),
    ]
}

/// Trials that only one of two ways brings to the right answer.
fn versus(
    what: &str,
    records: &[&DiscriminateRecord],
    chosen: fn(&DiscriminateRecord) -> bool,
    random: fn(&DiscriminateRecord) -> bool,
) -> String {
    let only: Vec<bool> = records.iter().filter(|r| chosen(r) != random(r)).map(|r| chosen(r)).collect();
    let p = Proportion::count(&only, |c| **c);
    format!(
        "Of {} trials that only one of the two brings to the right answer, the readings {what} do so in {}; 50 % would be no \
         difference (McNemar 1947).",
        p.of,
        rounded(p)
    )
}

fn introduction(study: &Discrimination) -> Section {
    Section::lead()
        .paragraph(written_by("hexbench validate discriminate --markdown FILE"))
        .paragraph(format!(
            "{} pairs of effects that look alike, {} simulated campaigns each (seed {}; {} gave no answer). In each one of the \
             two effects, at random, is hidden in a machine of one of seven families, at a distance of 8 to 20 standard \
             deviations from what free leg springs can imitate, and measured by a plan that confuses the two. The diagnosis gives \
             a first answer. The proposed readings are then taken on the same simulated machine, with new noise, added to the \
             measurements, and everything is diagnosed again; beside it as many readings drawn at random from the same candidates of \
             poses, loads and conditions. The list itself is broad: what a random reading of it shows is no straw man.",
            study.pairs.len(),
            study.protocol.trials,
            study.protocol.seed,
            study.failures,
        ))
        .paragraph(
            "Right: exactly the hidden effect is named. Honest: ambiguous, and the hidden effect is not excluded. Wrong: anything \
             else. No held-out file: poses are left out in turn. Shares with exact binomial 95 % bounds (Clopper and Pearson).",
        )
}

const BEFORE: &str = "Three poses near the middle, three readings of each condition.";

const PROPOSED: &str = "Trials in which the first answer is open and the diagnosis proposes readings; it stops at readings that are \
expected to leave odds of 1000:1 between its best explanations, at two at least and six at most.";

fn asked_words() -> String {
    format!(
        "All trials, whatever the first answer: at most {READINGS} readings chosen by what separates the two effects of the pair alone, \
         as `hexbench discriminate --data` does."
    )
}
