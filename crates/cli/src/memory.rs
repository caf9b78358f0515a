//! How much memory a command may take.

use crate::failure::Failure;
use clap::Args;
use std::alloc::{GlobalAlloc, Layout, System};

/// One flag, the same in every command that can take much.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct MemoryLimit {
    /// Memory that the work may take in GB; what the machine has free otherwise.
    #[arg(long, value_name = "GB", value_parser = gigabytes)]
    max_memory: Option<f64>,
}

impl MemoryLimit {
    /// The limit in bytes.
    pub(crate) fn bytes(self) -> f64 {
        self.max_memory
            .map_or_else(output::free_memory, |gigabytes| 1e9 * gigabytes)
    }

    /// Refuses work that takes more.
    pub(crate) fn check(self, needed: f64, what: &str, change: &str) -> Result<(), Failure> {
        let limit = self.bytes();
        if needed <= limit {
            return Ok(());
        }
        Err(Failure::input(format!(
            "{what} needs about {:.3} GB of memory, more than the {:.3} GB allowed: {change}, or give --max-memory GB",
            1e-9 * needed,
            1e-9 * limit
        )))
    }
}

fn gigabytes(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        Ok(_) | Err(_) => Err("it is outside (0, inf)".to_owned()),
    }
}

/// The system's allocator; where it has nothing more, the program ends in a sentence.
struct OrSentence;

#[global_allocator]
static ALLOCATOR: OrSentence = OrSentence;

/// What was given, or the end of the program.
fn given(memory: *mut u8, bytes: usize) -> *mut u8 {
    if memory.is_null() {
        use std::io::Write;
        let _ = writeln!(
            std::io::stderr(),
            "error: there is no memory left, of which {bytes} bytes are needed: ask for less, or allow more"
        );
        // whatever was half-done stays, and is removed by the next run: nothing can be done without memory
        signal_hook::low_level::exit(1);
    }
    memory
}

// SAFETY: all of it is done by the system's allocator, as it was asked for.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for OrSentence {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        given(unsafe { System.alloc(layout) }, layout.size())
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        given(unsafe { System.alloc_zeroed(layout) }, layout.size())
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, bytes: usize) -> *mut u8 {
        given(unsafe { System.realloc(memory, layout, bytes) }, bytes)
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }
}
