//! `precess::fit` against a wheel of known imbalance, harmonics and modes, measured in the time domain.
#![expect(
    clippy::cast_precision_loss,
    reason = "counts of samples and trials, and integers of 53 bits"
)]

mod accuracy;
mod commands;
mod coupled;
mod scene;
mod spectra;
mod synthetic;
mod trials;
mod waterfalls;
