//! [`ClosedLine`]: a tone of a rotor through the loop: what the samples make of it, and what the hub and the outputs do.
//!
//! A tone of the frequency f appears in samples at the rate `f_s` at `f - k f_s`, the alias; the loop answers there, and holds its
//! torque between samples, which has components at all `alias + k f_s`, f among them.

use std::f64::consts::TAU;

use nalgebra::{Complex, DVector};

use super::analysis::{ControlLoop, alias};
use crate::structure::Fault;
use crate::structure::accelerance::{ComplexMatrix, complex};

/// A component that is slower than this share of the rate of the samples is constant: no motion that is seen.
const CONSTANT: f64 = 1e-6;
/// Components of the held torque on each side of the alias that count.
const IMAGES: i32 = 3;

/// A component of the motion.
#[derive(Clone, Debug)]
pub struct Component {
    /// Hz, not negative.
    pub frequency: f64,
    /// Rotation of the hub about each axis of B, rad, for `exp(i w t)`.
    pub attitude: [Complex<f64>; 3],
    /// Outputs of the model.
    pub outputs: Vec<Complex<f64>>,
}

/// A tone through the loop.
#[derive(Clone, Debug)]
pub struct ClosedLine {
    /// The rotor: `rw1.wheel`.
    pub rotor: String,
    /// What causes it.
    pub cause: String,
    /// Harmonic number.
    pub order: f64,
    /// Hz.
    pub frequency: f64,
    /// At which the samples show it, Hz, not negative.
    pub alias: f64,
    /// With motors held: without a controller.
    pub held: Component,
    /// Rotation and angular velocity of the hub at the samples, closed loop, rad and rad/s: of `exp(i w t_k)`.
    pub sampled: [Complex<f64>; 6],
    /// The torque of the law behind its filters at the samples, N m.
    pub torque: [Complex<f64>; 3],
    /// The motion in the closed loop: at the tone itself first, then at its alias, then at further images; where tone and alias
    /// are one, once.
    pub components: Vec<Component>,
}

impl ClosedLine {
    /// The RMS of the rotation about each axis: over time, all components.
    #[must_use]
    pub fn attitude_rms(&self) -> [f64; 3] {
        let square = |axis: usize| -> f64 {
            self.components.iter().filter_map(|of| of.attitude.get(axis)).map(mean_square).sum()
        };
        [0, 1, 2].map(|axis| square(axis).sqrt())
    }

    /// The same without a controller.
    #[must_use]
    pub fn held_rms(&self) -> [f64; 3] {
        self.held.attitude.map(|value| mean_square(&value).sqrt())
    }

    /// Whether the samples show it as a constant.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.alias <= CONSTANT * self.frequency
    }

    /// Whether the samples show it at another frequency.
    #[must_use]
    pub fn is_aliased(&self) -> bool {
        (self.alias - self.frequency).abs() > 1e-9 * self.frequency
    }
}

fn mean_square(value: &Complex<f64>) -> f64 {
    0.5 * value.norm_sqr()
}

impl ControlLoop {
    /// All tones of the rotors through the loop, in the order of the model.
    ///
    /// # Errors
    /// [`Fault::Unbounded`] at a resonance without damping, or at a pole of the loop on the unit circle.
    pub fn lines(&self) -> Result<Vec<ClosedLine>, Fault> {
        let contributors = self.plant.model.contributors();
        let mut lines = Vec::with_capacity(contributors.len());
        for of in &contributors {
            let [device, tone] = of.place;
            let (w, load) = self.plant.load(device, tone);
            let mut line = self.line(w, &load, of.cause == "imbalance")?;
            (line.rotor, line.cause, line.order) = (of.rotor.clone(), of.cause.clone(), of.order);
            lines.push(line);
        }
        Ok(lines)
    }

    /// A load `exp(i w t)` on all coordinates through the loop; the servo knows that of an imbalance.
    fn line(&self, w: f64, load: &DVector<Complex<f64>>, known: bool) -> Result<ClosedLine, Fault> {
        let load = ComplexMatrix::from_columns(std::slice::from_ref(load));
        let forced = self.forced(&self.plant.at_frequency(w), (w, &load), known)?;
        let unbounded = || Fault::Unbounded { frequency: w };
        let sampled = self.at_samples(w).through(&forced).ok_or_else(unbounded)?;
        let motion = &forced.states + sampled.states.rows(0, self.plant.a.nrows());
        let read = complex(&self.plant.motion()) * motion;
        let shown = alias(w / TAU, self.rate) * TAU;
        let rate = TAU * self.rate;
        let mut images: Vec<f64> = vec![w];
        for k in [0].into_iter().chain((1..=IMAGES).flat_map(|k| [k, -k])) {
            let image = shown + f64::from(k) * rate;
            if (image - w).abs() > 1e-9 * w && image.abs() > CONSTANT * rate {
                images.push(image);
            }
        }
        let none = ComplexMatrix::zeros(load.nrows(), 1);
        let mut components = Vec::new();
        for (index, image) in images.into_iter().enumerate() {
            let at = self.plant.at_frequency(image);
            let mut states = at.driven(&self.torques_at(&forced, (image, &sampled)))?;
            if index == 0 {
                states += &forced.states;
            }
            let outputs = at.outputs(&states, if index == 0 { &load } else { &none });
            components.push(component(image, &states, &outputs));
        }
        let held = self.plant.at_frequency(w).outputs(&forced.states, &load);
        let three = |of: &ComplexMatrix, from: usize| {
            [0, 1, 2].map(|k| of.get((from + k, 0)).copied().unwrap_or_default())
        };
        let [rotation, omega] = [three(&read, 0), three(&read, 3)];
        let mut both = [Complex::new(0.0, 0.0); 6];
        both.iter_mut().zip(rotation.into_iter().chain(omega)).for_each(|(to, of)| *to = of);
        Ok(ClosedLine {
            rotor: String::new(),
            cause: String::new(),
            order: 0.0,
            frequency: w / TAU,
            alias: shown.abs() / TAU,
            held: component(w, &forced.states, &held),
            sampled: both,
            torque: three(&sampled.torque, 0),
            components,
        })
    }
}

/// A component of the motion, at a frequency that is not negative.
fn component(w: f64, states: &ComplexMatrix, outputs: &ComplexMatrix) -> Component {
    let turn = |value: Complex<f64>| if w < 0.0 { value.conj() } else { value };
    let attitude = [0, 1, 2].map(|axis| turn(states.get((axis, 0)).copied().unwrap_or_default()));
    let outputs = outputs.iter().copied().map(turn).collect();
    Component { frequency: w.abs() / TAU, attitude, outputs }
}
