//! What a shell and `man` know of the command line: `completions` and `manual`, made from its declaration.

use std::path::PathBuf;

use clap::Args;
use clap_complete::Shell;

use super::error::CommandError;
use super::exit::Exit;
use super::outputs::Outputs;
use super::terminal::print;

/// The help of both commands.
pub(super) const COMPLETIONS_HELP: &str =
    "Example:\n  precess completions bash > ~/.local/share/bash-completion/completions/precess";
pub(super) const MANUAL_HELP: &str =
    "Examples:\n  precess manual --out ~/.local/share/man/man1\n  precess manual | man -l -";

/// The options of `completions`.
#[derive(Debug, Args)]
pub(super) struct Completions {
    /// The shell.
    shell: Shell,
}

impl Completions {
    pub(super) fn execute(&self, mut command: clap::Command) -> Result<Exit, CommandError> {
        let (name, mut script) = (command.get_name().to_owned(), Vec::new());
        clap_complete::generate(self.shell, &mut command, name, &mut script);
        print(&String::from_utf8_lossy(&script))?;
        Ok(Exit::Success)
    }
}

/// The options of `manual`.
#[derive(Debug, Args)]
pub(super) struct Manual {
    /// Write the pages of all commands into this folder, which is made if it is missing; without it the first page is
    /// printed.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// Replace files that are there.
    #[arg(long)]
    force: bool,
}

impl Manual {
    pub(super) fn execute(&self, command: clap::Command) -> Result<Exit, CommandError> {
        let mut pages = Vec::new();
        add_pages(command, "", &mut pages).map_err(CommandError::Output)?;
        let Some(folder) = &self.out else {
            if let Some((_, first)) = pages.first() {
                print(first)?;
            }
            return Ok(Exit::Success);
        };
        let names: Vec<_> = pages.iter().map(|(name, _)| name.clone()).collect();
        let mut outputs = Outputs::reserve(folder, &names, self.force)?;
        for path in outputs.write(&pages)? {
            print(&format!("{}\n", path.display()))?;
        }
        Ok(Exit::Success)
    }
}

/// The page of a command and those of its commands, each named as `git` names its own: `precess-run.1`.
fn add_pages(
    command: clap::Command,
    before: &str,
    pages: &mut Vec<(String, String)>,
) -> std::io::Result<()> {
    let name = format!("{before}{}", command.get_name());
    let mut page = Vec::new();
    let commands: Vec<_> = command.get_subcommands().cloned().collect();
    let title = command.display_name(&name);
    clap_mangen::Man::new(title.disable_help_subcommand(true)).render(&mut page)?;
    pages.push((format!("{name}.1"), String::from_utf8_lossy(&page).into_owned()));
    for command in commands.into_iter().filter(|command| command.get_name() != "help") {
        let bin = format!("{} {}", name.replace('-', " "), command.get_name());
        add_pages(command.bin_name(bin), &format!("{name}-"), pages)?;
    }
    Ok(())
}
