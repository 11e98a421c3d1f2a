//! The load as arrows: force and moment at the mobile origin, to scale within the drawing.

use crate::number::significant;
use crate::plot::Wireframe;
use hexbench_core::Vector3;
use hexbench_model::estimation::campaign::Condition;

/// Length of the larger arrow, as a share of the longest leg.
const LENGTH: f64 = 0.55;
/// Share of the other one, force over moment by the platform's arm, below which an arrow says nothing.
const LEAST: f64 = 0.02;

/// The drawing with the change of force and of moment.
pub(super) fn arrows(drawing: Wireframe, at: &Condition) -> Wireframe {
    let force = at.wrench.force - at.reference.force;
    let moment = at.wrench.moment - at.reference.moment;
    let arm = at.legs.arms.iter().map(Vector3::norm).fold(f64::MIN_POSITIVE, f64::max);
    let sizes = [force.norm(), moment.norm() / arm];
    let largest = sizes[0].max(sizes[1]);
    let length = LENGTH * at.legs.lengths.max();
    let named = [(force, sizes[0], "N", force.norm()), (moment, sizes[1], "N m", moment.norm())];
    named.into_iter().filter(|(_, size, ..)| *size > LEAST * largest).fold(
        drawing,
        |drawing, (v, size, unit, norm)| {
            let long = length * size / largest;
            let (from, along) = (at.place.translation, v / norm);
            // A load that presses comes from outside.
            let ends = if along.z < 0.0 { [from - along * long, from] } else { [from, from + along * long] };
            drawing.arrow(format!("{} {unit}", significant(norm, 3)), ends.map(Into::into))
        },
    )
}

/// Three numbers.
pub(super) fn list(v: &Vector3) -> String {
    v.iter().map(|x| significant(*x, 3)).collect::<Vec<_>>().join(", ")
}
