//! The page docs/imbalance-map.md: the error of the simplified model over inertia ratio, speed and flexibility, gimbal rate
//! and offset.

use std::fmt::Write as _;
use std::path::Path;

use nalgebra::{Matrix3, Vector3};
use precess::file::from_toml;
use precess::jitter::budget::{Budget, Sight};
use precess::jitter::coupled::compare;
use precess::jitter::device::Steady;
use precess::jitter::model::{HUB, Model, Output};
use precess::jitter::simplified::error;
use precess::jitter::sweep::Phases;
use precess::pointing::LineOfSight;
use precess::scenario::{ModalStructure, RecordedPoint, Scenario, StructureNode};
use precess::structure::Mode;
use precess::structure::dynamic_mass::Motor;
use precess_dynamics::{
    Hub, HubMode, Inputs, LoadAxes, Mode as JointMode, Sgcmg, Spacecraft, State,
};

const STEADY: Steady<'static> =
    Steady { motor: Motor::ConstantTorque, sprung: true, swept: Some(&[]) };
/// The wheel of every row: kg, kg m².
pub(crate) const MASS: f64 = 6.0;
pub(crate) const SPIN: f64 = 0.0191;
pub(crate) const ACROSS: f64 = 0.0114;
/// Ratios of the wheel's inertia about its axis to that of the hub across it.
pub(crate) const INERTIA_RATIOS: [f64; 8] = [1e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.2, 0.3];
/// Speed over the natural frequency of the bracket with the wheel at rest.
pub(crate) const SPEED_RATIOS: [f64; 8] = [0.2, 0.5, 0.8, 0.9, 0.97, 1.0, 1.1, 1.5];
/// Share of the bracket's modal mass that is the wheel's inertia across its axis.
pub(crate) const SHARES: [f64; 4] = [1e-3, 0.01, 0.1, 0.3];
/// Damping ratio of the bracket.
pub(crate) const DAMPING: f64 = 0.005;
/// Gimbal rate over the speed.
pub(crate) const GIMBAL_RATIOS: [f64; 7] = [1e-4, 1e-3, 3e-3, 0.005, 0.015, 0.05, 0.1];
/// Offset of the wheel's centre of mass by its radius of gyration across the axis.
pub(crate) const OFFSETS: [f64; 5] = [1e-4, 1e-3, 0.01, 0.03, 0.1];
/// Speed of the rows without another, rad/s.
const SPEED: f64 = 300.0;

fn scenario(hub: &str, imbalance: &str) -> Result<Scenario, String> {
    let text = format!(
        "format = 1\n[hub]\n{hub}\n[[device]]\nname = \"rw\"\nkind = \"reaction_wheel\"\n\
         mount = {{ spin_axis = [1, 0, 0] }}\nimbalance = {{ {imbalance} }}\n[device.wheel]\n\
         mass = \"{MASS} kg\"\ninertia = \"{SPIN}, {ACROSS}, {ACROSS} kg m^2\"\nrate = \"{SPEED} rad/s\"\n\
         [run]\nduration = \"1 s\"\n"
    );
    from_toml("map", &text, Path::new("")).map(|(scenario, _)| scenario).map_err(|e| e.to_string())
}

fn outputs(node: &str) -> Vec<Output> {
    let output = |axis: usize| {
        let mut row = [0.0; 6];
        row[axis] = 1.0;
        Output { name: axis.to_string(), terms: vec![(node.to_owned(), row)] }
    };
    (0..6).map(output).collect()
}

/// Error of displacement and of rotation at a node, at some speeds.
fn errors(scenario: &Scenario, node: &str, speeds: &[f64]) -> Result<Vec<[f64; 2]>, String> {
    let model = Model::new(scenario, &outputs(node), &STEADY).map_err(|e| e.to_string())?;
    let simple = model.simplified(scenario).map_err(|e| e.to_string())?;
    let at = |speed: &f64| {
        let coupled = model.lines(*speed).map_err(|e| e.to_string())?;
        let usual = simple.lines(*speed).map_err(|e| e.to_string())?;
        Ok([error(&coupled, &usual, &[0, 1, 2]), error(&coupled, &usual, &[3, 4, 5])])
    };
    speeds.iter().map(at).collect()
}

/// Rotation of a rigid hub by the dynamic imbalance, over the inertia ratio.
pub(crate) fn by_inertia(ratio: f64) -> Result<f64, String> {
    let across = SPIN / ratio;
    let hub = format!(
        "mass = \"{} kg\"\ninertia = \"{across}, {across}, {across} kg m^2\"",
        100.0 * MASS
    );
    Ok(errors(&scenario(&hub, "dynamic = \"2.2 g cm^2\"")?, HUB, &[SPEED])?[0][1])
}

/// Displacement of a rigid hub by the static imbalance of a wheel at its centre.
pub(crate) fn by_mass(ratio: f64) -> Result<f64, String> {
    let mass = MASS / ratio;
    let hub = format!("mass = \"{mass} kg\"\ninertia = \"{mass}, {mass}, {mass} kg m^2\"");
    Ok(errors(&scenario(&hub, "static = \"0.15 g cm\"")?, HUB, &[SPEED])?[0][0])
}

/// Rotation of the camera by the dynamic imbalance of a wheel on a bracket that turns about two axes across the spin axis:
/// two equal modes of a hub of 1e6 kg.
pub(crate) fn by_speed(speed_ratio: f64, share: f64) -> Result<f64, String> {
    Ok(by_speeds(&[speed_ratio], share)?[0])
}

/// The same at some speeds.
pub(crate) fn by_speeds(speed_ratios: &[f64], share: f64) -> Result<Vec<f64>, String> {
    let hub = "mass = \"1e6 kg\"\ninertia = \"1e6, 1e6, 1e6 kg m^2\"";
    let mut scenario = scenario(hub, "dynamic = \"2.2 g cm^2\"")?;
    // The mode turns the wheel by r for a modal coordinate of 1: with the wheel, a modal mass of 1 + J_t r^2.
    let turn = (share / (1.0 - share) / ACROSS).sqrt();
    let natural = SPEED * (1.0 + ACROSS * turn * turn).sqrt();
    let mode = Mode {
        frequency: natural,
        damping: DAMPING,
        linear: Vector3::zeros(),
        angular: Vector3::zeros(),
    };
    let shape = |axis: usize, turn: f64| {
        let mut shape = [0.0; 6];
        shape[axis] = turn;
        shape
    };
    let node = |name: &str, turn: f64| StructureNode {
        name: name.to_owned(),
        position: Vector3::zeros(),
        shapes: vec![shape(4, turn), shape(5, turn)],
    };
    scenario.structure = Some(ModalStructure {
        modes: vec![mode, mode],
        residual: 0,
        nodes: vec![node("rw", turn), node("camera", 0.1 * turn)],
        on_node: vec![0],
        contains_devices: false,
        points: vec![RecordedPoint { name: "camera".into(), node: 1 }],
        coordinates: vec![0.0; 2],
        rates: vec![0.0; 2],
    });
    let speeds: Vec<f64> = speed_ratios.iter().map(|ratio| SPEED * ratio).collect();
    let found = errors(&scenario, "camera", &speeds)?;
    Ok(found.into_iter().map(|[_, rotation]| rotation).collect())
}

/// Force of a gyro with static imbalance on a table while its gimbal turns: error of `U_s Omega^2` that turns with the
/// gimbal, RMS over a turn of the wheel, over the RMS of the force without its mean.
pub(crate) fn by_gimbal(ratio: f64) -> Result<f64, String> {
    let mut gyro =
        Sgcmg::bare_wheel(MASS, Matrix3::from_diagonal(&Vector3::new(SPIN, ACROSS, ACROSS)));
    gyro.d = 2.5e-6;
    gyro.m_g = 2.0;
    gyro.i_g_gc = Matrix3::from_diagonal_element(0.02);
    let hub =
        Hub { m_b: 100.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::from_diagonal_element(10.0) };
    let craft = Spacecraft::new(&hub, &gyro).map_err(|e| e.to_string())?;
    let (mut apart, mut whole) = (0.0, 0.0);
    let angles = 32;
    for step in 0..angles {
        let theta = std::f64::consts::TAU * f64::from(step) / f64::from(angles);
        let mut state: State<Sgcmg> = State::at_rest();
        (state.devices.theta, state.devices.spin) = (theta, SPEED);
        state.devices.gamma_dot = ratio * SPEED;
        let mut inputs: Inputs<Sgcmg> = Inputs::none();
        inputs.hub = HubMode::Fixed;
        inputs.modes.gimbal = JointMode::Prescribed(0.0);
        let found = craft.accelerations(&state, &inputs).map_err(|e| e.to_string())?;
        let loads =
            craft.loads(&state, &inputs, &found, LoadAxes::Hub).map_err(|e| e.to_string())?;
        // The centre of mass is at d (0, cos theta, sin theta): what holds the mount is U_s Omega^2 towards the axis.
        let size = -MASS * gyro.d * SPEED * SPEED;
        let usual = Vector3::new(0.0, size * theta.cos(), size * theta.sin());
        apart += (loads.hub.force - usual).norm_squared();
        whole += loads.hub.force.norm_squared();
    }
    Ok((apart / whole).sqrt())
}

/// Rotation of a light hub by the static imbalance of a wheel beside its centre, by a run of the coupled equations: error of
/// the simplified and of the linear model.
pub(crate) fn by_offset(ratio: f64) -> Result<[f64; 2], String> {
    let offset = ratio * (ACROSS / MASS).sqrt();
    let hub = "mass = \"60 kg\"\ninertia = \"2, 1.8, 1.9 kg m^2\"";
    let imbalance = format!("static = \"{} kg m\"", MASS * offset);
    let mut scenario = scenario(hub, &imbalance)?;
    if let Some(precess_dynamics::BuiltIn::ReactionWheel(wheel)) = scenario.devices.0.first_mut() {
        wheel.r_w_b = Vector3::new(0.3, 0.1, 0.0);
    }
    let sight = LineOfSight::rigid(HUB, &Vector3::x(), &Vector3::y()).map_err(|e| e.to_string())?;
    let budget = Budget {
        title: String::new(),
        speeds: [SPEED, 2.0 * SPEED],
        count: 2,
        swept: Vec::new(),
        phases: Phases::Given,
        motor: Motor::ConstantTorque,
        sprung: true,
        sights: vec![Sight { name: "hub".into(), line: sight }],
        limits: Vec::new(),
    };
    let run = compare(&scenario, &budget, SPEED).map_err(|e| e.to_string())?;
    let model = Model::new(&scenario, &budget.outputs(), &STEADY).map_err(|e| e.to_string())?;
    let usual = model.simplified(&scenario).map_err(|e| e.to_string())?;
    let usual = usual.lines(SPEED).map_err(|e| e.to_string())?;
    let (mut by_usual, mut by_linear, mut whole) = (0.0, 0.0, 0.0);
    for (line, (_, values)) in usual.iter().zip(&run.lines) {
        for (usual, [linear, found]) in line.values.iter().zip(values) {
            by_usual += (found - usual).norm_sqr();
            by_linear += (found - linear).norm_sqr();
            whole += found.norm_sqr();
        }
    }
    Ok([by_usual, by_linear].map(|square: f64| (square / whole).sqrt()))
}

/// A share as a cell: bold from 1 %, with what it exceeds.
pub(crate) fn cell(error: f64) -> String {
    let percent = 100.0 * error;
    let digits = match percent {
        p if p >= 99.95 => format!("{p:.0} %"),
        p if p >= 9.995 => format!("{p:.1} %"),
        p if p >= 0.0095 => format!("{p:.2} %"),
        _ => String::from("< 0.01 %"),
    };
    match percent {
        p if p > 10.0 => format!("**{digits}** (> 10)"),
        p if p > 3.0 => format!("**{digits}** (> 3)"),
        p if p > 1.0 => format!("**{digits}** (> 1)"),
        _ => digits,
    }
}

/// The page.
pub(crate) fn page() -> Result<String, String> {
    let mut text = String::from(HEAD);
    text.push_str("## Mass and inertia of the rotor\n\n");
    text.push_str(INERTIA);
    text.push_str("\n| ratio | displacement, static imbalance, `m_w / m_hub` | rotation, dynamic imbalance, `J_s / I_hub` |\n|---:|---:|---:|\n");
    for ratio in INERTIA_RATIOS {
        let _ = writeln!(
            text,
            "| {ratio} | {} | {} |",
            cell(by_mass(ratio)?),
            cell(by_inertia(ratio)?)
        );
    }
    text.push_str("\n## Speed and flexibility\n\n");
    text.push_str(FLEXIBLE);
    text.push_str(PICTURE);
    text.push_str("\n| speed over natural frequency |");
    for share in SHARES {
        let _ = write!(text, " share {share} |");
    }
    text.push_str("\n|---:|---:|---:|---:|---:|\n");
    for ratio in SPEED_RATIOS {
        let _ = write!(text, "| {ratio} |");
        for share in SHARES {
            let _ = write!(text, " {} |", cell(by_speed(ratio, share)?));
        }
        text.push('\n');
    }
    text.push_str("\n## Gimbal rate\n\n");
    text.push_str(GIMBAL);
    text.push_str("\n| gimbal rate over speed | error |\n|---:|---:|\n");
    for ratio in GIMBAL_RATIOS {
        let _ = writeln!(text, "| {ratio} | {} |", cell(by_gimbal(ratio)?));
    }
    text.push_str("\n## Offset\n\n");
    text.push_str(OFFSET);
    text.push_str("\n| offset over radius of gyration | simplified | linear, gyroscopic |\n|---:|---:|---:|\n");
    for ratio in OFFSETS {
        let [usual, linear] = by_offset(ratio)?;
        let _ = writeln!(text, "| {ratio} | {} | {} |", cell(usual), cell(linear));
    }
    text.push_str(TAIL);
    Ok(text)
}

const HEAD: &str = "\
<!-- @generated by `cargo run --release -p precess --example imbalance_map`; do not edit. -->

# Where `U_s Omega^2` errs

The usual model of a wheel's vibration puts the forces of its imbalance, `U_s Omega^2` and `U_d Omega^2`, on a spacecraft
whose wheels are rigid bodies at rest. This page compares it with the coupled equations: by how much it errs, and why.

**The error.** Of the complex amplitudes of the three displacements, or the three rotations, of the node that is named, at the
frequency of the wheel: root of the sum of squares of the differences, over the root of the sum of squares of the coupled ones. The
band is that one line. Where a row says so, the quantity is a force or a run in time. Bold: more than 1, 3 or 10 %.

**The wheel** has 6 kg, `J_s` = 0.0191 and `J_t` = 0.0114 kg m² and spins freely; a row without another speed is at 300 rad/s.

";
const INERTIA: &str = "\
A wheel at the centre of a rigid hub. Its mass is in both models, so the displacement has no error however heavy it is. The rotation
has one: a moment that turns with the rotor feels `I + J_t - J_s`, because the momentum of the rotor turns with the
hub, and the usual model has `I + J_t`. The error is `J_s / (I + J_t)`, at every speed.
";
const FLEXIBLE: &str = "\
A wheel on a bracket that turns about both axes across the spin axis, with 0.5 % of critical damping, on a heavy hub; rotation of
a camera on the bracket. The share is that of the wheel's inertia `J_t` in the modal mass. Gyroscopic moments split the mode into
two whirls. A dynamic imbalance excites the forward one alone, which lies where the modal mass would have `J_t - J_s`
instead of `J_t`; for this disc that is higher. Near the natural frequency of the wheel at rest the usual model has a peak that is not there.
";
const PICTURE: &str = "
![Error over speed and share, with contours of 1, 3 and 10 %](imbalance-map.svg)
";
const GIMBAL: &str = "\
Force on a table of a gyro with static imbalance whose gimbal turns at a constant rate. The centre of mass moves in a frame that
turns: `2 gimbal rate x velocity` is a force along the spin axis, `2 gamma' / Omega` of the usual force in the amplitude of one
axis of two, and a centrifugal term is smaller by another such factor. The error is `sqrt 2 gamma' / Omega` for small rates. Hubs that turn
while they point are far below these ratios; agile gyros near the lower end.
";
const OFFSET: &str = "\
A wheel 0.3 m along its spin axis and 0.1 m beside it from the centre of a hub of 60 kg and 2 kg m²; rotation of the hub across the
spin axis, in a run of the coupled, nonlinear equations. The simplified model errs by its missing momentum, whatever the offset; the linear model with gyroscopic terms errs
by the square of the offset over the radius of gyration, 0.044 m: imbalances of real wheels (micrometres) are at the top of the table.
";
const TAIL: &str = "
## Three cells by hand

`sim/tests/jitter/map.rs` derives one cell of each of three tables by hand: `J_s / (I + J_t)`; for the bracket with modal mass
`1 + J_t r^2`, the ratio of `k - (1 + (J_t - J_s) r^2) Omega^2 + i c Omega` to `k - (1 + J_t r^2) Omega^2 + i c Omega`; and for the gimbal the
acceleration `r'' + 2 w x r' + w x (w x r)` of a point of the rotor. It also makes this page and its picture again.
";
