//! `parameters.json`: numbers with names.

use hexbench_model::estimation::parameters::stiffness_name;
use std::collections::BTreeSet;

use serde::Deserialize;

use super::AnswerFault;
use super::fault::place_of_key;
use crate::challenge::folder::PARAMETERS;

const FORMAT: &str = "parameters/1";
/// Unit of the numbers that are scored.
const STIFFNESS_UNIT: &str = "N/um";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    format: String,
    parameters: Vec<Number>,
}

/// A number with its name.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Number {
    /// `leg-1.stiffness`, `base-compliance.rotation-x`, ...
    pub name: String,
    /// Value.
    pub value: f64,
    /// Standard uncertainty (k = 1), when stated.
    #[serde(default)]
    pub std: Option<f64>,
    /// Unit of both.
    pub unit: String,
}

/// The numbers, or everything that is wrong with them.
pub(super) fn read(text: &str) -> Result<Vec<Number>, Vec<AnswerFault>> {
    let file: File = serde_json::from_str(text).map_err(|e| vec![AnswerFault::json(PARAMETERS, &e)])?;
    let mut faults = Vec::new();
    if file.format != FORMAT {
        let place = format!("{}format", place_of_key(text, "format", 0));
        let rule = format!("\"{}\": the format must be \"{FORMAT}\"", file.format);
        faults.push(
            AnswerFault::new(PARAMETERS, &place, &rule).then(format!("Write \"format\": \"{FORMAT}\".")),
        );
    }
    let mut names = BTreeSet::new();
    let stiffnesses: Vec<String> = (0..6).map(stiffness_name).collect();
    for (k, number) in file.parameters.iter().enumerate() {
        let mut fault = |key: &str, rule: &str, next: &str| {
            let place = format!("{}parameters[{k}].{key} ({})", place_of_key(text, "name", k), number.name);
            faults.push(AnswerFault::new(PARAMETERS, &place, rule).then(next));
        };
        if !names.insert(number.name.as_str()) {
            fault("name", "this name is given twice", "Keep one of them.");
        }
        if let Some(std) = number.std.filter(|std| *std <= 0.0) {
            let rule = format!("{std}: a standard uncertainty is positive; leave it out if there is none");
            fault("std", &rule, "Write a positive number, or leave the key out.");
        }
        let is_scored = stiffnesses.contains(&number.name);
        if is_scored && number.unit != STIFFNESS_UNIT {
            let rule = format!("\"{}\": the unit of a leg stiffness is {STIFFNESS_UNIT}", number.unit);
            fault("unit", &rule, "Write \"unit\": \"N/um\", and the value in newtons for a micrometer.");
        }
    }
    if faults.is_empty() { Ok(file.parameters) } else { Err(faults) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        read(text).unwrap_err()[0].to_string()
    }

    fn file(number: &str) -> String {
        format!("{{\"format\": \"parameters/1\", \"parameters\": [{number}]}}")
    }

    #[test]
    fn a_number_may_come_without_uncertainty() {
        let one = r#"{"name": "leg-1.stiffness", "value": 4.2, "unit": "N/um"}"#;
        let two = r#"{"name": "leg-2.stiffness", "value": 4.2, "std": null, "unit": "N/um"}"#;
        let found = read(&file(&format!("{one}, {two}"))).unwrap();
        assert_eq!((found.len(), found[0].std, found[1].std), (2, None, None));
        assert_eq!(read(&file("")).unwrap(), []);
    }

    #[test]
    fn every_fault_has_its_place() {
        let one = r#"{"name": "leg-1.stiffness", "value": 4.2, "unit": "N/um"}"#;
        for (text, expected) in [
            ("", "line 1"),
            ("{\"format\": \"parameters/1\"}", "the key `parameters` is missing"),
            ("{\"format\": \"parameters/2\", \"parameters\": []}", "the format must be \"parameters/1\""),
            (&file(&one.replace("4.2", "NaN")), "line 1, column"),
            (&file(&one.replace("4.2", "1e999")), "number out of range"),
            (&file(&one.replace("4.2", "null")), "expected a number, found nothing"),
            (&file(&one.replace("value", "vlaue")), "unknown key `vlaue`"),
            (&file(&one.replace("N/um", "N/m")), "parameters[0].unit (leg-1.stiffness)"),
            (
                &file(&format!("{one},{one}")),
                "parameters[1].name (leg-1.stiffness): this name is given twice",
            ),
            (
                &file(&one.replace("\"unit\"", "\"std\": -1, \"unit\"")),
                "-1: a standard uncertainty is positive",
            ),
        ] {
            let found = fault(text);
            assert!(found.starts_with(PARAMETERS) && found.contains(expected), "{text}: {found}");
        }
    }
}
