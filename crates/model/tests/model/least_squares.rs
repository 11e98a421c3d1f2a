//! The least-squares core against certified problems, and on systems that do not determine their unknowns.

use hexbench_model::error::ModelError;
use hexbench_model::estimation::lsq::{Triangle, solve};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use serde_json::Value;

use crate::common::random::Random;

/// NIST certifies 15 digits; more agreement means nothing.
const CERTIFIED_DIGITS: f64 = 15.0;
/// Sums of a few hundred products of numbers of size one through a matrix of condition number below 1e3.
const ROUNDING: f64 = 1e3 * 300.0 * f64::EPSILON;

/// A certified problem.
struct Certified {
    name: &'static str,
    x: DMatrix<f64>,
    y: DVector<f64>,
    estimates: Vec<f64>,
    standard_errors: Vec<f64>,
    residual_sd: f64,
}

/// Form of the regressor of one row.
type Design = fn(&[f64]) -> Vec<f64>;

fn line(x: &[f64]) -> Vec<f64> {
    vec![1.0, x[0]]
}
fn quadratic(x: &[f64]) -> Vec<f64> {
    powers(x[0], 2)
}
fn through_origin(x: &[f64]) -> Vec<f64> {
    vec![x[0]]
}
fn fifth(x: &[f64]) -> Vec<f64> {
    powers(x[0], 5)
}
fn tenth(x: &[f64]) -> Vec<f64> {
    powers(x[0], 10)
}
fn affine(x: &[f64]) -> Vec<f64> {
    std::iter::once(1.0).chain(x.iter().copied()).collect()
}
fn powers(x: f64, degree: i32) -> Vec<f64> {
    (0..=degree).map(|k| x.powi(k)).collect()
}

fn parse(name: &'static str, text: &str, design: Design) -> Certified {
    let numbers =
        |line: &str| -> Vec<f64> { line.split_whitespace().filter_map(|w| w.parse().ok()).collect() };
    let is_parameter = |line: &&str| {
        let word = line.split_whitespace().next().unwrap_or("");
        word.strip_prefix('B').is_some_and(|d| d.parse::<u32>().is_ok()) && numbers(line).len() == 2
    };
    let certified: Vec<Vec<f64>> = text.lines().take(60).filter(is_parameter).map(numbers).collect();
    let after =
        text.lines().skip_while(|l| !l.contains("Residual")).find(|l| l.contains("Standard Deviation"));
    let rows: Vec<Vec<f64>> = text.lines().skip(60).map(numbers).filter(|row| row.len() >= 2).collect();
    let designs: Vec<Vec<f64>> = rows.iter().map(|row| design(&row[1..])).collect();
    let width = designs[0].len();
    assert_eq!(certified.len(), width, "{name}");
    Certified {
        name,
        x: DMatrix::from_fn(rows.len(), width, |i, j| designs[i][j]),
        y: DVector::from_fn(rows.len(), |i, _| rows[i][0]),
        estimates: certified.iter().map(|c| c[0]).collect(),
        standard_errors: certified.iter().map(|c| c[1]).collect(),
        residual_sd: numbers(after.unwrap())[0],
    }
}

/// Correct digits: minus the logarithm of the relative (for zero: absolute) error, at most those certified.
fn digits(found: f64, certified: f64) -> f64 {
    let error = if certified == 0.0 { found.abs() } else { (found / certified - 1.0).abs() };
    (-error.max(1e-300).log10()).clamp(0.0, CERTIFIED_DIGITS)
}

fn worst(found: impl Iterator<Item = f64>, certified: &[f64]) -> f64 {
    found.zip(certified).map(|(f, c)| digits(f, *c)).fold(f64::INFINITY, f64::min)
}

/// Correct digits of parameters, standard errors and residual standard deviation.
fn achieved(problem: &Certified) -> [f64; 3] {
    let solution = solve(&problem.x, &problem.y).unwrap();
    let n = problem.estimates.len();
    assert_eq!(solution.rank, n, "{}", problem.name);
    let dof = (problem.y.len() - n) as f64;
    let sd = (solution.rss / dof).sqrt();
    let ratio = solution.rss.sqrt() / (&problem.x * &solution.x).norm();
    println!("{}: condition {:.1e}, |r| / |A x| {ratio:.1e}", problem.name, solution.condition());
    let errors = (0..n).map(|k| sd * solution.covariance[(k, k)].sqrt());
    [
        worst(solution.x.iter().copied(), &problem.estimates),
        worst(errors, &problem.standard_errors),
        digits(sd, problem.residual_sd),
    ]
}

/// Demanded digits: of parameters `[0]`, of standard errors `[1]`, of the residual standard deviation `[2]`.
///
/// An orthogonal solution errs by `eps (kappa + kappa^2 |r| / |A x|)`, relative, with `kappa` the condition number of
/// the column-scaled regressor. The Wampler sets (kappa 2e3) differ in their residuals only: |r| / |A x| is 0, 0, 2e-3,
/// 0.2 and 20, and the digits fall in step. Longley has kappa 4e4 (intercept and year), and one parameter whose value
/// is a fifth of its standard error. Filip has kappa 5e9, and its powers of x already carry half an eps each: even an
/// exact solution of the rounded regressor has 7 to 8 digits only.
macro_rules! certified {
    ($test:ident, $file:literal, $design:expr, $demanded:expr) => {
        #[test]
        fn $test() {
            let text = include_str!(concat!("../reference/nist/", $file, ".dat"));
            let found = achieved(&parse($file, text, $design));
            let demanded: [f64; 3] = $demanded;
            println!("{}: {found:.1?} digits (parameters, standard errors, residual sd)", $file);
            for k in 0..3 {
                assert!(found[k] >= demanded[k], "{}: {found:.1?} digits, demanded {demanded:?}", $file);
            }
        }
    };
}

certified!(norris_is_solved_to_the_demanded_digits, "Norris", line, [12.0, 12.0, 12.0]);
certified!(pontius_is_solved_to_the_demanded_digits, "Pontius", quadratic, [11.0, 11.0, 11.0]);
certified!(noint1_is_solved_to_the_demanded_digits, "NoInt1", through_origin, [13.0, 13.0, 13.0]);
certified!(noint2_is_solved_to_the_demanded_digits, "NoInt2", through_origin, [13.0, 13.0, 13.0]);
certified!(longley_is_solved_to_the_demanded_digits, "Longley", affine, [11.0, 10.0, 11.0]);
certified!(wampler1_is_solved_to_the_demanded_digits, "Wampler1", fifth, [9.0, 9.0, 9.0]);
certified!(wampler2_is_solved_to_the_demanded_digits, "Wampler2", fifth, [9.0, 9.0, 9.0]);
certified!(wampler3_is_solved_to_the_demanded_digits, "Wampler3", fifth, [9.0, 11.0, 12.0]);
certified!(wampler4_is_solved_to_the_demanded_digits, "Wampler4", fifth, [8.0, 11.0, 12.0]);
certified!(wampler5_is_solved_to_the_demanded_digits, "Wampler5", fifth, [6.0, 11.0, 12.0]);
certified!(filip_is_solved_to_the_demanded_digits, "Filip", tenth, [7.0, 7.0, 8.0]);

fn weighted_lines() -> Value {
    serde_json::from_str(include_str!("../reference/gum/weighted_lines.json")).unwrap()
}

fn numbers(value: &Value) -> DVector<f64> {
    DVector::from_vec(value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect())
}

/// Straight line `a + b x`, rows divided by the uncertainty of y: `[a, b, var a, var b, cov, chi2]`.
fn weighted_line(x: &DVector<f64>, y: &DVector<f64>, u: &DVector<f64>) -> [f64; 6] {
    let rows = DMatrix::from_fn(x.len(), 2, |i, j| if j == 0 { 1.0 } else { x[i] } / u[i]);
    let s = solve(&rows, &y.component_div(u)).unwrap();
    [s.x[0], s.x[1], s.covariance[(0, 0)], s.covariance[(1, 1)], s.covariance[(0, 1)], s.rss]
}

/// Compare with printed values: half a unit of the last printed digit, given by `decimals`.
fn assert_printed(what: &str, found: f64, printed: &Value, decimals: i32) {
    let (printed, unit) = (printed.as_f64().unwrap(), 10f64.powi(-decimals));
    assert!((found - printed).abs() <= 0.51 * unit, "{what}: {found} for {printed}");
}

#[test]
fn weighted_lines_of_iso_28037_come_out_to_the_printed_digits() {
    let table = weighted_lines();
    for (name, decimals, chi_decimals) in [("wls1", 6, 3), ("wls2", 3, 3)] {
        let case = &table[name];
        let f = weighted_line(&numbers(&case["x"]), &numbers(&case["y"]), &numbers(&case["u_y"]));
        assert_printed(name, f[0], &case["a"], if name == "wls1" { 6 } else { 4 });
        assert_printed(name, f[1], &case["b"], decimals);
        assert_printed(name, f[2].sqrt(), &case["u_a"], 7);
        assert_printed(name, f[3].sqrt(), &case["u_b"], if name == "wls1" { 7 } else { 6 });
        assert_printed(name, f[4], &case["cov_ab"], 8);
        assert_printed(name, f[5], &case["chi2"], chi_decimals);
    }
}

#[test]
fn pearson_and_york_with_weights_on_y_come_out_to_the_printed_digits() {
    let case = &weighted_lines()["pearson_york_y_weights"];
    let u = numbers(&case["w_y"]).map(|w: f64| w.sqrt().recip());
    let f = weighted_line(&numbers(&case["x"]), &numbers(&case["y"]), &u);
    assert_printed("a", f[0], &case["a"], 4);
    assert_printed("b", f[1], &case["b"], 4);
    assert_printed("var a", f[2], &case["var_a"], 9);
    assert_printed("var b", f[3], &case["var_b"], 10);
    assert_printed("cov", f[4], &case["cov_ab"], 9);
}

#[test]
fn the_thermometer_of_the_gum_is_calibrated_to_the_computed_digits() {
    const DIGITS: f64 = 1e-11;
    let case = &weighted_lines()["gum_H3_thermometer"];
    let t = numbers(&case["t"]).add_scalar(-case["t0"].as_f64().unwrap());
    let f = weighted_line(&t, &numbers(&case["b"]), &DVector::repeat(t.len(), 1.0));
    let s = (f[5] / (t.len() - 2) as f64).sqrt();
    let at_30 = 10.0;
    let variance_30 = f[2] + at_30 * (2.0 * f[4] + at_30 * f[3]);
    for (key, found) in [
        ("intercept", f[0]),
        ("slope", f[1]),
        ("u_intercept", s * f[2].sqrt()),
        ("u_slope", s * f[3].sqrt()),
        ("corr", f[4] / (f[2] * f[3]).sqrt()),
        ("b30", f[0] + at_30 * f[1]),
        ("u_b30", s * variance_30.sqrt()),
    ] {
        let error = (found / case[key].as_f64().unwrap() - 1.0).abs();
        assert!(error < DIGITS, "{key}: {error:.1e}");
    }
}

/// A matrix of given rank, and a right-hand side. Elements of size one.
fn deficient(rows: usize, columns: usize, rank: usize, seed: u64) -> (DMatrix<f64>, DVector<f64>) {
    let mut random = Random::new(seed);
    let left = DMatrix::from_fn(rows, rank, |_, _| random.normal());
    let right = DMatrix::from_fn(rank, columns, |_, _| random.normal());
    (left * right, DVector::from_fn(rows, |_, _| random.normal()))
}

#[test]
fn undetermined_combinations_are_orthonormal_annihilated_and_complete() {
    for (rows, columns, rank) in [(30, 8, 5), (12, 12, 7), (4, 9, 4), (5, 9, 3), (1, 6, 1), (20, 6, 6)] {
        let (a, y) = deficient(rows, columns, rank, 7 + rows as u64);
        let s = solve(&a, &y).unwrap();
        assert_eq!((s.rank, s.null_space.ncols()), (rank, columns - rank), "{rows}x{columns} of rank {rank}");
        let gram = s.null_space.tr_mul(&s.null_space);
        let skew = (gram - DMatrix::identity(columns - rank, columns - rank))
            .abs()
            .iter()
            .fold(0.0, |m, x| x.max(m));
        assert!(skew < ROUNDING, "not orthonormal by {skew:.1e}");
        // In scaled parameters: columns of A divided by their norms.
        let scaled = DMatrix::from_fn(rows, columns, |i, j| a[(i, j)] / s.column_norms[j]);
        let left = (scaled * &s.null_space).norm();
        assert!(left < ROUNDING, "not annihilated by {left:.1e}");
        let shares: f64 = (0..columns).map(|k| s.undetermined_share(k).powi(2)).sum();
        assert!((shares - (columns - rank) as f64).abs() < ROUNDING, "shares sum to {shares}");
        assert_eq!(s.condition().is_finite(), rank == columns);
    }
}

#[test]
fn an_undetermined_system_gets_its_shortest_solution_in_scaled_parameters() {
    for (rows, columns, rank) in [(30, 8, 5), (4, 9, 4), (5, 9, 3)] {
        let (a, y) = deficient(rows, columns, rank, 31 + rows as u64);
        let s = solve(&a, &y).unwrap();
        let scaled = s.x.component_mul(&s.column_norms);
        let along = s.null_space.tr_mul(&scaled).norm() / scaled.norm();
        assert!(along < ROUNDING, "solution along the null space: {along:.1e}");
        // Normal equations hold.
        let gradient = a.tr_mul(&(&a * &s.x - &y)).norm() / (a.norm() * y.norm());
        assert!(gradient < ROUNDING, "gradient {gradient:.1e}");
    }
}

#[test]
fn a_parameter_no_row_depends_on_is_undetermined_and_the_others_are_not() {
    let (mut a, y) = deficient(20, 5, 5, 3);
    a.column_mut(2).fill(0.0);
    let s = solve(&a, &y).unwrap();
    let shares: Vec<f64> = (0..5).map(|k| s.undetermined_share(k)).collect();
    assert_eq!(s.rank, 4);
    assert!((shares[2] - 1.0).abs() < ROUNDING && s.x[2].abs() < ROUNDING, "{shares:?}, x = {}", s.x[2]);
    assert!([0, 1, 3, 4].iter().all(|&k| shares[k] < ROUNDING), "{shares:?}");
}

#[test]
fn two_parameters_with_the_same_column_are_undetermined_in_their_difference() {
    let (mut a, y) = deficient(20, 4, 4, 5);
    let same = a.column(1) * 1e-6;
    a.set_column(3, &same);
    let s = solve(&a, &y).unwrap();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let found: Vec<f64> = (0..4).map(|k| s.undetermined_share(k)).collect();
    let expected = [0.0, half, 0.0, half];
    assert!((0..4).all(|k| (found[k] - expected[k]).abs() < ROUNDING), "{found:?}");
}

#[test]
fn rank_and_solution_do_not_depend_on_the_units_of_the_parameters() {
    let (a, y) = deficient(25, 6, 6, 11);
    let units = DVector::from_vec(vec![1e-9, 1.0, 1e6, 1e-3, 1e12, 1e-12]);
    let other = DMatrix::from_fn(25, 6, |i, j| a[(i, j)] * units[j]);
    let (s, t) = (solve(&a, &y).unwrap(), solve(&other, &y).unwrap());
    assert_eq!((s.rank, t.rank), (6, 6));
    let error = (t.x.component_mul(&units) - &s.x).norm() / s.x.norm();
    assert!(error < ROUNDING, "{error:.1e}");
}

#[test]
fn numbers_that_are_not_finite_are_refused_at_once() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (a, y) = deficient(10, 4, 4, 2);
        let (mut bad_a, mut bad_y) = (a.clone(), y.clone());
        bad_a[(3, 2)] = bad;
        bad_y[9] = bad;
        for (a, y) in [(&bad_a, &y), (&a, &bad_y)] {
            assert!(matches!(solve(a, y), Err(ModelError::NotFinite { .. })));
        }
    }
}

#[test]
fn numbers_too_large_to_square_do_not_pass_as_a_solution() {
    let (a, y) = deficient(10, 4, 4, 2);
    let outcome = solve(&(a * 1e200), &y);
    let sound = outcome.as_ref().map_or(true, |s| s.x.iter().all(|x| x.is_finite()) && s.rank == 4);
    assert!(sound, "{outcome:?}");
}

#[test]
fn nothing_measured_is_an_error() {
    assert!(matches!(Triangle::new(3).solve(), Err(ModelError::TooFewEquations { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn rows_in_pieces_give_what_rows_at_once_give(
        seed in 0_u64..1000, columns in 1_usize..8, cuts in prop::collection::vec(1_usize..12, 1..6),
    ) {
        let rows: usize = cuts.iter().sum::<usize>() + columns;
        let (a, y) = deficient(rows, columns, columns, seed);
        let mut pieces = Triangle::new(columns);
        let mut at = 0;
        for n in cuts.iter().copied().chain([columns]) {
            pieces.push(&a.rows(at, n).into_owned(), &y.rows(at, n).into_owned()).unwrap();
            at += n;
        }
        let mut whole = Triangle::new(columns);
        whole.push(&a, &y).unwrap();
        let (p, w) = (pieces.solve().unwrap(), whole.solve().unwrap());
        // Backward error of both is eps; the forward error grows with the square of the condition number.
        let limit = 100.0 * f64::EPSILON * w.condition().powi(2) * (rows as f64);
        prop_assert_eq!((p.rank, pieces.rows()), (w.rank, rows));
        prop_assert!((&p.x - &w.x).norm() <= limit * (1.0 + w.x.norm()), "{:.1e}", (&p.x - &w.x).norm());
        prop_assert!((&p.covariance - &w.covariance).norm() <= limit * w.covariance.norm());
        prop_assert!((p.rss - w.rss).abs() <= limit * y.norm_squared());
    }
}
