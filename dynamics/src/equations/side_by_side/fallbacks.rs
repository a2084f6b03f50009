//! How often lanes fall back to the scalar path, counted for the checks of what does.

#[cfg(test)]
std::thread_local! {
    /// How often on this thread.
    pub(crate) static FALLBACKS: core::cell::Cell<usize> = const { core::cell::Cell::new(0) };
}

/// Counts one.
pub(crate) fn count() {
    #[cfg(test)]
    FALLBACKS.with(|count| count.set(count.get() + 1));
}
