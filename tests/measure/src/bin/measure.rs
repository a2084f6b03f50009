//! The services of a solver built with the feature `lanes`.

fn main() -> std::process::ExitCode {
    precess_measure::run()
}
