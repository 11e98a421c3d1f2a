//! What a machine remembers: creep of a preload of any age by either law, and contacts that close gradually; simulated, then diagnosed.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Approach, Dataset, Hexapod, LoadSequences, Observation};
use hexbench_experiments::trial::reported;
use hexbench_model::estimation::fit_named::{Added, fit_wanted};
use hexbench_model::inference::verdict::Verdict;
use hexbench_model::results::diagnose::{Diagnosis, diagnose, prepare};
use hexbench_model::terms::catalogue;
use hexbench_truth::campaign::{
    PlanKind, Poses, Schemes, SimulatedCampaign, Spread, Yardstick, machines, measure,
};
use hexbench_truth::mechanisms::{Creep, CreepLaw, JointFriction, LegBacklash, LegDrift, LoadMassError};
use hexbench_truth::metrology::{InstrumentFrames, InstrumentNoise};
use hexbench_truth::{Mechanism, World};

/// Distances from plain to large.
const DISTANCES: [f64; 3] = [10.0, 20.0, 40.0];
/// Largest error of a number, in standard uncertainties.
const WITHIN_SIGMAS: f64 = 3.0;
/// Time constant of exponential creep, s.
const TAU_S: f64 = 80.0;

/// A campaign to be diagnosed.
pub(crate) struct History {
    hexapod: Hexapod,
    pub(crate) measurements: Dataset,
    pub(crate) holdout: Dataset,
    /// The hidden effect, as large as its distance asks for.
    pub(crate) hidden: Option<Box<dyn Mechanism>>,
    /// The measurements without noise.
    exact: Dataset,
}

/// An effect in a machine of a seed, scaled to a distance; `of_plan` changes the plan "rich".
pub(crate) fn history(
    effect: Option<Box<dyn Mechanism>>,
    distance: f64,
    seed: u64,
    of_plan: impl Fn(&mut Schemes),
) -> History {
    let rng = |number| stream(seed, Purpose::Test, [17, number]);
    let family = *machines::FAMILIES.iter().cycle().nth(usize::try_from(seed).unwrap()).unwrap();
    let mut hexapod = machines::draw(family, &mut rng(0));
    let noise = InstrumentNoise::default();
    hexapod.metrology = Some(noise.metrology());
    let stiffness = machines::leg_stiffness(family, &mut rng(1));
    let mut schemes = PlanKind::Rich.schemes(&hexapod, &mut rng(2));
    of_plan(&mut schemes);
    let measurand = schemes.training.measurand;
    let [training, holdout] = [(schemes.training, 3), (schemes.holdout, 4)].map(|(s, n)| s.draw(&mut rng(n)));
    let world = World::new(hexapod.clone(), &stiffness);
    let mut campaign = SimulatedCampaign { world, frames: InstrumentFrames::default(), noise };
    let hidden = effect.map(|effect| {
        let yardstick = Yardstick::new(&campaign, &training, measurand).unwrap();
        effect.scaled(yardstick.scale_to(&*effect, distance).unwrap().0)
    });
    campaign.world.mechanisms.extend(hidden.iter().map(|h| h.scaled(1.0)));
    let read = |rows, n| measure(&campaign, rows, measurand, "history", &mut rng(n)).unwrap();
    let (measurements, holdout) = (read(&training, 5), read(&holdout, 6));
    let ideal = campaign.ideal(&training, measurand).unwrap();
    let mut exact = measurements.clone();
    exact.observations.iter_mut().zip(ideal).for_each(|(o, reading)| o.measured = reading.into());
    History { hexapod, measurements, holdout, hidden, exact }
}

impl History {
    pub(crate) fn diagnosis(&self) -> Diagnosis {
        diagnose(&self.hexapod, &self.measurements, Some(&self.holdout), &catalogue()).unwrap().diagnosis
    }
}

/// Value over true value in standard uncertainties; none where no number is given.
fn pull(d: &Diagnosis, name: &str, truth: f64) -> Option<f64> {
    let estimate = d.parameters.iter().find(|p| p.name == name)?;
    Some((estimate.value - truth) / estimate.std)
}

fn creep(age: Option<f64>, law: CreepLaw) -> Box<dyn Mechanism> {
    let time = if law == CreepLaw::Exponential { TAU_S } else { 10.0 };
    Box::new(Creep { age, law, ..Creep::new(0.05, time) })
}

/// Load and wait of a laboratory with a heavy platform.
fn heavy(schemes: &mut Schemes) {
    for scheme in [&mut schemes.training, &mut schemes.holdout] {
        scheme.reference.force.z = -250.0;
        for load in &mut scheme.loads {
            load.force.z -= 130.0;
        }
    }
}

fn stated(age: f64) -> impl Fn(&mut Schemes) {
    move |schemes| {
        heavy(schemes);
        for scheme in [&mut schemes.training, &mut schemes.holdout] {
            scheme.reference_age = Some(Spread::Fixed(age));
        }
    }
}

/// What was said of the campaigns of one case.
#[derive(Default)]
struct Said {
    right: usize,
    ambiguous: usize,
    outside: usize,
    other: usize,
    /// Errors in standard uncertainties, number by number.
    pulls: [Vec<f64>; 2],
}

impl Said {
    fn of(&mut self, id: &str, history: &History, names: [&str; 2], truth: [f64; 2]) {
        let d = history.diagnosis();
        let reported = reported(&d);
        let is_right = match &history.hidden {
            Some(_) => d.verdict == Verdict::Named && reported == [id],
            None => d.verdict == Verdict::Adequate && reported.is_empty(),
        };
        match d.verdict {
            _ if is_right => self.right += 1,
            Verdict::Ambiguous => self.ambiguous += 1,
            Verdict::Outside => self.outside += 1,
            _ => self.other += 1,
        }
        for k in (0..2).filter(|_| reported == [id]) {
            self.pulls[k].extend(pull(&d, names[k], truth[k]));
        }
    }

    fn line(&self, case: &str) -> String {
        let within = |pulls: &[f64], limit: f64| pulls.iter().filter(|p| p.abs() < limit).count();
        let of = |p: &Vec<f64>| format!("{}, {} of {}", within(p, 1.0), within(p, WITHIN_SIGMAS), p.len());
        let Self { right, ambiguous, outside, other, pulls } = self;
        format!(
            "{case:30} right {right:2} ambiguous {ambiguous} outside {outside} other {other}; within 1 and 3 sigma: {}; {}",
            of(&pulls[0]),
            of(&pulls[1])
        )
    }

    fn all_right(&self, case: &str) {
        let missed = [self.ambiguous, self.outside, self.other];
        let far = self.pulls.iter().flatten().any(|p| p.abs() > WITHIN_SIGMAS);
        assert!(missed == [0; 3] && !far, "{} {:?}", self.line(case), self.pulls);
    }
}

/// A case of creep: what the preload does, and whether the file says so.
#[derive(Clone, Copy)]
struct CreepCase {
    name: &'static str,
    age: Option<f64>,
    law: CreepLaw,
    is_stated: bool,
}

const fn exponential(name: &'static str, age: Option<f64>, is_stated: bool) -> CreepCase {
    CreepCase { name, age, law: CreepLaw::Exponential, is_stated }
}

const fn logarithmic(name: &'static str, age: Option<f64>) -> CreepCase {
    CreepCase { name, age, law: CreepLaw::Logarithmic, is_stated: false }
}

const CREEP: [CreepCase; 9] = [
    exponential("settled", None, false),
    exponential("fresh", Some(0.0), false),
    exponential("half-settled", Some(0.7 * TAU_S), false),
    exponential("fresh, age stated", Some(0.0), true),
    exponential("half-settled, age stated", Some(0.7 * TAU_S), true),
    exponential("settled, age stated", Some(20.0 * TAU_S), true),
    logarithmic("logarithmic, settled", None),
    logarithmic("logarithmic, fresh", Some(0.0)),
    logarithmic("logarithmic, half-settled", Some(60.0)),
];

impl CreepCase {
    fn history(self, distance: f64, seed: u64) -> History {
        let effect = Some(creep(self.age, self.law));
        match self.age.filter(|_| self.is_stated) {
            Some(age) => history(effect, distance, seed, stated(age)),
            None => history(effect, distance, seed, heavy),
        }
    }

    fn said(self, distances: &[f64], seeds: u64) -> Said {
        let mut said = Said::default();
        let names = match self.law {
            CreepLaw::Exponential => ["creep.fraction", "creep.time-constant"],
            CreepLaw::Logarithmic => ["creep.fraction-per-e-fold", "creep.logarithmic-time"],
        };
        for (&distance, seed) in distances.iter().flat_map(|d| (0..seeds).map(move |seed| (d, seed))) {
            let history = self.history(distance, seed);
            let numbers = history.hidden.as_ref().unwrap().parameters();
            let [share, time] = [0, 1].map(|k| numbers["creep"][k].as_f64().unwrap());
            said.of("creep", &history, names, [100.0 * share, time]);
        }
        said
    }
}

fn clean(seeds: u64) -> Said {
    let mut said = Said::default();
    (0..seeds).for_each(|seed| said.of("", &history(None, 0.0, seed, heavy), [""; 2], [0.0; 2]));
    said
}

fn backlash(width: f64, distances: &[f64], seeds: u64) -> Said {
    let mut said = Said::default();
    for (&distance, seed) in distances.iter().flat_map(|d| (0..seeds).map(move |seed| (d, seed))) {
        let history = history(Some(Box::new(LegBacklash { gap: 1e-6, width })), distance, seed, |_| {});
        let gap = history.hidden.as_ref().unwrap().parameters()["backlash"].as_f64().unwrap();
        let names = ["leg-backlash.gap", "leg-backlash.contact-width"];
        said.of("leg-backlash", &history, names, [1e6 * gap, width]);
    }
    said
}

/// The usual effects that go with time keep their names beside a preload that may creep.
fn other(id: &str, seeds: u64) -> Said {
    let mut said = Said::default();
    for seed in 0..seeds {
        let effect = hexbench_truth::mechanisms::effect(id).unwrap();
        let hexapod = machines::RING_A.hexapod("ring_a");
        let drawn = (effect.draw)(&hexapod, &mut stream(seed, Purpose::Test, [18]));
        said.of(id, &history(Some(drawn), 22.0, seed, heavy), [""; 2], [0.0; 2]);
    }
    said
}

#[test]
fn a_mass_that_nobody_counted_is_no_creep_of_the_preload() {
    for (distance, seed) in [(15.0, 0), (30.0, 1), (60.0, 2)] {
        let history = history(Some(Box::new(LoadMassError { mass: 0.5 })), distance, seed, heavy);
        let d = history.diagnosis();
        let pattern = d.outside.as_ref().and_then(|outside| outside.pattern);
        assert_eq!(
            pattern,
            Some("unstated-load"),
            "distance {distance}, seed {seed}: {:?} {:?}",
            d.verdict,
            d.added
        );
    }
}

/// A campaign of many readings sees laws far below the noise; no model is the worse for them.
#[test]
fn a_law_of_less_than_a_tenth_of_the_noise_is_told_and_the_springs_are_adequate() {
    for (poses, repeats, distance) in [(224, 2, 11.5), (420, 4, 20.0)] {
        let many = |schemes: &mut Schemes| {
            let Poses::Drawn { count, .. } = &mut schemes.training.poses else {
                panic!("the rich plan draws poses")
            };
            (*count, schemes.training.repeats) = (poses, repeats);
        };
        let history = history(Some(Box::new(LegDrift { leg: 2, rate: 1e-9 })), distance, 0, many);
        let d = history.diagnosis();
        let what =
            format!("{} readings: {:?}", history.measurements.observations.len(), d.candidates.first());
        assert_eq!(d.verdict, Verdict::Adequate, "{what}");
        assert_eq!(d.outside.as_ref().and_then(|outside| outside.pattern), Some("linear"), "{what}");
    }
}

/// Largest relative error of a number without noise: deflections are 5e-4 of the leg length, and fraction and time constant share it.
const LINEARIZATION: f64 = 5e-3;

#[test]
fn creep_of_any_preload_is_recovered_without_noise() {
    for (case, asked) in CREEP[..6].iter().zip([
        "creep:unsettled",
        "creep:unsettled",
        "creep:unsettled",
        "creep",
        "creep",
        "creep",
    ]) {
        let mut history = case.history(40.0, 3);
        // So exact that no prior has a say.
        let noise = InstrumentNoise::default();
        let [sigma_translation, sigma_rotation] =
            [noise.sigma_translation, noise.sigma_rotation].map(|s| 1e-3 * s);
        history.hexapod.metrology =
            Some(InstrumentNoise { sigma_translation, sigma_rotation, ..noise }.metrology());
        let campaign = prepare(&history.hexapod, &history.exact).unwrap();
        let (_, fit) = fit_wanted(&campaign, &[Added::named(asked, &catalogue()).unwrap()]).unwrap();
        let active = &fit.point.active[0];
        let share = history.hidden.as_ref().unwrap().parameters()["creep"][0].as_f64().unwrap();
        let near = |value: f64, truth: f64| (value / truth - 1.0).abs() < LINEARIZATION;
        assert!(
            near(active.values[0], share) && near(active.shape, TAU_S),
            "{}: {active:?} {share}",
            case.name
        );
        let fresh = case.age.map_or(0.0, |age| (-age / TAU_S).exp());
        let part = active.values.get(1).map_or(fresh, |part| part / active.values[0]);
        assert!((part - fresh).abs() < LINEARIZATION, "{}: {part} {fresh}", case.name);
    }
}

/// Loads put on one after the other at each pose, up and down again, none of them exceeded.
fn in_sequence(schemes: &mut Schemes) {
    heavy(schemes);
    for scheme in [&mut schemes.training, &mut schemes.holdout] {
        scheme.in_sequence = true;
        scheme.approaches = vec![Approach::Direct];
        scheme.elapsed = Spread::Even([5.0, 120.0]);
        let loads = &scheme.loads;
        scheme.loads = [1, 0, 1, 2, 3, 5, 2, 4].map(|load| loads[load]).to_vec();
    }
}

/// The same readings by someone who forgot to write the sequence down.
fn without_order(data: &Dataset) -> Dataset {
    let forgotten = |o: &Observation| Observation { order: None, ..*o };
    let mut data = Dataset {
        sequences: LoadSequences::default(),
        observations: data.observations.iter().map(forgotten).collect(),
        ..data.clone()
    };
    data.columns.order = false;
    data
}

fn friction() -> Box<dyn Mechanism> {
    Box::new(JointFriction { slider_force: 3.0, stick_ratio: None })
}

/// Reduced chi-square of a fit to a thousandth of the usual noise, and the first number of the effect.
fn recovered(history: &History, data: &Dataset, asked: &str) -> (f64, f64) {
    let mut hexapod = history.hexapod.clone();
    let noise = InstrumentNoise::default();
    let [sigma_translation, sigma_rotation] =
        [noise.sigma_translation, noise.sigma_rotation].map(|s| 1e-3 * s);
    hexapod.metrology = Some(InstrumentNoise { sigma_translation, sigma_rotation, ..noise }.metrology());
    let campaign = prepare(&hexapod, data).unwrap();
    let (_, fit) = fit_wanted(&campaign, &[Added::named(asked, &catalogue()).unwrap()]).unwrap();
    (fit.chi2 / fit.dof, fit.point.active[0].values[0])
}

#[test]
fn loads_that_follow_each_other_leave_the_trace_of_their_sequence() {
    let of = |effect, distance| history(Some(effect), distance, 3, in_sequence);
    let creeping = of(creep(None, CreepLaw::Exponential), 40.0);
    let share = creeping.hidden.as_ref().unwrap().parameters()["creep"][0].as_f64().unwrap();
    let sliding = of(friction(), 40.0);
    let force = sliding.hidden.as_ref().unwrap().parameters()["friction"].as_f64().unwrap();
    for (history, asked, truth) in [(creeping, "creep", share), (sliding, "joint-friction", force)] {
        let (left, value) = recovered(&history, &history.exact, asked);
        assert!((value / truth - 1.0).abs() < LINEARIZATION, "{asked}: {value} for {truth}");
        let forgotten = without_order(&history.exact);
        let (more, _) = recovered(&history, &forgotten, asked);
        assert!(more > 100.0 * left, "{asked}: {left}, and {more} without the sequence");
    }
}

#[test]
fn effects_of_a_history_are_named_in_a_sequence_of_loads() {
    for (id, effect) in [("creep", creep(None, CreepLaw::Exponential)), ("joint-friction", friction())] {
        let history = history(Some(effect), 22.0, 1, in_sequence);
        let d = history.diagnosis();
        assert_eq!(
            (d.verdict, reported(&d)),
            (Verdict::Named, vec![id.to_owned()]),
            "{:?}",
            d.candidates.first()
        );
    }
    let d = history(None, 0.0, 1, in_sequence).diagnosis();
    assert_eq!((d.verdict, reported(&d).len()), (Verdict::Adequate, 0), "{:?}", d.findings);
}

#[test]
fn creep_is_named_whatever_the_age_of_the_preload_and_the_law() {
    for case in CREEP {
        case.said(&[22.0], 1).all_right(case.name);
    }
    clean(2).all_right("clean");
}

#[test]
fn play_is_named_whether_its_contact_is_hard_or_soft() {
    for width in [0.0, 5.0] {
        backlash(width, &[45.0], 2).all_right(&format!("{width} N"));
    }
}

#[test]
#[ignore = "a study of some minutes; SEEDS=8 for the usual size"]
fn study_of_histories() {
    let seeds: u64 = std::env::var("SEEDS").map_or(8, |s| s.parse().unwrap());
    for case in CREEP {
        println!("{}", case.said(&DISTANCES, seeds).line(case.name));
    }
    println!("{}", clean(3 * seeds).line("clean"));
    for width in [0.0, 1.0, 5.0, 20.0] {
        println!(
            "{}",
            backlash(width, &[22.0, 45.0, 90.0], seeds).line(&format!("play, contact of {width} N"))
        );
    }
    for id in ["metrology-drift", "thermal-expansion", "joint-friction", "leg-nonlinearity", "leg-asymmetry"]
    {
        println!("{}", other(id, 3 * seeds).line(id));
    }
}
