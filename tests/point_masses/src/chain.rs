//! A device as bodies in a row, written down by hand.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::Passive;

/// How a joint moves: about or along an axis of the parent body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// About it.
    Turns(Vector3<f64>),
    /// Along it.
    Slides(Vector3<f64>),
}

/// A joint and its child body.
#[derive(Clone, Copy, Debug)]
pub struct Link {
    /// The motion of the joint.
    pub motion: Motion,
    /// Of the joint, from the parent body's origin, in the parent body's axes.
    pub origin: Vector3<f64>,
    /// Of the body, kg.
    pub mass: f64,
    /// From the joint's origin, own axes.
    pub centre: Vector3<f64>,
    /// About the centre of mass, own axes.
    pub inertia: Matrix3<f64>,
    /// Whether it is symmetric about its joint: then its axes are the parent body's.
    pub round: bool,
}

/// A device as bodies in a row.
#[derive(Clone, Debug)]
pub struct Chain {
    /// The axes of the device at zero as columns, along B axes.
    pub mount: Matrix3<f64>,
    /// Of the first joint, from B, B axes; the first link's own origin is zero.
    pub position: Vector3<f64>,
    /// From the hub outwards.
    pub links: Vec<Link>,
    /// Spring and friction of each joint.
    pub passive: Vec<Passive>,
}
