//! A panic in the code that reads one file, or in a library that it uses, as an error of that file.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether panics of this thread are caught and say nothing.
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

/// What `read` gives, or `None` if it panics: without a message, as the caller reports the file.
pub(super) fn isolated<T>(read: impl FnOnce() -> T) -> Option<T> {
    static HOOK: Once = Once::new();
    // Added once in front of what is there: to swap it for each file would race with other threads.
    HOOK.call_once(|| {
        let others = panic::take_hook();
        panic::set_hook(Box::new(move |about| {
            if !QUIET.get() {
                others(about);
            }
        }));
    });
    let before = QUIET.replace(true);
    // Nothing that `read` may have left half done is used after a panic.
    let result = panic::catch_unwind(AssertUnwindSafe(read));
    QUIET.set(before);
    result.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_nothing_and_a_result_is_passed_on() {
        assert_eq!(isolated(|| 7), Some(7));
        let empty: Vec<u8> = Vec::new();
        assert_eq!(isolated(|| empty[std::hint::black_box(3)]), None);
        assert!(!QUIET.get(), "later panics are reported again");
        assert_eq!(isolated(|| (isolated(|| panic!("inner")), QUIET.get())), Some((None::<()>, true)));
    }
}
