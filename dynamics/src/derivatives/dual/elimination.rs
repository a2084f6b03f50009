//! [`ConstantsPlain`]: a device of which nothing is a variable is eliminated in plain numbers.
//!
//! An evaluation has the derivatives by a few variables, most of which concern one device or only the hub. The
//! kernel of a device costs some ten times as much in dual numbers as in plain ones. Where every number that
//! it reads is constant, so is every result, with the bits that the dual kernel gives.

use crate::derivatives::dual::point::Number;
use crate::equations::arithmetic::{Arithmetic, EliminationInputs, Pivots};
use crate::equations::assembly::Assembly;
use crate::equations::device::Device;
use crate::equations::eliminate::DeviceElimination;
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::{DeviceInputs, Environment};
use crate::generated::hub::BodyRate;
use crate::model::kind::Kind;
use crate::model::mode::{Drive, Mode};
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::Scalar;
use crate::solve::elimination::Eliminate;

/// Each device in dual numbers, unless all that its kernel reads is constant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConstantsPlain(pub(crate) Arithmetic);

impl<T: Scalar> Eliminate<Number<T>> for ConstantsPlain {
    fn eliminate<K: Kind<Scalar = Number<T>>>(
        self,
        of: DeviceElimination<'_, K>,
    ) -> Result<(), SolveError<Number<T>>> {
        if is_constant(of.device, of.joints, of.given, of.environment) {
            eliminate_constant::<K, T>(of)
        } else {
            self.0.eliminate(of)
        }
    }
}

/// Whether nothing that a device's kernel reads has a derivative.
fn is_constant<K: Kind<Scalar = Number<T>>, T: Scalar>(
    device: &Device<K>,
    joints: &K::Joints<Number<T>>,
    given: DeviceInputs<'_, K>,
    environment: &Environment<Number<T>>,
) -> bool {
    // A gradient and wrenches are summed in dual numbers anyhow, so they are not worth a case.
    environment.central.is_none()
        && given.bodies.is_none()
        && environment.omega.iter().all(constant)
        && joints.states().flatten().all(|number| constant(&number))
        && given.motors.values().all(|motor| constant(&motor))
        && given.modes.values().all(|mode| match mode {
            Mode::Prescribed(acceleration) => constant(&acceleration),
            Mode::Driven | Mode::Locked => true,
        })
        && constants_are_constant::<K, T>(&device.constants)
}

fn constants_are_constant<K: Kind<Scalar = Number<T>>, T: Scalar>(
    constants: &K::Constants<Number<T>>,
) -> bool {
    let mut all = true;
    K::zip_constants(constants, constants, |number, _| all &= constant(&number));
    all
}

/// Whether a number has no derivative.
fn constant<T: Scalar>(number: &Number<T>) -> bool {
    number.derivatives.iter().all(|derivative| derivative.vanishes())
}

/// Eliminates the joints of a device of which nothing is a variable. Its torques are computed in dual numbers:
/// should one of a spring have a derivative, so has the whole device.
fn eliminate_constant<K: Kind<Scalar = Number<T>>, T: Scalar>(
    of: DeviceElimination<'_, K>,
) -> Result<(), SolveError<Number<T>>> {
    of.run(|inputs, pose, assembly, gains| {
        let mut fixed = true;
        K::zip_per_joint(inputs.drives, inputs.drives, |drive: Drive<Number<T>>, _| {
            let Drive { torque, driven, held, given } = drive;
            fixed &= [torque, driven, held, given].iter().all(constant);
        });
        if fixed {
            return eliminated_plainly(inputs, assembly, gains);
        }
        let pose = pose.unwrap_or_else(|| K::pose(inputs.joints));
        let eliminated = inputs.eliminated(&pose);
        *gains = Some(*K::gains(&eliminated));
        assembly.add(K::share(&eliminated));
        K::pivots(&eliminated)
    })
}

/// The kernel in plain numbers, its results as dual ones.
#[inline(never)]
fn eliminated_plainly<K: Kind<Scalar = Number<T>>, T: Scalar>(
    inputs: &EliminationInputs<'_, K, Number<T>>,
    assembly: &mut Assembly<Number<T>>,
    gains: &mut Option<K::Gains<Number<T>>>,
) -> Pivots<K, Number<T>> {
    let EliminationInputs { constants, joints, omega, drives } = inputs;
    let constants = K::zip_constants(constants, constants, |number, _| number.value);
    let joints = K::zip_joints(joints, joints, |number, _| number.value);
    let drives = K::zip_per_joint(drives, drives, |drive: Drive<Number<T>>, _| {
        let Drive { torque, driven, held, given } = drive;
        let [torque, driven, held, given] = [torque, driven, held, given].map(|of| of.value);
        Drive { torque, driven, held, given }
    });
    let omega = BodyRate {
        omega_bx: omega.omega_bx.value,
        omega_by: omega.omega_by.value,
        omega_bz: omega.omega_bz.value,
    };
    let eliminated = K::eliminate(&constants, &K::pose(&joints), &joints, &omega, &drives);
    let own = K::gains(&eliminated);
    *gains = Some(K::zip_gains(own, own, |number, _| Number::constant(number)));
    assembly.add(&K::share(&eliminated).map(Number::constant));
    let pivots = K::pivots(&eliminated);
    K::zip_per_joint(&pivots, &pivots, |pivot: Option<[T; 2]>, _| {
        pivot.map(|of| of.map(Number::constant))
    })
}
