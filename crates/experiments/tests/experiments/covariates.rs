//! Covariates that are not quite what the file says: the effect that they drive is named all the same, with its size.

use hexbench_truth::mechanisms::build;
use serde_json::json;

use crate::histories::history;

/// Of every effect beside what springs absorb, standard deviations of all readings together.
const DISTANCE: f64 = 40.0;

#[test]
fn legs_that_grow_with_a_temperature_that_is_off_by_kelvins_are_named_with_their_coefficient() {
    for (seed, off_k) in [(0, 0.4), (1, 2.0), (2, -1.0), (3, 2.0), (4, 0.4)] {
        let effect = build("thermal-expansion", json!({ "alpha": 1.2e-5 })).unwrap();
        let mut lab = history(Some(effect), DISTANCE, seed, |_| {});
        let stated = lab.hidden.as_ref().unwrap().parameters()["alpha"].as_f64().unwrap();
        for file in [&mut lab.measurements, &mut lab.holdout] {
            file.observations.iter_mut().for_each(|o| o.delta_t += off_k);
        }
        let d = lab.diagnosis();
        assert_eq!(d.added, ["thermal-expansion"], "{seed}: {:?}", d.candidates);
        let found = d.parameters.iter().find(|p| p.name == "thermal-expansion.coefficient").unwrap();
        let pull = (found.value - stated * 1e6) / found.std;
        assert!(pull.abs() < 4.0, "{seed}: {} +- {} for {}", found.value, found.std, stated * 1e6);
    }
}
