//! [`Broadband`]: noise of a one-sided power spectral density S(f), realised as a function of time; after
//! Shinozuka and Deodatis, "Simulation of stochastic processes by spectral representation", Appl. Mech.
//! Rev. 44(4), 191-204, 1991.
//!
//! ```text
//! F_j(t) = sum_k sqrt(2 S_j(f_k) / T) cos(2 pi f_k t + phi_jk),   f_k = k / T within the band
//! F_j(t) (Omega / Omega_ref)²                                       where it grows with the speed
//! ```
//!
//! The phases are uniform, from the seed, and independent of each other, so components are not
//! correlated unless [`correlation`](super::correlation) says so. Over a period T the mean square is the sum of `S / T`
//! over the lines, and the periodogram at the lines is S itself, whatever the seed: amplitudes are not random. It
//! approaches a normal process as lines grow in number. After T it repeats.
//!
//! A component that shares noise with others is a sum over independent noises (of vector processes: Deodatis,
//! J. Eng. Mech. 122(8), 778-787, 1996): the amplitudes of its lines differ from seed to
//! seed, and S is their mean.
//!
//! The paper has two-sided densities over the angular frequency; with `S_2 d omega = S df / 2` its
//! amplitude `sqrt(2) sqrt(2 S_2 d omega)` is the one above.

use nalgebra::Complex;

use super::correlation::CoherentPair;
use super::draws::phases;
use super::error::BroadbandError;
use super::waveform::{Line, knot_count};
use super::{COMPONENTS, Six, Waveform};

/// Most cycles of the highest line in a period, `f T`: 2^20 times of 32 bytes for each component.
pub(crate) const CYCLES_MAX: f64 = 131_072.0;
/// Frequencies at which a rounding of `f T` still counts as a line.
const ROUNDING: f64 = 1e-9;

/// Noise of force and torque.
#[derive(Clone, Debug, PartialEq)]
pub struct Broadband {
    /// Lowest and highest frequency, Hz; nothing outside.
    pub band: [f64; 2],
    /// T, s: the time after which it repeats; lines are 1 / T apart.
    pub period: f64,
    /// The frequencies of tables, Hz, each above the one before; empty where densities are constant.
    pub frequencies: Vec<f64>,
    /// One-sided densities, N²/Hz, then (N m)²/Hz: none (zero), one (constant), or one for each
    /// frequency.
    pub densities: Six<Vec<f64>>,
    /// `Omega_ref`, rad/s, at which the densities hold; none where they hold at any speed.
    pub reference_rate: Option<f64>,
    /// Pairs of components that share noise; empty where all are independent.
    pub pairs: Vec<CoherentPair>,
}

impl Broadband {
    /// What is wrong with it.
    ///
    /// # Errors
    /// The first fault.
    pub fn check(&self) -> Result<(), BroadbandError> {
        let Self { band: [from, to], period, frequencies, .. } = self;
        if !(*from > 0.0 && from < to && to.is_finite()) {
            return Err(BroadbandError::Band(self.band));
        }
        let cycles = [from * period, to * period];
        if !(*period > 0.0 && period.is_finite() && cycles[1] <= CYCLES_MAX)
            || self.cycles().is_empty()
        {
            return Err(BroadbandError::Period { period: *period, cycles });
        }
        let mut before = 0.0;
        for after in frequencies {
            if !(*after > before && after.is_finite()) {
                return Err(BroadbandError::Frequencies { before, after: *after });
            }
            before = *after;
        }
        if let (Some(first), Some(last)) = (frequencies.first(), frequencies.last())
            && !(first <= from && to <= last)
        {
            return Err(BroadbandError::Beyond { band: self.band, table: [*first, *last] });
        }
        for (component, densities) in COMPONENTS.into_iter().zip(&self.densities) {
            let (found, frequencies) = (densities.len(), frequencies.len());
            if found > 1 && found != frequencies {
                return Err(BroadbandError::Count { component, found, frequencies });
            }
            if let Some(value) =
                densities.iter().find(|value| !(**value >= 0.0 && value.is_finite()))
            {
                return Err(BroadbandError::Density { component, value: *value });
            }
        }
        match self.reference_rate {
            Some(rate) if rate == 0.0 || !rate.is_finite() => Err(BroadbandError::Reference(rate)),
            _ => self.check_pairs(),
        }
    }

    /// The cycles in a period of its lines.
    fn cycles(&self) -> std::ops::Range<usize> {
        let [from, to] = self.band.map(|frequency| frequency * self.period);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a cast from floating point saturates"
        )]
        let whole = |number: f64| number.clamp(0.0, CYCLES_MAX) as usize;
        let first = whole((from * (1.0 - ROUNDING)).ceil()).max(1);
        first..whole((to * (1.0 + ROUNDING)).floor()) + 1
    }

    /// Its one-sided density at a frequency, Hz: N²/Hz of a force, (N m)²/Hz of a moment; zero outside of
    /// the band. Between frequencies of a table a straight line between logarithms, or between the
    /// densities where one is zero.
    #[must_use]
    pub fn density(&self, component: usize, frequency: f64) -> f64 {
        let [from, to] = self.band;
        let slack = ROUNDING * frequency;
        let densities = self.densities.get(component).map_or(&[][..], Vec::as_slice);
        if !(from - slack <= frequency && frequency <= to + slack) {
            return 0.0;
        }
        let (last, rest) = match densities {
            [] => return 0.0,
            [density] => return *density,
            [_, .., last] => (*last, densities),
        };
        let after = self.frequencies.partition_point(|known| *known <= frequency);
        let at = |index: usize| Some((*self.frequencies.get(index)?, *rest.get(index)?));
        let Some((f_0, s_0)) = after.checked_sub(1).and_then(at) else {
            return rest.first().copied().unwrap_or(0.0);
        };
        let Some((f_1, s_1)) = at(after) else { return last };
        if s_0 == 0.0 || s_1 == 0.0 {
            return s_0 + (s_1 - s_0) * (frequency - f_0) / (f_1 - f_0);
        }
        // Of `libm`: bit-identical on every host.
        let share = libm::log(frequency / f_0) / libm::log(f_1 / f_0);
        s_0 * libm::exp(share * libm::log(s_1 / s_0))
    }

    /// The lines of a component, of the source of this name.
    ///
    /// The phase of a line does not depend on the band.
    #[must_use]
    pub fn lines(&self, component: usize, seed: u32, source: &str) -> Vec<Line> {
        if self.is_correlated(component) {
            return self.correlated_lines(component, seed, source);
        }
        let what = COMPONENTS.get(component).copied().unwrap_or_default();
        let cycles = self.cycles();
        let drawn = phases(seed, source, what).skip(cycles.start.saturating_sub(1));
        let line = |(cycles, phase): (usize, f64)| {
            #[expect(clippy::cast_precision_loss, reason = "at most CYCLES_MAX")]
            let density = self.density(component, cycles as f64 / self.period);
            Line { cycles, amplitude: (2.0 * density / self.period).sqrt(), phase }
        };
        cycles.zip(drawn).map(line).collect()
    }

    /// Of a component that shares noise: its parts of each independent noise, whose phases are those of the components
    /// up to this one.
    fn correlated_lines(&self, component: usize, seed: u32, source: &str) -> Vec<Line> {
        let cycles = self.cycles();
        let skipped = cycles.start.saturating_sub(1);
        let own = COMPONENTS.iter().take(component + 1);
        let mut drawn: Vec<_> = own.map(|what| phases(seed, source, what).skip(skipped)).collect();
        let line = |cycles: usize| {
            #[expect(clippy::cast_precision_loss, reason = "at most CYCLES_MAX")]
            let columns = self.independent(cycles as f64 / self.period);
            let mut sum = Complex::new(0.0, 0.0);
            for (phases, column) in drawn.iter_mut().zip(&columns) {
                let (sin, cos) = libm::sincos(phases.next().unwrap_or(0.0));
                sum += column.get(component).copied().unwrap_or_default() * Complex::new(cos, sin);
            }
            let amplitude = (2.0 / self.period).sqrt() * libm::hypot(sum.re, sum.im);
            Line { cycles, amplitude, phase: libm::atan2(sum.im, sum.re) }
        };
        cycles.map(line).collect()
    }

    /// How many times of 32 bytes its functions of time keep, all components together.
    #[must_use]
    pub fn knots(&self) -> usize {
        let components = self.densities.iter().filter(|densities| !densities.is_empty()).count();
        let highest = self.cycles().end.saturating_sub(1);
        knot_count(highest).and_then(|count| count.checked_mul(components)).unwrap_or(usize::MAX)
    }

    /// Its functions of time for a seed, of a source that has been checked.
    #[must_use]
    pub fn realise(&self, seed: u32, source: &str) -> Noise {
        let waveform = |component: usize| {
            let densities = self.densities.get(component)?;
            let acts = densities.iter().any(|density| *density != 0.0);
            acts.then(|| Waveform::new(self.period, &self.lines(component, seed, source)))
        };
        Noise { waveforms: std::array::from_fn(waveform), reference_rate: self.reference_rate }
    }
}

/// Noise as functions of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Noise {
    waveforms: Six<Option<Waveform>>,
    reference_rate: Option<f64>,
}

impl Noise {
    /// Force, N, and moment, N m, at a time, s, and a rate of the wheel, rad/s.
    #[must_use]
    pub fn at(&self, time: f64, rate: f64) -> Six<f64> {
        let ratio = self.reference_rate.map_or(1.0, |reference| rate / reference);
        let square = ratio * ratio;
        self.waveforms
            .each_ref()
            .map(|waveform| waveform.as_ref().map_or(0.0, |waveform| square * waveform.at(time)))
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Of an amplitude: 1.4e-8 of interpolation at the highest line, and below a quarter of the band 2^-16
    /// of it; eight digits of the density.
    const INTERPOLATION: f64 = 3e-8;

    fn table() -> Broadband {
        Broadband {
            band: [2.0, 40.0],
            period: 4.0,
            frequencies: vec![1.0, 10.0, 100.0],
            densities: [
                vec![1e-4, 1e-6, 1e-5],
                vec![2e-5],
                vec![],
                vec![],
                vec![0.0, 3e-6, 0.0],
                vec![],
            ],
            reference_rate: None,
            pairs: Vec::new(),
        }
    }

    /// The one-sided periodogram of even samples over one period, at some cycles in it: the square of the
    /// correlation with a cosine and a sine, by plain sums.
    fn periodogram(samples: &[f64], period: f64, cycles: u32) -> f64 {
        let count = f64::from(u32::try_from(samples.len()).expect("few"));
        let angle = |i: u32| TAU * f64::from(cycles) * f64::from(i) / count;
        let sum = |of: fn(f64) -> f64| {
            samples.iter().zip(0..).map(|(x, i)| x * of(angle(i))).sum::<f64>() / count
        };
        let (re, im) = (sum(f64::cos), sum(f64::sin));
        2.0 * (re * re + im * im) * period
    }

    #[test]
    fn a_realisation_has_the_density_that_defines_it() {
        let of = table();
        of.check().expect("valid");
        let noise = of.realise(3, "rw");
        let samples: Vec<_> =
            (0..1000).map(|i| noise.at(f64::from(i) * 4.0 / 1000.0, 0.0)).collect();
        for component in [0, 1, 4] {
            let history: Vec<f64> = samples.iter().map(|sample| sample[component]).collect();
            for cycles in [4, 8, 9, 39, 40, 41, 100, 160, 161, 200] {
                let frequency = f64::from(cycles) / 4.0;
                // Written out again: straight lines between logarithms, or between numbers at a zero.
                let within = (8..=160).contains(&cycles);
                let expected = match (within, component) {
                    (false, _) => 0.0,
                    (true, 0) if frequency <= 10.0 => 1e-4 * frequency.powi(-2),
                    (true, 0) => 1e-6 * frequency / 10.0,
                    (true, 1) => 2e-5,
                    (true, _) if frequency <= 10.0 => 3e-6 * (frequency - 1.0) / 9.0,
                    (true, _) => 3e-6 * (100.0 - frequency) / 90.0,
                };
                let found = periodogram(&history, 4.0, cycles);
                let bound = 2.0 * INTERPOLATION * 2e-5;
                assert!(
                    (found - expected).abs() < bound,
                    "{component} {cycles}: {found} {expected}"
                );
            }
            let square = history.iter().map(|x| x * x).sum::<f64>() / 1000.0;
            let sum: f64 = (8..=160).map(|k| of.density(component, f64::from(k) / 4.0) / 4.0).sum();
            assert!((square / sum - 1.0).abs() < INTERPOLATION, "{square} {sum}");
        }
        assert!(samples.iter().all(|sample| sample[2] == 0.0));
    }

    #[test]
    fn seeds_give_other_phases_and_the_same_seed_the_same_bits() {
        let bits = |seed: u32, source: &str| {
            table().realise(seed, source).at(1.234, 0.0).map(f64::to_bits)
        };
        assert_eq!(bits(1, "rw"), bits(1, "rw"));
        assert!(bits(1, "rw")[0] != bits(2, "rw")[0] && bits(1, "rw")[0] != bits(1, "other")[0]);
        // Components draw for themselves, and a narrower band leaves the phases that it keeps.
        let wide = table().lines(0, 1, "rw");
        let narrow = Broadband { band: [3.0, 4.0], ..table() }.lines(0, 1, "rw");
        assert_eq!(narrow, wide[4..=8]);
        assert_ne!(wide[0].phase, table().lines(1, 1, "rw")[0].phase);
    }

    #[test]
    fn the_force_grows_with_the_square_of_the_rate() {
        let scaled = Broadband { reference_rate: Some(100.0), ..table() }.realise(1, "rw");
        let fixed = table().realise(1, "rw").at(0.7, 300.0);
        for (scaled, fixed) in scaled.at(0.7, -300.0).iter().zip(fixed) {
            assert!((scaled - 9.0 * fixed).abs() <= 1e-15 * scaled.abs());
        }
    }

    #[test]
    fn what_cannot_be_realised_is_an_error() {
        let faults = [
            Broadband { band: [0.0, 1.0], ..table() },
            Broadband { band: [3.0, 2.0], ..table() },
            Broadband { band: [2.0, f64::INFINITY], ..table() },
            Broadband { band: [2.0, f64::NAN], ..table() },
            Broadband { period: 0.0, ..table() },
            Broadband { period: f64::NAN, ..table() },
            Broadband { period: 1e9, ..table() },
            Broadband { band: [2.1, 2.2], ..table() },
            Broadband { band: [2.0, 101.0], ..table() },
            Broadband { frequencies: vec![1.0, 100.0, 100.0], ..table() },
            Broadband { frequencies: vec![-1.0, 10.0, 100.0], ..table() },
            Broadband { frequencies: vec![1.0, 100.0], ..table() },
            Broadband { frequencies: vec![], ..table() },
            Broadband { reference_rate: Some(0.0), ..table() },
            Broadband {
                densities: [vec![-1.0], vec![], vec![], vec![], vec![], vec![]],
                ..table()
            },
            Broadband {
                densities: [vec![], vec![f64::NAN], vec![], vec![], vec![], vec![]],
                ..table()
            },
        ];
        for fault in faults {
            let error = fault.check().expect_err("a fault");
            assert!(!error.to_string().is_empty(), "{error:?}");
        }
    }
}
