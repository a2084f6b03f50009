//! The time of a sweep of 1000 speeds: four wheels with fifty tones each that share the frequencies, on a structure of a
//! hundred modes; on one core. `cargo bench -p precess --bench jitter`

use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use nalgebra::Vector3;
use precess::file::from_toml;
use precess::jitter::device::Steady;
use precess::jitter::model::{Model, Output};
use precess::jitter::sweep::{speeds, sweep};
use precess::scenario::{ModalStructure, RecordedPoint, Scenario, StructureNode};
use precess::structure::Mode;
use precess::structure::dynamic_mass::Motor;

const MODES: usize = 100;
const TONES: u32 = 50;
const SPEEDS: usize = 1000;

fn scenario() -> Scenario {
    let mut text = String::from(
        "format = 1\n[hub]\nmass = \"900 kg\"\ninertia = \"400, 350, 300 kg m^2\"\n[run]\nduration = \"1 s\"\n",
    );
    for wheel in 0..4 {
        let _ = write!(
            text,
            "[[device]]\nname = \"rw{wheel}\"\nkind = \"reaction_wheel\"\n\
             position = \"{}, {}, -60 cm\"\nmount = {{ spin_axis = [{}, {}, 1] }}\n\
             imbalance = {{ static = \"0.15 g cm\", dynamic = \"2.2 g cm^2\" }}\n[device.wheel]\n\
             mass = \"6 kg\"\ninertia = \"0.0191, 0.0114, 0.0114 kg m^2\"\nrate = \"3000 rpm\"\n",
            if wheel % 2 == 0 { 45 } else { -45 },
            if wheel < 2 { 45 } else { -45 },
            if wheel % 2 == 0 { 1 } else { -1 },
            if wheel < 2 { 1 } else { -1 },
        );
    }
    let (mut scenario, _) =
        from_toml("bench", &text, Path::new("")).unwrap_or_else(|e| panic!("{e}"));
    // Shapes that are of the size of a bus, with no pattern: the cost does not depend on them.
    let mut seed = 1_u64;
    let mut draw = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(seed >> 40).unwrap_or(0)) / f64::from(1 << 24) - 0.5
    };
    let mode = |k: usize| Mode {
        frequency: 50.0 * 1.04_f64.powi(i32::try_from(k).unwrap_or(0)),
        damping: 0.005,
        linear: Vector3::zeros(),
        angular: Vector3::zeros(),
    };
    let mut node = |name: &str, position: Vector3<f64>| StructureNode {
        name: name.to_owned(),
        position,
        shapes: (0..MODES).map(|_| std::array::from_fn(|_| 0.05 * draw())).collect(),
    };
    let mut nodes: Vec<StructureNode> = (0..4)
        .map(|k| {
            let sign = |bit: u32| if k & bit == 0 { 0.45 } else { -0.45 };
            node(&format!("rw{k}"), Vector3::new(sign(1), sign(2), -0.6))
        })
        .collect();
    nodes.push(node("camera", Vector3::new(0.0, 0.0, 0.8)));
    scenario.structure = Some(ModalStructure {
        modes: (0..MODES).map(mode).collect(),
        residual: 0,
        nodes,
        on_node: vec![0, 1, 2, 3],
        contains_devices: false,
        points: vec![RecordedPoint { name: "camera".into(), node: 4 }],
        coordinates: vec![0.0; MODES],
        rates: vec![0.0; MODES],
    });
    scenario
}

fn main() {
    let scenario = scenario();
    let axis = |k: usize| {
        let mut row = [0.0; 6];
        row[3 + k] = 1.0;
        Output { name: format!("camera {k}"), terms: vec![("camera".into(), row)] }
    };
    let steady = Steady { motor: Motor::ConstantTorque, sprung: true, swept: Some(&[]) };
    let start = Instant::now();
    let mut model =
        Model::new(&scenario, &[axis(0), axis(1)], &steady).unwrap_or_else(|e| panic!("{e}"));
    for (_, device) in &mut model.devices {
        for tone in 2..=TONES {
            let order = 0.37 * f64::from(tone);
            let force = std::array::from_fn(|_| nalgebra::Complex::new(1e-9, 0.0));
            device.add_tone("bearing", 0, order, &force).unwrap_or_else(|e| panic!("{e}"));
        }
    }
    let made = start.elapsed();
    let begin = Instant::now();
    let range = [600.0, 6000.0].map(|rpm: f64| rpm * std::f64::consts::TAU / 60.0);
    let found = sweep(&model, &speeds(range, SPEEDS), 1, &|_| {}).unwrap_or_else(|e| panic!("{e}"));
    let lines: usize = found.lines.iter().map(Vec::len).sum();
    println!(
        "{} speeds, {} tones, {MODES} modes, one core: {lines} lines in {:.2} s, the model in {:.3} s",
        found.speeds.len(),
        model.contributors().len(),
        begin.elapsed().as_secs_f64(),
        made.as_secs_f64()
    );
}
