//! What is changed, and what has been found under it: the laws ask the same of the same motions
//! again and again, and of functions that are not changed the result is the right ones'.

use std::cell::RefCell;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::kinematics::{BodyKinematics, Moment};
use super::poses_and_loads::{BodyPose, FieldLoads, JointWrenches};
use crate::mutation::energy_momentum::EnergyMomentum;
use crate::mutation::state::{Accelerations, Case, CaseName, Motion};
use crate::mutation::tape::Changed;

/// Which function is changed at which step: one, or with `prepare` all that use the node; by default
/// none.
#[derive(Default)]
pub(in crate::mutation) struct Fault {
    changed: Vec<Option<Changed>>,
    known: Rc<Results>,
    /// Of the unchanged functions.
    right: Rc<Results>,
}

/// Answers of one kind each.
#[derive(Default)]
pub(super) struct Results {
    pub(super) accelerations: Memo<Accelerations>,
    pub(super) bodies: Memo<Rc<BodyKinematics>>,
    pub(super) external: Memo<Rc<JointWrenches>>,
    pub(super) geometry: Memo<Rc<[BodyPose]>>,
    pub(super) energy_momentum: Memo<EnergyMomentum>,
    pub(super) loads: Memo<Rc<JointWrenches>>,
    pub(super) load_slopes: Memo<Rc<[f64]>>,
    pub(super) moments: Memo<Rc<Moment>>,
    pub(super) field_loads: Memo<Rc<FieldLoads>>,
    pub(super) poses: Memo<Rc<[BodyPose]>>,
}

/// Results by what was requested.
pub(super) struct Memo<V>(RefCell<FxHashMap<RequestKey, V>>);

/// All that a result depends on; a case stands for its parameters and all else that it is put to.
#[derive(PartialEq, Eq, Hash)]
struct RequestKey {
    function: Option<usize>,
    case: CaseName,
    /// Bit by bit.
    motion: Vec<u64>,
}

impl<V> Default for Memo<V> {
    fn default() -> Self {
        Self(RefCell::default())
    }
}

impl Fault {
    /// A change of these right functions.
    pub(super) fn new(right: &Self, changed: Vec<Option<Changed>>) -> Self {
        Self { changed, known: Rc::default(), right: Rc::clone(&right.known) }
    }

    /// Whether every function is right.
    pub(in crate::mutation) fn is_none(&self) -> bool {
        self.changed.iter().all(Option::is_none)
    }

    /// The change of function `index`.
    pub(super) fn changed(&self, index: usize) -> Option<Changed> {
        self.changed.get(index).copied().flatten()
    }

    /// What `find` finds by these functions; what it has found before is not found again.
    pub(super) fn result<V: Clone>(
        &self,
        memo: fn(&Results) -> &Memo<V>,
        functions: &[usize],
        case: &Case,
        motion: &Motion,
        find: impl FnOnce() -> V,
    ) -> V {
        let asked = RequestKey::new(functions, case, motion);
        let changed = functions.iter().any(|index| self.changed(*index).is_some());
        let right = if changed { None } else { memo(&self.right).get(&asked) };
        right.or_else(|| memo(&self.known).get(&asked)).unwrap_or_else(|| {
            let found = find();
            memo(&self.known).0.borrow_mut().insert(asked, found.clone());
            found
        })
    }
}

impl<V: Clone> Memo<V> {
    fn get(&self, asked: &RequestKey) -> Option<V> {
        self.0.borrow().get(asked).cloned()
    }
}

impl RequestKey {
    fn new(functions: &[usize], case: &Case, motion: &Motion) -> Self {
        let Motion { coordinates, rates, omega, velocity } = motion;
        let numbers = coordinates.iter().chain(rates).chain(omega.iter()).chain(velocity.iter());
        let motion = numbers.map(|number| number.to_bits()).collect();
        Self { function: functions.first().copied(), case: case.name, motion }
    }
}
