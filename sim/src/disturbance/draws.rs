//! Phases drawn from a seed: uniform from 0 to 2 pi, the same on every host and for any number of threads.
//!
//! The generator is `ChaCha` with eight rounds. Its key is the SHA-256 of the seed, the name of the source
//! and what is drawn, so what one component draws depends on no other source or component.

use std::f64::consts::TAU;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng as _, SeedableRng as _};
use sha2::{Digest as _, Sha256};

/// Phases, rad, without end: those of what `what` names, of the source `source`.
///
/// A phase has 32 bits, steps of 1.5e-9 rad.
pub fn phases(seed: u32, source: &str, what: &str) -> impl Iterator<Item = f64> + use<> {
    let key = Sha256::digest(format!("precess source phases 1\n{seed}\n{source}\n{what}"));
    let mut generator = ChaCha8Rng::from_seed(key.into());
    std::iter::repeat_with(move || f64::from(generator.next_u32()) / 4_294_967_296.0 * TAU)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of `N` phases the mean of cosines has a standard deviation of sqrt(1 / 2N); five of them are
    /// exceeded once in two million seeds, and this seed is fixed.
    const DEVIATIONS: f64 = 5.0;

    fn first(seed: u32, source: &str, what: &str) -> Vec<u64> {
        phases(seed, source, what).take(4).map(f64::to_bits).collect()
    }

    #[test]
    fn phases_are_those_of_seed_source_and_component() {
        let one = first(1, "rw", "force_x");
        assert_eq!(one, first(1, "rw", "force_x"));
        for other in [first(2, "rw", "force_x"), first(1, "rw2", "force_x"), first(1, "rw", "x")] {
            assert!(one.iter().zip(&other).all(|(a, b)| a != b));
        }
    }

    #[test]
    fn phases_are_uniform() {
        const COUNT: u32 = 10_000;
        let drawn: Vec<f64> = phases(7, "rw", "force_x").take(COUNT as usize).collect();
        let bound = DEVIATIONS / (2.0 * f64::from(COUNT)).sqrt();
        for multiple in [1.0, 2.0, 3.0] {
            let mean = |of: fn(f64) -> f64| {
                drawn.iter().map(|phase| of(multiple * phase)).sum::<f64>() / f64::from(COUNT)
            };
            assert!(mean(f64::cos).abs() < bound && mean(f64::sin).abs() < bound);
        }
        assert!(drawn.iter().all(|phase| (0.0..TAU).contains(phase)));
    }

    /// The first words of the generator, by SHA-256 of Python's `hashlib` and twenty lines of `ChaCha8`
    /// in Python: a seed means the same with any version of the crates.
    #[test]
    fn the_first_words_are_those_of_another_program() {
        const WORDS: [f64; 4] =
            [1_125_962_012.0, 3_186_247_124.0, 2_611_701_284.0, 1_649_214_651.0];
        let drawn = phases(1, "rw", "force_x").map(|phase| (phase / TAU * 4_294_967_296.0).round());
        assert!(drawn.zip(WORDS).all(|(drawn, stored)| drawn == stored));
    }
}
