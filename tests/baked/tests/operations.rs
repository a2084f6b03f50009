//! Operations of the hub's equations as the emitted crates solve them, counted: the numbers that the
//! generator adds to those of the kernels.

use precess_tests::counted::{Counted, Operations, count};

#[allow(
    clippy::all,
    clippy::pedantic,
    dead_code,
    unreachable_pub,
    reason = "emitted for a crate of its own, of which not all is read"
)]
#[path = "../four_wheels/src/kernels/hub.rs"]
#[rustfmt::skip]
mod hub;
#[allow(
    clippy::all,
    clippy::pedantic,
    dead_code,
    unreachable_pub,
    reason = "emitted for a crate of its own, of which not all is read"
)]
#[path = "../four_wheels/src/kernels/real.rs"]
mod real;
mod kernels {
    pub(crate) use super::{hub, real};
}
#[allow(clippy::pedantic, dead_code, reason = "only a body of numbers that count is solved for")]
#[path = "../../../codegen/bake/src/by_hand/rigid.rs"]
mod rigid;
#[allow(clippy::pedantic, reason = "written for a crate of its own")]
#[path = "../../../codegen/bake/src/by_hand/solve.rs"]
mod solve;

use hub::{BodyRate, HubShare};
use real::Real;
use rigid::RigidBody;
use solve::Assembly;

impl Real for Counted {
    fn recip(self) -> Self {
        precess_dynamics::Real::recip(self)
    }

    fn like(self, value: f64) -> Self {
        precess_dynamics::Real::like(self, value)
    }
}

fn number(value: f64) -> Counted {
    precess_dynamics::Scalar::from_f64(value)
}

/// A hub of 1 kg and 1 kg m2 about its centre of mass, which is B.
fn hub() -> RigidBody<Counted> {
    let (zero, one) = (number(0.0), number(1.0));
    let inertia = [one, zero, zero, one, zero, one];
    RigidBody { mass: one, first_moment: [zero; 3], inertia }
}

/// A device without mass: every number of its share is zero.
#[rustfmt::skip]
fn nothing() -> HubShare<Counted> {
    let z = number(0.0);
    HubShare {
        mr_moving_bx: z, mr_moving_by: z, mr_moving_bz: z,
        i_moving_11: z, i_moving_12: z, i_moving_13: z,
        i_moving_22: z, i_moving_23: z, i_moving_33: z,
        m_vv_11: z, m_vv_12: z, m_vv_13: z, m_vv_22: z, m_vv_23: z, m_vv_33: z,
        m_vw_11: z, m_vw_12: z, m_vw_13: z,
        m_vw_21: z, m_vw_22: z, m_vw_23: z,
        m_vw_31: z, m_vw_32: z, m_vw_33: z,
        m_ww_11: z, m_ww_12: z, m_ww_13: z, m_ww_22: z, m_ww_23: z, m_ww_33: z,
        h_v_1: z, h_v_2: z, h_v_3: z, h_w_1: z, h_w_2: z, h_w_3: z,
    }
}

/// An evaluation with as many devices.
fn evaluation(devices: usize) -> Operations {
    let (body, nothing, zero) = (hub(), nothing(), number(0.0));
    let omega = BodyRate { omega_bx: zero, omega_by: zero, omega_bz: zero };
    let (found, operations) = count(|| {
        let mut assembly = Assembly::new(&body, [zero; 3], [zero; 3]);
        for _ in 0..devices {
            assembly.add(&nothing);
        }
        assembly.solve(&omega)
    });
    assert!(found.is_some(), "a hub with mass and inertia has accelerations");
    // What a constant is made of costs nothing.
    assert_eq!(count(|| zero.like(1.0)).1, Operations::default());
    operations
}

#[test]
fn the_hub_and_each_device_take_what_the_generator_adds() {
    let [hub, one, two] = [0, 1, 2].map(|devices| evaluation(devices).arithmetic());
    println!("{hub} operations of the hub, {} of each device", one - hub);
    assert_eq!(hub, precess_bake::HUB_OPERATIONS as u64, "record what is true");
    assert_eq!(one - hub, precess_bake::SUM_OPERATIONS as u64, "record what is true");
    assert_eq!(two - one, one - hub);
}
