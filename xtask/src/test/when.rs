//! [`When`]: which runs a suite is in.

/// When a suite runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum When {
    /// In every `cargo xtask test`.
    Always,
    /// The same, with its long tests only in `--all --for` a folder whose change can break it.
    AlwaysShort,
    /// In `cargo xtask test --all` only.
    All,
    /// Only in `--all --for` a folder whose change can break it: what takes minutes, and finds what nothing else can break.
    AllFor,
    /// Elsewhere: a sample of what a suite of [`Self::AllFor`] does in full.
    Sample,
}

impl When {
    /// As tables have it, of a run without options.
    pub(crate) fn says(self) -> &'static str {
        match self {
            Self::Always => "yes",
            Self::AlwaysShort => "yes; long tests not in `--all`",
            Self::All => "no",
            Self::AllFor => "no, nor in `--all`",
            Self::Sample => "only there",
        }
    }
}
