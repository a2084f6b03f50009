//! [`Noise`]: normal numbers drawn from a seed, the same on every host, in any order and on any thread.
//!
//! The generator is `ChaCha` with eight rounds, as of the phases of sources. Its key is the SHA-256 of the seed and the
//! sensor's name, and each sample has a block of it: what a sensor draws at a sample depends on nothing else. Normal
//! numbers are by Box and Muller (1958), of uniform ones of 52 bits.

use core::f64::consts::TAU;

use alloc::format;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng as _, SeedableRng as _};
use sha2::{Digest as _, Sha256};

/// Numbers of one sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    key: [u8; 32],
}

/// A number between zero and one, both left out.
fn uniform(generator: &mut ChaCha8Rng) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "52 bits")]
    let bits = (generator.next_u64() >> 12) as f64;
    (bits + 0.5) / 4_503_599_627_370_496.0
}

impl Noise {
    /// Of the sensor of a name.
    #[must_use]
    pub fn new(seed: u64, sensor: &str) -> Self {
        Self { key: Sha256::digest(format!("precess sensor noise 1\n{seed}\n{sensor}")).into() }
    }

    /// The eight independent numbers of a sample: mean zero, variance one. None is beyond 8.6.
    #[must_use]
    pub fn at(&self, sample: u64) -> [f64; 8] {
        let mut generator = ChaCha8Rng::from_seed(self.key);
        // A block is 512 bits, eight uniform numbers.
        generator.set_block_pos(sample);
        let mut numbers = [0.0; 8];
        for pair in numbers.chunks_exact_mut(2) {
            let radius = libm::sqrt(-2.0 * libm::log(uniform(&mut generator)));
            let (sin, cos) = libm::sincos(TAU * uniform(&mut generator));
            pair.copy_from_slice(&[radius * cos, radius * sin]);
        }
        numbers
    }
}
