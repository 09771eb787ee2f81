//! Progress on a terminal; silence elsewhere, but for notes.

use std::sync::atomic::{AtomicU64, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

use crate::run::Watch;

/// Most notes shown; the rest are counted.
const MOST_NOTES: u64 = 10;

/// A bar on standard error with rate and time left; hidden where standard error is no terminal.
pub(super) struct Progress {
    bar: ProgressBar,
    notes: AtomicU64,
}

impl Progress {
    pub(super) fn new() -> Self {
        let bar = ProgressBar::new(0);
        let style = "{bar:40} {pos}/{len} frames  {per_sec}  {eta} left";
        bar.set_style(ProgressStyle::with_template(style).unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { bar, notes: AtomicU64::new(0) }
    }

    pub(super) fn end(&self) {
        self.bar.finish_and_clear();
        let more = self.notes.load(Ordering::Relaxed).saturating_sub(MOST_NOTES);
        if more > 0 {
            eprintln!("… and {more} more notes");
        }
    }
}

impl Watch for Progress {
    fn begin(&self, total: u64, there: u64, now: u64) {
        if there > 0 {
            eprintln!("going on: {there} of {total} frames are there");
        }
        self.bar.set_length(now);
        self.bar.reset_eta();
    }

    fn frame_done(&self) {
        self.bar.inc(1);
    }

    fn note(&self, message: &str) {
        if self.notes.fetch_add(1, Ordering::Relaxed) < MOST_NOTES {
            self.bar.suspend(|| eprintln!("note: {message}"));
        }
    }
}
