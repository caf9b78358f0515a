//! `hertzlamb completions`: scripts for shells.

use crate::failure::Failure;
use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  hertzlamb completions bash > ~/.local/share/bash-completion/completions/hertzlamb"
)]
pub(crate) struct Arguments {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
}

pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let mut script = Vec::new();
    generate(
        arguments.shell,
        &mut crate::Cli::command(),
        "hertzlamb",
        &mut script,
    );
    crate::failure::print(String::from_utf8_lossy(&script).trim_end())
}
