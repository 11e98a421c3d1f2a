//! Axes, points and orders that are not those of the file's conventions.

use hexbench_core::{Pose, Vector3};

use super::bench::{SPARSE, Share};
use super::fate::Fate;
use super::table::Table;
use super::units::{POSES, READINGS, WRENCHES, three};

const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]];

/// Every order and sign of axes but the right one; of readings and poses every sixth.
pub(super) fn turned(share: Share) -> Vec<Fate> {
    let signs = (0..8).map(|k: u8| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { 1.0 } else { -1.0 }));
    let ways: Vec<_> = signs.flat_map(|signs| ORDERS.map(|order| (order, signs))).skip(1).collect();
    let groups: [(&'static [[&'static str; 3]], usize); 3] = [(&WRENCHES, 1), (&READINGS, 6), (&POSES, 6)];
    let of = |(group, step): &(&'static [[&'static str; 3]], usize)| {
        let group = *group;
        ways.iter().step_by(*step).map(|way| (group, *way)).collect::<Vec<_>>()
    };
    let cases: Vec<_> = groups.iter().flat_map(of).collect();
    share.each(&cases, |(group, (order, signs))| {
        SPARSE.ask(SPARSE.readings.turned(group, *order, *signs).text())
    })
}

/// A table whose wrenches `[F; M]` are changed at the pose of their row.
fn with_wrenches(change: impl Fn(&Pose, [Vector3; 2]) -> [Vector3; 2]) -> Table {
    let old = &SPARSE.readings;
    let mut table = old.clone();
    for row in 0..old.rows.len() {
        let ([a, b, c], angles) = (three(old, row, POSES[0]), three(old, row, POSES[1]).map(f64::to_radians));
        let pose = Pose::from_array([a / 1e3, b / 1e3, c / 1e3, angles[0], angles[1], angles[2]]);
        for state in WRENCHES.chunks(2) {
            let wrench = [0, 1].map(|k| Vector3::from(three(old, row, state[k])));
            for (names, vector) in state.iter().zip(change(&pose, wrench)) {
                for (name, value) in names.iter().zip(vector.iter()) {
                    table.rows[row][old.column(name)] = value.to_string();
                }
            }
        }
    }
    table
}

/// Wrenches in other frames, about other points, of the other body.
pub(super) fn points(share: Share) -> Vec<Fate> {
    let about = |pose: &Pose, [f, m]: [Vector3; 2], arm: Vector3| [f, m + (pose.rotation() * arm).cross(&f)];
    let mut tables = vec![
        with_wrenches(|pose, wrench| wrench.map(|v| pose.rotation() * v)),
        with_wrenches(|pose, wrench| wrench.map(|v| pose.rotation().transpose() * v)),
        with_wrenches(|pose, [f, m]| [f, m + pose.translation.cross(&f)]),
        with_wrenches(|pose, [f, m]| [f, m - pose.translation.cross(&f)]),
        with_wrenches(|pose, [f, m]| [f, m + (pose.translation + Vector3::z() * 0.095).cross(&f)]),
        with_wrenches(|_, wrench| wrench.map(|v| -v)),
        with_wrenches(|_, [f, m]| [-f, m]),
        with_wrenches(|_, [f, m]| [f, -m]),
    ];
    for arm in [0.04, -0.04, 0.2, -0.2] {
        tables.push(with_wrenches(|pose, wrench| about(pose, wrench, Vector3::z() * arm)));
        tables.push(with_wrenches(|pose, wrench| about(pose, wrench, Vector3::x() * arm)));
    }
    // That the load acts at another point is an effect of the catalogue, and says so.
    share.each(&tables, |table| SPARSE.ask(table.text()).or_told_as("load-offset"))
}

/// The machine with its joints of one side or both in another order.
fn reordered(machine: &str, sides: &[&str], order: [usize; 6]) -> String {
    let mut lines: Vec<&str> = machine.lines().collect();
    for side in sides {
        let first = lines.iter().position(|line| line.starts_with(side)).unwrap() + 1;
        let old: Vec<&str> = lines[first..first + 6].to_vec();
        (0..6).for_each(|k| lines[first + k] = old[order[k]]);
    }
    lines.join("\n") + "\n"
}

/// Orders of legs: two exchanged, all shifted, reversed.
fn leg_orders() -> Vec<[usize; 6]> {
    let straight: [usize; 6] = std::array::from_fn(|k| k);
    let mut orders = vec![[5, 4, 3, 2, 1, 0]];
    for first in 0..6 {
        for second in first + 1..6 {
            let mut order = straight;
            order.swap(first, second);
            orders.push(order);
        }
    }
    orders.extend((1..6).map(|by| straight.map(|k| (k + by) % 6)));
    orders
}

/// Rows and legs in other orders.
pub(super) fn orders(share: Share) -> Vec<Fate> {
    let table = &SPARSE.readings;
    let rows = [
        |rows: &mut Vec<Vec<String>>| rows.reverse(),
        |rows: &mut Vec<Vec<String>>| rows.rotate_left(5),
        |rows: &mut Vec<Vec<String>>| rows.insert(9, rows[3].clone()),
        |rows: &mut Vec<Vec<String>>| rows.extend_from_within(..),
        |rows: &mut Vec<Vec<String>>| rows.sort(),
    ];
    let mut fates = share.each(&rows, |change| {
        let mut table = table.clone();
        change(&mut table.rows);
        SPARSE.ask(table.text())
    });
    for sides in [&["base_joints"][..], &["platform_joints"]] {
        fates.extend(share.each(&leg_orders(), |order| {
            SPARSE.ask_of(reordered(&SPARSE.machine, sides, *order), table.text())
        }));
    }
    fates
}
