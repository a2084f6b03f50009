//! Sets of sets in lanes: arrays and tuples. Each call goes on to the members, in order.

#![expect(clippy::inline_always, reason = "lanes reach wide instructions only in what is inlined")]

use std::vec::Vec;

use super::number::{Number, WIDEST};
use super::slot::{LanedSet, Visit};
use crate::equations::joint_inputs::JointInputs;
use crate::numbers::each::Value;
use crate::numbers::real::Real;
use crate::sets::devices::SetInputs;

impl<D: LanedSet, const N: usize> LanedSet for [D; N] {
    type Slots<T: Value> = Vec<D::Slots<T>>;

    fn slots<T: Real>(devices: &[D::Prepared; N], fill: T) -> Self::Slots<T> {
        devices.iter().map(|device| D::slots(device, fill)).collect()
    }

    #[inline(always)]
    fn each<T: Value>(
        devices: &[D::Prepared; N],
        slots: &mut Self::Slots<T>,
        visitor: &mut impl Visit<T>,
    ) {
        let mut slots = slots.iter_mut();
        for device in devices {
            let Some(slot) = slots.next() else { return };
            D::each(device, slot, visitor);
        }
    }

    #[inline(always)]
    fn load<T: Number>(
        devices: &[D::Prepared; N],
        slots: &mut Self::Slots<T>,
        like: T,
        joints: [&[D::Joints; N]; WIDEST],
    ) {
        let [a, b, c, d, e, f, g, h] = joints;
        let joints = a.iter().zip(b).zip(c).zip(d).zip(e).zip(f).zip(g).zip(h);
        for ((device, slot), (((((((a, b), c), d), e), f), g), h)) in
            devices.iter().zip(slots).zip(joints)
        {
            D::load(device, slot, like, [a, b, c, d, e, f, g, h]);
        }
    }

    #[inline(always)]
    fn put<T: Value>(
        devices: &[D::Prepared; N],
        slots: &mut Self::Slots<T>,
        lane: usize,
        joints: &[D::Joints; N],
        given: SetInputs<'_, Self>,
    ) -> bool {
        let given = given.motors.iter().zip(given.modes);
        devices.iter().zip(slots).zip(joints.iter().zip(given)).all(
            |((device, slot), (joints, (motors, modes)))| {
                D::put(device, slot, lane, joints, JointInputs { motors, modes, bodies: None })
            },
        )
    }

    #[inline(always)]
    fn take_joints<T: Value>(slots: &mut Self::Slots<T>, lane: usize, joints: &mut [D::Joints; N]) {
        let mut joints = joints.iter_mut();
        for slot in slots {
            let Some(joints) = joints.next() else { return };
            D::take_joints(slot, lane, joints);
        }
    }

    #[inline(always)]
    fn take_found<T: Value>(
        slots: &mut Self::Slots<T>,
        lane: usize,
        found: &mut [D::Accelerations; N],
    ) {
        let mut found = found.iter_mut();
        for slot in slots {
            let Some(found) = found.next() else { return };
            D::take_found(slot, lane, found);
        }
    }
}

macro_rules! tuples {
    ($(($($rest:ident $place:tt),*);)*) => {$(
        impl<A: LanedSet, $($rest: LanedSet),*> LanedSet for (A, $($rest,)*) {
            type Slots<T: Value> = (A::Slots<T>, $($rest::Slots<T>,)*);

            fn slots<T: Real>(devices: &Self::Prepared, fill: T) -> Self::Slots<T> {
                (A::slots(&devices.0, fill), $($rest::slots(&devices.$place, fill),)*)
            }

            #[inline(always)]
            fn each<T: Value>(
                devices: &Self::Prepared,
                slots: &mut Self::Slots<T>,
                visitor: &mut impl Visit<T>,
            ) {
                A::each(&devices.0, &mut slots.0, visitor);
                $($rest::each(&devices.$place, &mut slots.$place, visitor);)*
            }

            #[inline(always)]
            fn load<T: Number>(
                devices: &Self::Prepared,
                slots: &mut Self::Slots<T>,
                like: T,
                joints: [&Self::Joints; WIDEST],
            ) {
                A::load(&devices.0, &mut slots.0, like, joints.map(|joints| &joints.0));
                $($rest::load(
                    &devices.$place,
                    &mut slots.$place,
                    like,
                    joints.map(|joints| &joints.$place),
                );)*
            }

            #[inline(always)]
            fn put<T: Value>(
                devices: &Self::Prepared,
                slots: &mut Self::Slots<T>,
                lane: usize,
                joints: &Self::Joints,
                given: SetInputs<'_, Self>,
            ) -> bool {
                A::put(&devices.0, &mut slots.0, lane, &joints.0, JointInputs {
                    motors: &given.motors.0,
                    modes: &given.modes.0,
                    bodies: None,
                })
                $(&& $rest::put(
                    &devices.$place,
                    &mut slots.$place,
                    lane,
                    &joints.$place,
                    JointInputs {
                        motors: &given.motors.$place,
                        modes: &given.modes.$place,
                        bodies: None,
                    },
                ))*
            }

            #[inline(always)]
            fn take_joints<T: Value>(
                slots: &mut Self::Slots<T>,
                lane: usize,
                joints: &mut Self::Joints,
            ) {
                A::take_joints(&mut slots.0, lane, &mut joints.0);
                $($rest::take_joints(&mut slots.$place, lane, &mut joints.$place);)*
            }

            #[inline(always)]
            fn take_found<T: Value>(
                slots: &mut Self::Slots<T>,
                lane: usize,
                found: &mut Self::Accelerations,
            ) {
                A::take_found(&mut slots.0, lane, &mut found.0);
                $($rest::take_found(&mut slots.$place, lane, &mut found.$place);)*
            }
        }
    )*};
}

tuples! {
    ();
    (B 1);
    (B 1, C 2);
    (B 1, C 2, D 3);
    (B 1, C 2, D 3, E 4);
    (B 1, C 2, D 3, E 4, F 5);
    (B 1, C 2, D 3, E 4, F 5, G 6);
    (B 1, C 2, D 3, E 4, F 5, G 6, H 7);
}
