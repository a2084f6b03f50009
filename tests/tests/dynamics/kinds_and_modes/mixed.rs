//! Mixed sets: the order and the nesting of a tuple change only rounding, and kinds that are
//! special cases may be replaced by DGVSCMGs.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    BalancedDgvscmg, Devices, Dgvscmg, HingedPanel, ReactionWheel, Sgcmg, SloshMass,
};
use precess_point_masses::Chain;
use precess_tests::cases;

use super::case::{Joint, LIMITS, SEEDS, Solution, World, joints};
use super::devices::Drawn;
use super::random::{Random, errors_of};

/// Five kinds, nested; nine joints.
pub(crate) type Mixed = ([ReactionWheel; 2], Sgcmg, BalancedDgvscmg, (HingedPanel, SloshMass));

/// Settings of the joints, device by device.
pub(crate) type Settings = [Vec<Joint>; 6];

/// The set at random, with springs and friction.
pub(crate) fn drawn(random: &mut Random, heaviest: f64) -> (Mixed, Settings) {
    let wheels = [(); 2].map(|()| ReactionWheel::sprung(random, heaviest));
    let sgcmg = Sgcmg::sprung(random, heaviest);
    let double = BalancedDgvscmg::sprung(random, heaviest);
    let appendages = (HingedPanel::sprung(random, heaviest), SloshMass::sprung(random, heaviest));
    let settings = [
        joints::<ReactionWheel>(random),
        joints::<ReactionWheel>(random),
        joints::<Sgcmg>(random),
        joints::<BalancedDgvscmg>(random),
        joints::<HingedPanel>(random),
        joints::<SloshMass>(random),
    ];
    ((wheels, sgcmg, double, appendages), settings)
}

/// The devices as bodies in a row, in order.
pub(crate) fn chains((wheels, sgcmg, double, (panel, slosh)): &Mixed) -> Vec<Chain> {
    let [first, second] = wheels;
    vec![first.chain(), second.chain(), sgcmg.chain(), double.chain(), panel.chain(), slosh.chain()]
}

/// Solves a set whose devices are those of the mixed one in another order, and returns their joints
/// in the order of the mixed one.
fn reordered<D: Devices<Scalar = f64>>(
    world: &World,
    devices: &D,
    settings: &Settings,
    order: [usize; 6],
) -> Solution {
    let here: Vec<_> = order.iter().flat_map(|device| settings[*device].clone()).collect();
    let mut found = world.case(devices, &here).solved();
    let mut from = found.joints.into_iter();
    let mut of_device: [Vec<_>; 6] = Default::default();
    for device in order {
        of_device[device] = from.by_ref().take(settings[device].len()).collect();
    }
    found.joints = of_device.concat();
    found
}

/// The mixed set against what becomes of it.
fn same_motion(other: impl Fn(&World, &Mixed, &Settings) -> Solution) {
    let error = |random: &mut Random| {
        let world = World::drawn(random);
        let (devices, settings) = drawn(random, world.hub.m_b);
        let expected = world.case(&devices, &settings.concat()).solved();
        other(&world, &devices, &settings).error(&expected)
    };
    errors_of(SEEDS, error).are_within(LIMITS);
}

#[test]
fn order_of_devices_does_not_matter() {
    same_motion(|world, ([first, second], sgcmg, double, (panel, slosh)), settings| {
        let set = (*slosh, *double, *second, *panel, *sgcmg, *first);
        reordered(world, &set, settings, [5, 3, 1, 4, 2, 0])
    });
    same_motion(|world, (wheels, sgcmg, double, (panel, slosh)), settings| {
        let [first, second] = *wheels;
        let set = ((*panel, *slosh), *double, *sgcmg, [second, first]);
        reordered(world, &set, settings, [4, 5, 3, 2, 1, 0])
    });
}

/// The same devices in the same order are the same operations: to the bit.
#[test]
fn nesting_of_devices_does_not_even_change_rounding() {
    let mut random = Random::new(1);
    for _ in 0..cases(SEEDS) {
        let world = World::drawn(&mut random);
        let (devices, settings) = drawn(&mut random, world.hub.m_b);
        let ([first, second], sgcmg, double, (panel, slosh)) = devices;
        let expected = world.case(&devices, &settings.concat()).solved();
        let order = [0, 1, 2, 3, 4, 5];
        let flat = (first, second, sgcmg, double, panel, slosh);
        let deep = (((first,), (second, (sgcmg, [double]))), [(panel, (slosh,))]);
        assert_eq!(bits(&reordered(&world, &flat, &settings, order)), bits(&expected));
        assert_eq!(bits(&reordered(&world, &deep, &settings, order)), bits(&expected));
    }
}

/// The bits of all numbers.
pub(crate) fn bits(found: &Solution) -> Vec<u64> {
    let hub = found.r_b_n_ddot.iter().chain(&found.omega_dot).copied();
    hub.chain(found.joints.iter().map(|(_, value)| *value)).map(f64::to_bits).collect()
}

/// Devices as DGVSCMGs, without springs; a slosh mass has no such form.
fn as_dgvscmgs(devices: &Mixed) -> ([Dgvscmg; 5], SloshMass) {
    let (wheels, s, b, (p, slosh)) = devices;
    let [first, second] = wheels.map(|wheel| {
        let bare = Dgvscmg::bare_wheel(wheel.m_w, wheel.i_w_wc);
        Dgvscmg { mount: wheel.mount, r_go_b: wheel.r_w_b, d: wheel.d, ..bare }
    });
    let bare = Dgvscmg { mount: s.mount, r_go_b: s.r_g_b, ..Dgvscmg::bare_wheel(s.m_w, s.i_w_wc) };
    let (m_go, r_goc_go, i_go_goc) = (s.m_g, s.r_gc_g, s.i_g_gc);
    let single = Dgvscmg { m_go, r_goc_go, i_go_goc, l_o: s.l_g, d: s.d, ..bare };
    let disc = Matrix3::from_diagonal(&Vector3::new(b.j_11, b.j_22, b.j_22));
    let bare = Dgvscmg { mount: b.mount, r_go_b: b.r_go_b, ..Dgvscmg::bare_wheel(b.m_w, disc) };
    let (m_go, r_goc_go, i_go_goc) = (b.m_go, b.r_goc_go, b.i_go_goc);
    let outer = Dgvscmg { m_go, r_goc_go, i_go_goc, l_o: b.l_o, ..bare };
    let (m_gi, r_gic_gi, i_gi_gic) = (b.m_gi, b.r_gic_gi, b.i_gi_gic);
    let double = Dgvscmg { m_gi, r_gic_gi, i_gi_gic, l_i: b.l_i, ..outer };
    // A panel is the inner gimbal on a massless outer one, all other joints locked.
    let bare = Dgvscmg { mount: p.mount, r_go_b: p.r_p_b, ..Dgvscmg::bare_wheel(p.m_p, p.i_p_pc) };
    let panel = Dgvscmg { l_o: p.r_pc_p, ..bare };
    ([first, second, single, double, panel], *slosh)
}

/// Two of each kind: a block of one number would be measured by how near zero that happens to be.
#[test]
fn special_cases_may_all_be_put_as_dgvscmgs() {
    let error = |random: &mut Random| {
        let world = World::drawn(random);
        let heaviest = world.hub.m_b;
        let [(devices, settings, same), (more, more_settings, more_same)] = [(); 2].map(|()| {
            let (_, settings) = drawn(random, heaviest);
            let wheels = [(); 2].map(|()| ReactionWheel::drawn(random, heaviest));
            let sgcmg = Sgcmg::drawn(random, heaviest);
            let double = BalancedDgvscmg::drawn(random, heaviest);
            let panel = HingedPanel::drawn(random, heaviest);
            let devices = (wheels, sgcmg, double, (panel, SloshMass::drawn(random, heaviest)));
            let all = settings.concat();
            let [first, second, single, double, panel, slosh] = settings;
            let locked = [Joint::locked(0.0); 2];
            let same = [
                [&locked[..], &first].concat(),
                [&locked[..], &second].concat(),
                vec![single[0], locked[0], single[1]],
                double,
                [&panel[..], &locked].concat(),
                slosh,
            ];
            (devices, all, same.concat())
        });
        let expected = world.case(&[devices, more], &[settings, more_settings].concat()).solved();
        let put = [as_dgvscmgs(&devices), as_dgvscmgs(&more)];
        let mut found = world.case(&put, &[same, more_same].concat()).solved();
        for ((name, _), (of_kind, _)) in found.joints.iter_mut().zip(&expected.joints) {
            *name = of_kind;
        }
        found.error(&expected)
    };
    errors_of(SEEDS, error).are_within(LIMITS);
}
