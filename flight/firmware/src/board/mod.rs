//! The boards: how a program starts, prints and ends on each, in one small file per architecture.
//!
//! All of them are what QEMU emulates; a real board needs its own console and its own linker
//! script.

#[cfg(all(target_os = "none", target_arch = "arm"))]
#[path = "cortex_m.rs"]
mod machine;
#[cfg(all(target_os = "none", target_arch = "sparc"))]
#[path = "leon3.rs"]
mod machine;
#[cfg(all(target_os = "none", target_arch = "riscv64"))]
#[path = "riscv64.rs"]
mod machine;
#[cfg(not(target_os = "none"))]
#[path = "host.rs"]
mod machine;

pub use machine::*;

/// Makes a function the program: `fn(&mut dyn Write, Options) -> Result<(), E>`, `E` with a
/// message.
#[macro_export]
macro_rules! program {
    ($main:path) => {
        /// Where the start-up code of a board calls.
        #[cfg(target_os = "none")]
        // SAFETY: no other symbol of the image has the name; the start-up code calls it once.
        #[unsafe(no_mangle)]
        extern "C" fn rust_main() -> ! {
            use core::fmt::Write;
            let mut console = $crate::board::Console;
            let done = $main(&mut console, $crate::board::Options::none());
            if let Err(stop) = &done {
                let _ = writeln!(console, "stopped: {stop}");
            }
            $crate::board::exit(done.is_ok())
        }

        #[cfg(not(target_os = "none"))]
        fn main() -> std::process::ExitCode {
            let done = $main(&mut $crate::board::Console, $crate::board::Options::of_process());
            match done {
                Ok(()) => std::process::ExitCode::SUCCESS,
                Err(stop) => {
                    eprintln!("stopped: {stop}");
                    std::process::ExitCode::FAILURE
                }
            }
        }
    };
}

/// What a program does beyond its usual run; on a board nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// One number off by one unit in its last place, which a comparison has to find.
    pub nudge: bool,
}

impl Options {
    /// The usual run.
    #[must_use]
    pub const fn none() -> Self {
        Self { nudge: false }
    }

    /// As the command line has it.
    #[cfg(not(target_os = "none"))]
    #[must_use]
    pub fn of_process() -> Self {
        Self { nudge: std::env::args().any(|argument| argument == "--nudge") }
    }
}

/// A panic is printed and ends the program without success.
#[cfg(target_os = "none")]
#[panic_handler]
fn panic(info: &core::panic::PanicInfo<'_>) -> ! {
    use core::fmt::Write;
    // The console shows it; if that fails, the exit status does.
    let _ = writeln!(Console, "{info}");
    exit(false)
}
