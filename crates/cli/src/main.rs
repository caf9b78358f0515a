//! The `hertzlamb` command: `commands` has one file per subcommand but the completions, the other files are what they share.

// From the bottom up: a module uses only those above it.
mod failure;
mod process;
mod threads;
mod progress;
mod arguments;
mod report;
mod commands;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use clap_complete::{Shell, generate};
use commands::{
    chart, demo, export, impact, infer, materials, paper, plot, sweep, table, tabulate,
};
use failure::Failure;
use std::process::ExitCode;
use std::sync::atomic::Ordering;

/// Impact of a body on an elastic half-space: contact force, rebound and waves.
#[derive(Debug, Parser)]
#[command(
    name = "hertzlamb",
    version,
    propagate_version = true,
    after_help = "Exit codes: 0 done; 1 the work failed; 2 bad input or usage; 75 try the same again later; 101 a fault of the program; 130, 143 or 129 stopped by Ctrl-C, by SIGTERM or because the terminal closed.\nWith --json, an error is one JSON object on standard error."
)]
struct Cli {
    /// Only errors on standard error: no progress, no warnings.
    #[arg(short, long, global = true)]
    quiet: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Runs a scene: contact force, rebound, fields at probes.
    Impact(impact::Arguments),
    /// Runs many scenes that differ in some keys and writes them as one table.
    Sweep(sweep::Arguments),
    /// Yield pressure or velocity from a measured rebound, contact time or peak force.
    Infer(infer::Arguments),
    /// Inputs of particle codes, and a table of the rebound against velocity.
    Export(export::Arguments),
    /// Draws the results of impacts, sweeps and tables.
    Plot(plot::Arguments),
    /// A first look: the paper's case, its numbers, and the waves under a ball.
    Demo(demo::Arguments),
    /// Redoes the source paper: every number and Figures 4 to 11 beside ours.
    Paper(paper::Arguments),
    /// Builds a kernel table: once, for every material pair.
    Tabulate(tabulate::Arguments),
    /// Looks at finished tables (info, verify, diff) and joins shards (merge).
    Table(table::Arguments),
    /// Charts speed against accuracy of all methods, and where they fail.
    Chart(chart::Arguments),
    /// Lists and searches the materials library.
    Materials(materials::Arguments),
    /// Writes a completion script for a shell to standard output.
    #[command(
        after_help = "Example:\n  hertzlamb completions bash > ~/.local/share/bash-completion/completions/hertzlamb"
    )]
    Completions {
        /// The shell.
        shell: Shell,
    },
}

fn main() -> ExitCode {
    let json = std::env::args_os().any(|argument| argument == "--json");
    failure::JSON.store(json, Ordering::Relaxed);
    process::end_in_one_sentence();
    process::listen();
    let cli = parsed();
    failure::QUIET.store(cli.quiet, Ordering::Relaxed);
    let done = threads::start().and_then(|()| run(cli.command));
    process::let_signals_end();
    done.map_or_else(Failure::report, |()| ExitCode::SUCCESS)
}

fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Impact(arguments) => impact::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Infer(arguments) => infer::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Plot(arguments) => plot::run(&arguments),
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Paper(arguments) => paper::run(&arguments),
        Command::Tabulate(arguments) => tabulate::run(&arguments),
        Command::Table(arguments) => table::run(&arguments),
        Command::Chart(arguments) => chart::run(&arguments),
        Command::Materials(arguments) => materials::run(&arguments),
        Command::Completions { shell } => completions(shell),
    }
}

/// Writes a completion script.
fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    generate(shell, &mut Cli::command(), "hertzlamb", &mut script);
    failure::print(String::from_utf8_lossy(&script).trim_end())
}

/// The command line; every command has the version, and the name, of the program.
fn parsed() -> Cli {
    let command = Cli::command().mut_subcommands(|command| command.display_name("hertzlamb"));
    let found = command.try_get_matches();
    found
        .and_then(|found| Cli::from_arg_matches(&found))
        .unwrap_or_else(|error| {
            // a new line in an argument would look like a message of its own
            let odd = std::env::args_os().any(|argument| {
                let argument = argument.to_string_lossy();
                argument.chars().any(char::is_control)
            });
            if error.use_stderr() && (odd || failure::JSON.load(Ordering::Relaxed)) {
                let text = error.to_string();
                let sentence = text.split("\n\nUsage").next().unwrap_or(&text);
                let sentence = sentence.trim().trim_start_matches("error: ");
                let sentence = sentence.replace("\n\n  tip: ", "; ");
                Failure::input(sentence).report();
                std::process::exit(2);
            }
            error.exit()
        })
}
