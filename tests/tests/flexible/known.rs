//! Closed forms: a cantilever with a mass at its tip, a free structure.

use nalgebra::{Complex, DMatrix, DVector, Matrix3, Vector3};
use precess_dynamics::{
    About, Dgvscmg, Flexible, Hub, HubMode, Inputs, ListedModes, ModalMount, ModalPoint, Mode,
    Modes, Quaternion, SloshMass, SolveError, Spacecraft, State,
};
use precess_tests::bounds::LIMITS;
use precess_tests::random::Random;

use crate::craft::{SEED, Size, structure};

/// Length, m, mass, kg, and bending stiffness, N m², of the beam; mass at its tip, kg.
pub(crate) const BEAM: [f64; 3] = [2.0, 5.0, 40.0];
pub(crate) const TIP: f64 = 3.0;

/// A deformation, m sqrt(kg), whose square is nothing beside it.
const TINY: f64 = f64::EPSILON * f64::EPSILON;

/// A cantilever along x from B, flexible in z, a point mass at its tip.
pub(crate) struct Cantilever {
    craft: Spacecraft<SloshMass, Flexible<ListedModes>>,
    tip: ModalPoint<ListedModes>,
    frequencies: Vec<f64>,
    /// Compliance of the modes left out at the tip, if it is part of the model, m/N.
    residual: f64,
}

/// `beta L` of a clamped mode: the root of `cos x cosh x = -1`, as `cos x = -1 / cosh x` near
/// `(i - 1/2) pi`.
fn beta(mode: u32) -> f64 {
    let at = (f64::from(mode) + 0.5) * std::f64::consts::PI;
    let (mut low, mut high) = (at - 0.4, at + 0.4);
    let value = |x: f64| libm::cos(x) + 1.0 / libm::cosh(x);
    let sign = value(low).signum();
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if value(middle).signum() == sign { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

impl Cantilever {
    fn new(modes: u32) -> Self {
        Self::with_modes(modes, false)
    }

    /// With the residual compliance for a force across the tip, if requested: the static response
    /// `L³ / 3 EI`, and the slope `L² / 2 EI` there, less those of the modes.
    pub(crate) fn with_modes(modes: u32, with_residual: bool) -> Self {
        let [length, mass, stiffness] = BEAM;
        let betas: Vec<f64> = (0..modes).map(beta).collect();
        let signs = (0..modes).map(|mode| if mode % 2 == 0 { 1.0 } else { -1.0 });
        // (cosh x + cos x) / (sinh x + sin x), and shapes of unit mass over sqrt(mass).
        let sigma = |x: f64| (libm::cosh(x) + libm::cos(x)) / (libm::sinh(x) + libm::sin(x));
        let along_z = |value: f64| Vector3::new(0.0, 0.0, value);
        let tip: ModalPoint<ListedModes> = ModalPoint {
            position: Vector3::new(length, 0.0, 0.0),
            translation: signs.clone().map(|sign| along_z(2.0 * sign / mass.sqrt())).collect(),
            rotation: signs
                .zip(&betas)
                .map(|(sign, x)| {
                    Vector3::new(0.0, -2.0 * sign * x * sigma(*x) / (length * mass.sqrt()), 0.0)
                })
                .collect(),
        };
        let frequencies: Vec<f64> =
            betas.iter().map(|x| x * x * (stiffness / (mass * length.powi(3))).sqrt()).collect();
        let mut modes = Modes {
            frequencies: frequencies.clone(),
            damping: vec![0.0; betas.len()],
            linear: betas.iter().map(|x| along_z(2.0 * sigma(*x) / x * mass.sqrt())).collect(),
            // r x phi: x times phi_z, about -y.
            angular: betas
                .iter()
                .map(|x| Vector3::new(0.0, -2.0 / (x * x) * length * mass.sqrt(), 0.0))
                .collect(),
            mounts: vec![ModalMount { point: tip.clone(), contained: None }],
        };
        // The beam as a rigid body about B, and a base of some mass that is held.
        let hub = Hub {
            m_b: 10.0 + mass,
            r_bc_b: Vector3::new(mass * length / 2.0 / (10.0 + mass), 0.0, 0.0),
            i_b_bc: Matrix3::from_diagonal_element(mass * length * length),
        };
        let device =
            SloshMass { r_s_b: Vector3::new(length, 0.0, 0.0), ..SloshMass::bare_slosh_mass(TIP) };
        let (mut residual, mut count) = (0.0, 0);
        if with_residual {
            let shapes = tip.translation.iter().zip(&tip.rotation).zip(&frequencies);
            let known = shapes.fold([0.0, 0.0], |[of, slope], ((phi, psi), w)| {
                [of + phi.z * phi.z / (w * w), slope + phi.z * psi.y / (w * w)]
            });
            residual = length.powi(3) / (3.0 * stiffness) - known[0];
            // Uphill along x is about -y.
            let slope = -length * length / (2.0 * stiffness) - known[1];
            let mut compliance = [0.0; 36];
            // A force across, and what its own rotation does to it: the point mass bears no moment.
            (compliance[14], compliance[16], compliance[26]) = (residual, slope, slope);
            compliance[28] = slope * slope / residual;
            count = modes.add_residual(&mut [], &compliance).expect("valid");
            assert_eq!(count, 1);
        }
        let craft = Spacecraft::flexible_with_residual(&hub, &modes, count, &device, &0);
        let tip = modes.mounts[0].point.clone();
        let frequencies = modes.frequencies;
        Self { craft: craft.expect("valid"), tip, frequencies, residual }
    }

    /// Acceleration of the modes for coordinates and a force at the tip, the mass held.
    fn acceleration(&self, eta: Vec<f64>, force: f64, hub: HubMode) -> DVector<f64> {
        let mut state = State::at_rest_for(&self.craft);
        state.modal.eta = eta;
        let mut inputs = Inputs::none_for(&self.craft);
        inputs.hub = hub;
        for mode in precess_dynamics::Each::values_mut(&mut inputs.modes) {
            *mode = Mode::Locked;
        }
        inputs.modal.mounts[0].force.z = force;
        let state: State<SloshMass, Quaternion, Flexible<ListedModes>> = state;
        DVector::from_vec(
            self.craft.accelerations(&state, &inputs).expect("a solution").modal.eta_ddot,
        )
    }

    /// `-M^-1 K` of the modes, from the solver's accelerations, which are linear for deformations
    /// that are tiny.
    fn matrix(&self, hub: HubMode) -> DMatrix<f64> {
        let count = self.frequencies.len();
        let mut matrix = DMatrix::zeros(count, count);
        for mode in 0..count {
            let mut eta = vec![0.0; count];
            eta[mode] = TINY;
            matrix.set_column(mode, &(self.acceleration(eta, 0.0, hub) / TINY));
        }
        matrix
    }

    /// Displacement of the tip over a harmonic force there, m/N.
    pub(crate) fn receptance(&self, omega: f64) -> f64 {
        let count = self.frequencies.len();
        let matrix = self.matrix(HubMode::Fixed);
        let by_force = self.acceleration(vec![0.0; count], TINY, HubMode::Fixed) / TINY;
        let phi = DVector::from_iterator(count, self.tip.translation.iter().map(|v| v.z));
        // eta'' = A eta + b F and eta'' = -omega² eta.
        let dynamic = -matrix - DMatrix::identity(count, count) * omega * omega;
        phi.dot(&dynamic.lu().solve(&by_force).expect("off resonance"))
    }

    /// The same by the truncated sum of the beam's own modes, and the mass at its tip.
    pub(crate) fn modal_sum(&self, omega: f64) -> f64 {
        let terms = self.tip.translation.iter().zip(&self.frequencies).take(self.craft.massive());
        let own: f64 = terms.map(|(phi, w)| phi.z * phi.z / (w * w - omega * omega)).sum();
        let bare = self.residual + own;
        bare / (1.0 - omega * omega * TIP * bare)
    }
}

/// The tip of a uniform cantilever, exactly: `L³ / (EI x³) (sin x cosh x - cos x sinh x) /
/// (1 + cos x cosh x)`, and the mass at its tip.
pub(crate) fn analytic(omega: f64) -> f64 {
    let [length, mass, stiffness] = BEAM;
    let x = (omega * omega * mass * length.powi(3) / stiffness).sqrt().sqrt();
    let (sin, cos, sinh, cosh) = (libm::sin(x), libm::cos(x), libm::sinh(x), libm::cosh(x));
    let bare =
        length.powi(3) / (stiffness * x.powi(3)) * (sin * cosh - cos * sinh) / (1.0 + cos * cosh);
    bare / (1.0 - omega * omega * TIP * bare)
}

#[test]
fn cantilever_with_a_mass_at_its_tip_is_the_truncated_modal_sum() {
    for modes in [1, 3, 8, 24] {
        let cantilever = Cantilever::new(modes);
        for omega in [0.3, 2.0, 9.0, 31.0] {
            let (found, expected) = (cantilever.receptance(omega), cantilever.modal_sum(omega));
            let error = (found / expected - 1.0).abs();
            assert!(error <= LIMITS, "{modes} modes at {omega} rad/s: {error:e}");
        }
    }
}

/// Mode n adds `4 / (m w_n²)`, and `w_n` grows as n²: the rest of the sum falls as n⁻³.
#[test]
fn truncated_cantilever_converges_to_the_beam_with_the_third_power_of_the_modes() {
    let error = |modes| {
        let found = Cantilever::new(modes).receptance(2.0);
        (found / analytic(2.0) - 1.0).abs()
    };
    for modes in [5, 10] {
        let ratio = error(modes) / error(2 * modes);
        assert!((7.0..9.0).contains(&ratio), "{modes} modes: {ratio}");
    }
}

/// The bound of a step is the limit of the method at the fastest vibration: the mass at the tip makes
/// it slower than the beam's fastest mode, a base that is free faster than one that is held.
#[test]
fn longest_step_is_that_of_the_fastest_vibration() {
    let cantilever = Cantilever::new(4);
    let longest = |hub| {
        let mut inputs = Inputs::none_for(&cantilever.craft);
        inputs.hub = hub;
        let state: State<SloshMass, Quaternion, Flexible<ListedModes>> =
            State::at_rest_for(&cantilever.craft);
        match cantilever.craft.step(&state, &inputs, 1e3) {
            Err(SolveError::UnstableModes { dt: 1e3, longest }) => longest,
            found => panic!("{found:?}"),
        }
    };
    let fastest = cantilever.frequencies[3];
    let limit = 8.0_f64.sqrt();
    let (free, held) = (limit / longest(HubMode::Free), limit / longest(HubMode::Fixed));
    // The mass slides along x, across the bending: its joint does not matter.
    for (found, hub) in [(free, HubMode::Free), (held, HubMode::Fixed)] {
        let squares = (-cantilever.matrix(hub)).complex_eigenvalues();
        let expected = squares.iter().map(|square| square.re).fold(0.0, f64::max).sqrt();
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} {expected}");
    }
    assert!(held < free && held < fastest, "{held} {free} {fastest}");

    // Just below, vibration on a free base stays; its energy is what damping leaves.
    let mut state: State<SloshMass, Quaternion, Flexible<ListedModes>> =
        State::at_rest_for(&cantilever.craft);
    state.modal.eta.fill(1e-6);
    let inputs = Inputs::none_for(&cantilever.craft);
    let dt = 0.999 * longest(HubMode::Free);
    for _ in 0..3000 {
        state = cantilever.craft.step(&state, &inputs, dt).unwrap();
    }
    assert!(state.modal.eta.iter().all(|eta| eta.abs() < 1e-5), "{:?}", state.modal.eta);
}

/// Shapes that are orthogonal to the rigid motions have no momentum integrals.
#[test]
fn modes_of_a_free_structure_carry_no_momentum() {
    let random = &mut Random::new(SEED + 500);
    let size = Size { modes: 12, contained: false, rotation: 0.1, free: true };
    let (hub, modes) = structure(random, size, &[1.0]);
    let craft = Spacecraft::flexible(&hub, &modes, &[] as &[Dgvscmg; 0], &[]).expect("valid");
    let mut state: State<[Dgvscmg; 0], Quaternion, Flexible<ListedModes>> =
        State::at_rest_for(&craft);
    for (eta, rate) in state.modal.eta.iter_mut().zip(&mut state.modal.eta_dot) {
        (*eta, *rate) = (random.within(-1.0, 1.0), random.within(-5.0, 5.0));
    }
    // Integrals of shapes of some 0.1/sqrt(kg) over 400 kg are rounding of 40 sqrt(kg).
    let momentum = craft.momentum(&state, About::CentreOfMass).unwrap();
    let (linear, angular) = (momentum.linear.norm(), momentum.angular.norm());
    assert!(linear <= 1e-12 && angular <= 1e-12, "{linear:e} {angular:e}");
    let found = craft.accelerations(&state, &Inputs::none_for(&craft)).unwrap();
    let hub = found.r_b_n_ddot.norm() + found.omega_dot.norm();
    let largest = found.modal.eta_ddot.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    assert!(hub <= 1e-14 * largest, "{hub:e} of {largest:e}");
    for (k, acceleration) in found.modal.eta_ddot.iter().enumerate() {
        let (w, zeta) = (modes.frequencies[k], modes.damping[k]);
        let own = -w * w * state.modal.eta[k] - 2.0 * zeta * w * state.modal.eta_dot[k];
        assert!((acceleration - own).abs() <= 1e-13 * largest);
    }
    // And it oscillates as exp(lambda t), to the fifth power of the step.
    let next = craft.step(&state, &Inputs::none_for(&craft), 1e-4).unwrap();
    for k in 0..12 {
        let (w, zeta) = (modes.frequencies[k], modes.damping[k]);
        let root = Complex::new(-zeta * w, w * (1.0 - zeta * zeta).sqrt());
        let (eta, rate) = (state.modal.eta[k], state.modal.eta_dot[k]);
        let b = Complex::new(0.5 * eta, 0.0)
            + Complex::new(0.0, -0.5) * Complex::new((rate + zeta * w * eta) / root.im, 0.0);
        let over = root * 1e-4;
        let turn = Complex::new(libm::cos(over.im), libm::sin(over.im)) * libm::exp(over.re);
        let expected = 2.0 * (b * turn).re;
        assert!((next.modal.eta[k] - expected).abs() < 1e-11, "{} {expected}", next.modal.eta[k]);
    }
    let too_long = craft.step(&state, &Inputs::none_for(&craft), 1.0);
    assert!(matches!(too_long, Err(SolveError::UnstableModes { .. })));
}
