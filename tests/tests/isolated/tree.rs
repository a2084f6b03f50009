//! A tree of rigid bodies by Newton and Euler in inertial axes: the independent formulation.
//!
//! Every body is a link with one joint; a platform is six links, five of them without mass. Nothing
//! is eliminated and nothing is known of platforms: motion goes outwards link by link, wrenches come
//! back, the mass matrix is what unit accelerations need, and one dense system is solved by LU.
//! Struts pull at points of two bodies.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use precess_dynamics::kind::{JointInfo, Kind};
use precess_dynamics::{Each, Hub, Mode, Passive, Strut, Wrench};
use precess_tests::double_double::DoubleDouble;

use crate::linear::solved;

/// One link: a joint and its child body.
#[derive(Clone, Debug)]
pub(crate) struct Link {
    pub(crate) info: &'static JointInfo,
    /// The link that carries it; none on the hub.
    pub(crate) base: Option<usize>,
    /// Axes at zero, expressed in the base, by columns.
    pub(crate) mount: Matrix3<f64>,
    pub(crate) origin: Vector3<f64>,
    pub(crate) mass: f64,
    pub(crate) centre: Vector3<f64>,
    pub(crate) inertia: Matrix3<f64>,
    pub(crate) passive: Passive<f64>,
    pub(crate) q: f64,
    pub(crate) rate: f64,
    pub(crate) motor: f64,
    pub(crate) mode: Mode,
    pub(crate) wrench: Wrench,
}

/// A strut between a link and its platform's base.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    pub(crate) base: Option<usize>,
    pub(crate) on_base: Vector3<f64>,
    pub(crate) platform: usize,
    pub(crate) on_platform: Vector3<f64>,
    pub(crate) strut: Strut,
}

/// The field `at_b + G (r - r_b)` and what a central field adds at B, inertial axes.
#[derive(Clone, Debug)]
pub(crate) struct Field {
    pub(crate) at_b: Vector3<f64>,
    pub(crate) gradient: Matrix3<f64>,
    pub(crate) central: Option<(f64, Vector3<f64>)>,
}

/// The tree, and the motion of its hub.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    pub(crate) hub: Hub,
    pub(crate) links: Vec<Link>,
    pub(crate) lines: Vec<Line>,
    /// B axes in N by columns.
    pub(crate) axes: Matrix3<f64>,
    pub(crate) r: Vector3<f64>,
    pub(crate) v: Vector3<f64>,
    /// Inertial axes.
    pub(crate) omega: Vector3<f64>,
    pub(crate) force: Vector3<f64>,
    pub(crate) torque: Vector3<f64>,
    pub(crate) field: Field,
    /// Springs and dampers that couple links: link, torque, sum of the magnitudes of its terms.
    pub(crate) coupled: Vec<(usize, f64, f64)>,
    /// Their torques for the judge.
    pub(crate) coupled_exactly: Vec<(usize, DoubleDouble)>,
    /// Their energy, J.
    pub(crate) coupled_energy: f64,
}

/// Motion of a body: axes, origin from B, velocity, angular velocity, accelerations, inertial axes.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) axes: Matrix3<f64>,
    pub(crate) r: Vector3<f64>,
    pub(crate) v: Vector3<f64>,
    pub(crate) omega: Vector3<f64>,
    pub(crate) a: Vector3<f64>,
    pub(crate) alpha: Vector3<f64>,
    /// Sums of the magnitudes of the terms of `a` and of `alpha`.
    pub(crate) sizes: [f64; 2],
}

/// What Newton and Euler require.
pub(crate) struct Needed {
    /// Force on the hub and moment about B, inertial axes, besides what acts.
    pub(crate) hub: [Vector3<f64>; 2],
    /// Of each joint along its axis, besides what acts.
    pub(crate) joints: Vec<f64>,
    /// Of each joint, about its origin, in the link's axes.
    pub(crate) wrenches: Vec<[Vector3<f64>; 2]>,
    /// Of each row, six of the hub and one per joint, the sum of the magnitudes of its terms.
    pub(crate) sizes: Vec<f64>,
    /// Those of force and moment of each joint.
    pub(crate) wrench_sizes: Vec<[f64; 2]>,
}

/// Accelerations of a [`Tree`].
pub(crate) struct Solved {
    pub(crate) a: Vector3<f64>,
    pub(crate) alpha: Vector3<f64>,
    pub(crate) joints: Vec<f64>,
    /// What each changes by when every equation changes by the sum of its terms' magnitudes: the
    /// unit of the error that rounding of the equations explains.
    pub(crate) conditions: Vec<f64>,
}

fn axis(index: usize) -> Vector3<f64> {
    let mut axis = Vector3::zeros();
    axis[index] = 1.0;
    axis
}

impl Tree {
    pub(crate) fn new(hub: &Hub) -> Self {
        let none = Vector3::zeros();
        let field = Field { at_b: none, gradient: Matrix3::zeros(), central: None };
        Self {
            hub: *hub,
            links: Vec::new(),
            lines: Vec::new(),
            axes: Matrix3::identity(),
            r: none,
            v: none,
            omega: none,
            force: none,
            torque: none,
            field,
            coupled: Vec::new(),
            coupled_exactly: Vec::new(),
            coupled_energy: 0.0,
        }
    }

    /// Adds a device on the hub or on a link; returns its last link.
    pub(crate) fn device<K: Kind<Scalar = f64>>(
        &mut self,
        base: Option<usize>,
        device: &K,
    ) -> usize {
        let mut inboard = base;
        let (bodies, passive) = (device.bodies(), device.passive());
        let bodies = bodies.values().zip(passive.values());
        for ((body, passive), info) in bodies.zip(K::JOINTS) {
            let first = info.index == 0;
            self.links.push(Link {
                info,
                base: inboard,
                mount: if first { *device.mount() } else { Matrix3::identity() },
                origin: body.origin.into(),
                mass: body.mass,
                centre: body.centre.into(),
                inertia: body.inertia,
                passive,
                q: 0.0,
                rate: 0.0,
                motor: 0.0,
                mode: Mode::Driven,
                wrench: Wrench::none(),
            });
            inboard = Some(self.links.len() - 1);
        }
        self.links.len() - 1
    }

    /// The hub and then every link, for accelerations of hub and joints.
    pub(crate) fn motion(&self, a: Vector3<f64>, alpha: Vector3<f64>, joints: &[f64]) -> Vec<Body> {
        let sizes = [a.norm(), alpha.norm()];
        // From B: in a distant orbit positions from the inertial origin lose digits.
        let (axes, r, v, omega) = (self.axes, Vector3::zeros(), self.v, self.omega);
        let hub = Body { axes, r, v, omega, a, alpha, sizes };
        let mut bodies = vec![hub];
        for (link, q_ddot) in self.links.iter().zip(joints) {
            let base = bodies[link.base.map_or(0, |base| base + 1)].clone();
            let zero = base.axes * link.mount;
            let local = axis(link.info.axis);
            let along = zero * local;
            let arm = base.axes * link.origin
                + if link.info.slides { along * link.q } else { Vector3::zeros() };
            let turned = |v: &Vector3<f64>, w: &Vector3<f64>| w.cross(&w.cross(v));
            let mut body = Body {
                axes: zero,
                r: base.r + arm,
                v: base.v + base.omega.cross(&arm),
                omega: base.omega,
                a: base.a + base.alpha.cross(&arm) + turned(&arm, &base.omega),
                alpha: base.alpha,
                sizes: base.sizes,
            };
            body.sizes[0] += (base.sizes[1] + base.omega.norm_squared()) * arm.norm();
            let turning = 2.0 * base.omega.norm() * link.rate.abs() + q_ddot.abs();
            body.sizes[usize::from(!link.info.slides)] += turning;
            if link.info.slides {
                body.v += along * link.rate;
                body.a += along * *q_ddot + 2.0 * base.omega.cross(&(along * link.rate));
            } else {
                let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(local), link.q);
                body.axes = zero * turn.matrix();
                body.omega += along * link.rate;
                body.alpha += along * *q_ddot + base.omega.cross(&(along * link.rate));
            }
            bodies.push(body);
        }
        bodies
    }

    pub(crate) fn bodies(&self) -> Vec<(f64, Vector3<f64>, Matrix3<f64>)> {
        let hub = (self.hub.m_b, self.hub.r_bc_b, self.hub.i_b_bc);
        let links = self.links.iter().map(|link| (link.mass, link.centre, link.inertia));
        core::iter::once(hub).chain(links).collect()
    }

    /// Inverse dynamics: what is needed besides gravity, wrenches, struts, force and torque.
    pub(crate) fn needed(&self, a: Vector3<f64>, alpha: Vector3<f64>, joints: &[f64]) -> Needed {
        let moving = self.motion(a, alpha, joints);
        // Force and moment about each body's origin, and magnitudes.
        let mut wrenches = Vec::new();
        let mut sizes = Vec::new();
        for ((mass, centre, inertia), body) in self.bodies().into_iter().zip(&moving) {
            let arm = body.axes * centre;
            let inertia = body.axes * inertia * body.axes.transpose();
            let of_centre =
                body.a + body.alpha.cross(&arm) + body.omega.cross(&body.omega.cross(&arm));
            let gravity = self.field.at_b + self.field.gradient * (body.r + arm);
            // The integral of rho x G rho: by the second moment about the centre of mass.
            let second = Matrix3::identity() * (0.5 * inertia.trace()) - inertia;
            let product = self.field.gradient * second;
            let twist = Vector3::new(
                product[(2, 1)] - product[(1, 2)],
                product[(0, 2)] - product[(2, 0)],
                product[(1, 0)] - product[(0, 1)],
            );
            let force = mass * (of_centre - gravity);
            let gyroscopic = body.omega.cross(&(inertia * body.omega));
            let turning = inertia * body.alpha + gyroscopic - twist;
            wrenches.push([force, turning + arm.cross(&force)]);
            let [of_origin, of_turning] = body.sizes;
            let swing = (of_turning + body.omega.norm_squared()) * centre.norm();
            let size = mass * (of_origin + swing + gravity.norm() + self.field.at_b.norm());
            let gyroscopic = of_turning + body.omega.norm_squared();
            sizes.push([size, inertia.norm() * gyroscopic + arm.norm() * size]);
        }
        let act = |wrenches: &mut Vec<[Vector3<f64>; 2]>, body: usize, f: Vector3<f64>, n| {
            wrenches[body][0] -= f;
            wrenches[body][1] -= n;
        };
        for (index, link) in self.links.iter().enumerate() {
            let axes = &moving[index + 1].axes;
            let Wrench { force, moment } = link.wrench;
            act(&mut wrenches, index + 1, axes * force, axes * moment);
            sizes[index + 1][0] += force.norm();
            sizes[index + 1][1] += moment.norm();
        }
        for line in &self.lines {
            let (base, platform) = (line.base.map_or(0, |base| base + 1), line.platform + 1);
            let (from, to) =
                (moving[base].axes * line.on_base, moving[platform].axes * line.on_platform);
            let ends = (moving[platform].r + to) - (moving[base].r + from);
            let speed = moving[platform].v + moving[platform].omega.cross(&to)
                - moving[base].v
                - moving[base].omega.cross(&from);
            let along = ends.normalize();
            let tension = line.strut.stiffness * (ends.norm() - line.strut.length)
                + line.strut.damping * speed.dot(&along);
            let pull = along * tension;
            act(&mut wrenches, base, pull, from.cross(&pull));
            act(&mut wrenches, platform, -pull, to.cross(&-pull));
            // The length is a difference of lengths.
            let size = line.strut.stiffness * line.strut.length + tension.abs();
            for (body, arm) in [(base, from), (platform, to)] {
                sizes[body][0] += size;
                sizes[body][1] += size * arm.norm();
            }
        }
        wrenches[0][0] -= self.force + self.third_order(&moving);
        wrenches[0][1] -= self.torque;

        let mut needed = vec![0.0; self.links.len()];
        let mut rows = vec![0.0; 6 + self.links.len()];
        let mut wrench_sizes = vec![[0.0; 2]; self.links.len()];
        let mut local = vec![[Vector3::zeros(); 2]; self.links.len()];
        for index in (0..self.links.len()).rev() {
            let link = &self.links[index];
            let body = &moving[index + 1];
            let ([force, moment], [of_force, of_moment]) = (wrenches[index + 1], sizes[index + 1]);
            let own = [force, moment].map(|v| body.axes.transpose() * v);
            (local[index], wrench_sizes[index]) = (own, [of_force, of_moment]);
            needed[index] = own[usize::from(!link.info.slides)][link.info.axis];
            rows[6 + index] = if link.info.slides { of_force } else { of_moment };
            let base = link.base.map_or(0, |base| base + 1);
            let arm = body.r - moving[base].r;
            wrenches[base][0] += force;
            wrenches[base][1] += moment + arm.cross(&force);
            sizes[base][0] += of_force;
            sizes[base][1] += of_moment + arm.norm() * of_force;
        }
        for row in 0..3 {
            (rows[row], rows[3 + row]) = (sizes[0][0], sizes[0][1]);
        }
        Needed { hub: wrenches[0], joints: needed, wrenches: local, sizes: rows, wrench_sizes }
    }

    /// Third-order force of a central field on the whole, at B.
    pub(crate) fn third_order(&self, moving: &[Body]) -> Vector3<f64> {
        let Some((mu, n)) = self.field.central else { return Vector3::zeros() };
        let mut second = Matrix3::zeros();
        for ((mass, centre, inertia), body) in self.bodies().into_iter().zip(moving) {
            let inertia = body.axes * inertia * body.axes.transpose();
            let r = body.r + body.axes * centre;
            second += Matrix3::identity() * (0.5 * inertia.trace()) - inertia;
            second += mass * r * r.transpose();
        }
        let along = second * n;
        let slope = mu / self.r.norm_squared().powi(2);
        3.0 * slope * (along + (0.5 * second.trace() - 2.5 * n.dot(&along)) * n)
    }

    /// The same at rest, with nothing acting.
    fn still(&self) -> Self {
        let mut still = Self { lines: Vec::new(), coupled: Vec::new(), ..Self::new(&self.hub) };
        (still.axes, still.r, still.links) = (self.axes, self.r, self.links.clone());
        for link in &mut still.links {
            (link.rate, link.wrench) = (0.0, Wrench::none());
        }
        still
    }

    /// Accelerations of B and of the hub in inertial axes, and of the joints, by one dense system;
    /// and for each row what it changes by when each equation changes by its size.
    pub(crate) fn accelerations(&self) -> Solved {
        let size = 6 + self.links.len();
        let mut rest = vec![0.0; self.links.len()];
        let mut held = vec![false; size];
        for (index, link) in self.links.iter().enumerate() {
            match link.mode {
                Mode::Driven => {}
                Mode::Prescribed(acceleration) => {
                    (rest[index], held[6 + index]) = (acceleration, true);
                }
                Mode::Locked => held[6 + index] = true,
            }
        }
        let stacked = |needed: &Needed| -> Vec<f64> {
            let [force, moment] = needed.hub;
            let joints = needed.joints.iter().copied();
            force.iter().chain(&moment).copied().chain(joints).collect()
        };
        let none = Vector3::zeros();
        let bias = stacked(&self.needed(none, none, &rest));
        let still = self.still();
        let mut m = vec![vec![0.0; size]; size];
        for column in 0..size {
            let mut unit = vec![0.0; size];
            unit[column] = 1.0;
            let given = |at: usize| Vector3::new(unit[at], unit[at + 1], unit[at + 2]);
            let needed = stacked(&still.needed(given(0), given(3), &unit[6..]));
            for (row, needed) in m.iter_mut().zip(needed) {
                row[column] = needed;
            }
        }
        let torques = [0.0; 6].into_iter().chain(self.torques());
        let mut right: Vec<f64> = torques.zip(bias).map(|(torque, bias)| torque - bias).collect();
        for index in (0..size).filter(|&index| held[index]) {
            for row in &mut m {
                row[index] = 0.0;
            }
            m[index].fill(0.0);
            m[index][index] = 1.0;
            right[index] = 0.0;
        }
        let found = solved(&m, &right);
        let joints = rest.iter().zip(&found[6..]).map(|(a, b)| a + b).collect();
        let vector = |at: usize| Vector3::new(found[at], found[at + 1], found[at + 2]);
        let (a, alpha, joints): (_, _, Vec<f64>) = (vector(0), vector(3), joints);
        let sizes = self.needed(a, alpha, &joints).sizes;
        let torques = [0.0; 6].into_iter().chain(self.torque_sizes());
        let mut conditions = vec![0.0; size];
        for (row, (of_row, torque)) in sizes.iter().zip(torques).enumerate() {
            let mut unit = vec![0.0; size];
            unit[row] = if held[row] { 0.0 } else { of_row + torque };
            for (sum, change) in conditions.iter_mut().zip(solved(&m, &unit)) {
                *sum += change.abs();
            }
        }
        Solved { a, alpha, joints, conditions }
    }
}
