//! The modes of the imaging satellite's structure, `scenarios/imaging-satellite-modes.npz`: a frame of
//! Euler-Bernoulli beams with point masses, free, by finite elements.
//!
//! ```text
//! cargo run -p precess --example satellite_modes -- scenarios/imaging-satellite-modes.npz
//! ```
//!
//! Each element has consistent mass and equal bending stiffness in both planes; shear deformation is
//! left out. `K v = w² M v` is solved whole; the first six solutions are rigid motion, the next twenty
//! are kept. Mass and inertia about B are `Tᵀ M T` with the rigid motion T of all nodes, and modes of
//! a free structure have no momentum. Everything is chosen: an equipment deck that carries the gyros,
//! a telescope on its centre, columns and a frame on top, 900 kg.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::{DMatrix, Matrix3, Vector3};
use precess::structure::modes::eigen;
use precess::structure::{
    COORDINATES, Fault, Mode, Node, RigidMass, Structure, StructureError, npz, rigid_rows,
};

/// How many modes are kept.
pub(crate) const MODES: usize = 20;
/// Damping ratio of all modes.
const DAMPING: f64 = 0.005;
/// Of a rigid mode, of the lowest elastic one: rounding of the largest eigenvalue.
const RIGID_MAX: f64 = 1e-2;

/// A section: stiffness against stretching, N, torsion, N m², and bending, N m²; mass, kg/m, and
/// polar inertia, kg m, per length.
#[derive(Clone, Copy)]
struct Section {
    stretching: f64,
    torsion: f64,
    bending: f64,
    mass: f64,
    polar: f64,
}

const DECK: Section =
    Section { stretching: 8e7, torsion: 1.2e5, bending: 2e5, mass: 4.0, polar: 0.01 };
const TELESCOPE: Section =
    Section { stretching: 6e8, torsion: 1.2e7, bending: 1.6e7, mass: 35.0, polar: 1.5 };
const COLUMN: Section =
    Section { stretching: 1.2e8, torsion: 1.6e5, bending: 2.4e5, mass: 5.0, polar: 0.012 };
const BRACKET: Section =
    Section { stretching: 4e7, torsion: 1.6e4, bending: 2.4e4, mass: 2.0, polar: 0.004 };

/// A frame of beams.
#[derive(Default)]
struct Frame {
    nodes: Vec<Vector3<f64>>,
    members: Vec<(usize, usize, Section)>,
    /// Node, mass, kg, and moment of inertia about each axis, kg m².
    masses: Vec<(usize, f64, f64)>,
    named: Vec<(&'static str, usize)>,
}

impl Frame {
    fn node(&mut self, x: f64, y: f64, z: f64) -> usize {
        self.nodes.push(Vector3::new(x, y, z));
        self.nodes.len() - 1
    }

    /// Elements of equal length between two nodes; all nodes along them.
    fn beam(&mut self, from: usize, to: usize, elements: usize, section: Section) -> Vec<usize> {
        let (a, b) = (self.nodes[from], self.nodes[to]);
        let mut along = vec![from];
        for k in 1..elements {
            let r = a + (b - a) * (number(k) / number(elements));
            along.push(self.node(r.x, r.y, r.z));
        }
        along.push(to);
        self.members.extend(along.windows(2).map(|pair| (pair[0], pair[1], section)));
        along
    }

    /// Mass and stiffness matrix.
    fn matrices(&self) -> [DMatrix<f64>; 2] {
        let size = COORDINATES * self.nodes.len();
        let mut matrices = [DMatrix::zeros(size, size), DMatrix::zeros(size, size)];
        for (a, b, section) in &self.members {
            let offset = self.nodes[*b] - self.nodes[*a];
            let places: Vec<usize> =
                [*a, *b].into_iter().flat_map(|node| (0..6).map(move |k| 6 * node + k)).collect();
            let turn = turned(&offset);
            for (whole, own) in matrices.iter_mut().zip(element(offset.norm(), section)) {
                let own = turn.transpose() * own * &turn;
                for (i, row) in places.iter().enumerate() {
                    for (j, column) in places.iter().enumerate() {
                        whole[(*row, *column)] += own[(i, j)];
                    }
                }
            }
        }
        for (node, mass, moment) in &self.masses {
            for k in 0..3 {
                matrices[0][(6 * node + k, 6 * node + k)] += mass;
                matrices[0][(6 * node + 3 + k, 6 * node + 3 + k)] += moment;
            }
        }
        matrices
    }
}

/// From global coordinates of both nodes to those of the element, x along it.
fn turned(offset: &Vector3<f64>) -> DMatrix<f64> {
    let x = offset.normalize();
    let other = if x.z.abs() < 0.9 { Vector3::z() } else { Vector3::x() };
    let y = other.cross(&x).normalize();
    let axes = Matrix3::from_rows(&[x.transpose(), y.transpose(), x.cross(&y).transpose()]);
    let mut turn = DMatrix::zeros(12, 12);
    for k in 0..4 {
        turn.view_mut((3 * k, 3 * k), (3, 3)).copy_from(&axes);
    }
    turn
}

/// Mass and stiffness of an element of length l: x, y, z, rx, ry, rz of both ends.
fn element(l: f64, section: &Section) -> [DMatrix<f64>; 2] {
    let [mut mass, mut stiffness] = [DMatrix::zeros(12, 12), DMatrix::zeros(12, 12)];
    let of_ends = [(0, section.mass, section.stretching), (3, section.polar, section.torsion)];
    for (k, per_length, along) in of_ends {
        for (i, j) in [(k, k), (k + 6, k + 6), (k, k + 6), (k + 6, k)] {
            let own = i == j;
            mass[(i, j)] += per_length * l / if own { 3.0 } else { 6.0 };
            stiffness[(i, j)] += if own { along / l } else { -along / l };
        }
    }
    // Deflection and slope of both ends: y with rz, and z with -ry.
    let m = [
        [156.0, 22.0 * l, 54.0, -13.0 * l],
        [22.0 * l, 4.0 * l * l, 13.0 * l, -3.0 * l * l],
        [54.0, 13.0 * l, 156.0, -22.0 * l],
        [-13.0 * l, -3.0 * l * l, -22.0 * l, 4.0 * l * l],
    ];
    let k = [
        [12.0, 6.0 * l, -12.0, 6.0 * l],
        [6.0 * l, 4.0 * l * l, -6.0 * l, 2.0 * l * l],
        [-12.0, -6.0 * l, 12.0, -6.0 * l],
        [6.0 * l, 2.0 * l * l, -6.0 * l, 4.0 * l * l],
    ];
    for (places, signs) in
        [([1, 5, 7, 11], [1.0, 1.0, 1.0, 1.0]), ([2, 4, 8, 10], [1.0, -1.0, 1.0, -1.0])]
    {
        for i in 0..4 {
            for j in 0..4 {
                let sign: f64 = signs[i] * signs[j];
                mass[(places[i], places[j])] += sign * section.mass * l / 420.0 * m[i][j];
                stiffness[(places[i], places[j])] += sign * section.bending / l.powi(3) * k[i][j];
            }
        }
    }
    [mass, stiffness]
}

/// A small count as a number.
fn number(count: usize) -> f64 {
    u32::try_from(count).map_or(f64::NAN, f64::from)
}

/// The frame of the satellite: B on its axis, the deck 0.6 m below.
fn satellite() -> Frame {
    let mut frame = Frame::default();
    // The gyros are 45 cm from the axis, on the diagonals.
    let gyro = 0.45 * FRAC_1_SQRT_2;
    let lines = [-0.75, -gyro, 0.0, gyro, 0.75];
    let deck: Vec<Vec<usize>> =
        lines.iter().map(|x| lines.iter().map(|y| frame.node(*x, *y, -0.6)).collect()).collect();
    for (i, row) in deck.iter().enumerate() {
        for j in 0..4 {
            frame.members.push((row[j], row[j + 1], DECK));
            frame.members.push((deck[j][i], deck[j + 1][i], DECK));
        }
    }
    // Equipment: unequal, so that no two modes have the same frequency.
    for (i, row) in deck.iter().enumerate() {
        for (j, node) in row.iter().enumerate() {
            let mass = 18.0 + 1.5 * number(i) + 0.7 * number(j);
            frame.masses.push((*node, mass, 0.02 * mass));
        }
    }
    let camera = frame.node(0.0, 0.0, 1.0);
    let tube = frame.beam(deck[2][2], camera, 8, TELESCOPE);
    frame.masses.push((camera, 40.0, 1.5));
    frame.masses.push((tube[2], 70.0, 3.0));
    let tracker = frame.node(0.3, 0.1, 0.4);
    frame.beam(tube[5], tracker, 2, BRACKET);
    frame.masses.push((tracker, 3.0, 0.004));
    let mut ring = Vec::new();
    for (i, j) in [(4, 4), (0, 4), (0, 0), (4, 0)] {
        let corner = frame.node(lines[i], lines[j], 0.6);
        frame.beam(deck[i][j], corner, 3, COLUMN);
        ring.push(corner);
    }
    for k in 0..4 {
        let side = frame.beam(ring[k], ring[(k + 1) % 4], 2, COLUMN);
        frame.beam(side[1], tube[6], 2, BRACKET);
        frame.masses.push((side[1], 4.0 + number(k), 0.05));
    }
    let rest = 900.0 - frame.mass();
    frame.masses.push((deck[2][2], rest, 0.01 * rest));
    let gyros = [(3, 3), (1, 3), (1, 1), (3, 1)];
    let names = ["cmg1", "cmg2", "cmg3", "cmg4"];
    frame.named.extend(names.into_iter().zip(gyros.map(|(i, j)| deck[i][j])));
    frame.named.extend([("camera", camera), ("star_tracker", tracker)]);
    frame
}

impl Frame {
    fn mass(&self) -> f64 {
        let length = |(a, b, _): &(usize, usize, Section)| (self.nodes[*b] - self.nodes[*a]).norm();
        let members = self.members.iter().map(|member| member.2.mass * length(member));
        members.sum::<f64>() + self.masses.iter().map(|(_, mass, _)| mass).sum::<f64>()
    }
}

/// The structure with its modes.
///
/// # Errors
/// A mass matrix that is not positive definite.
pub(crate) fn structure() -> Result<Structure, Fault> {
    let frame = satellite();
    let [mass, stiffness] = frame.matrices();
    let mut solved = eigen(&mass, &stiffness)?;
    let (rigid, first) = (solved.values[5].abs().sqrt(), solved.values[6].sqrt());
    assert!(rigid < RIGID_MAX * first, "six rigid modes: {rigid} rad/s, {first} rad/s");
    // The sign of a mode is free: its largest element is above zero.
    for mut column in solved.vectors.column_iter_mut() {
        if column[column.icamax()] < 0.0 {
            column.neg_mut();
        }
    }
    let mut motion = DMatrix::zeros(mass.nrows(), 6);
    for (node, position) in frame.nodes.iter().enumerate() {
        motion.view_mut((6 * node, 0), (6, 6)).copy_from(&rigid_rows(position));
    }
    let of_rigid = motion.transpose() * &mass * &motion;
    let first_moment = Vector3::new(of_rigid[(5, 1)], of_rigid[(3, 2)], of_rigid[(4, 0)]);
    let inertia = of_rigid.view((3, 3), (3, 3)).into_owned();
    let inertia = Matrix3::from_fn(|i, j| 0.5 * (inertia[(i, j)] + inertia[(j, i)]));
    let mut shapes = DMatrix::zeros(6 * frame.named.len(), MODES);
    for (index, (_, node)) in frame.named.iter().enumerate() {
        let rows = solved.vectors.view((6 * node, 6), (6, MODES));
        shapes.view_mut((6 * index, 0), (6, MODES)).copy_from(&rows);
    }
    let mode = |k: usize| Mode {
        frequency: solved.values[6 + k].sqrt(),
        damping: DAMPING,
        linear: Vector3::zeros(),
        angular: Vector3::zeros(),
    };
    let node = |(name, node): &(&str, usize)| Node {
        name: (*name).to_owned(),
        position: frame.nodes[*node],
    };
    Structure {
        name: "imaging satellite: frame of beams, free, without the gyros".to_owned(),
        nodes: frame.named.iter().map(node).collect(),
        modes: (0..MODES).map(mode).collect(),
        shapes,
        mass: Some(RigidMass { mass: of_rigid[(0, 0)], first_moment, inertia }),
        mass_matrix: None,
        residual: None,
        has_devices: Some(false),
        initial: Vec::new(),
    }
    .checked()
}

#[allow(dead_code, reason = "a test compiles this file as a module")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let to = std::env::args().nth(1).ok_or("name the file to write")?;
    let structure = structure().map_err(StructureError::from)?;
    for mode in &structure.modes {
        println!("{:.3} Hz", mode.frequency / std::f64::consts::TAU);
    }
    std::fs::write(&to, npz::write(&structure)?)?;
    Ok(())
}
