//! Points of bodies: their velocity and acceleration are the derivatives of where they are, on the hub, along the chain of
//! a platform and a gyro on it, and on a sliding mass; and what has a closed form.

use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use precess_craft::{Craft, CraftState, rigid_state};
use precess_dynamics::{Attitude as _, JointStates as _};

use super::last;
use crate::engine::equations::kinematics::{Chain, axes};
use crate::engine::equations::points::{Accelerations, PointMotion, point_motion};
use crate::file::from_toml;
use crate::scenario::{Scenario, Target};

/// A gyro on a platform, a sliding mass on the hub, and points on their bodies.
const MOVING: &str = r#"
format = 1
[hub]
mass = "60 kg"
inertia = "9, 8, 7 kg m^2"
centre_of_mass = "1, -2, 3 cm"
[initial]
position = "1, 2, 3 m"
velocity = "0.1, -0.2, 0.3 m/s"
angular_velocity = "0.2, -0.5, 0.4 rad/s"
attitude = { mrp = [0.1, -0.2, 0.3] }
[[platform]]
name = "iso"
mass = "4 kg"
inertia = "0.1, 0.2, 0.3 kg m^2"
position = "10, 20, 30 cm"
mount = { axis = [1, 2, 3], angle = "40 deg" }
x_slide = { displacement = "1 mm", speed = "0.02 m/s", stiffness = "1e4 N/m" }
y_slide = { stiffness = "1e4 N/m" }
z_slide = { speed = "-0.01 m/s", stiffness = "1e4 N/m" }
x_turn = { angle = "3 mrad", stiffness = "900 N m/rad" }
y_turn = { rate = "0.1 rad/s", stiffness = "900 N m/rad" }
z_turn = { rate = "0.2 rad/s", stiffness = "900 N m/rad" }
[[device]]
name = "cmg"
kind = "dgvscmg"
on = "iso"
position = "5, -6, 7 cm"
mount = { axis = [3, -1, 2], angle = "70 deg" }
imbalance = { static = "40 g cm" }
outer_gimbal = { mass = "2 kg", inertia = "0.02, 0.03, 0.04 kg m^2", angle = "20 deg", rate = "0.6 rad/s" }
inner_gimbal = { mass = "1 kg", inertia = "0.01, 0.02, 0.02 kg m^2", angle = "-50 deg", rate = "-0.8 rad/s" }
wheel = { mass = "3 kg", inertia = "0.02, 0.01, 0.01 kg m^2", angle = "10 deg", rate = "90 rad/s" }
[[device]]
name = "tank"
kind = "slosh_mass"
position = "-20, 10, 5 cm"
mount = { axis = [0, 1, 1], angle = "30 deg" }
slosh_mass = { mass = "5 kg", displacement = "2 cm", speed = "0.3 m/s", stiffness = "40 N/m" }
[[point]]
name = "of_hub"
position = "30, -20, 10 cm"
[[point]]
name = "of_platform"
on = "iso.platform"
position = "1, 2, 3 cm"
[[point]]
name = "of_gimbal"
on = "cmg.outer_gimbal"
position = "4, 5, -6 cm"
[[point]]
name = "of_wheel"
on = "cmg.wheel"
position = "0, 10, 0 cm"
[[point]]
name = "of_tank"
on = "tank.slosh_mass"
[run]
duration = "1 ms"
[output]
rate = "10 kHz"
"#;

fn read(text: &str) -> Scenario {
    let read = from_toml("points", text, Path::new(""));
    read.unwrap_or_else(|errors| panic!("{errors:?}")).0
}

/// The motion of each point, by the equations of motion.
fn motions(scenario: &Scenario, craft: &Craft, state: &CraftState) -> Vec<PointMotion> {
    let chains = Chain::all(&scenario.devices);
    let found = craft.accelerations(state, &craft.no_inputs()).expect("accelerations");
    let joints: Vec<_> = state.devices.states().collect();
    let of_joints: Vec<_> = precess_dynamics::Each::values(&found.devices).collect();
    let of = Accelerations { b: found.r_b_n_ddot, omega_dot: found.omega_dot, joints: of_joints };
    let points = scenario.points.iter();
    points.map(|point| point_motion(point, &chains, state, &joints, Some(&of))).collect()
}

#[test]
fn an_acceleration_is_along_the_axes_of_its_body() {
    let columns = crate::record::Columns::from_scenario(&read(MOVING)).expect("columns");
    let frame = |name: &str| {
        let column = columns.as_slice().iter().find(|column| column.name == name);
        column.and_then(|column| column.frame.clone()).expect("a frame")
    };
    for (point, body) in
        [("of_hub", "B"), ("of_platform", "iso.platform"), ("of_gimbal", "cmg.outer_gimbal")]
    {
        assert_eq!(frame(&format!("{point}.acceleration_x")), body);
        assert_eq!(frame(&format!("{point}.velocity_x")), "N");
    }
}

#[test]
fn velocity_and_acceleration_are_the_derivatives_of_the_place() {
    assert_derivatives(&read(MOVING));
}

/// The gyro on a platform on the platform, with a point on each body.
#[test]
fn points_of_a_platform_on_a_platform_move_as_their_derivatives() {
    let upper = r#"
[[platform]]
name = "upper"
on = "iso"
mass = "2 kg"
inertia = "0.05, 0.06, 0.07 kg m^2"
position = "3, -2, 8 cm"
mount = { axis = [-2, 1, 1], angle = "65 deg" }
x_slide = { displacement = "2 mm", stiffness = "1e4 N/m" }
y_slide = { speed = "0.03 m/s", stiffness = "1e4 N/m" }
z_slide = { stiffness = "1e4 N/m" }
x_turn = { rate = "-0.3 rad/s", stiffness = "900 N m/rad" }
y_turn = { angle = "20 mrad", stiffness = "900 N m/rad" }
z_turn = { rate = "0.1 rad/s", stiffness = "900 N m/rad" }
[[point]]
name = "of_upper"
on = "upper.platform"
position = "1, -2, 3 cm"
[[device]]
name = "cmg""#;
    let scenario = with_gyro_on("upper", upper);
    assert_eq!(scenario.names, ["tank", "iso", "upper", "cmg"]);
    assert_derivatives(&scenario);
}

/// The scenario with the gyro on what some tables, which end before the gyro's name, add.
fn with_gyro_on(base: &str, tables: &str) -> Scenario {
    let on_base = MOVING.replace("on = \"iso\"", &format!("on = \"{base}\""));
    read(&on_base.replace("\n[[device]]\nname = \"cmg\"", tables))
}

/// The gyro on the second of two panels in a row, with a point on that.
#[test]
fn points_of_panels_in_a_row_move_as_their_derivatives() {
    let panels = r#"
[[device]]
name = "inner"
kind = "hinged_panel"
position = "3, -2, 8 cm"
mount = { axis = [-2, 1, 1], angle = "65 deg" }
panel = { mass = "2 kg", inertia = "0.05, 0.06, 0.07 kg m^2", angle = "30 deg", rate = "0.4 rad/s" }
[[device]]
name = "outer"
copy_of = "inner"
on = "inner"
panel = { rate = "-0.7 rad/s" }
[[point]]
name = "of_outer"
on = "outer.panel"
position = "1, -2, 3 cm"
[[device]]
name = "cmg""#;
    let scenario = with_gyro_on("outer", panels);
    assert_eq!(scenario.names, ["tank", "iso", "inner", "outer", "cmg"]);
    assert_derivatives(&scenario);
}

/// Differences of fourth order, of steps in which the wheel turns by a hundredth: about 1e-9.
fn assert_derivatives(scenario: &Scenario) {
    let craft = Craft::from(scenario.spacecraft().expect("a spacecraft"));
    let state = rigid_state(scenario.initial.clone());
    let h = 1e-4;
    let at = |steps: i32| {
        let mut at = state.clone();
        for _ in 0..steps.abs() {
            let dt = h * f64::from(steps.signum());
            at = craft.step(&at, &craft.no_inputs(), dt).expect("a step");
        }
        motions(scenario, &craft, &at)
    };
    let [a, b, now, c, d] = [-2, -1, 0, 1, 2].map(at);
    let slope = |index: usize, of: fn(&PointMotion) -> Vector3<f64>| {
        let [a, b, c, d] = [&a, &b, &c, &d].map(|motions| of(&motions[index]));
        (8.0 * (c - b) - (d - a)) / (12.0 * h)
    };
    let chains = Chain::all(&scenario.devices);
    let joints: Vec<_> = state.devices.states().collect();
    for (index, (point, motion)) in scenario.points.iter().zip(&now).enumerate() {
        let velocity = slope(index, |motion| motion.position);
        let off = (velocity - motion.velocity).norm() / velocity.norm();
        assert!(off < 1e-8, "{}: velocity off by {off:e}", point.name);
        let axes = match point.body {
            Target::Joint(joint) => {
                let (chain, _, info) = scenario.joints().nth(joint).expect("a joint");
                axes(&chains, chain, info.index, &joints)
            }
            _ => Matrix3::identity(),
        };
        let of_n = slope(index, |motion| motion.velocity);
        let acceleration = axes.tr_mul(&(state.attitude.dcm() * of_n));
        let off = (acceleration - motion.acceleration).norm() / acceleration.norm();
        assert!(off < 1e-7, "{}: acceleration off by {off:e}", point.name);
    }
}

/// On a hub that is held, at a constant rate: `r w²` towards the axis, along the axes of the wheel.
#[test]
fn a_point_of_a_wheel_is_accelerated_towards_its_axis() {
    let scenario = read(
        r#"
format = 1
[hub]
mass = "60 kg"
inertia = "9, 8, 7 kg m^2"
mode = "fixed"
[[device]]
name = "rw"
kind = "reaction_wheel"
position = "10, 0, 0 cm"
wheel = { mass = "3 kg", inertia = "0.02, 0.01, 0.01 kg m^2", rate = "50 rad/s" }
[[point]]
name = "rim"
on = "rw.wheel"
position = "1, 8, 0 cm"
[run]
duration = "0.5 s"
[output]
rate = "100 Hz"
"#,
    );
    let (_, samples) = super::recorded(&scenario);
    let of = |what: &str| ["x", "y", "z"].map(|axis| last(&samples, &format!("rim.{what}_{axis}")));
    // 50 rad/s for 0.5 s: 25 rad about x.
    let (sin, cos) = 25.0_f64.sin_cos();
    for (found, expected) in [
        (of("position"), [0.11, 0.08 * cos, 0.08 * sin]),
        (of("velocity"), [0.0, -4.0 * sin, 4.0 * cos]),
        (of("acceleration"), [0.0, -200.0, 0.0]),
    ] {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-10, "{found} {expected}");
        }
    }
}
