//! The files from which a bench is made.

use std::borrow::Cow;
use std::sync::Arc;

use hexbench_core::files::{parse_hexapod, read_campaign_from};
use hexbench_core::{Dataset, Hexapod};
use hexbench_model::effects::user_term;
use hexbench_model::inference::misread::{AsMeant, Change};
use hexbench_model::{effects::term::Term, terms::catalogue};

use super::cases::BundledCase;
use super::refusal::{Refusal, RefusalKind};
use crate::wire::{FileText, ServerLimits};

/// What the three files are usually called.
pub(super) const USUAL_NAMES: [&str; 3] = ["hexapod.toml", "measurements.csv", "holdout.csv"];
/// Longest name of a file that is shown.
const LONGEST_NAME: usize = 80;

/// Texts of the three files, and their names for messages.
#[derive(Debug, Clone)]
pub(super) struct Files {
    pub(super) hexapod: String,
    pub(super) data: String,
    pub(super) holdout: Option<String>,
    pub(super) names: [String; 3],
    /// How they are read differently from what they say.
    pub(super) changes: Vec<Change>,
}

/// The same, read.
#[derive(Debug)]
pub(super) struct Contents {
    pub(super) hexapod: Hexapod,
    pub(super) data: Dataset,
    pub(super) holdout: Option<Dataset>,
    /// What the readers noticed.
    pub(super) warnings: Vec<String>,
}

impl Files {
    /// Those of a bundled case.
    pub(super) fn of_case(case: &BundledCase) -> Self {
        Self {
            hexapod: case.hexapod.to_owned(),
            data: case.data.to_owned(),
            holdout: Some(case.holdout.to_owned()),
            names: USUAL_NAMES.map(str::to_owned),
            changes: Vec::new(),
        }
    }

    /// Those somebody has given.
    pub(super) fn of_texts(hexapod: &FileText, data: &FileText, holdout: Option<&FileText>) -> Self {
        let held = holdout.map_or(USUAL_NAMES[2], |t| &t.name);
        Self {
            hexapod: hexapod.text.clone(),
            data: data.text.clone(),
            holdout: holdout.map(|t| t.text.clone()),
            names: [shown(&hexapod.name), shown(&data.name), shown(held)],
            changes: Vec::new(),
        }
    }

    /// Reads and checks all three.
    pub(super) fn read(&self, limits: &ServerLimits) -> Result<Contents, Refusal> {
        let [machine, data, holdout] = &self.names;
        let mut warnings = Vec::new();
        let hexapod = parse_hexapod(&self.hexapod, machine)?;
        let mut measurements = |text: &str, name: &str| {
            let reading = read_campaign_from(&hexapod, text.as_bytes(), name)?;
            let rows = reading.dataset.observations.len();
            if rows > limits.rows {
                let rule = format!("{name} has {rows} readings; at most {} are accepted", limits.rows);
                return Err(Refusal::new(
                    RefusalKind::TooLarge,
                    rule,
                    "Use the command line, which accepts files of any length.",
                ));
            }
            warnings.extend(reading.warnings.iter().map(|w| format!("{name}: {w} {}", w.next_step())));
            Ok(reading.dataset)
        };
        let data = measurements(&self.data, data)?;
        let holdout = self.holdout.as_deref().map(|text| measurements(text, holdout)).transpose()?;
        Ok(Contents { hexapod, data, holdout, warnings })
    }
}

impl Contents {
    /// The same, read with changes; none where there are none.
    pub(super) fn as_meant(&self, changes: &[Change]) -> Option<Self> {
        if changes.is_empty() {
            return None;
        }
        let meant = AsMeant::of(&self.hexapod, &self.data, self.holdout.as_ref(), changes).into_owned();
        Some(Self {
            hexapod: meant.hexapod.into_owned(),
            data: meant.data.into_owned(),
            holdout: meant.holdout.map(Cow::into_owned),
            warnings: self.warnings.clone(),
        })
    }
}

/// A name that came from elsewhere: its last part, of printable characters.
pub(super) fn shown(name: &str) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let printable: String = last.chars().filter(|c| !c.is_control()).take(LONGEST_NAME).collect();
    if printable.is_empty() { "file".to_owned() } else { printable }
}

/// Bytes of terms of one's own that are kept of all requests together: the model keeps every distinct one until the program ends.
const MOST_KEPT_BYTES: usize = 64 << 20;

/// Refuses more terms when what is kept of earlier ones takes too much memory.
fn refuse_beyond(kept_bytes: usize) -> Result<(), Refusal> {
    if kept_bytes <= MOST_KEPT_BYTES {
        return Ok(());
    }
    let rule = format!("your own terms have taken more than {MOST_KEPT_BYTES} bytes since the start");
    Err(Refusal::new(RefusalKind::TooLarge, rule, "Restart `hexbench workbench`."))
}

/// The catalogue, with terms of one's own behind it.
pub(super) fn terms_with(own: &[String], limits: &ServerLimits) -> Result<Vec<Arc<dyn Term>>, Refusal> {
    if own.len() > limits.own_terms {
        let rule = format!("{} of your own terms; at most {} are accepted", own.len(), limits.own_terms);
        return Err(Refusal::new(RefusalKind::TooLarge, rule, "Remove some."));
    }
    if !own.is_empty() {
        refuse_beyond(user_term::kept_bytes())?;
    }
    let mut terms = catalogue();
    for (number, text) in own.iter().enumerate() {
        if text.len() > limits.term_bytes {
            let rule = format!("term file {} is longer than {} bytes", number + 1, limits.term_bytes);
            return Err(Refusal::new(
                RefusalKind::TooLarge,
                rule,
                "Shorten it: a term file needs only a few lines.",
            ));
        }
        let term = user_term::parse(text).map_err(|cause| Refusal::own_term(number, &cause))?;
        let id = term.info().id;
        if terms.iter().any(|t| t.info().id == id) {
            return Err(Refusal::bad_input(
                format!("the term `{id}` is given twice"),
                "Give one of them a different id.",
            ));
        }
        terms.push(term);
    }
    Ok(terms)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terms_are_taken_until_those_before_fill_what_is_kept() {
        assert!(refuse_beyond(MOST_KEPT_BYTES).is_ok());
        let refusal = refuse_beyond(MOST_KEPT_BYTES + 1).unwrap_err();
        assert_eq!(refusal.kind, RefusalKind::TooLarge);
        assert!(refusal.message.contains("67108864 bytes"), "{}", refusal.message);
    }

    #[test]
    fn names_are_only_ever_shown() {
        assert_eq!(shown("../../etc/passwd"), "passwd");
        assert_eq!(shown("C:\\data\\x.csv"), "x.csv");
        assert_eq!(shown("a\u{1b}[31m\n.csv"), "a[31m.csv");
        assert_eq!(shown("/"), "file");
        assert_eq!(shown(&"x".repeat(500)).len(), LONGEST_NAME);
    }
}
