//! [`AcrossDevices`]: one state of a spacecraft with many devices of one kind, devices side by side
//! in the lanes.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::vec::Vec;

use pulp::{Arch, Simd, WithSimd};

use super::constants::{DeviceBlocks, DeviceConstants};
use super::evaluate::{add_stiffness, regular, with_passive, within_reach};
use super::gather::{joints_in_lanes, values_in_lanes};
use super::lane::Lane;
use super::number::{Block, Number, WIDEST};
use super::slot::{Aligned, put_drives};
use super::width::{lanes_for, width};
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
use crate::numbers::vec3::map;
use crate::solve::accelerations::{EvaluationStart, evaluation_start, inputs_are_finite};
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};
use crate::validation::parameter_error::ParameterError;

/// A hub with `N` devices of one kind, evaluated as many at a time as there are lanes.
///
/// Worth it from four devices on. Lanes add up what the devices exert on the hub in another order
/// than [`Spacecraft`] does, so the last bits differ.
#[derive(Clone, Debug)]
pub struct AcrossDevices<K: Kind<Scalar = f64>, const N: usize> {
    craft: Spacecraft<[K; N]>,
    lanes: Arch,
    groups: Vec<Group<K>>,
    /// Whether lanes support every device.
    laned: bool,
}

/// As many devices as there are lanes.
#[derive(Clone, Debug)]
struct Group<K: Kernels> {
    constants: DeviceBlocks<K>,
    /// One in the lanes that have a device.
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
        let laned = craft.devices.iter().all(Device::lanes_support);
        Ok(Self { craft, lanes, groups, laned })
    }

    /// The spacecraft, for everything else that is asked of it.
    #[must_use]
    pub fn spacecraft(&self) -> &Spacecraft<[K; N]> {
        &self.craft
    }

    /// All accelerations, as [`Spacecraft::accelerations`] gives them, to rounding.
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
            match self.solve(stage, inputs, found, stiffness.as_deref_mut()) {
                Some(()) => Ok(()),
                None => self.craft.solve(stage, inputs, found, stiffness),
            }
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
        if !self.laned || inputs.gravity.uniform().is_none() || inputs.bodies.is_some() {
            return None;
        }
        self.lanes.dispatch(Evaluation { across: self, state, inputs, found, stiffness })
    }
}

impl<K: Kind<Scalar = f64>> Group<K> {
    /// These devices side by side; lanes without one repeat the last.
    fn new(devices: &[Device<K>]) -> Option<Self> {
        let mut weight = Block::ZERO;
        (0..devices.len()).for_each(|lane| weight.put(lane, 1.0));
        Some(Self { constants: DeviceBlocks::of(devices)?, weight })
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
        self.evaluate(Lane::<S, true>::splat(simd, 0.0))
    }
}

impl<K: Kind<Scalar = f64>, A: Attitude<f64>, const N: usize> Evaluation<'_, K, A, N> {
    #[inline(always)]
    fn evaluate<T: Number>(self, zero: T) -> Option<()> {
        let Self { across, state, inputs, found: all, stiffness: demanded } = self;
        let AcrossDevices { craft, groups, .. } = across;
        let EvaluationStart { environment, at_b } = evaluation_start(state, inputs).ok()?;
        let mut assembly = craft.assembly(inputs);
        let omega = map(environment.omega, |component| zero.like(component));
        // The first without the heap: where there is one group alone, that takes time.
        let (mut gains, mut of_first) = (Vec::new(), None);
        let (mut holds, mut shares) = (zero.same(zero), None);
        let mut start = 0;
        for group in groups {
            let (joints, drives) = gather::<K, T, N>(craft, start, &state.devices, inputs, zero)?;
            start += T::WIDTH;
            let DeviceConstants { constants, passive, bound, .. } = group.constants.in_lanes(zero);
            let drives = match &passive {
                Some(passive) => with_passive::<K, T>(&joints, &drives, passive),
                None => drives,
            };
            let pose = K::pose(&joints);
            let eliminated =
                K::eliminate(&constants, &pose, &joints, &expressed_in_b(omega), &drives);
            let regular = regular::<K, T>(zero, &eliminated, &drives, &bound);
            let within = within_reach::<K, T>(zero, &joints);
            holds = zero.both(holds, zero.both(within, regular));
            let real = zero.load(&group.weight).above(zero);
            if let Some(passive) = &passive {
                let mut stiffness = Stiffness::none(zero);
                add_stiffness::<K, T>(&mut stiffness, passive, &eliminated, &drives);
                let Stiffness { damping, spring } = stiffness;
                assembly.stiffness.damping += damping.or(real, zero).sum();
                assembly.stiffness.spring += spring.or(real, zero).sum();
            }
            let share = K::share(&eliminated).map(|number| number.or(real, zero));
            shares = Some(match &shares {
                Some(sum) => share.zip(sum, |number, sum| sum + number),
                None => share,
            });
            match &of_first {
                None => of_first = Some(Aligned(*K::gains(&eliminated))),
                Some(_) => gains.push(Aligned(*K::gains(&eliminated))),
            }
        }
        assembly.add(&shares?.map(Number::sum));
        let hub = craft.hub_accelerations(inputs, &environment, &mut assembly, at_b).ok()?;
        let splat = |v| map(v, |component| zero.like(component));
        let of_hub =
            Solution { r_b_n_ddot: splat(hub.r_b_n_ddot), omega_dot: splat(hub.omega_dot) };
        let of_hub = of_hub.expressed_in_b();
        let mut vanishing = zero;
        let mut rest = all.devices.iter_mut();
        for Aligned(gains) in of_first.iter().chain(&gains) {
            let found = K::back_substitute(gains, &of_hub);
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
        let holds = zero.like(1.0).or(zero.both(holds, vanishing.same(zero)), zero).store();
        if (0..T::WIDTH).any(|lane| holds.at(lane) != 1.0) {
            return None;
        }
        if let Some(demanded) = demanded {
            *demanded = craft.stiffness(inputs, &assembly);
        }
        all.finish(inputs, &hub, at_b).ok()
    }
}

/// The joints of a group's devices, and what is given of them.
type Gathered<K, T> = (<K as Kernels>::Joints<T>, <K as Kernels>::PerJoint<Drive<T>>);

/// Gathers the joints of a group's devices, and what is given of them; lanes without a device
/// repeat the last.
#[inline(always)]
fn gather<K: Kind<Scalar = f64>, T: Number, const N: usize>(
    craft: &Spacecraft<[K; N]>,
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
        let drives = craft.devices.get(at(lane))?.given_drives(joints, given)?;
        put_drives::<K>(&mut drives_of, lane, &drives);
    }
    let load = |block: Block| zero.load(&block);
    Some((laned, K::zip_per_joint(&drives_of, &drives_of, |drive, _| drive.map(load))))
}
