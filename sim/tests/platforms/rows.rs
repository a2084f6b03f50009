//! Rows of panels: the library's nested set to the bit, loads, momenta and energy, a locked row, the written
//! scenario, the frequency domain, and errors.

use std::ops::ControlFlow;

use nalgebra::Vector3;
use precess::engine::{Advance, Run, run};
use precess::file::to_toml;
use precess::record::Samples;
use precess::scenario::UndescribedError;
use precess_dynamics::kind::JointStates;
use precess_dynamics::{
    HingedPanel, Hub, Inputs, LoadAxes, OnPanel, Passive, ReactionWheel, Spacecraft, State,
    hinged_panel,
};

use super::stacked::{RUN, WHEEL, diagonal, ran};
use super::{errors, read};

/// A row of four panels with a wheel on the second, and a panel by itself. What is carried is written first.
const ROW: &str = r#"format = 1
[hub]
mass = "180 kg"
inertia = "40, 35, 30 kg m^2"
[initial]
angular_velocity = "0.02, -0.01, 0.03 rad/s"
[[device]]
name = "tip"
kind = "hinged_panel"
on = "third"
position = "1, 0, 0 m"
mount = { hinge_axis = [0, 0, 1] }
panel = { mass = "3 kg", centre_of_mass = "0.5, 0, 0 m", inertia = "0.2, 0.3, 0.5 kg m^2", stiffness = "8 N m/rad", angle = "0.2 rad" }
[[device]]
name = "third"
copy_of = "tip"
on = "second"
mount = { hinge_axis = [0, 1, 0] }
panel.angle = "-0.3 rad"
[[device]]
name = "rw"
kind = "reaction_wheel"
on = "second"
position = "0.2, 0.1, 0 m"
wheel = { mass = "3 kg", inertia = "0.02, 0.01, 0.01 kg m^2", centre_of_mass = "0, 1e-4, 0 m", rate = "120 rad/s" }
[[device]]
name = "second"
copy_of = "tip"
on = "first"
panel.angle = "0.4 rad"
panel.torque = "0.1 N m"
[[device]]
name = "first"
copy_of = "tip"
on = "hub"
position = "0.5, 0, 0 m"
mount = { hinge_axis = [1, 0, 0] }
panel.rate = "0.1 rad/s"
[[device]]
name = "other"
copy_of = "tip"
on = "hub"
position = "-0.5, 0, 0 m"
[run]
duration = "0.05 s"
integrator = "rk4"
step = "1 ms"
[output]
rate = "1 kHz"
columns = ["omega", "loads", "first", "second", "third", "tip", "rw", "other"]
"#;

const NAMES: [&str; 6] = ["other", "first", "second", "rw", "third", "tip"];

type Outer = (ReactionWheel, OnPanel<HingedPanel>);
type TypedSet = (HingedPanel, OnPanel<OnPanel<Outer>>);

/// The same craft in the library's own words.
fn typed() -> (Spacecraft<TypedSet>, State<TypedSet>, Inputs<TypedSet>) {
    let scenario = read(ROW);
    let hub = Hub { m_b: 180.0, r_bc_b: Vector3::zeros(), i_b_bc: diagonal(40.0, 35.0, 30.0) };
    let wheel = ReactionWheel {
        r_w_b: Vector3::new(0.2, 0.1, 0.0),
        d: 1e-4,
        ..ReactionWheel::bare_wheel(3.0, diagonal(0.02, 0.01, 0.01))
    };
    let panel = |name: &str, x: f64| {
        let at = scenario.names.iter().position(|known| known == name).expect("a panel");
        let (_, member) = scenario.members().nth(at).expect("a panel");
        HingedPanel {
            mount: member.mount(),
            r_p_b: Vector3::new(x, 0.0, 0.0),
            r_pc_p: Vector3::new(0.5, 0.0, 0.0),
            passive: hinged_panel::PerJoint { panel: Passive::spring(8.0, 0.0) },
            ..HingedPanel::bare_panel(3.0, diagonal(0.2, 0.3, 0.5))
        }
    };
    let third = OnPanel::on_panel(panel("third", 1.0), panel("tip", 1.0));
    let second = OnPanel::on_panel(panel("second", 1.0), (wheel, third));
    let devices = (panel("other", -0.5), OnPanel::on_panel(panel("first", 0.5), second));
    let craft = Spacecraft::new(&hub, &devices).expect("sound");
    let mut state: State<TypedSet> = State::at_rest();
    state.omega = Vector3::new(0.02, -0.01, 0.03);
    state.devices.0.phi = 0.2;
    let first = &mut state.devices.1;
    (first.carrier.phi, first.carrier.phi_dot) = (0.2, 0.1);
    first.carried.carrier.phi = 0.4;
    let (wheel, third) = &mut first.carried.carried;
    (wheel.spin, third.carrier.phi, third.carried.phi) = (120.0, -0.3, 0.2);
    let mut inputs: Inputs<TypedSet> = Inputs::none();
    inputs.motors.1.carried.carrier.u_p = 0.1;
    (craft, state, inputs)
}

#[test]
fn a_run_of_a_row_is_that_of_the_nested_set_to_the_bit() {
    let scenario = read(ROW);
    assert_eq!(scenario.names, NAMES);
    let (craft, mut state, inputs) = typed();
    let mut run = Run::new(&scenario).expect("a run");
    let mut steps = 0;
    while let Advance::Stepped = run.advance().expect("a step") {
        state = craft.step(&state, &inputs, 1e-3).expect("a step");
        steps += 1;
        let found = run.state();
        assert_eq!((found.r_b_n, found.omega), (state.r_b_n, state.omega));
        let typed: Vec<_> = state.devices.states().collect();
        let found: Vec<_> = found.devices.states().collect();
        assert_eq!(found, typed);
    }
    assert_eq!(steps, 50);
}

#[test]
fn loads_of_a_row_are_those_of_the_library() {
    let samples = ran(ROW);
    let (craft, state, inputs) = typed();
    let found = craft.accelerations(&state, &inputs).expect("regular");
    let first = craft.loads(&state, &inputs, &found, LoadAxes::Body).expect("finite").devices.1;
    let load = |name: &str| {
        let of = |axis| samples.column(&format!("{name}_{axis}")).expect("a column")[0];
        Vector3::new(of("x"), of("y"), of("z"))
    };
    let (wheel, third) = &first.carried.carried;
    assert_eq!(load("first.mount.force"), first.carrier.mount.force);
    assert_eq!(load("second.mount.moment"), first.carried.carrier.mount.moment);
    assert_eq!(load("rw.mount.force"), wheel.mount.force);
    assert_eq!(load("tip.panel.load_moment"), third.carried.joints.panel.moment);
    assert!(third.carried.mount.force.norm() > 0.01);
}

#[test]
fn momentum_of_a_row_is_conserved_and_the_ledger_closes_with_stops_and_locks() {
    let text = ROW.replace("integrator = \"rk4\"\nstep = \"1 ms\"", "").replace("0.05 s", "0.6 s")
        + "[[at]]\ntime = \"0.3 s\"\njoint = \"second.panel\"\nbrake = true\n\
           [[point]]\nname = \"edge\"\non = \"tip.panel\"\nposition = \"1, 0, 0 m\"\n";
    let text = text.replace("panel.angle = \"-0.3 rad\"", "panel.angle = \"-0.3 rad\"\npanel.upper_stop = \"-0.1 rad\"\npanel.lower_stop = \"-1 rad\"\npanel.at_stop = \"lock\"");
    let scenario = read(&text);
    let mut samples = Samples::default();
    let outcome = run(&scenario, &mut samples, &mut |_| ControlFlow::Continue(())).expect("a run");
    assert!(outcome.end.is_complete(), "{}", outcome.end);
    let drift = outcome.drift;
    for part in [drift.energy, drift.linear, drift.angular] {
        assert!(part.is_some_and(|part| part < 1e-9), "{drift:?}");
    }
    assert!(outcome.energy_lost > 0.0);
    assert!(samples.rows.iter().flatten().all(|number| number.is_finite()));
    let phi = samples.column("third.phi").expect("a column");
    assert!(phi.last().is_some_and(|phi| (phi + 0.1).abs() < 1e-15), "{:?}", phi.last());
}

#[test]
fn a_row_written_is_read_back_the_same() {
    let first = read(ROW);
    let written = to_toml(&first);
    assert!(written.contains("name = \"second\"\non = \"first\"\n"), "{written}");
    let second = read(&written);
    assert_eq!(to_toml(&second), written);
    assert_eq!((&second.names, &second.devices), (&first.names, &first.devices));
    let (on_hub, platforms, rows) = &first.devices;
    assert_eq!((on_hub.len(), platforms.len(), rows.len()), (1, 0, 1));
    assert!(first.devices_on_hub().is_none());
    let row = precess::scenario::set_of(&first, &[1]);
    assert_eq!(row, (Vec::new(), Vec::new(), rows.clone()));
}

#[test]
fn a_device_on_a_panel_has_no_description() {
    let error = read(ROW).description(false).err();
    assert_eq!(error, Some(UndescribedError::Carried("second".to_owned())));
    let text = error.map(|error| error.to_string()).unwrap_or_default();
    assert!(text.contains("second stands on another device") && text.contains("remove its `on`"));
}

/// A parameter of a panel that carries, by its name.
#[test]
fn parameters_of_a_carrying_panel_are_read_and_set() {
    let mut scenario = read(ROW);
    let all = precess::evaluation::Parameter::named(&scenario, &["second.m_p"]).expect("a name");
    assert_eq!(all[0].value(&scenario.hub, &scenario.devices), Some(3.0));
    let mut hub = scenario.hub;
    assert!(all[0].set(&mut hub, &mut scenario.devices, 4.0));
    assert_eq!(scenario.devices.2[0].carried.1[0].carrier.0.m_p, 4.0);
}

/// Panels, each with what it stands on; what else there is; parts of the message.
type Case<'a> = (&'a [(&'a str, &'a str)], String, [&'a str; 2]);

#[test]
fn errors_of_rows_name_the_row_and_the_bound() {
    let panel = |name: &str, on: &str| {
        format!(
            "[[device]]\nname = \"{name}\"\nkind = \"hinged_panel\"\non = \"{on}\"\n\
             panel = {{ mass = \"1 kg\", inertia = \"1, 1, 1 kg m^2\" }}\n"
        )
    };
    let platform = "[[platform]]\nname = \"iso\"\nmass = \"1 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n";
    let of = |panels: &[(&str, &str)], more: &str| -> String {
        let panels: String = panels.iter().map(|(name, on)| panel(name, on)).collect();
        errors(&format!(
            "format = 1\n[hub]\nmass = \"300 kg\"\ninertia = \"90, 80, 60 kg m^2\"\n{panels}{more}{RUN}"
        ))
    };
    let wheel = |on: &str| format!("{WHEEL}on = \"{on}\"\n");
    let cases: [Case; 9] = [
        (
            &[("a", "hub"), ("b", "a"), ("c", "b"), ("d", "c"), ("e", "d")],
            String::new(),
            ["`e` on `d` on `c` on `b` on `a` on `hub`: at most four panels", "remove `on`"],
        ),
        (&[("a", "b"), ("b", "a")], String::new(), ["panels in a circle", "remove `on`"]),
        (&[("a", "a")], String::new(), ["`a` stands on itself", "remove `on`"]),
        (
            &[("a", "iso"), ("b", "a")],
            platform.to_owned(),
            [
                "`b` on `a` on `iso`: a panel that carries devices stands on the hub",
                "let the platform carry the devices of the row one by one, or remove `on`",
            ],
        ),
        (
            &[("a", "rw"), ("b", "a")],
            wheel("hub"),
            ["`b` on `a` on `rw`: a panel that carries", "remove `on` of the panel"],
        ),
        (&[("a", "rw")], wheel("hub"), ["`rw` is no panel: devices stand on", "remove `on`"]),
        (&[], wheel("b"), ["no platform or panel is named `b`", "a `[[platform]]`"]),
        (
            &[("a", "hub")],
            wheel("b"),
            ["no platform or panel is named `b`", "there are a; without"],
        ),
        (&[("wing", "hub")], wheel("wng"), ["is named `wng`", "did you mean `wing`?"]),
    ];
    for (panels, more, parts) in cases {
        let shown = of(panels, &more);
        for part in parts {
            assert!(shown.contains(part), "`{part}` of {panels:?}:\n{shown}");
        }
        assert!(shown.contains("test.toml:"), "{panels:?}:\n{shown}");
        let is_on_platform = more.starts_with("[[platform]]");
        assert_eq!(shown.contains("let the platform"), is_on_platform, "{panels:?}:\n{shown}");
        // To add a platform is a remedy where the name is unknown, and nothing else is there.
        assert_eq!(shown.contains("add a `[[platform]]`"), panels.is_empty(), "{shown}");
    }
    // A circle is reported once, and what stands on one of it is not; so is one that stands on itself.
    for (panels, fault) in [
        (&[("c", "a"), ("a", "b"), ("b", "a")], "`a` on `b` on `a`: panels in a circle"),
        (&[("c", "a"), ("b", "a"), ("a", "a")], "`a` stands on itself"),
    ] {
        let shown = of(panels, "");
        assert!(shown.contains(fault), "{shown}");
        let count = shown.matches("in a circle").count() + shown.matches("on itself").count();
        assert!(count == 1 && !shown.contains("`c`"), "{shown}");
    }
}

/// A panel by its cantilevered mode, by itself and with a wheel that is held on it; a slosh mass.
#[test]
fn corner_frequencies_are_those_of_what_is_outboard_of_a_joint() {
    let text = r#"format = 1
[hub]
mass = "180 kg"
inertia = "40, 35, 30 kg m^2"
[[device]]
name = "panel"
kind = "hinged_panel"
panel = { mass = "8 kg", centre_of_mass = "0.3, 1, 0.2 m", inertia = "2.7, 0.6, 2.8 kg m^2", corner_frequency = "0.4 Hz", damping_ratio = 0.005, angle = "20 deg" }
[[device]]
name = "bare"
copy_of = "panel"
position = "0, 1, 0 m"
[[device]]
name = "rw"
kind = "reaction_wheel"
on = "panel"
position = "0.4, 0.1, 0.7 m"
wheel = { mass = "3 kg", inertia = "0.01, 0.01, 0.01 kg m^2", rate = "120 rad/s" }
[[device]]
name = "tank"
kind = "slosh_mass"
slosh_mass = { mass = "10 kg", corner_frequency = "0.5 Hz", damping_ratio = 0.01, displacement = "1 cm" }
[run]
duration = "0.05 s"
"#;
    let scenario = read(text);
    let axis = precess_dynamics::BuiltInKind::HingedPanel.joints()[0].axis;
    let about =
        |mass: f64, r: [f64; 3]| mass * (r.iter().map(|x| x * x).sum::<f64>() - r[axis] * r[axis]);
    let bare = [2.7, 0.6, 2.8][axis] + about(8.0, [0.3, 1.0, 0.2]);
    let with_wheel = bare + 0.01 + about(3.0, [0.4, 0.1, 0.7]);
    for (name, size, hertz, ratio) in
        [("bare", bare, 0.4, 0.005), ("panel", with_wheel, 0.4, 0.005), ("tank", 10.0, 0.5, 0.01)]
    {
        let mut members = scenario.members();
        let (_, member) = members.find(|(known, _)| *known == name).expect("a member");
        let spring = member.passive()[0];
        let omega = std::f64::consts::TAU * hertz;
        let expected = [size * omega * omega, 2.0 * ratio * size * omega];
        for (found, expected) in [spring.stiffness, spring.viscous].into_iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-12, "{name}: {found} {expected}");
        }
    }
    // What is written is the spring.
    let written = to_toml(&scenario);
    assert!(!written.contains("corner_frequency"), "{written}");
    assert_eq!(to_toml(&read(&written)), written);
    let both = text.replace("damping_ratio = 0.005", "stiffness = \"3 N m/rad\"");
    let shown = errors(&both);
    assert!(shown.contains("`stiffness` and `corner_frequency`"), "{shown}");
}
