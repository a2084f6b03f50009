//! The issue floor: how many products and sums this CPU issues per nanosecond when none waits for
//! another, with one number in a register and with several.
//!
//! Twelve independent chains of products and sums, more than latency times width of any core known
//! to us, few enough for sixteen registers. The ratio of products to sums is that of the
//! emitted kernels, 11 to 10.

use std::hint::black_box;
use std::time::{Duration, Instant};

use pulp::{Simd, WithSimd};
use serde_json::{Value, json};

use crate::timing::median;

/// Number of independent chains.
const CHAINS: u32 = 12;
/// Products each followed by a sum; one more product follows them.
const PAIRS: u32 = 10;
/// Operations of a round: in each chain, of each lane.
const OPERATIONS: u32 = CHAINS * (2 * PAIRS + 1);
/// Rounds in a measurement.
const ROUNDS: u32 = 20_000;
/// Measurements, of which the median counts.
const REPEATS: usize = 101;

/// Everything that this CPU has, in operations per nanosecond, and its frequency.
pub(crate) fn floor() -> Value {
    let mut rows = vec![row("f64", || Rounds::<false>.with_simd(pulp::Scalar))];
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(v3) = pulp::x86::V3::try_new() {
            rows.push(row("fused f64", || Simd::vectorize(v3, OneLane(Rounds::<true>))));
            rows.push(row("4 lanes", || Simd::vectorize(v3, Rounds::<false>)));
            rows.push(row("4 lanes, fused", || Simd::vectorize(v3, Rounds::<true>)));
        }
        if let Some(v4) = pulp::x86::V4::try_new() {
            rows.push(row("8 lanes", || Simd::vectorize(v4, Rounds::<false>)));
            rows.push(row("8 lanes, fused", || Simd::vectorize(v4, Rounds::<true>)));
        }
    }
    json!({ "floor": rows, "ghz": frequency() })
}

/// Operations per nanosecond of some rounds, each lane's counted.
fn row(name: &str, rounds: impl Fn() -> usize) -> Value {
    let mut per_ns: Vec<_> = (0..REPEATS)
        .map(|_| {
            let start = Instant::now();
            per_nanosecond(rounds(), start.elapsed())
        })
        .collect();
    json!({ "name": name, "per_ns": median(&mut per_ns) })
}

#[expect(clippy::cast_precision_loss, reason = "lanes are few")]
fn per_nanosecond(lanes: usize, time: Duration) -> f64 {
    f64::from(OPERATIONS) * f64::from(ROUNDS) * lanes as f64 / (1e9 * time.as_secs_f64())
}

/// The chains, products and sums fused or not; returns the number of lanes.
#[derive(Clone, Copy)]
struct Rounds<const FUSED: bool>;

impl<const FUSED: bool> WithSimd for Rounds<FUSED> {
    type Output = usize;

    #[expect(
        clippy::inline_always,
        reason = "the caller is compiled for the unit, and this with it"
    )]
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> usize {
        // Towards 1/3 from above: neither overflow nor underflow.
        let (factor, term) = (simd.splat_f64s(black_box(0.7)), simd.splat_f64s(black_box(0.1)));
        let mut start = 1.0;
        let mut chains: [S::f64s; CHAINS as usize] = core::array::from_fn(|_| {
            start += 1.0;
            simd.splat_f64s(black_box(start))
        });
        for _ in 0..ROUNDS {
            for _ in 0..PAIRS {
                for x in &mut chains {
                    *x = if FUSED {
                        simd.mul_add_f64s(*x, factor, term)
                    } else {
                        simd.add_f64s(simd.mul_f64s(*x, factor), term)
                    };
                }
            }
            for x in &mut chains {
                *x = simd.mul_f64s(*x, factor);
            }
        }
        black_box(chains.map(|x| simd.reduce_sum_f64s(x)));
        S::F64_LANES
    }
}

/// The same with one number in a register, compiled for a wider unit: that is where fused
/// instructions are.
#[derive(Clone, Copy)]
struct OneLane<R>(R);

impl<R: WithSimd> WithSimd for OneLane<R> {
    type Output = R::Output;

    #[expect(
        clippy::inline_always,
        reason = "the caller is compiled for the unit, and this with it"
    )]
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> R::Output {
        self.0.with_simd(pulp::Scalar)
    }
}

/// GHz, if a product of two 64-bit integers takes three cycles, as it does on x86-64 cores since
/// 2008; none elsewhere.
fn frequency() -> Option<f64> {
    const PRODUCTS: u32 = 1_000_000;
    const CYCLES: f64 = 3.0;
    if !cfg!(target_arch = "x86_64") {
        return None;
    }
    let mut ghz: Vec<_> = (0..REPEATS)
        .map(|_| {
            let start = Instant::now();
            let power = (0..PRODUCTS).fold(black_box(3_u64), |x, _| x.wrapping_mul(x));
            black_box(power);
            CYCLES * f64::from(PRODUCTS) / (1e9 * start.elapsed().as_secs_f64())
        })
        .collect();
    Some(median(&mut ghz))
}
