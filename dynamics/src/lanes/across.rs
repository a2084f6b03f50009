//! [`AcrossDevices`]: one state of a spacecraft with many devices of one kind, devices side by side
//! in the lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::vec::Vec;

use pulp::{Arch, Simd, WithSimd};

use super::across_loads::{AddLoads, Loads, add_in_order};
use super::constants::{DeviceBlocks, DeviceConstants, OwnLoads};
use super::evaluate::{regular, within_reach};
use super::fallback;
use super::gather::{joints_in_lanes, values_in_lanes};
use super::passive::{add_stiffness, viscous, with_passive};
use super::slot::{Aligned, put_drives};
use super::width::{dispatch, lanes_for, width};
use crate::attitude::parameterisation::Attitude;
use crate::equations::assembly::expressed_in_b;
use crate::equations::device::Device;
use crate::equations::error::SolveError;
use crate::equations::joint_inputs::JointInputs;
use crate::equations::stiffness::Stiffness;
use crate::equations::system::Solution;
use crate::model::kernels::Kernels;
use crate::model::kind::Kind;
use crate::model::mode::{Drive, Mode};
use crate::model::parameters::Hub;
use crate::numbers::each::Each;
use crate::numbers::lane::Lane;
use crate::numbers::laned::{Block, Number, WIDEST};
use crate::numbers::vec3::map;
use crate::solve::accelerations::{
    EvaluationStart, check_fixed, evaluation_start, inputs_are_finite,
};
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::validation::parameter_error::ParameterError;

/// A hub with `N` devices of one kind, evaluated as many at a time as there are lanes.
///
/// Worth it from four devices on. Results have the bits that [`Spacecraft`] gives.
#[derive(Clone, Debug)]
pub struct AcrossDevices<K: Kind<Scalar = f64>, const N: usize> {
    craft: Spacecraft<[K; N]>,
    lanes: Arch,
    groups: Vec<Group<K>>,
    /// What the devices have of their own.
    own: OwnLoads,
}

/// As many devices as there are lanes.
#[derive(Clone, Debug)]
struct Group<K: Kernels> {
    constants: DeviceBlocks<K>,
    /// How many there are.
    devices: usize,
    /// One in their lanes, the first.
    weight: Block,
}

impl<K: Kind<Scalar = f64>, const N: usize> AcrossDevices<K, N> {
    /// Checks the parameters and computes everything that depends only on them.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::new`].
    pub fn new(hub: &Hub, devices: &[K; N]) -> Result<Self, ParameterError<f64>> {
        let craft = Spacecraft::new(hub, devices)?;
        let lanes = lanes_for(N);
        let groups = craft.devices.chunks(width(lanes)).filter_map(Group::new).collect();
        Ok(Self { own: OwnLoads::of(&craft), craft, lanes, groups })
    }

    /// The spacecraft, for everything else that is asked of it.
    #[must_use]
    pub fn spacecraft(&self) -> &Spacecraft<[K; N]> {
        &self.craft
    }

    /// All accelerations, as [`Spacecraft::accelerations`] gives them.
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::accelerations`].
    pub fn accelerations<A: Attitude<f64>>(
        &self,
        state: &State<[K; N], A>,
        inputs: &Inputs<[K; N]>,
    ) -> Result<Accelerations<[K; N]>, SolveError<f64>> {
        let mut found = self.craft.no_accelerations();
        if inputs_are_finite(state, inputs) && self.solve(state, inputs, &mut found, None).is_some()
        {
            return Ok(found);
        }
        fallback::count();
        self.craft.accelerations(state, inputs)
    }

    /// The state after `dt` seconds, as [`Spacecraft::step`].
    ///
    /// # Errors
    ///
    /// As [`Spacecraft::step`].
    pub fn step<A: Attitude<f64>>(
        &self,
        state: &State<[K; N], A>,
        inputs: &Inputs<[K; N]>,
        dt: f64,
    ) -> Result<State<[K; N], A>, SolveError<f64>> {
        self.craft.stepped(state, inputs, dt, |_, stage, found, mut stiffness| {
            if self.solve(stage, inputs, found, stiffness.as_deref_mut()).is_some() {
                return Ok(());
            }
            fallback::count();
            self.craft.solve(stage, inputs, found, stiffness)
        })
    }

    /// The accelerations in lanes; none where lanes do not support the inputs, or fail.
    fn solve<A: Attitude<f64>>(
        &self,
        state: &State<[K; N], A>,
        inputs: &Inputs<[K; N]>,
        found: &mut Accelerations<[K; N]>,
        stiffness: Option<&mut Stiffness<f64>>,
    ) -> Option<()> {
        dispatch::<_, N>(self.lanes, Evaluation { across: self, state, inputs, found, stiffness })
    }
}

impl<K: Kind<Scalar = f64>> Group<K> {
    /// These devices side by side; lanes without one repeat the last.
    fn new(devices: &[Device<K>]) -> Option<Self> {
        let mut weight = Block::ZERO;
        (0..devices.len()).for_each(|lane| weight.put(lane, 1.0));
        Some(Self { weight, constants: DeviceBlocks::of(devices)?, devices: devices.len() })
    }
}

/// One evaluation.
struct Evaluation<'a, K: Kind<Scalar = f64>, A: Attitude<f64>, const N: usize> {
    across: &'a AcrossDevices<K, N>,
    state: &'a State<[K; N], A>,
    inputs: &'a Inputs<[K; N]>,
    found: &'a mut Accelerations<[K; N]>,
    stiffness: Option<&'a mut Stiffness<f64>>,
}

impl<K: Kind<Scalar = f64>, A: Attitude<f64>, const N: usize> WithSimd for Evaluation<'_, K, A, N> {
    type Output = Option<()>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        self.evaluate(Lane::splat(simd, 0.0))
    }
}

impl<K: Kind<Scalar = f64>, A: Attitude<f64>, const N: usize> Evaluation<'_, K, A, N> {
    /// What the devices exert on the hub is added device by device.
    #[inline(always)]
    fn evaluate<T: Number>(self, zero: T) -> Option<()> {
        let Self { across, state, inputs, found: all, stiffness: demanded } = self;
        let AcrossDevices { craft, groups, .. } = across;
        check_fixed(state, inputs).ok()?;
        let EvaluationStart { environment, at_b } = evaluation_start(state, inputs);
        let mut assembly = craft.assembly(inputs);
        let omega = map(environment.omega, |component| zero.like(component));
        // The first without the heap: where there is one group alone, that takes time.
        let (mut of_first, mut gains) = (None, Vec::with_capacity(groups.len().saturating_sub(1)));
        let mut holds = zero.same(zero);
        let OwnLoads { dry, lumped } = across.own;
        let with_loads = dry || lumped || inputs.bodies.is_some() || environment.central.is_some();
        let mut start = 0;
        for group in groups {
            let (joints, drives) = gather::<K, T, N>(start, &state.devices, inputs, zero)?;
            let DeviceConstants { passive, .. } = group.constants.in_lanes(zero);
            let loads = if with_loads {
                // Copies: numbers whose place another function knows do not stay in registers.
                let (mut to, joints, given) = (None, joints, drives);
                zero.apart(AddLoads::<K, T> {
                    constants: &group.constants,
                    bodies: inputs.bodies.as_ref().and_then(|bodies| bodies.get(start..)),
                    joints: &joints,
                    given: &given,
                    central: environment.central.as_ref(),
                    like: zero,
                    to: &mut to,
                });
                to
            } else {
                None
            };
            start += T::WIDTH;
            let drives = match (&passive, &loads) {
                (_, Some(Loads { drives, .. })) => *drives,
                (Some(passive), None) => with_passive::<K, T>(&joints, &drives, passive),
                (None, None) => drives,
            };
            let pose = K::pose(&joints);
            // Loaded here: what is loaded before a branch is copied to the stack.
            let DeviceConstants { constants, bound, .. } = group.constants.in_lanes(zero);
            let eliminated =
                K::eliminate(&constants, &pose, &joints, &expressed_in_b(omega), &drives);
            let regular = regular::<K, T>(zero, &eliminated, &drives, &bound);
            let within = within_reach::<K, T>(zero, &joints);
            holds = zero.both(holds, zero.both(within, regular));
            if let Some(passive) = &passive {
                let mut stiffness = Stiffness::none(zero);
                let of_loads = loads.as_ref().and_then(|loads| loads.stiffness);
                let joints = of_loads.unwrap_or_else(|| viscous::<K, T>(passive));
                add_stiffness::<K, T>(&mut stiffness, &joints, &eliminated, &drives);
                add_in_order(&mut assembly.stiffness, &stiffness, group.devices);
            }
            if let Some(Loads { on_hub: Some(on_hub), .. }) = &loads {
                on_hub.add_to(&mut assembly, group.devices);
            }
            let mut share = *K::share(&eliminated);
            if const { !N.is_multiple_of(T::WIDTH) } {
                let real = zero.load(&group.weight).above(zero);
                // Minus zero changes no sum.
                let none = zero.like(-0.0);
                share = share.map(
                    #[inline(always)]
                    |number| number.or(real, none),
                );
            }
            assembly.add_by(
                &share,
                #[inline(always)]
                |sum, number| number.added_to(sum),
            );
            match &of_first {
                None => of_first = Some(Aligned(*K::gains(&eliminated))),
                Some(_) => gains.push(Aligned(*K::gains(&eliminated))),
            }
        }
        let hub = craft.hub_accelerations(inputs, &environment, &mut assembly, at_b).ok()?;
        let all_gains = of_first.iter().chain(&gains);
        let vanishing = back_substitute::<K, T>(all_gains, &hub, zero, &mut all.devices);
        let holds = zero.like(1.0).or(zero.both(holds, vanishing.same(zero)), zero).store();
        if (0..T::WIDTH).any(|lane| holds.at(lane) != 1.0) {
            return None;
        }
        if let Some(demanded) = demanded {
            *demanded = craft.stiffness(inputs, &assembly);
        }
        // The joints' are: `holds` says it.
        all.finish(inputs, &hub, at_b, true).ok()
    }
}

/// Writes the accelerations of the devices' joints; zero where all are finite, else NaN.
#[inline(always)]
fn back_substitute<'a, K: Kind<Scalar = f64>, T: Number>(
    groups: impl Iterator<Item = &'a Aligned<K::Gains<T>>>,
    hub: &Solution<f64>,
    zero: T,
    devices: &mut [K::Accelerations<f64>],
) -> T {
    let splat = |v| map(v, |component| zero.like(component));
    let hub = Solution { r_b_n_ddot: splat(hub.r_b_n_ddot), omega_dot: splat(hub.omega_dot) };
    let hub = hub.expressed_in_b();
    let (mut vanishing, mut rest) = (zero, devices.iter_mut());
    for Aligned(gains) in groups {
        let found = K::back_substitute(gains, &hub);
        let mut found = K::zip_accelerations(&found, &found, |number, _| {
            vanishing = vanishing + number * zero;
            number.store()
        });
        for lane in 0..T::WIDTH {
            let Some(device) = rest.next() else { break };
            for (number, block) in device.values_mut().zip(found.values_mut()) {
                *number = block.at(lane);
            }
        }
    }
    vanishing
}

/// The joints of a group's devices, and what is given of them.
type Gathered<K, T> = (<K as Kernels>::Joints<T>, <K as Kernels>::PerJoint<Drive<T>>);

/// Gathers the joints of a group's devices, and what is given of them; lanes without a device
/// repeat the last.
#[inline(always)]
fn gather<K: Kind<Scalar = f64>, T: Number, const N: usize>(
    start: usize,
    joints: &[K::Joints<f64>; N],
    inputs: &Inputs<[K; N]>,
    zero: T,
) -> Option<Gathered<K, T>> {
    let at = |lane: usize| (start + lane).min(N - 1);
    let (first, mut joints_of) = (joints.get(at(0))?, [None; WIDEST]);
    let (mut torques, mut driven) = ([<K as Kind>::all(0.0); WIDEST], true);
    for (lane, (joint, torques)) in joints_of.iter_mut().zip(&mut torques).enumerate() {
        *joint = joints.get(at(lane));
        if lane < T::WIDTH {
            let (motors, modes) = (inputs.motors.get(at(lane))?, inputs.modes.get(at(lane))?);
            driven &= modes.values().all(|mode| mode == Mode::Driven);
            torques.values_mut().zip(motors.values()).for_each(|(place, torque)| *place = torque);
        }
    }
    let joints_of = joints_of.map(|joints| joints.unwrap_or(first));
    let laned = joints_in_lanes::<K, T>(zero, joints_of);
    if driven && K::JOINTS.iter().all(|info| info.driven) {
        let one = zero.like(1.0);
        let torques = values_in_lanes::<K, T>(zero, torques.each_ref());
        let drives = K::zip_per_joint(&torques, &torques, |torque, _| Drive {
            torque,
            driven: one,
            held: zero,
            given: zero,
        });
        return Some((laned, drives));
    }
    let drive = <K as Kind>::all(Mode::Driven.drive(0.0));
    let mut drives_of = K::zip_per_joint(&drive, &drive, |drive, _| drive.map(|_| Block::ZERO));
    for (lane, joints) in joints_of.into_iter().enumerate().take(T::WIDTH) {
        let (motors, modes) = (inputs.motors.get(at(lane))?, inputs.modes.get(at(lane))?);
        let given = JointInputs { motors, modes, bodies: None };
        let drives = Device::<K>::given_drives(joints, given)?;
        put_drives::<K>(&mut drives_of, lane, &drives);
    }
    let load = |block: Block| zero.load(&block);
    Some((laned, K::zip_per_joint(&drives_of, &drives_of, |drive, _| drive.map(load))))
}
