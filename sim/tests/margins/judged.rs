//! Poles and margins against python-control: `tests/fixtures/loops.json`, which `tests/engines/loops.py` writes.

use nalgebra::{Complex, ComplexField as _};
use precess::margins::analysis::ControlLoop;
use serde_json::Value;

use super::{BUS, controller, loop_of, read};

const FIXTURE: &str =
    include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/fixtures/loops.json"));

/// Poles that are simple and well apart.
const POLES: f64 = 1e-9;
/// python-control finds crossings as roots of polynomials of high order.
const MARGINS: f64 = 1e-6;

fn number(of: &Value, key: &str) -> f64 {
    of[key].as_f64().unwrap_or_else(|| panic!("no {key} in {of}"))
}

/// The loop of a case: wheels, and a panel whose centre of mass is on its hinge at B.
fn closed(case: &Value) -> ControlLoop {
    let [delay, stiffness, damping, integral] =
        ["delay", "stiffness", "damping", "integral"].map(|key| number(case, key));
    let panel = format!(
        "[[device]]\nname = \"panel\"\nkind = \"hinged_panel\"\nmount = {{ hinge_axis = [0, 0, 1] }}\n\
         [device.panel]\nmass = \"5 kg\"\ncentre_of_mass = \"0, 0, 0 m\"\ninertia = \"3, 3, 3 kg m^2\"\n\
         stiffness = \"{stiffness} N m/rad\"\ndamping = \"{damping} N m s/rad\"\n"
    );
    let panel = if stiffness > 0.0 { panel } else { String::new() };
    let control = controller(&format!("delay = \"{delay} s\""));
    let gain = format!(
        "rate_gain = \"6 N m s\"\nintegral_gain = \"{integral} 1/(kg m^2)\"\nintegral_limit = \"1 N m s\"\n"
    );
    let control =
        if integral > 0.0 { control.replace("rate_gain = \"6 N m s\"\n", &gain) } else { control };
    loop_of(&read(&format!("{BUS}{panel}{control}")))
}

#[test]
fn poles_and_margins_are_those_of_python_control() {
    let document: Value = serde_json::from_str(FIXTURE).expect("JSON");
    let cases = document["cases"].as_array().expect("cases");
    assert_eq!(cases.len(), 12);
    let mut worst = [0.0_f64; 3];
    for case in cases {
        let found = closed(case);
        let poles = found.closed.poles().expect("poles");
        assert_eq!(found.closed.is_stable().ok(), case["stable"].as_bool(), "{case}");
        for pole in case["poles"].as_array().expect("poles") {
            let part = |k: usize| pole[k].as_f64().expect("a number");
            let pole = Complex::new(part(0), part(1));
            let apart = poles.iter().map(|of| (of - pole).modulus());
            let apart = apart.fold(f64::INFINITY, f64::min);
            worst[0] = worst[0].max(apart);
            assert!(apart < POLES, "{pole}: {apart:e} of {poles:?}\n{case}");
        }
        let axis = found.closed.margins().expect("poles").expect("stable")[2];
        let ends = [(axis.gain_up, "gain_up", 1.0), (axis.phase, "phase", 1.0_f64.to_degrees())];
        for ((own, key, unit), worst) in ends.into_iter().zip(&mut worst[1..]) {
            // That at half the rate of the samples is no crossing of python-control.
            let Some(stored) = case[key].as_array() else { continue };
            let value = own.expect(key).value * unit;
            let expected = stored[0].as_f64().expect("a number");
            // There it may be the smaller one.
            if key == "gain_up" && value < expected {
                continue;
            }
            let apart = (value / expected - 1.0).abs();
            *worst = worst.max(apart);
            assert!(apart < MARGINS, "{key}: {value} {expected}\n{case}");
        }
    }
    println!("poles {:e}, gain {:e}, phase {:e}", worst[0], worst[1], worst[2]);
}

/// The panel's oscillation is above half the rate of the samples: it is named with the frequency that they show.
#[test]
fn an_oscillation_above_half_the_rate_is_named_with_its_alias() {
    let document: Value = serde_json::from_str(FIXTURE).expect("JSON");
    let found = closed(&document["cases"][9]);
    let found = found.analysis().expect("an analysis");
    let stiff = found.oscillations.iter().find(|of| of.frequency > 2.0).expect("the panel");
    // sqrt(k / Ip (1 + Ip / I)) with the hub, whose wheel is free.
    let inertia = 10.0 + 0.02;
    let natural = (700.0_f64 / 3.0 * (1.0 + 3.0 / inertia)).sqrt() / std::f64::consts::TAU;
    assert!((stiff.frequency / natural - 1.0).abs() < 1e-9, "{} {natural}", stiff.frequency);
    assert!((stiff.alias - (4.0 - natural)).abs() < 1e-2, "{}", stiff.alias);
    let number = found.oscillations.iter().position(|of| of == stiff);
    assert!(found.poles.iter().any(|pole| pole.oscillation == number));
}
