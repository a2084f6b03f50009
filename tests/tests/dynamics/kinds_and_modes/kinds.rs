//! Each smaller kind is a larger one with joints locked or prescribed, bodies massless or merged,
//! wheels balanced.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Dgcmg,
    Dgvscmg, ReactionWheel, Sgcmg, Vscmg,
};
use precess_point_masses::{Rigid, turn};

use super::case::{Joint, LIMITS, SEEDS, World, joints};
use super::devices::{
    Drawn, balanced_dgcmg, balanced_dgvscmg, balanced_reaction_wheel, balanced_sgcmg,
    balanced_vscmg, dgcmg, sgcmg,
};
use super::random::{Random, errors_of};

/// Devices per spacecraft: no block is one number that may happen to vanish.
const DEVICES: usize = 3;

/// A device with the settings of its joints, and a body that is merged into the hub.
struct Stated<K> {
    device: K,
    joints: Vec<Joint>,
    left: Option<Rigid>,
}

fn stated<K>(device: K, joints: Vec<Joint>) -> Stated<K> {
    Stated { device, joints, left: None }
}

/// Spacecraft whose devices are drawn as pairs that should be the same: all first ones against all
/// second ones.
fn same_motion<K: Drawn, L: Drawn>(pair: impl Fn(&mut Random, f64) -> (Stated<K>, Stated<L>)) {
    let error = |random: &mut Random| {
        let world = World::drawn(random);
        let (left, right): (Vec<_>, Vec<_>) =
            (0..DEVICES).map(|_| pair(random, world.hub.m_b)).unzip();
        let expected = solved(&world, &left);
        let mut found = solved(&world, &right);
        // Some joints go by another name; a locked one is in neither.
        for ((name, _), (of_other, _)) in found.joints.iter_mut().zip(&expected.joints) {
            *name = of_other;
        }
        found.error(&expected)
    };
    errors_of(SEEDS, error).are_within(LIMITS);
}

fn solved<K: Drawn>(world: &World, all: &[Stated<K>]) -> super::case::Solution {
    let left = all.iter().filter_map(|stated| stated.left);
    let bodies: Vec<_> = std::iter::once(Rigid::of_hub(&world.hub)).chain(left).collect();
    let hub = if bodies.len() == 1 { world.hub } else { Rigid::merged(&bodies).hub() };
    let devices: [K; DEVICES] = std::array::from_fn(|device| all[device].device);
    let settings: Vec<_> = all.iter().flat_map(|stated| stated.joints.clone()).collect();
    world.on(hub).case(&devices, &settings).solved()
}

/// The child body of a gimbal's joint, in the axes and from the origin of the gimbal.
fn outer_gimbal(device: &Dgvscmg) -> Rigid {
    Rigid { mass: device.m_go, centre: device.r_goc_go, inertia: device.i_go_goc }
}

fn inner_gimbal(device: &Dgvscmg) -> Rigid {
    Rigid { mass: device.m_gi, centre: device.r_gic_gi, inertia: device.i_gi_gic }
}

/// A VSCMG as a DGVSCMG with a massless inner gimbal.
fn without_inner_gimbal(device: &Vscmg) -> Dgvscmg {
    let Vscmg { mount, r_g_b, m_g, r_gc_g, i_g_gc, l_g, m_w, d, i_w_wc, .. } = *device;
    let bare = Dgvscmg::bare_wheel(m_w, i_w_wc);
    let outer = Dgvscmg { mount, r_go_b: r_g_b, m_go: m_g, r_goc_go: r_gc_g, ..bare };
    Dgvscmg { i_go_goc: i_g_gc, l_o: l_g, d, ..outer }
}

/// A wheel as a VSCMG with a massless gimbal.
fn without_gimbal(device: &ReactionWheel) -> Vscmg {
    let ReactionWheel { mount, r_w_b, m_w, d, i_w_wc, .. } = *device;
    Vscmg { mount, r_g_b: r_w_b, d, ..Vscmg::bare_wheel(m_w, i_w_wc) }
}

#[test]
fn reaction_wheel_is_a_vscmg_locked_at_zero_with_a_massless_gimbal() {
    same_motion(|random, heaviest| {
        let wheel = ReactionWheel::drawn(random, heaviest);
        let settings = joints::<ReactionWheel>(random);
        let with_gimbal = [vec![Joint::locked(0.0)], settings.clone()].concat();
        (stated(wheel, settings), stated(without_gimbal(&wheel), with_gimbal))
    });
}

#[test]
fn reaction_wheel_is_a_dgvscmg_locked_at_zero_with_massless_gimbals() {
    same_motion(|random, heaviest| {
        let wheel = ReactionWheel::drawn(random, heaviest);
        let settings = joints::<ReactionWheel>(random);
        let device = without_inner_gimbal(&without_gimbal(&wheel));
        let with_gimbals = [vec![Joint::locked(0.0); 2], settings.clone()].concat();
        (stated(wheel, settings), stated(device, with_gimbals))
    });
}

#[test]
fn vscmg_locked_at_any_angle_is_a_reaction_wheel_on_a_hub_with_its_gimbal() {
    same_motion(|random, heaviest| {
        let vscmg = Vscmg::drawn(random, heaviest);
        let mut settings = joints::<Vscmg>(random);
        settings[0] = Joint::locked(settings[0].state[0]);
        let mount = vscmg.mount * turn(&Vector3::z(), settings[0].state[0]);
        let Vscmg { r_g_b, l_g, m_w, d, i_w_wc, .. } = vscmg;
        let r_w_b = r_g_b + mount * l_g;
        let wheel = ReactionWheel { mount, r_w_b, d, ..ReactionWheel::bare_wheel(m_w, i_w_wc) };
        let gimbal = Rigid { mass: vscmg.m_g, centre: vscmg.r_gc_g, inertia: vscmg.i_g_gc };
        let left = Some(gimbal.moved(&r_g_b, &mount));
        (stated(vscmg, settings.clone()), Stated { left, ..stated(wheel, vec![settings[1]]) })
    });
}

#[test]
fn vscmg_is_a_dgvscmg_whose_massless_inner_gimbal_is_locked_at_zero() {
    same_motion(|random, heaviest| {
        let vscmg = Vscmg::drawn(random, heaviest);
        let settings = joints::<Vscmg>(random);
        let double = vec![settings[0], Joint::locked(0.0), settings[1]];
        (stated(vscmg, settings), stated(without_inner_gimbal(&vscmg), double))
    });
}

#[test]
fn body_of_a_vscmg_gimbal_may_stand_in_the_locked_inner_gimbal() {
    same_motion(|random, heaviest| {
        let vscmg = Vscmg::drawn(random, heaviest);
        let Vscmg { mount, r_g_b, m_g, r_gc_g, i_g_gc, l_g, m_w, d, i_w_wc, .. } = vscmg;
        let bare = Dgvscmg { mount, r_go_b: r_g_b, d, ..Dgvscmg::bare_wheel(m_w, i_w_wc) };
        let device = Dgvscmg { m_gi: m_g, r_gic_gi: r_gc_g, i_gi_gic: i_g_gc, l_i: l_g, ..bare };
        let settings = joints::<Vscmg>(random);
        let double = vec![settings[0], Joint::locked(0.0), settings[1]];
        (stated(vscmg, settings), stated(device, double))
    });
}

#[test]
fn dgvscmg_with_its_inner_gimbal_locked_at_zero_is_a_vscmg_with_both_gimbals_as_one() {
    same_motion(|random, heaviest| {
        let double = Dgvscmg::drawn(random, heaviest);
        let mut settings = joints::<Dgvscmg>(random);
        settings[1] = Joint::locked(0.0);
        let inner = inner_gimbal(&double).moved(&double.l_o, &Matrix3::identity());
        let Rigid { mass, centre, inertia } = Rigid::merged(&[outer_gimbal(&double), inner]);
        let Dgvscmg { mount, r_go_b, l_o, l_i, m_w, d, i_w_wc, .. } = double;
        let bare = Vscmg { mount, r_g_b: r_go_b, d, ..Vscmg::bare_wheel(m_w, i_w_wc) };
        let vscmg = Vscmg { m_g: mass, r_gc_g: centre, i_g_gc: inertia, l_g: l_o + l_i, ..bare };
        (stated(double, settings.clone()), stated(vscmg, vec![settings[0], settings[2]]))
    });
}

/// The inner gimbal turns about y, a VSCMG's about z: its axes are the inner gimbal's, a quarter
/// turn back about x, and so is the angle of the wheel, which has to bring its y axis back.
#[test]
fn dgvscmg_with_its_outer_gimbal_locked_at_any_angle_is_a_vscmg_on_a_hub_with_that_gimbal() {
    same_motion(|random, heaviest| {
        let double = Dgvscmg::drawn(random, heaviest);
        let mut settings = joints::<Dgvscmg>(random);
        settings[0] = Joint::locked(settings[0].state[0]);
        let outer = double.mount * turn(&Vector3::z(), settings[0].state[0]);
        // Columns: the VSCMG's axes along those of the inner gimbal; its z is y there.
        let back = Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0);
        let to = back.transpose();
        let Dgvscmg { r_go_b, l_o, l_i, m_w, d, i_w_wc, .. } = double;
        let Rigid { mass, centre, inertia } = inner_gimbal(&double).moved(&Vector3::zeros(), &to);
        let (mount, r_g_b) = (outer * back, r_go_b + outer * l_o);
        let bare = Vscmg { mount, r_g_b, d, ..Vscmg::bare_wheel(m_w, i_w_wc) };
        let vscmg = Vscmg { m_g: mass, r_gc_g: centre, i_g_gc: inertia, l_g: to * l_i, ..bare };
        let mut wheel = settings[2];
        wheel.state[0] += FRAC_PI_2;
        let left = Some(outer_gimbal(&double).moved(&r_go_b, &outer));
        let single = Stated { left, ..stated(vscmg, vec![settings[1], wheel]) };
        (stated(double, settings), single)
    });
}

#[test]
fn sgcmg_is_a_vscmg_whose_wheel_is_prescribed() {
    same_motion(|random, heaviest| {
        let vscmg = Vscmg::drawn(random, heaviest);
        let settings = joints::<Sgcmg>(random);
        (stated(vscmg, settings.clone()), stated(sgcmg(&vscmg), settings))
    });
}

#[test]
fn dgcmg_is_a_dgvscmg_whose_wheel_is_prescribed() {
    same_motion(|random, heaviest| {
        let dgvscmg = Dgvscmg::drawn(random, heaviest);
        let settings = joints::<Dgcmg>(random);
        (stated(dgvscmg, settings.clone()), stated(dgcmg(&dgvscmg), settings))
    });
}

/// Each balanced kind against its imbalanced one on a wheel without imbalance.
macro_rules! balanced_kinds {
    ($($claim:ident: $balanced:ident = $of:ident($made:ident);)*) => {$(
        #[test]
        fn $claim() {
            same_motion(|random, heaviest| {
                let mut made = $made::drawn(random, heaviest);
                let (axial, across) = (made.i_w_wc.m11, made.i_w_wc.m22);
                made.d = 0.0;
                made.i_w_wc = Matrix3::from_diagonal(&Vector3::new(axial, across, across));
                let settings = joints::<$balanced>(random);
                (stated(made, settings.clone()), stated($of(&made), settings))
            });
        }
    )*};
}

balanced_kinds! {
    balanced_reaction_wheel_is_one_without_imbalance:
        BalancedReactionWheel = balanced_reaction_wheel(ReactionWheel);
    balanced_vscmg_is_one_without_imbalance: BalancedVscmg = balanced_vscmg(Vscmg);
    balanced_sgcmg_is_one_without_imbalance: BalancedSgcmg = balanced_sgcmg(Sgcmg);
    balanced_dgvscmg_is_one_without_imbalance: BalancedDgvscmg = balanced_dgvscmg(Dgvscmg);
    balanced_dgcmg_is_one_without_imbalance: BalancedDgcmg = balanced_dgcmg(Dgcmg);
}
