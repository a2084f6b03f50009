//! [`Disturbance`]: empirical sources of force and torque beside the coupled devices: tones at harmonics
//! of a wheel's speed, broadband noise of a power spectral density, and measured records.
//!
//! A disturbance is a wrench from outside. A wheel on a rigid table is measured by what it exerts on
//! the table, and this is applied to what the wheel stands on, at the mount or on a body. There is no
//! reaction on the rotor: across a rigid bearing it would return to the mount and cancel, and about the spin
//! axis it would be a motor torque. So momentum is not conserved with a disturbance, and its work is work
//! from outside in the energy ledger.
//!
//! Such a measurement contains what a coupled wheel already has: the fundamental of its imbalance, and
//! of a wheel on flexible bearings its internal modes. [`Scenario::check`](crate::scenario::Scenario::check)
//! rejects both unless the source says that they were removed.
//!
//! Six components are in the order of [`COMPONENTS`]: force x, y, z, N, then moment x, y, z, N m, along
//! the axes of the data sheet.

mod broadband;
mod correlation;
mod draws;
mod error;
pub(crate) mod fourier;
mod harmonic;
mod measured;
mod waveform;

use std::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};

pub use broadband::{Broadband, Noise};
pub use correlation::CoherentPair;
pub use draws::phases;
pub use error::{BroadbandError, MeasuredError};
pub use harmonic::{Harmonic, WheelAngle};
pub use measured::{Measured, MeasuredInterpolation, Playback, RecordFile};
pub use waveform::{Line, Waveform};

/// Components of a wrench.
pub const COMPONENT_COUNT: usize = 6;
/// Their names: of keys of a file, of columns, of seeds.
pub const COMPONENTS: [&str; COMPONENT_COUNT] =
    ["force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"];

/// One of each component.
pub type Six<T> = [T; COMPONENT_COUNT];

/// A source of force and torque.
#[derive(Clone, Debug, PartialEq)]
pub struct Disturbance {
    /// Lower-case letters, digits, underscores; unique among sources. Columns are `source_NAME`.
    pub name: String,
    /// What it acts on.
    pub on: SourceTarget,
    /// Where the force acts, m: from the origin of the device on a mount, in the device's axes; else from
    /// B, the node or the body's origin, in the body's axes.
    pub point: Vector3<f64>,
    /// The axis of the data sheet along which the wheel spins: 0, 1 or 2.
    pub spin_axis: usize,
    /// The wheel's joint: its angle drives harmonics, its rate scales noise.
    pub wheel: Option<usize>,
    /// Whether the fundamental of the imbalance was removed from what was measured.
    pub fundamental_removed: bool,
    /// Whether the internal modes of the wheel were removed from what was measured.
    pub modes_removed: bool,
    /// From when, and until before when, it acts, s; infinite where it always does.
    pub window: [f64; 2],
    /// The seed of phases; those of harmonics are drawn where the source is made.
    pub seed: Option<u32>,
    /// What it exerts.
    pub model: Model,
}

/// What a source acts on, and its axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SourceTarget {
    /// What the device or platform of this number stands on, at its mount, in the axes of the mount.
    Mount(usize),
    /// The hub, about B.
    Hub {
        /// Columns: the data sheet's axes, expressed in B.
        axes: Matrix3<f64>,
    },
    /// A node of the structure, which is not turned by the deformation.
    Node {
        /// The node.
        node: usize,
        /// Columns: the data sheet's axes, expressed in B.
        axes: Matrix3<f64>,
    },
    /// The child body of a joint.
    Joint {
        /// The joint.
        joint: usize,
        /// Which axes turn with what.
        axes: JointAxes,
    },
}

/// The axes of a source on the child body of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointAxes {
    /// Those of the body: they turn with a rotor.
    Body,
    /// Those of its parent body: of a rotor the axes of its bearing, which do not turn with it.
    Parent,
}

/// What a source exerts.
#[derive(Clone, Debug, PartialEq)]
pub enum Model {
    /// Tones at multiples of the wheel's angle.
    Harmonic(Vec<Harmonic>),
    /// Noise of a power spectral density.
    Broadband(Broadband),
    /// Measured force and torque over time.
    Measured(Measured),
}

/// The rotation from the data sheet's axes to those of a device, whose rotor spins about x: the sheet's
/// axis `spin_axis` is x, the ones that follow it cyclically are y and z. Columns: the sheet's axes.
#[must_use]
pub fn sheet_axes(spin_axis: usize) -> Matrix3<f64> {
    let mut axes = Matrix3::zeros();
    for step in 0..3 {
        axes[(step, (spin_axis + step) % 3)] = 1.0;
    }
    axes
}

/// The components across the spin axis and along it: `[first radial, second radial, axial]`, the second
/// radial axis a quarter turn after the first about the spin axis; of the force with `from` 0, of the
/// moment with `from` 3.
#[must_use]
pub fn by_spin_axis(spin_axis: usize, from: usize) -> [usize; 3] {
    [from + (spin_axis + 1) % 3, from + (spin_axis + 2) % 3, from + spin_axis % 3]
}

/// A source that acts all the time.
pub const ALWAYS: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

impl Disturbance {
    /// Whether it acts at a time, s, which is approached from below or not.
    #[must_use]
    pub fn acts(&self, time: f64, from_below: bool) -> bool {
        let [from, to] = self.window;
        if from_below { from < time && time <= to } else { from <= time && time < to }
    }
}

impl Model {
    /// The highest frequency that it exerts at a rate of its wheel, Hz; of a record a quarter of the mean
    /// rate of its rows, which a spline shows well.
    #[must_use]
    pub fn highest_frequency(&self, rate: f64) -> f64 {
        match self {
            Self::Harmonic(tones) => {
                tones.iter().map(|tone| tone.number * rate.abs() / TAU).fold(0.0, f64::max)
            }
            Self::Broadband(noise) => noise.band[1],
            Self::Measured(record) => 0.25 * record.mean_rate(),
        }
    }

    /// The key of its table in a file.
    #[must_use]
    pub fn key(&self) -> &'static str {
        match self {
            Self::Harmonic(_) => "harmonic",
            Self::Broadband(_) => "broadband",
            Self::Measured(_) => "record",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spin_axis_of_the_sheet_is_the_x_axis_of_the_device() {
        for axis in 0..3 {
            let axes = sheet_axes(axis);
            assert_eq!(axes * Vector3::ith(axis, 1.0), Vector3::x());
            assert_eq!(axes * Vector3::ith((axis + 1) % 3, 1.0), Vector3::y());
            assert_eq!(axes.determinant(), 1.0);
        }
        assert_eq!(by_spin_axis(2, 3), [3, 4, 5]);
        assert_eq!(by_spin_axis(0, 0), [1, 2, 0]);
    }
}
