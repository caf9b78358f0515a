//! Progress of a long computation: a bar on a terminal, plain lines elsewhere.

use crate::failure::{QUIET, say};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::Ordering;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tabulator::Progress;

/// Progress bar on a terminal; elsewhere a line after each tenth of the work, at least [`PAUSE`] apart: share, slice,
/// rate, time left. It disappears when it is dropped.
pub(crate) struct Bar {
    /// Counts in both cases, is visible on a terminal only.
    bar: ProgressBar,
    on_terminal: bool,
    /// A stage shorter than this prints nothing; many are.
    patience: Duration,
    stage: Mutex<Stage>,
}

/// Shortest and longest time between two lines without a terminal. The shortest keeps the log of a job short.
const PAUSE: Duration = Duration::from_secs(10);
const SILENCE: Duration = Duration::from_secs(30);

/// A stage of the work and its last printed progress.
struct Stage {
    name: String,
    /// Units completed by an earlier run, once this is known.
    before: Option<u64>,
    told: Instant,
    tenth: u64,
    /// Poisson's ratio of the slice in progress, if any.
    slice: Option<f64>,
}

impl Bar {
    pub(crate) fn new() -> Self {
        Self::after(Duration::ZERO)
    }

    /// Progress that appears only if the work takes longer than `patience`.
    pub(crate) fn after(patience: Duration) -> Self {
        let style = "{msg:24} [{bar:40}] {percent:>3} %  {per_sec}  {eta} left";
        let style = ProgressStyle::with_template(style);
        let style = style.unwrap_or_else(|_| ProgressStyle::default_bar());
        Self {
            bar: ProgressBar::hidden().with_style(style.progress_chars("=> ")),
            on_terminal: std::io::stderr().is_terminal() && !QUIET.load(Ordering::Relaxed),
            patience,
            stage: Mutex::new(Stage::of("")),
        }
    }

    /// Sets the number of completed units of the stage; those of the first call come from an earlier run.
    pub(crate) fn set(&self, done: u64) {
        let mut stage = self.lock();
        if stage.before.is_none() {
            (stage.before, stage.tenth) = (Some(done), 10 * done / self.units());
            self.bar.set_position(done);
            self.bar.reset_eta();
        }
        drop(stage);
        Progress::advance(self, done.saturating_sub(self.bar.position()));
    }

    fn lock(&self) -> MutexGuard<'_, Stage> {
        self.stage.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Number of units of the stage.
    fn units(&self) -> u64 {
        self.bar.length().unwrap_or(0).max(1)
    }

    /// Shows the bar if the stage takes long enough; returns whether it does.
    fn is_due(&self) -> bool {
        let due = self.bar.elapsed() >= self.patience;
        if due && self.on_terminal && self.bar.is_hidden() {
            self.bar.set_draw_target(ProgressDrawTarget::stderr());
        }
        due
    }

    /// The next line, due after another tenth of the work or a long silence.
    fn line(&self, stage: &mut Stage, more: u64) -> Option<String> {
        let (done, units) = (self.bar.position(), self.units());
        let (tenth, silence) = (10 * done / units, stage.told.elapsed());
        let is_due = silence >= PAUSE && tenth != stage.tenth || silence >= SILENCE && more > 0;
        if !is_due {
            return None;
        }
        stage.tenth = tenth;
        let new = done - stage.before.unwrap_or(0).min(done);
        let rate = new as f64 / self.bar.elapsed().as_secs_f64().max(1e-9);
        let left = units.saturating_sub(done) as f64 / rate;
        let slice = stage.slice.map(|nu| format!(", nu = {nu:.4}"));
        Some(format!(
            "{} {} %{}, {rate:.1} a second, {left:.0} s left",
            stage.name,
            100 * done / units,
            slice.unwrap_or_default()
        ))
    }
}

impl Progress for Bar {
    fn total(&self, stage: &str, total: u64) {
        let mut now = self.lock();
        *now = Stage::of(stage);
        self.bar.reset();
        self.bar.set_length(total);
        self.bar.set_message(stage.to_owned());
        self.is_due();
    }

    fn slice(&self, poisson_ratio: f64) {
        let mut stage = self.lock();
        stage.slice = Some(poisson_ratio);
        let message = format!("{}, nu = {poisson_ratio:.4}", stage.name);
        self.bar.set_message(message);
    }

    fn advance(&self, done: u64) {
        let mut stage = self.lock();
        self.bar.inc(done);
        let line = self.line(&mut stage, done);
        if self.is_due()
            && !self.on_terminal
            && let Some(line) = line
        {
            stage.told = Instant::now();
            say(line);
        }
    }
}

impl Stage {
    /// Begins a stage.
    fn of(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            before: None,
            told: Instant::now(),
            tenth: 0,
            slice: None,
        }
    }
}
