//! Sources of disturbance in the frequency domain: harmonics as tones of the rotors that they belong to, broadband noise
//! as densities at the mounts.
//!
//! A source on a mount exerts `f = R F`, `m = R M + p x f` on it, with the axes R and the point p of
//! [`SourcePlace`](crate::scenario::SourcePlace). A tone `C Omega^2 sin(h theta + phi)` of a rotor at the angle
//! `theta_0 + Omega t` is `Re(-i exp(i (phi + h theta_0)) C Omega^2 exp(i h Omega t))`.

use nalgebra::{Complex, Vector3};

use super::model::Model;
use crate::disturbance::{
    Broadband, COMPONENT_COUNT, Disturbance, Harmonic, Model as Kind, SourceTarget,
};
use crate::scenario::{Scenario, members};
use crate::structure::{COORDINATES, Fault};

/// Broadband noise on a mount.
#[derive(Clone, Debug)]
pub struct MountNoise {
    /// The name of its source.
    pub name: String,
    /// Number of the mount.
    pub mount: usize,
    /// Its densities.
    pub density: Broadband,
    /// Device and rotor whose rate scales it.
    pub rotor: Option<[usize; 2]>,
    /// Force and moment on the mount by the six components of the source: columns.
    pub wrench: [[f64; COORDINATES]; COMPONENT_COUNT],
}

impl Model {
    /// Adds the sources of a scenario; returns those that the frequency domain has not, each with the reason.
    ///
    /// # Errors
    /// As [`SweptDevice::add_tone`](super::device::SweptDevice::add_tone).
    pub fn add_sources(&mut self, scenario: &Scenario) -> Result<Vec<String>, Fault> {
        let mut left_out = Vec::new();
        for of in &scenario.disturbances {
            let refused = match self.mount_of(scenario, of) {
                Err(reason) => Some(reason),
                Ok((mount, wrench)) => match &of.model {
                    Kind::Harmonic(tones) => self.add_tones(scenario, of, tones, mount, &wrench)?,
                    Kind::Broadband(density) => {
                        self.noises.push(MountNoise {
                            name: of.name.clone(),
                            mount,
                            density: density.clone(),
                            rotor: of.wheel.and_then(|joint| self.rotor_of(joint)),
                            wrench,
                        });
                        None
                    }
                    Kind::Measured(_) => Some("a record over time has no speed to be swept"),
                },
            };
            if let Some(reason) = refused {
                left_out.push(format!("source `{}` is left out: {reason}", of.name));
            }
        }
        Ok(left_out)
    }

    /// The mount that a source acts on, and the force and moment on it by each of its components.
    fn mount_of(
        &self,
        scenario: &Scenario,
        of: &Disturbance,
    ) -> Result<(usize, [[f64; COORDINATES]; COMPONENT_COUNT]), &'static str> {
        let member = match of.on {
            SourceTarget::Mount(member) => member,
            SourceTarget::Hub { .. } | SourceTarget::Node { .. } | SourceTarget::Joint { .. } => {
                return Err(
                    "it acts on no mount of a device; name the device, as in `on = \"rw1\"`",
                );
            }
        };
        if members(&scenario.devices).get(member).is_none_or(|member| member.on().is_some()) {
            return Err("its device stands on a platform or panel");
        }
        let first = scenario.joints().take_while(|(device, ..)| *device < member).count();
        let device = self.devices.iter().find(|(_, device)| device.first_joint == first);
        let place = scenario.source_place(of);
        let Some(((mount, _), place)) = device.zip(place) else {
            return Err("it names what is not there");
        };
        let wrench = std::array::from_fn(|component| {
            let column = |k: usize| -> Vector3<f64> { place.axes.column(k).into_owned() };
            let (force, moment) = if component < 3 {
                let force = column(component);
                (force, place.point.cross(&force))
            } else {
                (Vector3::zeros(), column(component - 3))
            };
            std::array::from_fn(|k| if k < 3 { force[k] } else { moment[k - 3] })
        });
        Ok((*mount, wrench))
    }

    /// Device and rotor of a joint of the scenario; none of one that does not turn.
    fn rotor_of(&self, joint: usize) -> Option<[usize; 2]> {
        self.devices.iter().enumerate().find_map(|(number, (_, device))| {
            let own = joint.checked_sub(device.first_joint)?;
            let rotor = device.rotors.iter().position(|rotor| rotor.joint == own)?;
            Some([number, rotor])
        })
    }

    fn add_tones(
        &mut self,
        scenario: &Scenario,
        of: &Disturbance,
        tones: &[Harmonic],
        mount: usize,
        wrench: &[[f64; COORDINATES]; COMPONENT_COUNT],
    ) -> Result<Option<&'static str>, Fault> {
        let Some((joint, [number, rotor])) =
            of.wheel.and_then(|joint| Some((joint, self.rotor_of(joint)?)))
        else {
            return Ok(Some("its wheel does not turn"));
        };
        let Some((own, device)) = self.devices.get_mut(number) else { return Ok(None) };
        if *own != mount {
            return Ok(Some("its wheel stands on another mount"));
        }
        let angle = scenario.mean_joints().nth(joint).map_or(0.0, |[angle, _]| angle);
        let backwards = device.rotors.get(rotor).is_some_and(|rotor| rotor.rate(1.0) < 0.0);
        for tone in tones {
            let mut force = [Complex::new(0.0, 0.0); COORDINATES];
            for ((amplitude, phase), column) in tone.amplitudes.iter().zip(&tone.phases).zip(wrench)
            {
                let phase = phase + tone.number * angle;
                let phasor = Complex::new(0.0, -1.0) * Complex::from_polar(*amplitude, phase);
                let phasor = if backwards { phasor.conj() } else { phasor };
                for (to, by) in force.iter_mut().zip(column) {
                    *to += phasor * *by;
                }
            }
            device.add_tone(&of.name, rotor, tone.number, &force)?;
        }
        Ok(None)
    }
}
