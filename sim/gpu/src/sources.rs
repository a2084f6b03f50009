//! [`Sources`]: the kernels of a set of devices as text, and as one text for NVRTC.
//!
//! They are derived by `precess-bake`, a program of its own, as all kernels of one spacecraft: nothing here derives.

use std::collections::{BTreeMap, BTreeSet};
use std::env;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use precess_description::{Body, Description, Device, FORMAT, Hub};
use precess_dynamics::BuiltInKind;

use crate::GpuError;

/// The program that derives.
const PROGRAM: &str = "precess-bake";
/// The name of every set in its files and functions: what they are depends on the kinds alone.
const NAME: &str = "set";
/// Headers in place of the system's.
const SYSTEM: &str = "nvrtc/";

/// An emitted file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourceFile {
    /// Its path from the folder of the kernels.
    pub path: String,
    /// What is in it.
    pub text: String,
}

/// The emitted files of a set of devices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sources {
    /// The name that files and functions begin with.
    pub name: String,
    /// The files.
    pub files: Vec<SourceFile>,
}

impl Sources {
    /// What `precess-bake` derives for devices of these kinds, in this order: within a second or two.
    ///
    /// # Errors
    /// [`GpuError::Generator`].
    pub fn derive(program: &Path, kinds: &[BuiltInKind]) -> Result<Self, GpuError> {
        let fault = |what: &dyn std::fmt::Display| GpuError::Generator(what.to_string());
        let text = Self::description(kinds).write().map_err(|error| fault(&error))?;
        let folder = tempfile::tempdir().map_err(|error| fault(&error))?;
        let out = folder.path().join(NAME);
        let mut command = Command::new(program);
        command.args(["--general", "--batch", "--out"]).arg(&out);
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|error| fault(&format!("{} cannot be started: {error}", program.display())))?;
        if let Some(mut input) = child.stdin.take() {
            // A program that ends before it has read all says why itself.
            let _ = input.write_all(text.as_bytes());
        }
        let output = child.wait_with_output().map_err(|error| fault(&error))?;
        if !output.status.success() {
            return Err(fault(&String::from_utf8_lossy(&output.stderr).trim()));
        }
        let mut files = Vec::new();
        for place in ["", SYSTEM] {
            for entry in fs::read_dir(out.join(place)).map_err(|error| fault(&error))? {
                let path = entry.map_err(|error| fault(&error))?.path();
                if let (true, Some(name)) = (path.is_file(), path.file_name()) {
                    let text = fs::read_to_string(&path).map_err(|error| fault(&error))?;
                    files.push(SourceFile { path: format!("{place}{}", name.display()), text });
                }
            }
        }
        files.sort_by(|a, b| a.path.cmp(&b.path));
        Ok(Self { name: NAME.to_owned(), files })
    }

    /// The description of a set; numbers of a spacecraft are no part of its kernels.
    #[must_use]
    pub fn description(kinds: &[BuiltInKind]) -> Description {
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let body = Body {
            mass: 1.0,
            origin: [0.0; 3],
            centre_of_mass: [0.0; 3],
            inertia: unit,
            locked_at: None,
        };
        let device = |(number, kind): (usize, &BuiltInKind)| Device {
            name: format!("device{number}"),
            kind: kind.name().to_owned(),
            mount: unit,
            turns: None,
            body: vec![body.clone(); kind.joints().len()],
            keep: Vec::new(),
        };
        Description {
            format: FORMAT,
            name: NAME.to_owned(),
            title: String::new(),
            hub: Hub { mass: 1.0, centre_of_mass: [0.0; 3], inertia: unit },
            device: kinds.iter().enumerate().map(device).collect(),
        }
    }

    /// All sources as one text that includes nothing: each file once, where it is first included.
    ///
    /// # Errors
    /// [`GpuError::Compile`] of an included file that is not among these.
    pub fn one_text(&self) -> Result<String, GpuError> {
        let files: BTreeMap<&str, &str> = self
            .files
            .iter()
            .map(|file| (file.path.strip_prefix(SYSTEM).unwrap_or(&file.path), &*file.text))
            .collect();
        let mut text = String::new();
        include(&format!("{}_batch.cu", self.name), &files, &mut BTreeSet::new(), &mut text)?;
        Ok(text)
    }
}

/// Appends a file, with those that it includes in their places.
fn include<'a>(
    name: &str,
    files: &BTreeMap<&'a str, &'a str>,
    included: &mut BTreeSet<&'a str>,
    text: &mut String,
) -> Result<(), GpuError> {
    let Some((name, file)) = files.get_key_value(name) else {
        return Err(GpuError::Compile(format!("`{name}` is included and was not emitted")));
    };
    if !included.insert(name) {
        return Ok(());
    }
    for line in file.lines() {
        let wanted = line.strip_prefix("#include ").map(str::trim);
        match wanted.map(|of| of.trim_matches(['"', '<', '>'])) {
            Some(other) => include(other, files, included, text)?,
            None => text.extend([line, "\n"]),
        }
    }
    Ok(())
}

/// Where `precess-bake` is: beside this program, as `cargo install` puts both; in the folder of programs of a Python
/// environment; else by the path.
#[must_use]
pub fn generator() -> PathBuf {
    let name = format!("{PROGRAM}{}", env::consts::EXE_SUFFIX);
    let beside = env::current_exe().ok().map(|own| own.with_file_name(&name));
    beside.filter(|path| path.is_file()).unwrap_or_else(|| PathBuf::from(PROGRAM))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sources(files: &[(&str, &str)]) -> Sources {
        let file = |(path, text): &(&str, &str)| SourceFile {
            path: (*path).to_owned(),
            text: (*text).to_owned(),
        };
        Sources { name: "set".to_owned(), files: files.iter().map(file).collect() }
    }

    #[test]
    fn each_file_is_there_once_where_it_is_first_included() {
        let one = sources(&[
            ("set_batch.cu", "#include \"a.h\"\nx\n#include \"b.c\"\n"),
            ("a.h", "#include <stddef.h>\na\n"),
            ("b.c", "#include \"a.h\"\nb\n"),
            ("nvrtc/stddef.h", "s\n"),
        ]);
        assert_eq!(one.one_text().unwrap(), "s\na\nx\nb\n");
    }

    #[test]
    fn a_file_that_is_missing_is_named() {
        let one = sources(&[("set_batch.cu", "#include <math.h>\n")]);
        let error = one.one_text().unwrap_err();
        assert!(error.to_string().contains("`math.h`"), "{error}");
    }

    #[test]
    fn a_program_that_is_missing_is_named_with_the_remedy() {
        let error = Sources::derive(Path::new("no-such-program"), &[BuiltInKind::ReactionWheel])
            .unwrap_err();
        let text = error.to_string();
        assert!(text.contains("no-such-program") && text.contains("cargo install"), "{text}");
    }
}
