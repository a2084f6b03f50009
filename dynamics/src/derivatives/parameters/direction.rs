//! [`ParameterDirection`]: parameters and inputs that change together, as a key of a scenario changes several.

use alloc::vec::Vec;

use crate::derivatives::parameters::rigid_body::RigidBody;
use crate::derivatives::variable::Variable;
use crate::model::kind::{BodyParameters, no_inertia};
use crate::model::parameters::Hub;
use crate::model::passive::Passive;
use crate::numbers::real::{Scalar, half, zero};
use crate::numbers::vec3::{Vec3, add, columns, cross, scale, vector, zeros};
use crate::sets::device_parameters::DeviceParameters;

/// What parameters and inputs of a spacecraft change by along one direction, per unit of it.
///
/// Each field has the changes of the numbers that it has in the spacecraft, not values: the change of a mass is in `hub.m_b`,
/// and may be negative.
#[derive(Clone, Debug)]
pub struct ParameterDirection<T = f64> {
    /// Of mass, kg, centre of mass, m, and inertia about it, kg m², of the hub.
    pub hub: Hub<T>,
    /// Of each device; none where no device changes. A mount changes as by a small rotation; `model` is not read.
    pub devices: Vec<DeviceParameters<T>>,
    /// Of what is held: inputs of [`Spacecraft::input_variables`](crate::Spacecraft::input_variables), and coordinates of
    /// locked joints, which are no states. What is not listed does not change.
    pub held: Vec<(Variable, T)>,
}

impl<T: Scalar> ParameterDirection<T> {
    /// Along which nothing changes.
    #[must_use]
    pub fn none() -> Self {
        let hub = Hub { m_b: zero(), r_bc_b: vector(zeros()), i_b_bc: no_inertia() };
        Self { hub, devices: Vec::new(), held: Vec::new() }
    }

    /// What the hub changes by; none where it does not.
    pub(crate) fn of_hub(&self) -> Option<RigidBody<T>> {
        Some(RigidBody::of_hub(&self.hub)).filter(|change| !change.vanishes())
    }

    /// The numbers of the devices that change.
    pub(crate) fn of_devices(&self) -> impl Iterator<Item = usize> {
        self.devices
            .iter()
            .enumerate()
            .filter(|(_, change)| changes(change))
            .map(|(number, _)| number)
    }
}

/// Whether anything does.
fn changes<T: Scalar>(change: &DeviceParameters<T>) -> bool {
    let DeviceParameters { mount, bodies, passive, .. } = change;
    let of_body = |body: &BodyParameters<T>| {
        let moves = body.origin.iter().any(|number| !number.vanishes());
        moves || !RigidBody::of(body).vanishes()
    };
    let resists = |of: &Passive<T>| {
        let Passive { stiffness, rest, viscous, coulomb, coulomb_rate } = *of;
        [stiffness, rest, viscous, coulomb, coulomb_rate].iter().any(|number| !number.vanishes())
    };
    let turns = mount.iter().any(|number| !number.vanishes());
    turns || bodies.iter().any(of_body) || passive.iter().any(resists)
}

/// The small rotation, expressed in B, by which a mount of these columns changes so: `1/2 sum m x dm`.
pub(crate) fn rotation<T: Scalar>(
    mount: &nalgebra::Matrix3<T>,
    change: &nalgebra::Matrix3<T>,
) -> Vec3<T> {
    let both = columns(mount).into_iter().zip(columns(change));
    let twice = both.fold(zeros(), |sum, (column, change)| add(sum, cross(column, change)));
    scale(half(), twice)
}
