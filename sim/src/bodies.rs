//! Momentum of each body by itself, the unit in which momentum drift is counted.
//!
//! Plain kinematics of positions and angular velocities, body after body along the chain, without
//! the emitted kernels. Only the sum over the bodies has to equal what the solver says; a test
//! holds it to that.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::Joints;
use precess_dynamics::{Angle, Attitude, Dgvscmg, Hub, State};

use crate::scenario::Set;

/// Momentum of one body, N axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyMomentum {
    /// m v, kg m/s.
    pub linear: Vector3<f64>,
    /// r x m v + I omega about the inertial origin, kg m^2/s.
    pub angular: Vector3<f64>,
}

/// The momentum of the hub, then of each device's outer gimbal, inner gimbal and wheel.
#[must_use]
pub fn momenta<const N: usize>(
    hub: &Hub,
    devices: &[Dgvscmg; N],
    state: &State<Set<N>>,
) -> Vec<BodyMomentum> {
    let nb = state.attitude.dcm().transpose();
    // Every point and axis below is along B axes, every velocity inertial.
    let b = Frame {
        axes: Matrix3::identity(),
        omega: state.omega,
        origin: nb.transpose() * state.r_b_n,
        velocity: nb.transpose() * state.r_b_n_dot,
    };
    let mut bodies = vec![b.body(hub.m_b, hub.r_bc_b, hub.i_b_bc)];
    for (device, joints) in devices.iter().zip(&state.devices) {
        bodies.extend(chain(&b, device, joints));
    }
    for body in &mut bodies {
        *body = BodyMomentum { linear: nb * body.linear, angular: nb * body.angular };
    }
    bodies
}

fn chain(b: &Frame, device: &Dgvscmg, j: &Joints) -> [BodyMomentum; 3] {
    let mount = Frame { axes: device.mount, ..b.moved(device.r_go_b) };
    // Go = mount * Rz(gamma_o), Gi = Go * Ry(gamma_i), W = Gi * Rx(theta)
    let go = mount.turned(Vector3::z(), j.gamma_o, j.gamma_o_dot);
    let gi = go.moved(device.l_o).turned(Vector3::y(), j.gamma_i, j.gamma_i_dot);
    let w = gi.moved(device.l_i).turned(Vector3::x(), j.theta, j.spin);
    [
        go.body(device.m_go, device.r_goc_go, device.i_go_goc),
        gi.body(device.m_gi, device.r_gic_gi, device.i_gi_gic),
        w.body(device.m_w, Vector3::new(0.0, device.d, 0.0), device.i_w_wc),
    ]
}

/// A frame on a moving body.
#[derive(Clone, Copy)]
struct Frame {
    /// Columns: the frame's axes along B axes.
    axes: Matrix3<f64>,
    omega: Vector3<f64>,
    /// From the inertial origin, along B axes, as all below.
    origin: Vector3<f64>,
    velocity: Vector3<f64>,
}

impl Frame {
    /// The same body, the origin moved by an offset along the frame's own axes.
    fn moved(&self, offset: Vector3<f64>) -> Self {
        let offset = self.axes * offset;
        Self {
            origin: self.origin + offset,
            velocity: self.velocity + self.omega.cross(&offset),
            ..*self
        }
    }

    /// The next body, turned about one of this frame's axes.
    fn turned(&self, axis: Vector3<f64>, angle: f64, rate: f64) -> Self {
        // The solver's own: the same bits on every host.
        let (sin, cos) = Angle::sin_cos(angle);
        let tilde = axis.cross_matrix();
        let turn = Matrix3::identity() + tilde * sin + tilde * tilde * (1.0 - cos);
        Self { axes: self.axes * turn, omega: self.omega + self.axes * axis * rate, ..*self }
    }

    fn body(&self, mass: f64, centre: Vector3<f64>, inertia: Matrix3<f64>) -> BodyMomentum {
        let c = self.moved(centre);
        let linear = c.velocity * mass;
        let spin = c.axes * inertia * c.axes.transpose() * c.omega;
        BodyMomentum { linear, angular: c.origin.cross(&linear) + spin }
    }
}

#[cfg(test)]
mod tests {
    use precess_dynamics::{About, Quaternion, Spacecraft};

    use super::*;
    use crate::scenario::table1::{Drive, Imbalance, Variant};

    /// Two evaluations of the same sums in another order; a few hundred roundings of 2e-16.
    const ROUNDING: f64 = 1e-13;

    #[test]
    fn the_bodies_momenta_add_up_to_the_solvers() {
        let mut scenario = Variant { imbalance: Imbalance::Printed, drive: Drive::Free }.scenario();
        let device = &mut scenario.devices[0];
        // A third of a turn about (1, 1, 1), and every offset that Table 1 leaves at zero.
        device.mount = Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0);
        device.r_goc_go = Vector3::new(0.01, -0.02, 0.03);
        device.r_gic_gi = Vector3::new(-0.04, 0.02, 0.01);
        device.l_o = Vector3::new(0.05, 0.01, -0.06);
        device.l_i = Vector3::new(-0.02, 0.07, 0.03);
        let state = &mut scenario.state;
        state.r_b_n = Vector3::new(0.3, -0.2, 0.1);
        state.r_b_n_dot = Vector3::new(-0.1, 0.4, 0.2);
        state.attitude = Quaternion { q0: 0.5, q1: -0.5, q2: 0.5, q3: 0.5 };
        state.omega = Vector3::new(0.3, -0.1, 0.2);
        state.devices[0] = Joints {
            gamma_o: 0.7,
            gamma_i: -1.1,
            theta: 2.3,
            gamma_o_dot: 0.9,
            gamma_i_dot: -1.7,
            spin: 40.0,
        };
        let sum = momenta(&scenario.hub, &scenario.devices, state).into_iter().reduce(|a, b| {
            BodyMomentum { linear: a.linear + b.linear, angular: a.angular + b.angular }
        });
        let sum = sum.expect("a spacecraft has a hub");
        let solver = Spacecraft::new(&scenario.hub, &scenario.devices).expect("it is accepted");
        let solver = solver.momentum(state, About::InertialOrigin).expect("a finite state");
        assert!((sum.linear - solver.linear).norm() <= ROUNDING * solver.linear.norm());
        assert!((sum.angular - solver.angular).norm() <= ROUNDING * solver.angular.norm());
    }
}
