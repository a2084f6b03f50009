//! A cubesat with three wheels along its axes, at speeds of their own, and a budget of its pointing.
//!
//! On a rigid hub the metrics do not vary over a common speed, since imbalance has `Omega^2` and the motion `1/Omega^2`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use precess::file::{budget_from_toml, from_file};
use precess::jitter::budget::{Assessed, Budget};
use precess::jitter::model::Model;
use precess::jitter::prepared::Prepared;
use precess::jitter::sweep::{Sweep, sweep};
use precess::scenario::Scenario;

/// The rates of the wheels, rpm: their tones have whole numbers of periods in six seconds.
const RATES: [u32; 3] = [3000, 3200, 2900];

/// An empty folder of a test.
pub(super) fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("precess-cubesat-{}-{name}", std::process::id()));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).expect("a folder");
    path
}

/// The scenario, with requirements on its rotation.
pub(super) fn scenario() -> String {
    let mut text = String::from(
        "format = 1\n[hub]\nmass = \"11.55 kg\"\ncentre_of_mass = \"0, 0, 1 cm\"\ninertia = \"0.09, 0.1, 0.05 kg m^2\"\n\
         [initial]\nsettled = true\n[run]\nduration = \"6 s\"\nintegrator = \"dop853\"\ntolerance = 1e-11\n\
         [output]\nrate = \"1 kHz\"\n",
    );
    for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
        let number = axis + 1;
        let position = ["5, 0, -5 cm", "0, 5, -5 cm", "-5, 0, -5 cm"][axis];
        let along = [0, 1, 2].map(|k| if k == axis { "1" } else { "0" }).join(", ");
        let _ = write!(
            text,
            "[[device]]\nname = \"wheel{number}\"\nkind = \"reaction_wheel\"\nposition = \"{position}\"\n\
             mount = {{ spin_axis = [{along}] }}\n\
             imbalance = {{ static = \"0.5 g mm\", dynamic = \"5 g mm2\", phase = \"0 deg\" }}\n\
             [device.wheel]\nmass = \"150 g\"\ninertia = \"640, 350, 350 g cm^2\"\nrate = \"{} rpm\"\n\
             torque = \"0 N m\"\ntorque_limit = \"2 mNm\"\n\
             [[requirement]]\nname = \"pointing {letter}\"\nquantity = \"rotation_{letter}\"\nstatistic = \"band_rms\"\n\
             band = \"1, 200 Hz\"\nlimit = \"2 arcsec\"\n",
            RATES[axis],
        );
    }
    text
}

/// The budget: rotations about x, y and z, by one assumption about phases.
pub(super) fn budget(phases: &str) -> String {
    let mut text = format!(
        "format = 1\nscenario = \"cubesat.toml\"\nphases = \"{phases}\"\n\
         [speed]\nfrom = \"1000 rpm\"\nto = \"8000 rpm\"\ncount = 15\n"
    );
    for (letter, row) in [("x", "1, 0, 0"), ("y", "0, 1, 0"), ("z", "0, 0, 1")] {
        let _ = write!(
            text,
            "[[line_of_sight]]\nname = \"{letter}\"\n[[line_of_sight.sensitivity]]\nnode = \"hub\"\n\
             x_by_rotation = [{row}]\n[[requirement]]\nname = \"pointing {letter}\"\nline_of_sight = \"{letter}\"\n\
             metric = \"band_rms\"\nband = \"1, 200 Hz\"\nlimit = \"2 arcsec\"\n"
        );
    }
    text
}

/// A folder with both files.
pub(super) fn files(name: &str, phases: &str) -> PathBuf {
    let folder = folder(name);
    std::fs::write(folder.join("cubesat.toml"), scenario()).expect("it is written");
    std::fs::write(folder.join("budget.toml"), budget(phases)).expect("it is written");
    folder
}

/// A command in a folder.
pub(super) fn precess(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_precess"));
    command.current_dir(folder).args(arguments).output().expect("it starts")
}

/// `jitter` of the budget in a folder, without coupled runs: its exit code, what it prints, its notes and its page.
pub(super) fn jitter(folder: &Path, more: &[&str]) -> (Option<i32>, String, String, String) {
    let arguments = ["jitter", "budget.toml", "--no-compare", "--force", "--out", "out"];
    let found = precess(folder, &[&arguments[..], more].concat());
    let page = std::fs::read_to_string(folder.join("out/budget.html")).unwrap_or_default();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (found.status.code(), text(&found.stdout), text(&found.stderr), page)
}

/// What a budget and a scenario are, with the model and the sweep.
pub(super) struct Found {
    pub(super) scenario: Scenario,
    pub(super) budget: Budget,
    pub(super) model: Model,
    pub(super) sweep: Sweep,
    pub(super) assessed: Vec<Assessed>,
}

/// The budget in a folder, with keys of the scenario replaced.
pub(super) fn found(folder: &Path, overrides: &[String]) -> Found {
    let (budget, path) = budget_from_toml(&folder.join("budget.toml"), &[])
        .unwrap_or_else(|errors| panic!("{errors}"));
    let (scenario, _) = from_file(&path, overrides).unwrap_or_else(|errors| panic!("{errors}"));
    let Prepared { model, speeds, .. } = Prepared::new(&scenario, &budget).expect("tones");
    let sweep = sweep(&model, &speeds, 1, &|_| {}).expect("a rigid hub");
    let assessed = budget.assess(&sweep).expect("lines");
    Found { scenario, budget, model, sweep, assessed }
}
