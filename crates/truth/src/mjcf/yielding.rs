//! A body on springs: three slides, then three hinges at its origin.

use super::{element::Element, part::Springs};

/// Names and axes of the joints.
const JOINTS: [(&str, &str, [f64; 3]); 6] = [
    ("x", "slide", [1.0, 0.0, 0.0]),
    ("y", "slide", [0.0, 1.0, 0.0]),
    ("z", "slide", [0.0, 0.0, 1.0]),
    ("rx", "hinge", [1.0, 0.0, 0.0]),
    ("ry", "hinge", [0.0, 1.0, 0.0]),
    ("rz", "hinge", [0.0, 0.0, 1.0]),
];

/// Joints of a body of the given mass (kg) and radius (m) on springs; directions in which it is rigid get none.
pub(super) fn joints(body: &str, springs: &Springs, mass: f64, radius: f64) -> Vec<Element> {
    let joint = |((name, kind, axis), spring): (&(&str, &str, [f64; 3]), &Option<f64>)| {
        let inertia = if *kind == "slide" { mass } else { mass * radius * radius };
        spring.map(|stiffness| {
            Element::new("joint")
                .text("name", format!("{body}-{name}"))
                .text("type", *kind)
                .numbers("axis", axis)
                .number("stiffness", stiffness)
                .number("damping", damping(stiffness, inertia))
        })
    };
    JOINTS.iter().zip(springs).filter_map(joint).collect()
}

/// Half the critical damping of a mass on a spring: rest comes soon. It has no part in the state of rest.
pub(super) fn damping(stiffness: f64, inertia: f64) -> f64 {
    (stiffness * inertia).sqrt()
}
