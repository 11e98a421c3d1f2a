//! A foundation, or a platform plate, that only translates or only rotates: told as what it is, or as either of the two.
//!
//! Under forces alone a plate cannot show a rotation, and a foundation does. Where both translate the springs against rotation must not
//! decide between them.

use hexbench_core::Wrench;
use hexbench_truth::mechanisms::build;
use serde_json::json;

use crate::histories::history;

/// Of every effect beside what springs absorb, standard deviations of all readings together.
const DISTANCE: f64 = 30.0;
/// Of springs that do not yield, N/m or N m/rad.
const RIGID: f64 = 1e30;
/// Of springs against translation, N/m, of which only the ratios matter.
const ALONG: [f64; 3] = [2e8, 3e8, 4e8];
/// Of springs against rotation, N m/rad, likewise.
const ABOUT: [f64; 3] = [1e6, 2e6, 3e6];

#[test]
fn bodies_that_only_translate_under_forces_alone_are_not_told_apart_by_rotations() {
    let mut named = 0;
    for id in ["base-compliance", "platform-compliance"] {
        for seed in 0..6 {
            let [x, y, z] = ALONG;
            let effect = build(id, json!({ "stiffness": [x, y, z, RIGID, RIGID, RIGID] })).unwrap();
            let d = history(Some(effect), DISTANCE, seed, |schemes| {
                for scheme in [&mut schemes.training, &mut schemes.holdout] {
                    scheme.loads.retain(|load| load.moment.norm() == 0.0);
                    assert!(scheme.loads.len() >= 3, "{} loads", scheme.loads.len());
                    scheme.reference = Wrench { moment: scheme.reference.moment * 0.0, ..scheme.reference };
                }
            })
            .diagnosis();
            assert!(d.added.iter().all(|added| added == id), "{id} {seed}: {:?}", d.added);
            assert!(d.present[id] > 0.05, "{id} {seed}: {:?}", d.present);
            named += usize::from(d.added == [id]);
        }
    }
    assert!(named >= 3, "{named} of 12");
}

#[test]
fn bodies_that_only_translate_or_only_rotate_are_named_under_all_loads_and_have_those_numbers_alone() {
    let [x, y, z] = ALONG;
    let [a, b, c] = ABOUT;
    let only =
        [("translation", [x, y, z, RIGID, RIGID, RIGID]), ("rotation", [RIGID, RIGID, RIGID, a, b, c])];
    let (mut named, mut alone) = (0, 0);
    for id in ["base-compliance", "platform-compliance"] {
        for (springs, stiffness) in only {
            for seed in 0..3 {
                let effect = build(id, json!({ "stiffness": stiffness })).unwrap();
                let d = history(Some(effect), DISTANCE, seed, |_| {}).diagnosis();
                assert!(d.added.iter().all(|added| added == id), "{id} {springs} {seed}: {:?}", d.added);
                let own = d.parameters.iter().filter(|p| p.name.starts_with(id));
                named += usize::from(d.added == [id]);
                alone +=
                    usize::from(own.clone().count() > 0 && own.clone().all(|p| p.name.contains(springs)));
            }
        }
    }
    assert!(named >= 8 && alone >= 8, "{named} named, {alone} with their own numbers, of 12");
}
