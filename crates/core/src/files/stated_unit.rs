//! The unit a column or key states for its quantity.

use super::units::{PLAIN, Unit, unit_named};
use super::{Dimension, FileProblem};

/// The unit written as `text` for a quantity of a kind; `usual` is the quantity's name with its usual unit.
pub(crate) fn stated_unit(
    quantity: &str,
    kind: Dimension,
    usual: String,
    text: Option<&str>,
) -> Result<&'static Unit, FileProblem> {
    let quantity = quantity.to_owned();
    let Some(text) = text.map(str::trim).filter(|text| !text.is_empty()) else {
        return if kind == Dimension::Number {
            Ok(&PLAIN)
        } else {
            Err(FileProblem::NoUnit { quantity, kind, usual })
        };
    };
    match unit_named(text, kind) {
        Some(unit) if unit.kind == kind => Ok(unit),
        Some(unit) => {
            let (unit, unit_kind) = (unit.name.into(), unit.kind);
            Err(FileProblem::WrongKindOfUnit { unit, unit_kind, quantity, kind, usual })
        }
        None => Err(FileProblem::UnknownUnit { unit: text.into(), quantity, kind, usual }),
    }
}
