//! Derivatives of the loads, from the tip to the hub, by the composite outboard of each joint.
//!
//! With m, S and I of the composite outboard of a joint about its origin, p and Y its [`Momenta`], and omega, alpha and a
//! the motion of the axes at the origin, the load (f, n) at the joint changes with that motion by
//!
//! ```text
//! df = m da + dalpha x S + 2 domega x p + (omega x domega) x S
//! dn = S x da + I dalpha + Y domega + I (omega x domega)
//! ```
//!
//! The load itself is that at an origin which does not accelerate, and m a and S x a more.
//!
//! A joint that turns about e turns all that is outboard of it: to the outboard bodies that is as if the motion of the
//! origin had been turned the other way, and the load with them. A rate of e changes omega by e and alpha by omega x e.
//! So each joint has three columns, by its coordinate, rate and acceleration, which move to the hub as loads do. What the
//! motor of an outboard joint changes by, per change of the motion of an inboard origin, is by the symmetry of the mass
//! matrix its own column by acceleration, (F, A), and by omega `A x omega + g`, where g is `Y^T e` at its own joint and
//! gets `2 u x F` from an origin that moves at u.

use super::loads::outwards;
use super::momenta::Momenta;
use crate::derivation::chain::mass_properties::MassProperties;
use crate::derivation::chain::motion::Motion;
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::chain::{Chain, Coordinate, Link};
use crate::derivation::heading::Heading;
use crate::derivation::script::{Script, pairs, triple};
use crate::graph::Expr;
use crate::kinds;
use crate::space::Axis::{X, Y, Z};
use crate::space::{BodyFrame, Hub, Vector};

/// Derivatives of one load by everything that belongs to a joint.
#[derive(Clone, Copy)]
pub(crate) struct ByJoint<L> {
    pub(crate) coordinate: L,
    pub(crate) rate: L,
    pub(crate) acceleration: L,
}

impl<L: Copy> ByJoint<L> {
    /// By the coordinate, the rate and the acceleration.
    pub(crate) fn each(&self) -> [L; 3] {
        [self.coordinate, self.rate, self.acceleration]
    }

    fn map<M>(self, f: impl Fn(L) -> M) -> ByJoint<M> {
        let Self { coordinate, rate, acceleration } = self;
        ByJoint { coordinate: f(coordinate), rate: f(rate), acceleration: f(acceleration) }
    }
}

/// All derivatives of one device, expressed in its axes, about B; joints from the hub outwards.
pub(crate) struct LoadDerivatives<'g> {
    /// Of the load on the device, by each joint.
    pub(crate) by_joint: Vec<ByJoint<Wrench<'g, Hub>>>,
    /// Of what the motor of joint k exerts, by joint j: `motors[k][j]`.
    pub(crate) motors: Vec<Vec<ByJoint<Expr<'g>>>>,
    /// Of the load on the device, by components of the hub's angular velocity.
    pub(crate) by_omega: [Wrench<'g, Hub>; 3],
    /// By those of its angular acceleration.
    pub(crate) by_omega_dot: [Wrench<'g, Hub>; 3],
    /// Of what the motor of each joint exerts, by both.
    pub(crate) motors_by_hub: Vec<[Vector<'g, Hub>; 2]>,
}

/// What a joint has, expressed in the axes of a body inboard of it, about that body's origin.
#[derive(Clone, Copy)]
struct JointColumns<'g> {
    of_load: ByJoint<Wrench<'g, BodyFrame>>,
    /// `g`.
    by_omega: Vector<'g, BodyFrame>,
}

/// The motion of a body's axes and of its origin.
#[derive(Clone, Copy)]
struct Base<'g> {
    omega: Vector<'g, BodyFrame>,
    alpha: Vector<'g, BodyFrame>,
    acceleration: Vector<'g, BodyFrame>,
}

/// How a joint changes it: what the outboard bodies see.
struct Change<'g> {
    omega: Vector<'g, BodyFrame>,
    /// Of alpha, with `omega x` the change of omega.
    alpha: Vector<'g, BodyFrame>,
    acceleration: Vector<'g, BodyFrame>,
}

/// The composite outboard of a joint, about its origin.
struct Outboard<'g> {
    composite: MassProperties<'g>,
    momenta: Momenta<'g>,
    /// What it requires while its origin does not accelerate.
    load: Wrench<'g, BodyFrame>,
}

/// Writes the steps to `script`.
pub(crate) fn load_derivatives<'g>(
    chain: &Chain<'g>,
    script: &mut Script<'g>,
) -> LoadDerivatives<'g> {
    let graph = chain.graph;
    let motions = outwards(chain, script);
    let mut outboard = Outboard {
        composite: MassProperties::zero(graph),
        momenta: Momenta::zero(graph),
        load: Wrench::zero(graph),
    };
    let mut columns: Vec<JointColumns<'g>> = Vec::new();
    let mut motors: Vec<Vec<ByJoint<Expr<'g>>>> = Vec::new();
    for (k, link) in chain.links.iter().enumerate().rev() {
        let (data, motion) = (&chain.kind.links[k], &motions[k]);
        let body = MassProperties::of_body(link, data, script);
        outboard.add(&body, motion);
        describe(data, &outboard, script);
        let base = Base::of(link, motion);
        let own = outboard.columns(link, &base);
        describe_columns(data, &own, script);
        let changes = link.changes(&base);
        let mut row = vec![own.of_load.map(|load| load.along(link))];
        row.extend(columns.iter().map(|of| of.of_load.map(|load| load.along(link))));
        for (column, of_motor) in columns.iter().zip(&mut motors) {
            of_motor.insert(0, column.motor(link, &changes));
        }
        motors.insert(0, row);
        columns.insert(0, own);
        let parent = k.checked_sub(1).map(|inner| motions[inner].axes);
        let omega =
            parent.unwrap_or_else(|| chain.hub.omega.as_parent_frame().relabelled_inboard());
        outboard.inwards(link, omega, &mut columns);
    }
    outboard.at_hub(chain, &columns, motors)
}

impl<'g> Base<'g> {
    fn of(link: &Link<'g>, motion: &Motion<'g>) -> Self {
        Self {
            omega: motion.axes,
            alpha: motion.axes.component_rates(),
            acceleration: motion.origin.acceleration.turned(link.turn),
        }
    }
}

impl<'g> Link<'g> {
    /// Whether the joint turns a body that looks the same from every angle, whose axes stay.
    fn turns_symmetric_rotor(&self) -> bool {
        matches!(self.coordinate, Coordinate::Angle(_)) && self.turn.is_none()
    }

    /// By its coordinate and by its rate.
    fn changes(&self, base: &Base<'g>) -> [Change<'g>; 2] {
        let (e, omega, zero) = (self.axis, base.omega, Vector::zero(self.rate.graph()));
        let sideways = omega.cross(e);
        let twice = sideways + sideways;
        match self.coordinate {
            Coordinate::Angle(_) => {
                let turned = e.cross(omega);
                [
                    Change {
                        omega: -turned,
                        alpha: -(e.cross(base.alpha) + omega.cross(turned)),
                        acceleration: -e.cross(base.acceleration),
                    },
                    Change { omega: e, alpha: twice, acceleration: zero },
                ]
            }
            Coordinate::Length(_) => [
                Change {
                    omega: zero,
                    alpha: zero,
                    acceleration: base.alpha.cross(e) + omega.cross(sideways),
                },
                Change { omega: zero, alpha: zero, acceleration: twice },
            ],
        }
    }
}

impl<'g> Outboard<'g> {
    /// Adds a body about its joint's origin.
    fn add(&mut self, body: &MassProperties<'g>, motion: &Motion<'g>) {
        let (omega, axes) = (motion.omega, motion.axes);
        self.composite = self.composite.plus(*body);
        self.momenta = self.momenta.plus(Momenta::of_body(body, omega));
        self.load = self.load.plus(Wrench {
            force: body.first_moment.prime(axes).prime(axes),
            moment: body.inertia.times(omega).prime(axes),
        });
    }

    /// What the load at the origin changes by.
    fn changed(&self, by: &Change<'g>) -> Wrench<'g, BodyFrame> {
        let MassProperties { mass, first_moment, inertia } = self.composite;
        Wrench {
            force: mass * by.acceleration
                + by.omega.cross(self.momenta.momentum)
                + by.alpha.cross(first_moment),
            moment: first_moment.cross(by.acceleration)
                + self.momenta.times(by.omega)
                + inertia.times(by.alpha),
        }
    }

    /// The columns of the joint, about its origin where it was.
    fn columns(&self, link: &Link<'g>, base: &Base<'g>) -> JointColumns<'g> {
        let MassProperties { mass, first_moment, .. } = self.composite;
        let Wrench { force, moment } = self.load;
        let (e, zero) = (link.axis, Wrench::zero(link.rate.graph()));
        let acceleration = self.composite.column(link);
        if link.turns_symmetric_rotor() {
            let moment = base.omega.cross(acceleration.moment);
            let rate = Wrench { moment, ..zero };
            let of_load = ByJoint { coordinate: zero, rate, acceleration };
            return JointColumns { of_load, by_omega: moment };
        }
        let [by_coordinate, by_rate] = link.changes(base);
        let rate = self.changed(&by_rate);
        let (coordinate, by_omega) = match link.coordinate {
            Coordinate::Angle(_) => {
                // The part by the acceleration a is e x (S x a) - S x (e x a).
                let moves =
                    Change { acceleration: Vector::zero(link.rate.graph()), ..by_coordinate };
                let turned = Wrench {
                    force: e.cross(force),
                    moment: e.cross(moment) + e.cross(first_moment).cross(base.acceleration),
                };
                (self.changed(&moves).plus(turned), self.momenta.transposed_times(e))
            }
            Coordinate::Length(_) => {
                let moment = e.cross(mass * base.acceleration + force);
                let moved = Wrench { moment, ..zero };
                (self.changed(&by_coordinate).plus(moved), self.momenta.momentum.cross(e))
            }
        };
        JointColumns { of_load: ByJoint { coordinate, rate, acceleration }, by_omega }
    }

    /// Everything about the parent body's origin; `omega` is that of its axes.
    fn inwards(
        &mut self,
        link: &Link<'g>,
        omega: Vector<'g, BodyFrame>,
        columns: &mut [JointColumns<'g>],
    ) {
        let arm = link.origin.relabelled_inboard();
        let u = omega.cross(arm) + link.origin.component_rates().relabelled_inboard();
        let twice_u = u + u;
        let turned = self.composite.in_parent_axes(link).relabelled_inboard();
        self.momenta = self.momenta.in_parent_frame(link, &turned, twice_u);
        let back = |v: Vector<'g, BodyFrame>| v.turned(link.turn.inverse()).relabelled_inboard();
        let along = arm.prime(omega).prime(omega);
        let force = back(self.load.force) + turned.mass * along;
        let about = turned.first_moment.cross(along) + arm.cross(force);
        self.load = Wrench { force, moment: back(self.load.moment) + about };
        self.composite = turned.shifted(arm);
        for column in columns {
            column.of_load = column.of_load.map(|load| load.in_parent_frame(link));
            let turned = column.by_omega.turned(link.turn.inverse()).relabelled_inboard();
            column.by_omega = turned + twice_u.cross(column.of_load.acceleration.force);
        }
    }

    fn at_hub(
        &self,
        chain: &Chain<'g>,
        columns: &[JointColumns<'g>],
        motors: Vec<Vec<ByJoint<Expr<'g>>>>,
    ) -> LoadDerivatives<'g> {
        let graph = chain.graph;
        let omega: Vector<'g, BodyFrame> = chain.hub.omega.as_parent_frame().relabelled_inboard();
        let zero = Vector::zero(graph);
        let units = [X, Y, Z].map(|axis| Vector::<BodyFrame>::unit(graph, axis));
        let by = |change: Change<'g>| on_hub(self.changed(&change));
        LoadDerivatives {
            by_joint: columns.iter().map(|of| of.of_load.map(on_hub)).collect(),
            motors,
            by_omega: units
                .map(|e| by(Change { omega: e, alpha: omega.cross(e), acceleration: zero })),
            by_omega_dot: units.map(|e| by(Change { omega: zero, alpha: e, acceleration: zero })),
            motors_by_hub: columns
                .iter()
                .map(|of| {
                    let moment = of.of_load.acceleration.moment;
                    [moment.cross(omega) + of.by_omega, moment].map(vector_on_hub)
                })
                .collect(),
        }
    }
}

impl<'g> JointColumns<'g> {
    /// What the joint's motor changes by where the motion of the origin of an inboard `link` does.
    fn motor(&self, link: &Link<'g>, [coordinate, rate]: &[Change<'g>; 2]) -> ByJoint<Expr<'g>> {
        let column = self.of_load.acceleration;
        let by = |change: &Change<'g>| {
            let by_alpha = column.moment.dot(change.alpha);
            self.by_omega.dot(change.omega) + by_alpha + column.force.dot(change.acceleration)
        };
        ByJoint { coordinate: by(coordinate), rate: by(rate), acceleration: column.along(link) }
    }
}

fn vector_on_hub<'g>(v: Vector<'g, BodyFrame>) -> Vector<'g, Hub> {
    v.relabelled_outboard().on_hub()
}

fn on_hub<'g>(load: Wrench<'g, BodyFrame>) -> Wrench<'g, Hub> {
    Wrench { force: vector_on_hub(load.force), moment: vector_on_hub(load.moment) }
}

/// Names the composite outboard of a joint and its momenta.
fn describe<'g>(data: &kinds::Link, outboard: &Outboard<'g>, script: &mut Script<'g>) {
    let (body, assembly) = (&data.body, data.assembly);
    outboard.composite.name(data, script);
    let letter = body.letters[0];
    let what = format!("Twice the momentum of {} relative to {letter}", assembly.to_uppercase());
    let heading = Heading::new(what).cited("as in", body.equations.h).unit("kg m/s");
    script.section(
        "mom",
        heading.note("and twice its moment, `2 sum m ((r . v) 1 - v r^T)`, kg m²/s"),
    );
    let Momenta { momentum, moment } = outboard.momenta;
    let stem = format!("twice_p_{assembly}");
    script.names(pairs(triple(&stem, body.frame), momentum.components()));
    for (row, entries) in moment.into_iter().enumerate() {
        let names = [1, 2, 3].map(|column| format!("y_{assembly}_{}{column}", row + 1));
        script.names(pairs(names, entries.components()));
    }
}

/// Names the columns of a joint, expressed in the axes of its body.
fn describe_columns<'g>(data: &kinds::Link, own: &JointColumns<'g>, script: &mut Script<'g>) {
    let (body, joint, whole) = (&data.body, &data.joint, data.assembly.to_uppercase());
    if data.is_locked() {
        return;
    }
    let what = format!("Load on {whole}, differentiated");
    let names = [joint.coordinate, joint.rate, joint.acceleration];
    let note = format!("by `{}`, `{}` and `{}`", names[0], names[1], names[2]);
    let heading = Heading::new(what).cited("as in", body.equations.about_origin);
    script.section("col", heading.about(body.letters[0]).note(note));
    for (of, by) in own.of_load.each().into_iter().zip(names) {
        script.names(of.named(&format!("own_by_{by}"), body.frame));
    }
    script.names(pairs(
        triple(&format!("own_{}_by_omega", joint.torque), body.frame),
        own.by_omega.components(),
    ));
}
