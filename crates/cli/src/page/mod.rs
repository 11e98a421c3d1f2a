//! Pages of text for people: the diagnosis, the demo, the catalogue.

pub(crate) mod comparison;
pub(crate) mod effect;
pub(crate) mod effects;
pub(crate) mod fitted;
use crate::output::Ink;
use hexbench_core::{Dataset, Hexapod};
use hexbench_model::diagnose::Study;
use hexbench_model::verdict::Verdict;
pub(crate) struct Subject<'a> {
    pub(crate) hexapod: &'a Hexapod,
    pub(crate) data: &'a Dataset,
    pub(crate) holdout: Option<&'a Dataset>,
    pub(crate) study: &'a Study,
}
pub(crate) fn word(v: Verdict) -> &'static str {
    match v {
        Verdict::Adequate => "adequate",
        Verdict::Named => "named",
        Verdict::Ambiguous => "ambiguous",
        Verdict::Outside => "outside",
    }
}
pub(crate) fn diagnosis(_: &Subject, _: bool, _: Ink) -> String {
    String::new()
}
pub(crate) fn demo(_: &Subject, _: Ink) -> String {
    String::new()
}
