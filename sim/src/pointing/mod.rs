//! Pointing metrics of a line of sight: exposures, indices of ECSS, optical sensitivities, and margins.
//!
//! | file | what |
//! |---|---|
//! | `weights` | shares of a line's variance in an exposure, [`ExposureWeights`] |
//! | `exposure` | [`Exposure`]: displacement, smear and jitter, from densities, lines and histories |
//! | `indices` | [`Index`]: APE, MPE, RPE, PDE, PRE, as they are formed along a history |
//! | `statistics` | their [`Interpretation`] over time and runs, with level and confidence; from densities |
//! | `quantile` | a quantile of any number of samples in bounded memory |
//! | `line_of_sight` | [`LineOfSight`]: by motions of nodes, or of a rigid instrument |
//! | `margin` | [`Limit`], [`Margin`]: tables of requirements |
//! | `state` | [`RequirementState`]: met, violated, or not evaluated, with the reason |
//!
//! A signal is in any unit, usually rad. Sources: R. L. Lucke, S. W. Sirlin, A. M. San Martin, "New definitions of
//! pointing stability: AC and DC effects", J. Astronautical Sciences 40(4), 1992; M. E. Pittelkau, W. G. `McKinley`,
//! Optical Engineering 55(6) 063108, 2016; ECSS-E-ST-60-10C, 2008; ESSB-HB-E-003, 2011.
//!
//! ```
//! use precess::pointing::exposure_of_lines;
//!
//! // A wheel at 100 Hz moves the line of sight by 0.4 urad; images of 10 ms and 0.1 ms.
//! let lines = [[100.0, 0.4e-6]];
//! let [slow, fast] = [10e-3, 0.1e-3].map(|time| exposure_of_lines(&lines, time));
//! assert!(slow?.jitter > 0.2e-6 && fast?.jitter < 1e-9);
//! # Ok::<(), precess::pointing::PointingError>(())
//! ```

mod error;
mod exposure;
mod indices;
mod line_of_sight;
mod margin;
mod quantile;
mod state;
mod statistics;
#[cfg(test)]
mod tests;
mod weights;

pub use error::PointingError;
pub use exposure::{
    Exposure, ExposureHistory, exposure_of_history, exposure_of_lines, exposure_of_psd,
    exposure_of_table,
};
pub use indices::Index;
pub use line_of_sight::{LineOfSight, NodeMotion, Sensitivity};
pub use margin::{Assessment, Limit, Margin, Metric, assess};
pub use state::{NoData, RequirementState};
pub use statistics::{IndexValue, Interpretation, index_of_psd, index_of_runs};
pub use weights::ExposureWeights;

pub(crate) use exposure::{EXPOSURE_SAMPLES_MIN, WindowSums};
pub(crate) use indices::IndexStream;
pub(crate) use quantile::Quantile;

use crate::spectra::float;

/// Samples of a window, at most.
const SAMPLES_MAX: f64 = 4_194_304.0;
/// A window is a whole number of samples up to this share of itself.
const WHOLE: f64 = 0.01;

/// Samples of a window, s, at a rate, 1/s: at least `least`.
pub(crate) fn samples_of(window: f64, rate: f64, least: usize) -> Result<usize, PointingError> {
    let exact = window * rate;
    let whole = exact.round();
    // A NaN is in no range.
    let fits = (float(least)..=SAMPLES_MAX).contains(&whole);
    if !fits || (whole / exact - 1.0).abs() > WHOLE {
        return Err(PointingError::Window { window, rate, least });
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within 0 and SAMPLES_MAX"
    )]
    let count = whole as usize;
    Ok(count)
}
