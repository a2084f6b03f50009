//! Work side by side: a graph belongs to one thread, but no derivation needs another's graph.

use std::panic::resume_unwind;
use std::thread::{ScopedJoinHandle, scope};

/// Does the same with each item, each on a thread of its own; the results are in the order of the
/// items, so that nothing depends on which thread was faster.
pub fn side_by_side<T, R>(
    items: impl IntoIterator<Item = T>,
    work: impl Fn(T) -> R + Sync,
) -> Vec<R>
where
    T: Send,
    R: Send,
{
    let work = &work;
    scope(|threads| {
        let started = items.into_iter().map(|item| threads.spawn(move || work(item)));
        let started: Vec<_> = started.collect();
        started.into_iter().map(joined).collect()
    })
}

/// Result of a thread; a panic in it is raised again.
#[must_use]
pub fn joined<R>(thread: ScopedJoinHandle<'_, R>) -> R {
    thread.join().unwrap_or_else(|panic| resume_unwind(panic))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Barrier;

    #[test]
    fn results_stand_in_the_order_of_the_items_whoever_is_first() {
        // The first item waits for the last.
        let last = Barrier::new(2);
        let work = |item: usize| {
            if item != 1 {
                last.wait();
            }
            item * item
        };
        assert_eq!(side_by_side([0, 1, 2], work), [0, 1, 4]);
    }
}
