//! What held-out readings say of an effect: useless ones pass in few cases, real ones are not lost.

use std::sync::Arc;

use hexbench_core::statistics::Proportion;
use hexbench_core::{Dataset, Hexapod, Measurand, Observation, Vector3};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::{Fit, TermSpec, fit};
use hexbench_model::estimation::foreseen::{Predictive, held_campaign};
use hexbench_model::inference::gain::{GainOutcome, HeldOutGain, UNLIKELY};
use rayon::prelude::*;

use crate::common::plan::{noisy, rich_plan};
use crate::common::terms::by_id;
use crate::common::world::World;
use crate::common::{PAPER_STIFFNESS, measured_machine, paper_machine};

const SIGMA_TRANSLATION_M: f64 = 0.82e-6;
const SIGMA_ROTATION_RAD: f64 = 9e-6;
/// Campaigns of a share.
const CAMPAIGNS: u64 = 200;

/// A load that acts off the mobile origin by so many of these, m: with three of them twelve held-out poses promise nine nats.
const OFFSET_M: [f64; 3] = [0.6e-3, -0.9e-3, 1.5e-3];

fn world(offset: f64) -> World {
    let mut world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    world.load_point = Vector3::from(OFFSET_M) * offset;
    world
}

fn measured(offset: f64, plan: &[Observation], seed: u64) -> Dataset {
    let clean = world(offset).measure(Measurand::DeflectionEuler, plan);
    noisy(&clean, SIGMA_TRANSLATION_M, SIGMA_ROTATION_RAD, seed)
}

fn offset_term() -> TermSpec {
    let term = by_id("load-offset");
    let prior = vec![1.0; term.info().parameters.len()];
    TermSpec { term: Arc::clone(&term), rich: false, shape: 1.0, prior }
}

/// What a campaign in which the load is off says of it on readings in which it may be otherwise.
struct Trial {
    fitted: f64,
    held: f64,
    held_poses: usize,
}

impl Trial {
    fn gain(&self, seed: u64) -> HeldOutGain {
        let hexapod: Hexapod = measured_machine(SIGMA_TRANSLATION_M, SIGMA_ROTATION_RAD);
        let data = measured(self.fitted, &rich_plan(24, 1.0, 10), 2 * seed);
        let holdout = measured(self.held, &rich_plan(self.held_poses, 1.0, 11), 2 * seed + 1);
        let campaign = Campaign::new(&hexapod, &data).unwrap();
        let foreseen = |fit: &Fit| {
            let held = held_campaign(&campaign, &holdout, &fit.point).unwrap();
            [Predictive::of(&campaign, fit).unwrap().foreseen(held).unwrap()]
        };
        let before = foreseen(&fit(&campaign, &[], None).unwrap());
        let after = foreseen(&fit(&campaign, &[offset_term()], None).unwrap());
        HeldOutGain::of(&before, &after)
    }

    fn share(&self, wanted: impl Fn(&HeldOutGain) -> bool + Sync) -> Proportion {
        let gains: Vec<HeldOutGain> = (0..CAMPAIGNS).into_par_iter().map(|seed| self.gain(seed)).collect();
        let promised = gains.iter().map(|g| g.expected_nats).sum::<f64>() / CAMPAIGNS as f64;
        let share = Proportion::count(&gains, |g| wanted(g));
        let Self { fitted, held, held_poses } = self;
        println!("{fitted} {held} {held_poses}: promised {promised:.2} nats, {} of {CAMPAIGNS}", share.hits);
        share
    }
}

fn is(outcome: GainOutcome) -> impl Fn(&HeldOutGain) -> bool {
    move |gain| gain.outcome == outcome
}

#[test]
fn a_useless_effect_is_shown_by_held_out_poses_in_one_case_of_twenty_at_most() {
    for held_poses in [4, 12, 24] {
        let shown = Trial { fitted: 0.0, held: 0.0, held_poses }.share(is(GainOutcome::Shown));
        assert!(!shown.is_above(UNLIKELY), "{shown:?}");
    }
}

#[test]
fn an_effect_that_seems_sure_and_is_not_there_survives_in_one_case_of_twenty_at_most() {
    let survives = |g: &HeldOutGain| g.outcome != GainOutcome::Refuted;
    for fitted in [3.0, 10.0] {
        let survived = Trial { fitted, held: 0.0, held_poses: 12 }.share(survives);
        assert!(!survived.is_above(UNLIKELY), "{survived:?}");
    }
}

#[test]
fn a_real_effect_is_refuted_in_one_case_of_twenty_at_most_however_few_the_held_out_poses() {
    for (size, held_poses) in [(1.0, 4), (2.0, 24), (3.0, 2), (3.0, 12)] {
        let refuted = Trial { fitted: size, held: size, held_poses }.share(is(GainOutcome::Refuted));
        assert!(!refuted.is_above(UNLIKELY), "{refuted:?}");
    }
}

#[test]
fn a_large_effect_is_shown_by_a_dozen_poses() {
    let shown = Trial { fitted: 8.0, held: 8.0, held_poses: 12 }.share(is(GainOutcome::Shown));
    assert!(shown.rate() > 0.9, "{shown:?}");
}
