//! Reading the sealed truth of a scene.

use std::path::Path;

use hexbench_core::files::{
    Dimension, Fault, FileError, FileProblem, Format, Item, KeyUnit, TomlSection, read_toml,
};
use serde_json::{Map, Value};

use crate::{Mechanism, mechanisms};

const TRUTH: Format = Format {
    name: "truth/1",
    keys: &[
        KeyUnit::plain("format"),
        KeyUnit::with_unit("leg_stiffness", Dimension::Stiffness, "N_per_um"),
        KeyUnit::plain("effect"),
    ],
};

/// What the drawings do not say.
#[derive(Debug)]
pub(super) struct Sealed {
    pub(super) leg_stiffness: [f64; 6],
    pub(super) mechanisms: Vec<Box<dyn Mechanism>>,
}

/// Reads a file of the format `truth/1`.
pub(super) fn read_truth(path: &Path) -> Result<Sealed, FileError> {
    read_toml(path, TRUTH, |top| {
        Ok(Sealed {
            leg_stiffness: stiffness(top)?,
            mechanisms: match top.get("effect") {
                Some(effects) => {
                    let one = |item: &Item<'_>| stated_effect(item).map(|(effect, _)| effect);
                    effects.list()?.iter().map(one).collect::<Result<_, _>>()?
                }
                None => Vec::new(),
            },
        })
    })
}

fn stiffness(top: &TomlSection<'_>) -> Result<[f64; 6], Fault> {
    let mut stiffness = [0.0; 6];
    for (k, item) in stiffness.iter_mut().zip(top.require("leg_stiffness")?.exactly::<6>("six stiffnesses")?)
    {
        *k = item.positive("a stiffness")?;
    }
    Ok(stiffness)
}

/// Reads an effect with its parameters: the mechanism, and the parameters of which [`mechanisms::build`] makes it again.
///
/// # Errors
/// A [`Fault`] at a table without id, or at what the effect cannot have.
pub fn stated_effect(item: &Item<'_>) -> Result<(Box<dyn Mechanism>, Value), Fault> {
    let entries = item.entries()?;
    let (ids, parameters): (Vec<_>, Vec<_>) = entries.iter().partition(|entry| entry.key() == "id");
    let Some(id) = ids.first() else {
        return Err(item.fault(FileProblem::MissingKey { key: "id".into() }));
    };
    let values = parameters.iter().map(|p| Ok((p.key().to_owned(), json(p)?)));
    let parameters = values.collect::<Result<Map<_, _>, Fault>>()?;
    // A formula is what is wrong with a law of one's own.
    let formula = entries.iter().find(|entry| entry.key() == "elongation").unwrap_or(id);
    let parameters = Value::Object(parameters);
    let built = mechanisms::build(id.string()?, parameters.clone()).map_err(|wrong| {
        formula.fault(FileProblem::Rule {
            rule: wrong.to_string(),
            next: "docs/reference/file-formats.md lists the effects with their parameters.".into(),
        })
    })?;
    Ok((built, parameters))
}

fn json(item: &Item<'_>) -> Result<Value, Fault> {
    if item.is_list() {
        return Ok(Value::Array(item.list()?.iter().map(json).collect::<Result<_, _>>()?));
    }
    if item.is_string() {
        return item.string().map(Value::from);
    }
    if item.is_integer() {
        return Ok(item.whole(0).map(Value::from).unwrap_or(Value::from(item.number()?)));
    }
    item.number().map(Value::from)
}
