//! Bodies of the requests to the workbench.

use std::sync::LazyLock;

use hexbench_workbench::bench::LoadedCampaign;
use hexbench_workbench::wire::{Ask, Export, Guess, Open, Selection, ServerLimits, What};
use serde::Serialize;
use serde_json::from_slice;

/// Small ones: an input should take milliseconds.
const LIMITS: ServerLimits =
    ServerLimits { bytes: 1 << 20, rows: 100, own_terms: 2, term_bytes: 1000, benches: 1 };

static BENCH: LazyLock<LoadedCampaign> = LazyLock::new(|| {
    let paper = Open::Case { id: "paper-protocol".into() };
    LoadedCampaign::open(&paper, None, &LIMITS).unwrap_or_else(|_| panic!("a case of this program"))
});

/// The bytes as each body; what is understood is answered or refused, and an answer can be sent.
pub(super) fn requests(bytes: &[u8]) -> bool {
    [opens(bytes), views(bytes), exports(bytes), guesses(bytes), from_slice::<Ask>(bytes).is_ok()]
        .contains(&true)
}

fn opens(bytes: &[u8]) -> bool {
    let Ok(open) = from_slice::<Open>(bytes) else { return false };
    let opened = LoadedCampaign::open(&open, None, &LIMITS).and_then(|bench| bench.opened("1"));
    opened.is_ok_and(|opened| sendable(&opened))
}

fn views(bytes: &[u8]) -> bool {
    let Ok(selection) = from_slice::<Selection>(bytes) else { return false };
    BENCH.view(&selection).is_ok_and(|view| sendable(&view))
}

/// All but what needs a diagnosis.
fn exports(bytes: &[u8]) -> bool {
    let Ok(export) = from_slice::<Export>(bytes) else { return false };
    let is_quick = !matches!(export.what, What::Report | What::Diagnosis);
    is_quick && BENCH.export(&export).is_ok_and(|file| sendable(&file))
}

fn guesses(bytes: &[u8]) -> bool {
    from_slice::<Guess>(bytes).is_ok_and(|guess| BENCH.reveal(&guess).is_ok_and(|told| sendable(&told)))
}

fn sendable(answer: &impl Serialize) -> bool {
    assert!(serde_json::to_string(answer).is_ok(), "an answer that is no JSON");
    true
}
