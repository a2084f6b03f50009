//! [`Modes`]: the modes of a structure in its floating frame B, as numbers.
//!
//! Numbers in SI units, all vectors expressed in B, the structure undeformed. Checked and turned
//! into constants once by [`Spacecraft::flexible`](crate::Spacecraft::flexible).

use core::fmt::Debug;

use nalgebra::{Matrix3, Vector3};

use crate::flexible::modal::storage::ModalStorage;

/// Modes of a structure: mass-normalised shapes about the floating frame B.
///
/// A point at r of the undeformed structure is displaced by `phi(r) eta` in B. The modal mass is
/// one: `integral of phi_i . phi_j dm` is 1 for i = j and 0 otherwise, so that `eta` is in m
/// sqrt(kg).
///
/// Which frame B is follows from the shapes: clamped at B (cantilever modes), they have momentum
/// integrals; those of the free structure have none about its centre of mass.
#[derive(Clone, Debug)]
pub struct Modes<M: ModalStorage, T: Clone + Debug = f64> {
    /// `w`, natural frequencies, rad/s; not below zero.
    pub frequencies: M::Modes<T>,
    /// `zeta`, damping ratios; not below zero.
    pub damping: M::Modes<T>,
    /// P, linear momentum integrals, `integral of phi_i dm`, sqrt(kg).
    pub linear: M::Modes<Vector3<T>>,
    /// H, angular momentum integrals about B, `integral of r x phi_i dm`, m sqrt(kg).
    pub angular: M::Modes<Vector3<T>>,
    /// The points on which devices stand.
    pub mounts: M::Mounts<ModalMount<M, T>>,
}

/// Shapes at a point of the structure: a mount, or a node such as an optic or a star tracker.
#[derive(Clone, Debug)]
pub struct ModalPoint<M: ModalStorage, T: Clone + Debug = f64> {
    /// Its place from B, m.
    pub position: Vector3<T>,
    /// `Phi`, displacement per modal coordinate, 1/sqrt(kg).
    pub translation: M::Modes<Vector3<T>>,
    /// `Psi`, small rotation per modal coordinate, rad/(m sqrt(kg)).
    pub rotation: M::Modes<Vector3<T>>,
}

/// A point on which devices stand.
#[derive(Clone, Debug)]
pub struct ModalMount<M: ModalStorage, T: Clone + Debug = f64> {
    /// The point and its shapes.
    pub point: ModalPoint<M, T>,
    /// What the model of the structure (its hub and its modes) already contains of the devices
    /// here, as a rigid body: it is subtracted. None if the model is of the structure without them.
    pub contained: Option<ContainedBody<T>>,
}

/// A rigid body that stands for a device in the model of a structure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContainedBody<T = f64> {
    /// Mass, kg.
    pub mass: T,
    /// Centre of mass from B, m.
    pub centre: Vector3<T>,
    /// Inertia about its centre of mass, kg m².
    pub inertia: Matrix3<T>,
}
