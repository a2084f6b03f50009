//! The boards: how each is built for, and the emulator that runs it.

use std::path::Path;
use std::process::Command;

use super::build::firmware;

/// An emulated board.
pub(super) struct Board {
    /// What it is called: also the folder it is built in.
    pub(super) name: &'static str,
    /// What the compiler calls it.
    pub(super) triple: &'static str,
    /// Its arithmetic and byte order.
    pub(super) says: &'static str,
    /// The compiler's flags, but for the linker script.
    flags: &'static str,
    script: &'static str,
    emulator: &'static [&'static str],
    /// The programs that are compared with this machine.
    pub(super) programs: &'static [&'static str],
    /// Whether it is among those of `--quick`.
    pub(super) is_quick: bool,
}

const LLD: &str = "-C linker=ld.lld -C linker-flavor=ld.lld";

/// The boards, the one that is measured first.
pub(super) const BOARDS: [Board; 4] = [
    Board {
        name: "cortex-m7",
        triple: "thumbv7em-none-eabihf",
        says: "hardware f64",
        // The frames' sizes, for the bound on the stack.
        flags: "-C target-cpu=cortex-m7 -Z emit-stack-sizes",
        script: "cortex-m.ld",
        // An instruction takes a nanosecond: time counts instructions.
        emulator: &[
            "qemu-system-arm",
            "-M",
            "mps2-an500",
            "-icount",
            "shift=0",
            "-semihosting-config",
            "enable=on,target=native",
        ],
        programs: &["conformance"],
        is_quick: true,
    },
    Board {
        name: "cortex-m4f",
        triple: "thumbv7em-none-eabihf",
        says: "software f64, hardware f32",
        flags: "-C target-cpu=cortex-m4",
        script: "cortex-m.ld",
        emulator: &[
            "qemu-system-arm",
            "-M",
            "mps2-an386",
            "-semihosting-config",
            "enable=on,target=native",
        ],
        programs: &["conformance", "conformance-single"],
        is_quick: false,
    },
    Board {
        name: "riscv64",
        triple: "riscv64gc-unknown-none-elf",
        says: "hardware f64",
        flags: "",
        script: "riscv64.ld",
        emulator: &["qemu-system-riscv64", "-M", "virt", "-bios", "none"],
        programs: &["conformance"],
        is_quick: false,
    },
    Board {
        name: "leon3",
        triple: "sparc-unknown-none-elf",
        says: "SPARC V8, hardware f64, big-endian",
        flags: "-C target-cpu=leon3",
        script: "leon3.ld",
        emulator: &["qemu-system-sparc", "-M", "leon3_generic"],
        programs: &["conformance"],
        is_quick: true,
    },
];

impl Board {
    /// The compiler's flags.
    pub(super) fn flags(&self) -> String {
        let linker = if self.name == "leon3" {
            "-C linker=sparc64-linux-gnu-ld -C linker-flavor=ld -C link-arg=-melf32_sparc"
        } else {
            LLD
        };
        let script = firmware().join("link").join(self.script);
        format!("{linker} -C link-arg=-T{} {}", script.display(), self.flags)
    }

    /// What runs an image there.
    pub(super) fn emulate(&self, image: &Path) -> Command {
        let (program, arguments) = self.emulator.split_first().unwrap_or((&"false", &[]));
        let mut command = Command::new(program);
        command.args(arguments).args(["-nographic", "-kernel"]).arg(image);
        command
    }
}
