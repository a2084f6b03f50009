//! Accelerations, energy, momenta and loads of random isolated clusters against the tree of bodies.

use nalgebra::Vector3;
use precess_dynamics::{About, Devices, Each, Gravity, LoadAxes, Wrench};
use precess_tests::bounds::{
    ACCELERATIONS_MEDIAN, ACCELERATIONS_WORST, BACKWARD_EPSILONS, POWER_EPSILONS, SPACECRAFT,
};
use precess_tests::cases;

use crate::craft::{Craft, Options, cluster, mixed, stacked};
use crate::panels::rows;
use crate::tree::Solved;

/// Seeds of each set and each choice of options.
const SEEDS: u64 = 40;

/// The rounding of a sum of terms, of the sum of their magnitudes.
const ROUNDING: f64 = BACKWARD_EPSILONS * f64::EPSILON;

/// Energy and momenta are sums of some tens of products; in units of the sum of magnitudes.
const SUMS: f64 = 1e-13;

fn all_options() -> [Options; 6] {
    let gravity = Some(Gravity::Central { mu: 4000.0 });
    let uniform = Some(Gravity::Uniform(Vector3::new(0.3, -9.0, 2.0)));
    let none = Options::default();
    [
        none,
        Options { springs: true, dry: true, ..none },
        Options { wrenches: true, modes: true, ..none },
        Options { gravity, ..none },
        Options { gravity: uniform, springs: true, ..none },
        Options { gravity, springs: true, dry: true, wrenches: true, modes: true, soft: false },
    ]
}

/// Runs a check on every set, with every choice of options.
macro_rules! everywhere {
    ($check:ident) => {
        for (number, options) in all_options().iter().enumerate() {
            for seed in 0..cases(SEEDS) {
                let what = format!("options {number}, seed {seed}");
                $check(&cluster(seed, options), &format!("cluster, {what}"));
                $check(&mixed(seed, options), &format!("mixed, {what}"));
                $check(&stacked(seed, options), &format!("stacked, {what}"));
                $check(&rows(seed, options), &format!("rows of panels, {what}"));
            }
        }
    };
}

/// Two solutions of the same equations, each with the backward error that is asserted of the
/// solver, differ by as much as the mass matrix makes of both.
fn accelerations_agree<D: Devices<Scalar = f64>>(of: &Craft<D>, what: &str) {
    let found = of.solver.accelerations(&of.state, &of.inputs).expect("regular");
    let Solved { a, alpha, joints, conditions } = of.tree.accelerations();
    let axes = of.tree.axes;
    let (r, omega) = (axes * found.r_b_n_ddot, axes * found.omega_dot);
    let found = r.iter().chain(&omega).copied().chain(found.devices.values());
    let expected = a.iter().chain(&alpha).chain(&joints);
    for (row, ((found, expected), condition)) in found.zip(expected).zip(conditions).enumerate() {
        let bound = 2.0 * ROUNDING * condition;
        let off = (found - expected).abs();
        assert!(off <= bound, "{what}: row {row}: {found}, not {expected}: {off:e} of {bound:e}");
    }
}

#[test]
fn accelerations_are_those_of_the_tree() {
    everywhere!(accelerations_agree);
}

/// Differences from the judge in double-double, of each block's largest magnitude.
struct Distances(Vec<f64>);

impl Distances {
    fn add<D: Devices<Scalar = f64>>(&mut self, of: &Craft<D>) {
        let found = of.solver.accelerations(&of.state, &of.inputs).expect("regular");
        let hub = found.r_b_n_ddot.iter().chain(&found.omega_dot).copied();
        let found: Vec<f64> = hub.chain(found.devices.values()).collect();
        let expected = crate::judge::accelerations(of);
        // Accelerations along sliding joints and about turning ones are different quantities.
        let slides = |index: usize| index >= 6 && of.tree.links[index - 6].info.slides;
        let block = |which: usize| {
            (0..found.len()).filter(move |index| match which {
                0 => *index < 3,
                1 => (3..6).contains(index),
                _ => *index >= 6 && slides(*index) == (which == 2),
            })
        };
        for which in 0..4 {
            let unit = block(which).map(|i| expected[i].abs()).fold(0.0, f64::max);
            let off = block(which).map(|i| (found[i] - expected[i]).abs()).fold(0.0, f64::max);
            if unit > 0.0 {
                self.0.push(off / unit);
            }
        }
    }
}

#[test]
fn accelerations_are_those_of_the_judge_in_double_double() {
    let mut distances = Distances(Vec::new());
    // Dry friction switches where rates pass zero: the judge has none.
    let options = all_options().map(|options| Options { dry: false, ..options });
    for (seed, options) in (0..cases(SPACECRAFT)).zip(options.iter().cycle()) {
        match seed / 6 % 4 {
            0 => distances.add(&cluster(seed, options)),
            1 => distances.add(&mixed(seed, options)),
            2 => distances.add(&stacked(seed, options)),
            _ => distances.add(&rows(seed, options)),
        }
    }
    let mut sorted = distances.0;
    sorted.sort_by(f64::total_cmp);
    let (worst, median) = (sorted[sorted.len() - 1], sorted[sorted.len() / 2]);
    println!("worst {worst:.1e}, median {median:.1e}");
    assert!(worst <= ACCELERATIONS_WORST, "worst {worst:e}");
    assert!(median <= ACCELERATIONS_MEDIAN, "median {median:e}");
}

/// Newton and Euler of every body hold with the accelerations found, to the rounding of their
/// terms.
fn residual_is_rounding<D: Devices<Scalar = f64>>(of: &Craft<D>, what: &str) {
    let found = of.solver.accelerations(&of.state, &of.inputs).expect("regular");
    let joints: Vec<f64> = found.devices.values().collect();
    let axes = of.tree.axes;
    let needed = of.tree.needed(axes * found.r_b_n_ddot, axes * found.omega_dot, &joints);
    let (torques, sizes) = (of.tree.torques(), of.tree.torque_sizes());
    let [force, moment] = needed.hub;
    let hub = force.iter().chain(&moment).enumerate().map(|(row, value)| (row, *value, "hub"));
    let links = of.tree.links.iter().zip(needed.joints.iter().zip(&torques)).enumerate();
    let driven = links.filter(|(_, (link, _))| link.mode == precess_dynamics::Mode::Driven);
    let joints =
        driven.map(|(row, (link, (needed, torque)))| (6 + row, needed - torque, link.info.body));
    for (row, residual, name) in hub.chain(joints) {
        let size = needed.sizes[row] + sizes.get(row.wrapping_sub(6)).unwrap_or(&0.0);
        let bound = ROUNDING * size;
        assert!(residual.abs() <= bound, "{what}: row {row}, {name}: {residual:e} of {size:e}");
    }
}

#[test]
fn backward_error_is_rounding() {
    everywhere!(residual_is_rounding);
}

fn sums_agree<D: Devices<Scalar = f64>>(of: &Craft<D>, what: &str) {
    let totals = of.tree.totals();
    let energy = of.solver.energy(&of.state).expect("finite");
    let off = (energy - totals.energy).abs() / totals.energy;
    assert!(off <= SUMS, "{what}: energy {energy}, not {}: {off:e}", totals.energy);
    let momentum = of.solver.momentum(&of.state, About::InertialOrigin).expect("finite");
    let unit = totals.mass * of.state.r_b_n_dot.norm();
    assert!((momentum.linear - totals.linear).norm() <= SUMS * unit, "{what}: momentum");
    let unit = totals.angular.norm() + unit * of.state.r_b_n.norm();
    assert!((momentum.angular - totals.angular).norm() <= SUMS * unit, "{what}: angular momentum");
    let centre = of.solver.centre_of_mass(&of.state).expect("finite");
    let at = of.tree.r + of.tree.axes * centre.c;
    let expected = totals.first_moment / totals.mass;
    assert!((at - expected).norm() <= SUMS * expected.norm(), "{what}: centre of mass");
    let prime = of.state.omega.cross(&centre.c) + centre.c_prime;
    let velocity = of.tree.v + of.tree.axes * prime;
    let expected = totals.linear / totals.mass;
    assert!((velocity - expected).norm() <= 100.0 * SUMS, "{what}: velocity of the centre");
    assert!((of.solver.mass() - totals.mass).abs() <= SUMS * totals.mass, "{what}: mass");
}

#[test]
fn energy_momenta_and_centre_of_mass_are_those_of_the_tree() {
    everywhere!(sums_agree);
}

fn loads_agree<D: Devices<Scalar = f64, Per<precess_dynamics::set::Loads>: AllLoads>>(
    of: &Craft<D>,
    what: &str,
) {
    let found = of.solver.accelerations(&of.state, &of.inputs).expect("regular");
    let joints: Vec<f64> = found.devices.values().collect();
    let axes = of.tree.axes;
    let tree = crate::tree::Tree { lines: Vec::new(), ..of.tree.clone() };
    let needed = tree.needed(axes * found.r_b_n_ddot, axes * found.omega_dot, &joints);
    let less_struts =
        of.tree.needed(axes * found.r_b_n_ddot, axes * found.omega_dot, &joints).joints;
    let passive = of.tree.torques();
    let moving = of.tree.motion(Vector3::zeros(), Vector3::zeros(), &joints);
    for choice in [LoadAxes::Body, LoadAxes::Parent, LoadAxes::Hub, LoadAxes::Inertial] {
        let loads = of.solver.loads(&of.state, &of.inputs, &found, choice).expect("finite");
        let (all, motors) = (loads.devices.wrenches(), loads.devices.motors());
        assert_eq!(all.len(), of.tree.links.len());
        let mut mounts = loads.devices.mounts().into_iter();
        for (index, link) in of.tree.links.iter().enumerate() {
            let parent = moving[link.base.map_or(0, |base| base + 1)].axes * link.mount;
            let own = moving[index + 1].axes;
            let to = match choice {
                LoadAxes::Body => nalgebra::Matrix3::identity(),
                LoadAxes::Parent => parent.transpose() * own,
                LoadAxes::Hub => axes.transpose() * own,
                LoadAxes::Inertial => own,
            };
            let [force, moment] = needed.wrenches[index].map(|v| to * v);
            let name = link.info.body;
            let [of_force, of_moment] = needed.wrench_sizes[index];
            let load = &all[index];
            let (of_force, of_moment) = (ROUNDING * of_force, ROUNDING * of_moment);
            let off = (load.force - force).norm();
            assert!(
                off <= of_force,
                "{what}: {choice:?}, force of {name}: {off:e} of {of_force:e}"
            );
            let off = (load.moment - moment).norm();
            assert!(off <= of_moment, "{what}: {choice:?} of {name}: {off:e} of {of_moment:e}");
            if link.info.index == 0 {
                // In the axes of the base, of B or of N.
                let base = moving[link.base.map_or(0, |base| base + 1)].axes;
                let to = match choice {
                    LoadAxes::Body | LoadAxes::Parent => base.transpose() * own,
                    LoadAxes::Hub => axes.transpose() * own,
                    LoadAxes::Inertial => own,
                };
                let mount = mounts.next().expect("a device");
                // About the place of the device or platform, which a sliding joint leaves.
                let slid = if link.info.slides {
                    to * Vector3::ith(link.info.axis, link.q)
                } else {
                    Vector3::zeros()
                };
                let [force, moment] = needed.wrenches[index].map(|v| to * v);
                let moment = moment + slid.cross(&force);
                let of_moment = of_moment + slid.norm() * of_force;
                let off = (mount.force - force).norm();
                assert!(off <= of_force, "{what}: {choice:?}, mount of {name}: {off:e}");
                let off = (mount.moment - moment).norm();
                assert!(off <= of_moment, "{what}: {choice:?}, moment at {name}: {off:e}");
            }
            let motor = less_struts[index] - (passive[index] - link.motor);
            let off = (motors[index] - motor).abs();
            let size = needed.sizes[6 + index] + of.tree.torque_sizes()[index];
            let bound = ROUNDING * size;
            assert!(off <= bound, "{what}: motor of {name}: {off:e} of {bound:e}");
        }
    }
}

/// The loads of every joint of a set, in order.
pub(crate) trait AllLoads {
    fn wrenches(&self) -> Vec<Wrench>;
    fn motors(&self) -> Vec<f64>;
    /// Of every device.
    fn mounts(&self) -> Vec<Wrench>;
}

impl<W: Each<Wrench>, U: Each<f64>, P> AllLoads for precess_dynamics::DeviceLoads<W, U, P, f64> {
    fn wrenches(&self) -> Vec<Wrench> {
        self.joints.values().collect()
    }

    fn mounts(&self) -> Vec<Wrench> {
        vec![self.mount]
    }

    fn motors(&self) -> Vec<f64> {
        self.motors.values().collect()
    }
}

impl<P: AllLoads, C: AllLoads> AllLoads for precess_dynamics::platform::Data<P, C> {
    fn wrenches(&self) -> Vec<Wrench> {
        [self.carrier.wrenches(), self.carried.wrenches()].concat()
    }

    fn mounts(&self) -> Vec<Wrench> {
        [self.carrier.mounts(), self.carried.mounts()].concat()
    }

    fn motors(&self) -> Vec<f64> {
        [self.carrier.motors(), self.carried.motors()].concat()
    }
}

impl<P: AllLoads, const N: usize> AllLoads for [P; N] {
    fn wrenches(&self) -> Vec<Wrench> {
        self.iter().flat_map(P::wrenches).collect()
    }

    fn mounts(&self) -> Vec<Wrench> {
        self.iter().flat_map(P::mounts).collect()
    }

    fn motors(&self) -> Vec<f64> {
        self.iter().flat_map(P::motors).collect()
    }
}

impl<A: AllLoads, B: AllLoads> AllLoads for (A, B) {
    fn wrenches(&self) -> Vec<Wrench> {
        [self.0.wrenches(), self.1.wrenches()].concat()
    }

    fn mounts(&self) -> Vec<Wrench> {
        [self.0.mounts(), self.1.mounts()].concat()
    }

    fn motors(&self) -> Vec<f64> {
        [self.0.motors(), self.1.motors()].concat()
    }
}

impl<A: AllLoads, B: AllLoads, C: AllLoads> AllLoads for (A, B, C) {
    fn wrenches(&self) -> Vec<Wrench> {
        [self.0.wrenches(), self.1.wrenches(), self.2.wrenches()].concat()
    }

    fn mounts(&self) -> Vec<Wrench> {
        [self.0.mounts(), self.1.mounts(), self.2.mounts()].concat()
    }

    fn motors(&self) -> Vec<f64> {
        [self.0.motors(), self.1.motors(), self.2.motors()].concat()
    }
}

#[test]
fn loads_are_those_of_the_tree() {
    everywhere!(loads_agree);
}

/// The ledger's two sides agree to rounding, and its sources are what they say.
fn ledger_balances<D: Devices<Scalar = f64>>(of: &Craft<D>, what: &str) {
    let found = of.solver.accelerations(&of.state, &of.inputs).expect("regular");
    let ledger = of.solver.ledger(&of.state, &of.inputs, &found).expect("finite");
    // The terms of every row times its rate.
    let joints: Vec<f64> = found.devices.values().collect();
    let axes = of.tree.axes;
    let needed = of.tree.needed(axes * found.r_b_n_ddot, axes * found.omega_dot, &joints);
    let rates = of.tree.links.iter().map(|link| link.rate.abs());
    let rates = [of.tree.v.norm(); 3].into_iter().chain([of.tree.omega.norm(); 3]).chain(rates);
    let terms: f64 = needed.sizes.iter().zip(rates).map(|(size, rate)| size * rate).sum();
    let bound = POWER_EPSILONS * f64::EPSILON * (terms + ledger.magnitude);
    assert!(ledger.residual.abs() <= bound, "{what}: {:e} of {bound:e}", ledger.residual);
    let totals = of.tree.totals();
    assert!((ledger.kinetic - totals.energy).abs() <= SUMS * totals.energy, "{what}: kinetic");
    let rates = of.tree.rates(axes * found.r_b_n_ddot, axes * found.omega_dot, &joints);
    let [kinetic, gravity, potential] = rates;
    let near = |found: f64, expected: f64, unit: f64, name: &str| {
        let (off, bound) = ((found - expected).abs(), ROUNDING * unit);
        assert!(off <= bound, "{what}: {name} {found}, not {expected}: {off:e} of {bound:e}");
    };
    near(ledger.kinetic_rate, kinetic, terms + ledger.magnitude, "dT/dt");
    near(ledger.power.gravity, gravity, terms + ledger.magnitude, "power of gravity");
    let weight = totals.mass * of.tree.field.at_b.norm() * (of.tree.r.norm() + 3.0);
    near(ledger.gravity, potential, weight + ledger.gravity.abs(), "potential energy");
    let stored: f64 = of.tree.stored();
    near(ledger.springs, stored, of.tree.stored_size() + stored, "energy of the springs");
}

#[test]
fn ledger_balances_and_its_rates_are_those_of_the_energies() {
    everywhere!(ledger_balances);
}
