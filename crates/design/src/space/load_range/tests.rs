//! Loads between bounds: shares, corners, rounding.

use super::*;
use crate::Budget;
use crate::space::Conditions;

const GRAVITY: f64 = 9.806_65;

fn part(name: &'static str, k: usize, unit: f64, bounds: [f64; 2]) -> ChosenPart {
    let mut direction = Vector6::zeros();
    direction[k] = unit;
    ChosenPart { name, unit: "", direction, bounds }
}

/// A mass of 12.2 to 34.523 kg with a pull along x, after a listed load.
fn space() -> Space {
    let reference = Wrench::from_array([0.0, 0.0, -119.7, 0.0, 0.0, 3.0]);
    let fixed = Wrench::from_array([0.0, 0.0, 0.0, 0.0, 0.0, 3.0]);
    let parts = vec![part("mass", 2, -GRAVITY, [12.2, 34.523]), part("fx", 0, 1.0, [-50.0, 70.0])];
    let listed = Loading { reference, load: Wrench::from_array([1.0; 6]) };
    let range = LoadRange { load: 1, fixed, parts };
    let chosen = Loading { reference, load: range.farthest_from(&reference) };
    Space {
        low: [0.0; 6],
        high: [0.0; 6],
        stroke: None,
        joint_angle: None,
        least_dexterity: 0.0,
        loads: vec![listed, chosen],
        load_ranges: vec![range],
        conditions: Conditions { waits: vec![0.0, 5.0], ..Conditions::default() },
        budget: Budget::default(),
    }
}

#[test]
fn shares_and_loads_are_each_others_inverse_and_what_is_listed_stays() {
    let space = space();
    assert_eq!(space.load_shares(&space.loads), [1.0, 1.0]);
    let loads = space.loads_at(&[0.25, 0.5]);
    let mass = 12.2 + 0.25 * 22.323;
    let expected = [10.0, 0.0, -GRAVITY * mass, 0.0, 0.0, 3.0];
    for (found, expected) in loads[1].load.to_array().iter().zip(expected) {
        assert!((found - expected).abs() <= 4.0 * f64::EPSILON * 340.0, "{loads:?}");
    }
    assert_eq!(loads[0], space.loads[0]);
    let shares = space.load_shares(&loads);
    assert!((shares[0] - 0.25).abs() < 1e-14 && (shares[1] - 0.5).abs() < 1e-14, "{shares:?}");
    // Four settings: two waits under each of two loads.
    let along_x = &space.load_directions()[1];
    assert_eq!(along_x.iter().map(|d| d.x).collect::<Vec<_>>(), [0.0, 0.0, 120.0, 120.0]);
}

#[test]
fn rounded_loads_are_round_and_keep_their_bounds_to_the_bit() {
    let space = space();
    let rounded = |shares: [f64; 2]| {
        let there = space.under(space.loads_at(&shares));
        let rounded = there.with_rounded_loads();
        assert_eq!(rounded.with_rounded_loads(), rounded, "rounded twice");
        let loads = rounded.loads;
        let [mass, fx] = [-loads[1].load.force.z / GRAVITY, loads[1].load.force.x];
        (mass, fx.to_bits())
    };
    let (mass, fx) = rounded([1.0 - 1e-12, 1.0 - 1e-12]);
    assert_eq!((mass.to_bits(), fx), ((34.523 * GRAVITY / GRAVITY).to_bits(), 70.0_f64.to_bits()));
    let (mass, fx) = rounded([0.3, 1e-9]);
    assert_eq!((format!("{mass:.9}"), fx), ("18.900000000".to_owned(), (-50.0_f64).to_bits()));
    for k in 0..1000 {
        let share = f64::from(k) / 999.0;
        let (mass, _) = rounded([share, share]);
        // A weight divided by gravity again is off by rounding of its own.
        assert!((12.2 - 1e-14..=34.523 + 1e-14).contains(&mass), "{mass}");
    }
}

#[test]
fn corners_are_loads_of_their_own_in_place_of_the_range() {
    let corners = space().at_corners();
    assert_eq!(corners.loads.len(), 1 + 4);
    assert_eq!(corners.load_ranges.iter().map(|r| r.load).collect::<Vec<_>>(), [1, 2, 3, 4]);
    let shares = corners.load_shares(&corners.loads);
    assert_eq!(shares, [0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
}
