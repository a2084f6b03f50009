//! What engines that nobody here wrote computed for some spacecraft with one device.

use nalgebra::Vector3;

use super::law::Law;
use super::stored::{Body, EngineError, Stored, tensor};
use super::trial::{Residuals, Role, concerns, gap};
use crate::mutation::device::{Device, Fault};
use crate::mutation::energy_momentum::EnergyMomentum;
use crate::mutation::state::Accelerations;
use precess_codegen::kinds::Kind;

/// The stored values, ready to be compared with.
#[derive(Clone)]
pub struct Engines {
    kind: &'static str,
    cases: Vec<Stored>,
}

impl Engines {
    /// Reads the spacecraft of a kind that count here: one device on an identity mount, everything
    /// of order one.
    ///
    /// # Errors
    /// When the text is not what the engines' store writes, or holds no such spacecraft.
    pub fn parse(kind: &Kind, json: &str) -> Result<Self, EngineError> {
        Ok(Self { kind: kind.name, cases: Stored::read(kind, json)? })
    }

    /// How many spacecraft of a kind there are.
    pub(in crate::mutation) fn count(&self, kind: &Kind) -> usize {
        if kind.name == self.kind { self.cases.len() } else { 0 }
    }

    /// Residuals of the laws that a change in `role` can move; none for a kind of which no
    /// values of the engines are stored.
    pub(super) fn residuals(
        &self,
        device: &Device<'_, '_>,
        fault: &Fault,
        role: Option<Role>,
    ) -> Residuals {
        let mut found = Vec::new();
        let count = self.count(device.chain.kind);
        for stored in &self.cases[..count] {
            if concerns(role, &[Role::Solution]) {
                found.push((Law::EngineAccelerations, stored.accelerations(device, fault)));
            }
            if concerns(role, &[Role::Momenta]) {
                found.push((Law::EngineMomenta, stored.momenta(device, fault)));
            }
            if concerns(role, &[Role::Body]) {
                found.push((Law::EngineBodies, stored.bodies(device, fault)));
            }
            if concerns(role, &[Role::FirstMoment]) {
                found.push((Law::EngineFirstMoment, stored.first_moment(device, fault)));
            }
        }
        found
    }
}

impl Stored {
    fn accelerations(&self, device: &Device<'_, '_>, fault: &Fault) -> f64 {
        let row = |a: &Accelerations| [a.point.as_slice(), a.omega.as_slice(), &a.joints].concat();
        let ours = row(&device.accelerations(&self.case, fault));
        self.accelerations.iter().map(|theirs| gap(&ours, &row(theirs))).fold(0.0, f64::max)
    }

    /// Energy and momenta of the whole spacecraft.
    fn momenta(&self, device: &Device<'_, '_>, fault: &Fault) -> f64 {
        let (case, motion) = (&self.case, &self.case.motion);
        let whole = device.energy_momentum(case, motion, fault).packed()
            + case.hub.energy_momentum(motion).packed();
        let ours = EnergyMomentum::unpacked(&whole);
        let energy = gap(&[ours.energy; 2], &self.energy);
        let linear = gap(ours.linear.as_slice(), self.linear.as_slice());
        energy.max(linear).max(gap(ours.angular.as_slice(), self.angular.as_slice()))
    }

    fn bodies(&self, device: &Device<'_, '_>, fault: &Fault) -> f64 {
        let joints = &self.accelerations[0].joints;
        let residual = |(k, theirs): (usize, &Body)| {
            let ours = device.body(k, &self.case, &self.case.motion, fault);
            let vectors = [
                (ours.r, theirs.r),
                (ours.r_prime, theirs.r_prime),
                (ours.r_dprime(joints), theirs.r_dprime),
                (ours.omega_b(), theirs.omega_b),
            ];
            let worst = vectors.iter().map(|(ours, theirs)| gap(ours.as_slice(), theirs));
            let inertia = gap(ours.inertia_b.as_slice(), tensor(theirs.i_b).as_slice());
            worst.fold(inertia, f64::max)
        };
        self.bodies.iter().enumerate().map(residual).fold(0.0, f64::max)
    }

    fn first_moment(&self, device: &Device<'_, '_>, fault: &Fault) -> f64 {
        let ours = device.moment(&self.case, &self.case.motion, fault);
        let sum = |of: fn(&Body) -> [f64; 3]| {
            let terms = self.bodies.iter().enumerate();
            let term = |(k, body): (usize, &Body)| {
                device.body_mass(k, &self.case) * Vector3::from(of(body))
            };
            terms.map(term).sum::<Vector3<f64>>()
        };
        let mc_dprime = ours.mc_dprime(&self.accelerations[0].joints);
        let pairs = [
            (ours.mc, sum(|body| body.r)),
            (ours.mc_prime, sum(|body| body.r_prime)),
            (mc_dprime, sum(|body| body.r_dprime)),
        ];
        pairs.iter().map(|(a, b)| gap(a.as_slice(), b.as_slice())).fold(0.0, f64::max)
    }
}
