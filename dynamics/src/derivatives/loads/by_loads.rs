//! [`ByLoads`]: how accelerations change with state and inputs, by the emitted derivatives of the loads.
//!
//! With `M a + bias = loads` the accelerations change by `-M⁻¹` times what the loads change by at given accelerations.
//! A device's loads depend on its own joints and on the hub's motion, so a column costs one elimination. Seen from a
//! frame that falls with a uniform field the attitude does not enter.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::loads::load_columns::{EachDevice, LoadColumns, Moving, Place};
use crate::derivatives::loads::mass_system::{MassSystem, follow};
#[cfg(feature = "lanes")]
use crate::derivatives::loads::side_by_side::HubGroup;
use crate::derivatives::loads::side_by_side::{Six, TOGETHER};
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
use crate::equations::arithmetic::Arithmetic;
use crate::equations::gravity::Gravity;
use crate::equations::hub::HubConstants;
use crate::equations::load_sums::HubAccelerations;
use crate::model::mode::HubMode;
use crate::numbers::each::Each;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, components, cross, sub};
use crate::sets::devices::Devices;
use crate::solve::accelerations::evaluation_start;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// The derivatives of the loads at a state, and the mass matrix.
#[derive(Debug)]
pub(crate) struct ByLoads<T> {
    by: Arithmetic,
    /// Groups with the hub's accelerations for the right side of its equations.
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
        let mut devices = each.found;
        let system = MassSystem::new(&craft.hub, craft.mass(), &devices.matrix, hub_is_free);
        let by = craft.arithmetic;
        match by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => {
                cpu.dispatch(DispatchedHub { system: &system, groups: &mut devices.groups });
            }
            Arithmetic::Portable => system.hub_of_groups(&mut devices.groups),
        }
        Some(Self { by, devices, system, hub: craft.hub, omega, gravity, hub_is_free })
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
        let gains = self.devices.gains.rows();
        for (variable, column) in variables.iter().zip(into.chunks_exact_mut(rows)) {
            let Some((hub, joints)) = column.split_first_chunk_mut::<6>() else { continue };
            let Some(Change { base, field, own }) = self.change(*variable) else {
                column.fill(zero());
                continue;
            };
            follow(gains, &base, joints);
            *hub = base;
            match own {
                Own::Device { first, less } => {
                    let own = joints.get_mut(first..).unwrap_or_default();
                    own.iter_mut().zip(less.get()).for_each(|(to, less)| *to = *to - less);
                }
                Own::All(axis) => {
                    for (to, less) in joints.iter_mut().zip(&self.devices.joints_by_omega) {
                        *to = *to - axis.of(*less);
                    }
                }
                Own::None => {}
            }
            if let Some([x, y, z]) = field {
                let [a, b, c, d, e, f] = base;
                *hub = [a + x, b + y, c + z, d, e, f];
            }
        }
        are_finite(into)
    }

    /// What changes with one variable; none where nothing does.
    #[inline(always)]
    fn change(&self, by: Variable) -> Option<Change<'_, T>> {
        let unit = |axis: Axis| Axis::ALL.map(|other| if other == axis { one() } else { zero() });
        let (still, zeros) = ([zero(); 6], [zero(); 3]);
        let place = |axis: Axis| axis as usize;
        let base = match by {
            Variable::Coordinate(joint) => return self.by_joint(joint, 0),
            Variable::Rate(joint) => return self.by_joint(joint, 1),
            Variable::Motor(joint) if self.is_free(joint) => return self.by_joint(joint, 2),
            Variable::Acceleration(joint) if !self.is_free(joint) => {
                return self.by_joint(joint, 2);
            }
            Variable::Attitude(axis) if self.gravity.iter().any(|field| !field.vanishes()) => {
                // [BN] g changes by its product with the small rotation.
                let field = cross(self.gravity, unit(axis));
                let falling = of_both([sub(zeros, field), zeros]);
                let base = if self.hub_is_free { still } else { falling };
                return Some(Change { base, field: Some(field), own: Own::None });
            }
            Variable::Omega(axis) => {
                let own = of_both(self.hub.loads_by_omega(self.omega, unit(axis)));
                let mut right = still;
                let devices = self.devices.omega.get(place(axis)).into_iter().flatten();
                for ((to, own), devices) in right.iter_mut().zip(own).zip(devices) {
                    *to = *devices - own;
                }
                let base = self.system.hub(&right, still);
                return Some(Change { base, field: None, own: Own::All(axis) });
            }
            Variable::Force(axis) => self.system.hub_by_unit(place(axis)),
            Variable::TorqueB(axis) => self.system.hub_by_unit(place(axis).wrapping_add(3)),
            Variable::HubAcceleration(axis) => of_both([unit(axis), zeros]),
            Variable::HubAngularAcceleration(axis) => of_both([zeros, unit(axis)]),
            _ => return None,
        };
        Some(Change { base, field: None, own: Own::None })
    }

    /// By the coordinate of a joint, by its rate, or by what drives it.
    #[inline(always)]
    fn by_joint(&self, joint: usize, which: usize) -> Option<Change<'_, T>> {
        let Place { first, count, group, line, .. } = *self.devices.places.get(joint)?;
        let own = joint.wrapping_sub(first).wrapping_add(which.wrapping_mul(count));
        let (of_device, place) = (own / TOGETHER, own % TOGETHER);
        let [a, b, c, d, e, f] = self.devices.groups.get(group.wrapping_add(of_device))?;
        let line = line.wrapping_add(of_device.wrapping_mul(count));
        let lines = self.devices.lines.get(line..)?.get(..count)?;
        Some(Change {
            base: [a[place], b[place], c[place], d[place], e[place], f[place]],
            field: None,
            own: Own::Device { first, less: Less { lines, place } },
        })
    }

    fn is_free(&self, joint: usize) -> bool {
        self.devices.places.get(joint).is_some_and(|place| place.free)
    }
}

/// What changes with a variable.
struct Change<'a, T> {
    /// The hub's accelerations, as seen from what falls with the field.
    base: Six<T>,
    /// The field.
    field: Option<Vec3<T>>,
    own: Own<'a, T>,
}

/// By how much less joints accelerate than those that follow the hub.
enum Own<'a, T> {
    None,
    /// Those of a device, from its first on.
    Device {
        first: usize,
        less: Less<'a, T>,
    },
    /// All, by the angular velocity about an axis.
    All(Axis),
}

/// A place in each line.
struct Less<'a, T> {
    lines: &'a [[T; TOGETHER]],
    place: usize,
}

impl<T: Scalar> Less<'_, T> {
    #[inline(always)]
    fn get(&self) -> impl Iterator<Item = T> {
        self.lines.iter().map(|line| line[self.place % TOGETHER])
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

/// The hub's accelerations of groups by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct DispatchedHub<'a, T> {
    system: &'a MassSystem<T>,
    groups: &'a mut [HubGroup<T>],
}

#[cfg(feature = "lanes")]
impl<T: Scalar> pulp::WithSimd for DispatchedHub<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.system.hub_of_groups(self.groups);
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
