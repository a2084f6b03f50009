//! The imaging satellite with twenty modes: its file, and its run.

use precess::file::structure_from_file;
use precess::scenario::IntegratorChoice;
use precess::structure::Structure;
use precess::structure::accelerance::{Accelerance, Base};

use super::satellite_modes::{MODES, structure};
use super::{columns, file, folder, ran};

/// Eigenvalues of the same matrices by other roundings, relative.
const FREQUENCY_MISS: f64 = 1e-9;
/// Accelerances of the nodes, of the largest element.
const ACCELERANCE_MISS: f64 = 1e-6;

/// The committed file is what the program of its header computes: the same frequencies, and
/// accelerances, on which the signs of the modes have no influence.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn the_file_is_what_its_program_writes() {
    let found =
        structure_from_file(&folder().join("imaging-satellite-modes.npz")).expect("the file");
    let made = structure().expect("a positive definite mass matrix");
    assert_eq!((found.modes.len(), found.nodes.len()), (MODES, 6));
    assert_eq!(found.nodes, made.nodes);
    for (a, b) in found.modes.iter().zip(&made.modes) {
        assert!((a.frequency / b.frequency - 1.0).abs() < FREQUENCY_MISS, "{a:?} {b:?}");
    }
    let at: Vec<usize> = (0..found.nodes.len()).collect();
    for frequency in [50.0, 300.0, 628.0, 900.0] {
        let of = |structure: &Structure| {
            let accelerance = Accelerance::new(structure, Base::Free, &at, &at).expect("nodes");
            accelerance.at(frequency).expect("off resonance")
        };
        let (a, b) = (of(&found), of(&made));
        let miss = (&a - &b).camax() / b.camax();
        assert!(miss < ACCELERANCE_MISS, "{frequency} rad/s: {miss:e}");
    }
}

/// Rigid modes are left out, so the shapes at the nodes carry no momentum; 900 kg, and the checks
/// of `precess structure show` hold.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn the_model_is_sound() {
    let structure = structure().expect("a positive definite mass matrix");
    let mass = structure.mass.expect("the file has a mass");
    assert!((mass.mass - 900.0).abs() < 1e-9, "{}", mass.mass);
    for check in structure.checks() {
        assert_ne!(check.holds(), Some(false), "{}", check.claim);
    }
    let hertz: Vec<_> =
        structure.modes.iter().map(|mode| mode.frequency / std::f64::consts::TAU).collect();
    assert!(hertz.windows(2).all(|pair| pair[0] < pair[1]), "{hertz:?}");
    // The wheels' 100 Hz is within the modes.
    assert!(hertz[0] < 100.0 && 100.0 < hertz[MODES - 1], "{hertz:?}");
}

/// The gyros are at their nodes, the hub is the file's, momentum and energy are conserved, and the
/// camera sees more than the rigid satellite does.
#[test]
#[ignore = "long: `cargo xtask test --all`"]
fn the_run_conserves_and_amplifies() {
    let mut scenario = file("imaging-satellite-flexible.toml");
    scenario.settings.duration = 0.2;
    scenario.settings.integrator = IntegratorChoice::Dop853 { tolerance: 1e-11 };
    scenario.requirements.clear();
    let structure = scenario.structure.clone().expect("a structure");
    assert!((scenario.hub.m_b - 900.0).abs() < 1e-9);
    for (device, node) in scenario.devices.0.iter().zip(&structure.on_node) {
        let origin = nalgebra::Vector3::from(device.parameters().bodies[0].origin);
        assert!((origin - structure.nodes[*node].position).norm() < 1e-9, "{origin}");
    }
    let (samples, outcome) = ran(&scenario);
    println!("{:?}", outcome.drift);
    let drifts = [outcome.drift.energy, outcome.drift.linear, outcome.drift.angular];
    assert!(drifts.iter().all(|drift| drift.is_some_and(|drift| drift < 1e-9)), "{drifts:?}");
    let peak = |names: [&str; 3]| {
        let rows = columns(&samples, names);
        rows.iter().map(|row| row.map(|v| v * v).iter().sum::<f64>().sqrt()).fold(0.0, f64::max)
    };
    let camera = peak(["camera.omega_x", "camera.omega_y", "camera.omega_z"]);
    let mut rigid = scenario.clone();
    rigid.structure = None;
    rigid.output.columns = vec!["omega".to_owned()];
    let rows = columns(&ran(&rigid).0, ["omega_x", "omega_y", "omega_z"]);
    let norms = rows.iter().map(|row| row.map(|v| v * v).iter().sum::<f64>().sqrt());
    let rigid = norms.fold(0.0, f64::max);
    println!("camera {camera:e} rad/s, rigid hub {rigid:e} rad/s");
    assert!(camera > 1.5 * rigid, "{camera:e} {rigid:e}");
}
