//! Rigid bodies put together, by parallel axes.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use precess_dynamics::Hub;

use super::{Chain, Motion};

/// A rigid body: its centre of mass from a point and its inertia about that centre, along the axes
/// of the axes in which it is expressed.
#[derive(Clone, Copy, Debug)]
pub struct Rigid {
    /// kg.
    pub mass: f64,
    /// Of mass, m.
    pub centre: Vector3<f64>,
    /// About it, kg m^2.
    pub inertia: Matrix3<f64>,
}

impl Rigid {
    /// The hub as a body from B.
    #[must_use]
    pub fn of_hub(hub: &Hub) -> Self {
        Self { mass: hub.m_b, centre: hub.r_bc_b, inertia: hub.i_b_bc }
    }

    /// The hub that moves as this body does.
    #[must_use]
    pub fn hub(&self) -> Hub {
        Hub { m_b: self.mass, r_bc_b: self.centre, i_b_bc: self.inertia }
    }

    /// The same body along turned axes, its point moved: `centre = origin + turn centre`.
    #[must_use]
    pub fn moved(&self, origin: &Vector3<f64>, turn: &Matrix3<f64>) -> Self {
        let inertia = turn * self.inertia * turn.transpose();
        Self { centre: origin + turn * self.centre, inertia: symmetric(&inertia), ..*self }
    }

    /// Several bodies as one; each inertia moves to the common centre by its parallel axes.
    #[must_use]
    pub fn merged(bodies: &[Self]) -> Self {
        let mass = bodies.iter().map(|body| body.mass).sum::<f64>();
        let centre = bodies.iter().map(|body| body.centre * body.mass).sum::<Vector3<f64>>() / mass;
        let about_centre = |body: &Self| {
            let r = body.centre - centre;
            let square = Matrix3::from_diagonal_element(r.norm_squared());
            body.inertia + (square - r * r.transpose()) * body.mass
        };
        let inertia = bodies.iter().map(about_centre).sum::<Matrix3<f64>>();
        Self { mass, centre, inertia: symmetric(&inertia) }
    }
}

fn symmetric(tensor: &Matrix3<f64>) -> Matrix3<f64> {
    (tensor + tensor.transpose()) * 0.5
}

/// The bodies of a device in a pose, from B along B axes.
#[must_use]
pub fn posed(chain: &Chain, coordinates: &[f64]) -> Vec<Rigid> {
    let (mut axes, mut origin) = (chain.mount, chain.position);
    let links = chain.links.iter().zip(coordinates);
    let walk = links.map(|(link, coordinate)| {
        origin += axes * link.origin;
        match link.motion {
            Motion::Turns(axis) => axes *= turn(&axis, *coordinate),
            Motion::Slides(axis) => origin += axes * axis * *coordinate,
        }
        Rigid { mass: link.mass, centre: link.centre, inertia: link.inertia }.moved(&origin, &axes)
    });
    walk.collect()
}

/// The rotation about an axis, active.
#[must_use]
pub fn turn(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    Rotation3::from_axis_angle(&Unit::new_unchecked(*axis), angle).into_inner()
}
