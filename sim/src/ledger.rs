//! The conserved quantities of a run and how far they drift.
//!
//! Energy less work, linear momentum and angular momentum about the inertial origin are constant
//! as long as no force or torque acts from outside; motors inside change none of them. Drift is
//! counted in units that cannot vanish by cancellation: the largest kinetic energy plus the
//! integral of sum |u * rate|, and for each momentum the sum over the bodies of magnitudes.

use nalgebra::Vector3;
use precess_dynamics::{About, SolveError, Spacecraft};

use crate::bodies;
use crate::packing::Packed;
use crate::scenario::{Scenario, Set};

/// Energy, work and momentum at one instant.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// Time since the start, s.
    pub time: f64,
    /// Kinetic energy, J.
    pub energy: f64,
    /// Work since the start, integral of `F.v_B + L_B.omega + sum(u * rate)`, J.
    pub work: f64,
    /// Integral of sum |u * rate| since the start, J.
    pub throughput: f64,
    /// Linear momentum, N axes, kg m/s.
    pub linear: Vector3<f64>,
    /// Angular momentum about the inertial origin, N axes, kg m^2/s.
    pub angular: Vector3<f64>,
    /// Sum over the bodies of the magnitudes of their linear momenta, kg m/s.
    pub linear_unit: f64,
    /// Sum over the bodies of the magnitudes of their angular momenta, kg m^2/s.
    pub angular_unit: f64,
}

impl Entry {
    pub(crate) fn new<const N: usize>(
        time: f64,
        packed: &Packed<N>,
        spacecraft: &Spacecraft<Set<N>>,
        scenario: &Scenario<N>,
    ) -> Result<Self, SolveError> {
        let state = packed.state();
        let momentum = spacecraft.momentum(&state, About::InertialOrigin)?;
        let bodies = bodies::momenta(&scenario.hub, &scenario.devices, &state);
        Ok(Self {
            time,
            energy: spacecraft.energy(&state)?,
            work: packed.work(),
            throughput: packed.throughput(),
            linear: momentum.linear,
            angular: momentum.angular,
            linear_unit: bodies.iter().map(|b| b.linear.norm()).sum(),
            angular_unit: bodies.iter().map(|b| b.angular.norm()).sum(),
        })
    }
}

/// Entries in the order of time, the first one at the start.
#[derive(Clone, Debug, Default)]
pub struct Ledger {
    /// The entries.
    pub entries: Vec<Entry>,
}

/// Departure from the start, each part in its own unit (see the module).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drift {
    /// |energy - work - initial energy|, unit: largest kinetic energy + integral of sum |u * rate|.
    pub energy: f64,
    /// |linear momentum - initial|, unit: sum over the bodies of magnitudes, its largest.
    pub linear: f64,
    /// |angular momentum - initial| about the inertial origin, unit: as for the linear one.
    pub angular: f64,
}

impl Ledger {
    /// The drift at each entry.
    pub fn drifts(&self) -> impl Iterator<Item = (f64, Drift)> + '_ {
        let most = |of: fn(&Entry) -> f64| self.entries.iter().map(of).fold(0.0, f64::max);
        let unit = Drift {
            energy: most(|e| e.energy) + most(|e| e.throughput),
            linear: most(|e| e.linear_unit),
            angular: most(|e| e.angular_unit),
        };
        let start = self.entries.first();
        self.entries.iter().zip(start.into_iter().cycle()).map(move |(e, s)| {
            let energy = (e.energy - e.work) - (s.energy - s.work);
            let drift = Drift {
                energy: share(energy.abs(), unit.energy),
                linear: share((e.linear - s.linear).norm(), unit.linear),
                angular: share((e.angular - s.angular).norm(), unit.angular),
            };
            (e.time, drift)
        })
    }

    /// The largest drift of each quantity over the run.
    #[must_use]
    pub fn drift(&self) -> Drift {
        self.drifts().fold(Drift::default(), |most, (_, d)| Drift {
            energy: larger(most.energy, d.energy),
            linear: larger(most.linear, d.linear),
            angular: larger(most.angular, d.angular),
        })
    }
}

/// The larger of two, and NaN once one of them is: a drift that is no number is no small drift.
fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// Nothing moves and nothing drifts: no drift, not 0/0. A NaN stays one.
fn share(drift: f64, unit: f64) -> f64 {
    if drift == 0.0 { 0.0 } else { drift / unit }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(energy: f64, work: f64, momentum: f64) -> Entry {
        let vector = Vector3::new(momentum, 0.0, 0.0);
        Entry {
            time: 0.0,
            energy,
            work,
            throughput: 1.0,
            linear: vector,
            angular: -vector,
            linear_unit: 4.0,
            angular_unit: 8.0,
        }
    }

    #[test]
    fn energy_that_work_explains_is_no_drift() {
        let ledger = Ledger { entries: vec![entry(1.0, 0.0, 0.0), entry(3.0, 2.0, 0.0)] };
        assert_eq!(ledger.drift(), Drift::default());
    }

    #[test]
    fn each_drift_is_counted_in_its_own_unit() {
        let ledger = Ledger { entries: vec![entry(1.0, 0.0, 0.0), entry(3.0, 1.0, 2.0)] };
        // 1 J of (3 + 1) J, 2 of 4 kg m/s, 2 of 8 kg m^2/s
        assert_eq!(ledger.drift(), Drift { energy: 0.25, linear: 0.5, angular: 0.25 });
    }

    #[test]
    fn a_drift_that_is_no_number_is_not_overlooked() {
        let entries = vec![entry(1.0, 0.0, 0.0), entry(1.0, f64::NAN, 0.0), entry(1.0, 0.0, 0.0)];
        assert!(Ledger { entries }.drift().energy.is_nan());
    }
}
