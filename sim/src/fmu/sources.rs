//! The C files that are the same in every unit of a version: its face over the instance, the instance over the emitted solver or
//! over the simulator's engine, and the standard's headers.

use super::FmiVersion;

type File = (&'static str, &'static str);

/// Names and texts of what all units have.
const SHARED: [File; 6] = [
    ("precess_fmu.h", include_str!("c/precess_fmu.h")),
    ("precess_instance.c", include_str!("c/precess_instance.c")),
    ("precess_instance.h", include_str!("c/precess_instance.h")),
    ("precess_instance_jvp.c", include_str!("c/precess_instance_jvp.c")),
    ("precess_instance_motion.c", include_str!("c/precess_instance_motion.c")),
    ("precess_instance_state.c", include_str!("c/precess_instance_state.c")),
];
/// The instance over the emitted solver.
const SOLVER: [File; 6] = [
    ("precess_fmu.c", include_str!("c/solver/precess_fmu.c")),
    ("precess_fmu_data.h", include_str!("c/solver/precess_fmu_data.h")),
    ("precess_fmu_jvp.c", include_str!("c/solver/precess_fmu_jvp.c")),
    ("precess_fmu_message.c", include_str!("c/solver/precess_fmu_message.c")),
    ("precess_fmu_solver.c", include_str!("c/solver/precess_fmu_solver.c")),
    ("precess_fmu_solver.h", include_str!("c/solver/precess_fmu_solver.h")),
];
/// That over the engine.
const ENGINE: [File; 3] = [
    ("precess_engine.h", include_str!("c/engine/precess_engine.h")),
    ("precess_fmu.c", include_str!("c/engine/precess_fmu.c")),
    ("precess_fmu_data.h", include_str!("c/engine/precess_fmu_data.h")),
];
const FMI2: [File; 4] = [
    ("precess_fmi2.c", include_str!("c/precess_fmi2.c")),
    ("precess_fmi2.h", include_str!("c/precess_fmi2.h")),
    ("precess_fmi2_co_simulation.c", include_str!("c/precess_fmi2_co_simulation.c")),
    ("precess_fmi2_model_exchange.c", include_str!("c/precess_fmi2_model_exchange.c")),
];
const FMI3: [File; 5] = [
    ("precess_fmi3.c", include_str!("c/precess_fmi3.c")),
    ("precess_fmi3.h", include_str!("c/precess_fmi3.h")),
    ("precess_fmi3_absent.c", include_str!("c/precess_fmi3_absent.c")),
    ("precess_fmi3_co_simulation.c", include_str!("c/precess_fmi3_co_simulation.c")),
    ("precess_fmi3_model_exchange.c", include_str!("c/precess_fmi3_model_exchange.c")),
];

/// The three headers of a version. They are the Modelica Association's, under the 2-clause BSD licence that each contains.
const HEADERS2: [File; 3] = [
    ("fmi2FunctionTypes.h", include_str!("c/fmi2FunctionTypes.h")),
    ("fmi2Functions.h", include_str!("c/fmi2Functions.h")),
    ("fmi2TypesPlatform.h", include_str!("c/fmi2TypesPlatform.h")),
];
const HEADERS3: [File; 3] = [
    ("fmi3FunctionTypes.h", include_str!("c/fmi3FunctionTypes.h")),
    ("fmi3Functions.h", include_str!("c/fmi3Functions.h")),
    ("fmi3PlatformTypes.h", include_str!("c/fmi3PlatformTypes.h")),
];

/// All that are in a unit of a version. FMI 3.0 leaves its headers to the importer.
pub(super) fn all(version: FmiVersion) -> Vec<(String, String)> {
    let own: [&[File]; 2] = match version {
        FmiVersion::Two => [&FMI2, &HEADERS2],
        FmiVersion::Three => [&FMI3, &[]],
    };
    texts(SHARED.iter().chain(&SOLVER).chain(own.into_iter().flatten()))
}

/// All of a version that are linked with the simulator's engine, the standard's headers among them.
pub(super) fn of_engine(version: FmiVersion) -> Vec<(String, String)> {
    let (own, headers): (&[File], &[File]) = match version {
        FmiVersion::Two => (&FMI2, &HEADERS2),
        FmiVersion::Three => (&FMI3, &HEADERS3),
    };
    texts(SHARED.iter().chain(&ENGINE).chain(own).chain(headers))
}

/// The headers that a compiler needs beside a unit of a version, by their names: those of the standard, of FMI 3.0.
#[must_use]
pub fn headers(version: FmiVersion) -> Vec<(String, String)> {
    match version {
        FmiVersion::Two => Vec::new(),
        FmiVersion::Three => texts(HEADERS3.iter()),
    }
}

fn texts<'a>(files: impl Iterator<Item = &'a File>) -> Vec<(String, String)> {
    files.map(|(path, text)| ((*path).to_owned(), (*text).to_owned())).collect()
}

/// Whether a file of the solver belongs to the sources.
pub(super) fn is_source(path: &str) -> bool {
    is_compiled(path) || has_ending(path, "h")
}

/// Whether a file is compiled by itself.
pub(super) fn is_compiled(path: &str) -> bool {
    has_ending(path, "c")
}

fn has_ending(path: &str, ending: &str) -> bool {
    std::path::Path::new(path).extension().is_some_and(|found| found == ending)
}
