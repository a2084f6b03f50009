//! This machine: standard output.

use core::fmt::{self, Write};

/// Standard output.
#[derive(Debug)]
pub struct Console;

impl Write for Console {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        std::io::Write::write_all(&mut std::io::stdout(), text.as_bytes()).map_err(|_| fmt::Error)
    }
}
