//! Our own equations, (D1) to (D13), in numbers against clouds of point masses: positions by rotation
//! matrices, derivatives by central differences, Newton's law for each point. Nothing is shared with the
//! derivation or with the graph.

#[path = "folder/mod.rs"]
mod folder;

use std::collections::HashMap;

use precess_codegen::derivation::chain::Chain;
use precess_codegen::graph::Graph;
use precess_codegen::kinds::DGVSCMG;
use precess_codegen::page::Page;
use precess_codegen::proof::KernelPages;

type V = [f64; 3];
type M = [V; 3];

/// Second differences leave the rounding of a position over the squared step, 1e-16 / 1e-8 = 1e-8, and
/// quantities are sums of some twenty points of order one.
const TOLERANCE: f64 = 1e-6;
/// Steps of first and second differences.
const STEPS: [f64; 2] = [1e-5, 1e-4];

struct Random(u64);

impl Random {
    /// Between -1 and 1.
    fn signed(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from(u32::try_from(self.0 >> 32).unwrap()) / f64::from(u32::MAX) * 2.0 - 1.0
    }

    fn vector(&mut self) -> V {
        [0; 3].map(|_| self.signed())
    }
}

fn add(a: V, b: V) -> V {
    [0, 1, 2].map(|i| a[i] + b[i])
}

fn scaled(k: f64, a: V) -> V {
    a.map(|x| k * x)
}

fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: V, b: V) -> V {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn times(m: M, v: V) -> V {
    m.map(|row| dot(row, v))
}

/// Rotation by an angle about a unit vector: Rodrigues.
fn rotation(axis: V, angle: f64) -> M {
    let (s, c) = angle.sin_cos();
    let column = |e: V| {
        add(add(scaled(c, e), scaled(s, cross(axis, e))), scaled((1.0 - c) * dot(axis, e), axis))
    };
    let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(column);
    [0, 1, 2].map(|i| columns.map(|column| column[i]))
}

/// Point masses of one body, from the origin of its frame.
type Cloud = Vec<(f64, V)>;

struct Spacecraft {
    /// Hub, outer gimbal, inner gimbal, wheel.
    clouds: [Cloud; 4],
    /// Origins of the three joints, each in the parent's frame.
    origins: [V; 3],
    angles: V,
    rates: V,
    omega: V,
}

impl Spacecraft {
    fn random(random: &mut Random) -> Self {
        let mut clouds = [0; 4].map(|_| {
            let point = |_| (1.5 + random.signed(), random.vector());
            (0..6).map(point).collect::<Cloud>()
        });
        // The wheel's centre of mass lies on its second axis.
        let [mass, centre] = [mass(&clouds[3]), 1.0];
        let sum = clouds[3].iter().fold([0.0; 3], |sum, (m, x)| add(sum, scaled(*m, *x)));
        for (_, x) in &mut clouds[3] {
            *x = add(*x, scaled(-centre / mass, [sum[0], 0.0, sum[2]]));
        }
        let origins = [0; 3].map(|_| random.vector());
        let [angles, rates, omega] = [0; 3].map(|_| random.vector());
        Self { clouds, origins, angles, rates, omega }
    }

    /// Where a point of a body is, from B in the axes of B.
    fn place(&self, body: usize, x: V, angles: V) -> V {
        let axes = [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
        let mut place = x;
        for k in (0..body).rev() {
            place = add(self.origins[k], times(rotation(axes[k], angles[k]), place));
        }
        place
    }

    /// The same from an inertial point, B at rest there, at a time.
    fn inertial(&self, body: usize, x: V, t: f64) -> V {
        let size = dot(self.omega, self.omega).sqrt();
        let turned = rotation(scaled(1.0 / size, self.omega), size * t);
        times(turned, self.place(body, x, add(self.angles, scaled(t, self.rates))))
    }

    /// Mass matrix and bias of the bodies chosen: translation, rotation, three joints.
    fn system(&self, bodies: std::ops::Range<usize>) -> ([[f64; 9]; 9], [f64; 9]) {
        let (mut matrix, mut bias) = ([[0.0; 9]; 9], [0.0; 9]);
        for (body, (m, x)) in bodies.flat_map(|k| self.clouds[k].iter().map(move |p| (k, p))) {
            let r = self.place(body, *x, self.angles);
            let velocity = |unknown: usize| {
                let mut unit = [0.0; 3];
                unit[unknown % 3] = 1.0;
                match unknown / 3 {
                    0 => unit,
                    1 => cross(unit, r),
                    _ => {
                        let at = |h| self.place(body, *x, add(self.angles, scaled(h, unit)));
                        let h = STEPS[0];
                        scaled(0.5 / h, add(at(h), scaled(-1.0, at(-h))))
                    }
                }
            };
            let velocities: [V; 9] = std::array::from_fn(velocity);
            let h = STEPS[1];
            let at = |t| self.inertial(body, *x, t);
            let ends = add(at(h), at(-h));
            let acceleration = scaled(1.0 / (h * h), add(ends, scaled(-2.0, at(0.0))));
            for (i, a) in velocities.iter().enumerate() {
                bias[i] += m * dot(*a, acceleration);
                for (j, b) in velocities.iter().enumerate() {
                    matrix[i][j] += m * dot(*a, *b);
                }
            }
        }
        (matrix, bias)
    }

    /// The symbols of the pages.
    fn symbols(&self) -> HashMap<String, f64> {
        let mut known = HashMap::new();
        let mut put = |name: &str, value: f64| known.insert(name.to_owned(), value);
        let bodies = [("m_b", "r_bc_b_b", "i_b"), ("m_go", "r_goc_go_go", "i_go")];
        let bodies = bodies.into_iter().chain([("m_gi", "r_gic_gi_gi", "i_gi"), ("m_w", "", "j")]);
        for ((m, r, i), cloud) in bodies.zip(&self.clouds) {
            let whole = mass(cloud);
            let sum = cloud.iter().fold([0.0; 3], |sum, (m, x)| add(sum, scaled(*m, *x)));
            let centre = scaled(1.0 / whole, sum);
            put(m, whole);
            for (axis, c) in ["x", "y", "z"].iter().zip(centre) {
                put(&format!("{r}{axis}"), c);
            }
            if m == "m_w" {
                put("d", centre[1]);
            }
            for (a, b) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)] {
                let entry = cloud.iter().map(|(m, x)| {
                    let x = add(*x, scaled(-1.0, centre));
                    m * (if a == b { dot(x, x) } else { 0.0 } - x[a] * x[b])
                });
                put(&format!("{i}_{}{}", a + 1, b + 1), entry.sum());
            }
        }
        for (stem, origin) in ["r_go_b_b", "l_o_", "l_i_"].iter().zip(self.origins) {
            for (axis, c) in ["x", "y", "z"].iter().zip(origin) {
                put(&format!("{stem}{axis}"), c);
            }
        }
        for (name, angle) in ["gamma_o", "gamma_i", "theta"].iter().zip(self.angles) {
            put(&format!("sin_{name}"), angle.sin());
            put(&format!("cos_{name}"), angle.cos());
        }
        for (name, rate) in ["gamma_o_dot", "gamma_i_dot", "spin"].iter().zip(self.rates) {
            put(name, rate);
        }
        for (axis, rate) in ["x", "y", "z"].iter().zip(self.omega) {
            put(&format!("omega_b{axis}"), rate);
        }
        known
    }
}

fn mass(cloud: &Cloud) -> f64 {
    cloud.iter().map(|(m, _)| m).sum()
}

fn paper() -> Vec<Page> {
    folder::pages("")
}

/// Evaluates every block of our own, in order, into `known` by the names of its statements.
fn evaluate(pages: &KernelPages<'_, '_>, known: &mut HashMap<String, f64>) {
    for equation in pages.equations().iter().filter(|e| e.block.given.is_empty()) {
        let names = pages.names(&equation.block);
        for ((label, name), (same, e)) in names.iter().zip(&equation.components) {
            assert_eq!(label, same);
            let value = |symbol: &str| match known.get(symbol) {
                Some(value) => *value,
                None => panic!("`{symbol}` is unknown in `{name}`"),
            };
            let value = e.evaluate(&value);
            let before = known.insert(name.clone(), value);
            assert!(before.is_none_or(|before| near(before, value)), "{name}: two values");
        }
    }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= TOLERANCE * (1.0 + a.abs())
}

const TAGS: [&str; 3] = ["o", "i", "w"];

/// The entry of the mass matrix, or of the bias, as the pages name it.
fn name(i: usize, j: usize) -> String {
    let letter = ["f", "n"];
    format!("{}_{}_b{}", letter[i / 3], TAGS[j - 6], ["x", "y", "z"][i % 3])
}

#[test]
fn composites_and_joint_rows_are_those_of_point_masses() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let mut pages = folder::pages("kernels");
    // The last page states the same by the paper's equations.
    pages.retain(|page| page.name != "04-by-the-paper.md");
    for page in &mut pages {
        page.text = page.text.replace("```equation\n(9)", "```text\n(9)");
        page.text = page.text.replace("```equation\n(76)", "```text\n(76)");
    }
    let pages = KernelPages::composites(&chain, &paper(), &pages).unwrap();
    let mut random = Random(20);
    for _ in 0..5 {
        let craft = Spacecraft::random(&mut random);
        let mut known = craft.symbols();
        evaluate(&pages, &mut known);
        let (matrix, bias) = craft.system(1..4);
        let check = |name: &str, expected: f64| {
            let found = known[name];
            assert!(near(expected, found), "{name}: {found} on the page, {expected} by points");
        };
        for j in 6..9 {
            for (i, row) in matrix.iter().enumerate().take(6) {
                check(&name(i, j), row[j]);
            }
            for k in j..9 {
                check(&format!("mass_{}{}", TAGS[j - 6], TAGS[k - 6]), matrix[j][k]);
            }
            check(&format!("u_rest_{}", TAGS[j - 6]), bias[j]);
        }
        // M_vw is -[S~].
        let first: V = [matrix[1][5], matrix[2][3], matrix[0][4]];
        let turning: M = [3, 4, 5].map(|i| [3, 4, 5].map(|j| matrix[i][j]));
        check("constant_m", matrix[0][0]);
        let force = cross(craft.omega, cross(craft.omega, first));
        let moment = cross(craft.omega, times(turning, craft.omega));
        for (i, axis) in ["x", "y", "z"].iter().enumerate() {
            let sum = |moving: String, share: String| known[&moving] + known[&share];
            let s = sum(format!("mr_moving_b{axis}"), format!("constant_mr_b{axis}"));
            assert!(near(first[i], s), "first moment along b{axis}: {s}, {}", first[i]);
            check(&format!("f_rates_b{axis}"), bias[i] - force[i]);
            check(&format!("n_rates_b{axis}"), bias[3 + i] - moment[i]);
            for (j, expected) in turning[i].iter().enumerate().skip(i) {
                let entry = format!("{}{}", i + 1, j + 1);
                let found = sum(format!("i_moving_{entry}"), format!("constant_i_{entry}"));
                assert!(near(*expected, found), "inertia {entry}: {found}, {expected}");
            }
        }
    }
}

/// Solves a dense system: Gauss, with pivots.
fn solve(mut matrix: Vec<Vec<f64>>, mut right: Vec<f64>) -> Vec<f64> {
    let n = right.len();
    for k in 0..n {
        let largest = (k..n).max_by(|a, b| matrix[*a][k].abs().total_cmp(&matrix[*b][k].abs()));
        matrix.swap(k, largest.unwrap());
        right.swap(k, largest.unwrap());
        for i in k + 1..n {
            let factor = matrix[i][k] / matrix[k][k];
            let row = matrix[k].clone();
            for (entry, other) in matrix[i].iter_mut().zip(row) {
                *entry -= factor * other;
            }
            right[i] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        let rest: f64 = (k + 1..n).map(|j| matrix[k][j] * right[j]).sum();
        right[k] = (right[k] - rest) / matrix[k][k];
    }
    right
}

/// Accelerations by the page of the elimination, and by solving all equations at once, for every
/// choice of joints whose acceleration is given.
#[test]
fn the_elimination_solves_the_system_of_point_masses() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &DGVSCMG);
    let pages = folder::pages("kernels/elimination");
    let mut random = Random(30);
    for modes in 0..8 {
        let craft = Spacecraft::random(&mut random);
        let (matrix, bias) = craft.system(0..4);
        let load: [f64; 9] = std::array::from_fn(|_| random.signed());
        let given = random.vector();
        let driven = |k: usize| modes >> k & 1 == 0;
        // The joints whose acceleration is given leave the unknowns.
        let free: Vec<usize> = (0..9).filter(|x| *x < 6 || driven(x - 6)).collect();
        let right = free.iter().map(|&x| {
            let held = (6..9).filter(|y| !free.contains(y)).map(|y| matrix[x][y] * given[y - 6]);
            load[x] - bias[x] - held.sum::<f64>()
        });
        let rows = free.iter().map(|&x| free.iter().map(|&y| matrix[x][y]).collect());
        let solved = solve(rows.collect(), right.collect());
        let mut expected: Vec<f64> =
            (0..9).map(|x| if x < 6 { 0.0 } else { given[x - 6] }).collect();
        free.iter().zip(&solved).for_each(|(&x, value)| expected[x] = *value);

        let mut known = HashMap::new();
        for j in 6..9 {
            let tag = TAGS[j - 6];
            known.extend((0..6).map(|i| (name(i, j), matrix[i][j])));
            for k in j..9 {
                known.insert(format!("mass_{tag}{}", TAGS[k - 6]), matrix[j][k]);
            }
            let of_mode = |on: bool| if on { 1.0 } else { 0.0 };
            known.insert(format!("driven_{tag}"), of_mode(driven(j - 6)));
            known.insert(format!("held_{tag}"), of_mode(!driven(j - 6)));
            known.insert(format!("given_{tag}"), if driven(j - 6) { 0.0 } else { given[j - 6] });
            known.insert(format!("u_{tag}"), load[j]);
            known.insert(format!("u_rest_{tag}"), bias[j]);
        }
        // The outer gimbal's row across the wheel's axis.
        let sin = craft.angles[1].sin();
        known.insert("sin_gamma_i".to_owned(), sin);
        known.insert("across_oo".to_owned(), matrix[6][6] - sin * sin * matrix[8][8]);
        known.insert("across_ow".to_owned(), matrix[6][8] + sin * matrix[8][8]);
        for (i, axis) in ["x", "y", "z"].iter().enumerate() {
            known.insert(format!("f_rates_b{axis}"), bias[i]);
            known.insert(format!("n_rates_b{axis}"), bias[3 + i]);
            known.insert(format!("r_b_n_ddot_b{axis}"), expected[i]);
            known.insert(format!("omega_dot_b{axis}"), expected[3 + i]);
        }
        evaluate(&KernelPages::elimination(&chain, &pages).unwrap(), &mut known);

        let share = |x: usize, y: usize| {
            let block = [["vv", "vw"], ["", "ww"]][x / 3][y / 3];
            known[&format!("m_{block}_{}{}", x % 3 + 1, y % 3 + 1)]
        };
        let entry = |x: usize, y: usize| matrix[x][y] - share(x.min(y), x.max(y));
        let hub = (0..6).map(|x| (0..6).map(|y| entry(x, y)).collect()).collect();
        let right = |x: usize| load[x] - known[&format!("h_{}_{}", ["v", "w"][x / 3], x % 3 + 1)];
        let hub = solve(hub, (0..6).map(right).collect());
        let joints = ["gamma_o_ddot", "gamma_i_ddot", "spin_dot"].map(|joint| known[joint]);
        for (x, found) in hub.into_iter().chain(joints).enumerate() {
            assert!(near(expected[x], found), "unknown {x}, modes {modes:b}: {found}");
        }
    }
}
