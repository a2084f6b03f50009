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

use crate::service::Rejected;
use crate::timing::{each_line, median, median_of_turn};

/// Number of independent chains.
const CHAINS: u32 = 12;
/// Products each followed by a sum; one more product follows them.
const PAIRS: u32 = 10;
/// Operations of a round: in each chain, of each lane.
const OPERATIONS: u32 = CHAINS * (2 * PAIRS + 1);
/// Rounds in a measurement.
const ROUNDS: u32 = 5_000;
/// Measurements, of which the median counts.
const REPEATS: usize = 101;

/// Everything that this CPU has, in operations per nanosecond, and its frequency.
pub(crate) fn floor() -> Value {
    let row = |InstructionSet { name, rounds }: &InstructionSet| {
        let mut per_ns: Vec<_> = (0..REPEATS).map(|_| 1.0 / per_operation(*rounds)).collect();
        json!({ "name": name, "per_ns": median(&mut per_ns) })
    };
    json!({ "floor": rows().iter().map(row).collect::<Vec<_>>(), "ghz": frequency() })
}

/// Nanoseconds per operation of one row, a turn after each line of the input.
pub(crate) fn turns(name: &str) -> Result<(), Rejected> {
    let rows = rows();
    let found = rows.iter().find(|row| row.name == name);
    let InstructionSet { rounds, .. } = found.ok_or_else(|| format!("this CPU has no `{name}`"))?;
    each_line(|| median_of_turn(|| Ok(per_operation(*rounds))))
}

/// The row that bounds lanes: of the widest registers at hand.
#[cfg(feature = "lanes")]
pub(crate) fn widest() -> &'static str {
    rows().last().map_or(ONE, |row| row.name)
}

/// The row of single numbers.
pub(crate) const ONE: &str = "f64";

/// What is timed of one kind of instructions.
struct InstructionSet {
    name: &'static str,
    /// Returns the number of lanes.
    rounds: fn() -> usize,
}

/// What this CPU has, wider registers later.
fn rows() -> Vec<InstructionSet> {
    let mut rows = vec![InstructionSet { name: ONE, rounds: || Rounds.with_simd(pulp::Scalar) }];
    #[cfg(target_arch = "x86_64")]
    {
        use pulp::x86::{V3, V4};
        // Where the instructions are there, so is the token.
        fn v3<W: WithSimd<Output = usize>>(work: W) -> usize {
            V3::try_new().map_or(0, |v3| Simd::vectorize(v3, work))
        }
        fn v4<W: WithSimd<Output = usize>>(work: W) -> usize {
            V4::try_new().map_or(0, |v4| Simd::vectorize(v4, work))
        }
        if V3::try_new().is_some() {
            rows.push(InstructionSet { name: "4 lanes", rounds: || v3(Rounds) });
        }
        if V4::try_new().is_some() {
            rows.push(InstructionSet { name: "8 lanes", rounds: || v4(Rounds) });
        }
    }
    rows
}

/// Nanoseconds per operation of some rounds, each lane's counted.
fn per_operation(rounds: fn() -> usize) -> f64 {
    let start = Instant::now();
    let lanes = rounds();
    per_operation_of(lanes, start.elapsed())
}

#[expect(clippy::cast_precision_loss, reason = "lanes are few")]
fn per_operation_of(lanes: usize, time: Duration) -> f64 {
    1e9 * time.as_secs_f64() / (f64::from(OPERATIONS) * f64::from(ROUNDS) * lanes as f64)
}

/// The chains; returns the number of lanes.
#[derive(Clone, Copy)]
struct Rounds;

impl WithSimd for Rounds {
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
                    *x = simd.add_f64s(simd.mul_f64s(*x, factor), term);
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
