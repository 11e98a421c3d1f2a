//! Texts that live as long as the program: ids and names read from files, beside those of the catalogue.
//!
//! Every distinct text is kept once, so loading the same file again costs no memory.

use std::collections::HashSet;
use std::hash::Hash;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use crate::effects::term::{Need, ParameterInfo};

/// Bytes of all that is kept here.
static KEPT: AtomicUsize = AtomicUsize::new(0);
static TEXTS: Mutex<Option<HashSet<&'static str>>> = Mutex::new(None);
static PARAMETERS: Mutex<Vec<&'static [ParameterInfo]>> = Mutex::new(Vec::new());
static NEEDS: Mutex<Option<HashSet<&'static [Need]>>> = Mutex::new(None);

/// Bytes of texts and lists that are kept until the program ends: what every distinct term file has left.
pub(crate) fn kept_bytes() -> usize {
    KEPT.load(Ordering::Relaxed)
}

/// The one copy of a text.
pub(crate) fn text(text: &str) -> &'static str {
    kept(&TEXTS, text, || Box::leak(text.to_owned().into_boxed_str()))
}

/// The one copy of a list of needs.
pub(crate) fn needs(needs: &[Need]) -> &'static [Need] {
    kept(&NEEDS, needs, || Box::leak(needs.to_vec().into_boxed_slice()))
}

/// The one copy of a list of parameters.
pub(crate) fn parameters(parameters: &[ParameterInfo]) -> &'static [ParameterInfo] {
    // Parameters hold floats and cannot be hashed; lists are few.
    let mut known = PARAMETERS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(same) = known.iter().find(|p| **p == parameters) {
        return same;
    }
    let leaked: &'static [ParameterInfo] = Box::leak(parameters.to_vec().into_boxed_slice());
    known.push(leaked);
    KEPT.fetch_add(size_of_val(leaked), Ordering::Relaxed);
    leaked
}

fn kept<T: ?Sized + Hash + Eq>(
    set: &Mutex<Option<HashSet<&'static T>>>,
    value: &T,
    leak: impl FnOnce() -> &'static T,
) -> &'static T {
    let mut guard = set.lock().unwrap_or_else(PoisonError::into_inner);
    let set = guard.get_or_insert_with(HashSet::new);
    if let Some(same) = set.get(value) {
        return same;
    }
    let leaked = leak();
    KEPT.fetch_add(size_of_val(leaked), Ordering::Relaxed);
    set.insert(leaked);
    leaked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_text_is_kept_once() {
        let a = text(&String::from("kept-once"));
        let b = text(&["kept", "once"].join("-"));
        assert!(std::ptr::eq(a, b));
    }

    #[test]
    fn what_is_kept_is_counted() {
        let long = "counted".repeat(1000);
        let before = kept_bytes();
        text(&long);
        assert!(kept_bytes() >= before + long.len());
    }
}
