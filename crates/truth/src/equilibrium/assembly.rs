//! Imbalance of the structure and its derivatives.
//!
//! Terms of relative size force / (stiffness * length), about 1e-4, are kept where the legs themselves give them and left out
//! for brackets, yielding bodies and bent joints: Newton's method then gains four digits a step instead of doubling them.

use hexbench_core::{Matrix3, Matrix6, Vector3, Vector6};

use super::{Body, leg::Leg};
use crate::{
    Setup,
    linear::{MOST, Square},
    setup::Cable,
    so3,
};

/// Where each body's unknowns begin.
#[derive(Debug, Clone, Copy)]
pub(super) struct Layout {
    pub plate: usize,
    pub base: Option<usize>,
    pub loaded: Option<usize>,
    pub unknowns: usize,
    /// Scale of forces per length, N/m.
    pub stiffness: f64,
    /// Scale of moments per force, m.
    pub radius: f64,
}

impl Layout {
    pub(super) fn of(setup: &Setup) -> Self {
        let base = setup.base_compliance.map(|_| 12);
        let loaded = setup.plate_compliance.map(|_| if base.is_some() { 18 } else { 12 });
        let unknowns = 12 + 6 * usize::from(base.is_some()) + 6 * usize::from(loaded.is_some());
        let softness: f64 = setup.laws.iter().map(|l| l.compliance).sum::<f64>() / 6.0;
        let radius = setup.platform_joints.iter().map(nalgebra::Matrix::norm).sum::<f64>() / 6.0;
        Self { plate: 6, base, loaded, unknowns, stiffness: 1.0 / softness, radius }
    }
}

/// Bodies of the structure.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bodies {
    /// The body that the legs hold.
    pub plate: Body,
    /// The body on which the legs stand, its origin at the base center.
    pub base: Body,
    /// The body that is loaded and measured; the plate itself unless that yields.
    pub loaded: Body,
}

/// Force and moment about the origin of a body, fixed axes.
#[derive(Debug, Clone, Copy)]
struct Resultant {
    force: Vector3,
    moment: Vector3,
}

/// External load on the loaded body, about its origin.
fn external(setup: &Setup, body: &Body) -> Resultant {
    let mut sum = Resultant { force: setup.wrench.force, moment: setup.wrench.moment };
    let mut add = |arm: Vector3, force: Vector3| {
        sum.force += force;
        sum.moment += arm.cross(&force);
    };
    for f in &setup.forces {
        add(body.axes * f.point, f.force);
    }
    for cable in &setup.cables {
        let arm = body.axes * cable.attachment;
        let pull = cable.anchor - body.origin - arm;
        let length = pull.norm();
        add(arm, pull * (cable.stiffness * (length - cable.free_length) / length));
    }
    sum
}

/// What is out of balance, scaled to newtons, in the order of the unknowns (legs, plate, base, loaded).
pub(super) fn imbalance(setup: &Setup, layout: &Layout, bodies: &Bodies, legs: &[Leg; 6]) -> [f64; MOST] {
    let mut r = [0.0; MOST];
    let mut on_plate = external(setup, &bodies.loaded);
    let on_loaded = on_plate;
    let mut on_base = Resultant { force: Vector3::zeros(), moment: Vector3::zeros() };
    on_plate.moment += (bodies.loaded.origin - bodies.plate.origin).cross(&on_plate.force);
    for (i, leg) in legs.iter().enumerate() {
        r[i] = layout.stiffness * (leg.length - setup.leg_lengths[i] - leg.point.elongation);
        on_plate.force += leg.upper_force;
        on_plate.moment += leg.upper_arm.cross(&leg.upper_force) + leg.upper_moment;
        on_base.force += leg.lower_force;
        on_base.moment += leg.lower_arm.cross(&leg.lower_force) + leg.lower_moment;
    }
    put(&mut r, layout.plate, &on_plate.force, &(on_plate.moment / layout.radius));
    let mut gap = |start: usize, d: &Vector6| {
        let (u, w) = (d.fixed_rows::<3>(0).into_owned(), d.fixed_rows::<3>(3).into_owned());
        put(&mut r, start, &(u * layout.stiffness), &(w * (layout.stiffness * layout.radius)));
    };
    if let (Some(start), Some(compliance)) = (layout.base, &setup.base_compliance) {
        let ground = Body::upright(setup.base_centre);
        gap(start, &yielding_gap(&bodies.base, &ground, &on_base, compliance));
    }
    if let (Some(start), Some(compliance)) = (layout.loaded, &setup.plate_compliance) {
        gap(start, &yielding_gap(&bodies.loaded, &bodies.plate, &on_loaded, compliance));
    }
    r
}

/// Displacement of a body relative to its support minus the compliance times the load on it, in the support's axes. The
/// load is the one conjugate to translation and rotation vector, so that the support stores energy.
fn yielding_gap(body: &Body, support: &Body, load: &Resultant, compliance: &Matrix6) -> Vector6 {
    let d = body.relative_to(support);
    let turn = d.fixed_rows::<3>(3).into_owned();
    let force = support.axes.tr_mul(&load.force);
    let moment = so3::left_jacobian_transposed(&turn) * support.axes.tr_mul(&load.moment);
    d - compliance * Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

/// Derivatives of [`imbalance`] by the scaled unknowns.
pub(super) fn derivatives(setup: &Setup, layout: &Layout, bodies: &Bodies, legs: &[Leg; 6]) -> Square {
    let mut a = [[0.0; MOST]; MOST];
    for (i, leg) in legs.iter().enumerate() {
        length_row(&mut a, layout, i, leg);
        force_column(&mut a, layout, i, leg);
        plate_block(&mut a, setup, layout, leg);
    }
    for bracket in &setup.brackets {
        let (moved, pulled) = (&legs[bracket.displaced], &legs[bracket.pulled]);
        let along = moved.direction.dot(&(bracket.compliance * pulled.direction));
        a[bracket.displaced][bracket.pulled] -= layout.stiffness * along * pulled.point.force_slope;
    }
    for cable in &setup.cables {
        cable_block(&mut a, layout, cable, &bodies.loaded);
    }
    if let (Some(start), Some(compliance)) = (layout.base, &setup.base_compliance) {
        base_rows(&mut a, layout, start, compliance, legs);
    }
    if let Some(start) = layout.loaded {
        loaded_rows(&mut a, start, layout.plate, &bodies.plate.axes);
    }
    a
}

fn length_row(a: &mut Square, layout: &Layout, i: usize, leg: &Leg) {
    a[i][i] = -layout.stiffness * leg.point.elongation_slope;
    put(&mut a[i], layout.plate, &leg.direction, &(leg.upper_arm.cross(&leg.direction) / layout.radius));
    if let Some(start) = layout.base {
        put(&mut a[i], start, &-leg.direction, &(leg.direction.cross(&leg.lower_arm) / layout.radius));
    }
}

fn force_column(a: &mut Square, layout: &Layout, i: usize, leg: &Leg) {
    let pull = -leg.direction * leg.point.force_slope;
    let moment = leg.upper_arm.cross(&pull) / layout.radius;
    for axis in 0..3 {
        a[layout.plate + axis][i] = pull[axis];
        a[layout.plate + 3 + axis][i] = moment[axis];
    }
}

/// Derivative of the balance of the plate by its own twist: legs turn under tension, bent joints push back.
fn plate_block(a: &mut Square, setup: &Setup, layout: &Layout, leg: &Leg) {
    let across = leg.across();
    let (kb, kp) = (setup.base_joint_stiffness, setup.platform_joint_stiffness);
    let turning = (leg.point.force + (kb + kp) / leg.length) / leg.length;
    let arm = so3::skew(&leg.upper_arm);
    let force_by_shift = across * -turning;
    let mut force_by_turn = -force_by_shift * arm;
    let mut moment_by_shift = Matrix3::zeros();
    let mut moment_by_turn = so3::skew(&leg.upper_force) * arm;
    if kp != 0.0 {
        let rest = so3::skew(&leg.platform_rest);
        force_by_turn -= across * rest * (kp / leg.length);
        moment_by_shift = rest * across * (kp / leg.length);
        moment_by_turn += so3::skew(&leg.direction) * rest * kp - moment_by_shift * arm;
    }
    moment_by_shift += arm * force_by_shift;
    moment_by_turn += arm * force_by_turn;
    let (k, r) = (layout.stiffness, layout.radius);
    let start = layout.plate;
    add_block(a, start, start, &force_by_shift, 1.0 / k);
    add_block(a, start, start + 3, &force_by_turn, 1.0 / (k * r));
    add_block(a, start + 3, start, &moment_by_shift, 1.0 / (k * r));
    add_block(a, start + 3, start + 3, &moment_by_turn, 1.0 / (k * r * r));
}

/// Derivative of the balance of the plate by the twist of the body that the cable holds: its stretch, not its turning.
fn cable_block(a: &mut Square, layout: &Layout, cable: &Cable, body: &Body) {
    let arm = body.axes * cable.attachment;
    let along = (cable.anchor - body.origin - arm).normalize();
    let force_by_shift = along * along.transpose() * -cable.stiffness;
    let lever = so3::skew(&arm);
    let (k, r) = (layout.stiffness, layout.radius);
    let (row, column) = (layout.plate, layout.loaded.unwrap_or(layout.plate));
    add_block(a, row, column, &force_by_shift, 1.0 / k);
    add_block(a, row, column + 3, &(-force_by_shift * lever), 1.0 / (k * r));
    add_block(a, row + 3, column, &(lever * force_by_shift), 1.0 / (k * r));
    add_block(a, row + 3, column + 3, &(-lever * force_by_shift * lever), 1.0 / (k * r * r));
}

fn base_rows(a: &mut Square, layout: &Layout, start: usize, compliance: &Matrix6, legs: &[Leg; 6]) {
    for k in 0..6 {
        a[start + k][start + k] = 1.0;
    }
    for (i, leg) in legs.iter().enumerate() {
        let pull = leg.direction * leg.point.force_slope;
        let moment = leg.lower_arm.cross(&pull);
        let d = compliance * Vector6::new(pull.x, pull.y, pull.z, moment.x, moment.y, moment.z);
        for axis in 0..3 {
            a[start + axis][i] = -layout.stiffness * d[axis];
            a[start + 3 + axis][i] = -layout.stiffness * layout.radius * d[3 + axis];
        }
    }
}

fn loaded_rows(a: &mut Square, start: usize, plate: usize, axes: &Matrix3) {
    let to_plate_axes = axes.transpose();
    for offset in [0, 3] {
        add_block(a, start + offset, start + offset, &to_plate_axes, 1.0);
        add_block(a, start + offset, plate + offset, &to_plate_axes, -1.0);
    }
}

fn put(row: &mut [f64; MOST], start: usize, first: &Vector3, second: &Vector3) {
    row[start..start + 3].copy_from_slice(first.as_slice());
    row[start + 3..start + 6].copy_from_slice(second.as_slice());
}

fn add_block(a: &mut Square, row: usize, column: usize, block: &Matrix3, factor: f64) {
    for i in 0..3 {
        for j in 0..3 {
            a[row + i][column + j] += block[(i, j)] * factor;
        }
    }
}
