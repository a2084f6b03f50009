//! The emitted functions of one kind, called as the solver and its users call them.

mod fault;
mod kinematics;
mod load_slopes;
mod poses_and_loads;
mod steering;

pub(super) use fault::Fault;
pub(super) use kinematics::BodyKinematics;
pub(super) use poses_and_loads::BodyPose;

use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};
use rustc_hash::FxHashSet;

use super::MutationError;
use super::energy_momentum::EnergyMomentum;
use super::listing::Listing;
use super::physics::Role;
use super::site::Site;
use super::state::{Accelerations, Case, Motion, parameters_of};
use super::tape::{Returned, Tape, Values};
use precess_codegen::derivation::chain::{Chain, Coordinate, Mode};
use precess_codegen::emit;
use precess_codegen::graph::{Expr, Stage};
use precess_codegen::kernel::Kernel;

/// Number of the function that all others read.
pub(super) const PREPARE: usize = 0;

/// The numbers of the functions that laws are put to.
struct Functions {
    /// One per body, from the hub outwards.
    bodies: Vec<usize>,
    first_moment: usize,
    constant_share: usize,
    eliminate: usize,
    back_substitute: usize,
    energy_momentum: usize,
    axes: usize,
    loads: usize,
    load_derivatives: usize,
    steer: usize,
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
    constant_share: Vec<(String, Expr<'g>)>,
}

impl<'a, 'g> Device<'a, 'g> {
    /// Lists and lays out every function of a kind.
    ///
    /// # Errors
    /// When the kind lacks a function that a law reads.
    pub(super) fn new(chain: &'a Chain<'g>) -> Result<Self, MutationError> {
        let graph = chain.graph;
        let emit::Functions { kernels, prepared } = emit::functions(chain).joined(graph);
        let claims: Vec<_> = kernels.iter().flat_map(|kernel| kernel.claims.clone()).collect();
        let (sections, record) = (&prepared.sections, &prepared.record);
        let nothing = FxHashSet::default();
        let mut listings =
            vec![Listing::new(graph, "prepare", sections, record, &claims, &nothing)];
        let given = prepared.given();
        let listing = |kernel: &Kernel<'g>| {
            let Kernel { name, sections, output, claims, .. } = kernel;
            Listing::new(graph, name, sections, output, claims, &given)
        };
        listings.extend(kernels.iter().map(listing));
        let tapes: Vec<_> = listings.iter().map(|listing| Tape::new(graph, listing)).collect();
        let symbol = |name: &str| graph.symbol(name, Stage::Parameter);
        let trigonometry = chain.kind.links.iter().map(|link| {
            ["sin", "cos"].map(|function| {
                graph.symbol(&format!("{function}_{}", link.joint.coordinate), Stage::Configuration)
            })
        });
        let functions = Functions::find(chain, &listings)?;
        let fields = listings[functions.eliminate].fields.iter();
        let constant_share = fields
            .filter(|(field, _)| field.starts_with("gain_") || field.starts_with("free_"))
            .map(|(field, _)| (field.clone(), graph.symbol(field, Stage::Rate)));
        Ok(Self {
            chain,
            parameters: parameters_of(chain.kind).iter().map(|name| symbol(name)).collect(),
            trigonometry: trigonometry.collect(),
            constant_share: constant_share.collect(),
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
            (functions.constant_share, Role::Solution),
            (functions.eliminate, Role::Solution),
            (functions.back_substitute, Role::Solution),
            (functions.energy_momentum, Role::Momenta),
            (functions.axes, Role::Axes),
            (functions.loads, Role::Loads),
            (functions.load_derivatives, Role::LoadDerivatives),
            (functions.steer, Role::Steering),
            (functions.external, Role::External),
            (functions.gravity, Role::Gravity),
        ];
        roles.into_iter().find(|(function, _)| *function == index).map(|(_, role)| role)
    }

    /// The fault that a site of function `index` stands for, of what is right without it.
    pub(super) fn fault(&self, right: &Fault, index: usize, site: &Site) -> Fault {
        let changed = |(k, tape): (usize, &Tape)| {
            let meant = index == PREPARE || k == index;
            let change = || tape.changed(self.chain.graph, &site.place, site.mutant.change);
            meant.then(change).flatten()
        };
        Fault::new(right, self.tapes.iter().enumerate().map(changed).collect())
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
        self.chain.kind.links[k].body.mass.map_or(0.0, |mass| self.parameter(case, mass))
    }

    fn parameter(&self, case: &Case, name: &str) -> f64 {
        let of = self.chain.graph.find(name);
        let place = self.parameters.iter().position(|symbol| Some(*symbol) == of);
        place.map_or(f64::NAN, |place| case.parameters[place])
    }

    /// Every argument a function may read, accelerations apart.
    fn arguments(&self, case: &Case, motion: &Motion) -> Values {
        let mut values = Values::covering(self.chain.graph);
        for (column, axis) in self.chain.mount.iter().zip(case.mount.column_iter()) {
            values.set_vector(column.components(), axis.into_owned());
        }
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
        self.tapes[index].evaluate(values, fault.changed(index))
    }

    /// `eliminate`.
    pub(super) fn eliminated(&self, case: &Case, fault: &Fault) -> Returned<'_> {
        self.call(self.functions.eliminate, &self.arguments(case, &case.motion), fault)
    }

    /// All accelerations of hub and device: `eliminate`, the hub's own six equations by Newton and
    /// Euler for one rigid body, `back_substitute`.
    pub(super) fn accelerations(&self, case: &Case, fault: &Fault) -> Accelerations {
        let functions = [
            self.functions.eliminate,
            self.functions.back_substitute,
            self.functions.constant_share,
        ];
        let find = || self.solved(case, fault);
        fault.result(|known| &known.accelerations, &functions, case, &case.motion, find)
    }

    /// Along B axes, as these functions are, then along the device's.
    fn solved(&self, case: &Case, fault: &Fault) -> Accelerations {
        let mount = &case.mount;
        let mut values = self.arguments(case, &case.motion);
        let omega = mount * case.motion.omega;
        values.set_vector(self.chain.hub.omega.components(), omega);
        let device = self.call(self.functions.eliminate, &values, fault);
        let constant_share = self.call(self.functions.constant_share, &values, fault);
        let hub = &case.hub;
        let centre = mount * hub.centre;
        let lever = centre.cross_matrix();
        let own = mount * hub.inertia * mount.transpose() - hub.mass * lever * lever;
        // Hub and device as one rigid body.
        let mass = hub.mass + constant_share.scalar("constant_m");
        let moment = hub.mass * centre
            + (constant_share.vector("constant_mr", "b") + device.vector("mr_moving", "b"));
        let inertia = own + (constant_share.tensor("constant_i") + device.tensor("i_moving"));
        let mut m = Matrix6::zeros();
        let mut put = |row: usize, column: usize, block: Matrix3<f64>| {
            m.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
        };
        let taken = Matrix3::from_fn(|row, column| {
            device.scalar(&format!("m_vw_{}{}", row + 1, column + 1))
        });
        let coupling = -moment.cross_matrix() - taken;
        put(0, 0, Matrix3::from_diagonal_element(mass) - device.tensor("m_vv"));
        put(0, 3, coupling);
        put(3, 0, coupling.transpose());
        put(3, 3, inertia - device.tensor("m_ww"));
        let taken =
            |stem: &str| Vector3::from_fn(|row, _| device.scalar(&format!("{stem}_{}", row + 1)));
        let force = mount * case.drive.force - omega.cross(&omega.cross(&moment)) - taken("h_v");
        let torque = mount * case.drive.torque - omega.cross(&(inertia * omega)) - taken("h_w");
        let mut right = Vector6::zeros();
        right.fixed_rows_mut::<3>(0).copy_from(&force);
        right.fixed_rows_mut::<3>(3).copy_from(&torque);
        let nothing = || Vector6::from_element(f64::NAN);
        let solution = m.lu().solve(&right).unwrap_or_else(nothing);
        let part = |row: usize| solution.fixed_rows::<3>(row).into_owned();

        values.set_vector(self.chain.hub.r_b_n_ddot.components(), part(0));
        values.set_vector(self.chain.hub.omega_dot.components(), part(3));
        for (field, symbol) in &self.constant_share {
            values.set(*symbol, device.scalar(field));
        }
        let joints = self.call(self.functions.back_substitute, &values, fault);
        let names = self.chain.kind.links.iter().map(|link| link.joint.acceleration);
        let joints = names.map(|name| joints.scalar(name)).collect();
        let along = |v: Vector3<f64>| mount.transpose() * v;
        Accelerations { point: along(part(0)), omega: along(part(3)), joints }
    }

    /// `energy_momentum`.
    pub(super) fn energy_momentum(
        &self,
        case: &Case,
        motion: &Motion,
        fault: &Fault,
    ) -> EnergyMomentum {
        let function = self.functions.energy_momentum;
        fault.result(
            |known| &known.energy_momentum,
            &[function],
            case,
            motion,
            || {
                let returned = self.call(function, &self.arguments(case, motion), fault);
                // The names without a search: this is called more often than all else together.
                let vector =
                    |names: [&str; 3]| Vector3::from(names.map(|name| returned.scalar(name)));
                EnergyMomentum {
                    energy: returned.scalar("energy"),
                    linear: vector(["linear_bx", "linear_by", "linear_bz"]),
                    angular: vector(["angular_b_bx", "angular_b_by", "angular_b_bz"]),
                }
            },
        )
    }

    /// The joints' own mass matrix as the energies of their motions: `T = sum of M_jk q_j' q_k' /
    /// 2`.
    pub(super) fn joint_masses(&self, case: &Case, fault: &Fault) -> DMatrix<f64> {
        let energy = |moving: &[usize]| {
            let rate = |k: usize| if moving.contains(&k) { 1.0 } else { 0.0 };
            let motion = case.motion.joints_alone((0..self.joints()).map(rate).collect());
            self.energy_momentum(case, &motion, fault).energy
        };
        DMatrix::from_fn(self.joints(), self.joints(), |j, k| {
            if j == k { 2.0 * energy(&[j]) } else { energy(&[j, k]) - energy(&[j]) - energy(&[k]) }
        })
    }
}

impl Functions {
    /// Finds each by its name.
    fn find(chain: &Chain<'_>, listings: &[Listing<'_>]) -> Result<Self, MutationError> {
        let find = |name: &str| {
            let place = listings.iter().position(|listing| listing.name == name);
            place.ok_or_else(|| MutationError::no_kernel(name, listings))
        };
        let bodies = chain.kind.links.iter().map(|link| find(&link.body.title.replace(' ', "_")));
        Ok(Self {
            bodies: bodies.collect::<Result<_, _>>()?,
            first_moment: find("first_moment")?,
            constant_share: find("constant_share")?,
            eliminate: find("eliminate")?,
            back_substitute: find("back_substitute")?,
            energy_momentum: find("energy_momentum")?,
            axes: find("axes")?,
            loads: find("loads")?,
            load_derivatives: find("load_derivatives")?,
            steer: find("steer")?,
            external: find("external")?,
            gravity: find("gravity")?,
        })
    }
}
