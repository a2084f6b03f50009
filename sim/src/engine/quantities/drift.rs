//! [`Conserved`]: energy less work and both momenta, and how far they drift; by running maxima, so
//! that memory does not grow with the run.
//!
//! Drift is counted in units that cannot vanish by cancellation: for each momentum the sum over the
//! bodies of the magnitudes of all terms, as `m (|v_B| + |omega x c|)`, its largest; for energy the
//! same sum of the kinetic energy, its largest, plus the integral of sum |u * rate|. Bodies of a
//! flexible structure are where they are undeformed, and each of its modes is a term. The units
//! are those at the end of the run: drift is the largest departure over the final unit, which is
//! what the largest share of any entry would be.

use nalgebra::Vector3;
use precess_dynamics::{About, EnergyAndMomentum, Gravity, HubMode, Momentum, SolveError};

use crate::engine::equations::kinematics::{Sizes, magnitude, momenta};
use crate::engine::equations::system::{System, lumped};
use crate::engine::integration::Moment;
use crate::record::Drift;
use crate::scenario::Scenario;
use precess_craft::{CraftAccelerations, CraftInputs, CraftState};

/// Running maxima of departures and units.
#[derive(Clone, Debug)]
pub(crate) struct Conserved {
    /// Whether momentum is conserved.
    isolated: bool,
    start: Option<Entry>,
    departures: [f64; 3],
    /// Largest sums of the magnitudes of the terms of energy and momenta; largest throughput.
    sizes: Sizes,
    throughput: f64,
}

/// What is compared with the start.
#[derive(Clone, Copy, Debug)]
struct Entry {
    energy: f64,
    linear: Vector3<f64>,
    angular: Vector3<f64>,
}

impl Conserved {
    pub(crate) fn new(scenario: &Scenario, system: &System<'_>) -> Self {
        let isolated = scenario.gravity == Gravity::None
            && scenario.hub_mode == HubMode::Free
            && !system.acting.has_wrenches()
            && !lumped(scenario);
        Self {
            isolated,
            start: None,
            departures: [0.0; 3],
            sizes: Sizes::default(),
            throughput: 0.0,
        }
    }

    /// Enters a moment; `lost` is the energy that brakes have taken so far, J.
    pub(crate) fn enter(
        &mut self,
        scenario: &Scenario,
        system: &System<'_>,
        time: f64,
        moment: &Moment,
        lost: f64,
    ) -> Result<(), SolveError> {
        let Moment { state, integrals: [work, throughput] } = moment;
        let ([kinetic, potential], momentum) = energies(system, time, state, None)?;
        let mut entry = Entry {
            energy: kinetic + potential + lost - work,
            linear: Vector3::zeros(),
            angular: Vector3::zeros(),
        };
        let sizes = sizes(scenario, system, state);
        self.sizes = Sizes {
            linear: larger(self.sizes.linear, sizes.linear),
            angular: larger(self.sizes.angular, sizes.angular),
            kinetic: larger(larger(self.sizes.kinetic, kinetic), sizes.kinetic),
        };
        self.throughput = larger(self.throughput, *throughput);
        if self.isolated {
            let Momentum { linear, angular } = match momentum {
                Some(momentum) => momentum,
                None => system.craft.momentum(state, About::InertialOrigin)?,
            };
            (entry.linear, entry.angular) = (linear, angular);
        }
        let start = *self.start.get_or_insert(entry);
        let departures = [
            (entry.energy - start.energy).abs(),
            magnitude(&(entry.linear - start.linear)),
            magnitude(&(entry.angular - start.angular)),
        ];
        for (largest, departure) in self.departures.iter_mut().zip(departures) {
            *largest = larger(*largest, departure);
        }
        Ok(())
    }

    /// The largest drift of each quantity so far.
    pub(crate) fn drift(&self) -> Drift {
        let [energy, linear, angular] = self.departures;
        let of_momentum = |departure, unit| self.isolated.then(|| share(departure, unit));
        Drift {
            energy: Some(share(energy, self.sizes.kinetic + self.throughput)),
            linear: of_momentum(linear, self.sizes.linear),
            angular: of_momentum(angular, self.sizes.angular),
        }
    }
}

/// Sums of the magnitudes of the terms of energy and momenta at a state.
fn sizes(scenario: &Scenario, system: &System<'_>, state: &CraftState) -> Sizes {
    let mut sum = Sizes::default();
    momenta(&scenario.hub, system.acting.chains(), state, |body| {
        sum.linear += body.sizes.linear;
        sum.angular += body.sizes.angular;
        sum.kinetic += body.sizes.kinetic;
    });
    let far = magnitude(&state.r_b_n);
    let modes = scenario.structure.iter().flat_map(|structure| &structure.modes);
    for (mode, rate) in modes.zip(&state.modal.eta_dot) {
        let linear = magnitude(&(mode.linear * *rate));
        sum.linear += linear;
        sum.angular += far * linear + magnitude(&(mode.angular * *rate));
        sum.kinetic += 0.5 * rate * rate;
    }
    sum
}

/// Inputs at a state and the accelerations that follow from them.
pub(crate) type Evaluated<'a> = (&'a CraftInputs, &'a CraftAccelerations);

/// Kinetic energy, and potential energy of gravity and springs, J; and momenta about the inertial
/// origin, if they come of the same pass over the bodies. `evaluated` is what is known already of
/// this time and state.
pub(crate) fn energies(
    system: &System<'_>,
    time: f64,
    state: &CraftState,
    evaluated: Option<Evaluated<'_>>,
) -> Result<([f64; 2], Option<Momentum>), SolveError> {
    let craft = &system.craft;
    if !system.has_potential() {
        let EnergyAndMomentum { energy, momentum } =
            craft.energy_and_momentum(state, About::InertialOrigin)?;
        return Ok(([energy, 0.0], Some(momentum)));
    }
    let ledger = if let Some((inputs, found)) = evaluated {
        craft.ledger(state, inputs, found)?
    } else {
        let inputs = system.inputs(time, state);
        let found = craft.accelerations(state, &inputs)?;
        system.count(1);
        craft.ledger(state, &inputs, &found)?
    };
    Ok(([ledger.kinetic, ledger.gravity + ledger.springs], None))
}

/// The larger of two, and NaN once one of them is: a drift that is no number is no small drift.
fn larger(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// Nothing moves and nothing drifts: no drift, not 0/0. A NaN stays one.
fn share(departure: f64, unit: f64) -> f64 {
    if departure == 0.0 { 0.0 } else { departure / unit }
}
