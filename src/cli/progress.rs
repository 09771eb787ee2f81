//! Progress: a bar on a terminal, a line a minute in a batch job.

use std::io::IsTerminal as _;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use indicatif::{HumanDuration, ProgressBar, ProgressStyle};

use crate::run::Watch;

/// Most notes shown; the rest are counted.
const MOST_NOTES: u64 = 10;
/// Between two lines where there is no terminal.
const EACH: Duration = Duration::from_secs(60);

/// A bar on standard error with rate, time left and failures; lines where standard error is no terminal.
pub(super) struct Progress {
    bar: ProgressBar,
    notes: AtomicU64,
    failed: AtomicU64,
    /// When the last line was written; none on a terminal.
    last_line: Option<Mutex<Instant>>,
    began: Instant,
}

impl Progress {
    pub(super) fn new() -> Self {
        let bar = ProgressBar::new(0);
        let style = "{bar:40} {pos}/{len} frames  {per_sec}  {eta} left{msg}";
        bar.set_style(ProgressStyle::with_template(style).unwrap_or_else(|_| ProgressStyle::default_bar()));
        let began = Instant::now();
        let last_line = (!std::io::stderr().is_terminal()).then(|| Mutex::new(began));
        Self { bar, notes: AtomicU64::new(0), failed: AtomicU64::new(0), last_line, began }
    }

    pub(super) fn end(&self) {
        self.bar.finish_and_clear();
        let more = self.notes.load(Ordering::Relaxed).saturating_sub(MOST_NOTES);
        if more > 0 {
            eprintln!("… and {more} more notes");
        }
    }

    /// Writes a line if the last is a minute old.
    fn line(&self) {
        let Some(mut last) = self.last_line.as_ref().and_then(|last| last.try_lock().ok()) else { return };
        if last.elapsed() < EACH {
            return;
        }
        *last = Instant::now();
        let (done, all) = (self.bar.position(), self.bar.length().unwrap_or_default());
        let rate = done as f64 / self.began.elapsed().as_secs_f64();
        let left = Duration::from_secs_f64((all.saturating_sub(done)) as f64 / rate.max(1e-9));
        let failed = self.failed.load(Ordering::Relaxed);
        eprintln!("{done} of {all} frames, {rate:.1}/s, {} left, {failed} failed", HumanDuration(left));
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
        self.line();
    }

    fn frame_failed(&self, id: u64, reason: &str) {
        let failed = self.failed.fetch_add(1, Ordering::Relaxed) + 1;
        self.bar.set_message(format!("  {failed} failed"));
        self.note(&format!("frame {id} failed: {reason}"));
    }

    fn note(&self, message: &str) {
        if self.notes.fetch_add(1, Ordering::Relaxed) < MOST_NOTES {
            self.bar.suspend(|| eprintln!("note: {message}"));
        }
    }
}
