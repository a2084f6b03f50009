//! A spacecraft as plain numbers in SI units: mass properties, mounts, and which joints are locked.
//!
//! The desktop tool derives nothing and the generator reads no scenario: this is what one writes
//! and the other reads. It depends on neither.
//!
//! Invariant of a [`Description`] that was [read](Description::read): every number is finite, names
//! are unique identifiers, inertias are symmetric.

mod error;
mod turn;

use serde::{Deserialize, Serialize};

pub use error::DescriptionError;
pub use turn::{Axis, Turn};

/// The version of the format.
pub const FORMAT: u32 = 1;

/// A spacecraft.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Description {
    /// [`FORMAT`].
    pub format: u32,
    /// Its name in file names and code: lower case, digits, underscores.
    pub name: String,
    /// What a heading says.
    #[serde(default)]
    pub title: String,
    /// The hub.
    pub hub: Hub,
    /// The devices, in order.
    pub device: Vec<Device>,
}

/// The hub.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hub {
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass from B, B axes, m.
    pub centre_of_mass: [f64; 3],
    /// Inertia about the centre of mass, B axes, kg m².
    pub inertia: [[f64; 3]; 3],
}

/// A device.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Device {
    /// Its name: lower case, digits, underscores.
    pub name: String,
    /// The kind's module: `dgvscmg`.
    pub kind: String,
    /// Row by row; columns are the device's axes expressed in B.
    pub mount: [[f64; 3]; 3],
    /// The turns that the mount is made of, first from the hub, where they are known: the form of
    /// the mount is then theirs, and not found in its numbers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turns: Option<Vec<Turn>>,
    /// Its bodies from the hub outwards.
    pub body: Vec<Body>,
    /// Parameters whose zero, or equality with another one, is a coincidence: they stay parameters.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub keep: Vec<String>,
}

/// A body of a device, and the joint that it moves on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Mass, kg.
    pub mass: f64,
    /// Origin of the joint from the origin of the parent body, expressed in the parent body's axes,
    /// m; of the first joint from B, expressed in B.
    pub origin: [f64; 3],
    /// Centre of mass from the joint's origin, own axes, m.
    pub centre_of_mass: [f64; 3],
    /// Inertia about the centre of mass, own axes, kg m².
    pub inertia: [[f64; 3]; 3],
    /// Where the joint is locked for good: its coordinate, rad or m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub locked_at: Option<f64>,
}

impl Description {
    /// Reads a description.
    ///
    /// # Errors
    /// With the place in the text where it is not TOML or has another form; with the device and the
    /// remedy where a value is none that a spacecraft can have.
    pub fn read(text: &str) -> Result<Self, DescriptionError> {
        let read: Self = toml::from_str(text).map_err(DescriptionError::Syntax)?;
        read.check()?;
        Ok(read)
    }

    /// The text that [reads](Self::read) back the same.
    ///
    /// # Errors
    /// Where a value is none that a spacecraft can have.
    pub fn write(&self) -> Result<String, DescriptionError> {
        self.check()?;
        toml::to_string(self).map_err(DescriptionError::Write)
    }

    /// Checks names and numbers.
    fn check(&self) -> Result<(), DescriptionError> {
        if self.format != FORMAT {
            return Err(DescriptionError::Format(self.format));
        }
        is_name(&self.name)?;
        // A heading is written in comments of the emitted files.
        if self.title.chars().any(char::is_control) {
            return Err(DescriptionError::Title);
        }
        if self.device.is_empty() {
            return Err(DescriptionError::NoDevice);
        }
        let Hub { mass, centre_of_mass, inertia } = &self.hub;
        numbers("hub", "mass", &[*mass])?;
        above_zero("hub", "mass", *mass)?;
        numbers("hub", "centre_of_mass", centre_of_mass)?;
        symmetric("hub", inertia)?;
        for (k, device) in self.device.iter().enumerate() {
            is_name(&device.name)?;
            if self.device[..k].iter().any(|other| other.name == device.name) {
                return Err(DescriptionError::Twice(device.name.clone()));
            }
            device.check()?;
        }
        Ok(())
    }
}

impl Device {
    fn check(&self) -> Result<(), DescriptionError> {
        let name = &self.name;
        numbers(name, "mount", self.mount.as_flattened())?;
        let dot = |a: usize, b: usize| self.mount.iter().map(|row| row[a] * row[b]).sum::<f64>();
        let off = (0..3).flat_map(|a| (a..3).map(move |b| (a, b)));
        let off = off.map(|(a, b)| (dot(a, b) - f64::from(u8::from(a == b))).abs());
        let [[a, b, c], [d, e, f], [g, h, i]] = self.mount;
        let determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
        if off.fold(0.0, f64::max) > ORTHONORMAL || determinant < 0.0 {
            return Err(DescriptionError::Mount(name.clone()));
        }
        for body in &self.body {
            numbers(name, "mass", &[body.mass])?;
            not_negative(name, "mass", body.mass)?;
            numbers(name, "origin", &body.origin)?;
            numbers(name, "centre_of_mass", &body.centre_of_mass)?;
            symmetric(name, &body.inertia)?;
            for axis in 0..3 {
                not_negative(name, "inertia", body.inertia[axis][axis])?;
            }
            numbers(name, "locked_at", &body.locked_at.map_or([0.0], |at| [at]))?;
        }
        Ok(())
    }
}

/// How far the columns of a mount may be from orthonormal, as for the general kernels.
const ORTHONORMAL: f64 = 4096.0 * f64::EPSILON;

fn is_name(name: &str) -> Result<(), DescriptionError> {
    let starts = name.chars().next().is_some_and(|c| c.is_ascii_lowercase());
    let letters = name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if starts && letters { Ok(()) } else { Err(DescriptionError::Name(name.to_owned())) }
}

fn numbers(of: &str, key: &'static str, values: &[f64]) -> Result<(), DescriptionError> {
    let bad = values.iter().find(|value| !value.is_finite());
    bad.map_or(Ok(()), |value| Err(DescriptionError::NotFinite(of.to_owned(), key, *value)))
}

fn above_zero(of: &str, key: &'static str, value: f64) -> Result<(), DescriptionError> {
    if value > 0.0 { Ok(()) } else { Err(DescriptionError::NotPositive(of.to_owned(), key, value)) }
}

fn not_negative(of: &str, key: &'static str, value: f64) -> Result<(), DescriptionError> {
    if value < 0.0 {
        return Err(DescriptionError::NotPositive(of.to_owned(), key, value));
    }
    Ok(())
}

fn symmetric(of: &str, inertia: &[[f64; 3]; 3]) -> Result<(), DescriptionError> {
    numbers(of, "inertia", inertia.as_flattened())?;
    let [[_, xy, xz], [yx, _, yz], [zx, zy, _]] = *inertia;
    let same = [(xy, yx), (xz, zx), (yz, zy)].into_iter().all(|(a, b)| a == b);
    if same { Ok(()) } else { Err(DescriptionError::NotSymmetric(of.to_owned())) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wheel() -> Description {
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let body = Body {
            mass: 0.1 + 0.2,
            origin: [1.0 / 3.0, 0.0, -0.0],
            centre_of_mass: [0.0; 3],
            inertia: unit,
            locked_at: None,
        };
        let (name, kind) = ("wheel".to_owned(), "reaction_wheel".to_owned());
        let turns =
            Some([None, Some(3)].map(|quarters| Turn { about: Axis::Y, quarters }).to_vec());
        let body = vec![body];
        let device = Device { name, kind, mount: unit, turns, body, keep: Vec::new() };
        let hub = Hub { mass: 10.0, centre_of_mass: [0.0; 3], inertia: unit };
        let name = "bus".to_owned();
        Description {
            format: FORMAT,
            name,
            title: "A \"bus\"".to_owned(),
            hub,
            device: vec![device],
        }
    }

    #[test]
    fn what_is_written_reads_back_to_the_last_bit() {
        let wheel = wheel();
        assert_eq!(Description::read(&wheel.write().unwrap()).unwrap(), wheel);
    }

    #[test]
    fn each_bad_value_is_named() {
        type Spoil = fn(&mut Description);
        let cases: [(Spoil, &str); 12] = [
            (|d| d.format = 2, "format 2"),
            (|d| d.name = "../x".to_owned(), "../x"),
            (|d| d.device.clear(), "no device"),
            (|d| d.hub.mass = 0.0, "hub: mass"),
            (|d| d.hub.centre_of_mass[1] = f64::NAN, "hub: centre_of_mass"),
            (|d| d.device.push(d.device[0].clone()), "wheel"),
            (|d| d.device[0].mount[0][0] = 0.9, "mount"),
            (|d| d.device[0].mount[2][2] = -1.0, "mount"),
            (|d| d.device[0].body[0].mass = -1.0, "mass"),
            (|d| d.title.push('\n'), "title"),
            (|d| d.device[0].body[0].inertia[0][1] = 1.0, "symmetric"),
            (|d| d.device[0].body[0].locked_at = Some(f64::INFINITY), "locked_at"),
        ];
        for (spoil, named) in cases {
            let mut description = wheel();
            spoil(&mut description);
            let error = description.write().unwrap_err().to_string();
            assert!(error.contains(named), "{error} does not say {named}");
        }
        let error = Description::read("format = 1\nname = 3").unwrap_err().to_string();
        assert!(error.contains("line 2"), "{error}");
        let turned = wheel().write().unwrap().replace("y 270", "y 45");
        let error = Description::read(&turned).unwrap_err().to_string();
        assert!(error.contains("`y 45`") && error.contains("line"), "{error}");
        let unknown = wheel().write().unwrap().replace("keep", "kept") + "colour = 1\n";
        assert!(Description::read(&unknown).is_err());
    }
}
