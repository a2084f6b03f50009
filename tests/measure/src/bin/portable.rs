//! The service of a solver built without the feature `lanes`: no registers chosen at run time.

fn main() -> std::process::ExitCode {
    precess_measure::run()
}
