//! Formulas and terms of the user, sessions of the workbench.

use hexbench_model::application::session::Session;
use hexbench_model::effects::formula::Formula;
use hexbench_model::effects::user_term::{self, variables};

/// A formula is a number or none at all, and is written as it was.
pub(super) fn formula(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let known: Vec<String> = variables().into_iter().map(|v| v.name.to_owned()).collect();
    let names: Vec<&str> = known.iter().map(String::as_str).collect();
    let Ok(formula) = Formula::parse(text, &names) else { return false };
    assert_eq!(formula.text(), text.trim());
    for value in [0.0, 1.0, -2.5, 1e30] {
        let values = vec![value; names.len()];
        assert_eq!(formula.value(&values).to_bits(), formula.value(&values).to_bits());
    }
    let _ = formula.check_units(&vec![None; names.len()]);
    true
}

/// A term that is accepted has parameters with names and sensible sizes.
pub(super) fn term(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let Ok(term) = user_term::parse(text) else { return false };
    let info = term.info();
    assert!(!info.parameters.is_empty() && !info.id.is_empty());
    true
}

/// A session that is accepted shows one of its steps, is written as it was read, and its terms are terms or refused.
pub(super) fn session(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let Ok(session) = Session::parse(text) else { return false };
    assert!(session.at < session.steps.len());
    let written = serde_json::to_string(&session).unwrap_or_default();
    let again = Session::parse(&written).map(|again| serde_json::to_string(&again).unwrap_or_default());
    assert_eq!(again.ok().as_ref(), Some(&written), "a session is read as it was written");
    let digests: Vec<String> = session.inputs.iter().map(|input| input.sha256.clone()).collect();
    assert!(session.made_with(&digests).is_ok(), "a session opens beside the files it names");
    let _ = session.options();
    if let Ok(terms) = session.terms() {
        assert!(terms.len() >= session.shown().own.len());
    }
    true
}
