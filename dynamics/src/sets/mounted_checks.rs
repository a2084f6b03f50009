//! A sketch that compiles: devices on a moving mount are a set like any other. [`Mounted`] has the
//! data of the mount and of what it carries, and shows a visitor the carried devices first, which is
//! the order of an elimination from the tips to the hub.
//!
//! What the equations need beyond the shape: the visitor has to enter the mount's frame before the
//! carried devices (its angular velocity and acceleration per joint) and to add their share to the
//! mount's own before its joint is eliminated. Data, counts, lists and new data need nothing more.

use std::vec::Vec;

use nalgebra::Matrix3;

use crate::equations::device::Device;
use crate::model::kind::Kind;
use crate::numbers::each::JointStates;
use crate::sets::bundle::{Bundle, Part, Shared, Unique};
use crate::sets::devices::{DeviceSet, JointInfos, List, Visit};
use crate::sets::per_device::{Joints, PerDevice, PerJoint};
use crate::validation::parameter_error::ParameterError;
use crate::{HingedPanel, ReactionWheel, Sgcmg};

/// Devices on a device that moves.
#[derive(Clone, Debug, PartialEq)]
struct Mounted<M, D> {
    mount: M,
    carried: D,
}

/// The mount's part of data.
#[derive(Clone, Copy)]
struct OfMount;

/// The part of what it carries.
#[derive(Clone, Copy)]
struct OfCarried;

impl<M: Kind, D: DeviceSet<Scalar = M::Scalar>> Part<Mounted<M, D>> for OfMount {
    type Of = M;

    fn of<F: PerDevice<M::Scalar>>(self, whole: &(D::Per<F>, F::Of<M>)) -> Option<&F::Of<M>> {
        Some(&whole.1)
    }

    fn of_mut<F: PerDevice<M::Scalar>>(
        self,
        whole: &mut (D::Per<F>, F::Of<M>),
    ) -> Option<&mut F::Of<M>> {
        Some(&mut whole.1)
    }
}

impl<M: Kind, D: DeviceSet<Scalar = M::Scalar>> Part<Mounted<M, D>> for OfCarried {
    type Of = D;

    fn of<F: PerDevice<M::Scalar>>(self, whole: &(D::Per<F>, F::Of<M>)) -> Option<&D::Per<F>> {
        Some(&whole.0)
    }

    fn of_mut<F: PerDevice<M::Scalar>>(
        self,
        whole: &mut (D::Per<F>, F::Of<M>),
    ) -> Option<&mut D::Per<F>> {
        Some(&mut whole.0)
    }
}

impl<M: Kind, D: DeviceSet<Scalar = M::Scalar>> DeviceSet for Mounted<M, D> {
    type Scalar = M::Scalar;
    type Prepared = (D::Prepared, Device<M>);
    type Per<F: PerDevice<M::Scalar>> = (D::Per<F>, F::Of<M>);

    fn check(&self, device: &mut usize) -> Result<(), ParameterError<M::Scalar>> {
        self.carried.check(device)?;
        self.mount.check(device)
    }

    fn prepare(&self) -> Self::Prepared {
        (self.carried.prepare(), self.mount.prepare())
    }

    fn new_data<F: PerDevice<M::Scalar>>(
        (carried, mount): &Self::Prepared,
        family: &F,
    ) -> Self::Per<F> {
        (D::new_data(carried, family), M::new_data(mount, family))
    }

    fn list<L: List<M::Scalar>>(
        (carried, mount): &Self::Prepared,
    ) -> impl Iterator<Item = L::Item> {
        D::list::<L>(carried).chain(M::list::<L>(mount))
    }

    fn visit<B: Bundle<M::Scalar>, V: Visit<M::Scalar, B>>(
        (carried, mount): &Self::Prepared,
        mut data: B::Of<'_, Self>,
        visitor: &mut V,
    ) -> Result<(), V::Error> {
        if let Some(data) = B::part::<Self, OfCarried>(&mut data, OfCarried) {
            D::visit::<B, V>(carried, data, visitor)?;
        }
        if let Some(data) = B::part::<Self, OfMount>(&mut data, OfMount) {
            M::visit::<B, V>(mount, data, visitor)?;
        }
        Ok(())
    }

    fn count<F: PerDevice<M::Scalar>>(_: &Self::Per<F>) -> Option<usize> {
        None
    }
}

/// Takes the first coordinate of each device down.
struct FirstCoordinates(usize);

impl Visit<f64, (Shared<Joints>, Unique<PerJoint<f64>>)> for FirstCoordinates {
    type Error = usize;

    fn visit<K: Kind<Scalar = f64>>(
        &mut self,
        _: &Device<K>,
        (joints, values): (&K::Joints<f64>, &mut K::PerJoint<f64>),
    ) -> Result<(), usize> {
        use crate::numbers::each::Each;
        let first = joints.states().next().map(|[coordinate, _]| coordinate);
        for value in values.values_mut() {
            *value = first.ok_or(self.0)?;
        }
        self.0 += 1;
        Ok(())
    }
}

#[test]
fn devices_on_a_moving_mount_are_a_set() {
    type Set = (Mounted<HingedPanel, [ReactionWheel; 2]>, Sgcmg);
    let unit = Matrix3::identity();
    let wheel = ReactionWheel::bare_wheel(1.0, unit);
    let mounted = Mounted { mount: HingedPanel::bare_panel(3.0, unit), carried: [wheel; 2] };
    let devices = (mounted, Sgcmg::bare_wheel(1.0, unit)).prepare();
    let bodies: Vec<_> = Set::list::<JointInfos>(&devices).map(|info| info.body).collect();
    assert_eq!(bodies, ["wheel", "wheel", "panel", "gimbal", "wheel"]);

    let mut joints = Set::new_data(&devices, &Joints);
    joints.0.0[1].theta = 2.0;
    joints.0.1.states_mut().for_each(|[coordinate, _]| *coordinate = 3.0);
    joints.1.gamma = 4.0;
    let mut values = Set::new_data(&devices, &PerJoint(0.0));
    let mut visitor = FirstCoordinates(0);
    let data = (&joints, &mut values);
    assert_eq!(
        Set::visit::<(Shared<Joints>, Unique<PerJoint<f64>>), _>(&devices, data, &mut visitor),
        Ok(())
    );
    assert_eq!(visitor.0, 4, "four devices");
    assert_eq!((values.0.0[0].wheel, values.0.0[1].wheel), (0.0, 2.0));
    assert_eq!((values.0.1.panel, values.1.gimbal, values.1.wheel), (3.0, 4.0, 4.0));
}
