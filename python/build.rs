//! Folds functions of the same code into one, where the linker can: every kind of device is compiled for several sets, and
//! a fifth of the module is there twice. LLVM's linker can, which Rust takes on x86-64 Linux.

use std::env;
use std::path::PathBuf;
use std::process::Command;

/// Option of the linker.
const FOLD: &str = "-Wl,--icf=all";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    if linker_folds() == Some(true) {
        println!("cargo::rustc-link-arg-cdylib={FOLD}");
    }
}

/// Whether an empty library links with the option.
fn linker_folds() -> Option<bool> {
    let folder = PathBuf::from(env::var_os("OUT_DIR")?);
    let source = folder.join("empty.rs");
    std::fs::write(&source, "").ok()?;
    let mut compile = Command::new(env::var_os("RUSTC")?);
    compile.args(["--crate-type", "cdylib", "--target"]);
    compile.arg(env::var_os("TARGET")?).arg("-C").arg(format!("link-arg={FOLD}"));
    if let Some(linker) = env::var_os("RUSTC_LINKER") {
        let mut option = std::ffi::OsString::from("linker=");
        option.push(linker);
        compile.arg("-C").arg(option);
    }
    if let Some(flags) = env::var_os("CARGO_ENCODED_RUSTFLAGS") {
        let flags = flags.to_string_lossy().into_owned();
        compile.args(flags.split('\u{1f}').filter(|flag| !flag.is_empty()));
    }
    let output = compile.arg("-o").arg(folder.join("empty.so")).arg(&source).output().ok()?;
    Some(output.status.success())
}
