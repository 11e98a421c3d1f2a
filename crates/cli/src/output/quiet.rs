//! `--quiet`: nothing is said that nobody asked for.

use std::sync::atomic::{AtomicBool, Ordering};

static QUIET: AtomicBool = AtomicBool::new(false);

/// From now on pages, notes and progress stay away, or are there again.
pub(crate) fn set_quiet(quiet: bool) {
    QUIET.store(quiet, Ordering::Relaxed);
}

/// True when they stay away.
pub(super) fn is_quiet() -> bool {
    QUIET.load(Ordering::Relaxed)
}
