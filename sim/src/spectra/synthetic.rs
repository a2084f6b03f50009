//! Seeded signals for tests: white Gaussian noise, and noise through a filter of the first order.

use std::f64::consts::TAU;

/// `SplitMix64` (Steele, Lea, Flood, 2014).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// From 0 up to 1.
    pub(crate) fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        #[expect(clippy::cast_precision_loss, reason = "53 bits")]
        let bits = (z >> 11) as f64;
        bits / 9_007_199_254_740_992.0
    }

    /// Of zero mean and unit variance (Box and Muller).
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        radius * (TAU * self.uniform()).cos()
    }

    pub(crate) fn white(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.normal()).collect()
    }

    /// A stationary process of unit variance with the autocorrelation `exp(-|t| / tau)`, samples `step` apart: exact
    /// at the samples. Its one-sided density is `4 tau / (1 + (2 pi f tau)^2)`.
    pub(crate) fn first_order(&mut self, count: usize, step: f64, tau: f64) -> Vec<f64> {
        let decay = (-step / tau).exp();
        let drive = (1.0 - decay * decay).sqrt();
        let mut value = self.normal();
        let mut out = Vec::with_capacity(count);
        for _ in 0..count {
            out.push(value);
            value = decay * value + drive * self.normal();
        }
        out
    }
}

/// `amplitude cos(2 pi frequency t + phase)` at a rate.
pub(crate) fn tone(count: usize, rate: f64, [frequency, amplitude, phase]: [f64; 3]) -> Vec<f64> {
    let time = |i: usize| super::float(i) / rate;
    (0..count).map(|i| amplitude * (TAU * frequency * time(i) + phase).cos()).collect()
}
