//! Evaluates crates that were emitted beside it: state by state from its input, one a line.
//!
//! A line has the name of the spacecraft and then numbers, as their bits: angular velocity, force, torque, and of
//! each joint, locked ones among them, coordinate, rate, whether its torque is given, and what is. A line of the
//! output has the accelerations, of locked joints zero, or `none`.

use std::io::{BufRead, Write};

/// The devices of a spacecraft, as its crate takes them.
macro_rules! device {
    ($mission:ident::$shape:ident, $of:expr $(, $locked:ident: $k:literal)*) => {{
        let of: &Device = $of;
        $mission::$shape::Device {
            mount: of.mount,
            bodies: std::array::from_fn(|k| {
                let (mass, origin, centre_of_mass, inertia) = of.bodies[k];
                $mission::Body { mass, origin, centre_of_mass, inertia }
            }),
            $($locked: of.locked_at[$k],)*
        }
    }};
}

macro_rules! hub {
    ($mission:ident) => {{
        let (mass, centre_of_mass, inertia) = parameters::$mission::HUB;
        $mission::Hub { mass, centre_of_mass, inertia }
    }};
}

macro_rules! drive {
    ($mission:ident, $joint:expr) => {
        match $joint {
            [_, _, 1.0, torque] => $mission::Drive::Torque(torque),
            [_, _, _, acceleration] => $mission::Drive::Acceleration(acceleration),
        }
    };
}

/// Wheels of a spacecraft, each with the number of its joint among all.
macro_rules! wheels {
    ($mission:ident::$shape:ident, $given:expr, $joints:expr) => {{
        let joint = |k: usize| $given.joints[$joints[k]];
        let state = $mission::State {
            omega: $given.omega,
            $shape: std::array::from_fn(|k| {
                let [theta, spin, ..] = joint(k);
                $mission::$shape::Joints { theta, spin }
            }),
        };
        let inputs = $mission::Inputs {
            force: $given.force,
            torque_b: $given.torque_b,
            $shape: std::array::from_fn(|k| $mission::$shape::Drives {
                u_w: drive!($mission, joint(k)),
            }),
        };
        (state, inputs)
    }};
}

/// A device of the description: its mount, its bodies, and where their joints are locked.
struct Device {
    mount: [[f64; 3]; 3],
    bodies: &'static [(f64, [f64; 3], [f64; 3], [[f64; 3]; 3])],
    locked_at: &'static [f64],
}

/// Written by the suite from the descriptions.
mod parameters;

/// A state and what acts.
struct Given {
    omega: [f64; 3],
    force: [f64; 3],
    torque_b: [f64; 3],
    /// Coordinate, rate, whether the torque is given, and what is given.
    joints: Vec<[f64; 4]>,
}

/// Accelerations of B, angular acceleration, those of the joints.
type Found = Option<([f64; 3], [f64; 3], Vec<f64>)>;

fn table1(given: &Given) -> Found {
    let [device] = &parameters::table1::DEVICES;
    let craft = table1::Spacecraft::new(&table1::Parameters {
        hub: hub!(table1),
        cmg: [device!(table1::cmg, device)],
    })
    .expect("as assumed");
    let [o, i, w] = given.joints[..] else { panic!("three joints") };
    let joints = table1::cmg::Joints {
        gamma_o: o[0],
        gamma_o_dot: o[1],
        gamma_i: i[0],
        gamma_i_dot: i[1],
        theta: w[0],
        spin: w[1],
    };
    let drives = table1::cmg::Drives {
        u_o: drive!(table1, o),
        u_i: drive!(table1, i),
        u_w: drive!(table1, w),
    };
    let state = table1::State { omega: given.omega, cmg: [joints] };
    let inputs =
        table1::Inputs { force: given.force, torque_b: given.torque_b, cmg: [drives] };
    let found = craft.accelerations(&state, &inputs).ok()?;
    let [own] = found.cmg;
    let joints = vec![own.gamma_o_ddot, own.gamma_i_ddot, own.spin_dot];
    Some((found.r_b_n_ddot, found.omega_dot, joints))
}

/// Two wheels; between them a VSCMG of two locked joints and a panel of one.
fn parked_spare(given: &Given) -> Found {
    let [first, spare, panel, second] = &parameters::parked_spare::DEVICES;
    let craft = parked_spare::Spacecraft::new(&parked_spare::Parameters {
        hub: hub!(parked_spare),
        wheel: [first, second].map(|of| device!(parked_spare::wheel, of)),
        spare: [device!(parked_spare::spare, spare, gamma: 0, theta: 1)],
        panel: [device!(parked_spare::panel, panel, phi: 0)],
    })
    .expect("as assumed");
    let (state, inputs) = wheels!(parked_spare::wheel, given, [0, 4]);
    let found = craft.accelerations(&state, &inputs).ok()?;
    let [first, second] = found.wheel.map(|own| own.spin_dot);
    Some((found.r_b_n_ddot, found.omega_dot, vec![first, 0.0, 0.0, 0.0, second]))
}

/// Four DGVSCMGs of which only the wheels move.
fn imaging_satellite_constants(given: &Given) -> Found {
    let craft = &imaging_satellite_constants::SPACECRAFT;
    let (state, inputs) = wheels!(imaging_satellite_constants::cmg, given, [2, 5, 8, 11]);
    let found = craft.accelerations(&state, &inputs).ok()?;
    let joints = found.cmg.iter().flat_map(|own| [0.0, 0.0, own.spin_dot]).collect();
    Some((found.r_b_n_ddot, found.omega_dot, joints))
}

fn main() {
    let mut out = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let line = line.expect("text");
        let mut words = line.split(' ');
        let name = words.next().expect("a name");
        if name == "constants" {
            // Fields in the order of the constructor's; the digits of a number tell its bits.
            writeln!(out, "{:?}", imaging_satellite_constants::SPACECRAFT).expect("a reader");
            continue;
        }
        let number = |word| f64::from_bits(u64::from_str_radix(word, 16).expect("bits"));
        let numbers: Vec<f64> = words.map(number).collect();
        let (hub, joints) = numbers.split_at(9);
        let given = Given {
            omega: hub[..3].try_into().expect("three"),
            force: hub[3..6].try_into().expect("three"),
            torque_b: hub[6..].try_into().expect("three"),
            joints: joints.chunks_exact(4).map(|of| of.try_into().expect("four")).collect(),
        };
        let found = match name {
            "table1" => table1(&given),
            "parked_spare" => parked_spare(&given),
            "imaging_satellite_constants" => imaging_satellite_constants(&given),
            other => panic!("no spacecraft is called `{other}`"),
        };
        let line = found.map_or("none".to_owned(), |(r, omega, joints)| {
            let all = r.into_iter().chain(omega).chain(joints);
            all.map(|x| format!("{:x}", x.to_bits())).collect::<Vec<_>>().join(" ")
        });
        writeln!(out, "{line}").expect("a reader");
    }
}
