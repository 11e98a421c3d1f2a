//! Evidence in closed form against brute force, tail probabilities against tables, and how often clean data accuse an
//! effect.

use hexbench_core::{Dataset, Measurand};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::noise::NoiseLevel;
use hexbench_model::inference::diagnosis::explain;
use hexbench_model::inference::evidence::{Gram, Likelihood, PriorBlock, Variant, log_orthant};
use hexbench_model::inference::power::{noncentral_cdf, noncentrality};
use hexbench_model::inference::verdict::{Judgement, Verdict, judge};
use hexbench_model::results::diagnose::diagnose;
use hexbench_model::terms::catalogue;
use nalgebra::{DMatrix, DVector, Matrix2, Vector2};
use rayon::prelude::*;

use crate::common::plan::{noisy, rich_plan};
use crate::common::random::Random;
use crate::common::world::World;
use crate::common::{PAPER_STIFFNESS, measured_machine, paper_machine};

/// Trapezoidal sums of smooth functions that vanish at both ends of a range of 24 standard deviations.
const INTEGRATION_NATS: f64 = 1e-7;
/// Moment matching after the first sign (Mendell and Elston 1974): two signs.
const TWO_SIGNS_RELATIVE: f64 = 0.03;
/// Two signs of probability below 1e-4, strongly opposed: share of the logarithm.
const TAIL_SHARE: f64 = 0.07;
/// Six signs, nothing far in the tail, of equal correlation one half.
const SIX_SIGNS_RELATIVE: f64 = 0.05;

/// One block with raw normal equations `g`, `b` (per parameter, SI).
fn gram(g: &DMatrix<f64>, b: &DVector<f64>, mut block: PriorBlock, width: f64, yy: f64) -> Gram {
    block.widths = vec![width];
    let t = block.transform.clone();
    Gram {
        g: t.transpose() * g * &t,
        b: t.transpose() * b,
        likelihood: Likelihood { yy, equations: 40.0, level: NoiseLevel::EXACT },
        blocks: vec![block],
        absorbed: DMatrix::zeros(6, t.ncols()),
        springs: DMatrix::zeros(6, 6),
    }
}

const ONLY: [Variant; 1] = [Variant { block: 0, width: 0 }];

/// `ln` of the integral of `exp(f)` over a range by the trapezoidal rule.
fn log_integral(from: f64, to: f64, steps: usize, f: impl Fn(f64) -> f64) -> f64 {
    let h = (to - from) / steps as f64;
    let values: Vec<f64> = (0..=steps).map(|i| f(from + h * i as f64)).collect();
    let top = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let inner: f64 = values.iter().map(|v| (v - top).exp()).sum();
    let ends = 0.5 * ((values[0] - top).exp() + (values[steps] - top).exp());
    top + (h * (inner - ends)).ln()
}

/// `ln N(x; 0, s^2)`.
fn log_normal(x: f64, s: f64) -> f64 {
    -0.5 * (x / s).powi(2) - s.ln() - 0.5 * std::f64::consts::TAU.ln()
}

#[test]
fn springs_beside_an_effect_are_those_of_the_joint_least_squares_problem() {
    /// Of condition numbers below 1e4 in double precision.
    const ALGEBRA: f64 = 1e-9;
    let mut random = Random::new(5);
    let mut draw = |rows: usize, columns: usize| DMatrix::from_fn(rows, columns, |_, _| random.normal());
    let (springs, effect, y) = (draw(20, 6), draw(20, 2), draw(20, 1));
    let (sizes, width) = ([0.5, 3.0], 0.8);
    let alone = (springs.transpose() * &springs).try_inverse().unwrap();
    let residual = |m: &DMatrix<f64>| m - &springs * (&alone * springs.tr_mul(m));
    let block = PriorBlock::new(&sizes, vec![false; 2], 1.0, false, 1.0);
    let t = block.transform.clone();
    let g = effect.tr_mul(&residual(&effect));
    let b = effect.tr_mul(&residual(&y)).column(0).into_owned();
    let problem = Gram {
        absorbed: &alone * springs.tr_mul(&effect) * t,
        springs: alone.clone(),
        ..gram(&g, &b, block, width, 40.0)
    };
    let (change, variance) = problem.springs(&ONLY).unwrap();

    let all = DMatrix::from_fn(20, 8, |i, j| if j < 6 { springs[(i, j)] } else { effect[(i, j - 6)] });
    let prior =
        DMatrix::from_fn(8, 8, |i, j| if i == j && i > 5 { (width * sizes[i - 6]).powi(-2) } else { 0.0 });
    let covariance = (all.tr_mul(&all) + prior).try_inverse().unwrap();
    let joint = &covariance * all.tr_mul(&y);
    let before = &alone * springs.tr_mul(&y);
    for leg in 0..6 {
        let off = [change[leg] - (joint[leg] - before[leg]), variance[leg] - covariance[(leg, leg)]];
        assert!(off.iter().all(|e| e.abs() < ALGEBRA), "leg {leg}: {off:?}");
    }
}

#[test]
fn evidence_of_one_parameter_is_the_integral_of_likelihood_and_prior() {
    // ln L(p) - ln L(0) = b p - g p^2 / 2 for normal equations g, b.
    for (g, b, size, width) in
        [(4.0, 3.0, 1.0, 2.0), (100.0, -30.0, 0.5, 0.25), (1e-2, 0.5, 3.0, 1.0), (50.0, -12.0, 1.0, 2.0)]
    {
        for positive in [false, true] {
            let block = PriorBlock::new(&[size], vec![positive], 1.0, false, 1.0);
            let closed = gram(&DMatrix::repeat(1, 1, g), &DVector::repeat(1, b), block, width, 100.0);
            let closed = closed.posterior(&ONLY, 1.0).unwrap().log_evidence;
            let s: f64 = size * width;
            let reach = 12.0 * s.min(1.0 / f64::sqrt(g)) + (b / g).abs().min(12.0 * s);
            let (from, ln_two) = if positive { (0.0, std::f64::consts::LN_2) } else { (-reach, 0.0) };
            let exponent = |p: f64| b * p - 0.5 * g * p * p + log_normal(p, s) + ln_two;
            let brute = log_integral(from, reach, 400_000, exponent);
            assert!(
                (closed - brute).abs() < INTEGRATION_NATS,
                "g {g}, b {b}, sign {positive}: {closed} for {brute}"
            );
        }
    }
}

/// Brute-force evidence of two parameters over the whole plane or its positive quadrant.
fn brute_plane(g: &Matrix2<f64>, b: &Vector2<f64>, prior: &Matrix2<f64>, positive: bool) -> f64 {
    let precision = prior.try_inverse().unwrap();
    let posterior = (g + precision).try_inverse().unwrap();
    let (mean, spread) = (posterior * b, posterior.diagonal().map(f64::sqrt));
    // Quadrants of the prior: 1/4 + asin(r) / (2 pi).
    let r = prior[(0, 1)] / (prior[(0, 0)] * prior[(1, 1)]).sqrt();
    let share: f64 = if positive { 0.25 + r.asin() / std::f64::consts::TAU } else { 1.0 };
    let norm = -share.ln() - 0.5 * prior.determinant().ln() - std::f64::consts::TAU.ln();
    let limits = |k: usize| {
        let low = mean[k] - 12.0 * spread[k];
        (
            if positive { low.max(0.0) } else { low },
            (mean[k] + 12.0 * spread[k]).max(if positive { 6.0 * spread[k] } else { f64::MIN }),
        )
    };
    let ((x0, x1), (y0, y1)) = (limits(0), limits(1));
    log_integral(x0, x1, 2000, |x| {
        log_integral(y0, y1, 2000, |y| {
            let p = Vector2::new(x, y);
            b.dot(&p) - 0.5 * p.dot(&((g + precision) * p)) + norm
        })
    })
}

#[test]
fn evidence_of_two_parameters_is_the_integral_of_likelihood_and_correlated_prior() {
    let g = Matrix2::new(9.0, 4.0, 4.0, 16.0);
    for (b, width) in
        [(Vector2::new(6.0, 9.0), 1.0), (Vector2::new(-3.0, 5.0), 0.5), (Vector2::new(1.0, -4.0), 2.0)]
    {
        for positive in [false, true] {
            let sizes = [0.8, 1.5];
            let block = PriorBlock::new(&sizes, vec![positive; 2], 1.0, false, 1.0);
            let prior = &block.transform * block.transform.transpose() * width * width;
            let prior = Matrix2::new(prior[(0, 0)], prior[(0, 1)], prior[(1, 0)], prior[(1, 1)]);
            let (g2, b2) = (
                DMatrix::from_iterator(2, 2, g.iter().copied()),
                DVector::from_iterator(2, b.iter().copied()),
            );
            let closed = gram(&g2, &b2, block, width, 100.0).posterior(&ONLY, 1.0).unwrap().log_evidence;
            let brute = brute_plane(&g, &b, &prior, positive);
            let correlated = (prior[(0, 1)] / (prior[(0, 0)] * prior[(1, 1)]).sqrt() - 0.5).abs() < 1e-12;
            assert!(correlated == positive, "prior {prior}");
            // Without signs exact up to the sum; with signs the quadrant is approximated.
            let limit = if positive { TWO_SIGNS_RELATIVE } else { 1e-6 };
            let error = (closed - brute).abs();
            println!("two parameters, sign {positive}: {error:.1e} nats");
            assert!(error < limit, "b {b}, sign {positive}: {closed} for {brute}");
        }
    }
}

/// A part and the rest of a whole, neither of them negative, are alike before the data: the same integral over another pair of numbers.
#[test]
fn evidence_of_a_part_of_the_first_is_that_of_the_part_and_the_rest() {
    const ALGEBRA: f64 = 1e-9;
    let (g, b) = (Matrix2::new(9.0, 4.0, 4.0, 16.0), Vector2::new(6.0, 9.0));
    // whole = rest + part: columns of (rest, part) are those of (whole, part) times this.
    let sum = Matrix2::new(1.0, 1.0, 0.0, 1.0);
    let raw = |g: &Matrix2<f64>, b: &Vector2<f64>, block| {
        let (g, b) =
            (DMatrix::from_iterator(2, 2, g.iter().copied()), DVector::from_iterator(2, b.iter().copied()));
        gram(&g, &b, block, 0.7, 100.0)
    };
    let block = || PriorBlock::new(&[1.0, 1.0], vec![true; 2], 1.0, false, 1.0);
    for b in [b, -b, Vector2::new(1.0, 30.0)] {
        let own = raw(&g, &b, block().with_part());
        let other = raw(&(sum.transpose() * g * sum), &(sum.transpose() * b), block());
        let (found, expected) = (own.posterior(&ONLY, 1.0).unwrap(), other.posterior(&ONLY, 1.0).unwrap());
        assert!((found.log_evidence - expected.log_evidence).abs() < ALGEBRA, "b {b}");
        assert!((found.mean[0] - expected.mean[0] - expected.mean[1]).abs() < ALGEBRA, "b {b}");
        let score = |gram: &Gram| gram.profile(&[], &[0])[0].1;
        assert!((score(&own) - score(&other)).abs() < ALGEBRA, "b {b}");
        // A part larger than the whole costs as much as a negative rest.
        let lengths = [own.signature_lengths(&[], 0), other.signature_lengths(&[], 0)];
        assert!((lengths[0][0] - lengths[1][0]).abs() < ALGEBRA, "{lengths:?}");
    }
}

#[test]
fn a_parameter_alone_scores_in_a_profile_as_in_a_posterior() {
    let mut random = Random::new(1);
    for n in [1, 2, 6] {
        for positive in [false, true] {
            let root = DMatrix::from_fn(n + 5, n, |_, _| random.normal());
            let b = DVector::from_fn(n, |_, _| 4.0 * random.normal());
            let block = PriorBlock::new(&vec![0.7; n], vec![positive; n], 1.0, false, 1.0);
            let problem = gram(&root.tr_mul(&root), &b, block, 1.5, 100.0);
            let whole = problem.posterior(&ONLY, 1.0).unwrap().log_evidence;
            let profile = problem.profile(&[], &[0])[0].1;
            assert!(
                (whole - profile).abs() < 1e-9 * (1.0 + whole.abs()),
                "{n} parameters: {whole} and {profile}"
            );
        }
    }
}

#[test]
fn the_student_form_tends_to_the_known_noise_with_many_degrees_of_freedom() {
    let problem = |dof: f64| {
        let block = PriorBlock::new(&[1.0, 1.0], vec![false; 2], 1.0, false, 1.0);
        let g = DMatrix::from_row_slice(2, 2, &[9.0, 4.0, 4.0, 16.0]);
        let b = DVector::from_vec(vec![6.0, 9.0]);
        // Residuals of the size of the noise: 40 equations, chi-square 40.
        let mut problem = gram(&g, &b, block, 1.0, 40.0);
        problem.likelihood.level = NoiseLevel { sum: dof, dof };
        problem.posterior(&ONLY, 1.0).unwrap().log_evidence
    };
    let known = problem(f64::INFINITY);
    let gap = |dof: f64| (problem(dof) - known).abs();
    let (coarse, fine) = (gap(1e4), gap(1e6));
    // The gap falls like the square of the drop over the degrees of freedom.
    assert!(fine < 1e-4 && (50.0..200.0).contains(&(coarse / fine)), "gaps {coarse:.1e} and {fine:.1e}");
}

#[test]
fn the_student_form_is_the_integral_over_the_unknown_noise() {
    // y'y, one column, prior width in units of the noise; noise variance s with a scaled inverse chi-square prior of
    // nu degrees of freedom about 1: p(y | model) = integral of s^(-n/2 - nu/2 - 1) exp(-(chi2 + nu) / 2s).
    let (g, b, width, yy, n, nu) = (9.0, 7.0, 1.5, 30.0, 40.0, 12.0);
    let block = PriorBlock::new(&[1.0], vec![false], 1.0, false, 1.0);
    let mut problem = gram(&DMatrix::repeat(1, 1, g), &DVector::repeat(1, b), block, width, yy);
    problem.likelihood.level = NoiseLevel { sum: nu, dof: nu };
    let closed = problem.posterior(&ONLY, 1.0).unwrap().log_evidence;
    let over_noise = |f: &dyn Fn(f64) -> f64| {
        log_integral(-6.0, 6.0, 2000, |log_s| f(log_s.exp()) - 0.5 * (n + nu) * log_s)
    };
    let without = over_noise(&|s| -(yy + nu) / (2.0 * s));
    let with = over_noise(&|s| {
        let sigma = s.sqrt();
        log_integral(-12.0 * sigma * width, 12.0 * sigma * width, 2000, |p| {
            log_normal(p, width * sigma) - (yy - 2.0 * b * p + g * p * p + nu) / (2.0 * s)
        })
    });
    assert!((closed - (with - without)).abs() < 1e-6, "{closed} for {}", with - without);
}

fn equicorrelated(n: usize, r: f64) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| if i == j { 1.0 } else { r })
}

#[test]
fn six_signs_of_correlation_one_half_agree_with_probability_one_seventh() {
    let p = log_orthant(DVector::zeros(6), equicorrelated(6, 0.5)).exp();
    println!("six signs: {p:.5} for {:.5}", 1.0 / 7.0);
    assert!((7.0 * p - 1.0).abs() < SIX_SIGNS_RELATIVE, "{p:.5} for {:.5}", 1.0 / 7.0);
}

#[test]
fn signs_of_displaced_normals_agree_with_random_draws() {
    const DRAWS: u32 = 400_000;
    let mut random = Random::new(2);
    for case in 0..4 {
        let root = equicorrelated(6, 0.5).cholesky().unwrap().l();
        let mean = DVector::from_fn(6, |_, _| 0.4 + 0.5 * random.normal());
        let mut hits = 0_u32;
        for _ in 0..DRAWS {
            let x = &mean + &root * DVector::from_fn(6, |_, _| random.normal());
            hits += u32::from(x.iter().all(|v| *v > 0.0));
        }
        let drawn = f64::from(hits) / f64::from(DRAWS);
        let found = log_orthant(mean.clone(), equicorrelated(6, 0.5)).exp();
        let noise = 4.0 / f64::from(hits).sqrt();
        assert!(
            (found / drawn - 1.0).abs() < SIX_SIGNS_RELATIVE + noise,
            "case {case}: {found:.4} for {drawn:.4}"
        );
    }
}

/// Rows of a table with a comment and a header line.
fn rows(text: &str) -> Vec<Vec<f64>> {
    let number = |line: &str| line.split(',').map(|w| w.parse().unwrap()).collect();
    text.lines().filter(|l| !l.starts_with('#')).skip(1).map(number).collect()
}

#[test]
fn two_signs_agree_with_the_table_of_quadrant_probabilities() {
    let mut worst: f64 = 0.0;
    for row in rows(include_str!("../reference/bivariate_orthant.csv")) {
        let [m1, m2, r, p] = row[..] else { panic!("{row:?}") };
        let found = log_orthant(DVector::from_vec(vec![m1, m2]), equicorrelated(2, r));
        let error = (found - p.ln()).abs();
        // Signs this improbable decide by themselves: a share of their many nats is enough.
        let probable = p.ln() > -10.0;
        let limit = if probable { TWO_SIGNS_RELATIVE } else { TAIL_SHARE * p.ln().abs() };
        worst = worst.max(if probable { error } else { 0.0 });
        assert!(error < limit, "means {m1}, {m2}, correlation {r}: {:.4e} for {p:.4e}", found.exp());
    }
    println!("two signs more probable than 5e-5: at most {worst:.1e} nats");
}

#[test]
fn the_noncentral_chi_square_agrees_with_its_table() {
    // Poisson mixtures of a few hundred terms of relative accuracy 1e-12 or so.
    const ABSOLUTE: f64 = 1e-9;
    let mut worst: f64 = 0.0;
    for row in rows(include_str!("../reference/noncentral_chi_square.csv")) {
        let [dof, lambda, x, cdf] = row[..] else { panic!("{row:?}") };
        let error = (noncentral_cdf(x, dof, lambda) - cdf).abs();
        worst = worst.max(error);
        assert!(error < ABSOLUTE, "dof {dof}, lambda {lambda}, x {x}: off by {error:.1e}");
    }
    println!("noncentral chi-square: at most {worst:.1e}");
}

#[test]
fn the_noncentrality_of_a_test_at_one_percent_with_ninety_percent_power_is_the_tabled_one() {
    // (2.5758 + 1.2816)^2 = 14.879 for one degree of freedom, where the other tail is out of reach.
    let found = noncentrality(1.0, 0.01, 0.9);
    assert!((found - 14.879).abs() < 1e-3, "{found}");
}

/// Noise of one reading in the campaigns below.
const SIGMA_M: f64 = 0.5e-6;
const SIGMA_RAD: f64 = 3e-6;
const CAMPAIGNS: u64 = 300;

fn clean_campaign() -> Dataset {
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    world.measure(Measurand::DeflectionEuler, &rich_plan(12, 1.0, 21))
}

fn judged(clean: &Dataset, seed: u64) -> Judgement {
    let data = noisy(clean, SIGMA_M, SIGMA_RAD, seed);
    let campaign = Campaign::new(&measured_machine(SIGMA_M, SIGMA_RAD), &data).unwrap();
    let outcome = explain(&campaign, &catalogue()).unwrap();
    judge(&outcome.sets, &outcome.candidates)
}

#[test]
fn clean_campaigns_accuse_no_effect_more_often_than_claimed() {
    // An effect is named when its probability is 0.95 or more; nothing has a prior probability of 0.45 and something
    // 0.55. By Markov's inequality odds of 19 for an effect come up in clean data with a chance of at most
    // 0.55 / 0.45 / 19 = 6.4 %: 19 of 300, and 32 with four standard deviations more.
    const MOST_NAMED: usize = 32;
    let clean = clean_campaign();
    let all: Vec<Judgement> = (0..CAMPAIGNS).into_par_iter().map(|s| judged(&clean, 5000 + s)).collect();
    let count = |v: Verdict| all.iter().filter(|j| j.verdict == v).count();
    let accused = all.iter().filter(|j| !j.sure.is_empty() || j.verdict == Verdict::Outside).count();
    let adequate = count(Verdict::Adequate);
    println!(
        "of {CAMPAIGNS} clean campaigns {adequate} adequate, {} ambiguous, {} named, {} outside; {accused} accuse",
        count(Verdict::Ambiguous),
        count(Verdict::Named),
        count(Verdict::Outside)
    );
    assert!(accused <= MOST_NAMED, "{accused} of {CAMPAIGNS} clean campaigns accuse an effect");
    assert!(
        adequate * 10 >= all.len() * 8,
        "only {adequate} of {CAMPAIGNS} clean campaigns pass as adequate"
    );
}

#[test]
fn probabilities_of_the_first_addition_sum_to_one() {
    let clean = clean_campaign();
    for seed in 0..5 {
        let judgement = judged(&clean, seed);
        let sum: f64 = judgement.first.iter().map(|f| f.1).sum();
        assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    }
}

#[test]
fn one_thread_and_two_give_the_same_bytes() {
    let mut world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    world.bracket = 40e-9;
    let clean = world.measure(Measurand::DeflectionEuler, &rich_plan(16, 1.0, 22));
    let data = noisy(&clean, SIGMA_M, SIGMA_RAD, 23);
    let hexapod = measured_machine(SIGMA_M, SIGMA_RAD);
    let bytes = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let study = pool.install(|| diagnose(&hexapod, &data, None, &catalogue()).unwrap());
        serde_json::to_string(&study.diagnosis).unwrap()
    };
    assert_eq!(bytes(1), bytes(2));
}
