//! A term whose law is a function of the calling program: the same fit as its formula, asked for all conditions at once.

use std::sync::{Arc, Mutex};

use hexbench_model::effects::term::Term;
use hexbench_model::effects::user_term::{LawOfProgram, LawQuestion, UserTermError, of_function, parse};
use hexbench_model::estimation::fit::{TermSpec, fit};
use hexbench_model::results::diagnose::prepare;

use crate::cases;

const HEADER: &str = r#"
format = "term/1"
id = "square-spring"
title = "Legs that soften with the square of the force"
parameters = [{ name = "size", unit = "nm/N", scale = 20 }]
"#;

/// Elongations of the legs by the force under the load and in the reference state.
fn square(question: &LawQuestion) -> Vec<[f64; 6]> {
    let [f, f0] = [0, 1].map(|k| question.variables[k].as_slice());
    let bent = |x: f64| question.sizes[0] * x * x.abs() / 100.0;
    let row = |n: usize| std::array::from_fn(|leg| bent(f[6 * n + leg]) - bent(f0[6 * n + leg]));
    (0..question.conditions).map(row).collect()
}

fn law(law: impl Fn(&LawQuestion) -> Vec<[f64; 6]> + Send + Sync + 'static) -> LawOfProgram {
    let variables = ["f", "f0"].map(str::to_owned).to_vec();
    LawOfProgram { acts: "elongation".to_owned(), variables, name: "law".to_owned(), law: Box::new(law) }
}

#[test]
fn a_function_gives_the_fit_of_its_formula_in_few_questions_that_are_never_repeated() {
    let (hexapod, data, _) = cases::case("two-effects");
    let campaign = prepare(&hexapod, &data).unwrap();
    let asked = Arc::new(Mutex::new(Vec::new()));
    let counted = {
        let asked = Arc::clone(&asked);
        move |question: &LawQuestion| {
            asked.lock().unwrap().push(question.conditions);
            square(question)
        }
    };
    let function = of_function(HEADER, law(counted)).unwrap();
    let formula = parse(&format!("elongation = \"size*(f*abs(f) - f0*abs(f0))/100\"\n{HEADER}")).unwrap();
    let of = |term: &Arc<dyn Term>| {
        let wanted = TermSpec { term: Arc::clone(term), rich: false, shape: 1.0, prior: vec![1.0] };
        fit(&campaign, &[wanted], None).unwrap()
    };
    asked.lock().unwrap().clear();
    let (own, theirs) = (of(&function), of(&formula));
    assert!((own.chi2 / theirs.chi2 - 1.0).abs() < 1e-9, "{} {}", own.chi2, theirs.chi2);
    let counts = std::mem::take(&mut *asked.lock().unwrap());
    let all = campaign.groups.len();
    assert!(counts.iter().any(|n| *n >= all) && counts.len() < 60, "{counts:?} for {all} conditions");
    assert!(counts.iter().filter(|n| **n == 1).count() < 3, "one by one: {counts:?}");
    of(&function);
    assert!(asked.lock().unwrap().is_empty(), "known answers were asked for again");
}

#[test]
fn laws_that_bend_mix_conditions_or_give_no_number_are_refused() {
    type Change = fn(&LawQuestion) -> Vec<[f64; 6]>;
    let refused = |change: Change| of_function(HEADER, law(change)).err().unwrap();
    let bends = refused(|q| square(&LawQuestion { sizes: vec![q.sizes[0].powi(2)], ..q.clone() }));
    assert!(matches!(bends, UserTermError::NotLinear { .. }), "{bends}");
    let shifted = refused(|q| square(q).into_iter().map(|row| row.map(|x| x + 1e-9)).collect());
    assert!(matches!(shifted, UserTermError::NotLinear { .. }), "{shifted}");
    let mixes = refused(|q| square(q).into_iter().map(|row| row.map(|x| x * q.conditions as f64)).collect());
    assert!(mixes.to_string().contains("asked for fewer of them"), "{mixes}");
    let nothing = refused(|q| vec![[f64::NAN; 6]; q.conditions]);
    assert!(matches!(nothing, UserTermError::NoValue { .. }), "{nothing}");
    let both = format!("elongation = \"size*df\"\n{HEADER}");
    assert!(of_function(&both, law(square)).err().unwrap().to_string().contains("not both"));
    let unknown = LawOfProgram { variables: vec!["elapsd".to_owned()], ..law(square) };
    assert!(of_function(HEADER, unknown).err().unwrap().to_string().contains("`elapsed` perhaps"));
}
