//! What a formula of a user term may mention.

use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// Variables that differ from leg to leg.
pub(super) const OF_LEG: [&str; 9] = ["f", "f0", "df", "q", "q_home", "nx", "ny", "nz", "leg"];
/// Variables of the reading.
pub(super) const OF_READING: [&str; 21] = [
    "approach", "delta_T", "elapsed", "a", "b", "c", "alpha", "beta", "gamma", "fx", "fy", "fz", "mx", "my",
    "mz", "ref_fx", "ref_fy", "ref_fz", "ref_mx", "ref_my", "ref_mz",
];

/// Unit and meaning of a variable.
pub(super) fn meaning(variable: &str) -> [&'static str; 2] {
    match variable {
        "f" => ["N", "leg force under the load, tension positive"],
        "f0" => ["N", "leg force in the reference state"],
        "df" => ["N", "f - f0"],
        "q" => ["m", "leg length"],
        "q_home" => ["m", "leg length at the zero pose"],
        "nx" | "ny" | "nz" => ["", "direction of the leg, base joint to platform joint, fixed axes"],
        "leg" => ["", "number of the leg, 1 to 6"],
        "approach" => ["", "+1: load reached from below, -1: from above"],
        "delta_T" => ["K", "temperature since the reference"],
        "elapsed" => ["s", "time since the reference"],
        "a" | "b" | "c" => ["m", "position of the platform"],
        "alpha" | "beta" | "gamma" => ["rad", "orientation of the platform"],
        "fx" | "fy" | "fz" => ["N", "force on the platform, fixed axes"],
        "mx" | "my" | "mz" => ["N m", "moment on the platform at the mobile origin, fixed axes"],
        "ref_fx" | "ref_fy" | "ref_fz" => ["N", "the same in the reference state"],
        "ref_mx" | "ref_my" | "ref_mz" => ["N m", "the same in the reference state"],
        _ => ["", ""],
    }
}

/// Values of [`OF_READING`] at a condition, SI.
pub(super) fn of_reading(at: &Condition) -> Vec<f64> {
    let mut values = vec![at.approach.sign(), at.delta_t, at.elapsed];
    values.extend(at.pose.to_array());
    values.extend(at.wrench.to_array());
    values.extend(at.reference.to_array());
    values
}

/// Values of [`OF_LEG`] for one leg (from zero) at a condition, SI; legs count from 1 in formulas.
pub(super) fn of_leg(machine: &Machine, at: &Condition, leg: usize) -> [f64; 9] {
    let (f, f0, n) = (at.force[leg], at.reference_force[leg], at.legs.directions[leg]);
    let (q, q_home) = (at.commanded_lengths[leg], machine.home_lengths[leg]);
    [f, f0, f - f0, q, q_home, n.x, n.y, n.z, (leg + 1) as f64]
}

/// Names and values as `f = 12, q = 0.2, ...` for messages, only those that `mentioned` keeps.
pub(super) fn describe(names: &[&str], values: &[f64], mentioned: impl Fn(usize) -> bool) -> String {
    let shown = (0..names.len()).filter(|&k| mentioned(k));
    shown.map(|k| format!("{} = {:.6}", names[k], Shown(values[k]))).collect::<Vec<_>>().join(", ")
}

/// A number in its shortest ordinary form.
struct Shown(f64);

impl std::fmt::Display for Shown {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-3..1e6).contains(&size) {
            write!(out, "{}", self.0)
        } else {
            write!(out, "{:.4e}", self.0)
        }
    }
}
