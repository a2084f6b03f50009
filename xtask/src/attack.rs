//! `attack`: random spacecraft against the promises of docs/promises.md.

use clap::Args;

use xtask::run::cargo;

/// Options of `attack`; what is not said here is left to the campaign.
#[derive(Args)]
pub(crate) struct Options {
    /// For how long new cases are drawn
    #[arg(long, default_value_t = 1.0)]
    minutes: f64,
    /// The campaign: the same seed continues where it ended; a new one without this option
    #[arg(long)]
    seed: Option<u64>,
    /// One property, by its name
    #[arg(long)]
    property: Option<String>,
    /// One chunk of that property and seed, once more
    #[arg(long, requires = "seed", requires = "property")]
    chunk: Option<u64>,
    /// Say each property in a sentence, and end
    #[arg(long)]
    list: bool,
}

/// Runs the campaign in the profile of the tests: its assertions are on, and what
/// `cargo xtask test` has compiled is not compiled again.
pub(crate) fn attack(options: &Options) -> Result<(), String> {
    let Options { minutes, seed, property, chunk, list } = options;
    let mut arguments: Vec<String> =
        ["run", "--quiet", "--profile", "test", "-p", "precess-attack", "--bin", "attack", "--"]
            .map(str::to_owned)
            .to_vec();
    arguments.extend(["--minutes".to_owned(), minutes.to_string()]);
    let numbers = [("--seed", seed), ("--chunk", chunk)];
    for (name, number) in numbers {
        arguments.extend(number.iter().flat_map(|n| [name.to_owned(), n.to_string()]));
    }
    arguments.extend(property.iter().flat_map(|name| ["--property".to_owned(), name.clone()]));
    arguments.extend(list.then(|| "--list".to_owned()));
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    cargo(&arguments)
}
