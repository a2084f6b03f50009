//! Newton's law for point masses, and d'Alembert's principle: the accelerations of every kind, and
//! of a mixed set, balance all that acts in every direction in which the spacecraft may move.

use nalgebra::{SMatrix, SVector, Vector3};
use precess_dynamics::kind::Each;
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Dgcmg,
    Dgvscmg, FlexibleReactionWheel, FlexibleVscmg, Gravity, HingedPanel, Mode, ReactionWheel,
    Sgcmg, SloshMass, Vscmg, Wrench,
};
use precess_dynamics::{FixedSet, HubMode};
use precess_point_masses::{Chain, DirectionEquation, PointMasses, Rates};

use super::case::{Case, SEEDS, Solution, World, joints, largest};
use super::devices::Drawn;
use super::mixed::{Mixed, chains, drawn};
use super::random::{Random, errors_of};

/// Largest backward error of the accelerations, in units of the sum of the magnitudes of all terms,
/// so that conditioning does not matter.
const BACKWARD: f64 = 50.0 * f64::EPSILON;

/// Largest median error of accelerations against a reference, of the block.
const ACCELERATIONS_MEDIAN: f64 = 1e-13;

/// Largest error of all. Against a reference in higher precision it is 1e-11; this one has doubles
/// of its own, whose centripetal terms cancel, and as good a conditioning: ten times that.
const ACCELERATIONS_WORST: f64 = 1e-10;

/// Uniform gravity, and a wrench on every body, at random.
pub(crate) fn disturb<D: FixedSet<Scalar = f64>>(case: &mut Case<D>, random: &mut Random) {
    case.inputs.gravity = Gravity::Uniform(random.vector(9.8));
    let mut wrenches = D::all(Wrench::none());
    for wrench in wrenches.values_mut() {
        *wrench = Wrench { force: random.vector(10.0), moment: random.vector(1.0) };
    }
    case.inputs.bodies = Some(wrenches);
}

/// The equations in every direction in which the spacecraft may move.
fn rows<D: FixedSet<Scalar = f64>>(case: &Case<D>, masses: &PointMasses) -> Vec<DirectionEquation> {
    let inputs = &case.inputs;
    let g = match inputs.gravity {
        Gravity::Uniform(g) => g,
        Gravity::None | Gravity::Central { .. } => Vector3::zeros(),
    };
    let hub = inputs.force.iter().chain(inputs.torque_b.iter()).copied();
    let acting: Vec<_> = hub.chain(inputs.motors.values()).collect();
    let wrenches: Vec<_> = inputs.bodies.iter().flat_map(Each::values).collect();
    masses.equations(&g, &acting, &wrenches)
}

/// The largest backward error, `abs(m q'' - h)` in units of the magnitudes of its terms, over all
/// directions that are free.
fn unbalance<D: FixedSet<Scalar = f64>>(case: &Case<D>, masses: &PointMasses) -> f64 {
    assert_eq!(case.inputs.hub, HubMode::Free);
    let Rates { r_b_n_dot: r_b_n_ddot, omega: omega_dot, joints } =
        Rates::of_accelerations(&case.accelerations());
    let found: Vec<_> = r_b_n_ddot.iter().chain(&omega_dot).chain(&joints).copied().collect();
    let driven = case.inputs.modes.values().map(|mode| mode == Mode::Driven);
    let free = [true; 6].into_iter().chain(driven);
    let errors =
        rows(case, masses).into_iter().zip(free).filter(|(_, free)| *free).map(|(row, _)| {
            let DirectionEquation { m, h, magnitudes: (of_m, of_h) } = row;
            let residual = m.iter().zip(&found).map(|(m, q)| m * q).sum::<f64>() - h;
            residual.abs() / (of_m.iter().zip(&found).map(|(m, q)| m * q.abs()).sum::<f64>() + of_h)
        });
    largest(errors)
}

/// Two devices of a kind, with springs, friction, gravity and wrenches on the bodies.
pub(crate) fn pair<K: Drawn>(random: &mut Random) -> (World, Case<[K; 2]>, PointMasses) {
    let world = World::drawn(random);
    let devices = [(); 2].map(|()| K::sprung(random, world.hub.m_b));
    let settings = devices.map(|_| joints::<K>(random)).concat();
    let mut case = world.case(&devices, &settings);
    disturb(&mut case, random);
    let chains: Vec<Chain> = devices.iter().map(Drawn::chain).collect();
    let masses = PointMasses::of_spacecraft(&world.hub, &case.state, chains);
    (world, case, masses)
}

fn balances<K: Drawn>() {
    let error = |random: &mut Random| {
        let (_, case, masses) = pair::<K>(random);
        unbalance(&case, &masses)
    };
    errors_of(SEEDS, error).are_within(BACKWARD);
}

#[test]
fn wheels_balance() {
    balances::<ReactionWheel>();
    balances::<BalancedReactionWheel>();
}

#[test]
fn wheels_on_flexible_bearings_balance() {
    balances::<FlexibleReactionWheel>();
    balances::<FlexibleVscmg>();
}

#[test]
fn single_gimbals_balance() {
    balances::<Vscmg>();
    balances::<Sgcmg>();
    balances::<BalancedVscmg>();
    balances::<BalancedSgcmg>();
}

#[test]
fn double_gimbals_balance() {
    balances::<Dgvscmg>();
    balances::<Dgcmg>();
    balances::<BalancedDgvscmg>();
    balances::<BalancedDgcmg>();
}

#[test]
fn panels_and_slosh_masses_balance() {
    balances::<HingedPanel>();
    balances::<SloshMass>();
}

fn mixed(random: &mut Random) -> (Case<Mixed>, PointMasses) {
    let world = World::drawn(random);
    let (devices, settings) = drawn(random, world.hub.m_b);
    let mut case = world.case(&devices, &settings.concat());
    disturb(&mut case, random);
    let masses = PointMasses::of_spacecraft(&world.hub, &case.state, chains(&devices));
    (case, masses)
}

#[test]
fn mixed_set_balances() {
    let error = |random: &mut Random| {
        let (case, masses) = mixed(random);
        unbalance(&case, &masses)
    };
    errors_of(SEEDS, error).are_within(BACKWARD);
}

/// Directions of the mixed set: the hub's six and nine joints.
const DIRECTIONS: usize = 15;

/// The equations solved; the wheel that its kind prescribes has its acceleration, zero, for one.
fn reference(case: &Case<Mixed>, masses: &PointMasses) -> Solution {
    let rows = rows(case, masses);
    let mut m = SMatrix::<f64, DIRECTIONS, DIRECTIONS>::from_fn(|i, j| rows[i].m[j]);
    let mut h = SVector::<f64, DIRECTIONS>::from_fn(|i, _| rows[i].h);
    for (joint, mode) in case.inputs.modes.values().enumerate() {
        if mode != Mode::Driven {
            m.row_mut(6 + joint).fill(0.0);
            m.column_mut(6 + joint).fill(0.0);
            m[(6 + joint, 6 + joint)] = 1.0;
            h[6 + joint] = 0.0;
        }
    }
    let solved = m.cholesky().expect("positive definite").solve(&h);
    let names = case.craft.joints().map(|(_, info)| info.coordinate);
    Solution {
        r_b_n_ddot: solved.fixed_rows::<3>(0).into_owned(),
        omega_dot: solved.fixed_rows::<3>(3).into_owned(),
        joints: names.zip(solved.iter().skip(6).copied()).collect(),
    }
}

#[test]
fn mixed_set_accelerates_as_its_point_masses_do() {
    let error = |random: &mut Random| {
        let (case, masses) = mixed(random);
        assert_eq!(masses.directions(), DIRECTIONS);
        case.solved().error(&reference(&case, &masses))
    };
    let errors = errors_of(SEEDS, error);
    errors.are_within(ACCELERATIONS_WORST);
    errors.have_median_within(ACCELERATIONS_MEDIAN);
}
