//! [`LoadChange`], [`LoadGradient`]: products of the emitted derivatives of the loads of a device with a direction and with
//! weights, of numbers or of lanes.

#![expect(clippy::inline_always, reason = "instructions are reached only in what is inlined")]

use crate::model::kernels::Kernels;
use crate::model::kind::{Kind, LoadColumn, LoadDerivatives};
use crate::numbers::each::JointStates;
use crate::numbers::real::Real;
use crate::numbers::vec3::{Vec3, add, components, dot, map, scale};

/// What the loads of a device change by, in its axes.
pub(crate) struct LoadChange<K: Kernels, T: Real> {
    /// Force and moment about B that the hub exerts.
    pub(crate) hub: [Vec3<T>; 2],
    /// What the motors exert.
    pub(crate) joints: K::PerJoint<T>,
}

impl<K: Kind, T: Real> LoadChange<K, T> {
    /// Along a direction of coordinates, rates and the hub's angular velocity, in the device's axes.
    #[inline(always)]
    pub(crate) fn along(
        zero: T,
        found: &LoadDerivatives<K, T>,
        direction: &K::Joints<T>,
        omega: Vec3<T>,
    ) -> Self {
        let mut change = Self { hub: [[zero; 3]; 2], joints: <K as Kind>::all(zero) };
        let mut states = direction.states();
        K::zip_per_joint(
            &found.coordinates,
            &found.rates,
            #[inline(always)]
            |by_coordinate, by_rate| {
                let [coordinate, rate] = states.next().unwrap_or([zero; 2]);
                change.add(coordinate, &by_coordinate);
                change.add(rate, &by_rate);
                zero
            },
        );
        let ([x, y, z], [by_x, by_y, by_z]) = (omega, &found.omega);
        change.add(x, by_x);
        change.add(y, by_y);
        change.add(z, by_z);
        change
    }

    /// Adds a multiple of a column.
    #[inline(always)]
    fn add(&mut self, by: T, column: &LoadColumn<K, T>) {
        let [force, moment] = self.hub;
        self.hub = [
            add(force, scale(by, components(&column.hub.force))),
            add(moment, scale(by, components(&column.hub.moment))),
        ];
        self.joints = K::zip_per_joint(
            &self.joints,
            &column.joints,
            #[inline(always)]
            |sum, load| sum + by * load,
        );
    }
}

/// The gradient of a weighted sum of the loads, less it, in the device's axes.
pub(crate) struct LoadGradient<K: Kernels, T: Real> {
    /// By coordinates and rates, without springs and friction, and by accelerations.
    pub(crate) coordinates: K::PerJoint<T>,
    pub(crate) rates: K::PerJoint<T>,
    pub(crate) accelerations: K::PerJoint<T>,
    pub(crate) omega: Vec3<T>,
    /// Force and moment that the hub exerts where the joints accelerate by their weights: not less it.
    pub(crate) hub: [Vec3<T>; 2],
}

impl<K: Kind, T: Real> LoadGradient<K, T> {
    /// With weights of force and moment, and of the joints.
    #[inline(always)]
    pub(crate) fn new(
        zero: T,
        found: &LoadDerivatives<K, T>,
        hub: [Vec3<T>; 2],
        weights: &K::PerJoint<T>,
    ) -> Self {
        let of = |columns: &K::PerJoint<LoadColumn<K, T>>| {
            K::zip_per_joint(
                columns,
                weights,
                #[inline(always)]
                |column, _| less::<K, T>(&column, hub, weights),
            )
        };
        let mut exerted = [[zero; 3]; 2];
        K::zip_per_joint(
            &found.accelerations,
            weights,
            #[inline(always)]
            |column, weight| {
                let [force, moment] = exerted;
                exerted = [
                    add(force, scale(weight, components(&column.hub.force))),
                    add(moment, scale(weight, components(&column.hub.moment))),
                ];
                zero
            },
        );
        Self {
            coordinates: of(&found.coordinates),
            rates: of(&found.rates),
            accelerations: of(&found.accelerations),
            omega: map(
                found.omega,
                #[inline(always)]
                |column| less::<K, T>(&column, hub, weights),
            ),
            hub: exerted,
        }
    }
}

/// A column weighed, less it.
#[inline(always)]
fn less<K: Kind, T: Real>(
    column: &LoadColumn<K, T>,
    [force, moment]: [Vec3<T>; 2],
    weights: &K::PerJoint<T>,
) -> T {
    let mut sum =
        dot(force, components(&column.hub.force)) + dot(moment, components(&column.hub.moment));
    K::zip_per_joint(
        &column.joints,
        weights,
        #[inline(always)]
        |load, weight| {
            sum = sum + load * weight;
            sum
        },
    );
    -sum
}
