//! The members of the workspace, in groups that are compiled apart, and their features: the one place where features
//! of a command are chosen.
//!
//! Features of one member reach what all others of a command are made of. So what is compiled with the solver's
//! lanes has commands of its own: the desktop tool, which has none, is compiled once for all commands.

/// Members that are compiled by one command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Members {
    /// Without the solver's lanes: the desktop tool, the generator, and in a default run the suites of the solver.
    Plain,
    /// With lanes of every width.
    InLanes,
}

/// Those whose unit tests and examples are compiled in lanes where everything is tested.
const SOLVER: [&str; 2] = ["precess-dynamics", "precess-tests"];

/// The suite that compares lanes with single evaluations: whatever else is tested is tested by itself.
const SUITE: (&str, &str) = ("precess-tests", "lanes");

/// Those that are nothing without lanes, and what only the Python package is made of: minutes to compile.
const LANES: [&str; 4] = ["precess-attack", "precess-counts", "precess-lanes", "precess-measure"];

impl Members {
    /// The group of a target of a package, `lib`, `bin` or the name of an integration test: that of the solver's
    /// library depends on whether everything is tested.
    pub(crate) fn of_target(package: &str, target: &str, everything: bool) -> Self {
        let in_lanes = LANES.contains(&package)
            || (package, target) == SUITE
            || (everything && target == "lib" && SOLVER.contains(&package));
        if in_lanes { Self::InLanes } else { Self::Plain }
    }

    /// Arguments of cargo that choose the features. Where everything is tested, spacecraft have every number of devices
    /// to eight.
    pub(crate) fn features(self, everything: bool) -> &'static [&'static str] {
        match self {
            Self::Plain if everything => &["--features", "precess-tests/shapes"],
            Self::Plain => &[],
            Self::InLanes => &["--features", "precess-tests/lanes"],
        }
    }

    /// The group in a message.
    pub(crate) fn says(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::InLanes => ", in lanes",
        }
    }
}

/// Arguments of cargo that select the members that are compiled without lanes in a default run.
pub(crate) fn without_lanes() -> Vec<&'static str> {
    let excluded = LANES.iter().flat_map(|name| ["--exclude", *name]);
    std::iter::once("--workspace").chain(excluded).collect()
}
