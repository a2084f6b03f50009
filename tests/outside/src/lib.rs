//! Builds crates outside the workspace, which use Precess as others do: a kind of one's own, a library without panics.
//!
//! Versions of dependencies are the workspace's, and so is the build folder: what has the same profile there, nalgebra
//! above all, is compiled once.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// How a crate is optimised.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Profile {
    /// As the workspace for development, but for the crate itself.
    Development {
        /// Of the crate.
        opt_level: u8,
    },
    /// What is linked is what flight code would link. Dependencies are generic and compiled with the crate: left
    /// without optimisation, they build in half the time.
    Release,
}

/// A crate in a folder of its own, in the folder for temporary files of a suite.
#[derive(Clone, Copy, Debug)]
pub struct Outside<'a> {
    /// Name of the crate and of its folder.
    pub name: &'a str,
    /// The rest of its manifest: `[lib]`, `[features]`.
    pub manifest: &'a str,
    /// Whether it names types of nalgebra.
    pub with_nalgebra: bool,
    /// How it is optimised.
    pub profile: Profile,
}

impl Outside<'_> {
    /// The folder of the crate, which is there afterwards: in that for temporary files, which cargo states to a suite.
    ///
    /// # Panics
    /// If the folder cannot be made.
    #[must_use]
    pub fn folder(&self, temporary: &str) -> PathBuf {
        let folder = Path::new(temporary).join(self.name);
        fs::create_dir_all(&folder).expect("a folder for the build");
        folder
    }

    /// Builds it with further arguments of cargo; returns the folder with the result.
    ///
    /// # Panics
    /// If it cannot be built, with what the compiler says.
    #[must_use]
    pub fn build(&self, temporary: &str, arguments: &[&str]) -> PathBuf {
        let (folder, root) = (self.folder(temporary), root());
        fs::write(folder.join("Cargo.toml"), self.whole_manifest(&root)).expect("a manifest");
        // Cargo drops what the crate does not need.
        fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).expect("the versions");
        let target = Path::new(temporary).ancestors().nth(1).expect("the build folder");
        let mut cargo = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        cargo.args(["build", "--offline", "--quiet", "--message-format", "short"]).args(arguments);
        cargo.arg("--manifest-path").arg(folder.join("Cargo.toml"));
        cargo.arg("--target-dir").arg(target).current_dir(&root);
        if self.profile == Profile::Release {
            cargo.arg("--release");
        }
        // Flags of the outer build (coverage, sanitizers) bring code and panics of their own.
        for flags in ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_TARGET"] {
            cargo.env_remove(flags);
        }
        let output = cargo.output().expect("cargo starts");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{} does not build: {errors}", self.name);
        target.join(if self.profile == Profile::Release { "release" } else { "debug" })
    }

    fn whole_manifest(&self, root: &Path) -> String {
        let Self { name, manifest, .. } = self;
        let nalgebra = if self.with_nalgebra {
            "nalgebra = { version = '0.35', default-features = false, features = ['libm'] }\n"
        } else {
            ""
        };
        let profile = match self.profile {
            Profile::Development { opt_level } => format!(
                "[profile.dev]\ndebug = false\nincremental = false\ncodegen-units = 4\n\
                 [profile.dev.package]\nlibm.opt-level = 2\n{name}.opt-level = {opt_level}\n"
            ),
            Profile::Release => "[profile.release]\npanic = \"abort\"\ncodegen-units = 1\n\
                 [profile.release.package.\"*\"]\nopt-level = 0\n\
                 [profile.release.package]\nlibm.opt-level = 3\nprecess-dynamics.opt-level = 3\n"
                .to_owned(),
        };
        format!(
            "[package]\nname = \"{name}\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\
             [workspace]\n{manifest}\
             [dependencies]\nprecess-dynamics = {{ path = '{}' }}\n{nalgebra}{profile}",
            root.join("dynamics").display()
        )
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}
