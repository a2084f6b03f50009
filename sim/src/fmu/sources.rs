//! The C files that are the same in every unit: the faces of FMI 2.0 over the emitted solver, and the standard's headers.

/// Names and texts. The three headers of the standard are the Modelica Association's, under the 2-clause BSD licence
/// that each of them contains.
const FILES: [(&str, &str); 13] = [
    ("fmi2FunctionTypes.h", include_str!("c/fmi2FunctionTypes.h")),
    ("fmi2Functions.h", include_str!("c/fmi2Functions.h")),
    ("fmi2TypesPlatform.h", include_str!("c/fmi2TypesPlatform.h")),
    ("precess_fmi2.c", include_str!("c/precess_fmi2.c")),
    ("precess_fmi2.h", include_str!("c/precess_fmi2.h")),
    ("precess_fmi2_co_simulation.c", include_str!("c/precess_fmi2_co_simulation.c")),
    ("precess_fmi2_model_exchange.c", include_str!("c/precess_fmi2_model_exchange.c")),
    ("precess_fmu.c", include_str!("c/precess_fmu.c")),
    ("precess_fmu.h", include_str!("c/precess_fmu.h")),
    ("precess_instance.c", include_str!("c/precess_instance.c")),
    ("precess_instance.h", include_str!("c/precess_instance.h")),
    ("precess_instance_motion.c", include_str!("c/precess_instance_motion.c")),
    ("precess_instance_state.c", include_str!("c/precess_instance_state.c")),
];

/// All of them.
pub(super) fn all() -> impl Iterator<Item = (String, String)> {
    FILES.into_iter().map(|(path, text)| (path.to_owned(), text.to_owned()))
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
