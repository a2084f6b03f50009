//! The C library as it is installed: libraries, header, pkg-config, `CMake`, licences, the guide.

use std::fs;
use std::path::Path;

use super::archive::{Entry, Package, pack};
use super::build::Stage;
use super::licences;
use super::sources::entry;
use xtask::capi::{GUIDE, HEADERS, MANIFEST};
use xtask::run::{output, run_there};

/// Files of `pkg-config` and `CMake`, with `@VERSION@` and `@SONAME@` to be filled in.
const FILES: [(&str, &str); 4] = [
    ("lib/pkgconfig/precess.pc", include_str!("library/precess.pc")),
    ("lib/pkgconfig/precess-shared.pc", include_str!("library/precess-shared.pc")),
    ("lib/cmake/Precess/PrecessConfig.cmake", include_str!("library/PrecessConfig.cmake")),
    (
        "lib/cmake/Precess/PrecessConfigVersion.cmake",
        include_str!("library/PrecessConfigVersion.cmake"),
    ),
];

/// The archive. Its name has the machine in it.
pub(super) fn package(stage: &Stage) -> Result<Package, String> {
    let manifest = ["--locked", "--manifest-path", MANIFEST];
    // What `registries` lists is there only after this.
    run_there(stage.cargo()?.arg("fetch").args(manifest))?;
    let version = version(stage)?;
    // Before 1.0, a minor release may change what is exported.
    let interface = version.rsplit_once('.').map_or(version.as_str(), |(first, _)| first);
    let soname = format!("libprecess.so.{interface}");
    let mut command = stage.cargo()?;
    command.args(["rustc", "--release", "--quiet", "--package", "precess-capi"]).args(manifest);
    if cfg!(target_os = "linux") {
        // Of the shared library only.
        command.args(["--", &format!("-Clink-arg=-Wl,-soname,{soname}")]);
    }
    run_there(&mut command)?;
    let release = stage.target.join("release");
    let mut entries = vec![
        Entry::file("lib/libprecess.a", read(&release.join("libprecess.a"))?),
        Entry::file(format!("lib/{soname}"), read(&release.join("libprecess.so"))?),
        Entry::link("lib/libprecess.so", &soname),
        Entry::file("share/doc/precess/README.md", read(&stage.sources.join(GUIDE))?),
        Entry::file(
            "share/doc/precess/LICENSES-OF-OTHERS",
            licences::of_others(stage, MANIFEST, "precess-capi")?,
        ),
    ];
    for header in HEADERS {
        let (_, name) = header.rsplit_once('/').ok_or("a header without a folder")?;
        entries.push(Entry::file(format!("include/{name}"), read(&stage.sources.join(header))?));
    }
    for name in ["LICENSE-APACHE", "LICENSE-MIT"] {
        let mut licence = entry(&stage.sources, name)?;
        licence.path = format!("share/doc/precess/{name}");
        entries.push(licence);
    }
    let filled = |text: &str| text.replace("@VERSION@", &version).replace("@SONAME@", &soname);
    entries.extend(FILES.map(|(path, text)| Entry::file(path, filled(text))));
    let root = format!("precess-c-{version}-{}", licences::host(stage)?);
    Ok(Package { name: format!("{root}.tar.gz"), bytes: pack(&root, &entries)? })
}

/// The version of the library: that of its package.
pub(super) fn version(stage: &Stage) -> Result<String, String> {
    let mut command = stage.cargo()?;
    command.args(["pkgid", "--manifest-path", MANIFEST, "--package", "precess-capi"]);
    let id = output(&mut command)?;
    let version = id.trim().rsplit(['#', '@']).next().unwrap_or_default();
    Ok(version.to_owned())
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    fs::read(path).map_err(|error| format!("cannot read {}: {error}", path.display()))
}
