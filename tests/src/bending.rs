//! Structures that bend, with a wheel on each of four mounts: what is timed and counted.

use nalgebra::Vector3;
use precess_dynamics::{
    FlexibleInputs, FlexibleSpacecraft, FlexibleState, ListedModes, ModalMount, ModalPoint,
    ModalStorage as _, Modes, ReactionWheel,
};

use crate::measured::{Measured, hub};

/// How many wheels, and mounts.
pub const WHEELS: usize = 4;

/// Where the mounts are, m.
const PLACES: [[f64; 3]; WHEELS] =
    [[0.5, 0.1, 0.2], [-0.4, 0.3, -0.1], [0.2, -0.5, 0.3], [-0.1, -0.2, -0.4]];

/// A spacecraft with its state and inputs.
#[derive(Debug)]
pub struct Bending {
    /// The spacecraft.
    pub craft: FlexibleSpacecraft<[ReactionWheel; WHEELS], ListedModes>,
    /// Its state.
    pub state: FlexibleState<[ReactionWheel; WHEELS], ListedModes>,
    /// What acts on it.
    pub inputs: FlexibleInputs<[ReactionWheel; WHEELS], ListedModes>,
}

impl Bending {
    /// The hub of [`Measured`] with so many modes, in motion.
    ///
    /// # Panics
    /// If the solver rejects it.
    #[must_use]
    pub fn new(modes: usize) -> Self {
        let inertia = nalgebra::Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01));
        let wheels = PLACES.map(|place| ReactionWheel {
            r_w_b: place.into(),
            d: 1e-4,
            ..ReactionWheel::bare_wheel(4.0, inertia)
        });
        let rigid = Measured::new(&wheels);
        let modes = structure(modes, &PLACES.map(Vector3::from));
        let craft = FlexibleSpacecraft::new(&hub(), &modes, &wheels, &[0, 1, 2, 3])
            .unwrap_or_else(|error| panic!("{error}"));
        let mut state = FlexibleState::at_rest(&craft);
        state.rigid = rigid.state;
        swing(&mut state.eta);
        let mut inputs = FlexibleInputs::none_for(&craft);
        inputs.rigid = rigid.inputs;
        Self { craft, state, inputs }
    }
}

/// Displaces modes by up to a thousandth.
pub fn swing(eta: &mut [f64]) {
    for (k, eta) in (0_u16..).zip(eta) {
        *eta = 1e-3 * f64::from(k).sin();
    }
}

/// Modes from 20 rad/s on, one every 10, with momentum, and shapes of some hundredths at the mounts.
#[must_use]
pub fn structure(modes: usize, places: &[Vector3<f64>; WHEELS]) -> Modes<ListedModes> {
    // Phases that grow with the square of the number: no shape depends on a few others.
    let wave = |scale: f64, at: f64| {
        let numbers = (0_u16..).map(f64::from).take(modes);
        let shape = numbers.map(|k| {
            let phase = 1.3 * k * k + (at + 1.0) * k;
            let [x, z] = [phase, 1.9 * phase].map(f64::sin);
            Vector3::new(x, (0.7 * phase + at).cos(), z) * scale
        });
        shape.collect::<Vec<_>>()
    };
    let mount = |(at, position): (f64, &Vector3<f64>)| ModalMount {
        point: ModalPoint {
            position: *position,
            translation: wave(0.02, at),
            rotation: wave(0.02, at + 0.5),
        },
        contained: None,
    };
    Modes {
        frequencies: (0_u16..).map(|k| 20.0 + 10.0 * f64::from(k)).take(modes).collect(),
        damping: ListedModes::modes(modes, &0.005),
        linear: wave(0.5, 7.0),
        angular: wave(0.5, 8.0),
        mounts: [0.0, 1.0, 2.0, 3.0].into_iter().zip(places).map(mount).collect(),
    }
}
