//! Evaluate and step every kind, one device and four: the library whose size, stack and
//! instructions `cargo xtask flight` measures.
//!
//! Each module has a set of devices and two functions over it, exported as
//! `precess_dgvscmg_4_accelerations` and `precess_dgvscmg_4_step`; three more steer four DGVSCMGs. They take Rust's types by
//! reference and return whether it succeeded; the result is written to the caller's memory.

#![no_std]
#![expect(
    improper_ctypes_definitions,
    reason = "called only from Rust; the name is what is exported, so that the gates find it"
)]

use precess_dynamics::{
    Accelerations, BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg,
    BalancedVscmg, Dgcmg, Dgvscmg, FlexibleReactionWheel, FlexibleVscmg, HingedPanel, Inputs,
    ReactionWheel, Sgcmg, SloshMass, Spacecraft, State, Vscmg,
};

/// What [`Spacecraft::accelerations`] is called through.
pub type Evaluate<D> =
    extern "C" fn(&Spacecraft<D>, &State<D>, &Inputs<D>, &mut Accelerations<D>) -> bool;

/// What [`Spacecraft::step`] is called through; the step in seconds.
pub type Step<D> = extern "C" fn(&Spacecraft<D>, &mut State<D>, &Inputs<D>, f64) -> bool;

macro_rules! exports {
    ($($module:ident $kind:ident $devices:literal;)*) => {$(
        #[doc = concat!("So many of the kind: ", stringify!($kind), ", ", $devices, ".")]
        pub mod $module {
            use super::{Accelerations, Inputs, $kind, Spacecraft, State};

            /// The devices.
            pub type Set = [$kind; $devices];

            /// All accelerations; whether they could be found.
            // SAFETY: no other symbol has the name.
            #[unsafe(export_name = concat!("precess_", stringify!($module), "_accelerations"))]
            pub extern "C" fn accelerations(
                craft: &Spacecraft<Set>,
                state: &State<Set>,
                inputs: &Inputs<Set>,
                found: &mut Accelerations<Set>,
            ) -> bool {
                craft.accelerations(state, inputs).map(|all| *found = all).is_ok()
            }

            /// The state after a step of `dt` seconds; whether it could be found.
            // SAFETY: no other symbol has the name.
            #[unsafe(export_name = concat!("precess_", stringify!($module), "_step"))]
            pub extern "C" fn step(
                craft: &Spacecraft<Set>,
                state: &mut State<Set>,
                inputs: &Inputs<Set>,
                dt: f64,
            ) -> bool {
                craft.step(state, inputs, dt).map(|next| *state = next).is_ok()
            }
        }
    )*};
}

exports! {
    dgvscmg_1 Dgvscmg 1;
    dgvscmg_4 Dgvscmg 4;
    balanced_dgvscmg_1 BalancedDgvscmg 1;
    balanced_dgvscmg_4 BalancedDgvscmg 4;
    dgcmg_1 Dgcmg 1;
    dgcmg_4 Dgcmg 4;
    balanced_dgcmg_1 BalancedDgcmg 1;
    balanced_dgcmg_4 BalancedDgcmg 4;
    vscmg_1 Vscmg 1;
    vscmg_4 Vscmg 4;
    balanced_vscmg_1 BalancedVscmg 1;
    balanced_vscmg_4 BalancedVscmg 4;
    sgcmg_1 Sgcmg 1;
    sgcmg_4 Sgcmg 4;
    balanced_sgcmg_1 BalancedSgcmg 1;
    balanced_sgcmg_4 BalancedSgcmg 4;
    reaction_wheel_1 ReactionWheel 1;
    reaction_wheel_4 ReactionWheel 4;
    balanced_reaction_wheel_1 BalancedReactionWheel 1;
    balanced_reaction_wheel_4 BalancedReactionWheel 4;
    hinged_panel_1 HingedPanel 1;
    hinged_panel_4 HingedPanel 4;
    slosh_mass_1 SloshMass 1;
    slosh_mass_4 SloshMass 4;
    flexible_reaction_wheel_1 FlexibleReactionWheel 1;
    flexible_reaction_wheel_4 FlexibleReactionWheel 4;
    flexible_vscmg_1 FlexibleVscmg 1;
    flexible_vscmg_4 FlexibleVscmg 4;
}

/// What steers four DGVSCMGs.
pub mod steering {
    use super::{Inputs, Spacecraft, State};
    use nalgebra::Vector3;
    use precess_dynamics::{
        Allocation, Dgvscmg, Servo, SteeringLaw, SteeringMatrix, SteeringTerms,
    };

    /// The devices.
    pub type Set = [Dgvscmg; 4];

    /// Their joints.
    pub const JOINTS: usize = 12;

    /// What rates and accelerations require about B; whether it could be found.
    // SAFETY: no other symbol has the name.
    #[unsafe(export_name = "precess_dgvscmg_4_steering_terms")]
    pub extern "C" fn terms(
        craft: &Spacecraft<Set>,
        state: &State<Set>,
        found: &mut SteeringTerms<f64, JOINTS>,
    ) -> bool {
        craft.steering_terms(state).map(|terms| *found = terms).is_ok()
    }

    /// Commands for a torque; whether they could be found.
    // SAFETY: no other symbol has the name.
    #[unsafe(export_name = "precess_dgvscmg_4_allocate")]
    pub extern "C" fn allocate(
        law: &SteeringLaw<f64, JOINTS>,
        matrix: &SteeringMatrix<f64, JOINTS>,
        torque: &Vector3<f64>,
        found: &mut Allocation<f64, JOINTS>,
    ) -> bool {
        law.allocate(matrix, torque).map(|commands| *found = commands).is_ok()
    }

    /// Motor torques for commands, their derivatives zero; whether they could be found.
    // SAFETY: no other symbol has the name.
    #[unsafe(export_name = "precess_dgvscmg_4_servo")]
    pub extern "C" fn servo(
        craft: &Spacecraft<Set>,
        servo: &Servo<f64, JOINTS>,
        state: &State<Set>,
        inputs: &Inputs<Set>,
        commands: &[f64; JOINTS],
        found: &mut [f64; JOINTS],
    ) -> bool {
        let torques = craft.servo(servo, state, inputs, commands, &[0.0; JOINTS]);
        torques.map(|torques| *found = torques.torques).is_ok()
    }
}

/// What a static library needs and cannot reach: the gate on panics shows that it is never linked.
#[cfg(feature = "standalone")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    loop {}
}
