//! Spectra of evenly sampled signals: densities, cross-spectra, lines, orders, and RMS over frequency.
//!
//! | file | what |
//! |---|---|
//! | `window` | [`Window`]: rectangular, Hann, flat-top |
//! | `settings` | [`WelchSettings`], and the [`Metadata`] that state how a spectrum was computed |
//! | `segment` | one segment: trend removed, windowed, transformed |
//! | `density` | [`psd`]: one-sided power spectral density by Welch's method |
//! | `cross` | [`cross_spectra`]: Hermitian matrix of n signals, and their coherence |
//! | `lines` | [`amplitude_spectrum`]: amplitudes of lines, and [`Line`] the strongest of them |
//! | `orders` | [`track_orders`]: amplitude and phase against a phase signal |
//! | `confidence` | equivalent number of averages, and intervals by chi-square |
//!
//! Densities are one-sided, in unit²/Hz, and frequencies are in Hz. Sources: P. D. Welch, IEEE Trans. Audio
//! Electroacoust. 15(2), 1967; G. Heinzel, A. Rüdiger, R. Schilling, "Spectrum and spectral density
//! estimation by the DFT", 2002; J. S. Bendat, A. G. Piersol, Random Data, 4th edition.
//!
//! ```
//! use precess::spectra::{WelchSettings, psd};
//!
//! let samples: Vec<f64> = (0..4096).map(|i| 2.0 * (0.3 * f64::from(i)).sin()).collect();
//! let found = psd(&samples, 1000.0, &WelchSettings::hann(1024))?;
//! // 0.3 rad a sample are 47.7 Hz.
//! assert!((found.band_rms([40.0, 60.0])? - 2.0_f64.sqrt()).abs() < 1e-3);
//! assert_eq!(found.metadata.segments, 7);
//! # Ok::<(), precess::spectra::SpectrumError>(())
//! ```
//!
//! Sines and cosines of the windows do not depend on the host; those inside the transform are of the
//! transform's crate.

mod confidence;
mod cross;
mod density;
mod error;
mod lines;
mod orders;
pub(crate) mod segment;
mod settings;
#[cfg(test)]
#[expect(clippy::unreadable_literal, reason = "as another program prints them")]
mod stored;
#[cfg(test)]
pub(crate) mod synthetic;
#[cfg(test)]
mod tests;
mod window;

pub use cross::{CrossSpectra, cross_spectra};
pub use density::{Psd, psd};
pub use error::SpectrumError;
pub use lines::{AmplitudeSpectrum, Line, amplitude_spectrum};
pub use orders::{Order, OrderSettings, OrderWindow, track_orders};
pub use settings::{Detrend, Metadata, WelchSettings};
pub use window::Window;

/// A count as a number.
#[expect(clippy::cast_precision_loss, reason = "counts of samples in memory, below 2^53")]
pub(crate) fn float(count: usize) -> f64 {
    count as f64
}
