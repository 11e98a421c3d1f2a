//! How an experiment is watched and stopped.

/// Hears how far an experiment is, from any thread; may ask it to stop.
pub trait Progress: Sync {
    /// So many trials are to be done, of which some were done before.
    fn begin(&self, _trials: u64, _known: u64) {}

    /// So many records of the journal are damaged and computed again.
    fn damaged(&self, _records: u64) {}

    /// Some trials more are done.
    fn advance(&self, trials: u64);

    /// True when no further trial shall begin.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// Nobody watches.
#[derive(Debug, Clone, Copy)]
pub struct Silent;

impl Progress for Silent {
    fn advance(&self, _: u64) {}
}
