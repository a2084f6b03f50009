//! Spacecraft of every kind in general motion: what is timed and counted.
//!
//! Costs depend on the set, the modes and gravity, not on the numbers, so bare devices will
//! do; no coordinate, rate or torque is zero, and no gimbal is where it loses its inertia.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Each, JointStates, Kind};
use precess_dynamics::{
    Accelerations, Axis, BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg,
    BalancedVscmg, Devices, Dgcmg, Dgvscmg, FlexibleReactionWheel, FlexibleVscmg, HingedPanel, Hub,
    Inputs, ParameterVariable, ReactionWheel, Scalar, Sgcmg, SloshMass, SolveError, Spacecraft,
    State, Vscmg,
};

use crate::random::{Random, SEED};

const VALID: &str = "the parameters of a bare device are valid";

/// A spacecraft with its state and inputs.
#[derive(Clone, Debug)]
pub struct Measured<D: Devices> {
    /// The spacecraft.
    pub craft: Spacecraft<D>,
    /// Its state.
    pub state: State<D>,
    /// What acts on it.
    pub inputs: Inputs<D>,
}

impl<D: Devices> Measured<D> {
    /// These devices on a hub, in motion.
    ///
    /// # Panics
    /// If the solver rejects the devices.
    #[must_use]
    pub fn new(devices: &D) -> Self {
        let random = &mut Random::new(SEED);
        let mut number = |size: f64| D::Scalar::from_f64(random.within(0.5 * size, size));
        let craft = Spacecraft::new(&hub(), devices).expect(VALID);
        let (mut state, mut inputs) = (State::at_rest_for(&craft), Inputs::none_for(&craft));
        state.r_b_n = Vector3::from_fn(|_, _| number(100.0));
        state.r_b_n_dot = Vector3::from_fn(|_, _| number(10.0));
        state.omega = Vector3::from_fn(|_, _| number(0.5));
        inputs.force = Vector3::from_fn(|_, _| number(10.0));
        inputs.torque_b = Vector3::from_fn(|_, _| number(1.0));
        for [coordinate, rate] in state.devices.states_mut() {
            (*coordinate, *rate) = (number(1.0), number(2.0));
        }
        for motor in inputs.motors.values_mut() {
            *motor = number(0.2);
        }
        Self { craft, state, inputs }
    }

    /// All accelerations.
    ///
    /// # Errors
    /// As [`Spacecraft::accelerations`].
    pub fn accelerations(&self) -> Result<Accelerations<D>, SolveError<D::Scalar>> {
        self.craft.accelerations(&self.state, &self.inputs)
    }
}

/// The hub of the measured spacecraft.
#[must_use]
pub fn hub<T: Scalar>() -> Hub<T> {
    let of = T::from_f64;
    let rows = [900.0, 50.0, 30.0, 50.0, 800.0, 20.0, 30.0, 20.0, 600.0];
    Hub {
        m_b: of(800.0),
        r_bc_b: Vector3::new(of(0.1), of(-0.2), of(0.3)),
        i_b_bc: Matrix3::from_row_iterator(rows.map(of)),
    }
}

/// Something to do with a device of each kind.
pub trait EachKind<T: Scalar> {
    /// Called once a kind, with its name.
    fn visit<K: Kind<Scalar = T>>(&mut self, name: &'static str, device: K);
}

/// Shows a device of each of the fourteen kinds, larger ones first.
pub fn each_kind<T: Scalar>(visitor: &mut impl EachKind<T>) {
    let of = T::from_f64;
    let (mass, axial, across) = (of(4.0), of(0.2), of(0.1));
    let disc = disc();
    // A massless gimbal whose rotor moves in all six freedoms has no inertia at all.
    let gimbal = FlexibleVscmg { m_g: mass, i_g_gc: disc, ..FlexibleVscmg::bare_wheel(mass, disc) };
    visitor.visit("flexible_vscmg", gimbal);
    visitor.visit("flexible_reaction_wheel", FlexibleReactionWheel::bare_wheel(mass, disc));
    visitor.visit("dgvscmg", Dgvscmg::bare_wheel(mass, disc));
    visitor.visit("balanced_dgvscmg", BalancedDgvscmg::bare_wheel(mass, axial, across));
    visitor.visit("dgcmg", Dgcmg::bare_wheel(mass, disc));
    visitor.visit("balanced_dgcmg", BalancedDgcmg::bare_wheel(mass, axial, across));
    visitor.visit("vscmg", Vscmg::bare_wheel(mass, disc));
    visitor.visit("balanced_vscmg", BalancedVscmg::bare_wheel(mass, axial, across));
    visitor.visit("sgcmg", Sgcmg::bare_wheel(mass, disc));
    visitor.visit("balanced_sgcmg", BalancedSgcmg::bare_wheel(mass, axial, across));
    visitor.visit("reaction_wheel", ReactionWheel::bare_wheel(mass, disc));
    visitor
        .visit("balanced_reaction_wheel", BalancedReactionWheel::bare_wheel(mass, axial, across));
    visitor.visit("hinged_panel", HingedPanel::bare_panel(mass, disc));
    visitor.visit("slosh_mass", SloshMass::bare_slosh_mass(mass));
}

/// The paper's device, of which most measurements are.
#[must_use]
pub fn dgvscmg<T: Scalar>() -> Dgvscmg<T> {
    Dgvscmg::bare_wheel(T::from_f64(4.0), disc())
}

/// A wheel's inertia, kg m².
fn disc<T: Scalar>() -> Matrix3<T> {
    let rows = [0.2, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.1];
    Matrix3::from_row_iterator(rows.map(T::from_f64))
}

/// Something to do with each set of devices that the benches run over.
pub trait EachSet {
    /// Called once a set, with its name.
    fn visit<D: Devices<Scalar = f64>>(&mut self, name: &str, devices: &D);
}

/// Shows a visitor 1, 4, 16 and 64 DGVSCMGs, then four devices of each kind.
///
/// # Panics
/// Never.
pub fn each_set(visitor: &mut impl EachSet) {
    visitor.visit("1", &[dgvscmg(); 1]);
    visitor.visit("4", &[dgvscmg(); 4]);
    visitor.visit("16", &[dgvscmg(); 16]);
    let most: Box<[_; 64]> = vec![dgvscmg(); 64].try_into().expect("64 devices");
    visitor.visit("64", &*most);
    each_kind(&mut OfFour(visitor));
}

/// Takes four devices of a kind for a set.
struct OfFour<'a, V>(&'a mut V);

impl<V: EachSet> EachKind<f64> for OfFour<'_, V> {
    fn visit<K: Kind<Scalar = f64>>(&mut self, name: &'static str, device: K) {
        self.0.visit(name, &[device; 4]);
    }
}

/// What campaigns vary of a device: six parameters.
#[must_use]
pub const fn imbalance_of(device: usize) -> [ParameterVariable<'static>; 6] {
    [
        ParameterVariable::StaticImbalance { device },
        ParameterVariable::DynamicImbalance { device },
        ParameterVariable::Phase { device },
        ParameterVariable::MountRotation { device, about: Axis::X },
        ParameterVariable::MountRotation { device, about: Axis::Y },
        ParameterVariable::MountRotation { device, about: Axis::Z },
    ]
}
