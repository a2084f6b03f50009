//! The members of the workspace, in groups that are compiled apart.
//!
//! Features of one member reach what all others of a command are made of. So what is compiled with the solver's
//! lanes has commands of its own: the desktop tool, which has none, is compiled once for all commands.

/// Those whose tests need the solver's lanes.
const IN_LANES: [&str; 7] = [
    "precess-attack",
    "precess-counts",
    "precess-double-double",
    "precess-dynamics",
    "precess-measure",
    "precess-point-masses",
    "precess-tests",
];

/// What only the Python package is made of, whose tests are those of campaigns in lanes: minutes to compile.
const OF_PYTHON: [&str; 1] = ["precess-lanes"];

/// Arguments of cargo that select the members whose tests need lanes.
pub(crate) fn in_lanes() -> Vec<&'static str> {
    IN_LANES.iter().flat_map(|name| ["--package", *name]).collect()
}

/// Arguments of cargo that select all others.
pub(crate) fn without_lanes() -> Vec<&'static str> {
    let excluded = IN_LANES.iter().chain(&OF_PYTHON).flat_map(|name| ["--exclude", *name]);
    std::iter::once("--workspace").chain(excluded).collect()
}
