//! [`Inputs`]: forces and torques on a spacecraft at one instant, modes of its joints and hub.

use nalgebra::Vector3;

use crate::equations::gravity::Gravity;
use crate::equations::joint_inputs::JointInputs;
use crate::model::mode::{HubMode, Mode};
use crate::model::wrench::Wrench;
use crate::numbers::vec3::{add, components, cross, vector, zeros};
use crate::sets::devices::{Devices, FixedSet, JointInfos, SetInputs, set_own_modes};
use crate::sets::per_device as data;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::structure::{Rigid, StructureData, StructureEquations};

/// Forces, torques and modes. Constant during a step, expressed in the axes that each field names.
///
/// `Inputs { motors, ..Inputs::none() }` is a free hub with every joint driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inputs<D: Devices, S: StructureData = Rigid> {
    /// External force F through B, B axes, N; see [`Self::add_force`] for other points.
    pub force: Vector3<D::Scalar>,
    /// `L_B`, external torque about B, B axes, N m.
    pub torque_b: Vector3<D::Scalar>,
    /// Motor torques, device by device; that of a joint that is not driven has no effect.
    pub motors: D::Per<data::Motors>,
    /// Mode of each joint.
    pub modes: D::Per<data::PerJoint<Mode<D::Scalar>>>,
    /// Mode of the hub.
    pub hub: HubMode<D::Scalar>,
    /// Gravity on every body.
    pub gravity: Gravity<D::Scalar>,
    /// External wrench on the child body of each joint, about the joint's origin, expressed in the
    /// body's own axes; `None` if there is none.
    ///
    /// During a step such a wrench turns with its body: for one that keeps its direction in N or in
    /// B, steps must resolve the turning. A rotor that is the same from every angle (a balanced
    /// kind's) has the axes of its parent body, so the same numbers mean another force there than
    /// on an imbalanced rotor.
    pub bodies: Option<D::Per<data::PerJoint<Wrench<D::Scalar>>>>,
    /// Modal forces, and wrenches on mounts, of a flexible structure; `()` of a rigid hub.
    pub modal: S::Inputs<D::Scalar>,
}

impl<D: Devices, S: StructureEquations> Inputs<D, S> {
    /// Those of the joints.
    pub(crate) fn of_joints(&self) -> SetInputs<'_, D> {
        JointInputs { motors: &self.motors, modes: &self.modes, bodies: self.bodies.as_ref() }
    }
}

impl<D: FixedSet> Inputs<D> {
    /// No force, torque or gravity, motors off, every joint in the mode of its kind, a free hub.
    #[must_use]
    pub fn none() -> Self {
        Self {
            force: vector(zeros()),
            torque_b: vector(zeros()),
            motors: D::motors_off(),
            modes: D::modes(),
            hub: HubMode::Free,
            gravity: Gravity::None,
            bodies: None,
            modal: (),
        }
    }

    /// Zero wrenches on all bodies, to be changed and assigned to [`Self::bodies`].
    #[must_use]
    pub fn no_wrenches() -> D::Per<data::PerJoint<Wrench<D::Scalar>>> {
        D::all(Wrench::none())
    }
}

impl<D: Devices, S: StructureEquations> Inputs<D, S> {
    /// As [`Inputs::none`], for a set whose devices are known only at run time.
    #[must_use]
    pub fn none_for(spacecraft: &Spacecraft<D, S>) -> Self {
        let mut inputs = Self::driven_for(spacecraft);
        set_own_modes(&mut inputs.modes, D::list::<JointInfos>(&spacecraft.devices));
        inputs
    }

    /// As [`Inputs::none_for`], but every joint is driven, whatever the mode of its kind: for inputs
    /// whose modes are all written.
    #[must_use]
    #[inline]
    pub fn driven_for(spacecraft: &Spacecraft<D, S>) -> Self {
        Self {
            force: vector(zeros()),
            torque_b: vector(zeros()),
            motors: D::new_data(&spacecraft.devices, &data::Motors),
            modes: D::new_data(&spacecraft.devices, &data::PerJoint(Mode::Driven)),
            hub: HubMode::Free,
            gravity: Gravity::None,
            bodies: None,
            modal: S::no_inputs(spacecraft),
        }
    }

    /// The same forces, torques and modes, with the modal part of another structure.
    #[must_use]
    pub fn with_modal<R: StructureEquations>(self, modal: R::Inputs<D::Scalar>) -> Inputs<D, R> {
        let Self { force, torque_b, motors, modes, hub, gravity, bodies, .. } = self;
        Inputs { force, torque_b, motors, modes, hub, gravity, bodies, modal }
    }

    /// As [`Inputs::no_wrenches`], for a set whose devices are known only at run time.
    #[must_use]
    pub fn no_wrenches_for(
        spacecraft: &Spacecraft<D, S>,
    ) -> D::Per<data::PerJoint<Wrench<D::Scalar>>> {
        D::new_data(&spacecraft.devices, &data::PerJoint(Wrench::none()))
    }

    /// Adds a force on the hub at a point from B, both expressed in B, m and N.
    pub fn add_force(&mut self, point: &Vector3<D::Scalar>, force: &Vector3<D::Scalar>) {
        let (point, force) = (components(point), components(force));
        self.force = vector(add(components(&self.force), force));
        self.torque_b = vector(add(components(&self.torque_b), cross(point, force)));
    }
}
