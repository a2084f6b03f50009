//! A pivot that is only rounding is rejected, also where other masses or inertias are large.

use nalgebra::{Matrix3, Rotation3, Vector3};
use precess_dynamics::kind::Kind;
use precess_dynamics::{
    BuiltIn, Dgcmg, Dgvscmg, Hub, Inputs, ReactionWheel, SloshMass, SolveError, State,
};
use precess_tests::random::{Random, SEED};

use super::services::{OneDevice, outcomes};

/// Poses tried of each spacecraft.
const POSES: u64 = 60;

/// A hub without products of inertia, its centre of mass at B.
fn hub(moments: [f64; 3]) -> Hub {
    let i_b_bc = Matrix3::from_diagonal(&Vector3::from(moments));
    Hub { m_b: 10.0, r_bc_b: Vector3::zeros(), i_b_bc }
}

fn disc() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1))
}

fn skew(random: &mut Random) -> Matrix3<f64> {
    let mut angle = || random.within(-3.0, 3.0);
    *Rotation3::from_euler_angles(angle(), angle(), angle()).matrix()
}

fn rejected<K: Kind<Scalar = f64> + Into<BuiltIn>>(case: &OneDevice<K>, device: Option<usize>) {
    for (service, outcome) in outcomes(case) {
        match outcome {
            Err(SolveError::Singular { device: found, .. }) if found == device => {}
            outcome => panic!("{service}: {outcome:?} for {:?}", case.device),
        }
    }
}

fn gimballed(inertia: f64, random: &mut Random) -> OneDevice<Dgvscmg> {
    let device = Dgvscmg { mount: skew(random), ..Dgvscmg::bare_wheel(4.0, disc()) };
    let mut state = State::<[Dgvscmg; 1]>::at_rest();
    state.devices[0].gamma_o = random.within(-3.0, 3.0);
    state.devices[0].gamma_i = random.within(-1.0, 1.0);
    state.devices[0].spin = 100.0;
    let mut inputs = Inputs::<[Dgvscmg; 1]>::none();
    inputs.motors[0].u_w = 0.1;
    OneDevice { hub: hub([inertia; 3]), device, state, inputs }
}

#[test]
fn hub_without_inertia_is_rejected_beside_what_the_devices_took_out() {
    for number in 0..POSES {
        let random = &mut Random::new(SEED + number);
        for inertia in [0.0, 1e-17, 1e-16] {
            rejected(&gimballed(inertia, random), None);
        }
        let device =
            ReactionWheel { mount: skew(random), ..ReactionWheel::bare_wheel(4.0, disc()) };
        // Nothing but the wheel's axis is left without inertia: its transverse moments are the
        // hub's.
        let mut state = State::<[ReactionWheel; 1]>::at_rest();
        state.devices[0].spin = 100.0;
        rejected(&OneDevice { hub: hub([0.0; 3]), device, state, inputs: Inputs::none() }, None);
    }
}

/// More than rounding, so it is solved, as accurately as the conditioning allows.
#[test]
fn hub_with_little_inertia_is_answered() {
    for number in 0..POSES {
        let case = gimballed(1e-9, &mut Random::new(SEED + number));
        for (service, outcome) in outcomes(&case) {
            let omega_dot = outcome.unwrap_or_else(|error| panic!("{service}: {error}"));
            // 0.1 N m on 1e-9 kg m², along the spin axis, whatever the massless gimbals transmit.
            let size = Vector3::from(omega_dot).norm();
            assert!((0.9e8..1.2e10).contains(&size), "{service}: {size}");
        }
    }
}

/// A rod about its own axis: base parameters hand the hub a moment that the moving part takes back.
#[test]
fn moment_that_the_moving_share_cancels_is_rejected() {
    let rod = Matrix3::from_diagonal(&Vector3::new(1.0, 0.0, 1.0));
    let device = ReactionWheel::bare_wheel(4.0, rod);
    let state = State::<[ReactionWheel; 1]>::at_rest();
    rejected(&OneDevice { hub: hub([1.0, 0.0, 1.0]), device, state, inputs: Inputs::none() }, None);
}

#[test]
fn hub_whose_mass_is_nothing_beside_what_slides_is_rejected() {
    let device = SloshMass::bare_slosh_mass(4.0);
    let light = Hub { m_b: 1e-16, ..hub([1.0; 3]) };
    let state = State::<[SloshMass; 1]>::at_rest();
    rejected(&OneDevice { hub: light, device, state, inputs: Inputs::none() }, None);
}

/// A point mass that the inner gimbal has brought onto the outer gimbal's axis.
#[test]
fn joint_whose_own_diagonal_is_rounding_is_rejected() {
    for number in 0..POSES {
        let angle = Random::new(SEED + number).within(-1.5, 1.5);
        let device = Dgcmg {
            l_o: Vector3::new(angle.cos(), 0.0, 0.0),
            l_i: Vector3::new(-1.0, 0.0, 0.0),
            ..Dgcmg::bare_wheel(2.0, Matrix3::zeros())
        };
        let mut state = State::<[Dgcmg; 1]>::at_rest();
        state.devices[0].gamma_i = angle;
        rejected(&OneDevice { hub: hub([1.0; 3]), device, state, inputs: Inputs::none() }, Some(0));
        // A tenth of a radian on, it has a lever arm.
        state.devices[0].gamma_i = angle + 0.1;
        let case = OneDevice { hub: hub([1.0; 3]), device, state, inputs: Inputs::none() };
        assert!(outcomes(&case).iter().all(|(_, outcome)| outcome.is_ok()));
    }
}
