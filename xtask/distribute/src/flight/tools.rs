//! The programs that `flight` needs: Debian's compiler with its sources, linkers, emulators.

use std::path::Path;
use std::process::Command;

/// Debian's compiler: the only one whose sources of `core` a package brings. Never the one on the
/// path, which may be rustup's and has no such sources.
pub(super) const RUSTC: &str = "/usr/bin/rustc";

/// The cargo that goes with it.
pub(super) const CARGO: &str = "/usr/bin/cargo";

/// Each program (or file) with the package that has it.
const NEEDED: [(&str, &str); 8] = [
    (RUSTC, "rustc-web"),
    (CARGO, "cargo-web"),
    ("/usr/lib/rustlib/src/rust/library/core/src/lib.rs", "rust-web-src"),
    ("/usr/bin/ld.lld", "lld"),
    ("/usr/bin/sparc64-linux-gnu-ld", "binutils-sparc64-linux-gnu"),
    ("/usr/bin/qemu-system-arm", "qemu-system-arm"),
    ("/usr/bin/qemu-system-riscv64", "qemu-system-misc"),
    ("/usr/bin/qemu-system-sparc", "qemu-system-sparc"),
];

/// The command that installs what is missing; none where nothing is.
pub(super) fn missing() -> Option<String> {
    let packages: Vec<&str> = NEEDED
        .into_iter()
        .filter(|(file, _)| !Path::new(file).exists())
        .map(|(_, package)| package)
        .collect();
    let install = "apt-get install --no-install-recommends";
    (!packages.is_empty()).then(|| format!("{install} {}", packages.join(" ")))
}

/// Release of the compiler for boards: `rustc 1.96.0`.
pub(super) fn compiler() -> Result<String, String> {
    let output = Command::new(RUSTC).arg("--version").output();
    let output = output.map_err(|error| format!("{RUSTC} did not start: {error}"))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let words: Vec<&str> = text.split_whitespace().take(2).collect();
    match words.as_slice() {
        [name, release] => Ok(format!("{name} {release}")),
        _ => Err(format!("`{RUSTC} --version` names no release: {text}")),
    }
}
