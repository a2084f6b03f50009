//! The emitted functions of one kind, called as the solver and its users call them.

mod exerted;

pub(super) use exerted::Stand;

use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};

use super::MutationError;
use super::held::Held;
use super::listing::Listing;
use super::physics::Role;
use super::site::Site;
use super::state::{Accelerations, Case, Motion, parameters_of};
use super::tape::{Changed, Returned, Tape, Values};
use crate::derivation::chain::{Chain, Coordinate, Mode};
use crate::emit::prepared;
use crate::graph::{Expr, Stage};
use crate::kernel::{Kernel, kernels, parameters};
use crate::kinds;
use crate::space::{Axis, ENTRIES};

/// Number of the function that all others read.
pub(super) const PREPARE: usize = 0;

/// The numbers of the functions that laws are put to.
struct Functions {
    /// One per body, from the hub outwards.
    bodies: Vec<usize>,
    first_moment: usize,
    eliminate: usize,
    back_substitute: usize,
    energy_momentum: usize,
    axes: usize,
    loads: usize,
    external: usize,
    gravity: usize,
}

/// The functions with their listings, `prepare` first.
pub(super) struct Device<'a, 'g> {
    pub(super) chain: &'a Chain<'g>,
    pub(super) listings: Vec<Listing<'g>>,
    tapes: Vec<Tape>,
    functions: Functions,
    parameters: Vec<Expr<'g>>,
    /// Sine and cosine of each joint.
    trigonometry: Vec<[Expr<'g>; 2]>,
    /// Fields that `eliminate` hands to `back_substitute`.
    handed: Vec<(String, Expr<'g>)>,
}

/// Which function is changed at which step: one, or with `prepare` all that use the node.
#[derive(Clone, Default)]
pub(super) struct Fault(Vec<Option<Changed>>);

/// One body seen from B; vectors along B but for `omega`, which is along the axes of its functions.
pub(super) struct BodySeen {
    pub(super) mass: f64,
    /// The axes along which its functions resolve it, as columns along B. A rotor that is the same
    /// from every angle does not carry them along.
    axes: Matrix3<f64>,
    /// The axes that are fixed in it.
    pub(super) attitude: Matrix3<f64>,
    pub(super) r: Vector3<f64>,
    pub(super) r_prime: Vector3<f64>,
    pub(super) columns: Vec<Vector3<f64>>,
    pub(super) r_dprime_rest: Vector3<f64>,
    pub(super) omega: Vector3<f64>,
    /// About the body's own centre of mass: given, not computed by a kernel.
    pub(super) inertia: Matrix3<f64>,
    pub(super) inertia_prime: Matrix3<f64>,
    pub(super) inertia_b: Matrix3<f64>,
    pub(super) inertia_b_prime: Matrix3<f64>,
}

/// The device's centre of mass, weighted with its mass, along B.
pub(super) struct Moment {
    pub(super) mc: Vector3<f64>,
    pub(super) mc_prime: Vector3<f64>,
    pub(super) columns: Vec<Vector3<f64>>,
    pub(super) rest: Vector3<f64>,
}

impl<'a, 'g> Device<'a, 'g> {
    /// Lists and lays out every function of a kind.
    ///
    /// # Errors
    /// When the kind lacks a function that a law reads.
    pub(super) fn new(chain: &'a Chain<'g>) -> Result<Self, MutationError> {
        let graph = chain.graph;
        let kernels = kernels(chain);
        let hoisted = prepared(graph, &kernels, &parameters(chain.kind));
        let claims: Vec<_> = kernels.iter().flat_map(|kernel| kernel.claims.clone()).collect();
        let mut listings =
            vec![Listing::new(graph, "prepare", &hoisted.sections, &hoisted.record, &claims)];
        let listing = |kernel: &Kernel<'g>| {
            let Kernel { name, sections, output, claims, .. } = kernel;
            Listing::new(graph, name, sections, output, claims)
        };
        listings.extend(kernels.iter().map(listing));
        let tapes: Vec<_> = listings.iter().map(|listing| Tape::new(graph, listing)).collect();
        let symbol = |name: &str| graph.symbol(name, Stage::Parameter);
        let trigonometry = chain.kind.links.iter().map(|link| {
            ["sin", "cos"].map(|function| {
                graph.symbol(&format!("{function}_{}", link.joint.coordinate), Stage::Configuration)
            })
        });
        let functions = Functions::of(chain, &listings)?;
        let fields = listings[functions.eliminate].fields.iter();
        let handed = fields
            .filter(|(field, _)| field.starts_with("gain_") || field.starts_with("free_"))
            .map(|(field, _)| (field.clone(), graph.symbol(field, Stage::Rate)));
        Ok(Self {
            chain,
            parameters: parameters_of(chain.kind).iter().map(|name| symbol(name)).collect(),
            trigonometry: trigonometry.collect(),
            handed: handed.collect(),
            listings,
            tapes,
            functions,
        })
    }

    /// What a change of function `index` can move; `prepare` has no role of its own: it moves all.
    pub(super) fn role(&self, index: usize) -> Option<Role> {
        let functions = &self.functions;
        if functions.bodies.contains(&index) {
            return Some(Role::Body);
        }
        let roles = [
            (functions.first_moment, Role::FirstMoment),
            (functions.eliminate, Role::Solution),
            (functions.back_substitute, Role::Solution),
            (functions.energy_momentum, Role::Momenta),
            (functions.axes, Role::Axes),
            (functions.loads, Role::Loads),
            (functions.external, Role::External),
            (functions.gravity, Role::Gravity),
        ];
        roles.into_iter().find(|(function, _)| *function == index).map(|(_, role)| role)
    }

    /// The fault that a site of function `index` stands for.
    pub(super) fn fault(&self, index: usize, site: &Site) -> Fault {
        let changed = |(k, tape): (usize, &Tape)| {
            let meant = index == PREPARE || k == index;
            let change = || tape.changed(self.chain.graph, &site.place, site.mutant.change);
            meant.then(change).flatten()
        };
        Fault(self.tapes.iter().enumerate().map(changed).collect())
    }

    /// How many joints and bodies there are.
    pub(super) fn joints(&self) -> usize {
        self.chain.links.len()
    }

    /// The sum of the bodies' masses.
    pub(super) fn mass(&self, case: &Case) -> f64 {
        (0..self.joints()).map(|k| self.body_mass(k, case)).sum()
    }

    /// The mass of body `k`.
    pub(super) fn body_mass(&self, k: usize, case: &Case) -> f64 {
        self.parameter(case, self.chain.kind.links[k].body.mass)
    }

    fn parameter(&self, case: &Case, name: &str) -> f64 {
        let of = self.chain.graph.find(name);
        let place = self.parameters.iter().position(|symbol| Some(*symbol) == of);
        place.map_or(f64::NAN, |place| case.parameters[place])
    }

    /// Every argument a function may ask for, accelerations apart.
    fn arguments(&self, case: &Case, motion: &Motion) -> Values {
        let mut values = Values::covering(self.chain.graph);
        for (symbol, value) in self.parameters.iter().zip(&case.parameters) {
            values.set(*symbol, *value);
        }
        for (k, link) in self.chain.links.iter().enumerate() {
            let [sine, cosine] = self.trigonometry[k];
            values.set(sine, libm::sin(motion.coordinates[k]));
            values.set(cosine, libm::cos(motion.coordinates[k]));
            if let Coordinate::Length(length) = link.coordinate {
                values.set(length, motion.coordinates[k]);
            }
            values.set(link.rate, motion.rates[k]);
            values.set(link.torque, case.drive.motors[k]);
            if let Some(Mode { driven, held, given }) = link.mode {
                let numbers = case.drive.modes[k].numbers();
                for (symbol, value) in [driven, held, given].into_iter().zip(numbers) {
                    values.set(symbol, value);
                }
            }
        }
        values.set_vector(self.chain.hub.omega.components(), motion.omega);
        values.set_vector(self.chain.hub.r_b_n_dot.components(), motion.velocity);
        values
    }

    /// Calls function `index`.
    fn call(&self, index: usize, values: &Values, fault: &Fault) -> Returned<'_> {
        self.tapes[index].evaluate(values, fault.0.get(index).copied().flatten())
    }

    /// `eliminate`.
    pub(super) fn eliminated(&self, case: &Case, fault: &Fault) -> Returned<'_> {
        self.call(self.functions.eliminate, &self.arguments(case, &case.motion), fault)
    }

    /// All accelerations of hub and device: `eliminate`, the hub's own six equations by Newton and
    /// Euler for one rigid body, `back_substitute`.
    pub(super) fn accelerations(&self, case: &Case, fault: &Fault) -> Accelerations {
        let mut values = self.arguments(case, &case.motion);
        let device = self.call(self.functions.eliminate, &values, fault);
        let (hub, omega) = (&case.hub, case.motion.omega);
        let lever = hub.centre.cross_matrix();
        let about_b = hub.inertia - hub.mass * lever * lever;
        let mut m = Matrix6::zeros();
        let mut put = |row: usize, column: usize, block: Matrix3<f64>| {
            m.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
        };
        let coupling = Matrix3::from_fn(|row, column| {
            device.scalar(&format!("m_vw_{}{}", row + 1, column + 1))
        }) - hub.mass * lever;
        put(0, 0, device.tensor("m_vv") + Matrix3::from_diagonal_element(hub.mass));
        put(0, 3, coupling);
        put(3, 0, coupling.transpose());
        put(3, 3, device.tensor("m_ww") + about_b);
        let side =
            |stem: &str| Vector3::from_fn(|row, _| device.scalar(&format!("{stem}_{}", row + 1)));
        let force =
            case.drive.force - hub.mass * omega.cross(&omega.cross(&hub.centre)) + side("h_v");
        let torque = case.drive.torque - omega.cross(&(about_b * omega)) + side("h_w");
        let mut right = Vector6::zeros();
        right.fixed_rows_mut::<3>(0).copy_from(&force);
        right.fixed_rows_mut::<3>(3).copy_from(&torque);
        let nothing = || Vector6::from_element(f64::NAN);
        let solution = m.lu().solve(&right).unwrap_or_else(nothing);
        let part = |row: usize| solution.fixed_rows::<3>(row).into_owned();

        values.set_vector(self.chain.hub.r_b_n_ddot.components(), part(0));
        values.set_vector(self.chain.hub.omega_dot.components(), part(3));
        for (field, symbol) in &self.handed {
            values.set(*symbol, device.scalar(field));
        }
        let joints = self.call(self.functions.back_substitute, &values, fault);
        let names = self.chain.kind.links.iter().map(|link| link.joint.acceleration);
        let joints = names.map(|name| joints.scalar(name)).collect();
        Accelerations { point: part(0), omega: part(3), joints }
    }

    /// `energy_momentum`.
    pub(super) fn held(&self, case: &Case, motion: &Motion, fault: &Fault) -> Held {
        let arguments = self.arguments(case, motion);
        let returned = self.call(self.functions.energy_momentum, &arguments, fault);
        // The names as they stand: this is asked for more often than all else together.
        let vector = |names: [&str; 3]| Vector3::from(names.map(|name| returned.scalar(name)));
        Held {
            energy: returned.scalar("energy"),
            linear: vector(["linear_bx", "linear_by", "linear_bz"]),
            angular: vector(["angular_b_bx", "angular_b_by", "angular_b_bz"]),
        }
    }

    /// The joints' own mass matrix as the energies of their motions: `T = sum of M_jk q_j' q_k' / 2`.
    pub(super) fn joint_masses(&self, case: &Case, fault: &Fault) -> DMatrix<f64> {
        let energy = |moving: &[usize]| {
            let rate = |k: usize| if moving.contains(&k) { 1.0 } else { 0.0 };
            let motion = case.motion.joints_alone((0..self.joints()).map(rate).collect());
            self.held(case, &motion, fault).energy
        };
        DMatrix::from_fn(self.joints(), self.joints(), |j, k| {
            if j == k { 2.0 * energy(&[j]) } else { energy(&[j, k]) - energy(&[j]) - energy(&[k]) }
        })
    }

    /// `first_moment`.
    pub(super) fn moment(&self, case: &Case, motion: &Motion, fault: &Fault) -> Moment {
        let arguments = self.arguments(case, motion);
        let returned = self.call(self.functions.first_moment, &arguments, fault);
        let tags = self.chain.kind.links.iter().map(|link| link.joint.tag);
        Moment {
            mc: returned.vector("mc", "b"),
            mc_prime: returned.vector("mc_prime", "b"),
            columns: tags.map(|tag| returned.vector(&format!("f_{tag}"), "b")).collect(),
            rest: returned.vector("f_tilde", "b"),
        }
    }

    /// The function of body `k`.
    pub(super) fn body(&self, k: usize, case: &Case, motion: &Motion, fault: &Fault) -> BodySeen {
        let links = self.chain.kind.links;
        let data = &links[k].body;
        let arguments = self.arguments(case, motion);
        let returned = self.call(self.functions.bodies[k], &arguments, fault);
        let carrier = if k == 0 { "b" } else { links[k - 1].body.frame };
        let (own, point) = (data.frame, data.point);
        let before = self.axes(k, motion);
        let turned = self.turned(k, motion);
        let axes = if self.chain.kind.axes_turn(k) { before * turned } else { before };
        let vector = |stem: &str| before * returned.vector(stem, carrier);
        let tensor = |stem: &str| axes * returned.tensor(stem) * axes.transpose();
        let names = data.inertia.names();
        let given = |row: usize, column: usize| {
            let entry = format!("{}{}", row.min(column) + 1, row.max(column) + 1);
            let named = ENTRIES.iter().zip(&names).find(|(known, _)| **known == entry);
            let name = named.and_then(|(_, name)| name.as_ref());
            name.map_or(0.0, |name| self.parameter(case, name))
        };
        let column = |tag: &str| vector(&format!("r_{point}_b_dprime_{tag}"));
        BodySeen {
            mass: self.body_mass(k, case),
            axes,
            attitude: before * turned,
            r: vector(&format!("r_{point}_b")),
            r_prime: vector(&format!("r_{point}_b_prime")),
            columns: links[..=k].iter().map(|link| column(link.joint.tag)).collect(),
            r_dprime_rest: column("rest"),
            omega: returned.vector(&format!("omega_{own}_b"), own),
            inertia: axes * Matrix3::from_fn(given) * axes.transpose(),
            inertia_prime: tensor(&format!("i_{own}_{point}_prime")),
            inertia_b: tensor(&format!("i_{own}_b")),
            inertia_b_prime: tensor(&format!("i_{own}_b_prime")),
        }
    }

    /// The axes that the functions use behind so many joints, as columns along B: the geometry
    /// itself.
    fn axes(&self, joints: usize, motion: &Motion) -> Matrix3<f64> {
        let turning = (0..joints).filter(|k| self.chain.kind.axes_turn(*k));
        turning.fold(Matrix3::identity(), |axes, k| axes * self.turned(k, motion))
    }

    /// How joint `k` has turned what it carries: a sliding one has not.
    fn turned(&self, k: usize, motion: &Motion) -> Matrix3<f64> {
        match self.chain.kind.links[k].joint.motion {
            kinds::Motion::Slide(_) => Matrix3::identity(),
            kinds::Motion::Turn(axis) => {
                let angle = motion.coordinates[k];
                // Rodrigues: what lies along the axis stays, the rest turns.
                let tilde = unit(axis).cross_matrix();
                let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
                Matrix3::identity() + sine * tilde + (1.0 - cosine) * tilde * tilde
            }
        }
    }
}

impl Functions {
    /// Finds each by its name.
    fn of(chain: &Chain<'_>, listings: &[Listing<'_>]) -> Result<Self, MutationError> {
        let find = |name: &str| {
            let place = listings.iter().position(|listing| listing.name == name);
            place.ok_or_else(|| MutationError::no_kernel(name, listings))
        };
        let bodies = chain.kind.links.iter().map(|link| find(&link.body.title.replace(' ', "_")));
        Ok(Self {
            bodies: bodies.collect::<Result<_, _>>()?,
            first_moment: find("first_moment")?,
            eliminate: find("eliminate")?,
            back_substitute: find("back_substitute")?,
            energy_momentum: find("energy_momentum")?,
            axes: find("axes")?,
            loads: find("loads")?,
            external: find("external")?,
            gravity: find("gravity")?,
        })
    }
}

fn unit(axis: Axis) -> Vector3<f64> {
    let mut v = Vector3::zeros();
    v[axis.cycle()[0]] = 1.0;
    v
}

impl BodySeen {
    /// Second derivative of the centre of mass, seen from B.
    pub(super) fn r_dprime(&self, joints: &[f64]) -> Vector3<f64> {
        let terms = self.columns.iter().zip(joints).map(|(column, q)| *q * column);
        terms.fold(self.r_dprime_rest, |sum, term| sum + term)
    }

    /// Angular velocity relative to B, along B.
    pub(super) fn omega_b(&self) -> Vector3<f64> {
        self.axes * self.omega
    }
}

impl Moment {
    /// `m c″`.
    pub(super) fn mc_dprime(&self, joints: &[f64]) -> Vector3<f64> {
        let terms = self.columns.iter().zip(joints).map(|(column, q)| *q * column);
        terms.fold(self.rest, |sum, term| sum + term)
    }
}
