//! Forces and moments of a wheel on a rigid table, in the time domain: the forward model of the tests.
//!
//! It shares no formula with the fit: bearings are masses, springs and dampers in real coordinates, tilting
//! follows `H_y = I_r y' + I_s Omega z`, `H_z = I_r z' - I_s Omega y`, and each line is written sample by
//! sample with a phase of its own. Noise is white on every channel of the table.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, Matrix2, Matrix3, Vector2, Vector3};

/// A generator of numbers: `SplitMix64`, and Box and Muller's normal ones.
pub(crate) struct Random {
    state: u64,
    spare: Option<f64>,
}

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self { state: seed, spare: None }
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Between 0 and 1.
    pub(crate) fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn normal(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        let radius = (-2.0 * (1.0 - self.uniform()).ln()).sqrt();
        let (sine, cosine) = (TAU * self.uniform()).sin_cos();
        self.spare = Some(radius * sine);
        radius * cosine
    }
}

/// A rotor on bearings: mass or inertia, stiffness, damping, SI; `spin` is the inertia about the axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bearing {
    pub(crate) inertia: f64,
    pub(crate) spin: f64,
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
}

/// What acts on the rotor at one harmonic, by Omega²: along and about the axis, and across it turning with
/// and against the wheel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Source {
    pub(crate) h: f64,
    pub(crate) fx: f64,
    pub(crate) f_forward: f64,
    pub(crate) f_backward: f64,
    pub(crate) tx: f64,
    pub(crate) t_forward: f64,
    pub(crate) t_backward: f64,
    /// Of the torque's forward part beyond the force's.
    pub(crate) lead: f64,
    /// Of a whole harmonic from the wheel's angle.
    pub(crate) phase: f64,
}

/// A wheel on a table.
#[derive(Clone, Debug)]
pub(crate) struct Wheel {
    pub(crate) sources: Vec<Source>,
    pub(crate) radial: Bearing,
    pub(crate) tilting: Bearing,
    /// Standard deviation of each sample of force, N, and moment, N m, of the table.
    pub(crate) noise: [f64; 2],
    /// Place of the wheel, m, and its axes in the table's: columns.
    pub(crate) position: Vector3<f64>,
    pub(crate) axes: Matrix3<f64>,
}

/// A steady step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    pub(crate) speed: f64,
    /// rad/s².
    pub(crate) drift: f64,
    pub(crate) rate: f64,
    pub(crate) length: usize,
}

/// What a table writes.
pub(crate) struct Written {
    pub(crate) channels: [Vec<f64>; 6],
    pub(crate) pulses: Vec<f64>,
}

/// Amplitudes along y and z on the table of what turns with the amplitudes 1 and -i (or +i) on the rotor.
fn through(bearing: &Bearing, w: f64, spin: f64, sense: f64) -> [Complex<f64>; 2] {
    let c = |re, im| Complex::new(re, im);
    let own = c(bearing.stiffness - bearing.inertia * w * w, w * bearing.damping);
    let cross = c(0.0, bearing.spin * spin * w);
    let acting = Vector2::new(c(1.0, 0.0), c(0.0, -sense));
    let matrix = Matrix2::new(own, cross, -cross, own);
    let moved = matrix.try_inverse().expect("damped") * acting;
    let on_table = moved * c(bearing.stiffness, w * bearing.damping);
    [on_table.x, on_table.y]
}

impl Wheel {
    /// One step, with phases of its own.
    pub(crate) fn measured(&self, step: &Step, random: &mut Random) -> Written {
        let start = TAU * random.uniform();
        let middle = 0.5 * (step.length as f64 - 1.0) / step.rate;
        let spin = step.speed;
        let angle = |t: f64| {
            let t = t - middle;
            start + spin * (t + middle) + 0.5 * step.drift * (t * t - middle * middle)
        };
        let mut wheel: [Vec<f64>; 6] = std::array::from_fn(|_| vec![0.0; step.length]);
        let square = spin * spin;
        for source in &self.sources {
            let h = source.h;
            let w = h * spin;
            // Whole harmonics turn with the wheel, others with something else.
            let whole = (h - h.round()).abs() < 1e-12;
            let at = if whole { source.phase } else { TAU * random.uniform() };
            let unit = |amplitude: f64, phase: f64| Complex::from_polar(amplitude * square, phase);
            let mut waves = [Complex::new(0.0, 0.0); 6];
            let mut any = || if whole { 0.3 * PI } else { TAU * random.uniform() };
            let (axial, about) = (any(), any());
            waves[0] = unit(source.fx, axial);
            waves[3] = unit(source.tx, about);
            for (first, bearing, forward, backward, lead) in [
                (1, &self.radial, source.f_forward, source.f_backward, 0.0),
                (4, &self.tilting, source.t_forward, source.t_backward, source.lead),
            ] {
                for (amplitude, sense, phase) in
                    [(forward, 1.0, at + lead), (backward, -1.0, any())]
                {
                    let [y, z] = through(bearing, w, spin, sense);
                    waves[first] += y * unit(amplitude, phase);
                    waves[first + 1] += z * unit(amplitude, phase);
                }
            }
            // exp(i h angle) by a recurrence for a polynomial of second degree.
            let dt = 1.0 / step.rate;
            let mut e = Complex::from_polar(1.0, h * angle(0.0));
            let mut turn = Complex::from_polar(1.0, h * (angle(dt) - angle(0.0)));
            let curve = Complex::from_polar(1.0, h * step.drift * dt * dt);
            for index in 0..step.length {
                if index % 512 == 0 {
                    let t = index as f64 * dt;
                    e = Complex::from_polar(1.0, h * angle(t));
                    turn = Complex::from_polar(1.0, h * (angle(t + dt) - angle(t)));
                }
                for (channel, wave) in wheel.iter_mut().zip(&waves) {
                    channel[index] += wave.re * e.re - wave.im * e.im;
                }
                e *= turn;
                turn *= curve;
            }
        }
        let mut channels: [Vec<f64>; 6] = std::array::from_fn(|_| Vec::with_capacity(step.length));
        for index in 0..step.length {
            let [fx, fy, fz, tx, ty, tz] = wheel.each_ref().map(|channel| channel[index]);
            let force = self.axes * Vector3::new(fx, fy, fz);
            let moment = self.axes * Vector3::new(tx, ty, tz) + self.position.cross(&force);
            for (k, value) in force.iter().chain(moment.iter()).enumerate() {
                let noise = self.noise[k / 3] * random.normal();
                channels[k].push(value + noise);
            }
        }
        // Times at which the angle is a multiple of a turn, by Newton's method.
        let end = 2.0 * middle;
        let mut pulses = Vec::new();
        let (low, high) = (angle(0.0).min(angle(end)), angle(0.0).max(angle(end)));
        let mut turn = (low / TAU).ceil();
        while turn * TAU < high {
            let mut t = (turn * TAU - angle(0.0)) / spin;
            for _ in 0..8 {
                let rate = spin + step.drift * (t - middle);
                t -= (angle(t) - turn * TAU) / rate;
            }
            pulses.push(t);
            turn += 1.0;
        }
        pulses.sort_by(f64::total_cmp);
        Written { channels, pulses }
    }
}
