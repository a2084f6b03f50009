//! Spacecraft whose devices are of one kind, in lanes, behind object-safe traits: batches, whose states
//! are flat rows as `precess::evaluation` lays them out, and runs side by side.
//!
//! A crate of its own: it holds the kernels of every kind in lanes of every width, which take minutes
//! to compile and rarely change. The flexible VSCMG has none: see `in_lanes`.
//!
//! Every number has the bits of `Spacecraft` with a `Vec<BuiltIn>`: the order of sums over devices is
//! the same.

mod kind_batch;
mod side_by_side;

pub use side_by_side::{Motion, SideBySide, side_by_side};

use nalgebra::Vector3;
use precess_dynamics::{
    BuiltIn, Devices, Each as _, Gravity, Hub, HubMode, Inputs, Mode, ParameterError, SolveError,
    StructureData, Wrench, every_kind,
};

/// States of a part: whole groups of the widest lanes, and several parts for each thread.
pub const PART: usize = 64;

/// What acts on every state, joints in order.
#[derive(Clone, Debug)]
pub struct StateInputs {
    /// External force through B, in B, N.
    pub force: Vector3<f64>,
    /// External torque about B, in B, N m.
    pub torque_b: Vector3<f64>,
    /// Motor torques or forces.
    pub motors: Vec<f64>,
    /// Modes.
    pub modes: Vec<Mode<f64>>,
    /// Mode of the hub.
    pub hub: HubMode<f64>,
    /// Gravity.
    pub gravity: Gravity<f64>,
    /// Wrenches on the bodies, where there are any.
    pub bodies: Option<Vec<Wrench<f64>>>,
}

impl StateInputs {
    /// Those of a spacecraft with any set of devices.
    #[must_use]
    pub fn new<D: Devices<Scalar = f64>, S: StructureData>(inputs: &Inputs<D, S>) -> Self {
        Self {
            force: inputs.force,
            torque_b: inputs.torque_b,
            motors: inputs.motors.values().collect(),
            modes: inputs.modes.values().collect(),
            hub: inputs.hub,
            gravity: inputs.gravity,
            bodies: inputs.bodies.as_ref().map(|bodies| bodies.values().collect()),
        }
    }
}

/// Sees states on the way: number within the part, steps so far, state.
pub type Observer<'a> = dyn FnMut(usize, usize, &[f64]) + 'a;

/// Steps between two looks at whether to go on, and of which samples are kept before they are seen.
pub const SEGMENT: usize = 256;

/// Who watches a run.
pub struct RunObserver<'a> {
    /// Sees states.
    pub see: &'a mut Observer<'a>,
    /// Whether to go on.
    pub go: &'a (dyn Fn() -> bool + Sync),
}

/// What became of each state of a part.
pub type StateResults = Vec<Result<(), SolveError<f64>>>;

/// Some steps.
#[derive(Clone, Copy, Debug)]
pub struct Steps {
    /// Length, s.
    pub length: f64,
    /// How many.
    pub count: usize,
    /// After how many a state is seen.
    pub every: usize,
}

/// A batch of spacecraft.
pub trait Lanes: Send + Sync {
    /// Accelerations of the states of a part, one row each; `inputs` has one of each, or the same.
    fn accelerations(
        &self,
        part: usize,
        y: &[f64],
        inputs: &[StateInputs],
        out: &mut [f64],
    ) -> StateResults;
    /// Steps of RK4, inputs held, while `go` says so. A state that fails is left as it was before the
    /// step that failed.
    fn run(
        &self,
        part: usize,
        y: &mut [f64],
        inputs: &[StateInputs],
        steps: Steps,
        watch: RunObserver<'_>,
    ) -> StateResults;
}

/// What a batch was made of.
pub enum BatchSupport {
    /// A batch, and what is wrong with each spacecraft.
    Lanes(Box<dyn Lanes>, Vec<Option<ParameterError<f64>>>),
    /// The devices are of several kinds or of one without lanes, or there are none.
    Unsupported,
}

/// The first device, where all spacecraft have as many devices as the first, and all are of its kind.
fn one_kind(crafts: &[(Hub, Vec<BuiltIn>)]) -> Option<&BuiltIn> {
    let (_, devices) = crafts.first()?;
    let first = devices.first()?;
    let alike = |(_, of): &(Hub, Vec<BuiltIn>)| {
        of.len() == devices.len() && of.iter().all(|device| device.kind() == first.kind())
    };
    crafts.iter().all(alike).then_some(first)
}

/// The devices as those of their kind.
macro_rules! devices_of {
    ($crafts:ident, $kind:ident) => {{
        let one = |device: &BuiltIn| match device {
            BuiltIn::$kind(device) => Some(*device),
            _ => None,
        };
        let of = |(hub, of): &(Hub, Vec<BuiltIn>)| (*hub, of.iter().filter_map(one).collect());
        $crafts.iter().map(of).collect::<Vec<_>>()
    }};
}
use devices_of;

/// What comes of a kind in lanes, or one by one where it has no lanes here: its spacecraft are evaluated one by
/// one, with the same bits. In lanes the kernels of the flexible VSCMG, with seven joints, would be a
/// twentieth of the Python package.
macro_rules! in_lanes {
    (FlexibleVscmg, $of_kind:expr, $alone:expr) => {
        $alone
    };
    ($kind:ident, $of_kind:expr, $alone:expr) => {
        $of_kind
    };
}
use in_lanes;

/// The batch of one spacecraft for every state, or of one for each.
#[must_use]
pub fn lanes(crafts: &[(Hub, Vec<BuiltIn>)], each: bool) -> BatchSupport {
    let Some(first) = one_kind(crafts) else { return BatchSupport::Unsupported };
    macro_rules! by_kind {
        ($($kind:ident $module:ident $number:literal;)*) => {
            match first {
                $(BuiltIn::$kind(_) => {
                    in_lanes!($kind, kind_batch::of_kind(&devices_of!(crafts, $kind), each), BatchSupport::Unsupported)
                })*
            }
        };
    }
    every_kind!(by_kind)
}
