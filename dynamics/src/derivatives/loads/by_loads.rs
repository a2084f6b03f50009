//! [`ByLoads`]: how accelerations change with state and inputs, by the emitted derivatives of the loads.
//!
//! With `M a + bias = loads` the accelerations change by `-M⁻¹` times what the loads change by at given accelerations.
//! A device's loads depend on its own joints and on the hub's motion, so a column costs one elimination. Seen from a
//! frame that falls with a uniform field the attitude does not enter.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

#[cfg(feature = "alloc")]
use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
#[cfg(feature = "alloc")]
use crate::derivatives::loads::each_device::EachDevice;
use crate::derivatives::loads::fixed_columns::{FixedColumns, FixedDevices};
use crate::derivatives::loads::kernel::Moving;
use crate::derivatives::loads::kernel_loads::{COORDINATE, DRIVE, RATE};
#[cfg(feature = "alloc")]
use crate::derivatives::loads::load_columns::LoadsWorkspace;
use crate::derivatives::loads::load_columns::{HubSums, JointColumns};
use crate::derivatives::loads::mass_system::{Gains, MassSystem};
#[cfg(feature = "alloc")]
use crate::derivatives::loads::side_by_side::are_finite;
use crate::derivatives::loads::side_by_side::{Finiteness, HubGroup, Six, TOGETHER};
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::variable::{Axis, Variable};
#[cfg(feature = "alloc")]
use crate::equations::arithmetic::Arithmetic;
use crate::equations::gravity::Gravity;
use crate::equations::hub::HubConstants;
use crate::equations::load_sums::HubAccelerations;
use crate::model::mode::HubMode;
#[cfg(feature = "alloc")]
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
pub(crate) struct ByLoads<'a, T, const P: usize = TOGETHER> {
    #[cfg(feature = "alloc")]
    pub(crate) by: Arithmetic,
    /// Of the joints, with the hub's accelerations for the right side of its equations.
    pub(crate) joints: &'a [JointColumns<T>],
    pub(crate) gains: Gains<'a, T, P>,
    system: MassSystem<T>,
    /// The hub's accelerations by each component of its angular velocity.
    pub(crate) by_omega: HubGroup<T>,
    /// A uniform field, B axes.
    gravity: Vec3<T>,
    hub_is_free: bool,
}

/// How the hub moves, seen from a frame that falls with a uniform field.
struct FallingHub<T> {
    omega: Vec3<T>,
    accelerations: HubAccelerations<T>,
    /// The field, B axes.
    gravity: Vec3<T>,
}

impl<T: Scalar> FallingHub<T> {
    /// None where what acts has no emitted derivatives: a flexible structure, wrenches on bodies, a central field.
    fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
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
        let accelerations = HubAccelerations {
            r_b_n_ddot: sub(components(&accelerations.r_b_n_ddot), gravity),
            omega_dot: components(&accelerations.omega_dot),
        };
        Some(Self { omega, accelerations, gravity })
    }
}

impl<'a, T: Scalar> ByLoads<'a, T, 1> {
    /// As [`ByLoads::new`], without a heap; none also where there is no room for the joints.
    pub(crate) fn in_arrays<D: Devices<Scalar = T>, A: Attitude<T>, S, const JOINTS: usize>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        columns: &'a mut FixedColumns<T, JOINTS>,
    ) -> Option<Self>
    where
        S: StructureDerivatives,
    {
        let FallingHub { omega, accelerations: hub, gravity } =
            FallingHub::new(craft, state, inputs, accelerations)?;
        let mut each = FixedDevices::new((omega, hub), columns);
        let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
        D::visit::<Moving, _>(&craft.devices, data, &mut each).ok()?;
        let (joints, blocks, sums) = each.found()?;
        let hub_is_free = matches!(inputs.hub, HubMode::Free);
        let (hub, mass) = (&craft.hub, craft.mass());
        let reduction = HubReduction { hub, omega, mass, joints: &mut *joints, sums, hub_is_free };
        let (system, by_omega) = reduction.run();
        Some(Self {
            #[cfg(feature = "alloc")]
            by: Arithmetic::Portable,
            joints,
            gains: Gains { blocks },
            system,
            by_omega,
            gravity,
            hub_is_free,
        })
    }
}

#[cfg(feature = "alloc")]
impl<'a, T: Scalar> ByLoads<'a, T> {
    /// At a state with its accelerations; none where what acts has no emitted derivatives: a flexible structure,
    /// platforms, lumped imbalance, wrenches on bodies, a central field.
    pub(crate) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
        workspace: &'a mut LoadsWorkspace<T>,
    ) -> Option<Self> {
        let FallingHub { omega, accelerations: hub, gravity } =
            FallingHub::new(craft, state, inputs, accelerations)?;
        let (by, joints) = (craft.arithmetic, accelerations.devices.values().count());
        let mut each = EachDevice::new(by, (omega, hub), joints, workspace);
        let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
        D::visit::<Moving, _>(&craft.devices, data, &mut each).ok()?;
        let hub_is_free = matches!(inputs.hub, HubMode::Free);
        let (joints, sums) = workspace.columns.joints_and_sums();
        let (hub, mass) = (&craft.hub, craft.mass());
        let reduction = HubReduction { hub, omega, mass, joints, sums, hub_is_free };
        let (system, by_omega) = match by {
            #[cfg(feature = "lanes")]
            Arithmetic::Dispatched(cpu) => cpu.dispatch(reduction),
            Arithmetic::Portable => reduction.run(),
        };
        let (joints, gains) = (workspace.columns.joints(), workspace.columns.gains());
        Some(Self { by, joints, gains, system, by_omega, gravity, hub_is_free })
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

    /// The columns of a matrix of so many rows; whether all of them are finite, which may be false where they are.
    #[inline(always)]
    fn fill(&self, variables: &[Variable], rows: usize, into: &mut [T]) -> bool {
        let mut finite = Finiteness::of_none();
        for (variable, column) in variables.iter().zip(into.chunks_exact_mut(rows)) {
            let Some((hub, joints)) = column.split_first_chunk_mut::<6>() else { continue };
            if !self.fill_column(*variable, (hub, joints), &mut finite) {
                column.fill(zero());
            }
        }
        finite.holds()
    }
}

impl<T: Scalar, const P: usize> ByLoads<'_, T, P> {
    /// The hub's accelerations and the joints' by a variable; false, and nothing is written, where nothing changes.
    #[inline(always)]
    pub(crate) fn fill_column(
        &self,
        by: Variable,
        (hub, joints): (&mut Six<T>, &mut [T]),
        finite: &mut Finiteness<T>,
    ) -> bool {
        let Some(Change { base, field, own }) = self.change(by) else { return false };
        self.gains.follow(&base, joints, finite);
        *hub = base;
        match own {
            Own::Device { of, place } => {
                let last = of.first.wrapping_add(of.count);
                let own = joints.get_mut(of.first..last).unwrap_or_default();
                let less = of.less.iter().map(|line| line[place % TOGETHER]);
                own.iter_mut().zip(less).for_each(|(to, less)| *to = *to - less);
                own.chunks(TOGETHER).for_each(|own| finite.see_each(own));
            }
            Own::All(axis) => {
                self.gains.subtract_by_omega(axis as usize, joints);
                joints.chunks(TOGETHER).for_each(|joints| finite.see_each(joints));
            }
            Own::None => {}
        }
        if let Some([x, y, z]) = field {
            let [a, b, c, d, e, f] = base;
            *hub = [a + x, b + y, c + z, d, e, f];
        }
        let [a, b, c, d, rest @ ..] = *hub;
        finite.see(&[a, b, c, d]);
        finite.see_each(&rest);
        true
    }

    /// What changes with one variable; none where nothing does.
    #[inline(always)]
    pub(crate) fn change(&self, by: Variable) -> Option<Change<'_, T>> {
        let unit = |axis: Axis| Axis::ALL.map(|other| if other == axis { one() } else { zero() });
        let (still, zeros) = ([zero(); 6], [zero(); 3]);
        let place = |axis: Axis| axis as usize;
        let base = match by {
            Variable::Coordinate(joint) => return self.by_joint(joint, COORDINATE),
            Variable::Rate(joint) => return self.by_joint(joint, RATE),
            Variable::Motor(joint) if self.is_free(joint) => return self.by_joint(joint, DRIVE),
            Variable::Acceleration(joint) if !self.is_free(joint) => {
                return self.by_joint(joint, DRIVE);
            }
            Variable::Attitude(axis) if self.gravity.iter().any(|field| !field.vanishes()) => {
                // [BN] g changes by its product with the small rotation.
                let field = cross(self.gravity, unit(axis));
                let falling = of_both([sub(zeros, field), zeros]);
                let base = if self.hub_is_free { still } else { falling };
                return Some(Change { base, field: Some(field), own: Own::None });
            }
            Variable::Omega(axis) => {
                let base = self.by_omega.map(|row| row[place(axis)]);
                return Some(Change { base, field: None, own: Own::All(axis) });
            }
            Variable::Force(axis) => *self.system.hub_by_units()?.get(place(axis))?,
            Variable::TorqueB(axis) => {
                *self.system.hub_by_units()?.get(place(axis).wrapping_add(3))?
            }
            Variable::HubAcceleration(axis) => of_both([unit(axis), zeros]),
            Variable::HubAngularAcceleration(axis) => of_both([zeros, unit(axis)]),
            _ => return None,
        };
        Some(Change { base, field: None, own: Own::None })
    }

    /// Whether there is a uniform field.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn in_field(&self) -> bool {
        self.gravity.iter().any(|field| !field.vanishes())
    }

    /// The hub's accelerations by its inputs: by force and torque, by themselves where they are given.
    #[cfg(feature = "alloc")]
    #[inline(always)]
    pub(crate) fn by_hub(&self) -> [Six<T>; 6] {
        let units = [0, 1, 2, 3, 4, 5].map(|row| {
            let mut base = [zero(); 6];
            base[row] = one();
            base
        });
        self.system.hub_by_units().copied().unwrap_or(units)
    }

    /// By the coordinate of a joint, by its rate, or by what drives it.
    #[inline(always)]
    fn by_joint(&self, joint: usize, place: usize) -> Option<Change<'_, T>> {
        let of = self.joints.get(joint)?;
        let base = of.hub.map(|row| row[place % TOGETHER]);
        Some(Change { base, field: None, own: Own::Device { of, place } })
    }

    fn is_free(&self, joint: usize) -> bool {
        self.joints.get(joint).is_some_and(|of| of.free)
    }
}

/// The hub's equations, to be solved for the right sides of all joints.
struct HubReduction<'a, T> {
    hub: &'a HubConstants<T>,
    omega: Vec3<T>,
    /// Of the whole.
    mass: T,
    joints: &'a mut [JointColumns<T>],
    sums: &'a HubSums<T>,
    hub_is_free: bool,
}

impl<T: Scalar> HubReduction<'_, T> {
    /// In place of the right sides the hub's accelerations; those by its angular velocity, too.
    #[inline(always)]
    fn run(self) -> (MassSystem<T>, HubGroup<T>) {
        let Self { hub, omega, mass, joints, sums, hub_is_free } = self;
        let system = MassSystem::new(hub, mass, &sums.matrix, hub_is_free);
        for joint in joints {
            system.hub_of_group(&mut joint.hub);
        }
        let mut by_omega = sums.omega;
        for (axis, unit) in UNITS.into_iter().enumerate() {
            let own = of_both(hub.loads_by_omega(omega, unit.map(T::from_f64)));
            for (row, own) in by_omega.iter_mut().zip(own) {
                row[axis] = row[axis] - own;
            }
        }
        system.hub_of_group(&mut by_omega);
        (system, by_omega)
    }
}

/// What changes with a variable.
pub(crate) struct Change<'a, T> {
    /// The hub's accelerations, as seen from what falls with the field.
    pub(crate) base: Six<T>,
    /// The field.
    pub(crate) field: Option<Vec3<T>>,
    pub(crate) own: Own<'a, T>,
}

/// By how much less joints accelerate than those that follow the hub.
pub(crate) enum Own<'a, T> {
    None,
    /// Those of a joint's device, by the variable in this place.
    Device {
        of: &'a JointColumns<T>,
        place: usize,
    },
    /// All, by the angular velocity about an axis.
    All(Axis),
}

/// Columns by the instructions of this CPU.
#[cfg(feature = "lanes")]
struct Dispatched<'a, T> {
    loads: &'a ByLoads<'a, T>,
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

/// The same by the instructions of this CPU.
#[cfg(feature = "lanes")]
impl<T: Scalar> pulp::WithSimd for HubReduction<'_, T> {
    type Output = (MassSystem<T>, HubGroup<T>);

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Self::Output {
        self.run()
    }
}

/// Along each axis of B.
const UNITS: [Vec3<f64>; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Force and moment about B.
#[inline(always)]
fn of_both<T>([[a, b, c], [d, e, f]]: [Vec3<T>; 2]) -> Six<T> {
    [a, b, c, d, e, f]
}
