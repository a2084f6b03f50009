//! [`Backend`]: what makes the steps of a campaign, and what is said where it cannot be a GPU.

use clap::ValueEnum;

use super::Prepared;
use crate::campaign::shows_work;
use crate::command::error::CommandError;
use crate::engine::Gpu;

/// What makes the steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::command) enum Backend {
    /// The processor.
    Cpu,
    /// A GPU of NVIDIA.
    Cuda,
}

impl Backend {
    /// The GPU where one is wanted; none where there is none, which a note says with the reason.
    ///
    /// # Errors
    /// What a GPU does not support; a build without the feature `cuda`.
    pub(super) fn gpu(self, prepared: &Prepared) -> Result<Option<Gpu>, CommandError> {
        if self == Self::Cpu {
            return Ok(None);
        }
        let refused = |what: String| CommandError::Other(format!("--backend cuda: {what}"));
        if let Some(what) = prepared.scenario.not_on_gpu() {
            return Err(refused(what.to_string()));
        }
        if shows_work(&prepared.scenario) {
            return Err(refused(
                "a GPU does not compute the column `work`; leave it out".to_owned(),
            ));
        }
        opened(prepared)
    }
}

#[cfg(feature = "cuda")]
#[expect(clippy::unnecessary_wraps, reason = "an error without the feature `cuda`")]
fn opened(prepared: &Prepared) -> Result<Option<Gpu>, CommandError> {
    let devices = prepared.scenario.devices_on_hub().unwrap_or_default();
    match Gpu::open(devices) {
        Ok(gpu) => Ok(Some(gpu)),
        Err(reason) => {
            crate::command::terminal::note(&format!(
                "warning: --backend cuda: {reason}; the processor makes the steps, with the same numbers"
            ));
            Ok(None)
        }
    }
}

#[cfg(not(feature = "cuda"))]
fn opened(_: &Prepared) -> Result<Option<Gpu>, CommandError> {
    Err(CommandError::Other(
        "--backend cuda is not part of this build: it has not the feature `cuda`; build it with `cargo install --path sim \
         --features cuda`"
            .to_owned(),
    ))
}
