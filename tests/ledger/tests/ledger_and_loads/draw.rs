//! Every kind with random parameters: over the declared ranges, as real bodies have them.
//!
//! Masses log-uniform from 0.1 kg to the hub's; positions and offsets to 3 m; wheels are discs of
//! 0.02 to 0.5 m, tilted by 1e-6 to 0.1 rad, their centres 1e-6 m to a radius off the axis. One
//! imbalanced wheel in four has the simplified model. Two joints in three have spring, damper and
//! Coulomb friction.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::Kind;
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Dgcmg,
    Dgvscmg, Each, FlexibleReactionWheel, FlexibleVscmg, HingedPanel, ImbalanceModel, Passive,
    ReactionWheel, Sgcmg, SloshMass, Vscmg,
};

use super::random::Random;

/// A kind that can be drawn.
pub(crate) trait Drawn: Kind<Scalar = f64> {
    /// Whether its last body is symmetric about its joint: its axes are then its parent body's.
    const ROUND: bool;

    /// A device with no body heavier than this, kg.
    fn drawn(random: &mut Random, heaviest: f64) -> Self;
}

/// The largest motor and friction torques, N m (or N).
pub(crate) const TORQUE: f64 = 10.0;

fn mass(random: &mut Random, heaviest: f64) -> f64 {
    random.log_within(0.1, heaviest)
}

fn position(random: &mut Random) -> Vector3<f64> {
    let length = random.within(0.0, 3.0);
    random.vector(length)
}

fn offset(random: &mut Random) -> Vector3<f64> {
    let length = random.log_within(1e-3, 3.0);
    random.vector(length)
}

fn model(random: &mut Random) -> ImbalanceModel {
    if random.chance(0.25) { ImbalanceModel::Lumped } else { ImbalanceModel::Coupled }
}

/// Springs to 100 N m/rad, dampers to 10 N m s/rad, Coulomb friction to 10 N m.
fn passive<K: Kind<Scalar = f64>>(random: &mut Random) -> K::PerJoint<Passive> {
    let mut all = <K as Kind>::all(Passive::none());
    for passive in all.values_mut() {
        if random.chance(2.0 / 3.0) {
            *passive = Passive {
                stiffness: random.log_within(1e-3, 1.0) * 10.0 * TORQUE,
                rest: random.within(-1.0, 1.0),
                viscous: random.log_within(1e-4, 1.0) * TORQUE,
                coulomb: random.log_within(1e-4, 1.0) * TORQUE,
                coulomb_rate: random.log_within(1e-3, 0.1),
            };
        }
    }
    all
}

/// Mass, inertia, and offset of the centre from the axis.
fn wheel(random: &mut Random, heaviest: f64) -> (f64, Matrix3<f64>, f64) {
    let m_w = mass(random, heaviest);
    let (inertia, radius) = random.tilted_disc(m_w);
    (m_w, inertia, random.log_within(1e-6, radius))
}

/// A wheel on flexible bearings: off its axis by no more than a hundredth of its radius, which is more than
/// bearings would bear of a rotor. Its centripetal force does work at a bearing that slides, and the sums of powers
/// in which this cancels do not hold it.
fn wheel_on_bearings(random: &mut Random, heaviest: f64) -> (f64, Matrix3<f64>, f64) {
    let m_w = mass(random, heaviest);
    let (inertia, radius) = random.tilted_disc(m_w);
    (m_w, inertia, random.log_within(1e-6, radius / 100.0))
}

/// A kind by what each of its fields is drawn as.
macro_rules! drawn {
    ($kind:ident, $round:expr, |$random:ident, $heaviest:ident| { $($given:tt)* } $fields:tt) => {
        impl Drawn for $kind {
            const ROUND: bool = $round;

            fn drawn($random: &mut Random, $heaviest: f64) -> Self {
                $($given)*
                drawn!(@made $kind $random $fields)
            }
        }
    };
    (@made $kind:ident $random:ident { $($field:ident $(: $value:expr)?),* $(,)? }) => {
        Self {
            mount: $random.rotation(),
            $($field $(: $value)?,)*
            passive: passive::<Self>($random),
        }
    };
}

macro_rules! double_gimbals {
    ($($kind:ident),*) => {$(
        drawn!($kind, false, |random, heaviest| {
            let (m_go, m_gi) = (mass(random, heaviest), mass(random, heaviest));
            let (m_w, i_w_wc, d) = wheel(random, heaviest);
        } {
            r_go_b: position(random), m_go, r_goc_go: offset(random), i_go_goc: random.block(m_go),
            l_o: offset(random), m_gi, r_gic_gi: offset(random), i_gi_gic: random.block(m_gi),
            l_i: offset(random), m_w, d, i_w_wc, model: model(random),
        });
    )*};
}

macro_rules! single_gimbals {
    ($($kind:ident),*) => {$(
        drawn!($kind, false, |random, heaviest| {
            let m_g = mass(random, heaviest);
            let (m_w, i_w_wc, d) = wheel(random, heaviest);
        } {
            r_g_b: position(random), m_g, r_gc_g: offset(random), i_g_gc: random.block(m_g),
            l_g: offset(random), m_w, d, i_w_wc, model: model(random),
        });
    )*};
}

macro_rules! balanced_double_gimbals {
    ($($kind:ident),*) => {$(
        drawn!($kind, true, |random, heaviest| {
            let (m_go, m_gi) = (mass(random, heaviest), mass(random, heaviest));
            let m_w = mass(random, heaviest);
            let ([j_11, j_22], _) = random.disc(m_w);
        } {
            r_go_b: position(random), m_go, r_goc_go: offset(random), i_go_goc: random.block(m_go),
            l_o: offset(random), m_gi, r_gic_gi: offset(random), i_gi_gic: random.block(m_gi),
            l_i: offset(random), m_w, j_11, j_22,
        });
    )*};
}

macro_rules! balanced_single_gimbals {
    ($($kind:ident),*) => {$(
        drawn!($kind, true, |random, heaviest| {
            let (m_g, m_w) = (mass(random, heaviest), mass(random, heaviest));
            let ([j_11, j_22], _) = random.disc(m_w);
        } {
            r_g_b: position(random), m_g, r_gc_g: offset(random), i_g_gc: random.block(m_g),
            l_g: offset(random), m_w, j_11, j_22,
        });
    )*};
}

double_gimbals!(Dgvscmg, Dgcmg);
single_gimbals!(Vscmg, Sgcmg);
balanced_double_gimbals!(BalancedDgvscmg, BalancedDgcmg);
balanced_single_gimbals!(BalancedVscmg, BalancedSgcmg);
drawn!(ReactionWheel, false, |random, heaviest| {
    let (m_w, i_w_wc, d) = wheel(random, heaviest);
} { r_w_b: position(random), m_w, d, i_w_wc, model: model(random) });
drawn!(FlexibleReactionWheel, false, |random, heaviest| {
    let (m_w, i_w_wc, d) = wheel_on_bearings(random, heaviest);
} { r_sx_b: position(random), m_w, d, i_w_wc, model: model(random) });
drawn!(FlexibleVscmg, false, |random, heaviest| {
    let (m_w, i_w_wc, d) = wheel_on_bearings(random, heaviest);
    // A gimbal holds the bearings, their housing and the motor: at least a third of the rotor's mass.
    let m_g = random.log_within(m_w / 3.0, m_w.max(heaviest));
} {
    r_g_b: position(random), m_g, r_gc_g: offset(random), i_g_gc: random.block(m_g),
    l_g: offset(random), m_w, d, i_w_wc, model: model(random),
});
drawn!(BalancedReactionWheel, true, |random, heaviest| {
    let m_w = mass(random, heaviest);
    let ([j_11, j_22], _) = random.disc(m_w);
} { r_w_b: position(random), m_w, j_11, j_22 });
drawn!(HingedPanel, false, |random, heaviest| {
    let m_p = mass(random, heaviest);
} { r_p_b: position(random), m_p, r_pc_p: offset(random), i_p_pc: random.block(m_p) });
drawn!(SloshMass, false, |random, heaviest| {} {
    r_s_b: position(random), m_s: mass(random, heaviest)
});
