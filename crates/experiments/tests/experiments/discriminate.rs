//! Proposed readings against none and against random ones, a handful of campaigns.

use hexbench_experiments::Outcome;
use hexbench_experiments::discriminate::{
    CONFUSIONS, ConfusedPair, DiscriminateProtocol, DiscriminateRecord, Discrimination, PairTrials,
};
use hexbench_experiments::harness::{self, Silent};

fn discriminate(protocol: DiscriminateProtocol, confusions: &[ConfusedPair]) -> Discrimination {
    let trials = PairTrials { protocol, confusions };
    Discrimination::of(&trials, &harness::run(&trials, None, &Silent).unwrap())
}

/// Two pairs whose confusion needs quite different readings.
fn confusions() -> Vec<ConfusedPair> {
    let wanted = ["base-compliance or leg-coupling", "leg-nonlinearity or leg-backlash"];
    CONFUSIONS.into_iter().filter(|c| wanted.contains(&c.name().as_str())).collect()
}

fn right(records: &[DiscriminateRecord], stage: fn(&DiscriminateRecord) -> Outcome) -> usize {
    records.iter().filter(|r| stage(r) == Outcome::Right).count()
}

#[test]
fn most_open_answers_become_right_after_the_proposed_readings() {
    const TRIALS: usize = 10;
    // Of answers that the plan leaves open, chance or useless readings leave most open; see docs/results/discriminate.md for the shares.
    const LEAST_SHARE: f64 = 0.6;
    let study = discriminate(
        DiscriminateProtocol { trials: TRIALS, ..DiscriminateProtocol::default() },
        &confusions(),
    );
    assert_eq!(study.failures, 0);
    let open: Vec<DiscriminateRecord> = study.records().into_iter().filter(|r| r.readings > 0).collect();
    assert!(open.len() >= TRIALS / 2, "only {} answers were open", open.len());
    assert_eq!(right(&open, |r| r.before), 0);
    let (proposed, random) = (right(&open, |r| r.proposed), right(&open, |r| r.proposed_random));
    assert!(
        proposed as f64 >= LEAST_SHARE * open.len() as f64,
        "{proposed} of {} right after the proposed readings, {random} after random ones",
        open.len()
    );
    assert!(proposed >= random, "{proposed} right after the proposed readings, {random} after random ones");
}

#[test]
fn the_same_seed_gives_the_same_records_on_any_number_of_threads() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let protocol = DiscriminateProtocol { trials: 2, seed: 5 };
        pool.install(|| discriminate(protocol, &confusions()[..1]).records())
    };
    assert_eq!(run(1), run(3));
}
