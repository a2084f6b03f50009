//! An example measurement: a sweep of a wheel with two modes, and the TOML that describes it, for a first run.
//!
//! A staircase of speeds from 600 to 4800 rpm, 30 steps of 1.2 s at 1 kHz with a tachometer. Numbers are
//! chosen; the noise is white and seeded.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use nalgebra::{Complex, Vector3};

use super::modes::{Mode, amplification};

/// The name of the file of samples.
pub const SAMPLES: &str = "wheel-sweep.csv";
/// And of its description.
pub const DESCRIPTION: &str = "wheel-measurement.toml";

/// What the description says.
pub const TOML: &str = r#"# A wheel on a rigid table, run up in steps. Fit it:
#
#   precess fit wheel-measurement.toml --out results
format = 1
name = "rw"                        # of the device that is written
title = "A wheel on a table"
file = "wheel-sweep.csv"           # one file with a column of the speed; or [[record]] for each speed

[table]
position = "0, 0, 8 cm"            # of the wheel's centre from the table's origin, in the table's axes
spin_axis = [0, 0, 1]
reference = [1, 0, 0]              # the direction of the wheel's y axis at the index
reads = "on_table"                 # what the wheel exerts on the table; or "on_wheel"

[columns]
time = "time_s"
force = ["fx_n", "fy_n", "fz_n"]
torque = ["tx_nm", "ty_nm", "tz_nm"]
speed = "speed_rpm"
speed_unit = "rpm"
index = "tacho"                    # rises through its middle once a turn; leave it out if there is none

[sweep]
tolerance = 0.002                  # a steady step keeps its speed within this share
shortest = "0.8 s"

# Harmonics and modes are found. To state them instead:
#
# [[harmonic]]
# number = 5.2
# [[mode]]
# of = "radial_torque"
# frequency = "80 Hz"

[rotor]                            # if it is known, its bearings are written, too
mass = "3 kg"
inertia = "0.012, 0.0075 kg m^2"   # about the spin axis, across it
"#;

const RATE: f64 = 1000.0;
const STEPS: u32 = 30;
const STEP: u32 = 1200;
const SEED: u64 = 17;
/// Whole and other harmonic numbers with forces, kg m, and torques, kg m²: axial, forward, backward.
const LINES: [(f64, [f64; 3], [f64; 3]); 5] = [
    (0.42, [2e-7, 6e-7, 0.0], [0.0, 3e-8, 0.0]),
    (1.0, [0.0, 1.8e-6, 0.0], [0.0, 2.6e-7, 0.0]),
    (2.0, [4e-7, 7e-7, 0.0], [2e-8, 8e-8, 0.0]),
    (3.7, [0.0, 4e-7, 4e-7], [0.0, 5e-8, 5e-8]),
    (5.2, [5e-7, 3e-7, 0.0], [3e-8, 4e-8, 0.0]),
];
/// Noise of a sample, N and N m.
const NOISE: [f64; 2] = [1e-2, 1e-3];

/// The samples as CSV: the same bytes each time.
#[must_use]
pub fn samples() -> String {
    let radial = Mode { frequency: TAU * 195.0, damping: 0.015, inertia_ratio: 0.0, share: 1.0 };
    let rocking = Mode { frequency: TAU * 85.0, damping: 0.02, inertia_ratio: 1.6, share: 1.0 };
    let mut random = Random(SEED);
    let mut text = String::from("time_s,fx_n,fy_n,fz_n,tx_nm,ty_nm,tz_nm,speed_rpm,tacho\n");
    let mut digits = zmij::Buffer::new();
    let mut angle = 0.0;
    for step in 0..STEPS {
        let rpm = 600.0 + 4200.0 * f64::from(step) / f64::from(STEPS - 1);
        let spin = rpm * TAU / 60.0;
        let phases: Vec<f64> = LINES.iter().map(|_| TAU * random.uniform()).collect();
        for sample in 0..STEP {
            let time = f64::from(step * STEP + sample) / RATE;
            let [mut force, mut torque] = [Vector3::zeros(), Vector3::zeros()];
            for ((h, f, t), drawn) in LINES.iter().zip(&phases) {
                // Whole numbers turn with the wheel, from the index.
                let whole = h.fract() == 0.0;
                let phase = h * angle + if whole { 0.5 } else { *drawn };
                let wave = |phase: f64| {
                    let (sine, cosine) = precess_dynamics::Angle::sin_cos(phase);
                    Complex::new(cosine, sine) * spin * spin
                };
                let pair = |modes: &[Mode], [axial, forward, backward]: [f64; 3], lead: f64| {
                    let w = h * spin;
                    let e = wave(phase + lead);
                    let turning = amplification(modes, w, spin) * e * forward
                        + amplification(modes, -w, spin) * e.conj() * backward;
                    Vector3::new(axial * e.re, turning.re, turning.im)
                };
                force += pair(&[radial], *f, 0.0);
                torque += pair(&[rocking], *t, 0.8);
            }
            // The wheel's x, y, z are the table's z, x, y.
            let force = Vector3::new(force.y, force.z, force.x);
            let torque = Vector3::new(torque.y, torque.z, torque.x);
            let torque = torque + Vector3::new(0.0, 0.0, 0.08).cross(&force);
            text.push_str(digits.format(time));
            for (k, value) in force.iter().chain(torque.iter()).enumerate() {
                let _ = write!(text, ",{:.4e}", value + NOISE[k / 3] * random.normal());
            }
            let (tacho, _) = precess_dynamics::Angle::sin_cos(angle);
            let _ = writeln!(text, ",{rpm:.3},{tacho:.4}");
            angle += spin / RATE;
        }
    }
    text
}

/// `SplitMix64`.
struct Random(u64);

impl Random {
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The sum of twelve uniform numbers less six: near to normal, and without functions.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}
