use super::rest::load;
use super::*;
use crate::effects::term::{Chapter, Rich};
use crate::estimation::linearization::{actions, parameter_count};
use crate::terms::catalogue;
use crate::test_machine::readings;

/// Of sums of some twenty products.
const ROUNDING: f64 = 1e-13;

#[test]
fn what_a_term_does_at_once_is_the_sum_of_what_its_parameters_do() {
    let (hexapod, data) = readings(Measurand::DeflectionRotationVector, Vec::new());
    let campaign = Campaign::new(&hexapod, &data).unwrap();
    let (machine, compliances) = (Machine::nominal(&hexapod), Vector6::repeat(1e-7));
    let conditions = campaign.conditions(&machine, &compliances, &[], Tangents::ForFit).unwrap();
    let mut out = Vec::new();
    for term in catalogue().into_iter().filter(|t| t.info().chapter != Chapter::AbsolutePoses) {
        for rich in [false, term.info().rich != Rich::None] {
            let mut active = Active::new(term.clone(), rich, term.info().shape.map_or(1.0, |s| s.bounds[0]));
            let value = |k: usize| 1e-8 * (1.0 + k as f64).sin();
            active.values = (0..parameter_count(term.as_ref(), rich)).map(value).collect();
            for at in &conditions {
                let whole = load(&machine, at, std::iter::once(&active), &mut out);
                let mut sum = Load::default();
                actions(term.as_ref(), rich, active.shape, &machine, at, &mut out);
                assert_eq!(out.len(), active.values.len(), "{}", active.id());
                for (action, value) in out.iter().zip(&active.values) {
                    sum.add(action, *value);
                }
                let [whole, sum] = [&whole, &sum].map(|load| [load.stretch(at, &compliances), load.twist()]);
                for (a, b) in whole.iter().zip(&sum) {
                    assert!((a - b).amax() <= ROUNDING * b.amax(), "{active:?}: {a} for {b}");
                }
            }
        }
    }
}
