//! The reference for devices of every kind: Newton and Euler for each body of a spacecraft whose
//! devices are chains of turning and sliding joints, over any scalar.
//!
//! Nothing of it is emitted or derived: positions, velocities and accelerations go outwards from B,
//! forces and moments inwards ([`Craft::needed`]). These are linear in the accelerations, so one
//! evaluation for each unit acceleration, at rest and without gravity, gives the columns of the
//! equations of motion, which Gaussian elimination solves for what is not prescribed
//! ([`Craft::motion`]). With the solver it shares the types of modes and passive joints.

mod links;

use precess_dynamics::{HubMode, Mode, Passive, Scalar};

use crate::newton_euler::elimination;
use crate::newton_euler::vector::{Tensor, Vector, cross, dot};

/// A force, and its moment about a point, along one set of axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load<T> {
    /// Force, N.
    pub force: Vector<T>,
    /// Moment, N m.
    pub moment: Vector<T>,
}

/// A joint with its child body, in one state under its inputs.
#[derive(Clone, Copy, Debug)]
pub struct Link<T> {
    /// The axis of the parent body about which it turns, or along which it slides, 0 to 2.
    pub axis: usize,
    /// Whether it slides.
    pub slides: bool,
    /// Whether the body is symmetric about the joint: then the applied load and the load of the
    /// joint are along the axes of the parent body.
    pub round: bool,
    /// From the origin of the parent body, along its axes, m; that of the first link from B, B axes.
    pub origin: Vector<T>,
    /// Mass, kg.
    pub mass: T,
    /// Centre of mass from the body's origin, own axes, m.
    pub centre: Vector<T>,
    /// Inertia about the centre of mass, own axes, kg m^2.
    pub inertia: Tensor<T>,
    /// Spring, damper, friction.
    pub passive: Passive<T>,
    /// Coordinate, rad or m.
    pub coordinate: T,
    /// Rate.
    pub rate: T,
    /// Motor torque or force; of no effect unless the joint is driven.
    pub motor: T,
    /// Its mode.
    pub mode: Mode<T>,
    /// External force, and moment about the body's origin, own axes.
    pub applied: Load<T>,
}

/// A device.
#[derive(Clone, Debug)]
pub struct Chain<T> {
    /// Columns: its axes at zero angle, along B.
    pub mount: Tensor<T>,
    /// From the hub to the tip.
    pub links: Vec<Link<T>>,
}

/// A spacecraft in one state under its inputs, all along B.
#[derive(Clone, Debug)]
pub struct Craft<T> {
    /// The hub's mass, kg.
    pub mass: T,
    /// Its centre of mass from B, m.
    pub centre: Vector<T>,
    /// Its inertia about that, kg m^2.
    pub inertia: Tensor<T>,
    /// Angular velocity, rad/s.
    pub omega: Vector<T>,
    /// External force through B, moment about B.
    pub applied: Load<T>,
    /// Acceleration of free fall, m/s^2.
    pub gravity: Vector<T>,
    /// The hub's mode.
    pub hub_mode: HubMode<T>,
    /// The devices.
    pub chains: Vec<Chain<T>>,
}

/// All accelerations, along B; those of the joints device by device from the hub to the tip.
#[derive(Clone, Debug)]
pub struct Motion<T> {
    /// Inertial acceleration of B, m/s^2.
    pub r_b_n_ddot: Vector<T>,
    /// Angular acceleration, rad/s^2.
    pub omega_dot: Vector<T>,
    /// Of the joints.
    pub joints: Vec<T>,
}

/// What accelerations need.
#[derive(Clone, Debug)]
pub struct Needed<T> {
    /// On the hub about B, in addition to the inputs, along B.
    pub hub: Load<T>,
    /// Across each joint, exerted by the parent body on the child body about its origin, own axes.
    pub loads: Vec<Load<T>>,
    /// Torque or force of each motor.
    pub motors: Vec<T>,
}

/// What moves while accelerations are weighed: everything, or only the accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
enum With {
    RatesAndForces,
    Accelerations,
}

impl<T: Scalar> Load<T> {
    /// Nothing.
    #[must_use]
    pub fn zero() -> Self {
        Self { force: Vector::zero(), moment: Vector::zero() }
    }

    fn plus(self, other: Self) -> Self {
        Self { force: self.force + other.force, moment: self.moment + other.moment }
    }

    fn minus(self, other: Self) -> Self {
        Self { force: self.force - other.force, moment: self.moment - other.moment }
    }

    /// Along other axes.
    fn turned(self, axes: Tensor<T>) -> Self {
        Self { force: axes * self.force, moment: axes * self.moment }
    }

    /// About another point, from which the present one is at `arm`.
    fn moved(self, arm: Vector<T>) -> Self {
        Self { moment: self.moment + cross(arm, self.force), ..self }
    }
}

impl<T: Scalar> Link<T> {
    /// Torque or force of spring, damper and smoothed Coulomb friction.
    fn passive_torque(&self) -> T {
        let Passive { stiffness, rest, viscous, coulomb, coulomb_rate } = self.passive;
        let elastic = -(stiffness * (self.coordinate - rest)) - viscous * self.rate;
        if coulomb == T::from_f64(0.0) {
            return elastic;
        }
        let size = (self.rate * self.rate + coulomb_rate * coulomb_rate).sqrt();
        elastic - coulomb * self.rate * size.recip()
    }
}

impl<T: Scalar> Craft<T> {
    /// All accelerations; `None` where the equations of what is free are singular.
    #[must_use]
    pub fn motion(&self) -> Option<Motion<T>> {
        let given = self.given();
        let start: Vec<T> = given.iter().map(|x| x.unwrap_or_else(|| T::from_f64(0.0))).collect();
        let free: Vec<usize> = (0..given.len()).filter(|&k| given[k].is_none()).collect();
        let missing = self.missing(&start, With::RatesAndForces);
        let columns: Vec<Vec<T>> = free
            .iter()
            .map(|&k| {
                let mut unit = vec![T::from_f64(0.0); given.len()];
                unit[k] = T::from_f64(1.0);
                self.missing(&unit, With::Accelerations)
            })
            .collect();
        let rows = free.iter().map(|&row| columns.iter().map(|c| c[row]).collect()).collect();
        let right = free.iter().map(|&row| -missing[row]).collect();
        let mut found = start;
        for (&k, value) in free.iter().zip(elimination::solve(rows, right)?) {
            found[k] = value;
        }
        Some(Motion::from_accelerations(&found))
    }

    /// What accelerations need: inverse dynamics.
    #[must_use]
    pub fn needed(&self, motion: &Motion<T>) -> Needed<T> {
        self.weighed(motion, With::RatesAndForces)
    }

    /// Given accelerations, those of the hub first; none of what is free.
    fn given(&self) -> Vec<Option<T>> {
        let hub = match self.hub_mode {
            HubMode::Free => [None; 6],
            HubMode::Fixed => [Some(T::from_f64(0.0)); 6],
            HubMode::Prescribed { r_b_n_ddot: r, omega_dot: w } => {
                [r.x, r.y, r.z, w.x, w.y, w.z].map(Some)
            }
        };
        let joints =
            self.chains.iter().flat_map(|chain| &chain.links).map(|link| match link.mode {
                Mode::Driven => None,
                Mode::Prescribed(acceleration) => Some(acceleration),
                Mode::Locked => Some(T::from_f64(0.0)),
            });
        hub.into_iter().chain(joints).collect()
    }

    /// What accelerations need beyond what there is: on the hub, then of each motor.
    fn missing(&self, accelerations: &[T], with: With) -> Vec<T> {
        let Needed { hub, motors, .. } =
            self.weighed(&Motion::from_accelerations(accelerations), with);
        let links = self.chains.iter().flat_map(|chain| &chain.links);
        let joints = motors.into_iter().zip(links).map(|(needed, link)| match with {
            With::RatesAndForces => needed - link.motor,
            With::Accelerations => needed,
        });
        hub.force.0.into_iter().chain(hub.moment.0).chain(joints).collect()
    }

    fn weighed(&self, motion: &Motion<T>, with: With) -> Needed<T> {
        let moves = with == With::RatesAndForces;
        let omega = if moves { self.omega } else { Vector::zero() };
        // In the frame that falls freely there is no gravity.
        let falling = if moves { motion.r_b_n_ddot - self.gravity } else { motion.r_b_n_ddot };
        let base = links::Moving::hub(omega, falling, motion.omega_dot);
        let mut hub = base.inertial(self.mass, self.centre, self.inertia);
        if moves {
            hub = hub.minus(self.applied);
        }
        let (mut loads, mut motors) = (Vec::new(), Vec::new());
        let mut joints = motion.joints.iter().copied();
        for chain in &self.chains {
            let moving = links::outwards(chain, &base, &mut joints, with);
            let of_chain = links::inwards(chain, &moving, with);
            if let (Some(first), Some(load)) = (moving.first(), of_chain.first()) {
                hub = hub.plus(load.moved(first.origin));
            }
            for ((link, moving), load) in chain.links.iter().zip(&moving).zip(of_chain) {
                let along = if link.slides { load.force } else { load.moment };
                let passive = if moves { link.passive_torque() } else { T::from_f64(0.0) };
                motors.push(dot(moving.axis, along) - passive);
                loads.push(load.turned(moving.shown.transpose()));
            }
        }
        Needed { hub, loads, motors }
    }
}

impl<T: Scalar> Motion<T> {
    fn from_accelerations(accelerations: &[T]) -> Self {
        let three = |first: usize| Vector(core::array::from_fn(|k| accelerations[first + k]));
        let joints = accelerations[6..].to_vec();
        Self { r_b_n_ddot: three(0), omega_dot: three(3), joints }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of some tens of operations on numbers of about one.
    const ROUNDING: f64 = 1e-14;

    fn craft(link: &Link<f64>) -> Craft<f64> {
        Craft {
            mass: 2.0,
            centre: Vector::zero(),
            inertia: Tensor::identity(),
            omega: Vector::zero(),
            applied: Load::zero(),
            gravity: Vector::zero(),
            hub_mode: HubMode::Fixed,
            chains: vec![Chain { mount: Tensor::identity(), links: vec![*link] }],
        }
    }

    fn sliding() -> Link<f64> {
        Link {
            axis: 0,
            slides: true,
            round: false,
            origin: Vector::zero(),
            mass: 3.0,
            centre: Vector::zero(),
            inertia: Tensor([[0.0; 3]; 3]),
            passive: Passive::spring(5.0, 2.0),
            coordinate: 0.5,
            rate: 0.25,
            motor: 1.0,
            mode: Mode::Driven,
            applied: Load::zero(),
        }
    }

    /// `m x'' = u + F_x - k x - c x' + m g_x` on a fixed hub, which holds what is left.
    #[test]
    fn a_mass_on_a_spring_is_accelerated_by_all_that_acts_on_it() {
        let force = Vector([0.5, 0.0, 7.0]);
        let link = Link { applied: Load { force, moment: Vector::zero() }, ..sliding() };
        let craft = Craft { gravity: Vector([-1.0, 0.0, 0.0]), ..craft(&link) };
        let found = craft.motion().expect("regular");
        let expected = (1.0 + 0.5 - 5.0 * 0.5 - 2.0 * 0.25 - 3.0) / 3.0;
        assert!((found.joints[0] - expected).abs() <= ROUNDING, "{found:?}");
        let Needed { hub, motors, .. } = craft.needed(&found);
        assert!((motors[0] - 1.0).abs() <= ROUNDING, "{motors:?}");
        // The hub's own weight, and what the spring, the damper and the motor leave on it.
        let on_hub = 2.0 + 1.0 - 5.0 * 0.5 - 2.0 * 0.25;
        assert!((hub.force.0[0] - on_hub).abs() <= ROUNDING, "{hub:?}");
        assert_eq!(hub.force.0[2], -7.0, "what the external force needs");
    }

    /// A rod from its hinge at an angle q to a uniform field g along -y: `q'' = -m g l cos q / I`,
    /// and what a prescribed acceleration needs beyond that.
    #[test]
    fn a_hinged_rod_falls_as_a_pendulum() {
        let (length, angle) = (0.5, 0.3_f64);
        let link = Link {
            axis: 2,
            slides: false,
            centre: Vector([length, 0.0, 0.0]),
            inertia: Tensor::identity(),
            passive: Passive::none(),
            coordinate: angle,
            rate: 2.0,
            motor: 0.0,
            ..sliding()
        };
        let craft = Craft { gravity: Vector([0.0, -9.0, 0.0]), ..craft(&link) };
        let weight = -3.0 * 9.0 * length * angle.cos();
        let inertia = 1.0 + 3.0 * length * length;
        let found = craft.motion().expect("regular");
        assert!((found.joints[0] - weight / inertia).abs() <= ROUNDING, "{found:?}");
        let held = Link { mode: Mode::Prescribed(4.0), ..link };
        let held = Craft { gravity: craft.gravity, ..self::craft(&held) };
        let needed = held.needed(&held.motion().expect("regular"));
        assert!((needed.motors[0] - (4.0 * inertia - weight)).abs() <= 10.0 * ROUNDING);
    }
}
