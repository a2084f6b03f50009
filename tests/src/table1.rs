//! Table 1 of the paper, as printed and with a catalogue wheel.
//!
//! The table's rows do not agree with each other: `U_s / m_w` is 0.08 mm where the row `d` says
//! 8.0 mm, and `U_d = 15.4 g m^2` is ten thousand times what a catalogue wheel has (15.4 g cm^2).
//! The torque `u_x` reads 200 or 250 mN m. What the table leaves out (`L^o`, `L^i`, the gimbals'
//! centres of mass, the mount, F, `L_B`, the gimbals' rates) is zero or the identity.

use core::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::{Joints, MotorTorques, PerJoint};
use precess_dynamics::{Dgvscmg, FixedSet, Hub, ImbalanceModel, Inputs, Passive, State};

use crate::case::{Case, Set};

/// Which of the two wheels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Imbalance {
    /// `d = 8.0 mm`, `J_13 = 15.4 g m^2`.
    Printed,
    /// `d = 0.08 mm`, `J_13 = 15.4 g cm^2`.
    Catalogue,
}

/// Which motors run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// None.
    Free,
    /// `u_x = 200 mN m`, `u_y = u_z = 100 mN m`.
    Wheel200,
    /// `u_x = 250 mN m`, `u_y = u_z = 100 mN m`.
    Wheel250,
}

/// Every scenario of the table.
pub const SCENARIOS: [(Imbalance, Drive); 6] = [
    (Imbalance::Printed, Drive::Free),
    (Imbalance::Printed, Drive::Wheel200),
    (Imbalance::Printed, Drive::Wheel250),
    (Imbalance::Catalogue, Drive::Free),
    (Imbalance::Catalogue, Drive::Wheel200),
    (Imbalance::Catalogue, Drive::Wheel250),
];

/// The whole of one scenario.
#[must_use]
pub fn scenario(imbalance: Imbalance, drive: Drive) -> Case<1> {
    Case { hub: hub(), devices: [device(imbalance)], state: initial_state(), inputs: inputs(drive) }
}

/// Two catalogue devices on opposite sides of the hub, driven: for suites that need more than one.
#[must_use]
pub fn pair() -> Case<2> {
    let one = scenario(Imbalance::Catalogue, Drive::Wheel250);
    let (device, joints, motors) = (one.devices[0], one.state.devices[0], one.inputs.motors[0]);
    let State { r_b_n, r_b_n_dot, attitude, omega, .. } = one.state;
    Case {
        hub: one.hub,
        devices: [device, Dgvscmg { r_go_b: Vector3::new(-0.3, 0.0, 0.0), ..device }],
        state: State { r_b_n, r_b_n_dot, attitude, omega, devices: [joints; 2], modal: () },
        inputs: Inputs {
            force: one.inputs.force,
            torque_b: one.inputs.torque_b,
            motors: [motors; 2],
            ..Inputs::none()
        },
    }
}

/// The hub.
#[must_use]
pub fn hub() -> Hub {
    Hub {
        m_b: 810.0,
        r_bc_b: Vector3::new(-0.0002, 0.0001, 0.1),
        i_b_bc: Matrix3::new(900.0, 4.15, 2.93, 4.15, 800.0, 2.75, 2.93, 2.75, 600.0),
    }
}

/// The one device.
#[must_use]
pub fn device(imbalance: Imbalance) -> Dgvscmg {
    let gimbal = Matrix3::new(9.0, 0.81, 0.24, 0.81, 11.0, 0.93, 0.24, 0.93, 5.0);
    let (d, j_13) = match imbalance {
        Imbalance::Printed => (8.0e-3, 15.4e-3),
        Imbalance::Catalogue => (0.08e-3, 1.54e-6),
    };
    Dgvscmg {
        mount: Matrix3::identity(),
        r_go_b: Vector3::new(0.3, 0.0, 0.0),
        m_go: 24.0,
        r_goc_go: Vector3::zeros(),
        i_go_goc: gimbal,
        l_o: Vector3::zeros(),
        m_gi: 24.0,
        r_gic_gi: Vector3::zeros(),
        i_gi_gic: gimbal,
        l_i: Vector3::zeros(),
        m_w: 4.0,
        d,
        i_w_wc: Matrix3::new(0.2, 0.0, j_13, 0.0, 0.1, 0.0, j_13, 0.0, 0.1),
        passive: PerJoint::all(Passive::none()),
        model: ImbalanceModel::Coupled,
    }
}

/// The initial state: 500 rpm, all angles zero, `omega = (4.85, 0.57, 0) deg/s`.
#[must_use]
pub fn initial_state() -> State<Set<1>> {
    let degree = PI / 180.0;
    let spin = 500.0 * TAU / 60.0;
    State {
        omega: Vector3::new(4.85 * degree, 0.57 * degree, 0.0),
        devices: [Joints { spin, ..Dgvscmg::at_rest() }],
        ..State::at_rest()
    }
}

/// The motor torques, N m, and nothing else.
#[must_use]
pub fn inputs(drive: Drive) -> Inputs<Set<1>> {
    let motor = match drive {
        Drive::Free => Dgvscmg::motors_off(),
        Drive::Wheel200 => MotorTorques { u_o: 0.1, u_i: 0.1, u_w: 0.2 },
        Drive::Wheel250 => MotorTorques { u_o: 0.1, u_i: 0.1, u_w: 0.25 },
    };
    Inputs { motors: [motor], ..Inputs::none() }
}

#[cfg(test)]
mod tests {
    use precess_dynamics::Spacecraft;

    use super::{SCENARIOS, scenario};

    #[test]
    fn masses_sum_to_the_printed_862_kg() {
        for (imbalance, drive) in SCENARIOS {
            let case = scenario(imbalance, drive);
            let spacecraft = Spacecraft::new(&case.hub, &case.devices);
            assert_eq!(spacecraft.map(|spacecraft| spacecraft.mass()).ok(), Some(862.0));
        }
    }

    #[test]
    fn first_axis_rates_are_those_printed() {
        let state = super::initial_state();
        assert!((state.omega.x.to_degrees() - 4.85).abs() < 1e-14);
        assert!((state.devices[0].spin / core::f64::consts::TAU * 60.0 - 500.0).abs() < 1e-12);
    }
}
