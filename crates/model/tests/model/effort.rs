//! What fits cost, counted instead of timed: a clumsier change fails here on any machine.

use hexbench_core::Dataset;
use hexbench_model::estimation::fit::Fit;
use hexbench_model::estimation::fit_named::fit_named;
use hexbench_model::estimation::trust_region::Termination;
use hexbench_model::results::diagnose::prepare;
use hexbench_model::terms::catalogue;

use crate::cases::case;

/// A reading in millimeters that was taken for micrometres.
const WRONG_UNIT: f64 = 1e3;

/// Fit of springs and a term to the readings of a case, changed.
fn fitted(name: &str, term: &str, change: impl Fn(&mut Dataset)) -> Fit {
    let (hexapod, mut data, _) = case(name);
    change(&mut data);
    let term = catalogue().into_iter().find(|t| t.info().id == term).unwrap();
    fit_named(&prepare(&hexapod, &data).unwrap(), &[term]).unwrap()
}

#[test]
fn fits_of_sound_files_take_few_linearizations() {
    // Points at which the campaign was linearized, shortened steps included.
    let counts = [
        ("mujoco-foundation", "base-compliance"),
        ("contact", "joint-rotation-stiffness"),
        ("friction", "joint-friction"),
    ]
    .map(|(name, term)| {
        let fit = fitted(name, term, |_| {});
        assert_eq!(fit.termination, Termination::Settled, "{name}");
        (fit.effort.iterations, fit.effort.tried)
    });
    assert_eq!(counts, [(2, 1), (3, 2), (3, 2)]);
}

#[test]
fn a_wrong_unit_makes_a_fit_dearer_within_bounds() {
    let fit = fitted("mujoco-foundation", "base-compliance", |data| {
        for row in &mut data.observations {
            row.measured[0] *= WRONG_UNIT;
        }
    });
    assert_eq!((fit.effort.iterations, fit.effort.tried), (4, 10));
}

#[test]
fn of_many_readings_some_choose_the_start_and_the_fit_is_that_of_all() {
    const COPIES: usize = 30;
    let once = fitted("contact", "leg-nonlinearity", |_| {});
    let many = fitted("contact", "leg-nonlinearity", |data| {
        let all = std::mem::take(&mut data.observations);
        for copy in 0..COPIES {
            // Poses a micrometer apart are other conditions, here with the same readings.
            data.observations.extend(all.iter().map(|row| {
                let mut row = *row;
                row.pose.translation.x += 1e-6 * copy as f64;
                row
            }));
        }
    });
    assert!(many.lack_of_fit_dof > 6.0 * 1500.0, "{} degrees of freedom are not many", many.lack_of_fit_dof);
    let ratio = many.point.active[0].shape / once.point.active[0].shape;
    assert!((ratio - 1.0).abs() < 0.01, "the exponent is {ratio} times that of the readings taken once");
    let misfit = many.chi2 / (COPIES as f64 * once.chi2);
    assert!((misfit - 1.0).abs() < 0.01, "{misfit}");
    assert!(many.effort.tried <= 2, "{:?}", many.effort);
}
