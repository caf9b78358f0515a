//! How far a long computation is: a bar on a terminal, plain lines elsewhere.

use crate::failure::{is_quiet, say};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tabulator::Progress;

/// A bar on a terminal, a line for each tenth elsewhere: share, slice, rate, time left.
pub(crate) struct Bar {
    bar: Option<ProgressBar>,
    /// Time of a stage in which nothing is told: many are over by then.
    patience: Duration,
    state: Mutex<State>,
}

/// Time after which a line is due where there is no terminal.
const SILENCE: Duration = Duration::from_secs(30);

struct State {
    stage: String,
    total: u64,
    done: u64,
    /// Units that were done when the stage began.
    before: u64,
    begun: bool,
    shown: bool,
    started: Instant,
    told: Instant,
    /// Poisson's ratio where the work is, if it is anywhere.
    slice: Option<f64>,
}

impl Bar {
    pub(crate) fn new() -> Self {
        Self::after(Duration::ZERO)
    }

    /// One that tells of what takes longer than this.
    pub(crate) fn after(patience: Duration) -> Self {
        let shown = std::io::stderr().is_terminal() && !is_quiet();
        let bar = shown.then(|| {
            let style = "{msg:24} [{bar:40}] {percent:>3} %  {per_sec}  {eta} left";
            let style = ProgressStyle::with_template(style)
                .unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::new(0).with_style(style.progress_chars("=> "))
        });
        Self {
            bar,
            patience,
            state: Mutex::new(State::of("", 0)),
        }
    }

    /// Begins a stage of `total` units.
    pub(crate) fn start(&self, stage: &str, total: u64) {
        Progress::total(self, stage, total);
    }

    /// Says how many units of the stage are done; those of the first call were done before.
    pub(crate) fn set(&self, done: u64) {
        let before = {
            let mut state = self.lock();
            if !state.begun {
                state.begun = true;
                (state.done, state.before) = (done, done);
                if let Some(bar) = &self.bar {
                    bar.set_position(done);
                    bar.reset_eta();
                }
            }
            state.done
        };
        Progress::advance(self, done.saturating_sub(before));
    }

    /// Puts the bar of a stage on the terminal.
    fn show(&self, state: &mut State) {
        state.shown = true;
        if let Some(bar) = &self.bar {
            bar.set_message(state.stage.clone());
            bar.set_length(state.total);
            bar.set_position(state.done);
            bar.reset_elapsed();
            bar.reset_eta();
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn finish(&self) {
        if let Some(bar) = self.bar.as_ref().filter(|_| self.lock().shown) {
            bar.finish_and_clear();
        }
    }
}

impl Progress for Bar {
    fn total(&self, stage: &str, total: u64) {
        let mut state = self.lock();
        *state = State::of(stage, total);
        if self.patience.is_zero() {
            self.show(&mut state);
        }
    }

    fn slice(&self, poisson_ratio: f64) {
        let mut state = self.lock();
        state.slice = Some(poisson_ratio);
        if let Some(bar) = &self.bar {
            bar.set_message(format!("{}, nu = {poisson_ratio:.4}", state.stage));
        }
    }

    fn advance(&self, done: u64) {
        let mut state = self.lock();
        let before = state.done;
        state.done += done;
        if state.started.elapsed() < self.patience {
            return;
        }
        if !state.shown {
            self.show(&mut state);
        }
        if let Some(bar) = &self.bar {
            bar.set_position(state.done);
        } else if let Some(line) = state.line(before) {
            say(line);
        }
    }
}

impl State {
    /// The beginning of a stage.
    fn of(stage: &str, total: u64) -> Self {
        Self {
            stage: stage.to_owned(),
            total,
            done: 0,
            before: 0,
            begun: false,
            shown: false,
            started: Instant::now(),
            told: Instant::now(),
            slice: None,
        }
    }

    /// What to say when another tenth is done, or nothing has been said for long.
    fn line(&mut self, before: u64) -> Option<String> {
        let total = self.total.max(1);
        let tenth = |n: u64| 10 * n / total;
        let silent = self.done == before || self.told.elapsed() < SILENCE;
        if tenth(self.done) == tenth(before) && silent {
            return None;
        }
        self.told = Instant::now();
        let rate =
            (self.done - self.before) as f64 / self.started.elapsed().as_secs_f64().max(1e-9);
        let left = total.saturating_sub(self.done) as f64 / rate;
        let slice = self
            .slice
            .map_or_else(String::new, |nu| format!(", nu = {nu:.4}"));
        Some(format!(
            "{} {} %{slice}, {rate:.1} a second, {left:.0} s left",
            self.stage,
            100 * self.done / total
        ))
    }
}
