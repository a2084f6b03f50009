//! [`ByLoads`]: how accelerations change with state and inputs, by the emitted derivatives of the loads.
//!
//! With `M a + bias = loads` the accelerations change by `-M⁻¹` times what the loads change by at given accelerations.
//! A device's loads depend on its own joints and on the hub's motion, so a column costs one elimination. Seen from a
//! frame that falls with a uniform field the attitude does not enter.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::loads::load_columns::{EachDevice, LoadColumns, Moving, Place};
use crate::derivatives::loads::mass_system::{MassSystem, Reduced, Six};
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
use crate::equations::arithmetic::Arithmetic;
use crate::equations::gravity::Gravity;
use crate::equations::hub::HubConstants;
use crate::equations::load_sums::HubAccelerations;
use crate::model::mode::HubMode;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, add, components, cross, sub};
use crate::sets::devices::Devices;
use crate::solve::accelerations::evaluation_start;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// The derivatives of the loads at a state, and the mass matrix.
#[derive(Debug)]
pub(crate) struct ByLoads<T> {
    by: Arithmetic,
    devices: LoadColumns<T>,
    system: MassSystem<T>,
    hub: HubConstants<T>,
    omega: Vec3<T>,
    /// A uniform field, B axes.
    gravity: Vec3<T>,
    hub_is_free: bool,
}

impl<T: Scalar> ByLoads<T> {
    /// At a state with its accelerations; none where what acts has no emitted derivatives: a flexible structure,
    /// platforms, lumped imbalance, wrenches on bodies, a central field.
    pub(crate) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Option<Self> {
        let central = matches!(inputs.gravity, Gravity::Central { .. });
        let deforms = S::modes(craft) > 0 || S::mounts(craft) > 0;
        if central || deforms || inputs.bodies.is_some() {
            return None;
        }
        let start = evaluation_start(state, inputs);
        let (omega, gravity) = (start.environment.omega, start.at_b);
        let hub = HubAccelerations {
            r_b_n_ddot: sub(components(&accelerations.r_b_n_ddot), gravity),
            omega_dot: components(&accelerations.omega_dot),
        };
        let mut each = {
            let joints = accelerations.devices.values().count();
            EachDevice::new(craft.arithmetic, omega, hub, joints)
        };
        let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
        D::visit::<Moving, _>(&craft.devices, data, &mut each).ok()?;
        let hub_is_free = matches!(inputs.hub, HubMode::Free);
        let matrix = &each.found.matrix;
        let system = MassSystem::new(&craft.hub, craft.mass(), matrix, hub_is_free);
        let by = craft.arithmetic;
        Some(Self { by, devices: each.found, system, hub: craft.hub, omega, gravity, hub_is_free })
    }

    /// The accelerations' derivatives by these variables into the columns of a matrix, whose other rows stay as they
    /// are; the first of the variables of which one is not finite.
    pub(crate) fn columns(
        &self,
        variables: &[Variable],
        into: &mut DMatrix<T>,
    ) -> Result<(), usize> {
        let rows = into.nrows();
        if rows == 0 {
            return Ok(());
        }
        let finite = match self.by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => {
                cpu.dispatch(Dispatched { loads: self, variables, rows, into: &mut *into })
            }
            Arithmetic::Portable => self.fill(variables, rows, into.as_mut_slice()),
        };
        if finite {
            return Ok(());
        }
        let first = into.as_slice().chunks_exact(rows).position(|column| !are_finite(column));
        first.map_or(Ok(()), Err)
    }

    /// Whether all of them are finite.
    #[inline(always)]
    fn fill(&self, variables: &[Variable], rows: usize, into: &mut [T]) -> bool {
        for (variable, column) in variables.iter().zip(into.chunks_exact_mut(rows)) {
            if let Some((hub, joints)) = column.split_first_chunk_mut::<6>() {
                *hub = self.column(*variable, joints);
            }
        }
        are_finite(into)
    }

    /// The accelerations' derivatives by one variable: those of the hub, and those of the joints into `joints`.
    #[inline(always)]
    fn column(&self, by: Variable, joints: &mut [T]) -> Six<T> {
        let unit = |axis: Axis| Axis::ALL.map(|other| if other == axis { one() } else { zero() });
        let (still, zeros) = ([zero(); 6], [zero(); 3]);
        let place = |axis: Axis| axis as usize;
        match by {
            Variable::Coordinate(joint) => self.by_joint(joint, &self.devices.coordinates, joints),
            Variable::Rate(joint) => self.by_joint(joint, &self.devices.rates, joints),
            Variable::Motor(joint) if self.is_free(joint) => {
                self.by_joint(joint, &self.devices.driven, joints)
            }
            Variable::Acceleration(joint) if !self.is_free(joint) => {
                self.by_joint(joint, &self.devices.driven, joints)
            }
            Variable::Attitude(axis) => {
                // [BN] g changes by its product with the small rotation.
                let field = cross(self.gravity, unit(axis));
                let falling = of_both([sub(zeros, field), zeros]);
                let given = if self.hub_is_free { still } else { falling };
                let [a, b, c, d, e, f] = self.followed(given, joints);
                of_both([add([a, b, c], field), [d, e, f]])
            }
            Variable::Omega(axis) => {
                let own = of_both(self.hub.loads_by_omega(self.omega, unit(axis)));
                let mut right = own.map(|load| -load);
                let devices = self.devices.omega.get(place(axis)).into_iter().flatten();
                right.iter_mut().zip(devices).for_each(|(to, from)| *to = *to + *from);
                let base = self.followed(self.system.hub(&right, still), joints);
                for (to, less) in joints.iter_mut().zip(&self.devices.joints_by_omega) {
                    *to = *to - axis.of(*less);
                }
                base
            }
            Variable::Force(axis) => self.followed(self.system.hub_by_unit(place(axis)), joints),
            Variable::TorqueB(axis) => {
                let place = place(axis).wrapping_add(3);
                self.followed(self.system.hub_by_unit(place), joints)
            }
            Variable::HubAcceleration(axis) => self.followed(of_both([unit(axis), zeros]), joints),
            Variable::HubAngularAcceleration(axis) => {
                self.followed(of_both([zeros, unit(axis)]), joints)
            }
            _ => {
                joints.fill(zero());
                still
            }
        }
    }

    /// Of a hub with these accelerations, and of joints of which nothing else changes.
    #[inline(always)]
    fn followed(&self, base: Six<T>, joints: &mut [T]) -> Six<T> {
        self.devices.gains.follow(&base, joints);
        base
    }

    #[inline(always)]
    fn by_joint(&self, joint: usize, of: &[Reduced<T>], joints: &mut [T]) -> Six<T> {
        let Some((reduced, place)) = of.get(joint).zip(self.devices.places.get(joint)) else {
            return self.followed([zero(); 6], joints);
        };
        let base = self.followed(self.system.hub(&reduced.hub, [zero(); 6]), joints);
        let Place { first, count, .. } = *place;
        let own = joints.get_mut(first..first.saturating_add(count)).unwrap_or_default();
        own.iter_mut().zip(&reduced.joints).for_each(|(to, less)| *to = *to - *less);
        base
    }

    fn is_free(&self, joint: usize) -> bool {
        self.devices.places.get(joint).is_some_and(|place| place.free)
    }
}

/// Columns by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct Dispatched<'a, T> {
    loads: &'a ByLoads<T>,
    variables: &'a [Variable],
    rows: usize,
    into: &'a mut DMatrix<T>,
}

#[cfg(feature = "lanes")]
impl<T: Scalar> pulp::WithSimd for Dispatched<'_, T> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> bool {
        self.loads.fill(self.variables, self.rows, self.into.as_mut_slice())
    }
}

/// Whether all numbers are finite: zero times each, summed side by side, is.
#[inline(always)]
pub(crate) fn are_finite<T: Scalar>(numbers: &[T]) -> bool {
    let (fours, rest) = numbers.as_chunks::<4>();
    let mut sums = [zero::<T>(); 4];
    for four in fours {
        for (sum, number) in sums.iter_mut().zip(four) {
            *sum = *sum + *number * zero();
        }
    }
    sums.iter().chain(rest).all(|number| number.is_finite())
}

/// Force and moment about B.
#[inline(always)]
fn of_both<T>([[a, b, c], [d, e, f]]: [Vec3<T>; 2]) -> Six<T> {
    [a, b, c, d, e, f]
}
