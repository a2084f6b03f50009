//! [`Plan`]: the samples of a campaign in order, and the digest that names it.

use sha2::{Digest as _, Sha256};

use super::{Axis, CampaignError, NUMBERS_MAX, SAMPLES_MAX, Selection};
use crate::control::program_digests;
use crate::file::Override;
use crate::scenario::{ControlLaw, Scenario};

/// The samples of a campaign.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Keys and units of the values: `device.rw.wheel.rate [rpm]`.
    pub labels: Vec<String>,
    /// The samples in order.
    pub samples: Vec<Sample>,
    /// What the samples follow from. Plans of which one has more samples, and the others are the same, have one identity.
    pub identity: String,
}

/// A sample: the values of its keys.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// One for each label.
    pub values: Vec<f64>,
    /// What sets the keys.
    pub overrides: Vec<Override>,
}

impl Plan {
    /// The values of a sample with their labels, for a sentence: `device.rw.wheel.rate [rpm] = 600`.
    #[cfg(feature = "tool")]
    #[must_use]
    pub(crate) fn shown(&self, sample: usize) -> String {
        let values = self.samples.get(sample).map_or(&[][..], |sample| &sample.values);
        let pairs = self.labels.iter().zip(values);
        pairs.map(|(label, value)| format!("{label} = {value}")).collect::<Vec<_>>().join(", ")
    }

    /// Every combination of the values of some axes, the last axis fastest.
    ///
    /// # Errors
    /// No samples or too many, or two axes of one key.
    pub fn of_axes(axes: &[Axis]) -> Result<Self, CampaignError> {
        let product = |found: usize, axis: &Axis| found.saturating_mul(axis.values.len());
        let found = axes.iter().fold(usize::from(!axes.is_empty()), product);
        if found == 0 || found > SAMPLES_MAX {
            return Err(CampaignError::Samples { found, most: SAMPLES_MAX });
        }
        let mut samples = vec![Sample { values: Vec::new(), overrides: Vec::new() }];
        for (index, axis) in axes.iter().enumerate() {
            if axes.iter().take(index).any(|other| other.key == axis.key) {
                return Err(CampaignError::Twice(axis.key.clone()));
            }
            let with = |sample: &Sample, value: f64| {
                let mut sample = sample.clone();
                sample.values.push(value);
                sample.overrides.push(axis.set(value));
                sample
            };
            samples = samples
                .iter()
                .flat_map(|sample| axis.values.iter().map(move |value| with(sample, *value)))
                .collect();
        }
        Ok(Self {
            labels: axes.iter().map(Axis::label).collect(),
            samples,
            identity: format!("{axes:?}"),
        })
    }

    /// The digest of what the rows depend on: version of the program, text of the scenario with every default, what is
    /// recorded, what the samples follow from, and the files of programs that are controllers.
    #[must_use]
    pub fn digest(&self, scenario: &Scenario, selection: &Selection) -> [u8; 32] {
        let mut hash = Sha256::new();
        let mut part = |text: &str| {
            hash.update(u64::try_from(text.len()).unwrap_or(u64::MAX).to_le_bytes());
            hash.update(text.as_bytes());
        };
        part("precess campaign 1");
        part(env!("CARGO_PKG_VERSION"));
        part(&scenario.source.text);
        part(&scenario.source.filled);
        part(&format!("{selection:?}"));
        part(&self.identity);
        for of in &scenario.controllers {
            if let ControlLaw::Program { command, folder, .. } = &of.law {
                part(&format!("{command:?} {:?}", program_digests(command, folder)));
            }
        }
        hash.finalize().into()
    }

    /// Rejects a table of too many numbers.
    pub(super) fn check_size(&self, fields: usize) -> Result<(), CampaignError> {
        let samples = self.samples.len();
        if samples.saturating_mul(fields.saturating_add(self.labels.len())) > NUMBERS_MAX {
            return Err(CampaignError::Size { samples, fields });
        }
        Ok(())
    }
}

/// A number in the fewest digits that read back the same, an integer without a point.
#[must_use]
pub fn digits(value: f64) -> String {
    let text = zmij::Buffer::new().format(value).to_owned();
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}
