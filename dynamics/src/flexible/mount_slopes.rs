//! The mounts of a flexible structure as bases of devices: how each moves with displacement and rotation of its place,
//! (F5) to (F8) in dual numbers.

use alloc::vec::Vec;

use crate::derivatives::loads::side_by_side::Load;
use crate::derivatives::tree::base_motion::{BaseMotion, CoordinateSlopes, Link, Moments, spatial};
use crate::derivatives::tree::members::Base;
use crate::derivatives::tree::modal_columns::ModalColumns;
use crate::equations::gravity::Central;
use crate::equations::hub::HubConstants;
use crate::equations::joint_inputs::Environment;
use crate::equations::system::Solution;
use crate::flexible::equations::accelerations::accelerated;
use crate::flexible::equations::block::{Six, combined, joined, parted};
use crate::flexible::equations::mount::MountMotion;
use crate::flexible::equations::spacecraft::{MountConstants, negative, nothing};
use crate::flexible::modal::storage::{Flexible, ModalStorage};
use crate::model::joint_array::MAX_JOINTS;
use crate::model::wrench::Wrench;
use crate::numbers::dual::Dual;
use crate::numbers::real::{Scalar, one, zero};
use crate::numbers::vec3::{Vec3, add, rotate_transposed, sub};
use crate::sets::devices::Devices;
use crate::solve::spacecraft::Spacecraft;
use crate::solve::state::{Accelerations, State};

/// A number with its derivatives by displacement and rotation of a mount, or by their rates.
type ByPlace<T> = Dual<T, 6>;

/// Displacement and rotation of a mount, and their first and second derivatives.
type Places<T> = [Six<T>; 3];

impl<D: Devices, M: ModalStorage> Spacecraft<D, Flexible<M>> {
    /// The mounts as bases on the hub, which moves so.
    pub(crate) fn mount_bases<A>(
        &self,
        state: &State<D, A, Flexible<M>>,
        wrenches: &[Wrench<D::Scalar>],
        accelerations: &Accelerations<D, Flexible<M>>,
        hub: &BaseMotion<D::Scalar>,
        of_b: &Environment<D::Scalar>,
    ) -> Vec<Base<D::Scalar>> {
        let mounts = self.structure.mounts.as_ref().iter().enumerate();
        let bases = mounts.map(|(number, mount)| {
            let eta_ddot = accelerations.modal.eta_ddot.as_ref();
            let (moved, environment) = mount.surroundings(state, of_b);
            let shapes = mount.shapes.as_ref();
            let places = [state.modal.eta.as_ref(), state.modal.eta_dot.as_ref(), eta_ddot]
                .map(|numbers| combined(shapes, numbers));
            let of_hub = Solution { r_b_n_ddot: hub.acceleration, omega_dot: hub.omega_dot };
            let found = accelerated(&moved, &of_hub, mount, eta_ddot);
            let motion = BaseMotion {
                omega: moved.omega,
                acceleration: found.r_b_n_ddot,
                omega_dot: found.omega_dot,
                rho: rotate_transposed(&moved.axes, hub.rho),
            };
            let field = environment.central;
            let wrench = wrenches.get(number).copied().unwrap_or_else(Wrench::none);
            let [force, moment] = spatial(&mount.about_origin(&wrench));
            let body = contained(mount);
            let needed = motion.load(&body, field.as_ref());
            Base {
                link: Some(link(mount, &moved, &places, hub, of_b.central.as_ref())),
                first: 0,
                own: [[Load::none(); MAX_JOINTS]; 2],
                body,
                field,
                motion,
                load: [sub(needed[0], force), sub(needed[1], moment)],
                moments: Moments::of_body(&body),
                shapes: Some(shapes.to_vec()),
            }
        });
        bases.collect()
    }

    /// What the structure has of modes.
    pub(crate) fn modal_columns<A>(
        &self,
        state: &State<D, A, Flexible<M>>,
    ) -> ModalColumns<D::Scalar> {
        let momenta = self.structure.momenta.as_ref();
        let (linear, angular) = parted(&combined(momenta, state.modal.eta_dot.as_ref()));
        let mounts = self.structure.mounts.as_ref().iter();
        ModalColumns {
            massive: self.massive(),
            momenta: momenta.iter().map(parted_columns).collect(),
            passive: self.structure.passive.as_ref().to_vec(),
            rates: [linear, angular],
            positions: mounts.map(|mount| mount.position).collect(),
        }
    }
}

fn parted_columns<T: Scalar>(of: &Six<T>) -> [Vec3<T>; 2] {
    let (linear, angular) = parted(of);
    [linear, angular]
}

/// What the model contains of the devices, to be subtracted.
fn contained<M: ModalStorage, T: Scalar>(mount: &MountConstants<M, T>) -> HubConstants<T> {
    mount.contained.as_ref().map_or_else(nothing, negative)
}

/// A mount on a hub that moves so, its six coordinates displacement and rotation.
fn link<M: ModalStorage, T: Scalar>(
    mount: &MountConstants<M, T>,
    moved: &MountMotion<T>,
    places: &Places<T>,
    hub: &BaseMotion<T>,
    central: Option<&Central<T>>,
) -> Link<T> {
    let [by_place, by_rate] = [0, 1].map(|which| seeded(mount, places, which, hub, central));
    let unit = |own: usize| [0, 1, 2, 3, 4, 5].map(|k| if k == own { one() } else { zero() });
    let two = |of: &Six<T>| {
        let (linear, angular) = parted(of);
        [linear, angular]
    };
    let coordinates = (0..6).map(|own: usize| {
        let directions_by =
            by_place.1.iter().map(|column| two(&column.map(|number| number.derivative(own))));
        CoordinateSlopes {
            direction: two(&moved.of_shape.times(&unit(own))),
            by: [&by_place.0, &by_rate.0].map(|motion| motion.map(|of| of.derivative(own))),
            directions_by: directions_by.collect(),
        }
    });
    Link {
        base: 0,
        axes: moved.axes,
        p: moved.origin,
        p_prime: moved.origin_prime,
        relative: moved.relative,
        omega_base: hub.omega,
        coordinates: coordinates.collect(),
    }
}

/// The motion, and the directions of the six coordinates, with derivatives by these (0) or by their rates (1).
fn seeded<M: ModalStorage, T: Scalar>(
    mount: &MountConstants<M, T>,
    [q, q_dot, q_ddot]: &Places<T>,
    which: usize,
    hub: &BaseMotion<T>,
    central: Option<&Central<T>>,
) -> (BaseMotion<ByPlace<T>>, [Six<ByPlace<T>>; 6]) {
    let constant = ByPlace::constant;
    let mut numbers = [q.map(constant), q_dot.map(constant)];
    for (number, of) in numbers.get_mut(which).into_iter().flatten().enumerate() {
        of.add_derivative(number, one());
    }
    let [place, rate] = numbers;
    let position = mount.position.map(constant);
    let mut moved = MountMotion::new(position, &place, &rate, hub.omega.map(constant));
    if let Some(central) = central {
        moved = moved.falling(&central.map(constant));
    }
    let base = joined(hub.acceleration, hub.omega_dot).map(constant);
    let (of_hub, of_shape) =
        (moved.of_hub.times(&base), moved.of_shape.times(&q_ddot.map(constant)));
    let (v, w) = parted(&moved.bias);
    let ((v_hub, w_hub), (v_shape, w_shape)) = (parted(&of_hub), parted(&of_shape));
    let motion = BaseMotion {
        omega: moved.omega,
        acceleration: add(add(v_hub, v_shape), v),
        omega_dot: add(add(w_hub, w_shape), w),
        rho: rotate_transposed(&moved.axes, hub.rho.map(constant)),
    };
    let unit =
        |own: usize| [0, 1, 2, 3, 4, 5].map(|k| constant(if k == own { one() } else { zero() }));
    (motion, [0, 1, 2, 3, 4, 5].map(|own| moved.of_shape.times(&unit(own))))
}
