//! A stored spacecraft for the reference in double-double: chains of joints whose directions are
//! written down here, from the page of kinds and not from the solver.

use precess_dynamics::Scalar;
use precess_tests::chains::{Chain, Craft, Link, Load};
use precess_tests::newton_euler::vector::{Tensor, Vector};

use super::solver::{hub_mode, mode, mount, passive, scalar};
use super::stored::{self, StoredDevice, StoredJoint};

/// How a joint moves: about x, y or z (0 to 2) or along it, and whether its body is round.
#[derive(Clone, Copy)]
struct Moves {
    axis: usize,
    slides: bool,
    round: bool,
}

const fn turns(axis: usize) -> Moves {
    Moves { axis, slides: false, round: false }
}

const X: Moves = turns(0);
const Y: Moves = turns(1);
const Z: Moves = turns(2);
const ROUND: Moves = Moves { round: true, ..X };
const SLIDES: Moves = Moves { slides: true, ..X };

/// The joints of a kind from the hub to the tip.
fn joints(kind: &str) -> &'static [Moves] {
    match kind {
        "dgvscmg" | "dgcmg" => &[Z, Y, X],
        "balanced_dgvscmg" | "balanced_dgcmg" => &[Z, Y, ROUND],
        "vscmg" | "sgcmg" => &[Z, X],
        "balanced_vscmg" | "balanced_sgcmg" => &[Z, ROUND],
        "reaction_wheel" => &[X],
        "balanced_reaction_wheel" => &[ROUND],
        "hinged_panel" => &[Z],
        "slosh_mass" => &[SLIDES],
        "flexible_reaction_wheel" => {
            &[SLIDES, Moves { axis: 1, ..SLIDES }, Moves { axis: 2, ..SLIDES }, Y, Z, X]
        }
        "flexible_vscmg" => {
            &[Z, SLIDES, Moves { axis: 1, ..SLIDES }, Moves { axis: 2, ..SLIDES }, Y, Z, X]
        }
        other => panic!("{other} has no joints here; write them down"),
    }
}

/// The spacecraft as the reference takes it.
pub(crate) fn craft<T: Scalar>(stored: &stored::Craft) -> Craft<T> {
    Craft {
        mass: scalar(stored.hub.m_b),
        centre: vector(stored.hub.r_bc_b),
        inertia: symmetric(stored.hub.i_b),
        omega: vector(stored.omega),
        applied: Load { force: vector(stored.force), moment: vector(stored.torque_b) },
        gravity: vector(stored.gravity),
        hub_mode: hub_mode(stored.hub_mode),
        chains: stored.devices.iter().map(chain).collect(),
    }
}

fn chain<T: Scalar>(device: &StoredDevice) -> Chain<T> {
    let links = device.joints.iter().zip(joints(&device.kind));
    Chain {
        mount: Tensor::from(&mount(device.mount)),
        links: links.map(|(joint, moves)| link(joint, *moves)).collect(),
    }
}

fn link<T: Scalar>(joint: &StoredJoint, Moves { axis, slides, round }: Moves) -> Link<T> {
    let [a, b, c, d, e, f] = joint.wrench;
    Link {
        axis,
        slides,
        round,
        origin: vector(joint.origin),
        mass: scalar(joint.mass),
        centre: vector(joint.centre),
        inertia: symmetric(joint.inertia),
        passive: passive(joint),
        coordinate: scalar(joint.coordinate),
        rate: scalar(joint.rate),
        motor: scalar(joint.motor),
        mode: mode(joint.mode),
        applied: Load { force: vector([a, b, c]), moment: vector([d, e, f]) },
    }
}

fn vector<T: Scalar>(components: [f64; 3]) -> Vector<T> {
    Vector(components.map(scalar))
}

fn symmetric<T: Scalar>([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Tensor<T> {
    Tensor([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|row| row.map(scalar)))
}
