//! Newton and Euler of every link in double-double, expressed in B: the judge of accelerations.
//!
//! The same tree as [`Tree`], with no more digits lost than its numbers have: motion outwards,
//! wrenches inwards, one dense system.

use precess_dynamics::{Angle, Attitude, Devices, Gravity, Mode, Real, Scalar};
use precess_tests::double_double::DoubleDouble as DD;
use precess_tests::newton_euler::vector::{Tensor, Vector, cross, dot, tilde};

use crate::craft::Craft;
use crate::tree::{Link, Tree};

/// A field at B and its gradient; of a central body `mu / R⁴` and the direction from the centre.
type Field = (Vector<DD>, Tensor<DD>, Option<(DD, Vector<DD>)>);

/// Force and moment.
type Pair = [Vector<DD>; 2];

fn dd(value: f64) -> DD {
    DD::from_f64(value)
}

fn vector(v: &nalgebra::Vector3<f64>) -> Vector<DD> {
    Vector([v.x, v.y, v.z].map(dd))
}

fn tensor(m: &nalgebra::Matrix3<f64>) -> Tensor<DD> {
    Tensor::from(&m.map(dd))
}

/// Axes and place of a body, from B; velocity, angular velocity and their derivatives, inertial.
#[derive(Clone, Copy)]
struct Body {
    axes: Tensor<DD>,
    r: Vector<DD>,
    v: Vector<DD>,
    omega: Vector<DD>,
    a: Vector<DD>,
    alpha: Vector<DD>,
}

/// A tree, its rates and what acts on it.
struct Judge<'a> {
    tree: &'a Tree,
    omega: Vector<DD>,
    rates: Vec<DD>,
    /// What attracts the bodies.
    field: Field,
    /// Whether anything acts.
    acting: bool,
    force: Vector<DD>,
    torque: Vector<DD>,
}

/// `a_B` and omega', expressed in B, and the joints' accelerations.
pub(crate) fn accelerations<D: Devices<Scalar = f64>>(of: &Craft<D>) -> Vec<f64> {
    let tree = &of.tree;
    let judge = Judge {
        tree,
        omega: vector(&of.state.omega),
        rates: tree.links.iter().map(|link| dd(link.rate)).collect(),
        field: field(of),
        acting: true,
        force: vector(&of.inputs.force),
        torque: vector(&of.inputs.torque_b),
    };
    let none = (Vector::zero(), Tensor::identity() * dd(0.0), None);
    let still = Judge {
        omega: Vector::zero(),
        rates: vec![dd(0.0); tree.links.len()],
        field: none,
        acting: false,
        ..judge
    };
    let size = 6 + tree.links.len();
    let held = |index: usize| index >= 6 && tree.links[index - 6].mode != Mode::Driven;
    let given = tree.links.iter().map(|link| match link.mode {
        Mode::Prescribed(acceleration) => dd(acceleration),
        Mode::Driven | Mode::Locked => dd(0.0),
    });
    let given: Vec<DD> = vec![dd(0.0); 6].into_iter().chain(given).collect();
    let bias = judge.needed(&given);
    let mut matrix = vec![vec![dd(0.0); size]; size];
    for column in (0..size).filter(|column| !held(*column)) {
        let mut unit = vec![dd(0.0); size];
        unit[column] = dd(1.0);
        for (row, needed) in matrix.iter_mut().zip(still.needed(&unit)) {
            row[column] = needed;
        }
    }
    let mut right: Vec<DD> = bias.into_iter().map(|needed| -needed).collect();
    for index in (0..size).filter(|index| held(*index)) {
        matrix[index] = vec![dd(0.0); size];
        (matrix[index][index], right[index]) = (dd(1.0), dd(0.0));
    }
    let found = solved(matrix, right);
    found.into_iter().zip(given).map(|(a, given)| (a + given).to_f64()).collect()
}

fn field<D: Devices<Scalar = f64>>(of: &Craft<D>) -> Field {
    let nothing = Tensor::identity() * dd(0.0);
    let bn = tensor(&of.state.attitude.dcm());
    match of.inputs.gravity {
        Gravity::None => (Vector::zero(), nothing, None),
        Gravity::Uniform(g) => (bn * vector(&g), nothing, None),
        Gravity::Central { mu } => {
            let r = bn * vector(&of.state.r_b_n);
            let per_r = dot(r, r).sqrt().recip();
            let n = r * per_r;
            let square = dd(mu) * per_r * per_r;
            let gradient = (dyad(n) * dd(3.0) + Tensor::identity() * dd(-1.0)) * (square * per_r);
            (n * -square, gradient, Some((square * per_r * per_r, n)))
        }
    }
}

fn dyad(v: Vector<DD>) -> Tensor<DD> {
    Tensor([0, 1, 2].map(|i| (v * v.0[i]).0))
}

/// `½ tr I 1 - I`.
fn second_moment(inertia: Tensor<DD>) -> Tensor<DD> {
    let trace = inertia.0[0][0] + inertia.0[1][1] + inertia.0[2][2];
    Tensor::identity() * (trace * dd(0.5)) + inertia * dd(-1.0)
}

impl Judge<'_> {
    /// The hub and every link, for accelerations of hub and joints.
    fn motion(&self, given: &[DD]) -> Vec<Body> {
        let triple = |at: usize| Vector([given[at], given[at + 1], given[at + 2]]);
        let hub = Body {
            axes: Tensor::identity(),
            r: Vector::zero(),
            v: Vector::zero(),
            omega: self.omega,
            a: triple(0),
            alpha: triple(3),
        };
        let mut bodies = vec![hub];
        let joints = self.rates.iter().zip(&given[6..]);
        for (link, (rate, q_ddot)) in self.tree.links.iter().zip(joints) {
            let base = bodies[base_of(link)];
            let zero = base.axes * tensor(&link.mount);
            let local = Vector::unit(link.info.axis);
            let along = zero * local;
            let mut arm = base.axes * vector(&link.origin);
            if link.info.slides {
                arm = arm + along * dd(link.q);
            }
            let w = base.omega;
            let mut body = Body {
                axes: zero,
                r: base.r + arm,
                v: base.v + cross(w, arm),
                a: base.a + cross(base.alpha, arm) + cross(w, cross(w, arm)),
                ..base
            };
            if link.info.slides {
                body.v = body.v + along * *rate;
                body.a = body.a + along * *q_ddot + cross(w, along) * (*rate * dd(2.0));
            } else {
                let (sin, cos) = dd(link.q).sin_cos();
                let n = tilde(local);
                body.axes = zero * (Tensor::identity() + n * sin + n * n * (dd(1.0) - cos));
                body.omega = w + along * *rate;
                body.alpha = base.alpha + along * *q_ddot + cross(w, along) * *rate;
            }
            bodies.push(body);
        }
        bodies
    }

    /// What hub and joints need beside what acts, for accelerations of hub and joints.
    fn needed(&self, given: &[DD]) -> Vec<DD> {
        let moving = self.motion(given);
        let (at_b, gradient, central) = self.field;
        let mut wrenches: Vec<Pair> = Vec::new();
        let mut second = Tensor::identity() * dd(0.0);
        for ((mass, centre, inertia), body) in self.tree.bodies().into_iter().zip(&moving) {
            let (mass, arm) = (dd(mass), body.axes * vector(&centre));
            let inertia = tensor(&inertia).resolved_from(body.axes);
            let w = body.omega;
            let of_centre = body.a + cross(body.alpha, arm) + cross(w, cross(w, arm));
            let place = body.r + arm;
            let force = (of_centre - at_b - gradient * place) * mass;
            let own = second_moment(inertia);
            second = second + own + dyad(place) * mass;
            let product = (gradient * own).0;
            let twist = Vector([
                product[2][1] - product[1][2],
                product[0][2] - product[2][0],
                product[1][0] - product[0][1],
            ]);
            let moment = inertia * body.alpha + cross(w, inertia * w) - twist;
            wrenches.push([force, moment + cross(arm, force)]);
        }
        if self.acting {
            self.act(&moving, &mut wrenches);
        }
        if let Some((slope, n)) = central {
            let along = second * n;
            let trace = second.0[0][0] + second.0[1][1] + second.0[2][2];
            let spread = trace * dd(0.5) - dot(n, along) * dd(2.5);
            wrenches[0][0] = wrenches[0][0] - (along + n * spread) * (slope * dd(3.0));
        }
        let mut joints = vec![dd(0.0); self.tree.links.len()];
        for (index, link) in self.tree.links.iter().enumerate().rev() {
            let [force, moment] = wrenches[index + 1];
            let body = &moving[index + 1];
            let along = if link.info.slides { force } else { moment };
            joints[index] = dot(body.axes * Vector::unit(link.info.axis), along);
            let base = base_of(link);
            let [of_force, of_moment] = wrenches[base];
            let moved = moment + cross(body.r - moving[base].r, force);
            wrenches[base] = [of_force + force, of_moment + moved];
        }
        if self.acting {
            for (joint, link) in joints.iter_mut().zip(&self.tree.links) {
                let passive = &link.passive;
                let spring = dd(passive.stiffness) * (dd(link.q) - dd(passive.rest));
                *joint = *joint + spring + dd(passive.viscous) * dd(link.rate) - dd(link.motor);
            }
            for (link, torque) in &self.tree.coupled_exactly {
                joints[*link] = joints[*link] - *torque;
            }
        }
        let [force, moment] = wrenches[0];
        force.0.into_iter().chain(moment.0).chain(joints).collect()
    }

    /// Wrenches on bodies, struts, force and torque on the hub.
    fn act(&self, moving: &[Body], wrenches: &mut [Pair]) {
        let mut pull = |body: usize, force: Vector<DD>, moment: Vector<DD>| {
            let [f, m] = wrenches[body];
            wrenches[body] = [f - force, m - moment];
        };
        pull(0, self.force, self.torque);
        for (index, link) in self.tree.links.iter().enumerate() {
            let axes = moving[index + 1].axes;
            let wrench = &link.wrench;
            pull(index + 1, axes * vector(&wrench.force), axes * vector(&wrench.moment));
        }
        for line in &self.tree.lines {
            let (base, platform) = (line.base.map_or(0, |base| base + 1), line.platform + 1);
            // In line with the platform's point while it is at zero, where its first joint is.
            let first = &self.tree.links[line.platform - 5];
            let ahead =
                vector(&line.on_platform) - vector(&line.strut.direction) * dd(line.strut.length);
            let from = vector(&first.origin) + tensor(&first.mount) * ahead;
            let from = moving[base].axes * from;
            let to = moving[platform].axes * vector(&line.on_platform);
            let ends = moving[platform].r + to - moving[base].r - from;
            let speed = moving[platform].v + cross(moving[platform].omega, to)
                - moving[base].v
                - cross(moving[base].omega, from);
            let length = ends.norm();
            let along = ends * length.recip();
            let tension = dd(line.strut.stiffness) * (length - dd(line.strut.length))
                + dd(line.strut.damping) * dot(speed, along);
            let force = along * tension;
            pull(base, force, cross(from, force));
            pull(platform, force * dd(-1.0), cross(to, force * dd(-1.0)));
        }
    }
}

fn base_of(link: &Link) -> usize {
    link.base.map_or(0, |base| base + 1)
}

/// Elimination with the largest pivot of each column.
fn solved(mut a: Vec<Vec<DD>>, mut b: Vec<DD>) -> Vec<DD> {
    let size = b.len();
    for column in 0..size {
        let by_size = |i: &usize, j: &usize| {
            a[*i][column].abs().to_f64().total_cmp(&a[*j][column].abs().to_f64())
        };
        let largest = (column..size).max_by(by_size).expect("a row");
        a.swap(column, largest);
        b.swap(column, largest);
        for row in column + 1..size {
            let factor = a[row][column] / a[column][column];
            let pivot = a[column].clone();
            for (entry, above) in a[row].iter_mut().zip(pivot).skip(column) {
                *entry = *entry - factor * above;
            }
            b[row] = b[row] - factor * b[column];
        }
    }
    for row in (0..size).rev() {
        let known = (row + 1..size).fold(b[row], |sum, k| sum - a[row][k] * b[k]);
        b[row] = known / a[row][row];
    }
    b
}
