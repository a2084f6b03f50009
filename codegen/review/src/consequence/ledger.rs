//! What should be conserved, at one instant and over a run.
//!
//! Energy less the motors' work, linear momentum and angular momentum about the centre of mass,
//! from the sums over bodies, which no page enters. Units: the largest kinetic energy plus the
//! integral of sum |u rate|; the sum over the bodies of the magnitudes of their momenta, its
//! largest.

use super::state::{INPUTS, State, VELOCITY, plus};
use super::tape::Tape;
use super::{ConsequenceError, Drift};
use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::reference::{BodyInHub, bodies, hub_body, momenta};
use precess_codegen::derivation::share::Momenta;
use precess_codegen::graph::Expr;
use precess_codegen::space::{Hub, Vector};

/// Calculates entries.
pub(super) struct Accountant {
    tape: Tape,
    /// How many bodies there are, the hub among them.
    bodies: usize,
    slots: Vec<f64>,
}

/// Energy and momenta of one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    /// Energy less work, J.
    balance: f64,
    /// Kinetic energy, J.
    energy: f64,
    /// Integral of sum |u rate|, J.
    throughput: f64,
    /// Momenta, inertial components.
    linear: Momentum,
    angular: Momentum,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Momentum {
    total: [f64; 3],
    /// Sum over the bodies of magnitudes.
    unit: f64,
}

impl Accountant {
    /// From the sums over bodies of a chain.
    pub(super) fn new<'g>(chain: &Chain<'g>) -> Result<Self, ConsequenceError> {
        let (total, shares) = momenta_about_c(chain);
        let mut roots = vec![total.energy];
        for share in std::iter::once(&total).chain(&shares) {
            roots.extend(share.linear.components());
            roots.extend(share.angular.components());
        }
        let inputs = [&INPUTS[..], &VELOCITY].concat();
        let tape = Tape::new(chain.graph, &roots, &inputs)?;
        Ok(Self { tape, bodies: shares.len(), slots: Vec::new() })
    }

    /// The entry of a state.
    pub(super) fn entry(&mut self, state: &State) -> Entry {
        let inputs = [&state.inputs()[..], &state.velocity].concat();
        let mut values = self.tape.evaluate(&inputs, &mut self.slots);
        let energy = values.next().unwrap_or(f64::NAN);
        let mut vector = || std::array::from_fn(|_| values.next().unwrap_or(f64::NAN));
        let momentum = |total| Momentum { total: state.inertial(total), unit: 0.0 };
        let (mut linear, mut angular) = (momentum(vector()), momentum(vector()));
        for _ in 0..self.bodies {
            linear.unit += magnitude(vector());
            angular.unit += magnitude(vector());
        }
        let (balance, throughput) = (energy - state.work, state.throughput);
        Entry { balance, energy, throughput, linear, angular }
    }
}

/// Energy, linear momentum and angular momentum about the centre of mass: of the whole, and of the
/// hub and the three bodies.
fn momenta_about_c<'g>(chain: &Chain<'g>) -> (Momenta<'g>, Vec<Momenta<'g>>) {
    let zero = Vector::zero(chain.graph);
    let hub = hub_body(chain);
    let (device, hub_share) = (momenta(chain), of_body(chain, &hub));
    let all: Vec<_> = std::iter::once(hub).chain(bodies(chain)).collect();
    let moment = all.iter().fold(zero, |sum, body| sum + body.mass * body.r);
    let c = chain.hub.m_sc.recip() * moment;
    let about_c = |m: Momenta<'g>| Momenta { angular: m.angular - c.cross(m.linear), ..m };
    let total = Momenta {
        energy: device.energy + hub_share.energy,
        linear: device.linear + hub_share.linear,
        angular: device.angular + hub_share.angular,
    };
    let shares = all.iter().map(|body| about_c(of_body(chain, body)));
    (about_c(total), shares.collect())
}

/// Energy and momenta of one body, about B.
fn of_body<'g>(chain: &Chain<'g>, body: &BodyInHub<'g>) -> Momenta<'g> {
    let omega = chain.hub.omega;
    let velocity: Vector<'g, Hub> =
        chain.hub.r_b_n_dot + body.r.component_rates() + omega.cross(body.r);
    let omega_n = omega + body.omega_b;
    let linear = body.mass * velocity;
    let spin = body.inertia.times(omega_n);
    let half: Expr<'g> = chain.graph.constant(2).recip();
    Momenta {
        energy: half * (velocity.dot(linear) + omega_n.dot(spin)),
        linear,
        angular: spin + body.r.cross(linear),
    }
}

/// How far a run has drifted.
pub(super) struct Ledger {
    start: Entry,
    /// The largest departures, not yet divided by their units.
    departure: Drift,
    units: [f64; 4],
}

impl Ledger {
    /// Opens with the first entry.
    pub(super) fn new(start: Entry) -> Self {
        let mut ledger = Self { start, departure: Drift::default(), units: [0.0; 4] };
        ledger.add(&start);
        ledger
    }

    /// Adds an entry.
    pub(super) fn add(&mut self, entry: &Entry) {
        let start = &self.start;
        let apart = |a: &Momentum, b: &Momentum| magnitude(plus(a.total, -1.0, b.total));
        let Drift { energy, linear, angular } = &mut self.departure;
        *energy = energy.max((entry.balance - start.balance).abs());
        *linear = linear.max(apart(&entry.linear, &start.linear));
        *angular = angular.max(apart(&entry.angular, &start.angular));
        let units = [entry.energy, entry.throughput, entry.linear.unit, entry.angular.unit];
        self.units = std::array::from_fn(|k| self.units[k].max(units[k]));
    }

    /// The largest drift so far.
    pub(super) fn drift(&self) -> Drift {
        let Drift { energy, linear, angular } = self.departure;
        let [kinetic, throughput, linear_unit, angular_unit] = self.units;
        Drift {
            energy: energy / (kinetic + throughput),
            linear: linear / linear_unit,
            angular: angular / angular_unit,
        }
    }
}

impl Entry {
    /// Whether every number is one.
    pub(super) fn is_finite(&self) -> bool {
        let Self { balance, energy, throughput, linear, angular } = self;
        let momentum = |m: &Momentum| m.unit.is_finite() && m.total.iter().all(|x| x.is_finite());
        let scalars = [balance, energy, throughput].into_iter().all(|x| x.is_finite());
        scalars && momentum(linear) && momentum(angular)
    }
}

fn magnitude([x, y, z]: [f64; 3]) -> f64 {
    libm::sqrt(x * x + y * y + z * z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use precess_codegen::graph::Graph;
    use precess_codegen::kinds::DGVSCMG;

    #[test]
    fn the_bodies_add_up_to_the_whole() {
        let g = Graph::new();
        let (total, shares) = momenta_about_c(&Chain::new(&g, &DGVSCMG));
        assert_eq!(shares.len(), 4);
        // Any numbers between one and two, each symbol its own.
        let value =
            |name: &str| name.bytes().fold(0.3, |x, b| (x * 3.7 + f64::from(b)) % 1.0) + 1.0;
        let numbers = |m: &Momenta<'_>| {
            let [_, y, _] = m.linear.components();
            let [x, ..] = m.angular.components();
            [m.energy, y, x].map(|e| e.evaluate(&value))
        };
        let sums = shares.iter().map(numbers).fold([0.0; 3], |sum, share| plus(sum, 1.0, share));
        for (whole, sum) in numbers(&total).into_iter().zip(sums) {
            // The same terms in another order; a few hundred roundings.
            assert!((whole - sum).abs() < 1e-12 * whole.abs(), "{whole} {sum}");
        }
    }

    #[test]
    fn an_entry_with_one_number_that_is_none_is_not_finite() {
        let momentum = Momentum { total: [1.0; 3], unit: 2.0 };
        let right = Entry {
            balance: 1.0,
            energy: 1.0,
            throughput: 1.0,
            linear: momentum,
            angular: momentum,
        };
        assert!(right.is_finite());
        let total = Momentum { total: [1.0, f64::NAN, 1.0], ..momentum };
        let unit = Momentum { unit: f64::INFINITY, ..momentum };
        for wrong in [
            Entry { balance: f64::NAN, ..right },
            Entry { energy: f64::NAN, ..right },
            Entry { throughput: f64::NAN, ..right },
            Entry { linear: total, ..right },
            Entry { linear: unit, ..right },
            Entry { angular: total, ..right },
            Entry { angular: unit, ..right },
        ] {
            assert!(!wrong.is_finite(), "{wrong:?}");
        }
    }

    #[test]
    fn each_drift_is_the_largest_in_its_own_unit() {
        let entry = |balance, energy, x, unit| {
            let linear = Momentum { total: [x, 0.0, 0.0], unit };
            let angular = Momentum { total: [0.0, -x, 0.0], unit: 2.0 * unit };
            Entry { balance, energy, throughput: 1.0, linear, angular }
        };
        let mut ledger = Ledger::new(entry(5.0, 5.0, 0.0, 4.0));
        ledger.add(&entry(3.0, 7.0, 2.0, 3.0));
        ledger.add(&entry(4.0, 3.0, 1.0, 4.0));
        // 2 J of (7 + 1) J, 2 of 4 kg m/s, 2 of 8 kg m^2/s
        assert_eq!(ledger.drift(), Drift { energy: 0.25, linear: 0.5, angular: 0.25 });
    }
}
