//! `capi`: builds the library for flight software on this machine and tests it from C and C++.
//!
//! Builds it, holds the header against it, and runs the programs in C under every compiler that is
//! there, without a C library, under valgrind and under the sanitizers: all must print the same
//! bits. A run of the desktop tool must have the same bits, too.

mod desktop;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{cargo, is_there, output, root, target};
use crate::say;
use crate::skip::skip;

/// Warnings, each an error.
const WARNINGS: [&str; 5] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-ffp-contract=off"];
/// The workspace of what is linked on board.
pub const MANIFEST: &str = "flight/Cargo.toml";
/// Its headers: one that programs include, what it includes, and those of steering and of trackers.
pub const HEADERS: [&str; 4] = [
    "flight/capi/include/precess.h",
    "flight/capi/include/precess_constants.h",
    "flight/capi/include/precess_steering.h",
    "flight/capi/include/precess_tracking.h",
];
const LAYOUTS: [(&str, &str); 2] =
    [("layout", "flight/capi/tests/layout.c"), ("layout-v2", "flight/capi/tests/layout_v2.c")];
/// A program of version 1 of the interface.
const PROGRAM: &[&str] = &["flight/capi/tests/abi.c"];
/// A program of version 2, with a part of version 1.
const PROGRAM_2: &[&str] = &["flight/capi/tests/version2.c", "flight/capi/tests/version1.c"];
/// A program of platforms, which version 2 has.
const PLATFORMS: &[&str] = &["flight/capi/tests/platforms.c"];
/// A program of steering: of version 1, and of 2.
const STEERING: &[&str] = &["flight/capi/tests/steering.c"];
const STEERING_VERSIONS: [&str; 2] = ["-DPRECESS_TABLE_VERSION=1", "-DPRECESS_TABLE_VERSION=2"];
/// A program of trackers.
const TRACKING: &[&str] = &["flight/capi/tests/tracking.c"];
/// How the library is linked.
pub const GUIDE: &str = "flight/README.md";
const APP: &[&str] = &["flight/examples/cfs_app/main.c", "flight/examples/cfs_app/dyn_app.c"];
/// What the application prints.
const APP_OUTPUT: &str = "flight/examples/cfs_app/expected.txt";

/// A compiler and the language of its files.
struct Compiler {
    name: &'static str,
    arguments: &'static [&'static str],
    install: &'static str,
}

const COMPILERS: [Compiler; 4] = [
    Compiler { name: "gcc", arguments: &["-std=c11"], install: "apt-get install gcc libc6-dev" },
    Compiler {
        name: "g++",
        arguments: &["-std=c++11", "-x", "c++"],
        install: "apt-get install g++",
    },
    Compiler { name: "clang", arguments: &["-std=c11"], install: "apt-get install clang" },
    Compiler {
        name: "clang++",
        arguments: &["-std=c++11", "-x", "c++"],
        install: "apt-get install clang",
    },
];

/// Paths of what is built.
struct Host {
    /// The static library.
    library: PathBuf,
    /// The shared one.
    shared: PathBuf,
    /// For programs.
    programs: PathBuf,
}

/// All of it.
///
/// # Errors
/// What failed first.
pub fn host() -> Result<(), String> {
    let host = built()?;
    host.exports()?;
    let (mut outputs, mut second, mut platforms) = (Vec::new(), Vec::new(), Vec::new());
    let (mut steering, mut tracking) = (Vec::new(), Vec::new());
    for compiler in &COMPILERS {
        if !is_there(compiler.name) {
            skip(&format!("C interface by {}", compiler.name), compiler.install)?;
            continue;
        }
        for (name, layout) in LAYOUTS {
            host.compile(compiler, name, &[layout], &["-c"], false)?;
        }
        let program = host.compile(compiler, "abi", PROGRAM, &["-O2", "-DHOSTED"], true)?;
        outputs.push((program.clone(), printed(&mut Command::new(&program))?));
        for (name, option) in [("version2", "-O2"), ("version2-1", "-O1")] {
            let program = host.compile(compiler, name, PROGRAM_2, &[option, "-DHOSTED"], true)?;
            second.push((program.clone(), printed(&mut Command::new(&program))?));
        }
        let program = host.compile(compiler, "platforms", PLATFORMS, &["-O2", "-DHOSTED"], true)?;
        platforms.push((program.clone(), printed(&mut Command::new(&program))?));
        for version in STEERING_VERSIONS {
            let options = ["-O2", "-DHOSTED", version];
            let program = host.compile(compiler, "steering", STEERING, &options, true)?;
            steering.push((program.clone(), printed(&mut Command::new(&program))?));
        }
        let program = host.compile(compiler, "tracking", TRACKING, &["-O2", "-DHOSTED"], true)?;
        tracking.push((program.clone(), printed(&mut Command::new(&program))?));
        let first = host.guide()?;
        let first = host.compile(compiler, "first", &[&first], &["-O2"], true)?;
        printed(&mut Command::new(first))?;
        let app = host.compile(compiler, "app", APP, &["-O2"], true)?;
        host.app(&mut Command::new(app))?;
    }
    let gcc = &COMPILERS[0];
    if is_there(gcc.name) {
        outputs.extend(host.checked(gcc)?);
        let options = ["-g", "-O1", "-DHOSTED", "-fsanitize=address,undefined"];
        let program = host.compile(gcc, "version2", PROGRAM_2, &options, true)?;
        second.push((program.clone(), printed(&mut Command::new(&program))?));
        let program = host.compile(gcc, "platforms", PLATFORMS, &options, true)?;
        platforms.push((program.clone(), printed(&mut Command::new(&program))?));
        let program = host.compile(gcc, "steering", STEERING, &options, true)?;
        steering.push((program.clone(), printed(&mut Command::new(&program))?));
        let program = host.compile(gcc, "tracking", TRACKING, &options, true)?;
        tracking.push((program.clone(), printed(&mut Command::new(&program))?));
    }
    for (what, outputs) in [
        ("version 1", &outputs),
        ("version 2", &second),
        ("platforms", &platforms),
        ("steering", &steering),
        ("tracking", &tracking),
    ] {
        same(outputs)?;
        let count = outputs.len();
        say!("{what}: {count} programs in C and C++ print the same bits");
    }
    host.desktop()
}

/// Lines of a program below which nothing has been shown.
const LEAST: usize = 25;

/// All programs pass, and print the same.
fn same(outputs: &[(PathBuf, String)]) -> Result<(), String> {
    for (program, output) in outputs {
        let passed = output.ends_with("passed\n") && output.lines().count() > LEAST;
        if !passed || Some(output) != outputs.first().map(|(_, first)| first) {
            return Err(format!("{} prints other bits, or fails:\n{output}", program.display()));
        }
    }
    Ok(())
}

/// Builds both libraries, and runs their unit tests.
fn built() -> Result<Host, String> {
    let (common, folder) = (target()?, target()?.join("flight"));
    for (task, folder) in [(&["build", "--release"][..], &folder), (&["test"][..], &common)] {
        let folder = folder.to_string_lossy();
        let options = ["--manifest-path", MANIFEST, "--target-dir", &folder, "--quiet"];
        cargo(&[task, &options].concat())?;
    }
    let programs = folder.join("programs");
    std::fs::create_dir_all(&programs)
        .map_err(|error| format!("cannot make {}: {error}", programs.display()))?;
    let release = folder.join("release");
    let (library, shared) = (release.join("libprecess.a"), release.join("libprecess.so"));
    Ok(Host { library, shared, programs })
}

impl Host {
    /// The functions of the header are those of the library, and the library needs only the symbols
    /// that the header names.
    fn exports(&self) -> Result<(), String> {
        if !is_there("nm") {
            return skip("exports of the library", "apt-get install binutils");
        }
        let headers: Result<Vec<String>, String> =
            HEADERS.iter().map(|header| read(&root().join(header))).collect();
        let header = headers?.concat();
        let declared: BTreeSet<_> = functions(&header).collect();
        let nm = |option: &str| {
            printed(Command::new("nm").args(["--dynamic", option]).arg(&self.shared))
        };
        let defined = nm("--defined-only")?;
        let defined: BTreeSet<_> =
            defined.lines().filter_map(|line| line.split(' ').nth(2)).collect();
        if let Some(name) = declared.symmetric_difference(&defined).next() {
            return Err(format!(
                "{name} is in only one of the headers and the library; add it to the other"
            ));
        }
        let undefined = nm("--undefined-only")?;
        let undefined = undefined.lines().filter_map(|line| line.trim().strip_prefix("U "));
        // A version may follow the name.
        let mut undefined = undefined.map(|name| name.split('@').next().unwrap_or(name));
        if let Some(name) = undefined.find(|name| !["memcpy", "memset"].contains(name)) {
            return Err(format!("the library needs {name}; only memcpy and memset are allowed"));
        }
        let all = printed(Command::new("nm").arg(&self.shared))?;
        let panics = ["panick", "unwrap_failed", "expect_failed", "_fail"];
        if let Some(name) = all.lines().find(|line| panics.iter().any(|part| line.contains(part))) {
            return Err(format!("the library has a path that panics, {name}; find its caller"));
        }
        say!("{} functions, in the header and in the library; none can panic", declared.len());
        Ok(())
    }

    /// The program of the guide, in a file.
    fn guide(&self) -> Result<String, String> {
        let guide = read(&root().join(GUIDE))?;
        let program = guide.split_once("```c\n").and_then(|(_, rest)| rest.split_once("```"));
        let (program, _) = program.ok_or(format!("{GUIDE} has no program in C"))?;
        let to = self.programs.join("first.c");
        std::fs::write(&to, program)
            .map_err(|error| format!("cannot write {}: {error}", to.display()))?;
        Ok(to.to_string_lossy().into_owned())
    }

    /// Compiles a program; returns where it is.
    fn compile(
        &self,
        compiler: &Compiler,
        name: &str,
        sources: &[&str],
        options: &[&str],
        link: bool,
    ) -> Result<PathBuf, String> {
        let kind = options.iter().find_map(|option| option.strip_prefix("-fsanitize="));
        let kind = kind.map_or("", |_| "-sanitized");
        let to = self.programs.join(format!("{name}-{}{kind}", compiler.name));
        let mut command = Command::new(compiler.name);
        command.args(compiler.arguments).args(WARNINGS).args(options);
        command.args(["-Iflight/capi/include", "-o"]).arg(&to).args(sources);
        if link {
            // What follows is no source.
            if compiler.arguments.contains(&"-x") {
                command.args(["-x", "none"]);
            }
            command.arg(&self.library);
        }
        printed(&mut command)?;
        Ok(to)
    }

    /// Without a C library, under valgrind, under the sanitizers, and with the shared library.
    fn checked(&self, gcc: &Compiler) -> Result<Vec<(PathBuf, String)>, String> {
        let mut outputs = Vec::new();
        let mut run = |program: PathBuf, by: &mut Command| {
            outputs.push((program, printed(by)?));
            Ok::<_, String>(())
        };
        if cfg!(all(target_os = "linux", target_arch = "x86_64")) {
            let sources = [PROGRAM, &["flight/capi/tests/start.c"]].concat();
            let bare = [
                "-O2",
                "-ffreestanding",
                "-nostdlib",
                "-static",
                "-fno-stack-protector",
                "-fno-tree-loop-distribute-patterns",
                "-Wl,--gc-sections",
            ];
            let program = self.compile(gcc, "bare", &sources, &bare, true)?;
            run(program.clone(), &mut Command::new(program))?;
        }
        let options = ["-g", "-O1", "-DHOSTED", "-fsanitize=address,undefined"];
        let options = [&options[..], &["-fno-sanitize-recover=all"]].concat();
        let program = self.compile(gcc, "abi", PROGRAM, &options, true)?;
        run(program.clone(), &mut Command::new(program))?;
        let app = self.compile(gcc, "app", APP, &options, true)?;
        self.app(&mut Command::new(app))?;
        if is_there("valgrind") {
            for name in ["abi", "app"] {
                let program = self.programs.join(format!("{name}-gcc"));
                let mut valgrind = Command::new("valgrind");
                valgrind.args(["--quiet", "--error-exitcode=9", "--leak-check=full"]).arg(&program);
                if name == "app" {
                    self.app(&mut valgrind)?;
                } else {
                    run(program, &mut valgrind)?;
                }
            }
        } else {
            skip("C interface under valgrind", "apt-get install valgrind")?;
        }
        Ok(outputs)
    }

    /// Runs the application, which prints what it always does.
    fn app(&self, command: &mut Command) -> Result<(), String> {
        let (found, expected) = (printed(command)?, read(&root().join(APP_OUTPUT))?);
        if found == expected {
            return Ok(());
        }
        let kept = self.programs.join("app.txt");
        std::fs::write(&kept, found).map_err(|error| format!("cannot write: {error}"))?;
        Err(format!("{} is not {APP_OUTPUT}; compare them", kept.display()))
    }
}

/// The functions that a header declares, and the names that it gives them in version 2.
fn functions(header: &str) -> impl Iterator<Item = &str> {
    let renamed = header.lines().filter_map(|line| {
        let (name, second) = line.strip_prefix("#define ")?.split_once(' ')?;
        second.strip_prefix(name).filter(|end| *end == "_v2").map(|_| second)
    });
    let declared =
        header.lines().filter(|line| !line.starts_with([' ', '#', '/', '*'])).filter_map(|line| {
            let (before, _) = line.split_once('(')?;
            before.rsplit([' ', '*']).next().filter(|name| name.starts_with("precess_"))
        });
    declared.chain(renamed)
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path)
        .map_err(|error| format!("cannot read {}: {error}", path.display()))
}

/// What a program prints in the root, if it succeeds.
fn printed(command: &mut Command) -> Result<String, String> {
    output(command.current_dir(root()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_are_found_by_their_declarations() {
        let header = "/* precess_no(1) */\nint32_t precess_yes(void);\nconst char *precess_too(int \
                      a,\n                precess_not(b));\n#define precess_never(x) x\n#define \
                      precess_yes precess_yes_v2\n";
        let expected = ["precess_yes", "precess_too", "precess_yes_v2"];
        assert_eq!(functions(header).collect::<Vec<_>>(), expected);
    }
}
