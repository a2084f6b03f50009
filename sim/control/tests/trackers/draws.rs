//! Normally distributed noise by a seed, and statistics of what is estimated from it.

use precess_control::Noise;

/// Draws of unit variance.
pub(crate) struct Draws {
    noise: Noise,
    next: u64,
}

impl Draws {
    pub(crate) fn new(seed: u64) -> Self {
        Self { noise: Noise::new(seed, "tracker"), next: 0 }
    }

    pub(crate) fn draw(&mut self) -> f64 {
        let [value, ..] = self.noise.at(self.next);
        self.next += 1;
        value
    }
}

/// Variance of values about their known mean.
pub(crate) fn variance(values: &[f64], mean: f64) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
    let count = values.len() as f64;
    values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count
}

/// Whether a variance found from so many independent draws is the expected one within four standard deviations.
pub(crate) fn agrees(found: f64, expected: f64, count: usize) -> bool {
    #[expect(clippy::cast_precision_loss, reason = "a few thousand")]
    let deviation = (2.0 / count as f64).sqrt();
    (found / expected - 1.0).abs() < 4.0 * deviation
}
