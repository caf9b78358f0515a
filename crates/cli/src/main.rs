//! The `hertzlamb` command. `commands` has one file per subcommand except `completions`; the other files are shared
//! helpers.

// From the bottom up: a module uses only those above it.
mod failure;
mod process;
mod threads;
mod progress;
mod arguments;
mod report;
mod commands;

use clap::error::ErrorKind;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use clap_complete::{Shell, generate};
use commands::{
    chart, compare, demo, export, impact, infer, lamb, materials, noise, paper, plot, sweep, table,
    tabulate,
};
use failure::Failure;
use std::process::ExitCode;
use std::sync::atomic::Ordering;

/// Computes the impact of a body on an elastic half-space: contact force, rebound and waves.
#[derive(Debug, Parser)]
#[command(
    name = "hertzlamb",
    version,
    propagate_version = true,
    after_help = "Exit codes: 0 done; 1 the work failed; 2 bad input or usage; 75 temporary failure, retry later; 101 internal error, please report; 130, 143 or 129 stopped by Ctrl-C, by SIGTERM or because the terminal closed.\nWith --json, commands that accept it print an error as one JSON object on standard error."
)]
struct Cli {
    /// Print only errors on standard error: no progress, no warnings.
    #[arg(short, long, global = true)]
    quiet: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Computes one scene: contact force, rebound, fields at probes.
    Impact(impact::Arguments),
    /// Computes many scenes that differ in some keys and writes the results as one table.
    Sweep(sweep::Arguments),
    /// Infers the yield pressure or the velocity from a measured rebound, contact time or peak force, or the force from traces of sensors.
    Infer(infer::Arguments),
    /// Computes exact histories of Lamb's problem, for the tests of wave codes.
    Lamb(lamb::Arguments),
    /// Compares histories of another code with a reference.
    Compare(compare::Arguments),
    /// Computes the ground motion of many impacts: spectra and traces at receivers.
    Noise(noise::Arguments),
    /// Writes inputs for particle codes, or a table of the rebound over velocity.
    Export(export::Arguments),
    /// Draws the results of impacts, sweeps and tables.
    Plot(plot::Arguments),
    /// Shows a first example: the paper's case, its numbers, and the waves under a ball.
    Demo(demo::Arguments),
    /// Recomputes the source paper: compares all its numbers and Figures 4 to 11 with this program's.
    Paper(paper::Arguments),
    /// Builds a kernel table, which serves all pairs of materials.
    Tabulate(tabulate::Arguments),
    /// Inspects finished kernel tables (info, verify, diff) and joins shards (merge).
    Table(table::Arguments),
    /// Compares the speed and accuracy of all methods and maps where they fail.
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
        Command::Lamb(arguments) => lamb::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Noise(arguments) => noise::run(&arguments),
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

/// Parses the command line. Every subcommand shows the version and the name of the program.
fn parsed() -> Cli {
    let command = Cli::command().mut_subcommands(|command| command.display_name("hertzlamb"));
    let found = command.try_get_matches();
    found
        .and_then(|found| Cli::from_arg_matches(&found))
        .unwrap_or_else(|error| {
            let help = error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
            if help || !error.use_stderr() {
                error.exit();
            }
            Failure::input(usage_sentence(&error.to_string())).report();
            std::process::exit(2);
        })
}

/// A usage error in one sentence, without the lines on usage and help; its first tip follows a semicolon.
fn usage_sentence(text: &str) -> String {
    let end = ["\n\nUsage", "\n\nFor more"].map(|end| text.find(end).unwrap_or(text.len()));
    let sentence = text[..end[0].min(end[1])].trim();
    let sentence = sentence.trim_start_matches("error: ");
    let sentence = sentence.replace("\n\n  tip: ", "; ").replace("\n  ", " ");
    format!("{sentence}; --help lists the options")
}
