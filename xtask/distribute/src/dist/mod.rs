//! `dist`: what is distributed, built so that its bytes do not depend on where, installed and tried.
//!
//! Sources are those that git tracks. They are laid out in a folder of their own and built there: what is built is
//! what is in the archive of sources. Each package is then installed in an empty place, and its first example is run.

mod archive;
mod build;
mod crates;
mod empty_root;
mod first;
mod library;
mod licences;
mod materials;
mod python;
mod sources;
mod tool;
mod wrapper;

use std::path::{Path, PathBuf};

use clap::Args;
use sha2::{Digest as _, Sha256};

use self::archive::{Entry, Package, pack};
use self::build::Stage;
use crate::crates_of::linked_by;
pub(crate) use wrapper::called;
use xtask::run::target;
use xtask::say;

/// Where packages are written, in the build folder of cargo.
const PACKAGES: &str = "dist";
/// Where they are built.
const BUILD: &str = "dist-build";
/// The file of checksums, in the form of `sha256sum`.
const CHECKSUMS: &str = "SHA256SUMS";

/// Options of `dist`.
#[derive(Args)]
pub(crate) struct Options {
    /// Build a second time, in another folder, and fail unless every byte is the same
    #[arg(long)]
    check: bool,
    /// Only packages whose name contains this: `precess-c-`, `.crate`, `.whl`, `.cdx.json`
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
    /// Install desktop tool and wheel in a Debian without anything else, too (debootstrap, as root)
    #[arg(long)]
    empty_root: bool,
}

impl Options {
    /// Whether a package of one of these names is wanted.
    fn wants(&self, names: &[&str]) -> bool {
        self.only.as_ref().is_none_or(|only| names.iter().any(|name| name.contains(only.as_str())))
    }
}

/// Builds, compares, writes, tries.
pub(crate) fn dist(options: &Options) -> Result<(), String> {
    let sources = sources::tracked()?;
    let folder = target()?.join(BUILD);
    let packages = built(&sources, &folder, options)?;
    if options.check {
        let elsewhere = tempfile::tempdir()
            .map_err(|error| format!("cannot make a temporary folder: {error}"))?;
        let again = built(&sources, &elsewhere.path().join("second build"), options)?;
        same(&packages, &again)?;
        say!("{} packages, built in two folders, have the same bytes", packages.len());
    }
    let into = target()?.join(PACKAGES);
    write(&packages, &into)?;
    first::examples(&packages, &folder)?;
    if options.empty_root { empty_root::examples(&packages, &folder) } else { Ok(()) }
}

/// Every package, built in a folder.
fn built(sources: &[Entry], folder: &Path, options: &Options) -> Result<Vec<Package>, String> {
    let stage = Stage { sources: folder.join("sources"), target: folder.join("target") };
    // What Python builds, it builds beside its sources.
    sources::lay_out(sources, &stage.sources, &[])?;
    let version = library::version(&stage)?;
    let root = format!("precess-{version}-sources");
    let mut packages = Vec::new();
    let archive = format!("{root}.tar.gz");
    if options.wants(&[&archive]) {
        packages.push(Package { name: archive, bytes: pack(&root, sources)? });
    }
    if options.wants(&["precess-dynamics.crate", "precess-codegen.crate"]) {
        packages.extend(crates::packages(&stage)?);
    }
    if options.wants(&["precess-c-.tar.gz"]) {
        packages.push(library::package(&stage)?);
    }
    if options.wants(&[&format!("{}.tar.gz", tool::name(&stage, &version)?)]) {
        packages.push(tool::package(&stage, &version)?);
    }
    if options.wants(&["precess.whl", "precess.tar.gz"]) {
        packages.extend(python::packages(&stage, folder)?);
    }
    if options.wants(&["precess.cdx.json"]) {
        packages.extend(bills(&stage, &version)?);
    }
    Ok(packages)
}

/// The bills of materials, one for each package that links crates of others.
fn bills(stage: &Stage, version: &str) -> Result<Vec<Package>, String> {
    let of = |manifest: &'static str, packages: &[(&'static str, &'static str)]| {
        let metadata = licences::metadata(stage, manifest)?;
        let bill = |(package, name): &(&str, &str)| {
            let lines = linked_by(stage.cargo()?, manifest, package, &licences::host(stage)?)?;
            materials::bill(&metadata, (package, &lines), &format!("{name}-{version}"))
        };
        packages.iter().map(bill).collect::<Result<Vec<_>, String>>()
    };
    let crates = ["precess-dynamics", "precess-codegen", tool::PACKAGE, tool::GENERATOR];
    let crates = crates.map(|name| (name, name));
    let mut bills = of(tool::MANIFEST, &crates)?;
    bills.extend(of(xtask::capi::MANIFEST, &[("precess-capi", "precess-c")])?);
    bills.extend(of(python::MANIFEST, &[("precess-python", "precess-python")])?);
    Ok(bills)
}

/// The names and bytes of both builds are the same.
fn same(first: &[Package], second: &[Package]) -> Result<(), String> {
    let sums = |packages: &[Package]| packages.iter().map(line).collect::<Vec<_>>();
    let (first, second) = (sums(first), sums(second));
    if first == second {
        return Ok(());
    }
    let pairs = first.iter().zip(&second).filter(|(a, b)| a != b);
    let differ: Vec<_> = pairs.map(|(a, b)| format!("{a}\n{b}")).collect();
    Err(format!(
        "{} and {} packages, built in two folders, differ:\n{}",
        first.len(),
        second.len(),
        differ.join("\n")
    ))
}

/// Writes packages and checksums; what is there of an earlier version is removed.
fn write(packages: &[Package], into: &Path) -> Result<(), String> {
    let mut entries: Vec<_> =
        packages.iter().map(|one| Entry::file(&one.name, one.bytes.clone())).collect();
    let sums: String = packages.iter().map(|one| line(one) + "\n").collect();
    entries.push(Entry::file(CHECKSUMS, sums));
    sources::lay_out(&entries, into, &[])?;
    for package in packages {
        let path: PathBuf = into.join(&package.name);
        say!("{:>9} bytes  {}", package.bytes.len(), path.display());
    }
    Ok(())
}

/// Checksum and name, as `sha256sum --check` reads them.
fn line(package: &Package) -> String {
    let sum = Sha256::digest(&package.bytes);
    let sum: Vec<String> = sum.iter().map(|byte| format!("{byte:02x}")).collect();
    let sum = sum.concat();
    format!("{sum}  {}", package.name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn package(bytes: &str) -> Package {
        Package { name: "a".to_owned(), bytes: bytes.into() }
    }

    #[test]
    fn a_checksum_is_that_of_the_standard() {
        // FIPS 180-2, B.1.
        let sum = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(line(&package("abc")), format!("{sum}  a"));
    }

    #[test]
    fn builds_that_differ_are_named() {
        assert!(same(&[package("x")], &[package("x")]).is_ok());
        assert!(same(&[package("x")], &[package("y")]).is_err());
        assert!(same(&[package("x")], &[]).is_err());
    }
}
