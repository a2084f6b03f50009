//! [`ControlLaw`] and [`AttitudeReference`]: what a controller computes from, and what the hub is to follow; in numbers of a
//! scenario, from which [`precess_control`] makes them.

use std::path::PathBuf;

use nalgebra::{Matrix3, Vector3};
use precess_control::{
    AttitudeRow, AttitudeTable, ControlError, Guidance, Gyroscopic, Hold, Law, MrpFeedback,
    MrpGains, QuaternionFeedback, RateDamping, Slew, TurnLimits, Turning,
};
use precess_dynamics::Quaternion;

/// A law. Gains are diagonal, as those of a file: one for each axis of B. Where it has an inertia, kg m², none stands for that of the scenario at its start, about the centre of mass.
#[derive(Clone, Debug, PartialEq)]
pub enum ControlLaw {
    /// [`MrpFeedback`].
    MrpFeedback {
        /// Its gains.
        gains: MrpGains,
        /// Inertia for its feed-forward.
        inertia: Option<Matrix3<f64>>,
        /// What it adds for the gyroscopic torque.
        gyroscopic: Gyroscopic,
    },
    /// [`QuaternionFeedback`].
    QuaternionFeedback {
        /// `K`, N m.
        attitude: Matrix3<f64>,
        /// `D`, N m s.
        rate: Matrix3<f64>,
        /// Inertia for its feed-forward.
        inertia: Option<Matrix3<f64>>,
        /// What it adds for the gyroscopic torque.
        gyroscopic: Gyroscopic,
    },
    /// [`QuaternionFeedback::eigen_axis`].
    EigenAxis {
        /// Frequency of small errors without damping, Hz.
        frequency: f64,
        /// Their damping ratio.
        damping_ratio: f64,
        /// Inertia.
        inertia: Option<Matrix3<f64>>,
    },
    /// [`RateDamping`].
    RateDamping {
        /// `D`, N m s.
        rate: Matrix3<f64>,
    },
    /// A program that answers samples: [`ProgramController`](crate::control::ProgramController).
    Program {
        /// Its name, and its arguments.
        command: Vec<String>,
        /// The folder in which it runs: that of the scenario's file. It is not written to one.
        folder: PathBuf,
        /// How long it may take for an answer, s.
        time_limit: f64,
    },
}

/// What the hub is to follow.
#[derive(Clone, Debug, PartialEq)]
pub enum AttitudeReference {
    /// An attitude relative to N.
    Hold(Quaternion),
    /// A turn about one axis, from rest to rest.
    Slew {
        /// When it begins, s.
        start: f64,
        /// The attitude before.
        from: Quaternion,
        /// The attitude after.
        to: Quaternion,
        /// Largest rate, acceleration and jerk.
        limits: TurnLimits,
    },
    /// A frame that turns at a constant rate.
    Turning {
        /// Its attitude relative to N at time zero.
        attitude: Quaternion,
        /// Its angular velocity, expressed in it, rad/s.
        omega: Vector3<f64>,
    },
    /// Attitude and rate at some times, and a smooth motion through them.
    Table(Vec<AttitudeRow>),
}

/// A law that a run keeps.
pub(crate) type BuiltLaw = Box<dyn Law + Send>;
/// A reference that a run keeps.
pub(crate) type BuiltGuidance = Box<dyn Guidance + Send>;

impl ControlLaw {
    /// The keys of its gains that have an element beside the diagonal, with that element.
    pub(super) fn beside_the_diagonal(&self) -> Vec<(&'static str, f64)> {
        let all: &[(&'static str, &Matrix3<f64>)] = match self {
            Self::MrpFeedback { gains, .. } => {
                &[("law.rate_gain", &gains.rate), ("law.integral_gain", &gains.integral)]
            }
            Self::QuaternionFeedback { attitude, rate, .. } => {
                &[("law.attitude_gain", attitude), ("law.rate_gain", rate)]
            }
            Self::RateDamping { rate } => &[("law.rate_gain", rate)],
            Self::EigenAxis { .. } | Self::Program { .. } => &[],
        };
        let beside = |of: &Matrix3<f64>| {
            let rest = of - Matrix3::from_diagonal(&of.diagonal());
            rest.iter().copied().find(|element| *element != 0.0)
        };
        all.iter().filter_map(|(key, of)| Some((*key, beside(of)?))).collect()
    }

    /// The law, with an inertia where it states none; none of a program.
    ///
    /// # Errors
    ///
    /// What is wrong with its numbers.
    pub(crate) fn built(
        &self,
        own: impl Fn() -> Matrix3<f64>,
    ) -> Result<Option<BuiltLaw>, ControlError> {
        Ok(Some(match self {
            Self::MrpFeedback { gains, inertia, gyroscopic } => {
                Box::new(MrpFeedback::new(*gains, inertia.unwrap_or_else(own), *gyroscopic)?)
            }
            Self::QuaternionFeedback { attitude, rate, inertia, gyroscopic } => {
                let inertia = inertia.unwrap_or_else(own);
                Box::new(QuaternionFeedback::new(*attitude, *rate, inertia, *gyroscopic)?)
            }
            Self::EigenAxis { frequency, damping_ratio, inertia } => {
                // `sqrt(k / 2)` and `d / sqrt(2 k)` of small errors.
                let omega = std::f64::consts::TAU * frequency;
                let (k, d) = (2.0 * omega * omega, 2.0 * damping_ratio * omega);
                let inertia = inertia.unwrap_or_else(own);
                Box::new(QuaternionFeedback::eigen_axis(k, d, inertia)?)
            }
            Self::RateDamping { rate } => Box::new(RateDamping::new(*rate)?),
            Self::Program { .. } => return Ok(None),
        }))
    }
}

impl AttitudeReference {
    /// The reference as a function of time.
    ///
    /// # Errors
    ///
    /// What is wrong with its numbers.
    pub(crate) fn built(&self) -> Result<BuiltGuidance, ControlError> {
        Ok(match self {
            Self::Hold(attitude) => Box::new(Hold::new(*attitude)?),
            Self::Slew { start, from, to, limits } => {
                Box::new(Slew::new(*start, *from, *to, limits)?)
            }
            Self::Turning { attitude, omega } => Box::new(Turning::new(0.0, *attitude, *omega)?),
            Self::Table(rows) => Box::new(AttitudeTable::new(rows)?),
        })
    }

    /// The end of a slew, s.
    #[must_use]
    pub fn slew_end(&self) -> Option<f64> {
        match self {
            Self::Slew { start, from, to, limits } => {
                Slew::new(*start, *from, *to, limits).ok().map(|slew| slew.end())
            }
            Self::Hold(_) | Self::Turning { .. } | Self::Table(_) => None,
        }
    }
}
