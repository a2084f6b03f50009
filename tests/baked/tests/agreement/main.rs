//! Kernels of one spacecraft against the general solver, on random states: every mode, errors
//! included.

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
fn agree(name: &str, description: &Description, found: impl Fn(&Drawn) -> Option<Found>) {
    let spacecraft = general(description);
    let (mut worst, mut solved) = (0.0_f64, 0);
    for seed in 0..STATES {
        let drawn = drawn(description, seed);
        let expected = expected(&spacecraft, description, &drawn);
        let found = found(&drawn);
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
    agree("imaging_satellite", &description, |drawn| {
        let wheel = |k: usize| drawn.joints[k][2];
        let (state, inputs) = given!(imaging_satellite, cmg, drawn, wheel);
        let found = baked.accelerations(&state, &inputs).ok()?;
        let joints = found.cmg.iter().map(|own| vec![0.0, 0.0, own.spin_dot]);
        Some((found.r_b_n_ddot, found.omega_dot, joints.collect()))
    });
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
    let folded = &imaging_satellite_constants::SPACECRAFT;
    // The digits of a number tell its bits, the sign of a zero included.
    assert_eq!(format!("{values:?}"), format!("{folded:?}"));
    for seed in 0..STATES {
        let drawn = drawn(&description, seed);
        let wheel = |k: usize| drawn.joints[k][2];
        let (state, inputs) = given!(imaging_satellite, cmg, &drawn, wheel);
        let expected = values.accelerations(&state, &inputs);
        let (state, inputs) = given!(imaging_satellite_constants, cmg, &drawn, wheel);
        let found = folded.accelerations(&state, &inputs);
        assert_eq!(format!("{found:?}"), format!("{expected:?}"), "state {seed}");
    }
}

#[test]
fn parked_spare_with_a_device_and_a_panel_in_the_hub() {
    let description = description("parked_spare");
    let devices = &description.device;
    let baked = parked_spare::Spacecraft::new(&parked_spare::Parameters {
        hub: hub!(parked_spare, description),
        wheel: [0, 3].map(|k: usize| device!(parked_spare::wheel, &devices[k])),
        spare: [device!(parked_spare::spare, &devices[1], gamma: 0, theta: 1)],
        panel: [device!(parked_spare::panel, &devices[2], phi: 0)],
    })
    .expect("as assumed");
    agree("parked_spare", &description, |drawn| {
        let wheel = |k: usize| drawn.joints[[0, 3][k]][0];
        let (state, inputs) = given!(parked_spare, wheel, drawn, wheel);
        let found = baked.accelerations(&state, &inputs).ok()?;
        let [first, second] = found.wheel.map(|own| vec![own.spin_dot]);
        Some((found.r_b_n_ddot, found.omega_dot, vec![first, vec![0.0; 2], vec![0.0], second]))
    });
}

#[test]
fn table1_with_every_joint_free() {
    let description = description("table1");
    let baked = table1::Spacecraft::new(&table1::Parameters {
        hub: hub!(table1, description),
        cmg: [device!(table1::cmg, &description.device[0])],
    })
    .expect("as assumed");
    agree("table1", &description, |drawn| {
        let [o, i, w] = [0, 1, 2].map(|k| drawn.joints[0][k]);
        let joints = table1::cmg::Joints {
            gamma_o: o.at[0],
            gamma_o_dot: o.at[1],
            gamma_i: i.at[0],
            gamma_i_dot: i.at[1],
            theta: w.at[0],
            spin: w.at[1],
        };
        let drives = table1::cmg::Drives {
            u_o: drive!(table1, o),
            u_i: drive!(table1, i),
            u_w: drive!(table1, w),
        };
        let state = table1::State { omega: drawn.omega, cmg: [joints] };
        let inputs = table1::Inputs { force: drawn.force, torque_b: drawn.torque_b, cmg: [drives] };
        let found = baked.accelerations(&state, &inputs).ok()?;
        let [own] = found.cmg;
        let joints = vec![vec![own.gamma_o_ddot, own.gamma_i_ddot, own.spin_dot]];
        Some((found.r_b_n_ddot, found.omega_dot, joints))
    });
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
    agree("four_wheels", &description, |drawn| {
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
}

#[test]
fn an_angle_that_is_no_number_is_an_error_in_both() {
    let description = description("table1");
    let spacecraft = general(&description);
    let baked = table1::Spacecraft::new(&table1::Parameters {
        hub: hub!(table1, description),
        cmg: [device!(table1::cmg, &description.device[0])],
    })
    .expect("as assumed");
    let mut drawn = drawn(&description, 1);
    drawn.joints[0][0].at[0] = f64::NAN;
    assert!(expected(&spacecraft, &description, &drawn).is_none());
    let [o, i, w] = [0, 1, 2].map(|k| drawn.joints[0][k]);
    let joints = table1::cmg::Joints {
        gamma_o: o.at[0],
        gamma_o_dot: o.at[1],
        gamma_i: i.at[0],
        gamma_i_dot: i.at[1],
        theta: w.at[0],
        spin: w.at[1],
    };
    let drives = table1::cmg::Drives {
        u_o: table1::Drive::Torque(0.0),
        u_i: table1::Drive::Torque(0.0),
        u_w: table1::Drive::Torque(0.0),
    };
    let state = table1::State { omega: drawn.omega, cmg: [joints] };
    let inputs = table1::Inputs { force: [0.0; 3], torque_b: [0.0; 3], cmg: [drives] };
    assert!(baked.accelerations(&state, &inputs).is_err());
}
