//! [`CampaignError`]: what keeps a campaign from being started, continued or written.

use std::fmt;
use std::path::PathBuf;

use crate::file::Diagnostics;
use crate::record::RecordError;

/// What keeps a campaign from being started, continued or written.
#[derive(Debug)]
pub enum CampaignError {
    /// A text is no axis.
    Axis {
        /// The text.
        text: String,
        /// What is wrong.
        reason: &'static str,
    },
    /// A number or unit of an axis cannot be read.
    Value {
        /// The text.
        text: String,
        /// What is wrong.
        reason: String,
    },
    /// An axis or a campaign has no samples, or too many.
    Samples {
        /// How many.
        found: usize,
        /// Most that there may be.
        most: usize,
    },
    /// Two axes are of one key.
    Twice(String),
    /// A correlation that is none.
    Correlation {
        /// The keys of the pair.
        keys: [String; 2],
        /// What is wrong.
        reason: &'static str,
    },
    /// Correlations that no values have together: their matrix is not positive definite.
    Indefinite {
        /// The keys of a pair that the others do not allow.
        keys: [String; 2],
        /// What its coefficient is between where the others stay; none where no value will do.
        within: Option<[f64; 2]>,
        /// The pivot of Cholesky's factor that is not above zero.
        pivot: f64,
    },
    /// A sample is no list of probabilities, one for each distribution.
    Probabilities {
        /// The sample, from 0.
        sample: usize,
        /// Distributions.
        keys: usize,
    },
    /// The table of results would have too many numbers.
    Size {
        /// Samples.
        samples: usize,
        /// Numbers of a sample.
        fields: usize,
    },
    /// A scenario that cannot be read.
    Scenario(Diagnostics),
    /// A column that there is not.
    Record(RecordError),
    /// A journal is of another campaign, or no journal.
    OtherPlan(PathBuf),
    /// Another program writes to a journal.
    Locked {
        /// The journal.
        path: PathBuf,
        /// Which program, and what to do.
        source: std::io::Error,
    },
    /// A journal cannot be read or written.
    Io {
        /// The file.
        path: PathBuf,
        /// The operating system's reason.
        source: std::io::Error,
    },
}

impl fmt::Display for CampaignError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Axis { text, reason } => write!(
                f,
                "`{text}`: {reason}; write KEY=FROM..TO UNIT:COUNT, KEY=FROM..TO UNIT:log COUNT or \
                 KEY=1,2,5 UNIT"
            ),
            Self::Value { text, reason } => write!(
                f,
                "`{text}`: {reason}; write numbers and one unit: \"600..6000 rpm:181\" or \"1,2,5 kg\""
            ),
            Self::Samples { found, most } => {
                write!(f, "{found} samples are not within 1 to {most}; write another count")
            }
            Self::Twice(key) => {
                write!(
                    f,
                    "two axes are of the key `{key}`; name two keys, or list values in one axis"
                )
            }
            Self::Correlation { keys: [a, b], reason } => {
                write!(f, "the correlation of `{a}` and `{b}`: {reason}")
            }
            Self::Indefinite { keys: [a, b], within, pivot } => {
                write!(
                    f,
                    "the correlations are not positive definite (pivot {pivot:.3e}) at the pair `{a}` and \
                     `{b}`; "
                )?;
                match within {
                    Some([low, high]) => {
                        write!(
                            f,
                            "with the others, its coefficient is above {low:.4} and below {high:.4}"
                        )
                    }
                    None => write!(f, "reduce it and the others of `{b}`"),
                }
            }
            Self::Probabilities { sample, keys } => write!(
                f,
                "sample {sample} is not of {keys} probabilities between zero and one; state one for each key"
            ),
            Self::Size { samples, fields } => write!(
                f,
                "{samples} samples of {fields} numbers are more than {}; take fewer samples, lines or \
                 columns",
                super::NUMBERS_MAX
            ),
            Self::Scenario(errors) => errors.fmt(f),
            Self::Record(error) => error.fmt(f),
            Self::OtherPlan(path) => write!(
                f,
                "{} is no journal of this scenario, plan and version of the program; choose another \
                 folder by --out, or discard it with --force",
                path.display()
            ),
            Self::Locked { path, source } | Self::Io { path, source } => {
                write!(f, "{}: {source}", path.display())
            }
        }
    }
}

impl std::error::Error for CampaignError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Scenario(source) => Some(source),
            Self::Record(source) => Some(source),
            Self::Locked { source, .. } | Self::Io { source, .. } => Some(source),
            _ => None,
        }
    }
}

impl From<RecordError> for CampaignError {
    fn from(error: RecordError) -> Self {
        Self::Record(error)
    }
}
