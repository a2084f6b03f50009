//! What the numbers of a structure say of each other.

use nalgebra::{DMatrix, Vector3};
use precess::structure::{Mode, Node, RigidMass, Structure};

use super::structure;

/// Three bodies along x on springs in z, each with some inertia, and their modes by the eigenvalue problem.
fn lumps() -> Structure {
    let [mass, inertia, stiffness] = [2.0, 0.1, 500.0];
    let names = ["left", "middle", "right"];
    let node = |(k, name): (usize, &&str)| Node {
        name: (*name).into(),
        position: Vector3::new(0.5 * (k as f64 - 1.0), 0.2, 0.0),
    };
    let nodes: Vec<_> = names.iter().enumerate().map(node).collect();
    let matrix = DMatrix::from_fn(18, 18, |row, column| match (row == column, row % 6) {
        (false, _) => 0.0,
        (true, axis) if axis < 3 => mass,
        _ => inertia,
    });
    let free = structure(nodes, vec![unit_mode()], DMatrix::zeros(18, 1));
    // A spring against each pattern of motion that is not rigid: K = k (1 - P), P onto rigid motion.
    let rigid = free.rigid_shapes();
    let onto = &rigid
        * (rigid.transpose() * &rigid).try_inverse().expect("three nodes")
        * rigid.transpose();
    let stiff = (DMatrix::identity(18, 18) - onto) * stiffness;
    let eigen = precess::structure::modes::eigen(&matrix, &stiff).expect("positive definite");
    let mut found = structure(
        free.nodes.clone(),
        eigen.values[6..].iter().map(|v| Mode { frequency: v.sqrt(), ..unit_mode() }).collect(),
        eigen.vectors.columns(6, 12).into_owned(),
    );
    let whole = rigid.transpose() * &matrix * &rigid;
    let inertia = whole.fixed_view::<3, 3>(3, 3).into_owned();
    let first = Vector3::new(whole[(5, 1)], -whole[(5, 0)], whole[(4, 0)]);
    found.mass = Some(RigidMass { mass: whole[(0, 0)], first_moment: first, inertia });
    found.mass_matrix = Some(matrix);
    found
}

fn unit_mode() -> Mode {
    let (linear, angular) = (Vector3::zeros(), Vector3::zeros());
    Mode { frequency: 1.0, damping: 0.0, linear, angular }
}

#[test]
fn checks_hold_for_a_consistent_structure_and_see_a_wrong_number() {
    let good = lumps();
    for check in good.checks() {
        assert_eq!(check.holds(), Some(true), "{check:?}");
    }
    let wrong = |change: fn(&mut Structure)| {
        let mut structure = lumps();
        change(&mut structure);
        structure.checks().iter().map(|check| check.holds() == Some(true)).collect::<Vec<_>>()
    };
    assert_eq!(wrong(|s| s.shapes[(2, 3)] += 1e-3), [false, true, false, true, true]);
    assert_eq!(
        wrong(|s| s.mass.as_mut().expect("given").first_moment.x += 0.1),
        [true, false, true, true, true]
    );
    assert_eq!(wrong(|s| s.modes[0].linear.z = 3.0), [true, true, false, false, false]);
}
