//! The functions that take structures, once for each version of the interface: those of version 1 under
//! the names of the header, those of version 2 with `_v2` behind them, which the header chooses by
//! `PRECESS_TABLE_VERSION`. A program keeps the version that it was compiled with.

use core::ffi::c_void;

use crate::contributions::{Gains, contributions_of, eliminate, joint_accelerations_of};
use crate::craft::{Craft, init};
use crate::error::Fault;
use crate::evaluate::{accelerations_of, energy, momentum_of, step, stop};
use crate::inputs::inputs_none;
use crate::loads::loads_of;
use crate::state::{state_at_rest, state_restore, state_save, state_wrap};
use crate::steering::{allocate, servo_torques_of, steering_terms_of};
use crate::table::{init_from_table, table_write};
use crate::types::{
    Accelerations, Allocation, Contributions, Hub, Inputs, Loads, Momentum, Power, Servo,
    ServoTorques, State, SteeringLaw, SteeringTerms,
};
use crate::version::EntryOf;

#[cfg(test)]
use crate::pointers::{Argument, Call};

macro_rules! versions {
    ($($of:ident $first:literal $second:literal ($($name:ident: $ty:ty),* $(,)?);)*) => {
        versions! { first 0 [$($of $first ($($name: $ty),*);)*] }
        versions! { second 1 [$($of $second ($($name: $ty),*);)*] }
    };
    ($module:ident $version:literal [$($of:ident $export:literal ($($name:ident: $ty:ty),*);)*]) => {
        mod $module {
            #[allow(clippy::wildcard_imports, reason = "the types of the list below")]
            use super::*;

            /// The joints that a device has at most.
            const J: usize = crate::VERSIONS[$version];

            $(
                /// See `precess.h`.
                ///
                /// # Safety
                ///
                /// That of the function of which this is one version.
                // SAFETY: no other symbol has the name.
                #[unsafe(export_name = $export)]
                unsafe extern "C" fn $of($($name: $ty),*) -> i32 {
                    // SAFETY: by contract.
                    unsafe { super::$of::<J>($($name),*) }
                }
            )*

            /// Each of them.
            #[cfg(test)]
            pub(super) fn calls() -> Vec<Call> {
                vec![$(Call {
                    name: $export,
                    call: |arguments| {
                        $(let $name: $ty = Argument::taken(arguments, stringify!($name));)*
                        // SAFETY: each pointer is to memory larger than its structure, or is what a
                        // function rejects.
                        unsafe { self::$of($($name),*) }
                    },
                }),*]
            }
        }
    };
}

versions! {
    init "precess_init" "precess_init_v2" (
        memory: *mut c_void,
        size: usize,
        hub: *const Hub,
        devices: *const EntryOf<J>,
        count: u32,
        fault: *mut Fault,
    );
    init_from_table "precess_init_from_table" "precess_init_from_table_v2" (
        memory: *mut c_void,
        size: usize,
        table: *const u8,
        length: usize,
        fault: *mut Fault,
    );
    table_write "precess_table_write" "precess_table_write_v2" (
        hub: *const Hub,
        devices: *const EntryOf<J>,
        count: u32,
        table: *mut u8,
        capacity: usize,
        length: *mut usize,
    );
    state_at_rest "precess_state_at_rest" "precess_state_at_rest_v2" (
        craft: *const Craft,
        state: *mut State<J>,
    );
    state_wrap "precess_state_wrap" "precess_state_wrap_v2" (
        craft: *const Craft,
        state: *mut State<J>,
    );
    state_save "precess_state_save" "precess_state_save_v2" (
        craft: *const Craft,
        state: *const State<J>,
        numbers: *mut f64,
        count: u32,
    );
    state_restore "precess_state_restore" "precess_state_restore_v2" (
        craft: *const Craft,
        numbers: *const f64,
        count: u32,
        state: *mut State<J>,
        fault: *mut Fault,
    );
    inputs_none "precess_inputs_none" "precess_inputs_none_v2" (
        craft: *const Craft,
        inputs: *mut Inputs<J>,
    );
    accelerations_of "precess_accelerations_of" "precess_accelerations_of_v2" (
        craft: *const Craft,
        state: *const State<J>,
        inputs: *const Inputs<J>,
        out: *mut Accelerations<J>,
        fault: *mut Fault,
    );
    step "precess_step" "precess_step_v2" (
        craft: *const Craft,
        state: *mut State<J>,
        inputs: *const Inputs<J>,
        dt: f64,
        substeps: u32,
        work: *mut Power,
        fault: *mut Fault,
    );
    stop "precess_stop" "precess_stop_v2" (
        craft: *const Craft,
        state: *mut State<J>,
        inputs: *const Inputs<J>,
        lost: *mut f64,
        fault: *mut Fault,
    );
    energy "precess_energy" "precess_energy_v2" (
        craft: *const Craft,
        state: *const State<J>,
        energy: *mut f64,
        fault: *mut Fault,
    );
    momentum_of "precess_momentum_of" "precess_momentum_of_v2" (
        craft: *const Craft,
        state: *const State<J>,
        about: i32,
        point: *const f64,
        out: *mut Momentum,
        fault: *mut Fault,
    );
    loads_of "precess_loads_of" "precess_loads_of_v2" (
        craft: *const Craft,
        state: *const State<J>,
        inputs: *const Inputs<J>,
        axes: i32,
        out: *mut Loads<J>,
        fault: *mut Fault,
    );
    contributions_of "precess_contributions_of" "precess_contributions_of_v2" (
        craft: *const Craft,
        state: *const State<J>,
        inputs: *const Inputs<J>,
        out: *mut Contributions,
        fault: *mut Fault,
    );
    eliminate "precess_eliminate" "precess_eliminate_v2" (
        craft: *const Craft,
        state: *const State<J>,
        inputs: *const Inputs<J>,
        out: *mut Contributions,
        gains: *mut Gains,
        fault: *mut Fault,
    );
    joint_accelerations_of "precess_joint_accelerations_of" "precess_joint_accelerations_of_v2" (
        craft: *const Craft,
        gains: *const Gains,
        linear: *const f64,
        angular: *const f64,
        out: *mut Accelerations<J>,
        fault: *mut Fault,
    );
    steering_terms_of "precess_steering_terms_of" "precess_steering_terms_of_v2" (
        craft: *const Craft,
        state: *const State<J>,
        out: *mut SteeringTerms<J>,
        fault: *mut Fault,
    );
    allocate "precess_allocate" "precess_allocate_v2" (
        craft: *const Craft,
        state: *const State<J>,
        law: *const SteeringLaw<J>,
        torque: *const f64,
        out: *mut Allocation<J>,
        fault: *mut Fault,
    );
    servo_torques_of "precess_servo_torques_of" "precess_servo_torques_of_v2" (
        craft: *const Craft,
        state: *const State<J>,
        inputs: *const Inputs<J>,
        servo: *const Servo<J>,
        out: *mut ServoTorques<J>,
        fault: *mut Fault,
    );
}

/// The functions of version 1.
#[cfg(test)]
pub(crate) fn first() -> Vec<Call> {
    first::calls()
}

/// The functions of version 2.
#[cfg(test)]
pub(crate) fn second() -> Vec<Call> {
    second::calls()
}
