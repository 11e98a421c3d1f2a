//! Proposed readings: within what the campaign shows the machine can do, round, and better than most.

use hexbench_core::{Dataset, Measurand, Observation, Pose, Vector3, Wrench};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::fit_named::{Added, fit_wanted};
use hexbench_model::estimation::tolerances::{within_tolerances, within_tolerances_of};
use hexbench_model::inference::power::Detectable;
use hexbench_model::machine::kinematics::Legs;
use hexbench_model::results::next::{
    Effort, RivalExplanation, candidate_readings, detectable_after, forecasts, propose, suspects,
};

use crate::common::plan::{dataset, noisy, paper_plan, random_pose, reading, rich_plan};
use crate::common::random::Random;
use crate::common::structure::Structure;
use crate::common::terms::by_id;
use crate::common::world::World;
use crate::common::{PAPER_STIFFNESS, measured_machine};

const SIGMA_M: f64 = 0.5e-6;
const SIGMA_RAD: f64 = 3e-6;
/// A leg may carry so much more than it has carried.
const SLACK: f64 = 1.0501;

/// The paper's plan on a machine whose load acts beside the origin: several effects explain it.
fn open_campaign() -> (Campaign, Vec<RivalExplanation>) {
    let mut world = World::on_springs(&measured_machine(SIGMA_M, SIGMA_RAD), PAPER_STIFFNESS);
    world.load_point = Vector3::new(4e-3, -2e-3, 0.0);
    let data = noisy(&world.measure(Measurand::DeflectionEuler, &paper_plan(3)), SIGMA_M, SIGMA_RAD, 7);
    let campaign = Campaign::new(&world.drawn, &data).unwrap();
    let terms = ["load-offset", "base-compliance", "platform-compliance"].map(by_id);
    let rivals = suspects(&campaign, &terms).unwrap().rivals;
    (campaign, rivals)
}

fn strongest(campaign: &Campaign, o: &Observation) -> f64 {
    let hexapod = &campaign.hexapod;
    let legs = Legs::at(&hexapod.base_joints, &hexapod.platform_joints, &o.pose).unwrap();
    [o.wrench, o.reference].map(|w| legs.forces(&w.to_vector()).amax()).into_iter().fold(0.0, f64::max)
}

#[test]
fn no_reading_asks_more_of_a_leg_than_it_has_carried() {
    let (campaign, rivals) = open_campaign();
    let candidate_readings = candidate_readings(&campaign, &rivals).unwrap();
    assert!(candidate_readings.len() > 100, "{} readings", candidate_readings.len());
    let known = campaign.groups.iter().map(|g| strongest(&campaign, &g.mean)).fold(0.0, f64::max);
    for o in &candidate_readings {
        let carried = strongest(&campaign, o);
        assert!(carried <= SLACK * known, "{carried:.1} N against {known:.1} N at {o:?}");
    }
}

#[test]
fn poses_are_whole_millimetres_and_half_degrees() {
    let (campaign, rivals) = open_campaign();
    for o in candidate_readings(&campaign, &rivals).unwrap() {
        for (k, x) in o.pose.to_array().into_iter().enumerate() {
            let steps = if k < 3 { x * 1e3 } else { 2.0 * x.to_degrees() };
            assert!((steps - steps.round()).abs() < 1e-9, "coordinate {k}: {x}");
        }
    }
}

/// About one random set in a hundred separates the worst pair as well: readings are chosen one after the other, for all pairs.
#[test]
fn proposed_readings_separate_the_worst_pair_better_than_random_ones() {
    const READINGS: usize = 3;
    const SETS: usize = 150;
    /// Share of random sets that may be as good.
    const AS_GOOD: f64 = 0.05;
    let (campaign, rivals) = open_campaign();
    let candidate_readings = candidate_readings(&campaign, &rivals).unwrap();
    let proposed = propose(&campaign, &rivals, &candidate_readings, Effort::Exactly(READINGS)).unwrap();
    assert_eq!(proposed.readings(), READINGS);
    let worst = |readings: &[Observation]| {
        let all = forecasts(&campaign, &rivals, readings).unwrap();
        all.iter().flat_map(|pair| pair.separation.log_bayes_factor).fold(f64::INFINITY, f64::min)
    };
    let chosen: Vec<Observation> =
        proposed.proposals.iter().flat_map(|p| std::iter::repeat_n(p.observation, p.repeats)).collect();
    let best = worst(&chosen);
    let promised = proposed.forecasts.iter().flat_map(|o| o.separation.log_bayes_factor);
    assert!((promised.fold(f64::INFINITY, f64::min) / best - 1.0).abs() < 1e-9);
    let mut random = Random::new(3);
    let mut shuffled: Vec<(f64, Observation)> =
        candidate_readings.iter().map(|o| (random.unit(), *o)).collect();
    shuffled.sort_by(|x, y| x.0.total_cmp(&y.0));
    let drawn: Vec<Observation> = shuffled.into_iter().map(|x| x.1).collect();
    let sets: Vec<&[Observation]> = drawn.chunks_exact(READINGS).take(SETS).collect();
    let as_good = sets.iter().filter(|set| worst(set) >= best).count();
    assert_eq!(sets.len(), SETS);
    assert!(
        (as_good as f64) < AS_GOOD * SETS as f64,
        "{as_good} of {SETS} random sets are as good as {best:.2}"
    );
}

#[test]
fn every_reading_says_what_sort_it_is_or_is_ordinary() {
    let (campaign, rivals) = open_campaign();
    let candidate_readings = candidate_readings(&campaign, &rivals).unwrap();
    let proposed = propose(&campaign, &rivals, &candidate_readings, Effort::Exactly(3)).unwrap();
    let ordinary = campaign.groups[0].mean;
    for p in &proposed.proposals {
        let usual = p.observation.wrench == ordinary.wrench && p.observation.pose == Pose::default();
        assert!(usual || !p.words.is_empty(), "{p:?}");
    }
}

#[test]
fn readings_that_change_nothing_are_not_proposed() {
    let (campaign, rivals) = open_campaign();
    let idle: Vec<Observation> = candidate_readings(&campaign, &rivals)
        .unwrap()
        .into_iter()
        .map(|o| Observation { wrench: o.reference, elapsed: 0.0, delta_t: 0.0, ..o })
        .collect();
    let proposed = propose(&campaign, &rivals, &idle, Effort::UpTo(3)).unwrap();
    assert!(proposed.proposals.is_empty() && proposed.forecasts.is_empty(), "{proposed:?}");
}

/// The model averages readings under equal conditions, whatever line of whatever file they come from.
#[test]
fn readings_that_differ_only_in_where_they_come_from_are_proposed_as_any() {
    let (campaign, rivals) = open_campaign();
    let candidate_readings = candidate_readings(&campaign, &rivals).unwrap();
    let numbered: Vec<Observation> =
        candidate_readings.iter().zip(1..).map(|(o, line)| Observation { line, ..*o }).collect();
    let of = |candidate_readings: &[Observation]| {
        propose(&campaign, &rivals, candidate_readings, Effort::Exactly(6)).unwrap()
    };
    let (plain, from_lines) = (of(&candidate_readings), of(&numbered));
    assert!(plain.proposals.len() > 1, "{} proposals", plain.proposals.len());
    let words = |p: &hexbench_model::results::next::ProposedReadings| -> Vec<String> {
        p.proposals.iter().map(|p| p.words.clone()).collect()
    };
    assert_eq!(words(&plain), words(&from_lines));
}

/// A bent spring under one load that presses and one that pulls: play whose contacts close gradually bends as well.
fn bent_springs() -> Campaign {
    let drawn = measured_machine(SIGMA_M, SIGMA_RAD);
    let mut machine = Structure::on_springs(&drawn, PAPER_STIFFNESS);
    machine.contact = (3e-6, 0.75);
    let [preload, pressed, pulled] =
        [-120.0, -338.0, 100.0].map(|z| Wrench::from_array([0.0, 0.0, z, 0.0, 0.0, 0.0]));
    let mut random = Random::new(5);
    let at = |id: i64| {
        let pose = random_pose(&mut random, 4.0, 6.0);
        [pressed, pulled].map(|load| Observation { pose_id: id, ..reading(pose, load, preload) })
    };
    let plan: Vec<Observation> = (1..4).flat_map(at).flat_map(|o| [o; 3]).collect();
    let clean = dataset(Measurand::DeflectionRotationVector, machine.measured(&plan));
    Campaign::new(&drawn, &noisy(&clean, SIGMA_M, SIGMA_RAD, 7)).unwrap()
}

/// A rival takes the form that suits it best: what is promised of two effects holds for all of their forms.
#[test]
fn readings_are_promised_to_separate_every_form_that_the_data_leave_open() {
    let campaign = bent_springs();
    let rivals = suspects(&campaign, &["leg-nonlinearity", "leg-backlash"].map(by_id)).unwrap().rivals;
    let gradual = |fit: &Fit| fit.point.active.iter().any(|a| a.term.version() == Some("soft"));
    let of_play = &rivals[1];
    assert!(
        gradual(&of_play.fit) != of_play.forms.iter().any(|form| gradual(&form.fit)),
        "one form of the two"
    );
    let in_each_form = |rival: &RivalExplanation| -> Vec<RivalExplanation> {
        let fits = std::iter::once(&rival.fit).chain(rival.forms.iter().map(|form| &form.fit));
        fits.map(|fit| RivalExplanation { fit: fit.clone(), forms: Vec::new(), ..rival.clone() }).collect()
    };
    let candidates = candidate_readings(&campaign, &rivals).unwrap();
    let readings = propose(&campaign, &rivals, &candidates, Effort::Exactly(3)).unwrap().one_by_one();
    let promised = |rivals: &[RivalExplanation]| {
        let [told] = &forecasts(&campaign, rivals, &readings).unwrap()[..] else { panic!("one pair") };
        told.separation.log_bayes_factor.into_iter().fold(f64::INFINITY, f64::min)
    };
    let [of_springs, of_play] = [&rivals[0], &rivals[1]].map(in_each_form);
    let pairs = of_springs.iter().flat_map(|a| of_play.iter().map(move |b| [a.clone(), b.clone()]));
    let each: Vec<f64> = pairs.map(|pair| promised(&pair)).collect();
    let least = each.iter().copied().fold(f64::INFINITY, f64::min);
    assert!((promised(&rivals) / least - 1.0).abs() < 1e-9, "{each:?}");
    assert!(least < 0.5 * each[0], "the preferred forms alone promise too much: {each:?}");
}

/// The first half of a campaign with the second half to come, and the whole campaign, show the same effects: what a reading will measure
/// does not matter, its conditions do.
#[test]
fn what_readings_to_come_will_show_is_what_they_show_once_they_are_taken() {
    /// The pose at which a condition is seen follows its reading, in second order.
    const SECOND_ORDER: f64 = 1e-5;
    let world = World::on_springs(&measured_machine(SIGMA_M, SIGMA_RAD), PAPER_STIFFNESS);
    let all =
        noisy(&world.measure(Measurand::DeflectionEuler, &rich_plan(30, 1.0, 5)), SIGMA_M, SIGMA_RAD, 7);
    let (first, later) = all.observations.split_at(20);
    let terms = ["load-offset", "base-compliance", "leg-nonlinearity", "platform-compliance"].map(by_id);
    let half = Campaign::new(&world.drawn, &Dataset { observations: first.to_vec(), ..all.clone() }).unwrap();
    let half = within_tolerances(half);
    let whole = within_tolerances_of(&half, Campaign::with_noise(&world.drawn, &all, half.noise).unwrap());
    for beside in [vec![], vec![Added::from(by_id("load-offset"))]] {
        let (_, known) = fit_wanted(&half, &beside).unwrap();
        let [now, promised] =
            [&[], later].map(|readings| detectable_after(&half, &known, &terms, readings).unwrap());
        let taken = detectable_after(&whole, &known, &terms, &[]).unwrap();
        assert_eq!((now.len(), promised.len()), (taken.len(), taken.len()));
        for ((now, promised), taken) in now.iter().zip(&promised).zip(&taken) {
            let size = |d: &Detectable| d.size_at_90_percent_power.unwrap();
            let off = size(promised) / size(taken) - 1.0;
            assert!(off.abs() < SECOND_ORDER, "{taken:?} {promised:?}");
            assert!(size(promised) < size(now), "{now:?} {promised:?}");
        }
    }
}
