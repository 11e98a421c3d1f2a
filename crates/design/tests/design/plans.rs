//! Plans out of candidates: as good as enumeration, never beyond the budget, bounded by the approximate plan.

use hexbench_core::streams::{Purpose, stream};
use hexbench_design::exchange::bound::efficiency;
use hexbench_design::exchange::{Candidates, Exchange, ExchangedPlan};
use hexbench_design::{Criterion, DesignError, Objective};
use nalgebra::DMatrix;
use proptest::prelude::*;
use rand::RngExt;
use rand_pcg::Pcg64;

/// Values that agree to this share are one optimum, found by two ways of adding.
const ROUNDING: f64 = 1e-6;
/// The bound stops within 1e-4 of the approximate plan; the values here go through a root.
const BOUND_REACHED: f64 = 2e-4;

/// Random readings of two rows and three parameters at `poses` poses under two settings.
fn drawn(poses: usize, seed: u64, costs: [f64; 2], pose_cost: f64, budget: f64) -> Candidates {
    drawn_with(0, poses, seed, costs, pose_cost, budget)
}

/// The same with inputs known to a tolerance only beside the parameters.
fn drawn_with(
    inputs: usize,
    poses: usize,
    seed: u64,
    costs: [f64; 2],
    pose_cost: f64,
    budget: f64,
) -> Candidates {
    let mut rng = stream(seed, Purpose::Test, []);
    let mut information = || {
        let rows = DMatrix::from_fn(2, 3 + inputs, |_, _| rng.random_range(-1.0..1.0));
        rows.tr_mul(&rows)
    };
    let information = (0..2 * poses).map(|_| information()).collect();
    Candidates { information, costs: costs.into(), pose_cost, budget }
}

fn search(candidates: &Candidates, criterion: &Objective) -> Result<ExchangedPlan, DesignError> {
    Exchange::new(candidates, criterion).search(24, 1, &|| ())
}

fn value(candidates: &Candidates, criterion: &Objective, members: &[usize]) -> f64 {
    criterion.value(&candidates.sum(members), 1)
}

/// The best value of all plans of ascending members that spend the budget: no reading can be added to them.
fn enumerated(candidates: &Candidates, criterion: &Objective, members: &mut Vec<usize>) -> f64 {
    let affords = |k: usize| {
        let more: Vec<usize> = members.iter().copied().chain([k]).collect();
        candidates.cost_of(&more) <= candidates.budget
    };
    let affordable: Vec<usize> = (0..candidates.information.len()).filter(|&k| affords(k)).collect();
    if affordable.is_empty() {
        return value(candidates, criterion, members);
    }
    let last = members.last().copied().unwrap_or(0);
    let mut best = 0.0_f64;
    for k in affordable.into_iter().filter(|&k| k >= last) {
        members.push(k);
        best = best.max(enumerated(candidates, criterion, members));
        members.pop();
    }
    best
}

fn all() -> Vec<Objective> {
    use Criterion::{A, D, E, I, O1, O2, O3, O4, O5};
    let all = [O1, O2, O3, O4, O5, D, A, E, I(DMatrix::from_diagonal_element(3, 3, 0.5))];
    all.map(Objective::from).to_vec()
}

#[test]
fn every_criterion_reaches_the_best_of_all_plans_of_five_readings() {
    let candidates = drawn(4, 3, [1.0, 1.0], 0.0, 5.0);
    for criterion in all() {
        let best = enumerated(&candidates, &criterion, &mut Vec::new());
        let found = value(&candidates, &criterion, &search(&candidates, &criterion).unwrap().members);
        assert!(found >= best * (1.0 - ROUNDING), "{}: {found} of {best}", criterion.criterion().name());
    }
}

#[test]
fn a_budget_in_time_is_spent_as_well_as_by_enumeration() {
    for seed in 0..6 {
        let candidates = drawn(4, seed, [2.0, 3.0], 4.0, 21.0);
        let best = enumerated(&candidates, &Objective::from(Criterion::D), &mut Vec::new());
        let plan = search(&candidates, &Objective::from(Criterion::D)).unwrap();
        let found = value(&candidates, &Objective::from(Criterion::D), &plan.members);
        assert!(found >= best * (1.0 - ROUNDING), "seed {seed}: {found} of {best}");
    }
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let candidates = drawn(30, 5, [2.0, 3.0], 10.0, 120.0);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| search(&candidates, &Objective::from(Criterion::A)).unwrap())
    };
    assert_eq!(on(1), on(3));
}

/// Kiefer and Wolfowitz 1960: three points -1, 0, 1 with equal weights are the best approximate plan of a quadratic.
#[test]
fn the_best_approximate_plan_has_efficiency_one_and_a_worse_one_its_own() {
    let row = |x: f64| DMatrix::from_row_slice(1, 3, &[1.0, x, x * x]);
    let rows: Vec<_> = (-10..=10).map(|i| row(f64::from(i) / 10.0)).collect();
    let candidates = Candidates::of_rows(&rows, 6);
    let [a, b, c] = [0, 10, 20];
    let of = |members: &[usize]| efficiency(&candidates, &Objective::from(Criterion::D), members).unwrap();
    let best = of(&[a, a, b, b, c, c]);
    assert!((1.0 - best).abs() < BOUND_REACHED, "{best}");
    // Determinants are as the products of the counts: 3 * 2 * 1 against 2 * 2 * 2.
    let worse = of(&[a, a, a, b, b, c]);
    assert!((worse - (6.0_f64 / 8.0).cbrt()).abs() < BOUND_REACHED, "{worse}");
}

/// Six readings of three parameters one by one: two each is best for E, though the smallest eigenvalue is a triple one there.
#[test]
fn the_bound_of_the_smallest_eigenvalue_is_close_where_eigenvalues_meet() {
    /// `ln 3` over the sharpness of the smooth minimum, and what the moves leave.
    const CLOSE: f64 = 0.01;
    let axis = |k: usize| DMatrix::from_fn(1, 3, |_, j| if j == k { 1.0 } else { 0.0 });
    let candidates = Candidates::of_rows(&[axis(0), axis(1), axis(2)], 6);
    for criterion in [Objective::from(Criterion::E), Objective::from(Criterion::O3)] {
        let best = efficiency(&candidates, &criterion, &[0, 0, 1, 1, 2, 2]).unwrap();
        assert!(best > 1.0 - CLOSE, "{}: {best}", criterion.criterion().name());
        let half = efficiency(&candidates, &criterion, &[0, 0, 0, 1, 1, 2]).unwrap();
        assert!((half - 0.5).abs() < CLOSE, "{}: {half}", criterion.criterion().name());
    }
}

/// Inputs beside the parameters of a plan.
const INPUTS: usize = 2;

#[test]
fn plans_by_inexact_inputs_reach_the_best_of_all_plans_and_keep_the_bound() {
    let candidates = drawn_with(INPUTS, 4, 3, [1.0, 1.0], 0.0, 6.0);
    for criterion in all() {
        let criterion = criterion.with_inputs(INPUTS);
        let name = criterion.criterion().name();
        let best = enumerated(&candidates, &criterion, &mut Vec::new());
        let plan = search(&candidates, &criterion).unwrap();
        let found = value(&candidates, &criterion, &plan.members);
        assert!(found >= best * (1.0 - ROUNDING), "{name}: {found} of {best}");
        let Some(whole) = efficiency(&candidates, &criterion, &plan.members) else { continue };
        // Four readings do what they do with two thirds of the budget: no bound may ask for more.
        let few = drawn_with(INPUTS, 4, 3, [1.0, 1.0], 0.0, 4.0);
        let part = efficiency(&candidates, &criterion, &search(&few, &criterion).unwrap().members).unwrap();
        assert!(part <= 4.0 / 6.0 + BOUND_REACHED && part > 0.3, "{name}: {part}");
        assert!(whole > part && whole <= 1.0, "{name}: {whole} {part}");
    }
}

#[test]
fn inputs_that_nothing_shows_change_no_plan() {
    let exact = drawn(8, 3, [1.0, 1.0], 0.0, 6.0);
    let mut beside = exact.clone();
    for information in &mut beside.information {
        *information = information.clone().resize(3 + INPUTS, 3 + INPUTS, 0.0);
    }
    for criterion in all() {
        let plans = [
            search(&exact, &criterion).unwrap(),
            search(&beside, &criterion.clone().with_inputs(INPUTS)).unwrap(),
        ];
        assert_eq!(plans[0].members, plans[1].members, "{}", criterion.criterion().name());
    }
}

#[test]
fn ratios_of_eigenvalues_have_no_bound() {
    let candidates = drawn(4, 3, [1.0, 1.0], 0.0, 5.0);
    for criterion in [Objective::from(Criterion::O2), Objective::from(Criterion::O4)] {
        assert!(efficiency(&candidates, &criterion, &[0, 1, 2, 3, 4]).is_none());
    }
}

/// A plan drawn at random that nothing more can be added to by chance.
fn random_plan(candidates: &Candidates, rng: &mut Pcg64) -> Vec<usize> {
    let mut members: Vec<usize> = Vec::new();
    while candidates.cost_of(&members) <= candidates.budget {
        members.push(rng.random_range(0..candidates.information.len()));
    }
    members.pop();
    members
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_plan_exceeds_its_budget_or_its_bound_and_none_drawn_is_better(
        seed in 0_u64..1000,
        costs in prop::array::uniform2(1.0..5.0_f64),
        pose_cost in 0.0..8.0_f64,
        budget in 40.0..80.0_f64,
    ) {
        let candidates = drawn(8, seed, costs, pose_cost, budget);
        let plan = search(&candidates, &Objective::from(Criterion::D)).unwrap();
        let cost = candidates.cost_of(&plan.members);
        prop_assert!(cost <= budget * (1.0 + 1e-9), "{cost} of {budget}");
        let found = value(&candidates, &Objective::from(Criterion::D), &plan.members);
        let mut rng = stream(seed, Purpose::Test, []);
        for _ in 0..200 {
            let drawn = random_plan(&candidates, &mut rng);
            let worth = value(&candidates, &Objective::from(Criterion::D), &drawn);
            prop_assert!(worth <= found * (1.0 + ROUNDING), "drawn {worth}, found {found}");
        }
        // The bound is the same one whichever plan it is approached from.
        let drawn = random_plan(&candidates, &mut rng);
        let bounds = [&plan.members, &drawn].map(|members| {
            value(&candidates, &Objective::from(Criterion::D), members)
                / efficiency(&candidates, &Objective::from(Criterion::D), members).unwrap()
        });
        prop_assert!(found <= bounds[0] * (1.0 + ROUNDING) && (bounds[0] / bounds[1] - 1.0).abs() < 1e-3, "{bounds:?}");
    }
}
