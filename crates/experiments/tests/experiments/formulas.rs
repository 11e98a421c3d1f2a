//! Two readers of formulas, one of the world and one of the model, written by different methods: they agree.

use hexbench_core::streams::{Purpose, stream};
use hexbench_model::effects::formula::Formula;
use hexbench_truth::own_law::LawFormula;
use rand::RngExt;
use rand_pcg::Pcg64;

const VARIABLES: [&str; 3] = ["f", "q", "elapsed"];
const FUNCTIONS: [&str; 12] =
    ["abs", "sign", "sqrt", "cbrt", "exp", "sin", "cos", "tan", "atan", "tanh", "step", "sinh"];
const FUNCTIONS_OF_TWO: [&str; 4] = ["min", "max", "atan2", "hypot"];

/// A formula of the grammar, nested at most so deeply.
fn drawn(depth: u32, rng: &mut Pcg64) -> String {
    if depth == 0 {
        return match rng.random_range(0..4) {
            0 => format!("{:.3}", rng.random_range(0.1..9.0)),
            1 => format!("{} mm", rng.random_range(1..9)),
            2 => "pi".to_owned(),
            _ => VARIABLES[rng.random_range(0..VARIABLES.len())].to_owned(),
        };
    }
    let (one, two) = (drawn(depth - 1, rng), drawn(depth - 1, rng));
    match rng.random_range(0..9) {
        0 => format!("{one} + {two}"),
        1 => format!("{one}-{two}"),
        2 => format!("{one}*{two}"),
        3 => format!("{one} / ({two})"),
        4 => format!("-{one}"),
        5 => format!("({one})^{}", rng.random_range(-2..4)),
        6 => format!("{}({one})", FUNCTIONS[rng.random_range(0..FUNCTIONS.len())]),
        7 => format!("{}({one}, {two})", FUNCTIONS_OF_TWO[rng.random_range(0..FUNCTIONS_OF_TWO.len())]),
        _ => format!("({one})"),
    }
}

#[test]
fn both_readers_give_the_same_number_for_every_formula() {
    const FORMULAS: u64 = 4000;
    const ROUNDING: f64 = 1e-9;
    let mut compared = 0;
    for number in 0..FORMULAS {
        let mut rng = stream(5, Purpose::Test, [number]);
        let text = drawn(rng.random_range(0..5), &mut rng);
        let at = [rng.random_range(-50.0..50.0), rng.random_range(0.1..0.4), rng.random_range(0.0..300.0)];
        let of_world =
            LawFormula::new(&text, &VARIABLES).unwrap_or_else(|why| panic!("{text}: {why}")).value(&at);
        let of_model =
            Formula::parse(&text, &VARIABLES).unwrap_or_else(|why| panic!("{text}: {why}")).value(&at);
        let same = of_world.to_bits() == of_model.to_bits()
            || (of_world - of_model).abs() <= ROUNDING * of_model.abs();
        assert!(
            same || (of_world.is_nan() && of_model.is_nan()),
            "{text} at {at:?}: {of_world} and {of_model}"
        );
        compared += u64::from(of_world.is_finite());
    }
    assert!(compared > FORMULAS / 2, "{compared}");
}

#[test]
fn both_readers_refuse_the_same_texts() {
    for text in [
        "",
        "1 +",
        "f f",
        "(f",
        "f)",
        "g",
        "sin f",
        "min(f)",
        "sin(f, q)",
        "1.2.3",
        "f # q",
        "f,",
        "()",
        "^2",
    ] {
        assert!(LawFormula::new(text, &VARIABLES).is_err(), "{text}");
        assert!(Formula::parse(text, &VARIABLES).is_err(), "{text}");
    }
}
