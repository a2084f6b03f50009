//! Flexible structures, with a wheel on each of four mounts: what is timed and counted.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    Flexible, Inputs, ListedModes, ModalMount, ModalPoint, ModalStorage as _, Modes, Quaternion,
    ReactionWheel, Scalar, Spacecraft, State,
};

use crate::measured::{Measured, hub};

/// How many wheels, and mounts.
pub const WHEELS: usize = 4;

/// Where the mounts are, m.
const PLACES: [[f64; 3]; WHEELS] =
    [[0.5, 0.1, 0.2], [-0.4, 0.3, -0.1], [0.2, -0.5, 0.3], [-0.1, -0.2, -0.4]];

/// A spacecraft with its state and inputs.
#[derive(Debug)]
pub struct Bending<T: Scalar = f64> {
    /// The spacecraft.
    pub craft: Spacecraft<[ReactionWheel<T>; WHEELS], Flexible<ListedModes>>,
    /// Its state.
    pub state: State<[ReactionWheel<T>; WHEELS], Quaternion<T>, Flexible<ListedModes>>,
    /// What acts on it.
    pub inputs: Inputs<[ReactionWheel<T>; WHEELS], Flexible<ListedModes>>,
}

impl<T: Scalar> Bending<T> {
    /// The hub of [`Measured`] with so many modes, in motion.
    ///
    /// # Panics
    /// If the solver rejects it.
    #[must_use]
    pub fn new(modes: usize) -> Self {
        let of = T::from_f64;
        let inertia = Matrix3::from_diagonal(&Vector3::new(0.02, 0.01, 0.01)).map(of);
        let wheels = PLACES.map(|place| ReactionWheel {
            r_w_b: place.map(of).into(),
            d: of(1e-4),
            ..ReactionWheel::bare_wheel(of(4.0), inertia)
        });
        let rigid = Measured::new(&wheels);
        let modes = structure(modes, &wheels.each_ref().map(|wheel| wheel.r_w_b));
        let craft = Spacecraft::flexible(&hub(), &modes, &wheels, &[0, 1, 2, 3])
            .unwrap_or_else(|error| panic!("{error}"));
        let mut state = State::at_rest_for(&craft);
        state = rigid.state.with_modal(state.modal);
        swing(&mut state.modal.eta);
        let mut inputs = Inputs::none_for(&craft);
        inputs = rigid.inputs.with_modal(inputs.modal);
        Self { craft, state, inputs }
    }
}

/// Displaces modes by up to a thousandth.
pub fn swing<T: Scalar>(eta: &mut [T]) {
    for (k, eta) in (0_u16..).zip(eta) {
        *eta = T::from_f64(1e-3 * f64::from(k).sin());
    }
}

/// Modes from 20 rad/s on, one every 10, with momentum, and shapes of some hundredths at the mounts.
#[must_use]
pub fn structure<T: Scalar>(modes: usize, places: &[Vector3<T>; WHEELS]) -> Modes<ListedModes, T> {
    let of = T::from_f64;
    // Phases that grow with the square of the number: no shape depends on a few others.
    let wave = |scale: f64, at: f64| {
        let numbers = (0_u16..).map(f64::from).take(modes);
        let shape = numbers.map(|k| {
            let phase = 1.3 * k * k + (at + 1.0) * k;
            let [x, z] = [phase, 1.9 * phase].map(f64::sin);
            (Vector3::new(x, (0.7 * phase + at).cos(), z) * scale).map(of)
        });
        shape.collect::<Vec<_>>()
    };
    let mount = |(at, position): (f64, &Vector3<T>)| ModalMount {
        point: ModalPoint {
            position: *position,
            translation: wave(0.02, at),
            rotation: wave(0.02, at + 0.5),
        },
        contained: None,
    };
    Modes {
        frequencies: (0_u16..).map(|k| of(20.0 + 10.0 * f64::from(k))).take(modes).collect(),
        damping: ListedModes::modes(modes, &of(0.005)),
        linear: wave(0.5, 7.0),
        angular: wave(0.5, 8.0),
        mounts: [0.0, 1.0, 2.0, 3.0].into_iter().zip(places).map(mount).collect(),
    }
}
