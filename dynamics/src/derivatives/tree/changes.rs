//! [`Changes`]: what a variable changes of a tree of carriers at given accelerations: how bases move, and loads.

use alloc::vec::Vec;

use crate::derivatives::loads::side_by_side::Load;
use crate::derivatives::tree::base_motion::BaseMotion;
use crate::derivatives::tree::members::{Base, Members};
use crate::isolation::motion::Spatial;
use crate::numbers::real::{Scalar, zero};
use crate::numbers::vec3::{add, zeros};

/// What a column changes: how bases move, loads on bases, loads along joints.
#[derive(Debug)]
pub(crate) struct Changes<T> {
    pub(crate) motions: Vec<Option<BaseMotion<T>>>,
    pub(crate) loads: Vec<Spatial<T>>,
    pub(crate) joints: Vec<T>,
    pub(crate) modes: Vec<T>,
    /// The acceleration of a hub that is not free.
    pub(crate) given: Spatial<T>,
}

impl<T: Scalar> Changes<T> {
    pub(crate) fn none(members: &Members<T>, modes: usize) -> Self {
        Self {
            motions: alloc::vec![None; members.bases.len()],
            loads: alloc::vec![[zeros(); 2]; members.bases.len()],
            joints: alloc::vec![zero(); members.joints.len()],
            modes: alloc::vec![zero(); modes],
            given: [zeros(); 2],
        }
    }

    /// Nothing.
    pub(crate) fn clear(&mut self) {
        self.motions.fill(None);
        self.loads.fill([zeros(); 2]);
        self.joints.fill(zero());
        self.modes.fill(zero());
        self.given = [zeros(); 2];
    }

    /// The loads of the hub, of the modes and of the joints.
    pub(crate) fn rows(&self) -> impl Iterator<Item = T> {
        let hub = self.loads.first().into_iter().flatten().flatten();
        hub.chain(&self.modes).chain(&self.joints).copied()
    }

    /// The motion of a base changes by this, too.
    pub(crate) fn moves(&mut self, base: usize, by: &BaseMotion<T>) {
        if let Some(to) = self.motions.get_mut(base) {
            *to = Some(to.map_or(*by, |to| to.plus(by)));
        }
    }

    /// The acceleration of a hub that is not free.
    pub(crate) fn accelerates(&mut self, by: Spatial<T>) {
        self.given = by;
        self.moves(0, &BaseMotion::accelerating(by));
    }

    /// A load along a mode.
    pub(crate) fn mode(&mut self, mode: usize, load: T) {
        if let Some(to) = self.modes.get_mut(mode) {
            *to = *to + load;
        }
    }

    /// Loads along the coordinates of a carrier, or of a mount, whose coordinates are those of the modes.
    pub(crate) fn along(&mut self, base: &Base<T>, loads: impl Iterator<Item = T> + Clone) {
        if let Some(shapes) = &base.shapes {
            for (to, shape) in self.modes.iter_mut().zip(shapes) {
                *to = shape.iter().zip(loads.clone()).fold(*to, |sum, (by, load)| sum + *by * load);
            }
            return;
        }
        let joints = self.joints.iter_mut().skip(base.first);
        joints.zip(loads).for_each(|(to, load)| *to = *to + load);
    }

    /// A load on a base.
    pub(crate) fn load(&mut self, base: usize, [force, moment]: Spatial<T>) {
        if let Some([f, m]) = self.loads.get_mut(base) {
            (*f, *m) = (add(*f, force), add(*m, moment));
        }
    }

    /// The loads of a device on its base, and along its joints from that of the number `first` on.
    pub(crate) fn add(&mut self, base: usize, first: usize, load: &Load<T>) {
        let [a, b, c, d, e, f] = load.hub;
        self.load(base, [[a, b, c], [d, e, f]]);
        let joints = self.joints.iter_mut().skip(first).zip(load.joints);
        joints.for_each(|(to, from)| *to = *to + from);
    }
}
