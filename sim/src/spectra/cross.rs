//! [`cross_spectra`]: the Hermitian matrix of one-sided spectral densities of n signals, such as the six loads at an
//! interface, and their coherence.

use nalgebra::{Complex, DMatrix};

use super::density::{check_samples, finite};
use super::segment::{Segment, sides};
use super::{Metadata, Psd, SpectrumError, WelchSettings, float};

/// Complex numbers of a result, at most: 256 MiB.
const ELEMENTS_MAX: usize = 1 << 24;

/// One-sided cross-spectral densities of n signals.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossSpectra {
    /// How they were computed.
    pub metadata: Metadata,
    signals: usize,
    /// Bin by bin, row by row.
    elements: Vec<Complex<f64>>,
}

/// One-sided cross-spectral densities of signals of one length at a rate, 1/s, by Welch's method:
/// `G_ij,k = c_k / (K rate sum w^2) sum_s conj(X_i,k,s) X_j,k,s`, in the units of i and j by Hz. Its diagonal is
/// that of [`psd`](super::psd); a signal j that lags i has a negative phase (Bendat and Piersol, 5.2; the `csd` of
/// `SciPy`).
///
/// # Errors
///
/// Rate, segment, overlap, signals of different lengths, a sample that is not finite, or a result of more than 2^24
/// complex numbers.
pub fn cross_spectra(
    signals: &[&[f64]],
    rate: f64,
    settings: &WelchSettings,
) -> Result<CrossSpectra, SpectrumError> {
    let n = signals.len();
    let samples = signals.first().map_or(0, |signal| signal.len());
    let metadata = Metadata::new(*settings, rate, samples)?;
    let bins = metadata.bins();
    let numbers = n.saturating_mul(n).saturating_mul(bins);
    if !(1..=ELEMENTS_MAX).contains(&numbers) {
        return Err(SpectrumError::Size { numbers, most: ELEMENTS_MAX });
    }
    for (signal, values) in signals.iter().enumerate() {
        if values.len() != samples {
            let (expected, found) = (samples, values.len());
            return Err(SpectrumError::Lengths { signal, expected, found });
        }
        check_samples(signal, values)?;
    }
    let mut segment = Segment::new(settings.length, settings.window, settings.detrend);
    let mut elements = vec![Complex::new(0.0, 0.0); numbers];
    let mut spectra: Vec<Vec<Complex<f64>>> = vec![Vec::new(); n];
    for start in settings.starts(samples) {
        for (spectrum, signal) in spectra.iter_mut().zip(signals) {
            let part = signal.get(start..start + settings.length).unwrap_or_default();
            spectrum.clear();
            spectrum.extend_from_slice(segment.transform(part)?);
        }
        for (bin, matrix) in elements.chunks_exact_mut(n * n).enumerate() {
            let value = |i: usize| spectra.get(i).and_then(|s| s.get(bin)).copied();
            for (place, element) in matrix.iter_mut().enumerate() {
                let (i, j) = (place / n, place % n);
                if let (true, Some(a), Some(b)) = (i <= j, value(i), value(j)) {
                    *element += a.conj() * b;
                }
            }
        }
    }
    let scale = float(metadata.segments) * rate * segment.squares();
    for (bin, matrix) in elements.chunks_exact_mut(n * n).enumerate() {
        let factor = sides(bin, settings.length) / scale;
        for i in 0..n {
            for j in i..n {
                let value = matrix.get(i * n + j).copied().unwrap_or_default() * factor;
                // Of the diagonal, the imaginary part is zero but for rounding of fused operations.
                let value = if i == j { Complex::new(value.re, 0.0) } else { value };
                finite(&[value.re, value.im])?;
                for (place, value) in [(j * n + i, value.conj()), (i * n + j, value)] {
                    if let Some(element) = matrix.get_mut(place) {
                        *element = value;
                    }
                }
            }
        }
    }
    Ok(CrossSpectra { metadata, signals: n, elements })
}

impl CrossSpectra {
    /// Number of signals, n.
    #[must_use]
    pub const fn signals(&self) -> usize {
        self.signals
    }

    /// The n × n matrix of a bin, Hermitian; none beyond half the rate.
    #[must_use]
    pub fn at(&self, bin: usize) -> Option<DMatrix<Complex<f64>>> {
        let n = self.signals;
        let elements = self.elements.chunks_exact(n * n).nth(bin)?;
        Some(DMatrix::from_row_slice(n, n, elements))
    }

    /// The density of two signals over frequency, `G_ij`.
    ///
    /// # Errors
    ///
    /// A number of a signal that there is not.
    pub fn between(&self, i: usize, j: usize) -> Result<Vec<Complex<f64>>, SpectrumError> {
        let n = self.signals;
        if let Some(index) = [i, j].into_iter().find(|index| *index >= n) {
            return Err(SpectrumError::Index { index, count: n });
        }
        let matrices = self.elements.chunks_exact(n * n);
        Ok(matrices.map(|matrix| matrix.get(i * n + j).copied().unwrap_or_default()).collect())
    }

    /// The power spectral density of one signal.
    ///
    /// # Errors
    ///
    /// A number of a signal that there is not.
    pub fn psd(&self, signal: usize) -> Result<Psd, SpectrumError> {
        let density = self.between(signal, signal)?.iter().map(|value| value.re).collect();
        Ok(Psd { metadata: self.metadata, density })
    }

    /// Coherence `|G_ij|^2 / (G_ii G_jj)` over frequency, from 0 to 1; zero where a signal has no power. Of
    /// signals that have nothing in common it is about one by the number of averages.
    ///
    /// # Errors
    ///
    /// A number of a signal that there is not, or fewer averages than two: of one it is one throughout.
    pub fn coherence(&self, i: usize, j: usize) -> Result<Vec<f64>, SpectrumError> {
        if self.metadata.averages < 2.0 {
            return Err(SpectrumError::Averages(self.metadata.averages));
        }
        let (cross, a, b) = (self.between(i, j)?, self.psd(i)?, self.psd(j)?);
        let powers = a.density.iter().zip(&b.density);
        let of = |(cross, (a, b)): (&Complex<f64>, (&f64, &f64))| {
            // Divided one after the other: the product may overflow.
            if *a > 0.0 && *b > 0.0 {
                (cross.norm() / a * (cross.norm() / b)).min(1.0)
            } else {
                0.0
            }
        };
        Ok(cross.iter().zip(powers).map(of).collect())
    }
}
