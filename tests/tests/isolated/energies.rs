//! Energy, momenta and powers of a [`Tree`] from the motion of every body, and the torques at its
//! joints.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::Passive;

use crate::tree::{Line, Tree};

/// Energy, momenta about the inertial origin and first moment about it, inertial axes.
pub(crate) struct Totals {
    pub(crate) energy: f64,
    pub(crate) linear: Vector3<f64>,
    pub(crate) angular: Vector3<f64>,
    pub(crate) first_moment: Vector3<f64>,
    pub(crate) mass: f64,
}

impl Tree {
    /// Energy of all springs, J.
    pub(crate) fn stored(&self) -> f64 {
        let single = self
            .links
            .iter()
            .map(|link| 0.5 * link.passive.stiffness * (link.q - link.passive.rest).powi(2));
        let struts = self.lines.iter().map(|line| {
            0.5 * line.strut.stiffness * (self.length(line) - line.strut.length).powi(2)
        });
        single.chain(struts).sum::<f64>() + self.coupled_energy
    }

    /// The unit of its rounding: a strut's stretch is a difference of lengths.
    pub(crate) fn stored_size(&self) -> f64 {
        let struts = self.lines.iter().map(|line| {
            let length = self.length(line);
            line.strut.stiffness * (length - line.strut.length).abs() * length
        });
        struts.sum()
    }

    fn length(&self, line: &Line) -> f64 {
        let still = vec![0.0; self.links.len()];
        let moving = self.motion(Vector3::zeros(), Vector3::zeros(), &still);
        let (base, platform) =
            (&moving[line.base.map_or(0, |base| base + 1)], &moving[line.platform + 1]);
        let from = base.r + base.axes * line.on_base;
        (platform.r + platform.axes * line.on_platform - from).norm()
    }

    /// `dT/dt`, the power of gravity, and its potential energy, from the motion of every body.
    pub(crate) fn rates(&self, a: Vector3<f64>, alpha: Vector3<f64>, joints: &[f64]) -> [f64; 3] {
        let moving = self.motion(a, alpha, joints);
        let third = self.third_order(&moving).dot(&self.v);
        let [mut kinetic, mut gravity, mut potential] = [0.0, third, 0.0];
        for ((mass, centre, inertia), body) in self.bodies().into_iter().zip(&moving) {
            let arm = body.axes * centre;
            let inertia = body.axes * inertia * body.axes.transpose();
            let velocity = body.v + body.omega.cross(&arm);
            let of_centre =
                body.a + body.alpha.cross(&arm) + body.omega.cross(&body.omega.cross(&arm));
            kinetic += mass * of_centre.dot(&velocity) + (inertia * body.alpha).dot(&body.omega);
            let r = body.r + arm;
            let field = self.field.at_b + self.field.gradient * r;
            let second = Matrix3::identity() * (0.5 * inertia.trace()) - inertia;
            gravity += mass * field.dot(&velocity);
            let product = self.field.gradient * second;
            let twist = Vector3::new(
                product[(2, 1)] - product[(1, 2)],
                product[(0, 2)] - product[(2, 0)],
                product[(1, 0)] - product[(0, 1)],
            );
            gravity += twist.dot(&body.omega);
            let uniform = match self.field.central {
                Some((mu, _)) => mass * (mu / self.r.norm() + self.field.at_b.dot(&r)),
                None => mass * self.field.at_b.dot(&(self.r + r)),
            };
            let square = mass * r.dot(&(self.field.gradient * r));
            potential -= uniform + 0.5 * (square + product.trace());
        }
        [kinetic, gravity, potential]
    }

    pub(crate) fn totals(&self) -> Totals {
        let still = vec![0.0; self.links.len()];
        let moving = self.motion(Vector3::zeros(), Vector3::zeros(), &still);
        let none = Vector3::zeros();
        let mut sum =
            Totals { energy: 0.0, linear: none, angular: none, first_moment: none, mass: 0.0 };
        for ((mass, centre, inertia), body) in self.bodies().into_iter().zip(&moving) {
            let arm = body.axes * centre;
            let velocity = body.v + body.omega.cross(&arm);
            let spin = body.axes * inertia * body.axes.transpose() * body.omega;
            let r = self.r + body.r + arm;
            sum.energy += 0.5 * (mass * velocity.norm_squared() + body.omega.dot(&spin));
            sum.linear += mass * velocity;
            sum.angular += spin + r.cross(&(mass * velocity));
            sum.first_moment += mass * r;
            sum.mass += mass;
        }
        sum
    }

    /// The torque that acts at each joint: motor, spring, friction.
    pub(crate) fn torques(&self) -> Vec<f64> {
        let mut torques: Vec<f64> = self
            .links
            .iter()
            .map(|link| {
                let Passive { stiffness, rest, viscous, coulomb, coulomb_rate } = link.passive;
                let speed = (link.rate * link.rate + coulomb_rate * coulomb_rate).sqrt();
                let dry = if coulomb == 0.0 { 0.0 } else { coulomb * link.rate / speed };
                link.motor - stiffness * (link.q - rest) - viscous * link.rate - dry
            })
            .collect();
        for (joint, torque, _) in &self.coupled {
            torques[*joint] += torque;
        }
        torques
    }

    /// The sum of the magnitudes of the terms of each torque.
    pub(crate) fn torque_sizes(&self) -> Vec<f64> {
        let mut sizes: Vec<f64> = self
            .links
            .iter()
            .map(|link| {
                let Passive { stiffness, rest, viscous, coulomb, .. } = link.passive;
                let spring = stiffness * (link.q.abs() + rest.abs());
                link.motor.abs() + spring + viscous * link.rate.abs() + coulomb
            })
            .collect();
        for (joint, _, size) in &self.coupled {
            sizes[*joint] += size;
        }
        sizes
    }
}
