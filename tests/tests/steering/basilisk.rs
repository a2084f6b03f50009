//! Commands of Basilisk's `vscmgVelocitySteering` for four VSCMGs: `fixtures/steering.json`, by `engines/steering.py`.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BalancedVscmg, Hub, Spacecraft, State, Steered, SteeringLaw, SteeringTerms,
};
use serde::Deserialize;

const TEXT: &str = include_str!("../../fixtures/steering.json");

/// Of the largest command of a state: what issues of steering demand of a comparison with Basilisk.
const AGREEMENT: f64 = 1e-9;

#[derive(Deserialize)]
struct Stored {
    basilisk: String,
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    omega: [f64; 3],
    torque: [f64; 3],
    /// Of gimbals and of wheels.
    weights: [f64; 2],
    gyros: [Gyro; 4],
    commands: Commands,
}

#[derive(Clone, Copy, Deserialize)]
struct Gyro {
    mount: [[f64; 3]; 3],
    i_g: [f64; 3],
    i_w: [f64; 2],
    gamma: f64,
    gamma_dot: f64,
    spin: f64,
}

#[derive(Deserialize)]
struct Commands {
    spin_dot: [f64; 4],
    gamma_dot: [f64; 4],
}

const STEERED: [Steered; 8] = {
    let (rate, acceleration) = (Steered::Rate, Steered::Acceleration);
    [rate, acceleration, rate, acceleration, rate, acceleration, rate, acceleration]
};

impl Case {
    fn terms(&self) -> SteeringTerms<f64, 8> {
        let hub = Hub { m_b: 500.0, r_bc_b: Vector3::zeros(), i_b_bc: Matrix3::identity() * 100.0 };
        let devices = self.gyros.map(|gyro| BalancedVscmg {
            mount: Matrix3::from_rows(&gyro.mount.map(|row| Vector3::from(row).transpose())),
            m_g: 2.0,
            i_g_gc: Matrix3::from_diagonal(&gyro.i_g.into()),
            ..BalancedVscmg::bare_wheel(4.0, gyro.i_w[0], gyro.i_w[1])
        });
        let craft = Spacecraft::new(&hub, &devices).unwrap();
        let mut state: State<[BalancedVscmg; 4]> = State::at_rest();
        state.omega = self.omega.into();
        for (joints, gyro) in state.devices.iter_mut().zip(self.gyros) {
            (joints.gamma, joints.gamma_dot, joints.spin) = (gyro.gamma, gyro.gamma_dot, gyro.spin);
        }
        craft.steering_terms(&state).unwrap()
    }
}

#[test]
fn commands_are_those_of_basilisk() {
    let Stored { basilisk, cases } = serde_json::from_str(TEXT).unwrap();
    let mut worst = 0.0_f64;
    for case in &cases {
        let [gimbal, wheel] = case.weights;
        let weights = core::array::from_fn(|k| if k % 2 == 0 { gimbal } else { wheel });
        let law = SteeringLaw { weights, ..SteeringLaw::exact() };
        let matrix = case.terms().matrix(&STEERED);
        // Basilisk leaves the drift to the control law.
        let torque = Vector3::from(case.torque) - matrix.drift;
        let found = law.allocate(&matrix, &torque).unwrap().commands;
        let Commands { gamma_dot, spin_dot } = &case.commands;
        let expected: [f64; 8] =
            core::array::from_fn(|k| if k % 2 == 0 { gamma_dot[k / 2] } else { spin_dot[k / 2] });
        let size = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (found, expected) in found.iter().zip(expected) {
            assert!(found.is_finite());
            worst = worst.max((found - expected).abs() / size);
        }
    }
    println!(
        "Basilisk {basilisk}, {} states: worst {worst:.1e} of the largest command",
        cases.len()
    );
    assert!(worst < AGREEMENT && cases.len() == 20, "{worst:e}");
}

/// The comparison notices another moment of a gimbal.
#[test]
fn a_change_of_an_inertia_shows() {
    let Stored { mut cases, .. } = serde_json::from_str(TEXT).unwrap();
    let matrix = |case: &Case| case.terms().matrix(&STEERED);
    let before = matrix(&cases[0]);
    for change in [0, 1, 2] {
        cases[0].gyros[1].i_g[change] *= 1.0 + 1e-6;
        let changed = matrix(&cases[0]);
        let moved = (changed.columns[2] - before.columns[2]).norm();
        assert!(moved > 1e-10, "moment {change}: {moved:e}");
        cases[0].gyros[1].i_g[change] /= 1.0 + 1e-6;
    }
}
