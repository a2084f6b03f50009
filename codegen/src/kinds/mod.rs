//! Device kinds as data: a chain of joints and bodies, ordered from the hub to the tip.
//!
//! A kind says what turns about or slides along what, where the next origin lies and what its
//! quantities are called; the equations come from the one derivation that walks any such list.

mod balanced_dgcmg;
mod balanced_dgvscmg;
mod balanced_reaction_wheel;
mod balanced_sgcmg;
mod balanced_vscmg;
mod body;
mod builder;
mod dgcmg;
mod dgvscmg;
mod equations;
mod flexible;
mod hinged_panel;
mod naming;
mod reaction_wheel;
mod registry;
mod sgcmg;
mod slosh_mass;
mod vscmg;
mod wheel;

pub use balanced_dgcmg::BALANCED_DGCMG;
pub use balanced_dgvscmg::BALANCED_DGVSCMG;
pub use balanced_reaction_wheel::BALANCED_REACTION_WHEEL;
pub use balanced_sgcmg::BALANCED_SGCMG;
pub use balanced_vscmg::BALANCED_VSCMG;
pub use body::{Body, Centre, Inertia};
pub use builder::{KindBuilder, LinkBuilder};
pub use dgcmg::DGCMG;
pub use dgvscmg::DGVSCMG;
pub use equations::Equations;
pub use flexible::{FLEXIBLE_REACTION_WHEEL, FLEXIBLE_VSCMG};
pub use hinged_panel::HINGED_PANEL;
pub use naming::KindError;
pub use reaction_wheel::REACTION_WHEEL;
pub use registry::{Entry, KINDS, REGISTRY};
pub use sgcmg::SGCMG;
pub use slosh_mass::SLOSH_MASS;
pub use vscmg::VSCMG;

use crate::space::Axis;

/// A device: joints and bodies from the hub outwards.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Module and file name.
    pub name: &'static str,
    /// What it is, in words.
    pub title: &'static str,
    /// Source file, as the header of the emitted file cites it.
    pub source: &'static str,
    /// The chain.
    pub links: &'static [Link],
}

/// A joint and its child body.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    /// The joint.
    pub joint: Joint,
    /// The body.
    pub body: Body,
    /// This body and all outboard of it, as the paper calls them: D, V, W.
    pub assembly: &'static str,
}

/// A joint.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    /// Index letter of its quantities: `f_o`, `u_o`.
    pub tag: &'static str,
    /// How it moves.
    pub motion: Motion,
    /// The angle or the length.
    pub coordinate: &'static str,
    /// The same as it is written.
    pub coordinate_symbol: &'static str,
    /// Its rate.
    pub rate: &'static str,
    /// Its acceleration: the second-order state.
    pub acceleration: &'static str,
    /// Rate and acceleration as the paper writes them.
    pub symbols: [&'static str; 2],
    /// The motor torque on the body, with its reaction on the parent body; of a sliding joint, the
    /// force.
    pub torque: &'static str,
    /// What is given of it.
    pub drive: Drive,
    /// Whether its origin is that of the parent body before any sliding: no parameter states it.
    pub concentric: bool,
    /// Joint's origin from the parent body's, expressed in that body's axes, before any sliding.
    pub origin: Triple,
}

/// What the kind says of a joint's drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drive {
    /// It has a motor: the torque is given, or, for as long as its mode says so, the acceleration.
    Motor,
    /// It keeps its rate, whatever torque that takes: the acceleration is zero, no equation is
    /// solved for it, and nothing is given.
    Prescribed,
    /// It does not move: its coordinate is a parameter, its rate and its acceleration are zero.
    Locked,
}

/// How a joint moves, by an axis of its parent body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// It turns about the axis: its coordinate is an angle.
    Turn(Axis),
    /// It slides along the axis: its coordinate is a length.
    Slide(Axis),
}

impl Motion {
    /// The axis.
    #[must_use]
    pub fn axis(self) -> Axis {
        match self {
            Self::Turn(axis) | Self::Slide(axis) => axis,
        }
    }

    /// The units of what belongs to the joint.
    #[must_use]
    pub fn units(self) -> &'static Units {
        match self {
            Self::Turn(_) => &Units {
                rate: "rad/s",
                acceleration: "rad/s²",
                drive: "N m",
                force: "kg m",
                moment: "kg m²",
                pivot: "kg m²",
            },
            Self::Slide(_) => &Units {
                rate: "m/s",
                acceleration: "m/s²",
                drive: "N",
                force: "kg",
                moment: "kg m",
                pivot: "kg",
            },
        }
    }
}

/// Units of what belongs to a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Units {
    /// Of its rate.
    pub rate: &'static str,
    /// Of its acceleration.
    pub acceleration: &'static str,
    /// Of its motor torque or force.
    pub drive: &'static str,
    /// Of force per acceleration of the joint: `M_vi`.
    pub force: &'static str,
    /// Of moment per acceleration of the joint: `M_wi`.
    pub moment: &'static str,
    /// Of the joint's own inertia: `M_ii`.
    pub pivot: &'static str,
}

/// One of the units of these joints, or all that there are: `kg m² or kg m`.
#[must_use]
pub fn units<'a>(
    links: impl IntoIterator<Item = &'a Link>,
    of: impl Fn(&Units) -> &'static str,
) -> String {
    distinct(links.into_iter().map(|link| of(link.joint.motion.units()))).join(" or ")
}

/// The equation numbers that links cite, each once.
#[must_use]
pub fn cited<'a>(
    links: impl IntoIterator<Item = &'a Link>,
    of: impl Fn(&Equations) -> &'static str,
) -> String {
    distinct(links.into_iter().map(|link| of(&link.body.equations))).join(", ")
}

/// Each word once, in order.
fn distinct(words: impl Iterator<Item = &'static str>) -> Vec<&'static str> {
    let mut found = Vec::new();
    for word in words {
        if !found.contains(&word) {
            found.push(word);
        }
    }
    found
}

impl Link {
    /// The same link with a joint that keeps its rate.
    #[must_use]
    pub const fn prescribed(self) -> Self {
        Self { joint: Joint { drive: Drive::Prescribed, ..self.joint }, ..self }
    }

    /// The same link with its joint locked.
    #[must_use]
    pub const fn locked(self) -> Self {
        Self { joint: Joint { drive: Drive::Locked, ..self.joint }, ..self }
    }

    /// Whether the joint is locked.
    #[must_use]
    pub fn is_locked(&self) -> bool {
        self.joint.drive == Drive::Locked
    }

    /// Whether the joint has a motor.
    #[must_use]
    pub fn is_driven(&self) -> bool {
        self.joint.drive == Drive::Motor
    }
}

impl Joint {
    /// The parameter that states the joint's origin, if one does.
    #[must_use]
    pub fn place(&self) -> Option<Triple> {
        (!self.concentric).then_some(self.origin)
    }
}

impl Kind {
    /// Whether the axes of body `k` turn with its joint.
    ///
    /// Outboard of a sliding joint they do not. Nor need they at the tip, where a rotor is the same
    /// from every angle: symmetric about the joint's axis, with its centre of mass on it. Then no
    /// equation depends on the angle.
    #[must_use]
    pub fn axes_turn(&self, k: usize) -> bool {
        let Link { joint, body, .. } = &self.links[k];
        let tip = k + 1 == self.links.len();
        match joint.motion {
            Motion::Slide(_) => false,
            Motion::Turn(axis) => !(tip && body.is_symmetric_about(axis)),
        }
    }

    /// The links on whose angle the equations depend: those with axes that turn, or are turned by a
    /// locked joint.
    pub fn turning(&self) -> impl Iterator<Item = &Link> {
        let links = self.links.iter().enumerate();
        links.filter(|(k, _)| self.axes_turn(*k)).map(|(_, link)| link)
    }

    /// The links whose joint has a motor: those that an equation is solved for.
    pub fn driven(&self) -> impl Iterator<Item = &Link> {
        self.links.iter().filter(|link| link.is_driven())
    }

    /// The links with a sliding joint.
    pub fn sliding(&self) -> impl Iterator<Item = &Link> {
        self.links.iter().filter(|link| matches!(link.joint.motion, Motion::Slide(_)))
    }
}

/// Three components with the vector's symbol.
#[derive(Clone, Copy, Debug)]
pub struct Triple {
    /// As the paper writes it.
    pub symbol: &'static str,
    /// In code.
    pub name: &'static str,
    /// Component names.
    pub names: [&'static str; 3],
}
