//! What is compared with what: the same computation of the same spacecraft.

use std::path::{Path, PathBuf};

use serde::Deserialize;

/// A computation that several contenders do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub(crate) enum Subject {
    /// All accelerations of one state.
    #[serde(rename = "evaluation")]
    Evaluation,
    /// Those of many states, per state.
    #[serde(rename = "batch")]
    Batch,
    /// An RK4 step of one state.
    #[serde(rename = "step")]
    Step,
    /// An RK4 step of many states, per state.
    #[serde(rename = "batch step")]
    BatchStep,
    /// All accelerations of one state of the imaging satellite.
    #[serde(rename = "baked")]
    Baked,
    /// All accelerations of four reaction wheels on something that gives.
    #[serde(rename = "flexible")]
    Flexible,
    /// Derivatives of the accelerations of one state, and of a step.
    #[serde(rename = "derivatives")]
    Derivatives,
    /// An operation at the issue floor.
    #[serde(skip)]
    Floor,
}

/// The case of [`Subject::Baked`].
pub(crate) const IMAGING: &str = "imaging satellite";
/// The cases of [`Subject::Step`], with their titles; others are numbers of DGVSCMGs.
pub(crate) const WHEELS: (&str, &str) = ("wheels", "3 reaction wheels");
pub(crate) const VSCMG: (&str, &str) = ("vscmg", "1 VSCMG");

/// The description of the imaging satellite.
const DESCRIPTION: &str = "tests/baked/imaging_satellite/description.toml";

impl Subject {
    /// The service that the ratios of a table are taken to.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::Evaluation => "dispatched",
            Self::Batch => "batch",
            Self::Step => "step",
            Self::BatchStep => "steps",
            Self::Baked => "general",
            Self::Flexible => "flexible",
            Self::Derivatives => "evaluation",
            Self::Floor => "",
        }
    }

    /// Whether results of both can be compared.
    pub(crate) fn compares_with(self, other: Self) -> bool {
        let evaluations = [Self::Evaluation, Self::Batch];
        self == other || evaluations.contains(&self) && evaluations.contains(&other)
    }

    /// The file of a case.
    pub(crate) fn file(self, folder: &Path, case: &str) -> PathBuf {
        match self {
            Self::Evaluation | Self::Batch | Self::Floor => folder.join(format!("{case}.json")),
            Self::Derivatives => folder.join("derivatives").join(format!("{case}.json")),
            Self::Step | Self::BatchStep => folder.join("steps").join(format!("{case}.json")),
            Self::Flexible => folder.join("flexible").join(format!("{case}.json")),
            Self::Baked => PathBuf::from(DESCRIPTION),
        }
    }
}
