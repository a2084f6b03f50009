//! The desktop tool as it is installed: program, pages of `man`, completions, licences.

use std::fs;
use std::path::Path;
use std::process::Command;

use super::archive::{Content, Entry, Package, pack};
use super::build::Stage;
use super::licences;
use super::sources::entry;
use xtask::run::{output, run_there};

/// Its package, which is also its program.
pub(super) const PACKAGE: &str = "precess";
/// What derives for its commands `bake` and `export fmu`, which look for it beside them.
pub(super) const GENERATOR: &str = "precess-bake";
/// The engine for units of `export fmu --binary`, a static library, which it looks for in `../lib`.
const ENGINE: &str = "precess-fmu";
const ENGINE_FILE: &str = "libprecess_fmu.a";
/// How it is compiled: a copy is in each unit.
const ENGINE_PROFILE: &str = "unit";
/// The workspace that they are of.
pub(super) const MANIFEST: &str = "Cargo.toml";

/// Where each shell looks for what it completes.
const COMPLETIONS: [(&str, &str); 3] = [
    ("bash", "share/bash-completion/completions/precess"),
    ("fish", "share/fish/vendor_completions.d/precess.fish"),
    ("zsh", "share/zsh/site-functions/_precess"),
];

/// The archive. Its name has the machine in it, as `cargo binstall` wants it.
pub(super) fn package(stage: &Stage, version: &str) -> Result<Package, String> {
    run_there(stage.cargo()?.args(["fetch", "--locked"]))?;
    let mut cargo = stage.cargo()?;
    cargo.args(["build", "--release", "--quiet", "--locked"]);
    let programs = [PACKAGE, GENERATOR];
    cargo.args(programs.iter().flat_map(|name| ["--package", name, "--bin", name]));
    run_there(&mut cargo)?;
    let release = stage.target.join("release");
    let file = |name: &str| format!("{name}{}", std::env::consts::EXE_SUFFIX);
    let program = release.join(file(PACKAGE));
    let (mut entries, mut others) = (Vec::new(), String::new());
    for name in programs {
        let content = Content::File { bytes: read(&release.join(file(name)))?, executable: true };
        entries.push(Entry { path: format!("bin/{}", file(name)), content });
        others.push_str(&licences::of_others(stage, MANIFEST, name)?);
    }
    if std::env::consts::OS == "linux" {
        let mut cargo = stage.cargo()?;
        cargo.args(["build", "--profile", ENGINE_PROFILE, "--quiet", "--locked"]);
        run_there(cargo.args(["--package", ENGINE]))?;
        let file = stage.target.join(ENGINE_PROFILE).join(ENGINE_FILE);
        let content = Content::File { bytes: read(&file)?, executable: false };
        entries.push(Entry { path: format!("lib/{ENGINE_FILE}"), content });
    }
    entries.push(Entry::file("share/doc/precess/LICENSES-OF-OTHERS", others));
    for name in ["LICENSE-APACHE", "LICENSE-MIT", "README.md"] {
        let mut text = entry(&stage.sources, name)?;
        text.path = format!("share/doc/precess/{name}");
        entries.push(text);
    }
    for (shell, path) in COMPLETIONS {
        entries
            .push(Entry::file(path, output(Command::new(&program).args(["completions", shell]))?));
    }
    let pages =
        tempfile::tempdir().map_err(|error| format!("cannot make a temporary folder: {error}"))?;
    output(Command::new(&program).args(["manual", "--force", "--out"]).arg(pages.path()))?;
    let wrong = |error| format!("cannot read {}: {error}", pages.path().display());
    for page in fs::read_dir(pages.path()).map_err(wrong)? {
        let page = page.map_err(wrong)?;
        let name = page.file_name().to_string_lossy().into_owned();
        entries.push(Entry::file(format!("share/man/man1/{name}"), read(&page.path())?));
    }
    let root = name(stage, version)?;
    Ok(Package { name: format!("{root}.tar.gz"), bytes: pack(&root, &entries)? })
}

/// The name of the archive without its ending, and of its folder.
pub(super) fn name(stage: &Stage, version: &str) -> Result<String, String> {
    Ok(named(version, &licences::host(stage)?))
}

fn named(version: &str, target: &str) -> String {
    format!("{PACKAGE}-{version}-{target}")
}

/// Whether a package is that archive: a version, and a machine behind it.
pub(super) fn is_archive(name: &str) -> bool {
    let rest = name.strip_prefix("precess-").and_then(|rest| rest.strip_suffix(".tar.gz"));
    rest.is_some_and(|rest| {
        rest.starts_with(|c: char| c.is_ascii_digit())
            && rest.contains('-')
            && !rest.ends_with("-sources")
    })
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_archive_is_the_one_that_binstall_fetches() {
        let manifest = fs::read_to_string(xtask::run::root().join("sim/Cargo.toml")).unwrap();
        let manifest: toml::Table = toml::from_str(&manifest).unwrap();
        let binstall = &manifest["package"]["metadata"]["binstall"];
        let filled = |key: &str| {
            let text = binstall[key].as_str().unwrap();
            text.replace("{ version }", "1.2.3")
                .replace("{ target }", "t")
                .replace("{ bin }", PACKAGE)
        };
        let name = named("1.2.3", "t");
        assert!(
            filled("pkg-url").ends_with(&format!("/v1.2.3/{name}.tar.gz")),
            "{}",
            filled("pkg-url")
        );
        assert!(is_archive(&format!("{name}.tar.gz")) && !is_archive("precess-1.2.3.tar.gz"));
        assert!(
            !is_archive("precess-1.2.3-sources.tar.gz") && !is_archive("precess-c-1.2.3-t.tar.gz")
        );
        assert_eq!(filled("bin-dir"), format!("{name}/bin/precess{{ binary-ext }}"));
    }
}
