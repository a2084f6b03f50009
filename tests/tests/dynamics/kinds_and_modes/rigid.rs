//! Locked joints make a rigid body: the hub with their masses, by parallel axes.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use precess_dynamics::kind::JointInfo;
use precess_dynamics::{
    BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg, Dgcmg,
    Dgvscmg, Hub, ReactionWheel, Sgcmg, Vscmg,
};
use precess_dynamics::{FlexibleReactionWheel, HingedPanel, SloshMass};

use super::case::{Joint, LIMITS, SEEDS, World};
use super::devices::{Chain, Drawn, Motion};
use super::random::{Random, errors_of};

/// A rigid body: its centre of mass from a point and its inertia about that centre, along the axes
/// of the axes in which it is expressed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rigid {
    pub(crate) mass: f64,
    pub(crate) centre: Vector3<f64>,
    pub(crate) inertia: Matrix3<f64>,
}

impl Rigid {
    pub(crate) fn of_hub(hub: &Hub) -> Self {
        Self { mass: hub.m_b, centre: hub.r_bc_b, inertia: hub.i_b_bc }
    }

    /// The hub that moves as this body does.
    pub(crate) fn hub(&self) -> Hub {
        Hub { m_b: self.mass, r_bc_b: self.centre, i_b_bc: self.inertia }
    }

    /// The same body along turned axes, its point moved: `centre = origin + turn centre`.
    pub(crate) fn moved(&self, origin: &Vector3<f64>, turn: &Matrix3<f64>) -> Self {
        let inertia = turn * self.inertia * turn.transpose();
        Self { centre: origin + turn * self.centre, inertia: symmetric(&inertia), ..*self }
    }

    /// Several bodies as one; each inertia moves to the common centre by its parallel axes.
    pub(crate) fn merged(bodies: &[Self]) -> Self {
        let mass = bodies.iter().map(|body| body.mass).sum::<f64>();
        let centre = bodies.iter().map(|body| body.centre * body.mass).sum::<Vector3<f64>>() / mass;
        let about_centre = |body: &Self| {
            let r = body.centre - centre;
            let square = Matrix3::from_diagonal_element(r.norm_squared());
            body.inertia + (square - r * r.transpose()) * body.mass
        };
        let inertia = bodies.iter().map(about_centre).sum::<Matrix3<f64>>();
        Self { mass, centre, inertia: symmetric(&inertia) }
    }
}

fn symmetric(tensor: &Matrix3<f64>) -> Matrix3<f64> {
    (tensor + tensor.transpose()) * 0.5
}

/// The bodies of a device in a pose, from B along B axes.
pub(crate) fn posed(chain: &Chain, coordinates: &[f64]) -> Vec<Rigid> {
    let (mut axes, mut origin) = (chain.mount, chain.position);
    let links = chain.links.iter().zip(coordinates);
    let walk = links.map(|(link, coordinate)| {
        origin += axes * link.origin;
        match link.motion {
            Motion::Turns(axis) => axes *= turn(&axis, *coordinate),
            Motion::Slides(axis) => origin += axes * axis * *coordinate,
        }
        Rigid { mass: link.mass, centre: link.centre, inertia: link.inertia }.moved(&origin, &axes)
    });
    walk.collect()
}

/// The rotation about an axis, active.
pub(crate) fn turn(axis: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    Rotation3::from_axis_angle(&Unit::new_unchecked(*axis), angle).into_inner()
}

/// Two devices of a kind with every joint still, against the hub that has taken their bodies.
fn locked_is_rigid<K: Drawn>() {
    let error = |random: &mut Random| {
        let world = World::drawn(random);
        let devices = [(); 2].map(|()| K::drawn(random, world.hub.m_b));
        let still = |info: &JointInfo, random: &mut Random| {
            let locked = Joint::locked(random.joint(info)[0]);
            // A kind's own prescribed joint takes no lock: at rest it keeps still.
            if info.driven { locked } else { locked.prescribed(0.0) }
        };
        let pose =
            [(); 2].map(|()| K::JOINTS.iter().map(|info| still(info, random)).collect::<Vec<_>>());
        let mut bodies = vec![Rigid::of_hub(&world.hub)];
        for (device, pose) in devices.iter().zip(&pose) {
            let coordinates: Vec<_> = pose.iter().map(|joint| joint.state[0]).collect();
            bodies.extend(posed(&device.chain(), &coordinates));
        }
        let rigid = world.on(Rigid::merged(&bodies).hub());
        let expected = rigid.case::<[Dgvscmg; 0]>(&[], &[]).solved();
        let mut found = world.case(&devices, &pose.concat()).solved();
        assert!(found.joints.iter().all(|(_, acceleration)| *acceleration == 0.0));
        found.joints.clear();
        found.error(&expected)
    };
    errors_of(SEEDS, error).are_within(LIMITS);
}

#[test]
fn locked_wheel_is_part_of_the_hub() {
    locked_is_rigid::<ReactionWheel>();
    locked_is_rigid::<BalancedReactionWheel>();
}

#[test]
fn locked_single_gimbal_is_part_of_the_hub_at_any_angle() {
    locked_is_rigid::<Vscmg>();
    locked_is_rigid::<BalancedVscmg>();
    locked_is_rigid::<Sgcmg>();
    locked_is_rigid::<BalancedSgcmg>();
}

#[test]
fn locked_double_gimbal_is_part_of_the_hub_at_any_angles() {
    locked_is_rigid::<Dgvscmg>();
    locked_is_rigid::<BalancedDgvscmg>();
    locked_is_rigid::<Dgcmg>();
    locked_is_rigid::<BalancedDgcmg>();
}

#[test]
fn wheel_on_locked_bearings_is_part_of_the_hub_wherever_they_stand() {
    locked_is_rigid::<FlexibleReactionWheel>();
}

#[test]
fn locked_panel_is_part_of_the_hub_at_any_angle() {
    locked_is_rigid::<HingedPanel>();
}

#[test]
fn locked_slosh_mass_is_a_point_mass_wherever_it_stands() {
    locked_is_rigid::<SloshMass>();
}
