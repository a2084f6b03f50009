//! The symbols of a device and of its hub.

pub mod assumed;
pub mod framed_value;
pub(crate) mod mass_properties;
pub mod motion;
pub mod parallel_axes;
pub mod passes;
pub mod wrench;

use self::assumed::{Assumed, Mount};
use self::passes::Passes;
use crate::graph::{Expr, Graph, Node, Stage};
use crate::kinds::{self, Centre, Kind, Motion};
use crate::space::{BodyFrame, ENTRIES, Hub, ParentFrame, Symmetric, Turn, Vector, XYZ};

/// A device kind with its symbols in a graph.
pub struct Chain<'g> {
    /// The graph of the symbols.
    pub graph: &'g Graph,
    /// The data it was made from.
    pub kind: &'static Kind,
    /// Joints and bodies from the hub outwards.
    pub links: Vec<Link<'g>>,
    /// What belongs to the hub and to the whole.
    pub hub: HubSymbols<'g>,
    /// What the derivation of the equations of motion does to the chain first.
    pub passes: Passes,
    /// What is known of the parameters beforehand; none for a kind as it is.
    pub assumed: Option<Assumed>,
    /// The device's axes expressed in B: `mount`, column by column.
    pub mount: [Vector<'g, Hub>; 3],
}

/// The symbols of a joint and of its child body.
#[derive(Clone, Copy)]
pub struct Link<'g> {
    /// From the parent body's axes to those in which the body's quantities are expressed: they turn
    /// with it where the kind says so.
    pub turn: Turn<'g, ParentFrame, BodyFrame>,
    /// What the joint's coordinate is.
    pub coordinate: Coordinate<'g>,
    /// Unit vector of the joint's axis.
    pub axis: Vector<'g, BodyFrame>,
    /// Joint rate.
    pub rate: Expr<'g>,
    /// Joint acceleration.
    pub acceleration: Expr<'g>,
    /// Motor torque, or force of a sliding joint.
    pub torque: Expr<'g>,
    /// Whether that torque is given, or the acceleration; none where the kind prescribes it.
    pub mode: Option<Mode<'g>>,
    /// Origin of the joint from the parent body's origin; it moves along a sliding one.
    pub origin: Vector<'g, ParentFrame>,
    /// Mass.
    pub mass: Expr<'g>,
    /// Centre of mass from the body's origin.
    pub centre: Vector<'g, BodyFrame>,
    /// Inertia about the centre of mass.
    pub inertia: Symmetric<'g, BodyFrame>,
    /// Mass of this body and all outboard of it: `m_d`, `m_v`.
    pub assembly_mass: Expr<'g>,
}

/// A joint's mode, as numbers: its torque is given (driven), or its acceleration (prescribed; a
/// locked joint is at rest, and zero is given).
#[derive(Clone, Copy)]
pub struct Mode<'g> {
    /// One where the torque is given, else zero.
    pub driven: Expr<'g>,
    /// Zero where the torque is given, else one, in the unit of the pivot.
    pub held: Expr<'g>,
    /// The acceleration where it is given, else zero.
    pub given: Expr<'g>,
}

/// A joint's coordinate.
#[derive(Clone, Copy)]
pub enum Coordinate<'g> {
    /// An angle: from the parent body's axes to those that turn with the body.
    Angle(Turn<'g, ParentFrame, BodyFrame>),
    /// A length.
    Length(Expr<'g>),
}

/// Symbols of the hub and of the whole spacecraft, expressed in B.
pub struct HubSymbols<'g> {
    /// Mass of the whole.
    pub m_sc: Expr<'g>,
    /// Mass of the hub.
    pub m_b: Expr<'g>,
    /// Hub's centre of mass.
    pub r_bc_b: Vector<'g, Hub>,
    /// Hub's inertia about its centre of mass.
    pub i_b_bc: Symmetric<'g, Hub>,
    /// Angular velocity of B.
    pub omega: Vector<'g, Hub>,
    /// Its derivative.
    pub omega_dot: Vector<'g, Hub>,
    /// Inertial velocity of point B.
    pub r_b_n_dot: Vector<'g, Hub>,
    /// Inertial acceleration of point B.
    pub r_b_n_ddot: Vector<'g, Hub>,
    /// Inertial acceleration of the system's centre of mass.
    pub r_c_n_ddot: Vector<'g, Hub>,
}

impl<'g> Chain<'g> {
    /// The symbols of `kind` and of the hub.
    #[must_use]
    pub fn new(graph: &'g Graph, kind: &'static Kind) -> Self {
        Self::after(graph, kind, Passes::ALL)
    }

    /// The same for other passes, to see what they bring.
    #[must_use]
    pub fn after(graph: &'g Graph, kind: &'static Kind, passes: Passes) -> Self {
        Self::made(graph, kind, passes, None)
    }

    /// The symbols that are left of `kind` where this is assumed of its parameters.
    #[must_use]
    pub fn assuming(graph: &'g Graph, kind: &'static Kind, assumed: Assumed) -> Self {
        Self::made(graph, kind, Passes::ALL, Some(assumed))
    }

    fn made(
        graph: &'g Graph,
        kind: &'static Kind,
        passes: Passes,
        assumed: Option<Assumed>,
    ) -> Self {
        let hub = HubSymbols::new(graph);
        let known = assumed.clone().unwrap_or_default();
        let links = (0..kind.links.len()).map(|k| Link::new(graph, kind, k, &known));
        let mut links: Vec<_> = links.collect();
        for k in (0..links.len().saturating_sub(1)).rev() {
            let sum = links[k..].iter().skip(1).fold(links[k].mass, |sum, link| sum + link.mass);
            let name = format!("m_{}", kind.links[k].assembly);
            // The mass of one body is no sum.
            let one = matches!(sum.node(), Node::Symbol(_));
            links[k].assembly_mass = if one { sum } else { graph.abbreviation(&name, sum) };
        }
        let mount = known.mount(graph);
        Self { graph, kind, links, hub, passes, assumed, mount }
    }

    /// The first joint that moves, or the last one: the bodies inboard of it are parts of the hub.
    #[must_use]
    pub fn first_moving(&self) -> usize {
        let links = self.kind.links;
        links.iter().position(|link| !link.is_locked()).unwrap_or(links.len() - 1)
    }

    /// Whether every joint is locked: a body of the hub, without an equation of its own.
    #[must_use]
    pub fn is_rigid(&self) -> bool {
        self.kind.links.iter().all(kinds::Link::is_locked)
    }

    /// Along the device's axes, of a vector along those of the parent body of the first joint that
    /// moves.
    #[must_use]
    pub fn on_first(&self, v: Vector<'g, ParentFrame>) -> Vector<'g, ParentFrame> {
        let inboard = self.links[..self.first_moving()].iter().rev();
        inboard.fold(v, |v, link| v.relabelled_inboard().turned(link.turn.inverse()))
    }

    /// From B to the origin of the first joint that moves, along the device's axes; of each joint up
    /// to it the origin is one of these.
    #[must_use]
    pub fn reach(&self, origins: &[Vector<'g, ParentFrame>]) -> Vector<'g, ParentFrame> {
        let first = self.first_moving();
        let outermost = origins[first];
        let inboard = self.links[..first].iter().zip(&origins[..first]).rev();
        inboard.fold(outermost, |reach, (link, origin)| {
            *origin + reach.relabelled_inboard().turned(link.turn.inverse())
        })
    }

    /// Whether the mount is made of turns, and so part of every reference; else a reference has the
    /// device's axes along those of B.
    #[must_use]
    pub fn mount_is_turned(&self) -> bool {
        self.assumed.as_ref().is_some_and(|assumed| assumed.mount != Mount::Any)
    }
}

impl<'g> Chain<'g> {
    /// Along B axes, of a vector along the device's axes.
    #[must_use]
    pub fn mounted(&self, v: Vector<'g, ParentFrame>) -> Vector<'g, Hub> {
        v.along(self.mount)
    }

    /// Along B axes, of a tensor along the device's axes.
    #[must_use]
    pub fn mounted_tensor(&self, t: Symmetric<'g, ParentFrame>) -> Symmetric<'g, Hub> {
        t.along(self.mount)
    }
}

impl Chain<'_> {
    /// The paper's names of the axes of a frame: zero for the hub, k for the body outboard of joint
    /// k.
    #[must_use]
    pub fn triad(&self, frame: usize) -> [&'static str; 3] {
        let body = frame.checked_sub(1).and_then(|k| self.kind.links.get(k));
        body.map_or(["b_x", "b_y", "b_z"], |link| link.body.triad)
    }
}

impl<'g> Link<'g> {
    fn new(graph: &'g Graph, kind: &Kind, k: usize, assumed: &Assumed) -> Self {
        let parameter = |name: &str| assumed.parameter(graph, name);
        let (joint, body) = (&kind.links[k].joint, &kind.links[k].body);
        let locked = kind.links[k].is_locked();
        let acceleration = graph.symbol(joint.acceleration, Stage::Acceleration);
        let rate = if locked { graph.zero() } else { graph.symbol(joint.rate, Stage::Rate) };
        if !locked {
            graph.set_rate(rate, acceleration);
        }
        let place = joint.place().map(|place| Vector::new(place.names.map(parameter)));
        let rest = place.unwrap_or_else(|| Vector::zero(graph));
        let (coordinate, origin) = match joint.motion {
            Motion::Turn(axis) => {
                let (sin, cos) = if locked {
                    graph.constant_angle(joint.coordinate)
                } else {
                    graph.angle(joint.coordinate, rate)
                };
                (Coordinate::Angle(Turn::about(axis, sin, cos)), rest)
            }
            Motion::Slide(axis) => {
                let stage = if locked { Stage::Parameter } else { Stage::Configuration };
                let length = graph.symbol(joint.coordinate, stage);
                if !locked {
                    graph.set_rate(length, rate);
                }
                (Coordinate::Length(length), rest + length * Vector::unit(graph, axis))
            }
        };
        let mass = || body.mass.map_or_else(|| graph.zero(), parameter);
        let entry = |name: Option<String>| name.map_or(graph.zero(), |name| parameter(&name));
        Self {
            turn: if kind.axes_turn(k) { coordinate.turn(graph) } else { Turn::none(graph) },
            coordinate,
            axis: Vector::unit(graph, joint.motion.axis()),
            rate,
            acceleration,
            torque: graph.symbol(joint.torque, Stage::Rate),
            mode: kind.links[k].is_driven().then(|| Mode::new(graph, joint.tag)),
            origin,
            mass: mass(),
            assembly_mass: mass(),
            centre: match body.centre {
                Centre::Free(triple) => Vector::new(triple.names.map(parameter)),
                Centre::On(axis, distance) => parameter(distance) * Vector::unit(graph, axis),
                Centre::At => Vector::zero(graph),
            },
            inertia: Symmetric::new(body.inertia.names().map(entry)),
        }
    }

    /// Angular velocity of the body relative to its parent body.
    #[must_use]
    pub fn spin(&self) -> Vector<'g, BodyFrame> {
        match self.coordinate {
            Coordinate::Angle(_) => self.rate * self.axis,
            Coordinate::Length(_) => Vector::zero(self.rate.graph()),
        }
    }
}

impl<'g> Mode<'g> {
    fn new(graph: &'g Graph, tag: &str) -> Self {
        let symbol = |stem: &str| graph.symbol(&format!("{stem}_{tag}"), Stage::Rate);
        Self { driven: symbol("driven"), held: symbol("held"), given: symbol("given") }
    }
}

impl<'g> Coordinate<'g> {
    /// From the parent body's axes to those fixed in the body.
    #[must_use]
    pub fn turn(self, graph: &'g Graph) -> Turn<'g, ParentFrame, BodyFrame> {
        match self {
            Self::Angle(turn) => turn,
            Self::Length(_) => Turn::none(graph),
        }
    }

    /// `d e / d coordinate`.
    #[must_use]
    pub fn partial(self, e: Expr<'g>) -> Expr<'g> {
        match self {
            Self::Angle(turn) => turn.partial(e),
            Self::Length(length) => e.partial(length),
        }
    }
}

impl<'g> HubSymbols<'g> {
    fn new(graph: &'g Graph) -> Self {
        let parameter = |name: &str| graph.symbol(name, Stage::Parameter);
        let along = |stem: &str, stage| {
            Vector::new(XYZ.map(|axis| graph.symbol(&format!("{stem}_b{axis}"), stage)))
        };
        let omega: Vector<'g, Hub> = along("omega", Stage::Rate);
        let omega_dot: Vector<'g, Hub> = along("omega_dot", Stage::Acceleration);
        let r_b_n_dot: Vector<'g, Hub> = along("r_b_n_dot", Stage::Rate);
        let r_b_n_ddot: Vector<'g, Hub> = along("r_b_n_ddot", Stage::Acceleration);
        // Components along axes that turn: d(r_dot)/dt = r_ddot - omega x r_dot.
        let r_b_n_dot_rates = r_b_n_ddot - omega.cross(r_b_n_dot);
        for (v, rate) in [(omega, omega_dot), (r_b_n_dot, r_b_n_dot_rates)] {
            for (component, rate) in v.components().into_iter().zip(rate.components()) {
                graph.set_rate(component, rate);
            }
        }
        Self {
            m_sc: parameter("m_sc"),
            m_b: parameter("m_b"),
            r_bc_b: along("r_bc_b", Stage::Parameter),
            i_b_bc: Symmetric::new(ENTRIES.map(|entry| parameter(&format!("i_b_{entry}")))),
            omega,
            omega_dot,
            r_b_n_dot,
            r_b_n_ddot,
            r_c_n_ddot: along("r_c_n_ddot", Stage::Acceleration),
        }
    }
}
