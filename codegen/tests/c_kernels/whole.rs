//! Reads spacecraft and states as doubles, writes their accelerations: what whole.c does, by the
//! solver's public functions.

use std::error::Error;
use std::io::{Read, Write};

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Dgvscmg, Hub, Inputs, Mode, Spacecraft, State};

const DEVICES: usize = 4;

fn main() -> Result<(), Box<dyn Error>> {
    let (mut bytes, mut found) = (Vec::new(), Vec::new());
    std::io::stdin().read_to_end(&mut bytes)?;
    let numbers = bytes.chunks_exact(8).map(|b| f64::from_ne_bytes(b.try_into().unwrap()));
    let numbers: Vec<_> = numbers.collect();
    let mut rest = numbers.iter().copied();
    while rest.len() > 0 {
        let mut next = || rest.next().expect("numbers come in rounds");
        let m_b = next();
        let r_bc_b = vector(&mut next);
        let hub = Hub { m_b, r_bc_b, i_b_bc: symmetric(&mut next) };
        let mut state: State<[Dgvscmg; DEVICES]> = State::at_rest();
        let mut inputs: Inputs<[Dgvscmg; DEVICES]> = Inputs::none();
        state.omega = vector(&mut next);
        inputs.force = vector(&mut next);
        inputs.torque_b = vector(&mut next);
        let devices = core::array::from_fn(|k| {
            let device = device(&mut next);
            let joints = &mut state.devices[k];
            [joints.gamma_o, joints.gamma_i, joints.theta] = [next(), next(), next()];
            [joints.gamma_o_dot, joints.gamma_i_dot, joints.spin] = [next(), next(), next()];
            let motors = &mut inputs.motors[k];
            [motors.u_o, motors.u_i, motors.u_w] = [next(), next(), next()];
            let modes = &mut inputs.modes[k];
            for mode in [&mut modes.outer_gimbal, &mut modes.inner_gimbal, &mut modes.wheel] {
                let [driven, _, given] = [next(), next(), next()];
                *mode = if driven == 1.0 { Mode::Driven } else { Mode::Prescribed(given) };
            }
            device
        });
        let moves = Spacecraft::new(&hub, &devices)?.accelerations(&state, &inputs)?;
        found.extend(moves.r_b_n_ddot.iter().chain(&moves.omega_dot).copied());
        for joints in moves.devices {
            found.extend([joints.gamma_o_ddot, joints.gamma_i_ddot, joints.spin_dot]);
        }
    }
    let bytes: Vec<_> = found.iter().flat_map(|number: &f64| number.to_ne_bytes()).collect();
    Ok(std::io::stdout().write_all(&bytes)?)
}

fn device(next: &mut impl FnMut() -> f64) -> Dgvscmg {
    let mount = Matrix3::from_row_iterator((0..9).map(|_| next()));
    let (r_go_b, r_goc_go) = (vector(next), vector(next));
    let (m_go, i_go_goc) = (next(), symmetric(next));
    let (l_o, r_gic_gi) = (vector(next), vector(next));
    let (m_gi, i_gi_gic) = (next(), symmetric(next));
    let (l_i, d, m_w) = (vector(next), next(), next());
    Dgvscmg {
        mount,
        r_go_b,
        r_goc_go,
        m_go,
        i_go_goc,
        l_o,
        r_gic_gi,
        m_gi,
        i_gi_gic,
        l_i,
        d,
        ..Dgvscmg::bare_wheel(m_w, symmetric(next))
    }
}

fn vector(next: &mut impl FnMut() -> f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| next())
}

fn symmetric(next: &mut impl FnMut() -> f64) -> Matrix3<f64> {
    let [xx, xy, xz, yy, yz, zz] = core::array::from_fn(|_| next());
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}
