//! [`Applied`]: derivatives of what acts on the bodies of a device from outside: wrenches on bodies, the lumped imbalance,
//! the gradient of a central field.
//!
//! A wrench turns with its body. Where a joint turns by `dq`, the wrench `(f, m)` of the bodies outboard of it, about its
//! origin and expressed in its child body, changes as seen from inboard by `(a x f, a x m) dq`; where it slides, by
//! `(0, a x f) dq`. So each column is the kernel `external` of one wrench. Only the wrenches of the gradient on the bodies
//! change with the coordinates themselves: the kernel `gravity` in dual numbers.

use crate::derivatives::loads::side_by_side::Load;
use crate::equations::device::Device;
use crate::equations::gravity::{Central, gradient};
use crate::isolation::motion::Spatial;
use crate::model::joint_array::MAX_JOINTS;
use crate::model::kind::{JointInfo, Kind, Lumped, Wrenches};
use crate::model::wrench::Wrench;
use crate::numbers::dual::Dual;
use crate::numbers::each::{Each, JointStates};
use crate::numbers::real::{Scalar, one, two, zero};
use crate::numbers::symmetric::Symmetric;
use crate::numbers::vec3::{Vec3, components, cross, vector, zeros};

/// How many coordinates one evaluation of `gravity` is differentiated by.
const WIDTH: usize = 4;

/// A number with its derivatives by some coordinates.
type ByCoordinates<T> = Dual<T, WIDTH>;

/// What acts on one device, as loads that hub and motors exert less: expressed in B, about B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Applied<T> {
    /// What acts, force and moment.
    pub(crate) hub: Spatial<T>,
    /// By the joints' coordinates.
    pub(crate) coordinates: [Load<T>; MAX_JOINTS],
    /// By the joints' rates.
    pub(crate) rates: [Load<T>; MAX_JOINTS],
    /// By the position of B from the centre of the field, B axes.
    pub(crate) position: [Load<T>; 3],
    /// Second moment about B, and its derivatives by the joints' coordinates; only with a central field.
    pub(crate) second_moment: Symmetric<T>,
    pub(crate) second_moment_by: [Symmetric<T>; MAX_JOINTS],
}

/// The wrenches of the gradient on the bodies of a device with its second moment in its own axes, and their derivatives
/// by each coordinate.
struct OfGradient<K: Kind> {
    value: (Wrenches<K>, Symmetric<K::Scalar>),
    by: [(Wrenches<K>, Symmetric<K::Scalar>); MAX_JOINTS],
}

impl<T: Scalar> Applied<T> {
    /// Of a device under wrenches on its bodies, in a field; none where nothing acts.
    pub(crate) fn new<K: Kind<Scalar = T>>(
        device: &Device<K>,
        joints: &K::Joints<T>,
        bodies: Option<&Wrenches<K>>,
        field: Option<&Central<T>>,
    ) -> Option<Self> {
        if bodies.is_none() && field.is_none() && device.lumped.is_none() {
            return None;
        }
        let pose = K::pose(joints);
        let load = |wrenches: &Wrenches<K>| Load::of_applied(device, &pose, wrenches);
        let no_wrenches = || K::all(Wrench::none());
        let no_loads = [Load::none(); MAX_JOINTS];
        let mut found = Self {
            hub: [zeros(); 2],
            coordinates: no_loads,
            rates: no_loads,
            position: [Load::none(); 3],
            second_moment: Symmetric::zero(),
            second_moment_by: [Symmetric::zero(); MAX_JOINTS],
        };
        let mut wrenches = device.applied(joints, bodies);
        let of_gradient = field.map(|field| gradient_by_coordinates(device, joints, field));
        if let Some(OfGradient { value: (own, second_moment), by }) = &of_gradient {
            for (sum, wrench) in wrenches.values_mut().zip(own.values()) {
                *sum = sum.plus(&wrench);
            }
            found.second_moment = second_moment.rotated(&device.mount);
            for (to, (_, second)) in found.second_moment_by.iter_mut().zip(by) {
                *to = second.rotated(&device.mount);
            }
        }
        let carried = device.carried(&pose, &wrenches);
        let hub = carried.hub.turned(&device.mount);
        found.hub = [components(&hub.force), components(&hub.moment)];
        let outboard = carried.joints.values().zip(K::JOINTS);
        for (joint, (to, (outboard, info))) in
            found.coordinates.iter_mut().zip(outboard).enumerate()
        {
            if info.ignorable {
                continue;
            }
            let by = of_gradient.as_ref().and_then(|of| of.by.get(joint));
            let mut change = by.map_or_else(no_wrenches, |(wrenches, _)| *wrenches);
            if let Some(own) = change.values_mut().nth(joint) {
                *own = own.plus(&moved(&outboard, info));
            }
            *to = load(&change);
        }
        if let (Some(lumped), Some([_, spin])) = (&device.lumped, joints.states().last()) {
            let mut change = no_wrenches();
            if let Some(tip) = change.values_mut().last() {
                *tip = slope(lumped, spin);
            }
            if let Some(to) = found.rates.get_mut(K::JOINTS.len().saturating_sub(1)) {
                *to = load(&change);
            }
        }
        if let Some(field) = field {
            for (axis, to) in found.position.iter_mut().enumerate() {
                let e = [0, 1, 2].map(|own| if own == axis { one() } else { zero() });
                let changed = field.changed(e);
                let (wrenches, _) =
                    gradient::<K, T>(&device.constants, &device.mount, &pose, &changed);
                *to = load(&wrenches);
            }
        }
        Some(found)
    }
}

impl<T: Scalar> Load<T> {
    /// What hub and motors exert less where these wrenches act on the bodies.
    pub(crate) fn of_applied<K: Kind<Scalar = T>>(
        device: &Device<K>,
        pose: &K::Pose<T>,
        wrenches: &Wrenches<K>,
    ) -> Self {
        let carried = device.carried(pose, wrenches);
        let hub = carried.hub.turned(&device.mount);
        let ([a, b, c], [d, e, f]) = (components(&hub.force), components(&hub.moment));
        let mut load = Self { hub: [a, b, c, d, e, f].map(|number| -number), ..Self::none() };
        let along = carried.joints.values().zip(K::JOINTS).map(|(wrench, info)| wrench.along(info));
        load.joints.iter_mut().zip(along).for_each(|(to, along)| *to = -along);
        load
    }
}

/// What hub and motors exert less for each component of force and moment on the body of each joint.
pub(crate) fn by_wrenches<K: Kind<Scalar = T>, T: Scalar>(
    device: &Device<K>,
    joints: &K::Joints<T>,
) -> impl Iterator<Item = [Load<T>; 6]> {
    let pose = K::pose(joints);
    (0..K::JOINTS.len()).map(move |joint| {
        [0, 1, 2, 3, 4, 5].map(|component: usize| {
            let [a, b, c, d, e, f] =
                [0, 1, 2, 3, 4, 5].map(|own| if own == component { one() } else { zero() });
            let mut wrenches = K::all(Wrench::none());
            if let Some(own) = wrenches.values_mut().nth(joint) {
                *own = Wrench::of([a, b, c], [d, e, f]);
            }
            Load::of_applied(device, &pose, &wrenches)
        })
    })
}

/// By how much the wrench of the bodies outboard of a joint changes with its coordinate, seen from inboard.
fn moved<T: Scalar>(outboard: &Wrench<T>, info: &JointInfo) -> Wrench<T> {
    let axis: Vec3<T> = [0, 1, 2].map(|own| if own == info.axis { one() } else { zero() });
    let (force, moment) = (components(&outboard.force), components(&outboard.moment));
    let along_force = cross(axis, force);
    if info.slides {
        Wrench::torque(&vector(along_force))
    } else {
        Wrench::of(along_force, cross(axis, moment))
    }
}

/// By how much the lumped disturbance changes with the rate of the wheel.
fn slope<T: Scalar>(lumped: &Lumped<T>, spin: T) -> Wrench<T> {
    lumped.map(|number| two::<T>() * spin * number).at(one())
}

/// The kernel `gravity` with its derivatives by the joints' coordinates.
fn gradient_by_coordinates<K: Kind<Scalar = T>, T: Scalar>(
    device: &Device<K>,
    joints: &K::Joints<T>,
    field: &Central<T>,
) -> OfGradient<K> {
    let constant = ByCoordinates::constant;
    let constants =
        K::zip_constants(&device.constants, &device.constants, |number, _| constant(number));
    let [x, y, z] = device.mount;
    let transposed = [[x[0], y[0], z[0]], [x[1], y[1], z[1]], [x[2], y[2], z[2]]];
    let g = field.gradient.rotated(&transposed);
    let entries = [g.xx, g.xy, g.xz, g.yy, g.yz, g.zz].map(constant);
    let none = (K::all(Wrench::none()), Symmetric::zero());
    let mut found = OfGradient { value: none, by: [none; MAX_JOINTS] };
    let columns = found.by.get_mut(..K::JOINTS.len()).unwrap_or_default();
    for (part, columns) in columns.chunks_mut(WIDTH).enumerate() {
        let mut seeded = K::zip_joints(joints, joints, |number, _| constant(number));
        let first = part.saturating_mul(WIDTH);
        for (number, [coordinate, _]) in seeded.states_mut().skip(first).take(WIDTH).enumerate() {
            coordinate.add_derivative(number, one());
        }
        let (wrenches, tensor) = K::gravity(&constants, &K::pose(&seeded), entries);
        let of = |number: Option<usize>| {
            let part =
                |of: ByCoordinates<T>| number.map_or(of.value, |number| of.derivative(number));
            let mut all = K::all(Wrench::none());
            for (to, from) in all.values_mut().zip(wrenches.values()) {
                *to = Wrench { force: from.force.map(part), moment: from.moment.map(part) };
            }
            let [xx, xy, xz, yy, yz, zz] = tensor.map(part);
            (all, Symmetric { xx, xy, xz, yy, yz, zz })
        };
        found.value = of(None);
        columns.iter_mut().enumerate().for_each(|(number, to)| *to = of(Some(number)));
    }
    found
}
