//! Platforms on platforms: the library's nested set to the bit, loads, momenta and energy, the written scenario, and
//! errors.

use std::ops::ControlFlow;

use nalgebra::{Matrix3, Vector3};
use precess::engine::{Advance, Run, run};
use precess::file::to_toml;
use precess::record::Samples;
use precess_dynamics::kind::JointStates;
use precess_dynamics::{
    HingedPanel, Hub, Inputs, Isolated, LoadAxes, Mode, Passive, Platform, ReactionWheel,
    Spacecraft, State, Suspension, platform,
};

use super::{errors, read};

/// A panel on the hub, a platform with a wheel on it, and on this platform another with two wheels. The inner one is
/// written first: the set has the outer one first.
const STACKED: &str = r#"format = 1
[hub]
mass = "300 kg"
inertia = "90, 80, 60 kg m^2"
[initial]
angular_velocity = "0.02, -0.01, 0.03 rad/s"
[[platform]]
name = "iso"
on = "base"
mass = "2 kg"
centre_of_mass = "0.01, 0, 0.02 m"
inertia = "0.03, 0.02, 0.04 kg m^2"
position = "0.1, 0.2, 0.05 m"
mount = { dcm = [[1, 0, 0], [0, 0, -1], [0, 1, 0]] }
x_slide = { stiffness = "9000 N/m", damping = "15 N s/m", displacement = "0.0002 m" }
y_slide = { stiffness = "9000 N/m", damping = "15 N s/m" }
z_slide = { stiffness = "9000 N/m", damping = "15 N s/m", force = "0.2 N" }
x_turn = { stiffness = "120 N m/rad", damping = "0.3 N m s/rad" }
y_turn = { locked = true }
z_turn = { stiffness = "120 N m/rad", damping = "0.3 N m s/rad", rate = "0.003 rad/s" }
[[platform]]
name = "base"
mass = "6 kg"
centre_of_mass = "0, 0, 0.02 m"
inertia = "0.1, 0.1, 0.15 kg m^2"
position = "0, 0, 0.4 m"
mount = { dcm = [[0, -1, 0], [1, 0, 0], [0, 0, 1]] }
x_slide = { stiffness = "8000 N/m", damping = "20 N s/m", displacement = "0.0001 m" }
y_slide = { corner_frequency = "4 Hz", damping_ratio = 0.05 }
z_slide = { stiffness = "8000 N/m", damping = "20 N s/m" }
x_turn = { stiffness = "150 N m/rad", damping = "0.6 N m s/rad", rate = "0.002 rad/s" }
y_turn = { stiffness = "150 N m/rad", damping = "0.6 N m s/rad" }
z_turn = { stiffness = "150 N m/rad", damping = "0.6 N m s/rad" }
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
name = "rw0"
copy_of = "rw1"
on = "base"
position = "-0.1, 0, 0 m"
wheel.rate = "90 rad/s"
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
columns = ["omega", "loads", "iso", "base", "rw0", "rw1", "rw2", "panel"]
"#;

const NAMES: [&str; 6] = ["panel", "base", "rw0", "iso", "rw1", "rw2"];

type TypedSet = (HingedPanel, Isolated<(ReactionWheel, Isolated<[ReactionWheel; 2]>)>);

pub(super) fn diagonal(x: f64, y: f64, z: f64) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(x, y, z))
}

/// The same craft in the library's own words.
fn typed() -> (Spacecraft<TypedSet>, State<TypedSet>, Inputs<TypedSet>) {
    let hub = Hub { m_b: 300.0, r_bc_b: Vector3::zeros(), i_b_bc: diagonal(90.0, 80.0, 60.0) };
    let wheel =
        ReactionWheel { d: 1e-5, ..ReactionWheel::bare_wheel(3.0, diagonal(0.02, 0.01, 0.01)) };
    let (slide, turn) = (Passive::spring(9000.0, 15.0), Passive::spring(120.0, 0.3));
    let iso = Isolated {
        carrier: Platform {
            mount: Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0),
            r_p_b: Vector3::new(0.1, 0.2, 0.05),
            r_pc_p: Vector3::new(0.01, 0.0, 0.02),
            passive: platform::PerJoint::of([slide, slide, slide, turn, Passive::none(), turn]),
            ..Platform::bare(2.0, diagonal(0.03, 0.02, 0.04))
        },
        suspension: Suspension::none(),
        carried: [wheel, ReactionWheel { r_w_b: Vector3::new(0.0, 0.1, 0.1), ..wheel }],
    };
    let (slide, turn) = (Passive::spring(8000.0, 20.0), Passive::spring(150.0, 0.6));
    // Of the corner frequency: both platforms and three wheels, 6 kg, 2 kg and 3 kg each.
    let (mass, omega) = (17.0, std::f64::consts::TAU * 4.0);
    let corner = Passive::spring(mass * omega * omega, 2.0 * 0.05 * mass * omega);
    let base = Isolated {
        carrier: Platform {
            mount: Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0),
            r_p_b: Vector3::new(0.0, 0.0, 0.4),
            r_pc_p: Vector3::new(0.0, 0.0, 0.02),
            passive: platform::PerJoint::of([slide, corner, slide, turn, turn, turn]),
            ..Platform::bare(6.0, diagonal(0.1, 0.1, 0.15))
        },
        suspension: Suspension::none(),
        carried: (ReactionWheel { r_w_b: Vector3::new(-0.1, 0.0, 0.0), ..wheel }, iso),
    };
    let mut panel = HingedPanel {
        r_p_b: Vector3::new(0.5, 0.0, 0.0),
        r_pc_p: Vector3::new(0.5, 0.0, 0.0),
        ..HingedPanel::bare_panel(4.0, diagonal(0.2, 0.3, 0.5))
    };
    panel.passive.panel = Passive::spring(40.0, 0.0);
    let craft = Spacecraft::new(&hub, &(panel, base)).expect("accepted");
    let mut state: State<TypedSet> = State::at_rest();
    state.omega = Vector3::new(0.02, -0.01, 0.03);
    state.devices.0.phi = 0.01;
    let of_base = &mut state.devices.1;
    (of_base.carrier.x, of_base.carrier.alpha_dot) = (0.0001, 0.002);
    of_base.carried.0.spin = 90.0;
    let of_iso = &mut of_base.carried.1;
    (of_iso.carrier.x, of_iso.carrier.gamma_dot) = (0.0002, 0.003);
    (of_iso.carried[0].spin, of_iso.carried[1].spin) = (120.0, -110.0);
    let mut inputs: Inputs<TypedSet> = Inputs::none();
    inputs.motors.1.carried.1.carrier.f_z = 0.2;
    inputs.modes.1.carried.1.carrier.y_turn = Mode::Locked;
    (craft, state, inputs)
}

pub(super) fn ran(text: &str) -> Samples {
    let mut samples = Samples::default();
    run(&read(text), &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    samples
}

/// The three components of a column at a sample.
fn vector(samples: &Samples, name: &str, at: usize) -> Vector3<f64> {
    let component = |axis: &str| {
        let column = samples.column(&format!("{name}_{axis}"));
        column.unwrap_or_else(|| panic!("no {name}_{axis}"))[at]
    };
    Vector3::new(component("x"), component("y"), component("z"))
}

#[test]
fn a_run_of_two_platforms_is_that_of_the_nested_set_to_the_bit() {
    let scenario = read(STACKED);
    assert_eq!(scenario.names, NAMES);
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
        assert_eq!(found, typed);
    }
    assert_eq!(steps, 50);
}

#[test]
fn loads_of_both_platforms_are_those_of_the_library() {
    let samples = ran(STACKED);
    let (craft, state, inputs) = typed();
    let found = craft.accelerations(&state, &inputs).expect("regular");
    let base = craft.loads(&state, &inputs, &found, LoadAxes::Body).expect("finite").devices.1;
    let (rw0, iso) = &base.carried;
    let first = |name: &str| vector(&samples, name, 0);
    assert_eq!(first("base.mount.force"), base.carrier.mount.force);
    assert_eq!(first("iso.mount.force"), iso.carrier.mount.force);
    assert_eq!(first("iso.mount.moment"), iso.carrier.mount.moment);
    assert_eq!(first("rw2.mount.force"), iso.carried[1].mount.force);
    // On all that stands on the outer platform: a wheel, and the inner platform at its place.
    let force = rw0.mount.force + iso.carrier.mount.force;
    assert_eq!(first("base.carried.force"), force);
    let at = |place: [f64; 3], force: &Vector3<f64>| Vector3::from(place).cross(force);
    let moment = rw0.mount.moment + at([-0.1, 0.0, 0.0], &rw0.mount.force);
    let of_iso = &iso.carrier.mount;
    let moment = moment + (of_iso.moment + at([0.1, 0.2, 0.05], &of_iso.force));
    assert!((first("base.carried.moment") - moment).norm() <= 1e-15 * moment.norm());
    assert!(of_iso.force.norm() > 1.0, "{of_iso:?}");
    assert_eq!(samples.column("iso.u_y").expect("a column")[0], iso.carrier.motors.y_turn);
}

pub(super) const WHEEL: &str = "[[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n\
    wheel = { mass = \"3 kg\", inertia = \"0.02, 0.01, 0.01 kg m^2\", centre_of_mass = \"0, 1e-4, 0 m\", \
    rate = \"120 rad/s\", torque = \"0.1 N m\" }\n";

pub(super) const RUN: &str = "[run]\nduration = \"0.05 s\"\nintegrator = \"rk4\"\nstep = \"1 ms\"\n[output]\nrate = \"1 kHz\"\n";

/// Everything that a platform on a platform may have.
fn everything() -> String {
    STACKED
        .replace("integrator = \"rk4\"\nstep = \"1 ms\"", "")
        .replace(
            "y_turn = { locked = true }",
            "y_turn = { acceleration = { sine = \"0.1 rad/s^2\", frequency = \"9 Hz\" }, lower_stop = \
             \"-9 deg\", upper_stop = \"9 deg\", at_stop = \"lock\" }\n\
             coupled.stiffness.slides = [\"9, 1, 0 N/m\", \"1, 9, 0 N/m\", \"0, 0, 9 N/m\"]",
        )
        .replace("columns = [", "columns = [\"tip\", ")
        + r#"[[platform.strut]]
position = "0.1, 0, 0 m"
direction = [0, 0, 1]
length = "0.1 m"
stiffness = "1000 N/m"
damping = "2 N s/m"
[[point]]
name = "tip"
on = "iso.platform"
position = "0.1, 0.2, 0.3 m"
[[at]]
time = "20 ms"
joint = "iso.x_slide"
brake = true
[[at]]
time = "30 ms"
joint = "iso.x_slide"
force = "0.1 N"
[[wrench]]
on = "iso.platform"
force = "0, 1, 0 N"
axes = "inertial"
[[crossing]]
column = "iso.z"
value = "1 um"
[[requirement]]
name = "inner"
quantity = "iso.gamma"
statistic = "peak"
limit = "1 rad"
"#
}

#[test]
fn a_platform_on_a_platform_written_is_read_back_the_same() {
    let first = read(&everything());
    assert_eq!(first.names, NAMES);
    let written = to_toml(&first);
    assert!(written.contains("name = \"iso\"\non = \"base\"\n"), "{written}");
    let second = read(&written);
    assert_eq!(to_toml(&second), written);
    assert_eq!((&second.names, &second.devices), (&first.names, &first.devices));
    assert_eq!((&second.initial, &second.drives), (&first.initial, &first.drives));
    assert_eq!((&second.stops, &second.changes), (&first.stops, &first.changes));
    assert_eq!((&second.wrenches, &second.points), (&first.wrenches, &first.points));
    let [base] = &first.devices.1[..] else { panic!("one platform on the hub") };
    assert_eq!((base.carried.0.len(), base.carried.1[0].carried.len()), (1, 2));
    let set = precess::scenario::set_of(&first, &[1, 2, 3, 4, 5]);
    assert_eq!(set, (Vec::new(), first.devices.1.clone(), Vec::new()));
}

#[test]
fn everything_on_two_platforms_runs_and_the_ledger_closes() {
    let scenario = read(&everything());
    let mut samples = Samples::default();
    let outcome = run(&scenario, &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    // The tolerance of a step is 1e-10.
    assert!(outcome.drift.energy.is_some_and(|drift| drift < 1e-9), "{:?}", outcome.drift);
    assert!(outcome.energy_lost > 0.0);
    assert!(samples.rows.iter().flatten().all(|number| number.is_finite()));
    // From P of the inner platform, both slides along x at their places.
    let [base, iso] = [
        (Vector3::new(0.0, 0.0, 0.4), Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)),
        (Vector3::new(0.1, 0.2, 0.05), Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0)),
    ];
    let [outer, tip] = [Vector3::new(1e-4, 0.0, 0.0), Vector3::new(0.1002, 0.2, 0.3)];
    let expected = base.0 + base.1 * (outer + iso.0 + iso.1 * tip);
    assert!((vector(&samples, "tip.position", 0) - expected).norm() < 1e-15);
    let mut alone = scenario;
    alone.wrenches.clear();
    let outcome = run(&alone, &mut Samples::default(), &mut |_| ControlFlow::Continue(()));
    let drift = outcome.expect("a run").drift;
    for part in [drift.linear, drift.angular] {
        assert!(part.is_some_and(|part| part < 1e-9), "{drift:?}");
    }
}

/// Name and `on` of each platform, and what is shown.
type Case = (&'static [(&'static str, &'static str)], [&'static str; 2]);

#[test]
fn errors_of_what_stands_on_what_name_both_and_the_bound() {
    let plain = |name: &str, on: &str| {
        format!(
            "[[platform]]\nname = \"{name}\"\non = \"{on}\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n"
        )
    };
    let of = |platforms: &[(&str, &str)]| -> String {
        let platforms: String = platforms.iter().map(|(name, on)| plain(name, on)).collect();
        errors(&format!(
            "format = 1\n[hub]\nmass = \"300 kg\"\ninertia = \"90, 80, 60 kg m^2\"\n{WHEEL}on = \"a\"\n{platforms}{RUN}"
        ))
    };
    let cases: [Case; 7] = [
        (
            &[("a", "hub"), ("b", "a"), ("c", "b")],
            ["`c` on `b` on `a`: at most two platforms stand on one another", "write `on = \"a\"`"],
        ),
        (&[("a", "b"), ("b", "a")], ["`a` on `b` on `a`: platforms in a circle", "remove `on`"]),
        (&[("a", "a")], ["`a` stands on itself", "remove `on`"]),
        (&[("a", "hub"), ("b", "rw")], ["`rw` is a device: platforms stand on", "there are a;"]),
        (
            &[("a", "isolatr"), ("isolator", "hub")],
            ["no platform is named `isolatr`", "did you mean `isolator`?"],
        ),
        (&[("a", "sky")], ["no platform is named `sky`", "remove `on`: it stands on the hub"]),
        (&[("a", "sky"), ("b", "hub")], ["no platform is named `sky`", "there are b;"]),
    ];
    // Twenty in a circle: none of them is at the hub.
    let names: Vec<String> = (0..20).map(|k| format!("p{k}")).collect();
    let circle: Vec<_> = names.iter().zip(names.iter().cycle().skip(1)).collect();
    let circle: Vec<_> = circle.iter().map(|(a, b)| (a.as_str(), b.as_str())).collect();
    let shown = of(&circle);
    assert!(shown.contains("`p3` on `p4` on `p5`") && shown.contains("at most two"), "{shown}");
    for (platforms, parts) in cases {
        let shown = of(platforms);
        for part in parts {
            assert!(shown.contains(part), "`{part}` of {platforms:?}:\n{shown}");
        }
        assert!(
            shown.contains("test.toml:") && shown.matches("error: ").count() == 1,
            "{platforms:?}:\n{shown}"
        );
    }
}
