//! Balanced wheels have a closed form: (18) for the translation, Euler's equation with the wheels'
//! spin for the rotation.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::BalancedReactionWheel;
use precess_point_masses::Rigid;

use super::case::{Joint, LIMITS, SEEDS, Solution, World, joints};
use super::devices::Drawn;
use super::random::{Random, errors_of};

/// The accelerations of balanced wheels fixed in a hub:
///
/// ```text
/// r_b_n_ddot = F / m - omega' x c - omega x (omega x c)
/// (I - sum J s s^T) omega' = L_c - omega x (I omega + sum J spin s) - sum u s,   I, L_c about C
/// spin' = u / J - s . omega'
/// ```
fn closed_form(world: &World, wheels: &[BalancedReactionWheel; 3], settings: &[Joint]) -> Solution {
    let whole = wheels.iter().map(|wheel| {
        let moments = Vector3::new(wheel.j_11, wheel.j_22, wheel.j_22);
        let inertia = Matrix3::from_diagonal(&moments);
        let disc = Rigid { mass: wheel.m_w, centre: Vector3::zeros(), inertia };
        disc.moved(&wheel.r_w_b, &wheel.mount)
    });
    let whole: Vec<_> = std::iter::once(Rigid::of_hub(&world.hub)).chain(whole).collect();
    let Rigid { mass, centre: c, mut inertia } = Rigid::merged(&whole);
    let (omega, force) = (world.omega, world.force);
    let (mut spinning, mut motors) = (Vector3::zeros(), Vector3::zeros());
    let whole = inertia;
    for (wheel, joint) in wheels.iter().zip(settings) {
        let s = wheel.mount.column(0).into_owned();
        spinning += s * (wheel.j_11 * joint.state[1]);
        motors += s * joint.torque;
        inertia -= s * s.transpose() * wheel.j_11;
    }
    let torque = world.torque_b - c.cross(&force);
    let gyroscopic = omega.cross(&(whole * omega + spinning));
    let omega_dot = inertia.try_inverse().expect("positive") * (torque - gyroscopic - motors);
    let spin_dot = wheels.iter().zip(settings).map(|(wheel, joint)| {
        let s = wheel.mount.column(0).into_owned();
        ("theta", joint.torque / wheel.j_11 - s.dot(&omega_dot))
    });
    let r_b_n_ddot = force / mass - omega_dot.cross(&c) - omega.cross(&omega.cross(&c));
    Solution { r_b_n_ddot, omega_dot, joints: spin_dot.collect() }
}

#[test]
fn balanced_wheels_obey_18_and_eulers_equation() {
    let error = |random: &mut Random| {
        let world = World::drawn(random);
        let wheels = [(); 3].map(|()| BalancedReactionWheel::drawn(random, world.hub.m_b));
        let settings = wheels.map(|_| joints::<BalancedReactionWheel>(random)).concat();
        world.case(&wheels, &settings).solved().error(&closed_form(&world, &wheels, &settings))
    };
    errors_of(SEEDS, error).are_within(LIMITS);
}
