//! [`ByTree`]: how accelerations change with state and inputs by the emitted derivatives of the loads, whatever acts: where
//! platforms, panels and the mounts of a flexible structure carry devices, in a central field, with wrenches on bodies and
//! with lumped imbalance.
//!
//! A change of how a carrier moves changes the loads of all that it carries; they add up on the carrier, along whose
//! joints they are what its motors exert, and on its base, (I6). So a column is a pass outwards of changed motions, one
//! inwards of changed loads, and `-M⁻¹` of these.

use alloc::vec;

use nalgebra::DMatrix;

use crate::attitude::parameterisation::Attitude;
use crate::derivatives::loads::side_by_side::are_finite;
use crate::derivatives::loads::side_by_side::{Load, TOGETHER};
use crate::derivatives::structure::StructureDerivatives;
use crate::derivatives::tree::base_motion::{BaseMotion, Moments};
use crate::derivatives::tree::changes::Changes;
use crate::derivatives::tree::field_columns::FieldColumns;
use crate::derivatives::tree::mass_matrix::{HUB, mass_matrix};
use crate::derivatives::tree::members::{Base, Members};
use crate::derivatives::tree::modal_columns::ModalColumns;
use crate::derivatives::tree::system::TreeSystem;
use crate::derivatives::variable::Variable;
use crate::isolation::motion::{Spatial, product};
use crate::model::joint_array::MAX_JOINTS;
use crate::model::mode::HubMode;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, columns, components, sub, zeros};
use crate::sets::devices::Devices;
use crate::solve::accelerations::evaluation_start;
use crate::solve::inputs::Inputs;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// The derivatives of the loads at a state, and the mass matrix.
#[derive(Debug)]
pub(crate) struct ByTree<T> {
    pub(crate) members: Members<T>,
    pub(crate) modal: ModalColumns<T>,
    system: TreeSystem<T>,
    pub(crate) field: Option<FieldColumns<T>>,
    /// What the hub's force and moment change by with the position of B, B axes, less those of what it carries.
    pub(crate) hub_by_position: [Spatial<T>; 3],
    /// The field at B, B axes.
    pub(crate) at_b: Vec3<T>,
    pub(crate) hub_is_free: bool,
}

/// What the hub's accelerations have besides those that are solved for: what the field at B changes by, and, of a hub
/// that is not free, what is given.
#[derive(Clone, Copy)]
struct BesidesSolved<T> {
    field: Vec3<T>,
    given: Spatial<T>,
}

impl<T: Scalar> ByTree<T> {
    /// At a state with its accelerations; none where what acts has no emitted derivatives: a platform that is no
    /// carrier.
    pub(crate) fn new<D: Devices<Scalar = T>, A: Attitude<T>, S: StructureDerivatives>(
        craft: &Spacecraft<D, S>,
        state: &State<D, A, S>,
        inputs: &Inputs<D, S>,
        accelerations: &Accelerations<D, S>,
    ) -> Option<Self> {
        let start = evaluation_start(state, inputs);
        let field =
            FieldColumns::new(&inputs.gravity, columns(&state.attitude.dcm()), &state.r_b_n);
        let motion = BaseMotion {
            omega: start.environment.omega,
            acceleration: sub(components(&accelerations.r_b_n_ddot), start.at_b),
            omega_dot: components(&accelerations.omega_dot),
            rho: field.as_ref().map_or_else(zeros, |field| field.rho),
        };
        let body = S::body(craft, state);
        let (mounts, modal) =
            S::bases(craft, state, inputs, accelerations, &motion, &start.environment);
        let hub = Base {
            link: None,
            first: 0,
            own: [[Load::none(); MAX_JOINTS]; 2],
            body,
            field: start.environment.central,
            motion,
            load: [zeros(); 2],
            moments: Moments::of_body(&body),
            shapes: None,
        };
        let mut members = Members::on(hub, mounts);
        let data = (&state.devices, inputs.of_joints(), &accelerations.devices);
        S::visit_members(craft, data, &mut members).ok()?;
        members.add_up();
        let hub_is_free = matches!(inputs.hub, HubMode::Free);
        let system = mass_matrix(&members, &modal, hub_is_free);
        let second = members.bases.first().map(|hub| hub.moments.second);
        let hub_by_position = field.as_ref().zip(second).map(|(field, second)| {
            field.on_hub(&body, &second).map(|[a, b, c, d, e, f]| [[a, b, c], [d, e, f]])
        });
        let hub_by_position = hub_by_position.unwrap_or([[zeros(); 2]; 3]);
        let at_b = start.at_b;
        Some(Self { members, modal, system, field, hub_by_position, at_b, hub_is_free })
    }

    /// The accelerations' derivatives by these variables into the columns of a matrix, those of the modes after those of
    /// the joints; the first of the variables of which one is not finite.
    pub(crate) fn columns(
        &self,
        variables: &[Variable],
        into: &mut DMatrix<T>,
    ) -> Result<(), usize> {
        let height = into.nrows().max(1);
        let mut changes = Changes::none(&self.members, self.modal.count());
        let mut rows = vec![[zero(); TOGETHER]; self.system.len()];
        let columns = into.as_mut_slice().chunks_mut(height.saturating_mul(TOGETHER));
        for (group, (variables, columns)) in variables.chunks(TOGETHER).zip(columns).enumerate() {
            let mut found = [BesidesSolved { field: zeros(), given: [zeros(); 2] }; TOGETHER];
            rows.fill([zero(); TOGETHER]);
            for (place, (variable, found)) in variables.iter().zip(&mut found).enumerate() {
                changes.clear();
                found.field = self.change(*variable, &mut changes);
                self.carry(&mut changes);
                found.given = changes.given;
                for (to, from) in rows.iter_mut().zip(changes.rows()) {
                    if let Some(to) = to.get_mut(place) {
                        *to = from;
                    }
                }
            }
            self.system.solve(&mut rows);
            let each = variables.iter().zip(columns.chunks_mut(height)).zip(&found);
            for (place, ((variable, column), found)) in each.enumerate() {
                self.write(*variable, (&rows, place), found, column);
                if !are_finite(column) {
                    return Err(group.saturating_mul(TOGETHER).saturating_add(place));
                }
            }
        }
        Ok(())
    }

    /// Writes a column by a place of the solved rows.
    fn write(
        &self,
        by: Variable,
        (rows, place): (&[[T; TOGETHER]], usize),
        found: &BesidesSolved<T>,
        column: &mut [T],
    ) {
        let of = |row: &[T; TOGETHER]| -row.get(place).copied().unwrap_or_else(zero);
        let Some((hub, joints)) = column.split_first_chunk_mut::<HUB>() else { return };
        let (of_hub, rest) = rows.split_at(rows.len().min(HUB));
        let (modes, of_joints) = rest.split_at(self.modal.count().min(rest.len()));
        joints.iter_mut().zip(of_joints.iter().chain(modes)).for_each(|(to, row)| *to = of(row));
        if self.hub_is_free {
            hub.iter_mut().zip(of_hub).for_each(|(to, row)| *to = of(row));
        } else {
            let given = found.given.as_flattened();
            hub.iter_mut().zip(given).for_each(|(to, from)| *to = *from);
        }
        if let Variable::Acceleration(joint) = by
            && let Some(own) = joints.get_mut(joint)
        {
            *own = one();
        }
        hub.iter_mut().zip(found.field).for_each(|(to, field)| *to = *to + field);
    }

    /// Carries changed motions outwards, and the loads that change with them inwards.
    fn carry(&self, changes: &mut Changes<T>) {
        let Members { bases, devices, .. } = &self.members;
        for (number, base) in bases.iter().enumerate() {
            if let Some(link) = &base.link
                && let Some(Some(of_base)) = changes.motions.get(link.base)
            {
                let field = bases.get(link.base).and_then(|base| base.field.as_ref());
                let carried = link.carried(of_base, field);
                changes.moves(number, &carried);
            }
            let Some(Some(change)) = changes.motions.get(number).copied() else { continue };
            // Of the hub with the third-order force: `hub_by_position`.
            let field = base.field.as_ref().filter(|_| number > 0);
            changes.load(number, base.motion.load_by(&base.body, field, &change));
            if number == 0 {
                let mut modes = changes.modes.iter_mut();
                let load = self.modal.by_motion(&change, |value| {
                    if let Some(to) = modes.next() {
                        *to = *to + value;
                    }
                });
                changes.load(0, load);
            }
        }
        for device in devices {
            if let Some(Some(change)) = changes.motions.get(device.base) {
                let load = device.by_motion(change);
                changes.add(device.base, device.first, &load);
            }
        }
        for (number, base) in bases.iter().enumerate().skip(1).rev() {
            let load = changes.loads.get(number).copied();
            let (Some(link), Some(load)) = (&base.link, load) else { continue };
            changes.along(base, link.coordinates.iter().map(|of| product(&of.direction, &load)));
            changes.load(link.base, link.inward(load));
        }
    }
}
