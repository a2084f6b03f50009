//! [`Spacecraft::mass_solution`]: accelerations by loads only, `M⁻¹ r`, by the elimination of an evaluation, without a heap.

use crate::derivatives::loads::kernel::NotEmitted;
use crate::derivatives::structure::StructureDerivatives;
use crate::equations::assembly::{Assembly, expressed_in_b};
use crate::equations::device::Device;
use crate::equations::joint_inputs::Environment;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::gains::GroupGains;
use crate::equations::system::Solution;
use crate::isolation::carrier::Carrier;
use crate::model::kind::Kind;
use crate::model::mode::Mode;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{Vec3, zeros};
use crate::sets::bundle::{Bundle, Given, Shared, Unique};
use crate::sets::carrying::{Carrying, PreparedCarrying};
use crate::sets::devices::{DeviceSet, Devices, Visit};
use crate::sets::per_device as data;
use crate::solve::elimination::{Eliminated, Elimination, substitute};
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;

/// State and inputs of the joints, what acts on them, and the gains that come of them.
type Loaded = (Shared<data::Joints>, Given, Shared<data::Accelerations>, Unique<data::Gains>);

/// Eliminates the joints at rest into the hub's system.
struct AtRest<'a, T> {
    assembly: &'a mut Assembly<T>,
}

impl<T: Scalar> Visit<T, Loaded> for AtRest<'_, T> {
    type Error = NotEmitted;

    fn visit<K: Kind<Scalar = T>>(
        &mut self,
        device: &Device<K>,
        (joints, given, loads, gains): <Loaded as Bundle<T>>::Of<'_, K>,
    ) -> Result<(), NotEmitted> {
        let mut joints = *joints;
        joints.states_mut().for_each(|[_, rate]| *rate = zero());
        let mut loads = loads.values();
        let drives = K::zip_per_joint(given.modes, given.modes, |mode, _| {
            let load = loads.next().unwrap_or_else(zero);
            match mode {
                Mode::Driven => Mode::Driven.drive(load),
                Mode::Prescribed(_) => Mode::Prescribed(load).drive(zero()),
                Mode::Locked => Mode::Locked.drive(zero()),
            }
        });
        let pose = K::pose(&joints);
        let rate = expressed_in_b(zeros());
        let eliminated = K::eliminate(&device.constants, &pose, &joints, &rate, &drives);
        *gains = Some(*K::gains(&eliminated));
        self.assembly.add(K::share(&eliminated));
        Ok(())
    }

    fn visit_carrying<C: Carrier<Scalar = T>, D: DeviceSet<Scalar = T>>(
        &mut self,
        _: &PreparedCarrying<C, D>,
        _: <Loaded as Bundle<T>>::Of<'_, Carrying<C, D>>,
    ) -> Result<(), NotEmitted> {
        Err(NotEmitted)
    }
}

impl<D: Devices, S: StructureDerivatives> Spacecraft<D, S> {
    /// Accelerations of hub and joints under force and moment about B, B axes, and the loads of the joints, for which
    /// `joints` has those of driven ones and the accelerations of prescribed ones; it becomes the accelerations.
    /// `given` are those of a hub that is not free.
    pub(crate) fn mass_solution(
        &self,
        at: (&D::Per<data::Joints>, &Inputs<D, S>),
        [force, moment]: [Vec3<D::Scalar>; 2],
        given: Option<Solution<D::Scalar>>,
        joints: &mut D::Per<data::Accelerations>,
    ) -> Result<Solution<D::Scalar>, NotEmitted> {
        let mut assembly = Assembly::new(&self.body, force, moment);
        let mut gains = D::new_data(&self.devices, &data::Gains);
        #[cfg(feature = "lanes")]
        let mut groups = GroupGains::none();
        if self.passive {
            let (coordinates, inputs) = at;
            let data = (coordinates, inputs.of_joints(), &*joints, &mut gains);
            let mut visitor = AtRest { assembly: &mut assembly };
            D::visit::<Loaded, _>(&self.devices, data, &mut visitor)?;
        } else {
            // Without springs and friction, as an evaluation at rest.
            let (coordinates, inputs) = at_rest::<D, S>(at, joints);
            let environment =
                Environment { omega: zeros(), central: None, impulse: false, reduction: None };
            let mut elimination = Elimination::new(&environment, &mut assembly, 0, self.arithmetic);
            #[cfg(feature = "lanes")]
            {
                elimination.groups = Some(&mut groups);
            }
            let data = (&coordinates, inputs.of_joints(), &mut gains);
            let eliminated = D::visit::<Eliminated, _>(&self.devices, data, &mut elimination);
            eliminated.map_err(|_| NotEmitted)?;
        }
        #[cfg(feature = "lanes")]
        let groups = (!self.passive).then_some(&mut groups);
        #[cfg(not(feature = "lanes"))]
        let groups = None;
        // Its pivots are those of the accelerations, which were accepted.
        let hub = given.unwrap_or_else(|| assembly.system(zeros()).solved().0);
        // What is not finite is rejected by who calls.
        let _ = substitute::<D>(&self.devices, &gains, &hub, joints, groups);
        Ok(hub)
    }
}

/// The joints at rest, and these loads for what drives them: of prescribed ones the accelerations.
fn at_rest<D: Devices, S: StructureDerivatives>(
    (coordinates, inputs): (&D::Per<data::Joints>, &Inputs<D, S>),
    loads: &D::Per<data::Accelerations>,
) -> (D::Per<data::Joints>, Inputs<D, S>) {
    let (mut coordinates, mut inputs) = (coordinates.clone(), inputs.clone());
    coordinates.states_mut().for_each(|[_, rate]| *rate = zero());
    let to = inputs.modes.values_mut().zip(inputs.motors.values_mut());
    for ((mode, motor), load) in to.zip(loads.values()) {
        (*mode, *motor) = match *mode {
            Mode::Driven => (Mode::Driven, load),
            Mode::Prescribed(_) => (Mode::Prescribed(load), zero()),
            Mode::Locked => (Mode::Locked, zero()),
        };
    }
    (coordinates, inputs)
}
