//! A VSCMG with its rotor on flexible bearings: whirls and translation modes with the gimbal locked against the closed
//! form, and the stiff VSCMG as the bearings stiffen.
//!
//! Run with `--nocapture` to see the figures.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::flexible_vscmg::PerJoint;
use precess_dynamics::{FlexibleVscmg, HubMode, Inputs, Mode, Passive, State, Vscmg};

use super::flexible_wheel::{
    I_R, I_S, M, SPINS, STIFFNESS, error_of_modes, falls_as_one_over_the_stiffness, run,
};

/// Mass of the gimbal, kg.
const M_G: f64 = 3.0;

/// Springs and dampers of the slides (axial, radial) and of the tilts.
fn bearings([axial, radial, tilt]: [Passive; 3]) -> PerJoint<Passive> {
    PerJoint {
        gimbal: Passive::none(),
        axial_slide: axial,
        radial_slide_y: radial,
        radial_slide_z: radial,
        tilt_y: tilt,
        tilt_z: tilt,
        wheel: Passive::none(),
    }
}

/// A gimbal off its axis, with this rotor.
fn gyro(d: f64, inertia: Matrix3<f64>) -> Vscmg {
    Vscmg {
        r_g_b: Vector3::new(0.4, -0.2, 0.3),
        m_g: M_G,
        r_gc_g: Vector3::new(0.01, 0.02, -0.01),
        i_g_gc: Matrix3::new(0.05, 2e-3, -1e-3, 2e-3, 0.04, 1e-3, -1e-3, 1e-3, 0.06),
        l_g: Vector3::new(0.02, -0.03, 0.04),
        d,
        ..Vscmg::bare_wheel(M, inertia)
    }
}

/// The same with the rotor on bearings: springs and dampers of the slides (axial, radial) and of the tilts.
fn on_bearings(stiff: &Vscmg, springs: [Passive; 3]) -> FlexibleVscmg {
    let passive = bearings(springs);
    let Vscmg { r_g_b, m_g, r_gc_g, i_g_gc, l_g, m_w, d, i_w_wc, .. } = *stiff;
    let bare = FlexibleVscmg::bare_wheel(m_w, i_w_wc);
    FlexibleVscmg { r_g_b, m_g, r_gc_g, i_g_gc, l_g, d, passive, ..bare }
}

/// Whatever the angle at which the gimbal is locked.
#[test]
fn whirls_and_translations_in_a_locked_gimbal_are_those_of_the_closed_form() {
    let round = Matrix3::from_diagonal(&Vector3::new(I_S, I_R, I_R));
    let springs = STIFFNESS.map(|k| Passive::spring(k, 0.0));
    let device = on_bearings(&gyro(0.0, round), springs);
    let mut inputs = Inputs::<FlexibleVscmg> { hub: HubMode::Fixed, ..Inputs::none() };
    inputs.modes.gimbal = Mode::Locked;
    let mut worst = 0.0_f64;
    for gamma in [0.0, 1.1, -2.0] {
        for spin in SPINS {
            let mut state: State<FlexibleVscmg> = State::at_rest();
            (state.devices.gamma, state.devices.theta, state.devices.spin) = (gamma, 0.7, spin);
            worst = worst.max(error_of_modes(&device, 1, &state, &inputs, spin));
        }
    }
    println!("worst {worst:.1e} of a frequency");
}

/// The motion of a free hub whose gimbal turns differs from that with stiff bearings as one over the stiffness.
#[test]
fn stiff_gyro_is_the_limit_as_one_over_the_stiffness() {
    let (rate, spin, omega) = (0.3, 8.0, Vector3::new(0.03, -0.05, 0.04));
    let inertia = Matrix3::new(I_S, 2e-4, -3e-4, 2e-4, I_R, 0.0, -3e-4, 0.0, I_R);
    let stiff = gyro(1e-3, inertia);
    let mut still: State<Vscmg> = State::at_rest();
    (still.omega, still.devices.gamma_dot, still.devices.spin) = (omega, rate, spin);
    let slow = run(&stiff, still).omega;
    // The gimbal's rate loads the tilts: stiffer springs until the first order is all.
    falls_as_one_over_the_stiffness(32.0, |[slide, tilt]| {
        let soft = on_bearings(&stiff, [slide, slide, tilt]);
        let mut state: State<FlexibleVscmg> = State::at_rest();
        (state.omega, state.devices.gamma_dot, state.devices.spin) = (omega, rate, spin);
        (run(&soft, state).omega - slow).norm()
    });
}
