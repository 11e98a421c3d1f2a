//! Numbers and poses in XML, with the line they stand on.

use std::borrow::Cow;

use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use roxmltree::Node;

use super::super::FilePlace;
use super::super::error::Fault;
use super::super::number::usable;
use crate::Vector3;

/// The text without a first `<?...?>`, which is often malformed and says nothing here; lines keep their numbers.
pub(super) fn without_declaration(text: &str) -> Cow<'_, str> {
    let begins = text.trim_start_matches('\u{feff}').trim_start().starts_with("<?");
    match text.find("?>").filter(|_| begins) {
        None => Cow::Borrowed(text.trim_start_matches('\u{feff}')),
        Some(end) => {
            let lines = text[..end].matches('\n').count();
            Cow::Owned("\n".repeat(lines) + &text[end + 2..])
        }
    }
}

/// What is wrong with text that is no XML.
pub(super) fn fault_of(wrong: &roxmltree::Error) -> Fault {
    let at = wrong.pos();
    let rule = format!("this is not XML: {}", wrong.to_string().split(" at ").next().unwrap_or_default());
    let next = "Expand templates (xacro, erb) first, or write the model anew from the program that made it.";
    Fault::rule(line(at.row), rule, next)
}

fn line(row: u32) -> FilePlace {
    FilePlace { line: Some(row.into()), ..FilePlace::file() }
}

/// A fault of an element.
pub(super) fn fault(node: Node<'_, '_>, rule: impl Into<String>, next: &str) -> Fault {
    let row = node.document().text_pos_at(node.range().start).row;
    let place = line(row).with_name(node.tag_name().name());
    Fault::rule(place, rule, next)
}

/// The first child element of a name.
pub(super) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|c| c.has_tag_name(name))
}

/// The text of the first child element of a name.
pub(super) fn text<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    child(node, name).and_then(|c| c.text()).map(str::trim)
}

/// So many numbers.
pub(super) fn numbers<const N: usize>(node: Node<'_, '_>, text: &str) -> Result<[f64; N], Fault> {
    let parsed: Option<Vec<f64>> =
        text.split_whitespace().map(|word| word.parse().ok().filter(|x: &f64| x.is_finite())).collect();
    let all = parsed.and_then(|all| <[f64; N]>::try_from(all).ok()).ok_or_else(|| {
        fault(
            node,
            format!("{text:?} is not {N} numbers"),
            "Correct it, or expand the template it comes from.",
        )
    })?;
    if all.iter().any(|x| usable(*x).is_err()) {
        return Err(fault(
            node,
            format!("{text:?} holds a number too large for any machine"),
            "Correct the exponent.",
        ));
    }
    Ok(all)
}

/// A direction of length 1.
pub(super) fn direction(node: Node<'_, '_>, text: &str) -> Result<Vector3, Fault> {
    let axis = Vector3::from(numbers::<3>(node, text)?);
    axis.try_normalize(1e-9)
        .ok_or_else(|| fault(node, "the axis has no length", "Correct the direction of the axis."))
}

/// Position, and roll, pitch, yaw about fixed x, y, z (rad), as URDF and SDF state a pose.
pub(super) fn pose([x, y, z, roll, pitch, yaw]: [f64; 6]) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Isometry3::from_parts(Translation3::new(x, y, z), turn)
}
