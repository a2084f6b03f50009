//! Kernels of one spacecraft against the general solver, on random states: every mode, errors
//! included.

mod emitted;
mod general;

use std::path::Path;

use precess_description::Description;
use precess_tests::blocks::largest;
use precess_tests::bounds::ACCELERATIONS_WORST;

use general::{Drawn, Found, Joint, drawn, expected, general};

/// Random states of each spacecraft.
const STATES: u32 = 300;

fn description(name: &str) -> Description {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    let text = std::fs::read_to_string(file.join("description.toml")).expect("a description");
    Description::read(&text).expect("a description")
}

/// The largest error of a block, in units of its largest magnitude.
fn off(found: &[f64], expected: &[f64]) -> f64 {
    let scale = largest(expected.iter().copied());
    let errors = found.iter().zip(expected).map(|(found, expected)| (found - expected).abs());
    let worst = largest(errors);
    // An acceleration that is given is exactly that, zero included.
    if scale > 0.0 { worst / scale } else { worst }
}

/// A device of the emitted crate.
macro_rules! device {
    ($mission:ident::$shape:ident, $of:expr $(, $locked:ident: $k:literal)*) => {{
        let of: &precess_description::Device = $of;
        $mission::$shape::Device {
            mount: of.mount,
            bodies: std::array::from_fn(|k| $mission::Body {
                mass: of.body[k].mass,
                origin: of.body[k].origin,
                centre_of_mass: of.body[k].centre_of_mass,
                inertia: of.body[k].inertia,
            }),
            $($locked: of.body[$k].locked_at.unwrap_or_default(),)*
        }
    }};
}

macro_rules! hub {
    ($mission:ident, $of:expr) => {
        $mission::Hub {
            mass: $of.hub.mass,
            centre_of_mass: $of.hub.centre_of_mass,
            inertia: $of.hub.inertia,
        }
    };
}

macro_rules! drive {
    ($mission:ident, $of:expr) => {
        if $of.torque {
            $mission::Drive::Torque($of.given)
        } else {
            $mission::Drive::Acceleration($of.given)
        }
    };
}

/// A state of a mission's wheels and what acts on them.
macro_rules! given {
    ($mission:ident, $shape:ident, $drawn:expr, $wheel:expr) => {{
        let (drawn, wheel): (&Drawn, _) = ($drawn, $wheel);
        let state = $mission::State {
            omega: drawn.omega,
            $shape: std::array::from_fn(|k| {
                let Joint { at: [theta, spin], .. } = wheel(k);
                $mission::$shape::Joints { theta, spin }
            }),
        };
        let inputs = $mission::Inputs {
            force: drawn.force,
            torque_b: drawn.torque_b,
            $shape: std::array::from_fn(|k| $mission::$shape::Drives {
                u_w: drive!($mission, wheel(k)),
            }),
        };
        (state, inputs)
    }};
}

/// Holds every random state of a spacecraft against the general solver.
fn agree(name: &str, description: &Description, found: impl Fn(&[Drawn]) -> Vec<Option<Found>>) {
    let spacecraft = general(description);
    let states: Vec<_> = (0..STATES).map(|seed| drawn(description, seed)).collect();
    let (mut worst, mut solved) = (0.0_f64, 0);
    for (seed, (drawn, found)) in states.iter().zip(found(&states)).enumerate() {
        let expected = expected(&spacecraft, description, drawn);
        assert_eq!(found.is_some(), expected.is_some(), "{name}: state {seed} has accelerations");
        let (Some(found), Some(expected)) = (found, expected) else { continue };
        solved += 1;
        let joint = |all: &[Vec<f64>], k: usize| -> Vec<f64> {
            all.iter().filter_map(|device| device.get(k).copied()).collect()
        };
        let mut errors = vec![off(&found.0, &expected.0), off(&found.1, &expected.1)];
        errors.extend((0..3).map(|k| off(&joint(&found.2, k), &joint(&expected.2, k))));
        worst = worst.max(largest(errors));
    }
    assert!(solved > STATES / 2, "{name}: only {solved} states have accelerations");
    assert!(worst <= ACCELERATIONS_WORST, "{name}: off by {worst:e}");
    println!("{name}: {solved} states, worst {worst:.1e} of the block");
}

/// What a function of one state finds of each.
fn of_each(found: impl Fn(&Drawn) -> Option<Found>) -> impl Fn(&[Drawn]) -> Vec<Option<Found>> {
    move |states| states.iter().map(&found).collect()
}

#[test]
fn imaging_satellite_with_locked_gimbals() {
    let description = description("imaging_satellite");
    let devices = &description.device;
    let baked = imaging_satellite::Spacecraft::new(&imaging_satellite::Parameters {
        hub: hub!(imaging_satellite, description),
        cmg: std::array::from_fn(
            |k| device!(imaging_satellite::cmg, &devices[k], gamma_o: 0, gamma_i: 1),
        ),
    })
    .expect("as assumed");
    let found = of_each(|drawn| accelerations(&baked, drawn));
    agree("imaging_satellite", &description, found);
}

/// Those of four DGVSCMGs of which only the wheels move.
fn accelerations(baked: &imaging_satellite::Spacecraft, drawn: &Drawn) -> Option<Found> {
    let wheel = |k: usize| drawn.joints[k][2];
    let (state, inputs) = given!(imaging_satellite, cmg, drawn, wheel);
    let found = baked.accelerations(&state, &inputs).ok()?;
    let joints = found.cmg.iter().map(|own| vec![0.0, 0.0, own.spin_dot]);
    Some((found.r_b_n_ddot, found.omega_dot, joints.collect()))
}

#[test]
fn folded_values_give_the_bits_of_the_constructor() {
    let description = description("imaging_satellite");
    let devices = &description.device;
    let values = imaging_satellite::Spacecraft::new(&imaging_satellite::Parameters {
        hub: hub!(imaging_satellite, description),
        cmg: std::array::from_fn(
            |k| device!(imaging_satellite::cmg, &devices[k], gamma_o: 0, gamma_i: 1),
        ),
    })
    .expect("as assumed");
    // The digits of a number tell its bits, the sign of a zero included.
    assert_eq!(emitted::folded(), format!("{values:?}"));
    let states: Vec<_> = (0..STATES).map(|seed| drawn(&description, seed)).collect();
    let expected: Vec<_> = states.iter().map(|drawn| accelerations(&values, drawn)).collect();
    let found = emitted::found("imaging_satellite_constants", &states);
    for (seed, (found, expected)) in found.iter().zip(&expected).enumerate() {
        assert_eq!(format!("{found:?}"), format!("{expected:?}"), "state {seed}");
    }
}

#[test]
fn parked_spare_with_a_device_and_a_panel_in_the_hub() {
    let found = |states: &[Drawn]| emitted::found("parked_spare", states);
    agree("parked_spare", &description("parked_spare"), found);
}

#[test]
fn table1_with_every_joint_free() {
    let found = |states: &[Drawn]| emitted::found("table1", states);
    agree("table1", &description("table1"), found);
}

#[test]
fn four_wheels_each_with_a_kernel_of_its_own() {
    let description = description("four_wheels");
    let devices = &description.device;
    let baked = four_wheels::Spacecraft::new(&four_wheels::Parameters {
        hub: hub!(four_wheels, description),
        wheel_x: [device!(four_wheels::wheel_x, &devices[0])],
        wheel_y: [device!(four_wheels::wheel_y, &devices[1])],
        wheel_z: [device!(four_wheels::wheel_z, &devices[2])],
        wheel_skew: [device!(four_wheels::wheel_skew, &devices[3])],
    })
    .expect("as assumed");
    let found = of_each(|drawn| {
        macro_rules! joints {
            ($shape:ident, $k:literal) => {{
                let [theta, spin] = drawn.joints[$k][0].at;
                [four_wheels::$shape::Joints { theta, spin }]
            }};
        }
        macro_rules! drives {
            ($shape:ident, $k:literal) => {
                [four_wheels::$shape::Drives { u_w: drive!(four_wheels, drawn.joints[$k][0]) }]
            };
        }
        let state = four_wheels::State {
            omega: drawn.omega,
            wheel_x: joints!(wheel_x, 0),
            wheel_y: joints!(wheel_y, 1),
            wheel_z: joints!(wheel_z, 2),
            wheel_skew: joints!(wheel_skew, 3),
        };
        let inputs = four_wheels::Inputs {
            force: drawn.force,
            torque_b: drawn.torque_b,
            wheel_x: drives!(wheel_x, 0),
            wheel_y: drives!(wheel_y, 1),
            wheel_z: drives!(wheel_z, 2),
            wheel_skew: drives!(wheel_skew, 3),
        };
        let found = baked.accelerations(&state, &inputs).ok()?;
        let all = [
            found.wheel_x[0].spin_dot,
            found.wheel_y[0].spin_dot,
            found.wheel_z[0].spin_dot,
            found.wheel_skew[0].spin_dot,
        ];
        Some((found.r_b_n_ddot, found.omega_dot, all.map(|own| vec![own]).to_vec()))
    });
    agree("four_wheels", &description, found);
}

#[test]
fn an_angle_that_is_no_number_is_an_error_in_both() {
    let description = description("table1");
    let mut drawn = drawn(&description, 1);
    drawn.joints[0][0].at[0] = f64::NAN;
    assert!(expected(&general(&description), &description, &drawn).is_none());
    assert!(matches!(emitted::found("table1", &[drawn]).as_slice(), [None]));
}
