//! A progress bar on standard error, for what takes longer than two seconds.

use std::sync::Once;
use std::time::{Duration, Instant};

use hexbench_experiments::harness;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::quiet::is_quiet;
use super::report;

/// Work shorter than this needs no bar.
const PATIENCE: Duration = Duration::from_secs(2);

/// A bar that appears after a while, on a terminal only.
#[derive(Debug)]
pub(crate) struct Progress {
    bar: ProgressBar,
    begun: Instant,
    shown: Once,
}

impl Progress {
    /// For so many steps of a kind, such as rows.
    pub(crate) fn of(steps: u64, kind: &str) -> Self {
        let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::hidden());
        let style = ProgressStyle::with_template(&format!(
            "{{bar:30}} {{percent:>3}} %  {{human_pos}} of {{human_len}} {kind}, {{eta}} left"
        ));
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { bar, begun: Instant::now(), shown: Once::new() }
    }

    /// Some steps more are done.
    pub(crate) fn advance(&self, steps: u64) {
        self.bar.inc(steps);
        if self.begun.elapsed() > PATIENCE && !is_quiet() {
            self.shown.call_once(|| self.bar.set_draw_target(ProgressDrawTarget::stderr()));
        }
    }

    /// The bar goes away.
    pub(crate) fn done(self) {
        drop(self);
    }
}

impl harness::Progress for Progress {
    /// What was done before says nothing about the time the others will take.
    fn begin(&self, trials: u64, known: u64) {
        self.bar.set_length(trials);
        self.bar.set_position(known);
        self.bar.reset_eta();
    }

    fn damaged(&self, records: u64) {
        if records > 0 {
            let what = format!("{records} damaged records of the journal will be computed again");
            report::warn(&what, "Nothing if the files were copied or the disk was full.");
        }
    }

    fn advance(&self, trials: u64) {
        self.advance(trials);
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
