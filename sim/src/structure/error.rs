//! [`StructureError`]: a file of a structure that cannot be read, or a computation that has no result:
//! where, what, the bound and the remedy.

use std::fmt;
use std::path::PathBuf;

/// An error with its place.
#[derive(Debug)]
pub struct StructureError {
    /// The file; empty of bytes that a program passed.
    pub file: PathBuf,
    /// Where in the file.
    pub place: FileLocation,
    /// What is wrong.
    pub fault: Fault,
}

/// A place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileLocation {
    /// The file as a whole.
    File,
    /// A line, from 1.
    Line(usize),
    /// A byte, from 0.
    Byte(usize),
    /// An array of an archive, or a matrix.
    Member(String),
}

/// What is wrong.
#[derive(Debug)]
pub enum Fault {
    /// The operating system's reason.
    Io(std::io::Error),
    /// More bytes than are read.
    Large {
        /// The bound, bytes.
        bound: usize,
    },
    /// The first bytes are of no known format.
    Format,
    /// An op4 file by itself, whose rows have no nodes.
    Bare,
    /// The file ends too early.
    Ended {
        /// What should come.
        wanted: String,
    },
    /// A text that is no number.
    NotNumber {
        /// What it should be.
        wanted: String,
        /// The text.
        found: String,
    },
    /// A count or index out of range.
    Number {
        /// Of what.
        what: String,
        /// The number.
        found: usize,
        /// Lowest and highest.
        range: [usize; 2],
    },
    /// An integer out of range.
    Integer {
        /// Of what.
        what: &'static str,
        /// The integer.
        found: i64,
        /// Lowest and highest.
        range: [i64; 2],
    },
    /// A number out of range.
    Range {
        /// Of what.
        what: String,
        /// The number.
        value: f64,
        /// Lowest and highest.
        range: [f64; 2],
    },
    /// A number that is not finite.
    NotFinite {
        /// Of what.
        what: String,
        /// The number.
        value: f64,
    },
    /// A matrix of another shape.
    Shape {
        /// Which.
        what: String,
        /// Its shape.
        found: Vec<usize>,
        /// The shape that it should have.
        wanted: Vec<usize>,
    },
    /// A matrix that is not symmetric.
    Skew {
        /// Which.
        what: &'static str,
        /// The largest difference from its transpose.
        skew: f64,
        /// The largest that is taken as rounding.
        bound: f64,
    },
    /// Two markers of one record that differ.
    Record {
        /// Bytes by the marker before it.
        before: i64,
        /// Bytes by the marker behind it.
        behind: i64,
    },
    /// A member or matrix that is not there.
    Missing {
        /// Which.
        what: String,
        /// What is there.
        present: Vec<String>,
    },
    /// A type of numbers, a format or a compression that is not read.
    Type {
        /// As the file has it.
        found: String,
        /// What is read.
        wanted: &'static str,
    },
    /// A complex matrix where a real one is needed.
    Complex,
    /// No positions of the nodes.
    NoPositions {
        /// How many nodes have shapes.
        nodes: usize,
    },
    /// A name of a node that is none.
    Name {
        /// The name, its hidden letters written out.
        name: String,
        /// Why it is none.
        reason: String,
    },
    /// No node of this name.
    UnknownNode {
        /// The name.
        name: String,
        /// The names that there are.
        nodes: Vec<String>,
    },
    /// Two nodes of one name.
    NameTwice {
        /// The name.
        name: String,
    },
    /// A mass matrix that is not positive definite.
    Indefinite {
        /// Which.
        what: &'static str,
        /// Its order.
        size: usize,
    },
    /// Damping that couples modes.
    CoupledDamping {
        /// Modes, from 1.
        modes: [usize; 2],
        /// The element over the geometric mean of the two diagonal ones.
        ratio: f64,
        /// The largest that is left out.
        bound: f64,
    },
    /// Modes that should be rigid and are not, or the other way round.
    RigidModes {
        /// How many were stated.
        stated: usize,
        /// Angular frequency of the last of them, rad/s.
        last: f64,
        /// Angular frequency of the first one above, rad/s.
        next: f64,
    },
    /// Rigid-body modes that are no motion of a rigid body with the positions of the nodes.
    NotRigid {
        /// The largest difference, of the largest element.
        missed: f64,
        /// The largest that is taken as rounding.
        bound: f64,
    },
    /// Nodes that do not determine the motion of a rigid body.
    Undetermined {
        /// Coordinates that they have.
        rows: usize,
    },
    /// Devices that cannot be linearised.
    Device(precess_dynamics::DerivativeError),
    /// No mass of a free structure.
    NoMass,
    /// A frequency at which the response is unbounded.
    Unbounded {
        /// The angular frequency, rad/s.
        frequency: f64,
    },
}

impl Fault {
    /// The error at a place; the file is added by who opened it.
    #[must_use]
    pub fn at(self, place: FileLocation) -> StructureError {
        StructureError { file: PathBuf::new(), place, fault: self }
    }
}

impl From<Fault> for StructureError {
    fn from(fault: Fault) -> Self {
        fault.at(FileLocation::File)
    }
}

impl StructureError {
    /// The same error in a file.
    #[must_use]
    pub fn in_file(mut self, file: &std::path::Path) -> Self {
        file.clone_into(&mut self.file);
        self
    }
}

impl fmt::Display for FileLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => Ok(()),
            Self::Line(line) => write!(f, "line {line}: "),
            Self::Byte(byte) => write!(f, "byte {byte}: "),
            Self::Member(name) => write!(f, "`{name}`: "),
        }
    }
}

impl fmt::Display for StructureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.file.as_os_str().is_empty() {
            write!(f, "{}: ", self.file.display())?;
        }
        write!(f, "{}{}", self.place, self.fault)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(source) => source.fmt(f),
            Self::Large { bound } => {
                write!(f, "more than {bound} bytes; write only the nodes and modes that are needed")
            }
            Self::Format => f.write_str(
                "no structure: not NPZ, no Flex text of 42, no table in TOML; see docs/structure.md",
            ),
            Self::Bare => f.write_str(
                "an op4 file has matrices and no nodes; write a table that maps rows to nodes \
                 (docs/structure.md) and name that",
            ),
            Self::Ended { wanted } => {
                write!(f, "the file ends where {wanted} should follow; is it cut off?")
            }
            Self::NotNumber { wanted, found } => {
                write!(f, "`{found}` where {wanted} should be; correct the line")
            }
            Self::Number { what, found, range: [low, high] } => {
                write!(f, "{found} {what}; {low} to {high} are possible")
            }
            Self::Integer { what, found, range: [low, high] } => {
                write!(f, "{what} {found}; it is from {low} to {high}")
            }
            Self::Range { what, value, range: [low, high] } => {
                write!(f, "{what} is {value:e}; it is from {low:e} to {high:e}")
            }
            Self::NotFinite { what, value } => write!(f, "{what} has {value}; finite is needed"),
            Self::Shape { what, found, wanted } => {
                write!(f, "{what} has the shape {found:?}; {wanted:?} is needed")
            }
            Self::Skew { what, skew, bound } => write!(
                f,
                "{what} differs from its transpose by {skew:e}, more than {bound:e}; make it symmetric"
            ),
            Self::Record { before, behind } => write!(
                f,
                "a record has {before} bytes by the marker before it and {behind} by the one behind; \
                 copy the file again as binary"
            ),
            Self::Missing { what, present } => {
                write!(f, "`{what}` is missing; there are {}", listed(present))
            }
            Self::Type { found, wanted } => {
                write!(f, "`{found}` is not read; write {wanted}")
            }
            Self::Complex => f.write_str("a complex matrix; shapes, masses and stiffnesses are real"),
            Self::NoPositions { nodes } => write!(
                f,
                "shapes at {nodes} nodes without positions; write a table that names them \
                 (docs/structure.md), with the positions of the nodes"
            ),
            Self::UnknownNode { name, nodes } => {
                write!(f, "no node is named `{name}`; there are {}", listed(nodes))
            }
            Self::Name { name, reason } => write!(f, "a node is named `{name}`: {reason}"),
            Self::NameTwice { name } => {
                write!(f, "two nodes are named `{name}`; give one of them another name")
            }
            Self::Indefinite { what, size } => write!(
                f,
                "{what} of order {size} is not positive definite; leave coordinates without mass out"
            ),
            Self::CoupledDamping { modes: [a, b], ratio, bound } => write!(
                f,
                "the damping matrix couples modes {a} and {b} by {ratio:e} of their own, more than \
                 {bound:e}; give a damping ratio for each mode"
            ),
            Self::RigidModes { stated, last, next } => write!(
                f,
                "{stated} rigid-body modes are stated, but mode {stated} is at {last:e} rad/s and the \
                 next at {next:e} rad/s; correct `rigid_modes`"
            ),
            Self::NotRigid { missed, bound } => write!(
                f,
                "the rigid-body modes miss the motion of a rigid body with these nodes by {missed:e}, \
                 more than {bound:e}; check positions, units and rows of the nodes, and `rigid_modes`"
            ),
            Self::Undetermined { rows } => write!(
                f,
                "{rows} coordinates of the nodes do not determine the motion of a rigid body; add a node \
                 with six rows"
            ),
            Self::Device(error) => error.fmt(f),
            Self::NoMass => f.write_str(
                "the structure has no mass, so its free motion is unknown; give mass, centre of mass \
                 and inertia, or hold the base (`--base fixed`)",
            ),
            Self::Unbounded { frequency } => write!(
                f,
                "no finite response at {frequency} rad/s; give the modes a damping ratio, or choose \
                 another frequency"
            ),
        }
    }
}

fn listed(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

impl std::error::Error for StructureError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.fault {
            Fault::Io(source) => Some(source),
            _ => None,
        }
    }
}
