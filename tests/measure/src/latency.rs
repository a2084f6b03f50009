//! Latency of an operation: chains in which each operation depends on the one before.

use std::hint::black_box;
use std::time::Instant;

use precess_dynamics::Angle;
use precess_tests::counted::Latencies;

use crate::timing::median;

/// Operations in a chain.
const LINKS: u32 = 20_000;
/// Measurements, of which the median counts.
const REPEATS: usize = 101;

/// Of each operation, on this CPU.
pub(crate) fn latencies() -> Latencies {
    // Where the numbers go: to 0.99, to and fro about 1, to where sine and cosine are alike.
    Latencies {
        mul: chain(|x| x * 0.999_999),
        add: chain(|x| x + 1e-6),
        recip: chain(f64::recip),
        sin_cos: chain(|x| Angle::sin_cos(x).1),
    }
}

/// Nanoseconds per link.
fn chain(link: impl Fn(f64) -> f64) -> f64 {
    let mut times: Vec<_> = (0..REPEATS)
        .map(|_| {
            let start = Instant::now();
            black_box((0..LINKS).fold(black_box(1.01), |x, _| link(x)));
            1e9 * start.elapsed().as_secs_f64() / f64::from(LINKS)
        })
        .collect();
    median(&mut times)
}
