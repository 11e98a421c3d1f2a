//! Cartesian stiffness `K = L' diag(k) L` and compliance `J diag(c) J'` against published matrices and closed forms.

use hexbench_core::{Matrix6, Pose, Vector3};
use hexbench_model::machine::kinematics::Legs;
use serde_json::Value;

use crate::common::{self, ring};

/// Published with two significant digits, rounded either way: half a unit of the second digit of 1.0.
const TWO_DIGITS: f64 = 0.051;
/// The exact evaluations carry four or five digits.
const FOUR_DIGITS: f64 = 6e-4;
/// Closed forms: sums of six products through a 6x6 inverse of condition number below 1e3.
const ROUNDING: f64 = 1e3 * 6.0 * f64::EPSILON;

fn table() -> Value {
    serde_json::from_str(include_str!("../reference/hexapods/published_matrices.json")).unwrap()
}

fn stiffness(legs: &Legs, k: f64) -> Matrix6 {
    legs.leg_jacobian.transpose() * legs.leg_jacobian * k
}

fn compliance(legs: &Legs, k: f64) -> Matrix6 {
    legs.platform_jacobian * legs.platform_jacobian.transpose() / k
}

/// Six edges of a cube of edge `edge` standing on a corner, its center `above` over the mobile origin; the joints are
/// the ends of the edges.
fn cubic(edge: f64, above: f64) -> Legs {
    let (a, b, c) = (
        Vector3::new(2.0, -1.0, -1.0) / 6f64.sqrt(),
        Vector3::new(0.0, 1.0, -1.0) / 2f64.sqrt(),
        3f64.sqrt(),
    );
    let corner = |x: [f64; 3]| {
        let x = Vector3::from(x) * edge;
        Vector3::new(a.dot(&x), b.dot(&x), x.sum() / c - 1.5 * edge / c + above)
    };
    let low = [
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let high = [
        [1.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 1.0],
        [0.0, 1.0, 1.0],
    ];
    Legs::at(&low.map(corner), &high.map(corner), &Pose::default()).unwrap()
}

#[test]
fn a_cubic_machine_has_the_stiffness_of_the_closed_form_at_its_centre() {
    for height in [0.04, 0.1, 0.25] {
        let k = 3e6;
        // The height of a cube between its lower and upper triangle of joints is edge / sqrt(3).
        let found = stiffness(&cubic(height * 3f64.sqrt(), 0.0), k);
        let (xy, bend, twist) = (2.0 * k, 1.5 * k * height * height, 6.0 * k * height * height);
        let expected = Matrix6::from_diagonal(&[xy, xy, xy, bend, bend, twist].into());
        let error = common::relative_difference(&found, &expected);
        assert!(error < ROUNDING, "height {height}: {error:.1e}");
    }
}

#[test]
fn cubic_machines_have_their_published_stiffness_at_the_stated_frame() {
    let table = table();
    for case in table["cubic"]["cases"].as_array().unwrap().iter().skip(1) {
        let x: Vec<f64> = case.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
        let [height_of_platform, frame, height, centre, bend, twist, mixed] = x[..] else { panic!("{case}") };
        let k = stiffness(&cubic(height * 3f64.sqrt(), centre - height_of_platform - frame), 1.0);
        for (found, published) in [
            (k[(3, 3)], bend),
            (k[(4, 4)], bend),
            (k[(5, 5)], twist),
            (k[(0, 4)], mixed),
            (-k[(1, 3)], mixed),
        ] {
            let error = (found - published).abs();
            assert!(error <= TWO_DIGITS * published.abs() + ROUNDING, "{case}: {found:.5} for {published}");
        }
        for axis in 0..3 {
            assert!((k[(axis, axis)] - 2.0).abs() < ROUNDING, "{case}: {}", k[(axis, axis)]);
        }
    }
}

/// The general machine of Dehaeze at the frame {B}.
fn general() -> (Legs, f64) {
    let table = table();
    let case = &table["general_configuration"];
    let number = |key: &str| case[key].as_f64().unwrap();
    let angles = |key: &str| -> [f64; 6] {
        let all: Vec<f64> = case[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
        all.try_into().unwrap()
    };
    let base = ring(number("FR"), angles("FTh_deg"), number("FH"));
    let platform = ring(number("MR"), angles("MTh_deg"), -number("MO_B_m") - number("MH"));
    let pose = Pose::from_array([0.0, 0.0, number("H_m") + number("MO_B_m"), 0.0, 0.0, 0.0]);
    (Legs::at(&base, &platform, &pose).unwrap(), number("k_N_per_m"))
}

#[test]
fn the_general_machine_has_its_published_compliance_to_the_printed_digits() {
    let (legs, k) = general();
    let found = compliance(&legs, k);
    let table = table();
    let rows = table["general_configuration"]["C_published_2digits"].as_array().unwrap();
    for (i, row) in rows.iter().enumerate() {
        for (j, value) in row.as_array().unwrap().iter().enumerate() {
            let published = value.as_f64().unwrap();
            let size = (found[(i, i)] * found[(j, j)]).sqrt();
            let error = (found[(i, j)] - published).abs();
            let limit = TWO_DIGITS * published.abs() + ROUNDING * size;
            assert!(error <= limit, "C[{i}][{j}] = {:.4e} for {published:.1e}", found[(i, j)]);
        }
    }
}

#[test]
fn the_general_machine_has_the_compliance_and_leg_length_evaluated_directly() {
    let (legs, k) = general();
    let found = compliance(&legs, k);
    let table = table();
    let own = &table["general_configuration"]["C_own"];
    for (key, value) in [
        ("xx", found[(0, 0)]),
        ("zz", found[(2, 2)]),
        ("rxrx", found[(3, 3)]),
        ("rzrz", found[(5, 5)]),
        ("x_ry", found[(0, 4)]),
    ] {
        let error = (value / own[key].as_f64().unwrap() - 1.0).abs();
        assert!(error < FOUR_DIGITS, "{key}: {error:.1e}");
    }
    // Printed as 95.2 mm.
    assert!((legs.lengths.mean() * 1e3 - 95.2).abs() < 0.051, "{:.3} mm", legs.lengths.mean() * 1e3);
}

#[test]
fn stiffness_and_compliance_are_inverse() {
    let (legs, k) = general();
    let error = (stiffness(&legs, k) * compliance(&legs, k) - Matrix6::identity()).amax();
    assert!(error < ROUNDING, "{error:.1e}");
}
