//! The suites: one row for each program of tests and each command that tests.
//!
//! A row states the folders whose change can break it, so that `cargo xtask test --for PATH` runs what matters. Tests
//! in `complete` hold the table against the targets of the workspace and the folders of its sources.

use std::path::Path;

pub(crate) use super::when::When;

/// How a suite is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum How {
    /// A test program of cargo: package and target, which is `lib`, `bin` or the name of an integration test.
    Target { package: &'static str, target: &'static str },
    /// Examples in the documentation of libraries.
    Documentation,
    /// A command of the workbench, with its arguments.
    Command(&'static [&'static str]),
}

/// Folders and files whose change can break a suite, from the repository's root.
type Folders = &'static [&'static [&'static str]];

/// A suite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Suite {
    pub(crate) how: How,
    pub(crate) when: When,
    pub(crate) broken_by: Folders,
}

/// The derivation, its proofs, and what is emitted.
const GENERATOR: &[&str] = &["codegen/src", "tests/derivation"];
/// Kernels of one spacecraft.
const BAKING: &[&str] = &["codegen/bake", "codegen/description", "tests/baked"];
/// The solver but for its lanes.
const SOLVER: &[&str] = &[
    "dynamics/Cargo.toml",
    "dynamics/src/attitude",
    "dynamics/src/derivatives",
    "dynamics/src/equations",
    "dynamics/src/flexible",
    "dynamics/src/generated",
    "dynamics/src/integrate",
    "dynamics/src/isolation",
    "dynamics/src/lib.rs",
    "dynamics/src/model",
    "dynamics/src/numbers",
    "dynamics/src/results",
    "dynamics/src/rigid",
    "dynamics/src/sets",
    "dynamics/src/solve",
    "dynamics/src/steering",
    "dynamics/src/validation",
];
/// Several states or devices at a time.
const LANES: &[&str] = &["dynamics/src/lanes"];
/// References and random spacecraft that suites share.
const REFERENCES: &[&str] =
    &["tests/src", "tests/double_double", "tests/point_masses", "tests/Cargo.toml"];
/// What builds crates outside the workspace.
const OUTSIDE: &[&str] = &["tests/outside"];
/// What is stored of the engines, and the scripts that store it.
const ENGINES: &[&str] = &["tests/engines", "tests/fixtures"];
/// The desktop tool, whichever of its commands.
const DESKTOP: &[&str] =
    &["sim/Cargo.toml", "sim/control", "sim/craft", "sim/schema", "sim/src", "scenarios"];
/// What goes on board.
const BOARD: &[&str] = &["flight"];
/// Pages.
const PAGES: &[&str] = &["docs", "README.md", "CHANGELOG.md"];

const fn always(package: &'static str, target: &'static str, broken_by: Folders) -> Suite {
    Suite { how: How::Target { package, target }, when: When::Always, broken_by }
}

const fn always_short(package: &'static str, target: &'static str, broken_by: Folders) -> Suite {
    Suite { how: How::Target { package, target }, when: When::AlwaysShort, broken_by }
}

const fn all(package: &'static str, target: &'static str, broken_by: Folders) -> Suite {
    Suite { how: How::Target { package, target }, when: When::All, broken_by }
}

const fn all_for(package: &'static str, target: &'static str, broken_by: Folders) -> Suite {
    Suite { how: How::Target { package, target }, when: When::AllFor, broken_by }
}

const fn command(words: &'static [&'static str], when: When, broken_by: Folders) -> Suite {
    Suite { how: How::Command(words), when, broken_by }
}

/// The suite of examples in the documentation.
pub(crate) const DOCUMENTATION: &str = "examples in documentation";

/// Every suite, in the order of their run: a broken generated file is named before anything compiles it.
pub(crate) const SUITES: &[Suite] = &[
    command(
        &["lint"],
        When::All,
        &[&["codegen", "dynamics", "sim", "tests", "xtask", "flight", "Cargo.toml"]],
    ),
    command(
        &["regen", "--check", "--quiet"],
        When::Always,
        &[GENERATOR, &["codegen/review", "dynamics/src/generated", "docs"]],
    ),
    command(&["bake", "--check"], When::Always, &[GENERATOR, BAKING]),
    command(
        &["mutate", "--sample", "100"],
        When::Sample,
        &[GENERATOR, &["codegen/review", "tests/fixtures"]],
    ),
    command(
        &["mutate", "--check"],
        When::AllFor,
        &[GENERATOR, &["codegen/review", "tests/fixtures", "docs"]],
    ),
    command(&["demo"], When::All, &[GENERATOR, SOLVER, DESKTOP]),
    // The generator.
    always("precess-codegen", "lib", &[GENERATOR]),
    always(
        "precess-codegen",
        "c_kernels",
        &[GENERATOR, SOLVER, OUTSIDE, &["codegen/tests/c_kernels", "docs/c.md"]],
    ),
    always("precess-codegen", "chains", &[GENERATOR, &["codegen/tests/chains.rs"]]),
    always(
        "precess-codegen",
        "external_kind",
        &[GENERATOR, SOLVER, OUTSIDE, &["codegen/tests/external_kind", "docs/adding-a-kind.md"]],
    ),
    always(
        "precess-codegen",
        "flexible_wheels",
        &[GENERATOR, &["codegen/tests/flexible_wheels.rs"]],
    ),
    always("precess-codegen", "limits", &[GENERATOR, &["codegen/tests/limits.rs"]]),
    always("precess-codegen", "modes", &[GENERATOR, &["codegen/tests/modes.rs"]]),
    always_short(
        "precess-codegen",
        "mutation",
        &[GENERATOR, &["codegen/tests/mutation", "codegen/tests/folder"]],
    ),
    always("precess-codegen", "passes", &[GENERATOR, &["codegen/tests/passes.rs"]]),
    always(
        "precess-codegen",
        "point_masses",
        &[GENERATOR, &["codegen/tests/point_masses.rs", "codegen/tests/folder"]],
    ),
    always(
        "precess-codegen",
        "registry",
        &[GENERATOR, SOLVER, DESKTOP, BOARD, PAGES, &["codegen/tests/registry.rs"]],
    ),
    always("precess-bake", "lib", &[GENERATOR, BAKING]),
    always("precess-bake", "c_reference", &[GENERATOR, BAKING]),
    always(
        "precess-bake",
        "c_solver",
        &[GENERATOR, SOLVER, BAKING, &["codegen/tests/c_kernels", "docs/c.md"]],
    ),
    always("precess-bake", "missions", &[GENERATOR, BAKING]),
    all_for("precess-bake", "mutation", &[GENERATOR, BAKING]),
    always("precess-description", "lib", &[BAKING]),
    always("precess-review", "lib", &[GENERATOR, &["codegen/review"]]),
    always("precess-review", "physics", &[GENERATOR, &["codegen/review", "tests/fixtures"]]),
    always(
        "precess-review",
        "printed",
        &[
            GENERATOR,
            &["codegen/review", "codegen/tests/folder", "docs/errata.md", "docs/letter.md"],
        ],
    ),
    all_for(
        "precess-derive",
        "bin",
        &[GENERATOR, BAKING, &["codegen/review", "xtask/derive", "xtask/src"]],
    ),
    // The solver.
    always("precess-dynamics", "lib", &[SOLVER, LANES]),
    always("precess-double-double", "lib", &[SOLVER, REFERENCES]),
    always("precess-tests", "lib", &[SOLVER, REFERENCES]),
    always("precess-tests", "dynamics", &[SOLVER, REFERENCES, &["tests/tests/dynamics"]]),
    always("precess-tests", "flexible", &[SOLVER, REFERENCES, &["tests/tests/flexible"]]),
    always(
        "precess-tests",
        "isolated",
        &[SOLVER, REFERENCES, &["tests/tests/isolated", "tests/fixtures"]],
    ),
    always(
        "precess-tests",
        "steering",
        &[SOLVER, REFERENCES, ENGINES, &["tests/tests/steering", "tests/fixtures"]],
    ),
    all(
        "precess-tests",
        "lanes",
        &[
            SOLVER,
            LANES,
            REFERENCES,
            &["tests/tests/dynamics", "tests/tests/isolated", "tests/tests/lanes"],
        ],
    ),
    always("precess-tests", "engines", &[SOLVER, REFERENCES, ENGINES, &["tests/tests/engines"]]),
    always("precess-tests", "links", &[PAGES, &["tests/tests/links.rs", "sim/fuzz", "sim/report"]]),
    always(
        "precess-tests",
        "architecture",
        &[
            GENERATOR,
            BAKING,
            SOLVER,
            LANES,
            REFERENCES,
            DESKTOP,
            &["codegen/review", "docs", "tests/tests/architecture", "xtask"],
        ],
    ),
    all(
        "precess-tests",
        "code_size",
        &[SOLVER, OUTSIDE, &["tests/tests/code_size.rs", "tests/fixtures"]],
    ),
    all(
        "precess-tests",
        "no_panic",
        &[SOLVER, OUTSIDE, &["tests/tests/no_panic.rs", "tests/fixtures"]],
    ),
    always("precess-derivatives", "linearize", &[SOLVER, REFERENCES, &["tests/derivatives"]]),
    always("precess-ledger", "ledger_and_loads", &[SOLVER, REFERENCES, &["tests/ledger"]]),
    always("precess-baked", "agreement", &[GENERATOR, SOLVER, REFERENCES, BAKING]),
    always("precess-baked", "operations", &[BAKING]),
    always("four-wheels", "reference", &[BAKING]),
    always("imaging-satellite", "reference", &[BAKING]),
    all_for("precess-attack", "numbers", &[&["tests/attack"]]),
    all_for("precess-attack", "printed", &[SOLVER, LANES, &["tests/attack"]]),
    all_for("precess-attack", "sample", &[SOLVER, LANES, REFERENCES, &["tests/attack"]]),
    // What a sampled controller is made of.
    always("precess-control", "lib", &[SOLVER, &["sim/control"]]),
    always("precess-control", "estimator", &[SOLVER, &["sim/control"]]),
    always("precess-control", "filters", &[ENGINES, &["sim/control"]]),
    always("precess-control", "laws", &[SOLVER, ENGINES, &["sim/control"]]),
    always("precess-control", "references", &[SOLVER, &["sim/control"]]),
    always("precess-control", "sensors", &[SOLVER, &["sim/control"]]),
    always("precess-control", "trackers", &[SOLVER, &["sim/control"]]),
    // Batches on a GPU.
    always("precess-gpu", "lib", &[&["sim/gpu"]]),
    always(
        "precess-gpu",
        "batches",
        &[GENERATOR, SOLVER, BAKING, &["codegen/tests/c_kernels", "sim/gpu"]],
    ),
    // The engine for functional mock-up units.
    always("precess-fmu", "lib", &[SOLVER, DESKTOP, &["sim/fmu"]]),
    // The desktop tool.
    always("precess", "lib", &[SOLVER, DESKTOP, &["sim/report"]]),
    always("precess", "bending", &[SOLVER, DESKTOP, &["sim/tests/bending", "sim/examples"]]),
    always("precess", "campaign", &[SOLVER, DESKTOP, &["sim/tests/campaign", "sim/tests/shared"]]),
    always(
        "precess",
        "command",
        &[SOLVER, DESKTOP, &["sim/tests/command.rs", "sim/tests/shared", "tests/baked"]],
    ),
    always("precess", "control", &[SOLVER, DESKTOP, &["sim/tests/control"]]),
    always("precess", "corpus", &[SOLVER, DESKTOP, &["sim/tests/corpus.rs", "sim/fuzz"]]),
    always("precess", "endless", &[DESKTOP, &["sim/tests/endless.rs"]]),
    always_short("precess", "fit", &[SOLVER, DESKTOP, &["sim/tests/fit"]]),
    always("precess", "fmu", &[GENERATOR, BAKING, SOLVER, DESKTOP, &["sim/tests/fmu"]]),
    always("precess", "health", &[SOLVER, DESKTOP, &["sim/tests/health"]]),
    always_short("precess", "identify", &[SOLVER, DESKTOP, &["sim/tests/identify"]]),
    always(
        "precess",
        "jitter",
        &[SOLVER, DESKTOP, &["sim/tests/jitter", "sim/examples", "docs/imbalance-map.md"]],
    ),
    always("precess", "kill", &[DESKTOP, &["sim/tests/kill.rs", "sim/tests/shared"]]),
    always(
        "precess",
        "known_answers",
        &[SOLVER, DESKTOP, &["sim/tests/known_answers", "sim/tests/known_answers.rs"]],
    ),
    always("precess", "margins", &[SOLVER, DESKTOP, &["sim/tests/margins"]]),
    always("precess", "mutated", &[SOLVER, DESKTOP, &["sim/tests/mutated.rs", "sim/tests/shared"]]),
    always("precess", "picture", &[SOLVER, DESKTOP, &["sim/tests/picture.rs", "docs"]]),
    always("precess", "platforms", &[SOLVER, DESKTOP, &["sim/tests/platforms"]]),
    always(
        "precess",
        "reported",
        &[SOLVER, DESKTOP, &["sim/tests/reported", "docs/commands.md", "docs/scenarios.md"]],
    ),
    always("precess", "scenarios", &[SOLVER, DESKTOP, &["sim/tests/scenarios.rs", "docs"]]),
    always("precess", "schema", &[DESKTOP, &["sim/tests/schema"]]),
    always("precess", "sources", &[SOLVER, DESKTOP, &["sim/tests/sources"]]),
    always("precess", "spectra", &[SOLVER, DESKTOP, &["sim/tests/spectra", "sim/tests/shared"]]),
    always(
        "precess",
        "structure",
        &[SOLVER, DESKTOP, &["sim/tests/structure", "sim/tests/shared", "tests/engines"]],
    ),
    always(
        "precess",
        "table1",
        &[SOLVER, DESKTOP, REFERENCES, &["sim/tests/table1.rs", "codegen/review"]],
    ),
    // The workbench.
    always("xtask", "lib", &[&["xtask/src"]]),
    always("xtask", "bin", &[&["xtask/src", "xtask/features", "Cargo.toml"]]),
    all("precess-distribute", "bin", &[&["xtask/src", "xtask/distribute"]]),
    always("precess-site", "bin", &[&["xtask/src", "xtask/site"]]),
    Suite { how: How::Documentation, when: When::Always, broken_by: &[SOLVER, DESKTOP, GENERATOR] },
    // What is built for others, in build folders of its own; then what waits for cargo in the common one.
    command(
        &["flight", "--check", "--quick"],
        When::All,
        &[SOLVER, BOARD, BAKING, &["xtask/distribute", "docs"]],
    ),
    command(
        &["dependencies"],
        When::All,
        &[&[
            "deny.toml",
            "Cargo.lock",
            "flight/Cargo.lock",
            "flight/firmware/Cargo.lock",
            "python/Cargo.lock",
            "sim/fuzz/Cargo.lock",
        ]],
    ),
    command(&["engines"], When::All, &[ENGINES]),
    command(&["reports"], When::All, &[DESKTOP, &["sim/report", "scenarios"]]),
    command(
        &["python", "--quick"],
        When::All,
        &[SOLVER, LANES, DESKTOP, &["sim/gpu", "sim/lanes", "python", "xtask/distribute"]],
    ),
    command(
        &["site", "--check"],
        When::All,
        &[
            DESKTOP,
            SOLVER,
            &[
                "docs",
                "python/precess",
                "python/notebooks",
                "flight/capi/include",
                "xtask/site",
                "sim/report",
            ],
        ],
    ),
    command(
        &["instructions", "--check", "--quick"],
        When::All,
        &[SOLVER, LANES, &["tests/counts", "docs"]],
    ),
    command(
        &["accuracy", "--check"],
        When::AllFor,
        &[SOLVER, REFERENCES, &["tests/derivatives", "tests/examples", "docs"]],
    ),
];

impl Suite {
    /// As it is called in tables.
    pub(crate) fn name(&self) -> String {
        match self.how {
            How::Target { package, target } => format!("{package} {target}"),
            How::Documentation => DOCUMENTATION.to_owned(),
            How::Command(words) => words.join(" "),
        }
    }

    /// Whether its program is that of a package and target.
    pub(crate) fn is(&self, of: &str, named: &str) -> bool {
        matches!(self.how, How::Target { package, target } if package == of && target == named)
    }

    /// Whether its program is of a package.
    pub(crate) fn is_of(&self, of: &str) -> bool {
        matches!(self.how, How::Target { package, .. } if package == of)
    }

    /// Whether a change of a file or in a folder can break it.
    pub(crate) fn can_break(&self, path: &Path) -> bool {
        let folders = self.broken_by.iter().flat_map(|group| group.iter()).map(Path::new);
        folders.into_iter().any(|folder| path.starts_with(folder) || folder.starts_with(path))
    }
}
