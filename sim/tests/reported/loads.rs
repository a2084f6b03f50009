//! Loads about stated points, in stated axes, and what an evaluation says of them.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess::evaluation::Evaluator;
use precess::file::from_toml;
use precess::scenario::Scenario;
use precess_dynamics::BuiltInKind;

use super::{case, folder, precess};

/// Gravity, m/s², on a fixed hub: what stands still needs its weight, through its centre of mass.
const G: f64 = 10.0;

/// Masses of some kilograms at decimetres: rounding of 1e-16 of the terms; modes give by 1e-12.
const ROUNDING: f64 = 1e-10;

/// Turn of the platform about its x axis, and of the node, rad.
const TURNS: [f64; 2] = [0.3, 0.5];

/// The slides of the platform, m.
const SLID: [f64; 3] = [0.01, -0.02, 0.03];

/// Position of the device on the platform, m.
const ON_PLATFORM: [f64; 3] = [0.4, 0.1, -0.2];

fn read(text: &str) -> Scenario {
    let read = from_toml("reported", text, Path::new(""));
    let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}\n{text}"));
    scenario
}

/// A locked device of a kind: its tables, its mass and its centre of mass from its position, expressed
/// in its axes, every angle zero.
fn device(kind: BuiltInKind) -> (String, f64, Vector3<f64>) {
    let name = kind.name();
    let mut text = String::new();
    let (mut mass, mut first_moment) = (0.0, Vector3::zeros());
    let mut slid = Vector3::zeros();
    for info in kind.joints() {
        let body = info.body.replace(' ', "_");
        // A wheel whose kind keeps its rate is not locked.
        let locked = if info.driven { "locked = true" } else { "rate = \"0 rad/s\"" };
        if info.slides {
            let displacement = 0.01 * f64::from(u8::try_from(info.axis + 1).expect("an axis"));
            slid[info.axis] += displacement;
            let _ = writeln!(text, "{body}.displacement = \"{displacement} m\"");
        }
        let _ = writeln!(text, "{body}.{locked}");
        let bearing =
            body.ends_with("slide") || body.contains("_slide_") || body.starts_with("tilt");
        if bearing {
            continue;
        }
        let balanced = name.starts_with("balanced_");
        let (of_body, centre) = match body.as_str() {
            "wheel" if balanced => (2.0, Vector3::zeros()),
            "wheel" => (2.0, Vector3::new(0.0, 1e-3, 0.0)),
            "slosh_mass" => (2.0, Vector3::zeros()),
            _ => (3.0, Vector3::new(0.2, 0.3, 0.1)),
        };
        let _ = writeln!(text, "{body}.mass = \"{of_body} kg\"");
        if body != "slosh_mass" {
            let _ = writeln!(text, "{body}.inertia = \"0.3, 0.2, 0.2 kg m^2\"");
        }
        if centre != Vector3::zeros() {
            let [x, y, z]: [f64; 3] = centre.into();
            let _ = writeln!(text, "{body}.centre_of_mass = \"{x}, {y}, {z} m\"");
        }
        mass += of_body;
        first_moment += (centre + slid) * of_body;
    }
    (format!("kind = \"{name}\"\n{text}"), mass, first_moment / mass)
}

/// A fixed hub in a uniform field; a structure whose node has turned.
fn hub(structure: bool) -> String {
    let mut text = String::from(
        "format = 1\n[hub]\nmass = \"100 kg\"\ninertia = \"10, 10, 10 kg m^2\"\nmode = \"fixed\"\n\
         [gravity]\nuniform = \"0, 0, -10 m/s^2\"\n[run]\nduration = \"1 ms\"\n",
    );
    if structure {
        // So large a coordinate of so small a shape is held by its mass.
        let _ = writeln!(
            text,
            "[structure]\ncontains_devices = false\ncoordinates = [1e7]\n\
             [[structure.node]]\nname = \"w\"\nposition = \"0.3, 0, 0 m\"\n\
             [[structure.mode]]\nfrequency = \"1e-12 rad/s\"\n\
             shape = [{{ node = \"w\", translation = [0, 2e-9, 1e-9], rotation = [{}, 0, 0] }}]",
            TURNS[1] * 1e-7
        );
    }
    text
}

/// A locked platform, all coordinates of its slides and one turn beside zero.
fn platform(node: &str) -> String {
    let [x, y, z] = SLID;
    format!(
        "[[platform]]\nname = \"p\"\n{node}mass = \"4 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
         position = \"0.5, 0.1, 0.2 m\"\n\
         x_slide = {{ displacement = \"{x} m\", locked = true }}\n\
         y_slide = {{ displacement = \"{y} m\", locked = true }}\n\
         z_slide = {{ displacement = \"{z} m\", locked = true }}\n\
         x_turn = {{ angle = \"{} rad\", locked = true }}\n\
         y_turn = {{ locked = true }}\nz_turn = {{ locked = true }}\n",
        TURNS[0]
    )
}

/// The load at the mount of a member, and the axes that its columns are labelled with.
fn at_mount(text: &str, name: &str) -> ([Vector3<f64>; 2], String) {
    let evaluator = Evaluator::new(&read(text)).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let state = evaluator.initial();
    let inputs = evaluator.inputs(0.0, &state).expect("nothing sticks");
    let found = evaluator.accelerations(&state, &inputs).expect("a pose");
    let loads = evaluator.loads(&state, &inputs, &found).expect("loads");
    let columns = evaluator.load_columns();
    let place = |column: &str| columns.iter().position(|of| of.name == column).expect("a column");
    let vector = |what: &str| {
        let of = |axis: &str| loads[place(&format!("{name}.mount.{what}_{axis}"))];
        Vector3::new(of("x"), of("y"), of("z"))
    };
    let frame = columns[place(&format!("{name}.mount.force_x"))].frame.clone();
    ([vector("force"), vector("moment")], frame.expect("a frame"))
}

#[track_caller]
fn assert_load(
    found: &([Vector3<f64>; 2], String),
    (force, moment): (Vector3<f64>, Vector3<f64>),
    frame: &str,
    what: &str,
) {
    let ([of_force, of_moment], of_frame) = found;
    assert_eq!(of_frame, frame, "{what}");
    let unit = ROUNDING * force.norm();
    assert!((of_force - force).norm() <= unit, "{what}: force {of_force}, not {force}");
    assert!((of_moment - moment).norm() <= unit, "{what}: moment {of_moment}, not {moment}");
}

/// Of every kind on the hub, on a platform and on a node that has turned, and of the platform itself on
/// both: the weight, about `position`, in the axes that the column names.
#[test]
fn every_mount_load_is_about_its_position_in_the_axes_of_its_label() {
    let mount = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    let turn = |angle| *Rotation3::from_axis_angle(&Vector3::x_axis(), angle).matrix();
    let [of_platform, of_node] = TURNS.map(turn);
    let up = |mass: f64| Vector3::new(0.0, 0.0, mass * G);
    for kind in BuiltInKind::ALL {
        let (tables, mass, centre) = device(*kind);
        let arm = mount * centre;
        let placed = |on: &str| {
            let [x, y, z] = ON_PLATFORM;
            format!(
                "[[device]]\nname = \"d\"\n{on}position = \"{x}, {y}, {z} m\"\n\
                 mount = {{ dcm = [[0, -1, 0], [1, 0, 0], [0, 0, 1]] }}\n{tables}"
            )
        };
        let name = kind.name();
        let force = up(mass);
        let found = at_mount(&(hub(false) + &placed("")), "d");
        assert_load(&found, (force, arm.cross(&force)), "B", name);

        let found = at_mount(&(hub(true) + &placed("node = \"w\"\n")), "d");
        let moment = (of_node * arm).cross(&force);
        assert_load(&found, (force, moment), "B", &format!("{name} on a node"));

        for (structure, base, node) in
            [(false, Matrix3::identity(), ""), (true, of_node, "node = \"w\"\n")]
        {
            let what = format!("{name} on a platform, structure: {structure}");
            let text = hub(structure) + &platform(node) + &placed("on = \"p\"\n");
            let found = at_mount(&text, "d");
            let own = (base * of_platform).transpose() * force;
            assert_load(&found, (own, arm.cross(&own)), "p.platform", &what);

            let found = at_mount(&text, "p");
            let p = Vector3::from(SLID);
            let at_device = p + of_platform * (Vector3::from(ON_PLATFORM) + arm);
            let moment = (base * p).cross(&up(4.0)) + (base * at_device).cross(&force);
            assert_load(&found, (up(mass + 4.0), moment), "B", &format!("{what}: the platform"));
        }
    }
}

/// 2 kg moved by 0.1 m and 0.2 m along x and y, and 2 kg by 0.1 m along x, of 20 N each.
#[test]
fn moments_below_an_isolator_and_a_tank_are_about_their_positions() {
    let text = std::fs::read_to_string(case("locked-isolator-and-tank.toml")).expect("the case");
    for (name, moment) in [("iso", [4.0, -2.0, 0.0]), ("tank", [0.0, -2.0, 0.0])] {
        let found = at_mount(&text, name);
        assert_load(&found, (Vector3::new(0.0, 0.0, 20.0), moment.into()), "B", name);
    }
}

/// A balanced rotor has no axes of its own: its loads are in those of its parent body, and of the first
/// body of a device these are the device's, not the hub's.
#[test]
fn loads_of_a_balanced_rotor_are_labelled_with_the_mount() {
    let text = hub(false)
        + "[[device]]\nname = \"rw\"\nkind = \"balanced_reaction_wheel\"\n\
           mount = { spin_axis = [0, 0, 1] }\n\
           wheel = { mass = \"3 kg\", inertia = \"0.02, 0.01, 0.01 kg m^2\", angle = \"1 rad\" }\n\
           [[device]]\nname = \"gyro\"\nkind = \"balanced_vscmg\"\n\
           gimbal = { mass = \"1 kg\", inertia = \"0.1, 0.1, 0.1 kg m^2\" }\n\
           wheel = { mass = \"1 kg\", inertia = \"0.02, 0.01, 0.01 kg m^2\" }\n";
    let evaluator = Evaluator::new(&read(&text)).expect("accepted");
    let frame = |name: &str| {
        let column = evaluator.load_columns().iter().find(|column| column.name == name);
        column.and_then(|column| column.frame.clone()).expect("a frame")
    };
    assert_eq!(frame("rw.wheel.load_force_x"), "mount of rw");
    assert_eq!(frame("gyro.wheel.load_force_x"), "parent body of gyro.wheel");
    assert_eq!(frame("gyro.gimbal.load_force_x"), "gyro.gimbal");
    let state = evaluator.initial();
    let inputs = evaluator.inputs(0.0, &state).expect("nothing sticks");
    let found = evaluator.accelerations(&state, &inputs).expect("a pose");
    let loads = evaluator.loads(&state, &inputs, &found).expect("loads");
    let along = |axis: &str| {
        let name = format!("rw.wheel.load_force_{axis}");
        loads[evaluator.load_columns().iter().position(|of| of.name == name).expect("a column")]
    };
    // Up is x of the mount.
    assert_eq!([along("x"), along("y"), along("z")], [30.0, 0.0, 0.0]);
}

/// A run solves a pose in which what is locked, or prescribed, has no inertia; so does `check`.
#[test]
fn check_solves_what_a_run_solves() {
    let folder = folder("locked-poses");
    let out = folder.to_str().expect("a path");
    for name in ["locked-pendulum.toml", "locked-gyro.toml", "prescribed-pendulum.toml"] {
        let checked = precess(&["check", &case(name)]);
        assert_eq!(checked.code, Some(0), "{}", checked.error);
        assert!(!checked.error.contains("cannot be solved"), "{name}: {}", checked.error);
        assert!(checked.out.contains("condition number of the mass matrix"), "{name}");
        let ran = precess(&["run", &case(name), "--out", out]);
        assert_eq!(ran.code, Some(0), "{name}: {}", ran.error);
    }
    // And does not solve what a run does not.
    let released = ["--set", "platform.p.z_turn.locked=false"];
    let checked = precess(&[&["check", &case("locked-pendulum.toml")], &released[..]].concat());
    assert!(
        checked.error.contains("the initial state cannot be solved: `p`: pivot"),
        "{}",
        checked.error
    );
    assert_eq!(checked.code, Some(1));
    let run = ["run", &case("locked-pendulum.toml"), "--out", out, "--force"];
    assert_eq!(precess(&[&run[..], &released[..]].concat()).code, Some(1));
}

/// The velocity of B cancels that of the turn about it: momentum is zero but for rounding, in units of
/// `m (|v_B| + |omega x c|)`, 120 kg m/s. So does the energy of a hub without inertia of its own.
#[test]
fn drift_is_counted_in_units_that_do_not_cancel() {
    let text = "format = 1\n[hub]\nmass = \"100 kg\"\ncentre_of_mass = \"0.3, 0, 0 m\"\n\
                inertia = \"10, 10, 10 kg m^2\"\n[initial]\nangular_velocity = \"0, 0, 2 rad/s\"\n\
                velocity = \"0, -0.6, 0 m/s\"\n[run]\nduration = \"1 s\"\n";
    let small = text.replace("10, 10, 10 kg m^2", "1e-6, 1e-6, 1e-6 kg m^2");
    for text in [text, &small] {
        let mut samples = precess::record::Samples::default();
        let outcome = precess::engine::run(&read(text), &mut samples, &mut |_| {
            std::ops::ControlFlow::Continue(())
        });
        let drift = outcome.expect("a run").drift;
        for of in [drift.energy, drift.linear, drift.angular] {
            assert!(of.is_some_and(|of| of < 1e-11), "{drift:?}");
        }
    }
}

/// A point mass has no inertia about itself, and the rounding of the parallel axes none either: at any
/// place.
#[test]
fn a_point_mass_that_the_model_contains_is_accepted_anywhere() {
    for number in 0..200_u32 {
        let along = |step: f64| (f64::from(number) * step).fract() * 4.0 - 2.0;
        let [x, y, z] = [0.618_033_988_7, 0.324_717_957_2, 0.220_744_084_6].map(along);
        let mass = 0.5 + 20.0 * (f64::from(number) * 0.754_877_666).fract();
        let text = format!(
            "format = 1\n[hub]\nmass = \"400 kg\"\ninertia = \"320, 310, 290 kg m^2\"\n\
             [structure]\ncontains_devices = true\n\
             [[structure.node]]\nname = \"tank\"\nposition = \"{x}, {y}, {z} m\"\n\
             [[structure.mode]]\nfrequency = \"10 Hz\"\n\
             shape = [{{ node = \"tank\", translation = [0, 0, 0.05] }}]\n\
             [[device]]\nname = \"slosh\"\nkind = \"slosh_mass\"\nnode = \"tank\"\n\
             slosh_mass = {{ mass = \"{mass} kg\", stiffness = \"18 N/m\", displacement = \"3 mm\" }}\n\
             [run]\nduration = \"1 s\"\n"
        );
        let evaluator = Evaluator::new(&read(&text)).unwrap_or_else(|error| panic!("{error}"));
        let state = evaluator.initial();
        evaluator
            .accelerations(&state, &evaluator.inputs(0.0, &state).expect("nothing sticks"))
            .expect("solved");
    }
}

/// Residual flexibility about the axis of a wheel that turns freely moves no mass: refused by `check`
/// and in the name of the wheel; a locked wheel moves.
#[test]
fn residual_flexibility_about_a_free_spin_axis_is_refused_by_name() {
    let file = case("residual-about-spin-axis.toml");
    let checked = precess(&["check", &file]);
    assert_eq!(checked.code, Some(1), "{}", checked.out);
    assert!(
        checked
            .error
            .contains("rw.wheel turns freely, so node `w` moves no inertia about that axis"),
        "{}",
        checked.error
    );
    let locked = ["--set", "device.rw.wheel.rate='0 rpm'", "--set", "device.rw.wheel.locked=true"];
    let checked = precess(&[&["check", &file], &locked[..]].concat());
    assert_eq!(checked.code, Some(0), "{}", checked.error);
    // Across the axis there is mass.
    let across = [
        "--set",
        "structure.mode=[{ frequency = '30 Hz', shape = [{ node = 'w', translation \
                   = [0, 0, 0.05] }] }, { residual = true, frequency = '1 rad/s', damping = 0.05, \
                   shape = [{ node = 'w', rotation = [0, 1e-3, 0] }] }]",
    ];
    let checked = precess(&[&["check", &file], &across[..]].concat());
    assert_eq!(checked.code, Some(0), "{}", checked.error);
}

/// A pendulum of two turns whose y turn is at 90 degrees: the y turn is named, and its angle.
#[test]
fn a_y_turn_at_ninety_degrees_is_named() {
    let file = case("turn-at-right-angle.toml");
    let folder = folder("right-angle");
    let ran = precess(&["run", &file, "--out", folder.to_str().expect("a path")]);
    assert_eq!(ran.code, Some(1), "{}", ran.out);
    let said = ran.out + &ran.error;
    assert!(said.contains("`p`: its y turn is at 90"), "{said}");
    assert!(said.contains("away from 90 deg"), "{said}");
    let checked = precess(&["check", &file]);
    assert!(checked.error.contains("with the y turn at 90 degrees"), "{}", checked.error);
}
