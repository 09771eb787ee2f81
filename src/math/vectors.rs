//! The same code for wider vectors: loops compiled a second time for AVX2, chosen when the program runs.
//!
//! Never FMA: fused sums round once where `·` and `+` round twice. Without it, the width of vectors changes no bit.

/// Work over long rows of numbers. `run` and all that it calls must be `#[inline(always)]`, or vectors stay narrow.
pub(crate) trait Work {
    /// Does it.
    fn run(self);
}

/// Does `work` with the widest vectors that this CPU has.
pub(crate) fn widest(work: impl Work) {
    #[cfg(test)]
    if tests::are_vectors_narrow() {
        return work.run();
    }
    #[cfg(target_arch = "x86_64")]
    if std::is_x86_feature_detected!("avx2") {
        // SAFETY: the CPU has AVX2.
        return unsafe { with_avx2(work) };
    }
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_avx2(work: impl Work) {
    work.run();
}

#[cfg(test)]
pub(crate) mod tests {
    use std::cell::Cell;

    thread_local! {
        static NARROW: Cell<bool> = const { Cell::new(false) };
    }

    pub(crate) fn are_vectors_narrow() -> bool {
        NARROW.get()
    }

    /// What `make` makes with the vectors that every CPU has.
    pub fn narrow<T>(make: impl FnOnce() -> T) -> T {
        NARROW.set(true);
        let made = make();
        NARROW.set(false);
        made
    }
}
