//! Fits of readings without noise.

use super::slug;
use crate::recovery::noiseless::{Bounded, Noiseless};
use crate::recovery::scene::HiddenSubject;
use crate::regress::limit::{LimitGroup, LimitTest, RegressLimit};
use crate::regress::trials::{OfSubject, SuiteTrials};

fn machines(t: &SuiteTrials, subject: HiddenSubject) -> impl Iterator<Item = Option<&Noiseless>> {
    t.machines.iter().filter(move |m| m.subject == subject).map(|m: &OfSubject<Noiseless>| m.found.as_ref())
}

/// What is found without noise, against the baseline; poses closed exactly by both worlds have rounding only, and its bound.
pub(super) fn of_subject(s: HiddenSubject) -> Vec<RegressLimit> {
    let group = LimitGroup::NoiseFree;
    let of = |what: &str, id: &str, pick: fn(&Noiseless) -> Option<Bounded>| {
        let why = if s.absolute {
            "World and model close a pose alike: only rounding may remain, and its bound is derived."
        } else {
            "What remains is the linearization of the model on this machine: it has no reason to change."
        };
        let value = move |b: Bounded| if s.absolute { b.error / b.bound } else { b.error };
        let values = move |t: &SuiteTrials| {
            machines(t, s).map(|m| m.and_then(pick).map_or(f64::INFINITY, value)).collect::<Vec<_>>()
        };
        let title = if s.absolute {
            format!("{}: {what} without noise, error over bound", s.name)
        } else {
            format!("{}: {what} without noise, relative error", s.name)
        };
        let test = if s.absolute { LimitTest::Bound } else { LimitTest::Exact };
        RegressLimit::new((format!("{id}:{}", slug(s.name)), group), title, why, test, values)
    };
    let mut both = vec![of("leg stiffness", "exact-stiffness", |m| m.stiffness)];
    if !s.effects.is_empty() {
        both.push(of("its numbers", "exact-effect", |m| m.effect));
    }
    both
}

/// The derived bounds of all deflections.
pub(super) fn bounds() -> RegressLimit {
    RegressLimit::new(
        ("exact-bounds", LimitGroup::NoiseFree),
        "errors without noise over the bounds derived from the linearization",
        "An error beyond what the model leaves out by construction has another cause, whatever the baseline says.",
        LimitTest::Bound,
        |t| {
            let found = t.machines.iter().filter(|m| !m.subject.absolute).filter_map(|m| m.found);
            found.flat_map(|m| [m.stiffness, m.effect]).flatten().map(|b| b.error / b.bound).collect()
        },
    )
}
