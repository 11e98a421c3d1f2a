//! Loads that nobody wrote down: rows that state the same load in both states, at which the platform moves as under a load.
//!
//! A machine without a change of load stands still, but for drift, warmth and what earlier loads leave. Where the movement is that of the
//! springs under one component of the loads, and the file has none of that component in any row, a column is missing. The load that
//! a deflection `d` takes, by the springs of the other rows:
//!
//! ```text
//! W = J^-T C^-1 J^-1 d
//! ```

use std::collections::BTreeMap;

use hexbench_core::statistics::{Welford, median, root_mean_square};
use hexbench_core::words::to_digits;
use hexbench_core::{Dataset, Hexapod, Observation, Vector6, Wrench};

use super::super::blunders::WRENCH;
use super::super::finding::{Finding, FindingKind};
use super::deflections::BesideSprings;
use crate::estimation::campaign::Condition;
use crate::estimation::linearization::{Linearization, ModelPoint};

/// Error over the noise, and share of the deflection of a condition with a load, from which a condition without one moves.
const MOVES: f64 = 10.0;
const MOVES_SHARE: f64 = 0.2;
/// Share of the squared loads, moments over the radius of the platform, that one component has where its column is missing.
const ONE_COMPONENT: f64 = 0.9;
/// Fewer conditions may be mistakes of single rows.
const FEWEST_CONDITIONS: usize = 2;
/// One of so many conditions without a load has to move.
const ONE_OF: usize = 2;
/// Digits of a load that springs tell.
const DIGITS: usize = 3;

/// Readings under the same pose, loads and approach that differ by this share of the readings of the file are none of one load.
const OTHER_LOADS: f64 = 0.5;
/// So many readings have to be of poses at which no load is entered.
const FEWEST_READINGS: usize = 3;

/// The finding about poses at which every load is zero, and readings differ as under different loads: they were not entered.
pub(crate) fn not_entered(data: &Dataset) -> Option<Finding> {
    let rows: Vec<&Observation> = data.observations.iter().filter(|o| o.block == 0).collect();
    let is_empty = |o: &&Observation| o.wrench == Wrench::default() && !states_no_load(o);
    // Poses are gathered only where a load is missing: most files have none.
    if !rows.iter().any(is_empty) {
        return None;
    }
    let mut poses: BTreeMap<[u64; 6], Vec<&Observation>> = BTreeMap::new();
    for o in &rows {
        poses.entry(o.pose.bits()).or_default().push(o);
    }
    poses.retain(|_, rows| rows.len() >= FEWEST_READINGS && rows.iter().all(is_empty));
    let scale = Scale::of(&rows);
    let of_other_loads = poses.into_values().filter(|rows| scale.spread(rows) > OTHER_LOADS);
    let mut lines: Vec<u64> = of_other_loads.flatten().map(|o| o.line).collect();
    lines.sort_unstable();
    let (first, last) = (lines.first()?, lines.last()?);
    let is_whole = lines.len() == rows.len();
    let which =
        if is_whole { format!("all {} rows", rows.len()) } else { format!("lines {first} to {last}") };
    let kind = if is_whole { FindingKind::IdleColumn } else { FindingKind::Load };
    Some(Finding {
        text: format!(
            "every load is zero in {which}, yet readings at the same pose differ as under different loads: the loads were not entered"
        ),
        next: "enter the loads of these rows in fx_N ... mz_Nm".to_owned(),
        size: which,
        rows: if is_whole { Vec::new() } else { lines },
        ..Finding::of(kind)
    })
}

/// Sizes of the numbers of a file, root mean square.
struct Scale([f64; 6]);

impl Scale {
    fn of(rows: &[&Observation]) -> Self {
        let size = |k: usize| root_mean_square(rows.iter().filter(|o| o.is_read(k)).map(|o| o.measured[k]));
        Self(std::array::from_fn(|k| size(k).unwrap_or(f64::INFINITY)))
    }

    /// How far readings under one reference load and approach are from their mean, over these sizes.
    fn spread(&self, rows: &[&Observation]) -> f64 {
        let mut alike: BTreeMap<_, [Welford; 6]> = BTreeMap::new();
        for o in rows {
            let key = (o.reference.to_array().map(f64::to_bits), o.approach.sign().to_bits());
            let all = alike.entry(key).or_default();
            for k in (0..6).filter(|&k| o.is_read(k)) {
                all[k].add(o.measured[k] / self.0[k]);
            }
        }
        let several = alike.into_values().flatten().filter(|all| all.count() > 1);
        let sums = several.map(|all| (all.sum_of_squares(), (all.count() - 1) as f64));
        let (squares, count) = sums.fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
        if count > 0.0 { f64::sqrt(squares / count) } else { 0.0 }
    }
}

/// A condition that states no load, and the load that its reading takes.
struct Moving {
    condition: usize,
    load: Vector6,
}

/// The finding about rows that state no load and move as under one that no row states.
pub(super) fn moving(hexapod: &Hexapod, data: &Dataset, springs: &BesideSprings) -> Option<Finding> {
    let groups = &springs.campaign.groups;
    let (unloaded, loaded): (Vec<usize>, Vec<usize>) =
        (0..groups.len()).partition(|&i| states_no_load(&groups[i].mean));
    if unloaded.is_empty() {
        return None;
    }
    let level = |i: usize| springs.conditions[i][0].norm() / 6_f64.sqrt();
    let least = MOVES.max(MOVES_SHARE * median(loaded.into_iter().map(level))?);
    let few = FEWEST_CONDITIONS.max(unloaded.len().div_ceil(ONE_OF));
    let moving: Vec<usize> = unloaded.into_iter().filter(|&i| level(i) > least).collect();
    if moving.len() < few {
        return None;
    }
    let part = springs.campaign.unwhitened_part(&moving);
    let there = Linearization::at_fit(&part, &ModelPoint::start(&part), |_, _| (), drop).ok()?;
    let of = |(condition, at): (usize, &Condition)| {
        Some(Moving { condition, load: load_of(at, &springs.compliances)? })
    };
    let moving = moving.into_iter().zip(&there.conditions).map(of).collect::<Option<Vec<_>>>()?;
    let component = one_component(&moving, hexapod.platform_radius())?;
    states_nothing_of(component, &data.observations).then(|| finding(data, springs, &moving, component))
}

/// True for a row that states the same load in both states.
pub fn states_no_load(row: &Observation) -> bool {
    row.wrench == row.reference
}

/// True where a component is zero in both states of all rows.
pub(crate) fn states_nothing_of(component: usize, rows: &[Observation]) -> bool {
    rows.iter().flat_map(|o| [o.wrench, o.reference]).all(|w| w.to_array()[component] == 0.0)
}

/// The name of a component, and the smallest and largest of its loads in words.
pub(crate) fn name_and_range(component: usize, loads: impl Iterator<Item = f64>) -> (&'static str, String) {
    let (name, unit) = WRENCH[component];
    let (least, most) = loads.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
    let [least, most] = [least, most].map(|load| to_digits(load, DIGITS));
    (name, format!("{name} from {least} to {most} {unit}"))
}

/// Wrench under which springs give the deflection that was read; none where the numbers read do not tell it.
fn load_of(at: &Condition, compliances: &Vector6) -> Option<Vector6> {
    let legs = at.legs.platform_jacobian.try_inverse()?;
    let elongation = legs * at.observer.try_inverse()? * at.reading;
    let load = legs.tr_mul(&elongation.component_div(compliances));
    (at.reads_pose && load.iter().all(|x| x.is_finite())).then_some(load)
}

/// The component that nearly all of the loads have in common.
fn one_component(moving: &[Moving], radius: f64) -> Option<usize> {
    let mut squares = [0.0; 6];
    for one in moving {
        for (k, square) in squares.iter_mut().enumerate() {
            *square += (if k < 3 { one.load[k] } else { one.load[k] / radius }).powi(2);
        }
    }
    let all: f64 = squares.iter().sum();
    (0..6).find(|&k| squares[k] > ONE_COMPONENT * all)
}

fn finding(data: &Dataset, springs: &BesideSprings, moving: &[Moving], component: usize) -> Finding {
    let (name, size) = name_and_range(component, moving.iter().map(|one| one.load[component]));
    let groups = moving.iter().flat_map(|one| &springs.campaign.groups[one.condition].rows);
    let mut rows: Vec<u64> = groups.map(|&row| data.observations[row as usize].line).collect();
    rows.sort_unstable();
    let text = format!(
        "{} rows state the same load in both states, yet the platform moves as under {size}; {name} is zero in every row of the file: \
         it was applied, and not written down",
        rows.len()
    );
    let next = format!(
        "write {name} into these rows as it was applied; until then the other rows are diagnosed without them"
    );
    Finding { rows, size, text, next, ..Finding::of(FindingKind::Load) }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

    use hexbench_core::Vector3;

    use super::super::gross_readings;
    use super::super::test_cases::{CASES, read};
    use super::*;

    /// What is said of a bundled case whose loads are written otherwise.
    fn told(case: &str, write: impl Fn(&mut Observation)) -> Vec<Finding> {
        let (hexapod, mut data) = read(case);
        data.observations.iter_mut().for_each(write);
        gross_readings(&hexapod, &data)
    }

    #[test]
    fn a_component_that_was_not_written_down_is_named_with_its_size_and_rows() {
        let (hexapod, data) = read("friction");
        for (name, component, most) in [("fx", 0, 100.0), ("mx", 3, 10.0)] {
            let applied = |o: &&Observation| o.wrench.to_array()[component] != 0.0;
            let lines: Vec<u64> = data.observations.iter().filter(applied).map(|o| o.line).collect();
            let found = told("friction", |o| {
                let mut load = o.wrench.to_array();
                load[component] = 0.0;
                o.wrench = Wrench::from_array(load);
            });
            let [one] = &found[..] else { panic!("{name}: {found:?}") };
            assert_eq!((one.kind, &one.rows), (FindingKind::Load, &lines), "{name}");
            let largest: f64 =
                one.size.split(' ').rev().nth(if component < 3 { 1 } else { 2 }).unwrap().parse().unwrap();
            assert!(one.size.starts_with(name) && (largest / most - 1.0).abs() < 0.1, "{}", one.size);
        }
        assert!(gross_readings(&hexapod, &data).is_empty());
    }

    #[test]
    fn loads_that_were_not_entered_at_a_pose_or_anywhere_are_told_with_their_lines() {
        let preload = Wrench { force: Vector3::z() * -50.0, ..Wrench::default() };
        for case in CASES {
            let told = |is_empty: fn(i64) -> bool| {
                let (_, mut data) = read(case);
                for o in &mut data.observations {
                    o.reference = preload;
                    if is_empty(o.pose_id) {
                        o.wrench = Wrench::default();
                    }
                }
                let lines =
                    data.observations.iter().filter(|o| is_empty(o.pose_id)).map(|o| o.line).collect();
                (not_entered(&data), lines)
            };
            let (found, lines): (_, Vec<u64>) = told(|pose| pose == 2);
            let found = found.unwrap();
            assert_eq!((found.kind, found.rows), (FindingKind::Load, lines), "{case}");
            let found = told(|_| true).0.unwrap();
            assert_eq!(
                (found.kind, found.rows.as_slice()),
                (FindingKind::IdleColumn, [].as_slice()),
                "{case}"
            );
            assert_eq!(told(|_| false).0, None, "{case}");
        }
    }

    #[test]
    fn rows_without_a_load_that_stand_still_warm_up_or_have_a_column_are_left_alone() {
        let is_pushed = |o: &Observation| o.wrench.force.x != 0.0;
        for case in CASES {
            // No load was on the machine: it stands still.
            let still = told(case, |o| {
                if is_pushed(o) {
                    (o.wrench, o.measured) = (o.reference, [0.0; 6]);
                }
            });
            assert_eq!(still, [], "{case}");
            // All legs grow: the platform rises, as it would under a vertical force, which other rows state.
            let warm = told(case, |o| {
                if is_pushed(o) {
                    (o.wrench, o.measured) = (o.reference, [0.0, 0.0, 2e-5, 0.0, 0.0, 0.0]);
                }
            });
            assert_eq!(warm, [], "{case}");
            // One condition alone may be a slip of its line.
            let slipped = told(case, |o| {
                if is_pushed(o) && o.pose_id == 1 {
                    o.wrench = o.reference;
                }
            });
            assert_eq!(slipped, [], "{case}");
        }
    }
}
