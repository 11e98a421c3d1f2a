//! Sensors out of candidates: what each tells, and the best sets.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use hexbench_core::files::{read_hexapod, read_plan};
use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Hexapod, SensorKind, Vector3};
use hexbench_design::power::{EffectSizes, Example, Planned, PowerSettings, Reference, study};
use hexbench_design::sensors::{
    CandidateSensor, Found, Goal, Limits, Offer, SensorSearch, Sought, read_candidates,
};
use hexbench_design::{Criterion, DesignError, nominal};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::linearization::{Linearization, ModelPoint};
use hexbench_model::estimation::noise::stated_or_repeated;
use hexbench_model::estimation::nuisance::marginal;
use hexbench_model::estimation::tolerances::within_tolerances_at;
use hexbench_model::terms::catalogue;
use nalgebra::{DMatrix, DVector};
use rand::RngExt;

/// Values of the same set, computed in two orders.
const ROUNDING: f64 = 1e-9;
/// Combinations of inputs that do not show are left out: 1e-4 of a variance.
const LEFT_OUT: f64 = 1e-3;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A machine with a plan of several poses and loads.
fn bench() -> (Hexapod, Dataset) {
    let case = root().join("data/cases/mujoco-clean");
    let plan = read_plan(&case.join("measurements.csv"), None).unwrap().dataset;
    (read_hexapod(&case.join("hexapod.toml")).unwrap(), plan)
}

/// Gauges on a ring, up, along and outwards, two balls and a level.
fn candidates() -> Vec<CandidateSensor> {
    candidates_of(
        "[[ring]]\nname = \"rim\"\nradius_mm = 140\nheight_mm = 30\ncount = 7\n\
         directions = [\"radial\", \"tangential\", [0, 0, 1]]\nsigma_um = 0.3\n\
         [[ring]]\nname = \"ball\"\nkind = \"point\"\nradius_mm = 120\ncount = 2\nsigma_um = 0.8\ncost = 3\n\
         [[sensor]]\nname = \"level\"\nkind = \"inclination\"\naxis = [1, 0, 0]\nsigma_urad = 2\ncost = 2\n",
    )
}

fn candidates_of(tables: &str) -> Vec<CandidateSensor> {
    read(tables).unwrap()
}

fn read(tables: &str) -> Result<Vec<CandidateSensor>, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("candidates.toml");
    std::fs::write(&path, format!("format = \"sensor-candidates/1\"\n{tables}")).unwrap();
    read_candidates(&path).map_err(|e| format!("{e} next: {}", e.next_step()))
}

fn offer(hexapod: &Hexapod, plan: &Dataset, all: &[CandidateSensor]) -> Offer {
    Offer::of(hexapod, plan, nominal::compliance(hexapod), &[], all).unwrap()
}

fn number(number: usize) -> Limits {
    Limits { number, budget: None }
}

#[test]
fn what_candidates_tell_is_what_a_campaign_read_by_them_tells() {
    let (hexapod, plan) = bench();
    let all = candidates();
    let offer = offer(&hexapod, &plan, &all);
    let members = [0, 4, 9, 12, 17, 21, 23];
    let sum = marginal(&offer.sum(&members), 6);

    let sensors = members.iter().map(|&k| all[k].sensor.clone()).collect();
    let machine = Hexapod { sensors, ..hexapod };
    let rows = plan.to_be_read_by(&machine.sensors);
    let noise = stated_or_repeated(&machine, &rows).unwrap();
    let campaign = Campaign::with_noise(&machine, &rows, noise).unwrap();
    let springs = nominal::compliance(&machine);
    let point = ModelPoint { compliances: springs, ..ModelPoint::start(&campaign) };
    let lin = Linearization::at(&within_tolerances_at(campaign, &point), &point).unwrap();
    let j = lin.common_block() * DMatrix::from_diagonal(&DVector::from_column_slice(springs.as_slice()));
    let whole = j.tr_mul(&j);
    let off = (&sum - &whole).amax() / whole.amax();
    assert!(off < LEFT_OUT, "off by {off}");
    // Tolerances count: exact inputs tell far more.
    let exact = offer.sum(&members).view((0, 0), (6, 6)).into_owned();
    assert!((exact - &whole).amax() > 0.1 * whole.amax());
}

#[test]
fn sensors_of_the_machine_stay_and_count() {
    let (hexapod, plan) = bench();
    let all = candidates();
    let with_level = Hexapod { sensors: vec![all[23].sensor.clone()], ..hexapod.clone() };
    let alone = offer(&hexapod, &plan, &all).sum(&[0, 1, 23]);
    let beside = offer(&with_level, &plan, &all[..23]).sum(&[0, 1]);
    let [alone, beside] = [alone, beside].map(|m| marginal(&m, 6));
    assert!((&alone - beside).amax() < LEFT_OUT * alone.amax());
}

/// The best value by exchange and by enumeration.
fn both(offer: &Offer, goal: &Goal, limits: Limits) -> [f64; 2] {
    let search = SensorSearch::new(offer, goal).unwrap();
    let (best, how) = search.enumerate(limits).unwrap();
    let (found, _) = search.exchange(limits, 24, 1).unwrap();
    assert!(matches!(how, Found::OfAll(sets) if sets > 50), "{how:?}");
    let cost: f64 = found.members.iter().map(|&k| offer.costs[k]).sum();
    assert!(found.members.len() <= limits.number && limits.budget.is_none_or(|most| cost <= most + 1e-9));
    assert!(found.members.is_sorted_by(|a, b| a < b), "{:?}", found.members);
    [found.value, best.value]
}

fn assert_same(values: [f64; 2], what: &str) {
    let [found, best] = values;
    assert!((found / best - 1.0).abs() < ROUNDING, "{what}: {found} by exchange, {best} by enumeration");
}

#[test]
fn exchange_finds_what_enumeration_finds_for_gauges_balls_and_a_level() {
    let (hexapod, plan) = bench();
    let offer = offer(&hexapod, &plan, &candidates());
    for criterion in [Criterion::D, Criterion::O1, Criterion::A, Criterion::I(()), Criterion::E] {
        let goal = Goal::Fit(offer.objective(criterion));
        for n in [3, 4] {
            assert_same(both(&offer, &goal, number(n)), criterion.name());
        }
    }
}

#[test]
fn exchange_finds_what_enumeration_finds_for_rows_at_random() {
    let mut rng = stream(7, Purpose::Test, []);
    let rows: Vec<DMatrix<f64>> =
        (0..18).map(|_| DMatrix::from_fn(2, 5, |_, _| rng.random_range(-1.0..1.0))).collect();
    let offer = Offer::of_rows(&rows);
    for criterion in [Criterion::D, Criterion::A, Criterion::O2] {
        let goal = Goal::Fit(offer.objective(criterion));
        for n in [4, 6] {
            assert_same(both(&offer, &goal, number(n)), criterion.name());
        }
    }
}

#[test]
fn exchange_finds_what_enumeration_finds_within_a_budget() {
    let mut rng = stream(8, Purpose::Test, []);
    for seed in 0..4 {
        let rows: Vec<DMatrix<f64>> =
            (0..14).map(|_| DMatrix::from_fn(1, 3, |_, _| rng.random_range(-1.0..1.0))).collect();
        let mut offer = Offer::of_rows(&rows);
        offer.costs = (0..14).map(|_| rng.random_range(1.0..5.0)).collect();
        for criterion in [Criterion::D, Criterion::A] {
            let goal = Goal::Fit(offer.objective(criterion));
            let limits = Limits { number: 6, budget: Some(10.0) };
            assert_same(both(&offer, &goal, limits), &format!("{} {seed}", criterion.name()));
        }
    }
}

/// Base compliance, softer along one axis at a time.
fn soft_base() -> EffectSizes {
    let term = catalogue().into_iter().find(|t| t.info().id == "base-compliance").unwrap();
    let example = |k: usize| {
        let sizes = [2e-8, 2e-8, 2e-8, 1e-6, 1e-6, 1e-6];
        Example { values: (0..6).map(|i| if i == k { sizes[i] } else { 0.0 }).collect(), shape: 1.0 }
    };
    EffectSizes {
        term: Arc::clone(&term),
        examples: (0..6).map(example).collect(),
        reference: Reference::Usual,
    }
}

#[test]
fn sensors_chosen_to_see_an_effect_see_smaller_ones_than_those_of_criterion_d() {
    let (hexapod, plan) = bench();
    let (all, effect) = (candidates(), soft_base());
    let springs = nominal::compliance(&hexapod);
    let with_effect = Offer::of(&hexapod, &plan, springs, &[Sought::term(&effect)], &all).unwrap();
    let see = Goal::See(Sought::of(&effect, &with_effect));
    assert_same(both(&with_effect, &see, number(4)), "base-compliance");
    let alone = offer(&hexapod, &plan, &all);
    let fit = Goal::Fit(alone.objective(Criterion::D));
    let chosen = |offer: &Offer, goal: &Goal| {
        SensorSearch::new(offer, goal).unwrap().best(number(4), 24, 1).unwrap().0.members
    };
    let seen_from = |members: &[usize]| {
        let sensors = members.iter().map(|&k| all[k].sensor.clone()).collect();
        let machine = Hexapod { sensors, ..hexapod.clone() };
        let rows = plan.to_be_read_by(&machine.sensors);
        let noise = stated_or_repeated(&machine, &rows).unwrap();
        let planned = Planned::new(&machine, &rows, springs, noise).unwrap();
        study(&planned, vec![effect.clone()], PowerSettings::default()).unwrap().effects[0].seen_at.least
    };
    let [to_see, to_fit] = [chosen(&with_effect, &see), chosen(&alone, &fit)];
    // A mean of squares over effects of all directions: of the study's examples, the one that stands out most has the largest part in it.
    let value = |members: &[usize]| SensorSearch::new(&with_effect, &see).unwrap().value(members).unwrap();
    assert!(value(&to_see) > 1.1 * value(&to_fit), "{to_see:?}, by criterion D {to_fit:?}");
    let [from_seen, from_fit] = [&to_see, &to_fit].map(|members| seen_from(members));
    assert!(
        from_seen < from_fit,
        "seen from {from_seen} by {to_see:?}, by criterion D from {from_fit} by {to_fit:?}"
    );
}

#[test]
fn one_sensor_more_never_tells_less() {
    let (hexapod, plan) = bench();
    let offer = offer(&hexapod, &plan, &candidates());
    for criterion in [Criterion::D, Criterion::O1, Criterion::A, Criterion::I(())] {
        let goal = Goal::Fit(offer.objective(criterion));
        let search = SensorSearch::new(&offer, &goal).unwrap();
        let values: Vec<f64> = (2..7).map(|n| search.best(number(n), 8, 1).unwrap().0.value).collect();
        assert!(values.is_sorted(), "{}: {values:?}", criterion.name());
    }
}

#[test]
fn candidates_that_determine_nothing_are_told_and_how_many_are_enough() {
    let row = |k: usize| DMatrix::from_fn(1, 3, |_, i| if i == k { 1.0 } else { 0.0 });
    let same = Offer::of_rows(&[row(0), row(1), row(0)]);
    let goal = Goal::Fit(same.objective(Criterion::D));
    let refused = SensorSearch::new(&same, &goal).err();
    let Some(DesignError::SensorsNeverDetermine { candidates: 3, names }) = refused else {
        panic!("{refused:?}")
    };
    assert_eq!(names, ["3"]);
    let enough = Offer::of_rows(&[row(0), row(1), row(2), row(2)]);
    let goal = Goal::Fit(enough.objective(Criterion::D));
    let search = SensorSearch::new(&enough, &goal).unwrap();
    assert!(search.best(number(2), 4, 1).is_none());
    assert_eq!(search.enough(number(2), 3, 4, 1), Some(3));
}

#[test]
fn rings_and_faces_make_sensors_at_their_points() {
    let all = candidates_of(
        "[[ring]]\nname = \"rim\"\nradius_mm = 100\nheight_mm = 20\ncount = 4\nstart_deg = 90\n\
         directions = [\"radial\", \"tangential\"]\nsigma_um = 0.3\ncost = 2\n\
         [[face]]\nname = \"top\"\ncorner_mm = [0, 0, 50]\nedges_mm = [[10, 0, 0], [0, 20, 0]]\ncounts = [2, 1]\n\
         directions = [\"normal\"]\nsigma_um = 0.5\n\
         [[ring]]\nname = \"ball\"\nkind = \"point\"\nradius_mm = 80\ncount = 3\nsigma_um = 0.6\n",
    );
    let names: Vec<&str> = all.iter().map(|c| c.sensor.name.as_str()).collect();
    let rim = ["rim1a", "rim1b", "rim2a", "rim2b", "rim3a", "rim3b", "rim4a", "rim4b"];
    assert_eq!(names, [&rim[..], &["ball1", "ball2", "ball3", "top1", "top2"]].concat());
    let at = |k: usize| match all[k].sensor.kind {
        SensorKind::Distance { point, direction, sigma } => (point, direction, sigma),
        _ => panic!("{:?}", all[k]),
    };
    let is = |a: Vector3, b: [f64; 3]| (a - Vector3::from(b)).norm() < 1e-15;
    let ((p, radial, _), (_, tangential, _)) = (at(0), at(1));
    assert!(is(p, [0.0, 0.1, 0.02]) && is(radial, [0.0, 1.0, 0.0]) && is(tangential, [-1.0, 0.0, 0.0]));
    assert!(all[0].cost.total_cmp(&2.0).is_eq() && all[11].cost.total_cmp(&1.0).is_eq());
    let (p, normal, sigma) = at(12);
    assert!(is(p, [0.01, 0.01, 0.05]) && is(normal, [0.0, 0.0, 1.0]) && sigma < 0.51e-6);
}

#[test]
fn files_of_candidates_are_refused_with_what_to_write() {
    const RING: &str = "[[ring]]\nname = \"r\"\nradius_mm = 100\ncount = 3\nsigma_um = 1\n";
    let cases = [
        (String::new(), "[[ring]]"),
        (RING.to_owned(), "directions"),
        (format!("{RING}directions = [\"sideways\"]\n"), "Write radial, tangential or three numbers"),
        (format!("{RING}directions = [[0, 0, 0]]\n"), "[0, 0, 1]"),
        (format!("{RING}directions = []\n"), "1 to 26 directions"),
        (format!("{RING}kind = \"point\"\ndirections = [\"radial\"]\n"), "Remove the key"),
        (format!("{RING}kind = \"inclination\"\n"), "distance or point"),
        (format!("{RING}kind = \"point\"\ncost = 0\n"), "a cost"),
        (format!("{RING}kind = \"point\"\n{RING}kind = \"point\"\n"), "a name of its own"),
        (
            "[[face]]\nname = \"f\"\ncorner_mm = [0, 0, 0]\nedges_mm = [[1, 0, 0], [2, 0, 0]]\ncounts = [2, 2]\n\
             directions = [\"normal\"]\nsigma_um = 1\n"
                .to_owned(),
            "parallel",
        ),
        ("[[sensor]]\nname = \"g\"\nkind = \"distance\"\nsigma_um = 1\n".to_owned(), "point_mm"),
    ];
    for (tables, says) in cases {
        let told = read(&tables).unwrap_err();
        assert!(told.contains(says), "{tables}\n{told}");
    }
}
