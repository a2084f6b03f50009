//! Structures as archives of `NumPy`'s (`numpy.savez`, `numpy.load`).
//!
//! | array | shape | unit | |
//! |---|---|---|---|
//! | `format` | | | the text `precess-structure-1` |
//! | `name` | | | a description; may be left out |
//! | `nodes` | n | | names |
//! | `positions` | n, 3 | m | from B, expressed in B |
//! | `frequencies` | m | rad/s | angular, without damping |
//! | `damping` | m | | ratios |
//! | `shapes` | n, 6, m | kg^-1/2, rad m^-1 kg^-1/2 | mass-normalised; x, y, z, rx, ry, rz |
//! | `momentum` | 6, m | kg^1/2, kg^1/2 m | integrals, linear above angular, about B |
//! | `mass` | | kg | these three, or none of them |
//! | `first_moment` | 3 | kg m | about B |
//! | `inertia` | 3, 3 | kg m² | about B |
//! | `mass_matrix` | 6 n, 6 n | kg, kg m, kg m² | of the nodes' coordinates; may be left out |
//! | `residual_flexibility` | 6 n, 6 n | m/N, rad/(N m) | may be left out |
//! | `has_devices` | | | true, false; may be left out |
//!
//! Members are stored, not compressed. Numbers are doubles, singles or integers of either byte order; rows
//! or columns first.

mod npy;

use std::io::{Cursor, Read as _};

use nalgebra::{DMatrix, Matrix3, Matrix6xX, Vector3};
use zip::ZipArchive;
use zip::write::SimpleFileOptions;

use super::modes::of_columns;
use super::{COORDINATES, Fault, FileLocation, Node, RigidMass, Structure, StructureError};
use npy::{Array, array};
pub(crate) use npy::{numbers, texts};

/// What the member `format` has.
pub const FORMAT: &str = "precess-structure-1";

/// The members of an archive.
pub(crate) struct Members {
    names: Vec<String>,
    arrays: Vec<Array>,
}

/// Reads a structure.
///
/// # Errors
/// The member, what is wrong with it, and what is needed.
pub fn read(bytes: &[u8]) -> Result<Structure, StructureError> {
    let members = Members::from_bytes(bytes)?;
    let format = members.needed("format")?.text().map_err(|f| f.at(member("format")))?;
    if format != FORMAT {
        let fault = Fault::Type { found: format, wanted: FORMAT };
        return Err(fault.at(member("format")));
    }
    let at = |name: &str| {
        let place = member(name);
        move |fault: Fault| fault.at(place)
    };
    let names = members.needed("nodes")?.texts().map_err(at("nodes"))?;
    let frequencies = members.needed("frequencies")?.numbers(None).map_err(at("frequencies"))?;
    let (n, m) = (names.len(), frequencies.len());
    let doubles = |name: &str, shape: &[usize]| {
        members.needed(name)?.numbers(Some(shape)).map_err(|fault| fault.at(member(name)))
    };
    let damping = doubles("damping", &[m])?;
    let positions = doubles("positions", &[n, 3])?;
    let shapes = doubles("shapes", &[n, COORDINATES, m])?;
    let momenta = Matrix6xX::from_row_slice(&doubles("momentum", &[COORDINATES, m])?);
    let square = |name: &str| -> Result<Option<DMatrix<f64>>, StructureError> {
        let size = COORDINATES * n;
        let Some(array) = members.get(name) else { return Ok(None) };
        let values = array.numbers(Some(&[size, size])).map_err(|fault| fault.at(member(name)))?;
        Ok(Some(DMatrix::from_row_slice(size, size, &values)))
    };
    let mass = if ["mass", "first_moment", "inertia"].iter().any(|name| members.get(name).is_some())
    {
        Some(RigidMass {
            mass: doubles("mass", &[])?.first().copied().unwrap_or(f64::NAN),
            first_moment: Vector3::from_column_slice(&doubles("first_moment", &[3])?),
            inertia: Matrix3::from_row_slice(&doubles("inertia", &[3, 3])?),
        })
    } else {
        None
    };
    let position = |row: &[f64]| Vector3::from_row_slice(row);
    let nodes = names.into_iter().zip(positions.chunks_exact(3));
    let has_devices = match members.get("has_devices") {
        None => None,
        Some(array) => {
            let values = array.numbers(Some(&[])).map_err(at("has_devices"))?;
            Some(values.first().is_some_and(|value| *value != 0.0))
        }
    };
    let name = match members.get("name") {
        None => String::new(),
        Some(array) => array.text().map_err(at("name"))?,
    };
    let structure = Structure {
        name,
        nodes: nodes.map(|(name, row)| Node { name, position: position(row) }).collect(),
        modes: of_columns(&frequencies, &damping, &momenta),
        shapes: DMatrix::from_row_slice(COORDINATES * n, m, &shapes),
        mass,
        mass_matrix: square("mass_matrix")?,
        residual: square("residual_flexibility")?,
        has_devices,
        initial: Vec::new(),
    };
    Ok(structure.checked()?)
}

/// The bytes of an archive: the same for the same structure.
///
/// # Errors
/// [`Fault::Io`].
pub fn write(structure: &Structure) -> Result<Vec<u8>, StructureError> {
    let (n, m) = (structure.nodes.len(), structure.modes.len());
    let names: Vec<&str> = structure.nodes.iter().map(|node| node.name.as_str()).collect();
    let positions: Vec<f64> =
        structure.nodes.iter().flat_map(|node| node.position.iter().copied()).collect();
    let of_modes = |of: fn(&super::Mode) -> f64| structure.modes.iter().map(of).collect::<Vec<_>>();
    let rows = |matrix: &DMatrix<f64>| matrix.transpose().as_slice().to_vec();
    let momenta = structure.momenta().transpose().as_slice().to_vec();
    let size = [COORDINATES * n, COORDINATES * n];
    let mut members = vec![
        ("format", texts(&[FORMAT], &[])),
        ("name", texts(&[&structure.name], &[])),
        ("nodes", texts(&names, &[n])),
        ("positions", numbers(&positions, &[n, 3])),
        ("frequencies", numbers(&of_modes(|mode| mode.frequency), &[m])),
        ("damping", numbers(&of_modes(|mode| mode.damping), &[m])),
        ("shapes", numbers(&rows(&structure.shapes), &[n, COORDINATES, m])),
        ("momentum", numbers(&momenta, &[COORDINATES, m])),
    ];
    if let Some(mass) = &structure.mass {
        let inertia = mass.inertia.transpose();
        members.push(("mass", numbers(&[mass.mass], &[])));
        members.push(("first_moment", numbers(mass.first_moment.as_slice(), &[3])));
        members.push(("inertia", numbers(inertia.as_slice(), &[3, 3])));
    }
    let matrices =
        [("mass_matrix", &structure.mass_matrix), ("residual_flexibility", &structure.residual)];
    for (name, matrix) in matrices {
        if let Some(matrix) = matrix {
            members.push((name, numbers(&rows(matrix), &size)));
        }
    }
    if let Some(has) = structure.has_devices {
        members.push(("has_devices", array("|b1", &[], &[u8::from(has)])));
    }
    archived(&members).map_err(|source| Fault::Io(source).into())
}

/// Arrays of one dimension of any archive, by their names; one that is not needed may be missing, and is then empty.
pub(crate) fn named_columns(
    bytes: &[u8],
    names: &[(&str, bool)],
) -> Result<Vec<Vec<f64>>, StructureError> {
    let members = Members::from_bytes(bytes)?;
    let column = |(name, needed): &(&str, bool)| {
        if !needed && members.get(name).is_none() {
            return Ok(Vec::new());
        }
        let numbers = members.needed(name)?.numbers(None);
        numbers.map_err(|fault| fault.at(member(name)))
    };
    names.iter().map(column).collect()
}

/// All arrays of one dimension of numbers, with their names; others are left out.
pub(crate) fn all_columns(bytes: &[u8]) -> Result<Vec<(String, Vec<f64>)>, StructureError> {
    let Members { names, arrays } = Members::from_bytes(bytes)?;
    let column = |(name, array): (String, Array)| Some((name, array.numbers(None).ok()?));
    Ok(names.into_iter().zip(arrays).filter_map(column).collect())
}

/// The bytes of an archive of arrays by their names.
pub(crate) fn archived(members: &[(&str, Vec<u8>)]) -> std::io::Result<Vec<u8>> {
    use std::io::Write as _;
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let options = SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    for (name, bytes) in members {
        archive.start_file(format!("{name}.npy"), options)?;
        archive.write_all(bytes)?;
    }
    Ok(archive.finish()?.into_inner())
}

fn member(name: &str) -> FileLocation {
    FileLocation::Member(name.to_owned())
}

impl Members {
    /// All arrays of an archive.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Self, StructureError> {
        let failure = |error: zip::result::ZipError| {
            StructureError::from(Fault::Io(std::io::Error::other(error.to_string())))
        };
        let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(failure)?;
        let mut members = Self { names: Vec::new(), arrays: Vec::new() };
        for index in 0..archive.len() {
            let file = archive.by_index_raw(index).map_err(failure)?;
            let name = file.name().map_err(failure)?.into_owned();
            let Some(name) = name.strip_suffix(".npy").map(str::to_owned) else { continue };
            if file.compression() != zip::CompressionMethod::Stored {
                let found = format!("compressed: {}", file.compression());
                let wanted = "the archive by `numpy.savez`, which stores its members";
                return Err(Fault::Type { found, wanted }.at(member(&name)));
            }
            drop(file);
            let file = archive.by_index(index).map_err(failure)?;
            let mut content = Vec::new();
            // Stored: no longer than the archive, whatever its header says.
            file.take(bytes.len() as u64)
                .read_to_end(&mut content)
                .map_err(|source| Fault::Io(source).at(member(&name)))?;
            members.arrays.push(Array::parse(&content).map_err(|fault| fault.at(member(&name)))?);
            members.names.push(name);
        }
        Ok(members)
    }

    fn get(&self, name: &str) -> Option<&Array> {
        let index = self.names.iter().position(|found| found == name)?;
        self.arrays.get(index)
    }

    /// The array of a name.
    pub(crate) fn needed(&self, name: &str) -> Result<&Array, StructureError> {
        self.get(name).ok_or_else(|| {
            let present = self.names.clone();
            Fault::Missing { what: name.to_owned(), present }.into()
        })
    }
}
