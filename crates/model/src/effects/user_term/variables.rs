//! What a formula of a user term may mention.

use crate::effects::formula::Formula;
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// Variables that differ from leg to leg.
pub(super) const OF_LEG: [&str; 18] = [
    "f",
    "f0",
    "df",
    "q",
    "q_home",
    "nx",
    "ny",
    "nz",
    "nx_home",
    "ny_home",
    "nz_home",
    "leg",
    "df_next",
    "df_previous",
    "df_opposite",
    "df_others",
    "c_i",
    "k_i",
];
/// Variables of the reading.
pub(super) const OF_READING: [&str; 33] = [
    "approach", "delta_T", "elapsed", "a", "b", "c", "alpha", "beta", "gamma", "fx", "fy", "fz", "mx", "my",
    "mz", "ref_fx", "ref_fy", "ref_fz", "ref_mx", "ref_my", "ref_mz", "f_1", "f_2", "f_3", "f_4", "f_5",
    "f_6", "df_1", "df_2", "df_3", "df_4", "df_5", "df_6",
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
        "nx_home" | "ny_home" | "nz_home" => ["", "the same at the zero pose"],
        "leg" => ["", "number of the leg, 1 to 6"],
        "df_next" => ["N", "df of the leg with the next number, leg 1 after leg 6"],
        "df_previous" => ["N", "df of the leg with the number before"],
        "df_opposite" => ["N", "df of the leg three numbers on"],
        "df_others" => ["N", "sum of df over the five other legs"],
        "c_i" => ["m/N", "compliance of the leg's spring"],
        "k_i" => ["N/m", "stiffness of the leg's spring, 1/c_i"],
        "f_1" | "f_2" | "f_3" | "f_4" | "f_5" | "f_6" => ["N", "force of one leg under the load"],
        "df_1" | "df_2" | "df_3" | "df_4" | "df_5" | "df_6" => ["N", "df of one leg"],
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

/// Appends the values of [`OF_READING`] at a condition, SI.
pub(super) fn push_of_reading(at: &Condition, values: &mut Vec<f64>) {
    values.extend([at.approach.sign(), at.delta_t, at.elapsed]);
    values.extend(at.place.pose().to_array());
    values.extend(at.wrench.to_array());
    values.extend(at.reference.to_array());
    values.extend(at.force.iter());
    values.extend(at.force_change().iter());
}

/// Values of [`OF_LEG`] for one leg (from zero) at a condition, SI; legs count from 1 in formulas.
pub(super) fn of_leg(machine: &Machine, at: &Condition, leg: usize) -> [f64; OF_LEG.len()] {
    let (f, f0, n) = (at.force[leg], at.reference_force[leg], at.legs.directions[leg]);
    let (q, q_home) = (at.commanded_lengths[leg], machine.home_lengths[leg]);
    let df = at.force_change();
    let [next, previous, opposite] = [1, 5, 3].map(|on| df[(leg + on) % 6]);
    // Before anything is fitted a spring has no compliance, and its stiffness no value.
    let c = at.compliances[leg];
    let k = if c > 0.0 { c.recip() } else { 0.0 };
    let number = (leg + 1) as f64;
    let (change, others) = (f - f0, df.sum() - df[leg]);
    let home = machine.home_directions[leg];
    [
        f, f0, change, q, q_home, n.x, n.y, n.z, home.x, home.y, home.z, number, next, previous, opposite,
        others, c, k,
    ]
}

/// Values of all variables of a leg, for all legs at many conditions.
pub(crate) struct LegVariables {
    values: Vec<Vec<f64>>,
}

impl LegVariables {
    /// At these conditions.
    pub(crate) fn at(machine: &Machine, conditions: &[Condition]) -> Self {
        let of = |c: &Condition, leg: usize| {
            let mut values = Vec::with_capacity(OF_LEG.len() + OF_READING.len() + 1);
            values.extend(of_leg(machine, c, leg));
            push_of_reading(c, &mut values);
            values
        };
        Self { values: conditions.iter().flat_map(|c| (0..6).map(move |leg| of(c, leg))).collect() }
    }

    /// Names of the variables, in the order of their values.
    pub(crate) fn names() -> Vec<&'static str> {
        OF_LEG.into_iter().chain(OF_READING).collect()
    }

    /// Number of conditions.
    pub(crate) fn conditions(&self) -> usize {
        self.values.len() / 6
    }

    /// A formula with one name more, which has this value, at every condition and leg.
    pub(crate) fn values(&self, formula: &Formula, more: f64) -> Vec<[f64; 6]> {
        let mut row = Vec::with_capacity(OF_LEG.len() + OF_READING.len() + 1);
        let mut value = |values: &Vec<f64>| {
            row.clear();
            row.extend_from_slice(values);
            row.push(more);
            formula.value(&row)
        };
        let of = |six: &[Vec<f64>]| std::array::from_fn(|leg| value(&six[leg]));
        self.values.chunks_exact(6).map(of).collect()
    }
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
