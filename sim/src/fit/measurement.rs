//! [`Measurement`]: forces and moments of a wheel on a rigid table at steady speeds, and how they are
//! referred to the wheel.
//!
//! A table measures force `F_t` and moment `T_t` about its own origin, in its own axes. In the wheel's axes
//! (x along the spin axis, y along the direction from which its angle counts, z = x × y) and about its centre
//! W at `r` from the table's origin,
//!
//! ```text
//! F_w = A F_t        T_w = A (T_t - r x F_t)        A: rows are the wheel's axes in the table's
//! ```
//!
//! because the force acts through W. These are the force and moment that the wheel exerts on the table; a
//! table that reports what it exerts on the wheel has the opposite sign.

use std::collections::BTreeMap;
use std::fmt;

use nalgebra::{Matrix3, Vector3};

use super::error::FitError;

/// Force along x, y, z, N, and moment about x, y, z, N m, in the wheel's axes.
pub const CHANNELS: usize = 6;
/// Their names.
pub const CHANNEL_NAMES: [&str; CHANNELS] = ["fx", "fy", "fz", "tx", "ty", "tz"];

/// Samples of a record at least: lines need some turns, and noise some bins.
pub const SAMPLES_MIN: usize = 256;
/// And at most: forty lines are eighty columns of as many numbers.
pub const SAMPLES_MAX: usize = 1 << 19;
/// Records at least: a mode has three parameters, and a residual needs more speeds than parameters.
pub const RECORDS_MIN: usize = 3;
/// Sampling rates, 1/s.
const RATES: [f64; 2] = [1e-3, 1e8];
/// Speeds, rad/s, either sense.
const SPEEDS: [f64; 2] = [1e-3, 1e6];
/// Samples of each channel by which records are first compared.
const KEY: usize = 4;
/// The least sine between spin axis and reference direction.
const SINE_MIN: f64 = 1e-3;

/// Channels that share modes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Group {
    /// `fx`, along the spin axis.
    AxialForce,
    /// `fy` and `fz`, as one complex number.
    RadialForce,
    /// `tx`, about the spin axis.
    AxialTorque,
    /// `ty` and `tz`, as one complex number.
    RadialTorque,
}

/// Where the wheel is on the table, and the sign of what is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct TablePose {
    position: Vector3<f64>,
    axes: Matrix3<f64>,
    on_wheel: bool,
}

/// One steady speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// In messages.
    pub name: String,
    /// Sampling rate, 1/s.
    pub rate: f64,
    /// Speed about +x at the middle of the record, rad/s.
    pub speed: f64,
    /// Rate of change of the speed, rad/s²; 0 where it is unknown.
    pub drift: f64,
    /// Times at which the wheel's y axis passes the reference direction, s from the first sample; empty
    /// without an index.
    pub pulses: Vec<f64>,
    /// Forces, N, and moments, N m, in the wheel's axes.
    pub channels: [Vec<f64>; CHANNELS],
}

/// All speeds of a wheel.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// In the order of the file.
    pub records: Vec<Record>,
}

impl Group {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::AxialForce, Self::RadialForce, Self::AxialTorque, Self::RadialTorque];

    /// Indices of its channels; of an axial group twice the same.
    #[must_use]
    pub const fn channels(self) -> [usize; 2] {
        match self {
            Self::AxialForce => [0, 0],
            Self::RadialForce => [1, 2],
            Self::AxialTorque => [3, 3],
            Self::RadialTorque => [4, 5],
        }
    }

    /// Whether it is a pair that turns.
    #[must_use]
    pub const fn is_radial(self) -> bool {
        matches!(self, Self::RadialForce | Self::RadialTorque)
    }

    /// Whether it is a moment.
    #[must_use]
    pub const fn is_torque(self) -> bool {
        matches!(self, Self::AxialTorque | Self::RadialTorque)
    }

    /// The unit of its amplitude coefficients: force or moment by the square of a speed.
    #[must_use]
    pub const fn coefficient_unit(self) -> &'static str {
        if self.is_torque() { "kg m^2" } else { "kg m" }
    }
}

impl fmt::Display for Group {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::AxialForce => "axial force",
            Self::RadialForce => "radial force",
            Self::AxialTorque => "axial torque",
            Self::RadialTorque => "radial torque",
        })
    }
}

impl TablePose {
    /// A wheel with its centre at `position`, m, from the table's origin, its spin axis and the direction
    /// across it from which its angle counts, all expressed in the table's axes. `on_wheel`: the table
    /// reports what it exerts on the wheel.
    ///
    /// # Errors
    /// [`FitError::Axes`] where the directions are parallel or not finite.
    pub fn new(
        position: Vector3<f64>,
        spin_axis: Vector3<f64>,
        reference: Vector3<f64>,
        on_wheel: bool,
    ) -> Result<Self, FitError> {
        let x = spin_axis / spin_axis.norm();
        let across = reference / reference.norm();
        let across = across - x * x.dot(&across);
        let sine = across.norm();
        // Also not a number.
        if !(sine.is_finite() && sine >= SINE_MIN && position.iter().all(|p| p.is_finite())) {
            return Err(FitError::Axes { sine, bound: SINE_MIN });
        }
        let y = across / sine;
        let z = x.cross(&y);
        let axes = Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]);
        Ok(Self { position, axes, on_wheel })
    }

    /// Force, N, and moment about W, N m, of the wheel on the table, in the wheel's axes, from those of the
    /// table about its origin.
    #[must_use]
    pub fn referred(&self, table: [f64; CHANNELS]) -> [f64; CHANNELS] {
        let [fx, fy, fz, tx, ty, tz] = table;
        let force = Vector3::new(fx, fy, fz);
        let moment = Vector3::new(tx, ty, tz) - self.position.cross(&force);
        let sign = if self.on_wheel { -1.0 } else { 1.0 };
        let (force, moment) = (self.axes * force * sign, self.axes * moment * sign);
        [force.x, force.y, force.z, moment.x, moment.y, moment.z]
    }

    /// The channels of a table, all samples.
    #[must_use]
    pub fn referred_samples(&self, table: &[Vec<f64>; CHANNELS]) -> [Vec<f64>; CHANNELS] {
        let mut channels: [Vec<f64>; CHANNELS] = Default::default();
        let length = table.iter().map(Vec::len).min().unwrap_or(0);
        for index in 0..length {
            let sample = table.each_ref().map(|channel| channel[index]);
            for (channel, value) in channels.iter_mut().zip(self.referred(sample)) {
                channel.push(value);
            }
        }
        channels
    }
}

impl Record {
    /// Samples of each channel.
    #[must_use]
    pub fn length(&self) -> usize {
        self.channels[0].len()
    }

    /// Its length, s.
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "at most SAMPLES_MAX")]
    pub fn duration(&self) -> f64 {
        self.length() as f64 / self.rate
    }

    fn check(&self) -> Result<(), FitError> {
        let record = || self.name.clone();
        let found = self.length();
        if !(SAMPLES_MIN..=SAMPLES_MAX).contains(&found) {
            let range = [SAMPLES_MIN, SAMPLES_MAX];
            return Err(FitError::Samples { record: record(), found, range });
        }
        let lengths = self.channels.each_ref().map(Vec::len);
        if lengths.iter().any(|length| *length != found) {
            return Err(FitError::Uneven { record: record(), found: lengths });
        }
        let numbers = [
            ("the sampling rate (1/s)", self.rate, self.rate, RATES),
            ("the speed (rad/s)", self.speed, self.speed.abs(), SPEEDS),
            (
                "the change of the speed (rad/s)",
                self.drift * self.duration(),
                (self.drift * self.duration()).abs(),
                [0.0, 0.1 * self.speed.abs()],
            ),
        ];
        for (what, value, size, range) in numbers {
            if !(range[0]..=range[1]).contains(&size) {
                return Err(FitError::Range { record: record(), what, value, range });
            }
        }
        for (channel, name) in self.channels.iter().zip(CHANNEL_NAMES) {
            if let Some(index) = channel.iter().position(|sample| !sample.is_finite()) {
                return Err(FitError::Sample { record: record(), channel: name, index });
            }
        }
        Ok(())
    }
}

impl Measurement {
    /// Checks every record.
    ///
    /// # Errors
    /// The first record that cannot be used, and why.
    pub fn check(&self) -> Result<(), FitError> {
        if self.records.len() < RECORDS_MIN {
            return Err(FitError::Records { found: self.records.len(), least: RECORDS_MIN });
        }
        self.records.iter().try_for_each(Record::check)?;
        let channels: Vec<_> = self.records.iter().map(|record| &record.channels).collect();
        let Some([first, second]) = twice(&channels) else { return Ok(()) };
        let name = |place: usize| self.records.get(place).map(|record| record.name.clone());
        Err(FitError::Twice {
            records: [first, second].map(|place| name(place).unwrap_or_default()),
            places: [first + 1, second + 1],
        })
    }
}

/// The places of two records with the same numbers in all channels, the first such pair: noise never repeats, so they are
/// one measurement.
pub(super) fn twice(all: &[&[Vec<f64>; CHANNELS]]) -> Option<[usize; 2]> {
    let bits = |samples: &[f64]| samples.iter().map(|sample| sample.to_bits()).collect::<Vec<_>>();
    // By their length and their first samples, then by all.
    let mut known: BTreeMap<(usize, Vec<u64>), Vec<usize>> = BTreeMap::new();
    for (place, channels) in all.iter().enumerate() {
        let start = channels.iter().flat_map(|channel| bits(channel.get(..KEY).unwrap_or(channel)));
        let alike = known.entry((channels[0].len(), start.collect())).or_default();
        let same = |other: &&usize| all.get(**other).is_some_and(|other| other == channels);
        if let Some(first) = alike.iter().find(same) {
            return Some([*first, place]);
        }
        alike.push(place);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of a few products of numbers of order one.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn a_force_through_the_wheel_has_no_moment_about_it() {
        let r = Vector3::new(0.02, -0.03, 0.11);
        let axis = Vector3::new(0.0, 0.0, 2.0);
        let placement = TablePose::new(r, axis, Vector3::new(1.0, 1.0, 3.0), false).expect("axes");
        let force = Vector3::new(1.0, -2.0, 0.5);
        let moment = r.cross(&force);
        let table = [force.x, force.y, force.z, moment.x, moment.y, moment.z];
        let found = placement.referred(table);
        assert!((found[0] - 0.5).abs() < ROUNDING, "x is the spin axis: {found:?}");
        assert!(found[3..].iter().all(|t| t.abs() < ROUNDING), "{found:?}");
        let opposite = TablePose::new(r, axis, Vector3::new(1.0, 1.0, 0.0), true).expect("axes");
        assert!((opposite.referred(table)[0] + 0.5).abs() < ROUNDING);
        // y is (1, 1, 0) / sqrt 2, z is (-1, 1, 0) / sqrt 2.
        let half = std::f64::consts::FRAC_1_SQRT_2;
        assert!((found[1] + half).abs() < ROUNDING && (found[2] + 3.0 * half).abs() < ROUNDING);
    }

    #[test]
    fn parallel_directions_and_bad_records_are_errors() {
        let x = Vector3::x();
        let parallel = TablePose::new(Vector3::zeros(), x, x, false);
        assert!(matches!(parallel, Err(FitError::Axes { .. })));
        let nothing = TablePose::new(Vector3::zeros(), Vector3::zeros(), x, false);
        assert!(matches!(nothing, Err(FitError::Axes { .. })));
        let good = Record {
            name: "a".into(),
            rate: 1e3,
            speed: 100.0,
            drift: 0.0,
            pulses: Vec::new(),
            channels: std::array::from_fn(|_| vec![0.0; SAMPLES_MIN]),
        };
        // Samples of their own, so that none is there twice.
        let of = |record: Record| {
            let mut records = vec![record; RECORDS_MIN];
            for (record, own) in records.iter_mut().zip([1.0, 2.0, 3.0]) {
                record.channels[0][0] = own;
            }
            Measurement { records }.check()
        };
        assert_eq!(of(good.clone()), Ok(()));
        let mut records = vec![good.clone(); RECORDS_MIN];
        records[1].channels[0][0] = 1.0;
        let found = Measurement { records }.check();
        assert!(matches!(found, Err(FitError::Twice { places: [1, 3], .. })), "{found:?}");
        let mut bad = good.clone();
        bad.channels[4][7] = f64::NAN;
        assert!(matches!(of(bad), Err(FitError::Sample { channel: "ty", index: 7, .. })));
        assert!(matches!(
            of(Record { speed: f64::INFINITY, ..good.clone() }),
            Err(FitError::Range { .. })
        ));
        assert!(matches!(of(Record { rate: 0.0, ..good.clone() }), Err(FitError::Range { .. })));
        let mut uneven = good;
        uneven.channels[2].pop();
        assert!(matches!(of(uneven), Err(FitError::Uneven { .. })));
    }
}
