//! What is changed, and what has been found under it: the laws ask the same of the same motions
//! again and again, and of functions that are not changed the result is the right ones'.

use std::cell::RefCell;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::exerted::{Carried, Pulled, Stand};
use super::seen::{BodySeen, Moment};
use crate::mutation::held::Held;
use crate::mutation::state::{Accelerations, Case, CaseName, Motion};
use crate::mutation::tape::Changed;

/// Which function is changed at which step: one, or with `prepare` all that use the node; by default
/// none.
#[derive(Default)]
pub(in crate::mutation) struct Fault {
    changed: Vec<Option<Changed>>,
    known: Rc<Known>,
    /// Of the unchanged functions.
    right: Rc<Known>,
}

/// Answers of one kind each.
#[derive(Default)]
pub(super) struct Known {
    pub(super) accelerations: Memo<Accelerations>,
    pub(super) bodies: Memo<Rc<BodySeen>>,
    pub(super) external: Memo<Rc<Carried>>,
    pub(super) geometry: Memo<Rc<[Stand]>>,
    pub(super) held: Memo<Held>,
    pub(super) loads: Memo<Rc<Carried>>,
    pub(super) moments: Memo<Rc<Moment>>,
    pub(super) pulled: Memo<Rc<Pulled>>,
    pub(super) stands: Memo<Rc<[Stand]>>,
}

/// Results by what was requested.
pub(super) struct Memo<V>(RefCell<FxHashMap<Asked, V>>);

/// All that a result depends on; a case stands for its parameters and all else that it is put to.
#[derive(PartialEq, Eq, Hash)]
struct Asked {
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
    pub(super) fn of(right: &Self, changed: Vec<Option<Changed>>) -> Self {
        Self { changed, known: Rc::default(), right: Rc::clone(&right.known) }
    }

    /// The change of function `index`.
    pub(super) fn changed(&self, index: usize) -> Option<Changed> {
        self.changed.get(index).copied().flatten()
    }

    /// What `find` finds by these functions; what it has found before is not found again.
    pub(super) fn answer<V: Clone>(
        &self,
        memo: fn(&Known) -> &Memo<V>,
        functions: &[usize],
        case: &Case,
        motion: &Motion,
        find: impl FnOnce() -> V,
    ) -> V {
        let asked = Asked::new(functions, case, motion);
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
    fn get(&self, asked: &Asked) -> Option<V> {
        self.0.borrow().get(asked).cloned()
    }
}

impl Asked {
    fn new(functions: &[usize], case: &Case, motion: &Motion) -> Self {
        let Motion { coordinates, rates, omega, velocity } = motion;
        let numbers = coordinates.iter().chain(rates).chain(omega.iter()).chain(velocity.iter());
        let motion = numbers.map(|number| number.to_bits()).collect();
        Self { function: functions.first().copied(), case: case.name, motion }
    }
}
