//! How a run is asked to stop: Ctrl-C, and the signals by which batch systems warn before they kill.

use std::sync::atomic::AtomicBool;

/// Set when the run is to stop: frames in work are finished, then it ends.
pub(super) static STOP: AtomicBool = AtomicBool::new(false);

#[cfg(unix)]
mod unix {
    use std::sync::atomic::Ordering;
    use std::time::Duration;

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1, SIGUSR2};
    use signal_hook::iterator::Signals;

    use super::STOP;
    use crate::cli::Code;

    /// After so long the frames in work are dropped: batch systems kill what does not end. They are rendered again later.
    const PATIENCE: Duration = Duration::from_millis(4500);

    pub(in crate::cli) fn listen() -> std::io::Result<()> {
        let mut signals = Signals::new([SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2])?;
        std::thread::spawn(move || {
            for signal in signals.forever() {
                if STOP.swap(true, Ordering::Relaxed) {
                    std::process::exit(Code::Interrupted as i32);
                }
                let name = signal_hook::low_level::signal_name(signal).unwrap_or("a signal");
                eprintln!("{name}: stopping after the frames in work; once more to stop at once");
                std::thread::spawn(|| {
                    std::thread::sleep(PATIENCE);
                    eprintln!("the frames in work take long; they are dropped, and rendered when the run goes on");
                    std::process::exit(Code::Interrupted as i32);
                });
            }
        });
        Ok(())
    }
}

#[cfg(unix)]
pub(super) use unix::listen;

#[cfg(not(unix))]
pub(super) fn listen() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| {
        if STOP.swap(true, std::sync::atomic::Ordering::Relaxed) {
            std::process::exit(super::Code::Interrupted as i32);
        }
        eprintln!("stopping after the frames in work; Ctrl-C again to stop at once");
    })
}
