//! Derivatives carried through the steps against those of a run over dual numbers.

use std::path::Path;

use precess_craft::tangent::WIDTH;

use super::chain::ChainCraft;
use super::dual::DualCraft;
use super::parameters::slopes;
use super::run::{Samples, Times, run};
use crate::file::from_toml;
use crate::record::{Columns, Header};
use crate::scenario::Scenario;

/// Largest difference of the derivatives of a column by a key, of the largest of them.
const NEAR: f64 = 1e-10;

/// An imbalanced wheel that is driven, one of given acceleration, a locked gimbal and a panel on a spring.
const SCENARIO: &str = r#"
format = 1
[hub]
mass = "{mass} kg"
inertia = "4, 3.5, 3 kg m^2"
products_of_inertia = "0.1, {product}, -0.2 kg m^2"
centre_of_mass = "1, {centre}, -1 mm"
[gravity]
uniform = "0.1, 0, -0.2 m/s^2"
[initial]
position = "{position}, 2, 3 m"
velocity = "0.1, {velocity}, 0.3 m/s"
attitude = { axis = [1, 2, 3], angle = "{turn} deg" }
angular_velocity = "0.3, {omega}, 0.1 deg/s"
[[device]]
name = "rw"
kind = "reaction_wheel"
position = "30, {place}, -5 cm"
mount = { spin_axis = [0.2, {axis}, 1] }
imbalance = { static = "10 g cm", dynamic = "{dynamic} g cm^2", phase = "{phase} deg" }
[device.wheel]
mass = "{wheel} kg"
inertia = "288, 150, 150 kg cm^2"
rate = "{rate} rpm"
torque = "{torque} mN m"
damping = "{damping} mN m s/rad"
[[device]]
name = "cmg"
kind = "vscmg"
position = "-20, 10, 5 cm"
imbalance = { static = "4 g cm", dynamic = "50 g cm^2" }
[device.gimbal]
mass = "2 kg"
inertia = "90, 70, 80 kg cm^2"
angle = "{gimbal} deg"
locked = true
[device.wheel]
mass = "3 kg"
inertia = "200, 110, 110 kg cm^2"
rate = "2400 rpm"
acceleration = "{acceleration} rad/s^2"
[[device]]
name = "panel"
kind = "hinged_panel"
position = "0, 0.6, 0 m"
[device.panel]
mass = "12 kg"
inertia = "3, 1, 4 kg m^2"
centre_of_mass = "0, {panel}, 0 m"
stiffness = "{stiffness} N m/rad"
angle = "{angle} deg"
[run]
duration = "0.02 s"
integrator = "rk4"
step = "1 ms"
[output]
rate = "1.5 kHz"
"#;

/// Keys, with the middle of each and a step.
const KEYS: [(&str, f64, f64); 20] = [
    ("mass", 60.0, 0.1),
    ("product", 0.15, 1e-3),
    ("centre", 2.0, 0.1),
    ("position", 1.0, 1e-2),
    ("velocity", 0.2, 1e-3),
    ("turn", 40.0, 0.5),
    ("omega", -0.2, 0.01),
    ("place", 10.0, 0.1),
    ("axis", 0.3, 0.01),
    ("dynamic", 200.0, 1.0),
    ("phase", 40.0, 0.5),
    ("wheel", 4.0, 0.01),
    ("rate", 3000.0, 3.0),
    ("torque", 5.0, 0.05),
    ("damping", 0.1, 0.001),
    ("gimbal", 20.0, 0.2),
    ("acceleration", 3.0, 0.03),
    ("panel", 0.8, 0.002),
    ("stiffness", 200.0, 1.0),
    ("angle", 3.0, 0.02),
];

/// With one of the keys changed.
fn scenario(changed: usize, change: f64) -> Scenario {
    let mut text = SCENARIO.to_owned();
    for (index, (key, middle, _)) in KEYS.iter().enumerate() {
        let value = middle + if index == changed { change } else { 0.0 };
        text = text.replace(&format!("{{{key}}}"), &format!("{value:?}"));
    }
    from_toml("differentiated", &text, Path::new("")).unwrap_or_else(|errors| panic!("{errors}")).0
}

/// Those of all keys.
fn all_slopes() -> Vec<Vec<f64>> {
    let of = |(index, (_, _, step)): (usize, &(&str, f64, f64))| {
        let at = |steps: i32| Ok(scenario(index, f64::from(steps) * step));
        slopes(&at, *step).expect("it is differentiated")
    };
    KEYS.iter().enumerate().map(of).collect()
}

/// The derivatives of a column by a key.
fn column(samples: &[Samples], column: usize, key: usize) -> Vec<f64> {
    let of = samples[key / WIDTH].iter();
    of.map(|(_, row)| row[column].derivative(key % WIDTH)).collect()
}

#[test]
fn derivatives_through_steps_are_those_of_dual_numbers() {
    let middle = scenario(0, 0.0);
    let columns = Columns::from_scenario(&middle).expect("columns");
    let header = Header::new(&middle, &columns);
    let (times, slopes) = (Times::new(&middle).expect("times"), all_slopes());
    let craft = ChainCraft::new(&middle, &slopes).expect("a spacecraft").expect("it is supported");
    let found = run(craft.start(), &times, &header).expect("samples");
    let mut expected = Vec::new();
    for keys in slopes.chunks(WIDTH) {
        let craft = DualCraft::new(&middle, keys).expect("a spacecraft");
        expected.extend(run(craft.start(), &times, &header).expect("samples"));
    }
    assert_eq!(found.len(), expected.len());
    let (mut worst, mut compared) = (0.0_f64, 0);
    for (place, of) in header.columns.iter().enumerate() {
        for (key, (name, ..)) in KEYS.iter().enumerate() {
            let (found, expected) = (column(&found, place, key), column(&expected, place, key));
            let largest = expected.iter().fold(0.0_f64, |largest, of| largest.max(of.abs()));
            if !expected.iter().all(|of| of.is_finite()) || largest == 0.0 {
                continue;
            }
            compared += 1;
            for (found, expected) in found.iter().zip(&expected) {
                let apart = (found - expected).abs() / largest;
                assert!(apart <= NEAR, "{} by {name}: {found:e}, {expected:e}", of.name);
                worst = worst.max(apart);
            }
        }
    }
    println!("{compared} columns by keys, worst {worst:e} of the largest");
    assert!(compared > 200, "{compared}");
    // Values are those of the same steps.
    for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
        for (found, expected) in found.1.iter().zip(&expected.1) {
            let near = (found.value - expected.value).abs() <= NEAR * expected.value.abs().max(1.0);
            assert!(near || expected.value.is_nan(), "{} {}", found.value, expected.value);
        }
    }
}

#[test]
fn what_has_dual_numbers_only_is_not_carried_through_steps() {
    let none = |text: &str, to: &str| {
        let text = SCENARIO.replace(text, to);
        let mut values = text;
        for (key, middle, _) in KEYS {
            values = values.replace(&format!("{{{key}}}"), &format!("{middle:?}"));
        }
        let read = from_toml("differentiated", &values, Path::new(""));
        let scenario = read.unwrap_or_else(|errors| panic!("{errors}")).0;
        let none: Vec<Vec<f64>> = vec![Vec::new()];
        ChainCraft::new(&scenario, &none).expect("a spacecraft").is_none()
    };
    assert!(!none("uniform", "uniform"));
    assert!(none(r#"uniform = "0.1, 0, -0.2 m/s^2""#, r#"central = "398600.4418 km^3/s^2""#));
}
