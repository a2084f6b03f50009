//! Desktop tool and wheel installed in a Debian that has nothing else: made by debootstrap, entered by chroot, so as root.
//!
//! What the machine knows of its network goes along, for pip fetches a package: the resolver, certificates, pip's settings.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use super::archive::Package;
use super::first::nth_block;
use super::tool;
use xtask::files::remove_folder;
use xtask::run::{is_there, root, run_there};
use xtask::say;
use xtask::skip::skip;

/// Debian, where it comes from, and what it has beside its base.
const SUITE: &str = "bookworm";
const MIRROR: &str = "http://deb.debian.org/debian";
const INCLUDE: &str = "--include=ca-certificates,python3-venv";

/// What the network needs, where the machine has it.
const NETWORK: [&str; 3] = ["etc/resolv.conf", "etc/ssl/certs/ca-certificates.crt", "etc/pip.conf"];

/// The page whose first program is run.
const PAGE: &str = "docs/python.md";

/// Installs both of the packages that are there, and runs the first example of each.
pub(super) fn examples(packages: &[Package], folder: &Path) -> Result<(), String> {
    if !is_there("debootstrap") {
        return skip("packages in an empty root", "apt-get install debootstrap");
    }
    let place = folder.join("empty-root");
    if !place.join("etc/debian_version").exists() {
        // Whole or not there: one that was interrupted is made anew.
        let partial = folder.join("empty-root.partial");
        remove_folder(&partial)?;
        let mut debootstrap = Command::new("debootstrap");
        debootstrap.args(["--variant=minbase", INCLUDE, SUITE]).arg(&partial).arg(MIRROR);
        run_there(&mut debootstrap)?;
        fs::rename(&partial, &place)
            .map_err(|error| format!("cannot make {}: {error}", place.display()))?;
    }
    for path in NETWORK {
        let from = Path::new("/").join(path);
        if from.exists() {
            copy(&from, &place.join(path))?;
        }
    }
    let work = place.join("work");
    remove_folder(&work)?;
    copy_all(&root().join("scenarios"), &work.join("scenarios"))?;
    for package in packages {
        let name = &package.name;
        let lines = if tool::is_archive(name) {
            "tar xzf PACKAGE --strip-components=1 -C /usr/local && precess new reaction_wheel > bus.toml && \
             precess check bus.toml && precess run bus.toml --out results && \
             precess export fmu bus.toml --step '1 ms' --to bus.fmu"
                .to_owned()
        } else if Path::new(name).extension().is_some_and(|ending| ending == "whl") {
            let page = fs::read_to_string(root().join(PAGE))
                .map_err(|error| format!("cannot read {PAGE}: {error}"))?;
            put(&work.join("first.py"), nth_block(&page, "", "python", 0, PAGE)?.as_bytes())?;
            "python3 -m venv environment && environment/bin/pip install --quiet ./PACKAGE && \
             environment/bin/python first.py"
                .to_owned()
        } else {
            continue;
        };
        put(&work.join(name), &package.bytes)?;
        let begun = Instant::now();
        let lines = format!("cd /work && {}", lines.replace("PACKAGE", name));
        let mut chroot = Command::new("chroot");
        // Nothing of this machine's environment goes along.
        chroot
            .env_clear()
            .env("PATH", "/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin")
            .env("HOME", "/root");
        run_there(chroot.arg(&place).args(["/bin/sh", "-e", "-c", &lines]))?;
        let seconds = begun.elapsed().as_secs_f64();
        say!(
            "{name}: installed in an empty root, its first example has run, {seconds:.1} s together"
        );
    }
    Ok(())
}

fn copy_all(from: &Path, into: &Path) -> Result<(), String> {
    let wrong = |error| format!("cannot read {}: {error}", from.display());
    for entry in fs::read_dir(from).map_err(wrong)? {
        let entry = entry.map_err(wrong)?;
        let (path, into) = (entry.path(), into.join(entry.file_name()));
        if path.is_dir() { copy_all(&path, &into)? } else { copy(&path, &into)? }
    }
    Ok(())
}

fn copy(from: &Path, into: &Path) -> Result<(), String> {
    let bytes =
        fs::read(from).map_err(|error| format!("cannot read {}: {error}", from.display()))?;
    put(into, &bytes)
}

fn put(path: &Path, bytes: &[u8]) -> Result<(), String> {
    let folder = path.parent().unwrap_or(path);
    fs::create_dir_all(folder)
        .and_then(|()| fs::write(path, bytes))
        .map_err(|error| format!("cannot write {}: {error}", path.display()))
}
