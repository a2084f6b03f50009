//! Isolated platforms in scenarios: a run against the library called directly, the written scenario, errors with their
//! places, what refuses a platform, platforms on platforms, and rows of panels.

mod locked;
mod rows;
mod stacked;

use std::ops::ControlFlow;
use std::path::Path;
use std::process::Command;

use nalgebra::{Matrix3, Vector3};
use precess::engine::{Advance, Run, run};
use precess::file::{from_toml, to_toml};
use precess::record::Samples;
use precess::scenario::Scenario;
use precess_dynamics::kind::JointStates;
use precess_dynamics::{
    HingedPanel, Hub, Inputs, Isolated, LoadAxes, Mode, Passive, Platform, ReactionWheel,
    Spacecraft, State, Strut, Suspension, platform,
};

/// A panel on the hub, named after a wheel on the platform: the set has the panel first.
const TWO_WHEELS: &str = r#"format = 1
[hub]
mass = "300 kg"
inertia = "90, 80, 60 kg m^2"
[initial]
angular_velocity = "0.02, -0.01, 0.03 rad/s"
[[platform]]
name = "iso"
mass = "6 kg"
centre_of_mass = "0, 0, 0.02 m"
inertia = "0.1, 0.1, 0.15 kg m^2"
position = "0, 0, 0.4 m"
mount = { dcm = [[0, -1, 0], [1, 0, 0], [0, 0, 1]] }
x_slide = { stiffness = "8000 N/m", damping = "20 N s/m", displacement = "0.0001 m" }
y_slide = { corner_frequency = "4 Hz", damping_ratio = 0.05 }
z_slide = { stiffness = "8000 N/m", damping = "20 N s/m", force = "0.3 N" }
x_turn = { stiffness = "150 N m/rad", damping = "0.6 N m s/rad", rate = "0.002 rad/s" }
y_turn = { locked = true }
z_turn = { stiffness = "150 N m/rad", damping = "0.6 N m s/rad" }
[[platform.strut]]
position = "0.2, 0, 0 m"
direction = [0, 0, 1]
length = "0.1 m"
stiffness = "10000 N/m"
damping = "20 N s/m"
[[device]]
name = "rw1"
kind = "reaction_wheel"
on = "iso"
wheel = { mass = "3 kg", inertia = "0.02, 0.01, 0.01 kg m^2", centre_of_mass = "0, 1e-5, 0 m", rate = "120 rad/s" }
[[device]]
name = "rw2"
copy_of = "rw1"
position = "0, 0.1, 0.1 m"
wheel.rate = "-110 rad/s"
[[device]]
name = "panel"
kind = "hinged_panel"
position = "0.5, 0, 0 m"
[device.panel]
mass = "4 kg"
centre_of_mass = "0.5, 0, 0 m"
inertia = "0.2, 0.3, 0.5 kg m^2"
stiffness = "40 N m/rad"
angle = "0.01 rad"
[run]
duration = "0.05 s"
integrator = "rk4"
step = "1 ms"
[output]
rate = "1 kHz"
columns = ["loads", "iso", "rw1", "rw2", "panel"]
"#;

type TypedSet = (HingedPanel, Isolated<[ReactionWheel; 2]>);

/// The platform with its devices: 6 kg and two wheels of 3 kg.
const ISOLATED_MASS: f64 = 12.0;

fn read(text: &str) -> Scenario {
    let read = from_toml("test.toml", text, Path::new(""));
    read.unwrap_or_else(|errors| panic!("{errors}\n{text}")).0
}

fn errors(text: &str) -> String {
    match from_toml("test.toml", text, Path::new("")) {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(errors) => errors.to_string(),
    }
}

/// The same craft in the library's own words.
fn typed() -> (Spacecraft<TypedSet>, State<TypedSet>, Inputs<TypedSet>) {
    let hub = Hub {
        m_b: 300.0,
        r_bc_b: Vector3::zeros(),
        i_b_bc: Matrix3::from_diagonal(&Vector3::new(90.0, 80.0, 60.0)),
    };
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01));
    let wheel = ReactionWheel { d: 1e-5, ..ReactionWheel::bare_wheel(3.0, disc) };
    let (slide, turn) = (Passive::spring(8000.0, 20.0), Passive::spring(150.0, 0.6));
    let omega = std::f64::consts::TAU * 4.0;
    let corner = Passive::spring(ISOLATED_MASS * omega * omega, 2.0 * 0.05 * ISOLATED_MASS * omega);
    let mut suspension = Suspension::none();
    suspension.struts[0] = Some(Strut {
        position: Vector3::new(0.2, 0.0, 0.0),
        direction: Vector3::z(),
        length: 0.1,
        stiffness: 10000.0,
        damping: 20.0,
    });
    let isolated = Isolated {
        carrier: Platform {
            mount: Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0),
            r_p_b: Vector3::new(0.0, 0.0, 0.4),
            r_pc_p: Vector3::new(0.0, 0.0, 0.02),
            passive: platform::PerJoint::of([slide, corner, slide, turn, Passive::none(), turn]),
            ..Platform::bare(6.0, Matrix3::from_diagonal(&Vector3::new(0.1, 0.1, 0.15)))
        },
        suspension,
        carried: [wheel, ReactionWheel { r_w_b: Vector3::new(0.0, 0.1, 0.1), ..wheel }],
    };
    let panel_inertia = Matrix3::from_diagonal(&Vector3::new(0.2, 0.3, 0.5));
    let mut panel = HingedPanel {
        r_p_b: Vector3::new(0.5, 0.0, 0.0),
        r_pc_p: Vector3::new(0.5, 0.0, 0.0),
        ..HingedPanel::bare_panel(4.0, panel_inertia)
    };
    panel.passive.panel = Passive::spring(40.0, 0.0);
    let craft = Spacecraft::new(&hub, &(panel, isolated)).expect("accepted");
    let mut state: State<TypedSet> = State::at_rest();
    state.omega = Vector3::new(0.02, -0.01, 0.03);
    state.devices.0.phi = 0.01;
    state.devices.1.carrier.x = 0.0001;
    state.devices.1.carrier.alpha_dot = 0.002;
    state.devices.1.carried[0].spin = 120.0;
    state.devices.1.carried[1].spin = -110.0;
    let mut inputs: Inputs<TypedSet> = Inputs::none();
    inputs.motors.1.carrier.f_z = 0.3;
    inputs.modes.1.carrier.y_turn = Mode::Locked;
    (craft, state, inputs)
}

#[test]
fn a_run_is_that_of_the_library_to_the_bit() {
    let scenario = read(TWO_WHEELS);
    assert_eq!(scenario.names, ["panel", "iso", "rw1", "rw2"]);
    let (craft, mut state, inputs) = typed();
    let mut run = Run::new(&scenario).expect("a run");
    let mut steps = 0;
    while let Advance::Stepped = run.advance().expect("a step") {
        state = craft.step(&state, &inputs, 1e-3).expect("a step");
        steps += 1;
        let found = run.state();
        assert_eq!((found.r_b_n, found.omega), (state.r_b_n, state.omega));
        assert_eq!(found.attitude, state.attitude);
        let typed: Vec<_> = state.devices.states().collect();
        let found: Vec<_> = found.devices.states().collect();
        // No wheel completes a turn, at which a run reduces its angle.
        assert_eq!(found, typed);
    }
    assert_eq!(steps, 50);
}

#[test]
fn loads_below_and_above_the_isolator_are_those_of_the_library() {
    let scenario = read(TWO_WHEELS);
    let mut samples = Samples::default();
    run(&scenario, &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    let (craft, state, inputs) = typed();
    let found = craft.accelerations(&state, &inputs).expect("regular");
    let loads = craft.loads(&state, &inputs, &found, LoadAxes::Body).expect("finite").devices.1;
    let first = |name: &str| -> Vector3<f64> {
        let component = |axis: &str| {
            let column = samples.column(&format!("{name}_{axis}"));
            column.unwrap_or_else(|| panic!("no {name}_{axis}"))[0]
        };
        Vector3::new(component("x"), component("y"), component("z"))
    };
    assert_eq!(first("iso.mount.force"), loads.carrier.mount.force);
    assert_eq!(first("iso.mount.moment"), loads.carrier.mount.moment);
    assert_eq!(first("rw2.mount.force"), loads.carried[1].mount.force);
    assert_eq!(first("iso.platform.load_force"), loads.carrier.joints.platform.force);
    let r = Vector3::new(0.0, 0.1, 0.1);
    let [one, two] = [loads.carried[0].mount, loads.carried[1].mount];
    assert_eq!(first("iso.carried.force"), one.force + two.force);
    let moment = one.moment + (two.moment + r.cross(&two.force));
    assert!((first("iso.carried.moment") - moment).norm() <= 1e-15 * moment.norm());
    assert!(one.force.norm() > 0.0 && (one.force + two.force).norm() > 0.0);
    // A locked turn holds a moment; the five bodies without mass have no columns.
    assert_eq!(samples.column("iso.u_y").expect("a column")[0], loads.carrier.motors.y_turn);
    assert!(samples.column("iso.x_slide.load_force_x").is_none());
}

#[test]
fn corner_frequencies_of_turns_are_those_of_the_inertia_with_devices() {
    let text = TWO_WHEELS.replace(
        "z_turn = { stiffness = \"150 N m/rad\", damping = \"0.6 N m s/rad\" }",
        "z_turn = { corner_frequency = \"5 Hz\", damping_ratio = 0.1 }",
    );
    let scenario = read(&text);
    let z_turn = scenario.devices.1[0].carrier.passive.platform;
    // About z through P: the platform's 0.15, each wheel's 0.01, and 3 kg at 0.1 m; the wheels'
    // centres of mass are 10 µm off.
    let offset = |y: f64| 3.0 * y * y;
    let inertia = 0.15 + 2.0 * 0.01 + offset(1e-5) + offset(0.1 + 1e-5);
    let omega = std::f64::consts::TAU * 5.0;
    assert!((z_turn.stiffness / (inertia * omega * omega) - 1.0).abs() < 1e-12, "{z_turn:?}");
    assert!((z_turn.viscous / (0.2 * inertia * omega) - 1.0).abs() < 1e-12, "{z_turn:?}");
}

/// Everything a platform may have.
fn everything() -> String {
    TWO_WHEELS
        .replace(
            "locked = true }",
            "acceleration = { sine = \"0.1 rad/s^2\", frequency = \"9 Hz\" } }",
        )
        .replace(
            "force = \"0.3 N\" }",
            "force = { step = \"1 N\", at = \"10 ms\" }, force_limit = \"0.5 N\", lower_stop = \
             \"-5 mm\", upper_stop = \"5 mm\", at_stop = \"lock\" }",
        )
        .replace("integrator = \"rk4\"\nstep = \"1 ms\"", "")
        + r#"[[at]]
time = "20 ms"
joint = "iso.x_slide"
brake = true
[[at]]
time = "30 ms"
joint = "iso.x_slide"
force = "0 N"
[[wrench]]
on = "iso.platform"
force = "0, 1, 0 N"
axes = "inertial"
[[wrench]]
on = "rw2.wheel"
moment = "0, 1, 0 mN m"
axes = "inertial"
[[crossing]]
column = "iso.z"
value = "1 um"
[[requirement]]
name = "below"
quantity = "iso.mount.force"
statistic = "rms"
limit = "100 N"
[[platform]]
name = "second"
mass = "2 kg"
inertia = "0.02, 0.02, 0.02 kg m^2"
position = "0, 0, -0.4 m"
[platform.coupled]
rest_slides = "0, 0, 1e-5 m"
[platform.coupled.stiffness]
slides = ["9e3, 100, 0 N/m", "100, 9e3, 0 N/m", "0, 0, 9e3 N/m"]
coupling = ["0, 50, 0 N/rad", "-50, 0, 0 N/rad", "0, 0, 0 N/rad"]
turns = ["60, 0, 0 N m/rad", "0, 60, 0 N m/rad", "0, 0, 60 N m/rad"]
[platform.coupled.damping]
slides = ["9, 0, 0 N s/m", "0, 9, 0 N s/m", "0, 0, 9 N s/m"]
turns = ["0.1, 0, 0 N m s/rad", "0, 0.1, 0 N m s/rad", "0, 0, 0.1 N m s/rad"]
"#
}

#[test]
fn a_platform_written_is_read_back_the_same() {
    let first = read(&everything());
    assert_eq!(first.names, ["panel", "iso", "rw1", "rw2", "second"]);
    let written = to_toml(&first);
    let second = read(&written);
    assert_eq!(to_toml(&second), written);
    assert_eq!(second.names, first.names);
    assert_eq!(second.devices, first.devices);
    assert_eq!(second.initial, first.initial);
    assert_eq!(second.drives, first.drives);
    assert_eq!(second.stops, first.stops);
    assert_eq!(second.changes, first.changes);
    assert_eq!(second.wrenches, first.wrenches);
}

#[test]
fn everything_runs_and_the_ledger_closes() {
    let scenario = read(&everything());
    let mut samples = Samples::default();
    let outcome = run(&scenario, &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    // The tolerance of a step is 1e-10.
    assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-9), "{:?}", outcome.drift);
    assert!(outcome.energy_lost > 0.0);
    assert!(samples.rows.iter().flatten().all(|number| number.is_finite()));
    let mut alone = scenario;
    alone.wrenches.clear();
    let outcome = run(&alone, &mut Samples::default(), &mut |_| ControlFlow::Continue(()));
    let drift = outcome.expect("a run").drift;
    for part in [drift.linear, drift.angular] {
        assert!(part.is_some_and(|part| part < 1e-9), "{drift:?}");
    }
}

#[test]
fn errors_name_the_place_the_fault_and_the_remedy() {
    let with = |from: &str, to: &str| {
        assert!(TWO_WHEELS.contains(from), "{from}");
        errors(&TWO_WHEELS.replacen(from, to, 1))
    };
    let on = "on = \"iso\"";
    for (from, to, parts) in [
        (on, "on = \"isolator\"", ["no platform or panel is named `isolator`", "there are iso"]),
        (on, "on = \"rw1\"", ["`rw1` stands on itself", "remove `on`"]),
        (on, "on = \"rw2\"", ["`rw2` is no panel", "on the hub; there are iso, panel"]),
        ("mass = \"6 kg\"", "mass = \"0 kg\"", ["mass", "\"0 kg\""]),
        (
            "x_turn = { stiffness",
            "x_turn = { corner_frequency = \"2 Hz\", stiffness",
            ["`stiffness` and `corner_frequency`", "keep `stiffness`"],
        ),
        (
            "corner_frequency = \"4 Hz\", ",
            "",
            ["a damping ratio is of a corner frequency", "give `corner_frequency`"],
        ),
        ("corner_frequency = \"4 Hz\"", "corner_frequency = \"-4 Hz\"", ["is -4", "not negative"]),
        (
            "length = \"0.1 m\"",
            "length = \"0 m\"",
            ["`platform.iso.strut.0.length` is 0 m", "above zero"],
        ),
        ("direction = [0, 0, 1]", "direction = [0, 0, 0]", ["has no direction", "not all zero"]),
        ("length = \"0.1 m\"\n", "", ["length` is missing", "length = "]),
        ("y_slide = {", "y_slid = {", ["unknown key `platform.iso.y_slid`", "`y_slide`"]),
        (
            "mount = { dcm = [[0, -1, 0], [1, 0, 0], [0, 0, 1]] }",
            "mount = { spin_axis = [0, 0, 1] }",
            ["`platform.iso.mount`", "give one of `matrix`"],
        ),
        (
            "[run]",
            "[[at]]\ntime = \"1 ms\"\njoint = \"iso.w_turn\"\nlocked = true\n[run]",
            ["no joint is named `iso.w_turn`", "iso.z_turn"],
        ),
        (
            "[[platform.strut]]",
            "[platform.coupled]\nstiffness.slides = [\"1, 2, 0 N/m\", \"0, 1, 0 N/m\", \"0, 0, 1 N/m\"]\n[[platform.strut]]",
            ["is not symmetric", "equal 21, 31 and 32"],
        ),
        (
            "[[platform.strut]]",
            "[platform.coupled]\nstiffness.slides = [\"1, 2, 0 N/m\", \"2, 1, 0 N/m\", \"0, 0, 1 N/m\"]\n[[platform.strut]]",
            ["iso", "stiffness"],
        ),
        (
            "stiffness = \"8000 N/m\"",
            "stiffness = \"8000 N m/rad\"",
            ["a stiffness of a turning joint", "write it in"],
        ),
    ] {
        let shown = with(from, to);
        for part in parts {
            assert!(shown.contains(part), "`{part}` for {to}:\n{shown}");
        }
        assert!(shown.contains("test.toml:"), "a place for {to}:\n{shown}");
    }
    let shown = errors(&TWO_WHEELS.replace("\"iso\"", "\"panel\""));
    assert!(shown.contains("two devices or platforms are named `panel`; rename one"), "{shown}");
    let shown = errors(&TWO_WHEELS.replace("\"iso\"", "\"hub\""));
    assert!(shown.contains("choose another name"), "{shown}");
}

#[test]
fn bake_refuses_a_platform_and_the_flight_table_has_it() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("platforms");
    std::fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("two-wheels.toml");
    std::fs::write(&file, TWO_WHEELS).expect("a file");
    let run = |command: &[&str], file: &Path| {
        let mut precess = Command::new(env!("CARGO_BIN_EXE_precess"));
        let output = precess.args(command).arg(file).output().expect("it starts");
        let shown = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.success(), shown)
    };
    let (done, shown) = run(&["bake", "--description"], &file);
    assert!(!done && shown.contains("platform") && shown.contains("remove"), "{shown}");
    let (done, shown) = run(&["export", "table", "--force"], &file);
    assert!(done, "{shown}");
    let table = std::fs::read(folder.join("two-wheels.table")).expect("a table");
    let devices =
        TWO_WHEELS.matches("[[device]]").count() + TWO_WHEELS.matches("[[platform]]").count();
    assert_eq!(table.len(), 124 + 2320 * devices);
    for command in ["check", "evaluate"] {
        let mut precess = Command::new(env!("CARGO_BIN_EXE_precess"));
        let output = precess.arg(command).arg(&file).output().expect("it starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert!(String::from_utf8_lossy(&output.stdout).contains("iso."), "{command}");
    }
}
