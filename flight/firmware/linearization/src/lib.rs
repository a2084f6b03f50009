//! The matrices A and B of one and four DGVSCMGs: the library whose size, stack and instructions `cargo xtask flight`
//! measures apart from that which evaluates and steps.
//!
//! Exported as `precess_dgvscmg_4_linearize`. It takes Rust's types by reference and returns whether it succeeded; the
//! matrices are written to the caller's memory, column by column. Called only from Rust: the name is what is exported, so that
//! the gates find it.

#![no_std]

use precess_dynamics::{Accelerations, Dgvscmg, Inputs, LinearizationWorkspace, Spacecraft, State};

macro_rules! exports {
    ($($module:ident $devices:literal $joints:literal $states:literal $inputs:literal;)*) => {$(
        #[doc = concat!("So many DGVSCMGs: ", $devices, ".")]
        pub mod $module {
            use super::{Accelerations, Dgvscmg, Inputs, LinearizationWorkspace, Spacecraft, State};

            /// The devices.
            pub type Set = [Dgvscmg; $devices];

            /// What is written besides the matrices.
            pub type Workspace = LinearizationWorkspace<f64, $joints>;

            /// Derivatives by the states.
            pub type A = [f64; $states * $states];

            /// Derivatives by the inputs.
            pub type B = [f64; $states * $inputs];

            /// Both matrices and the accelerations; whether they could be found.
            // SAFETY: no other symbol has the name.
            #[unsafe(export_name = concat!("precess_", stringify!($module), "_linearize"))]
            pub extern "C" fn linearize(
                craft: &Spacecraft<Set>,
                state: &State<Set>,
                inputs: &Inputs<Set>,
                a: &mut A,
                b: &mut B,
                workspace: &mut Workspace,
                found: &mut Accelerations<Set>,
            ) -> bool {
                let linearized = craft.linearize_fixed(state, inputs, [a, b], workspace);
                linearized.map(|all| *found = all).is_ok()
            }
        }
    )*};
}

exports! {
    dgvscmg_1 1 3 18 9;
    dgvscmg_4 4 12 36 18;
}

/// What a static library needs and cannot reach: the gate on panics shows that it is never linked.
#[cfg(feature = "standalone")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
