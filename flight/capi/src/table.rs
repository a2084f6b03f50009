//! Parameters as a binary table: versioned, checksummed, the same bytes on every target.
//!
//! Little-endian; numbers are IEEE-754 doubles, integers 32 bits, nothing is padded.
//!
//! ```text
//! offset          bytes  what
//! 0               4      "PREC"
//! 4               4      version of the layout, 1 or 2
//! 8               4      length of the table, checksum included
//! 12              4      number of devices n, up to 8
//! 16              104    hub: mass, centre of mass (3), inertia (9)
//! 120 + s k       s      device k: kind, model (4 each); mount (9);
//!                        J bodies: mass, origin (3), centre of mass (3), inertia (9);
//!                        J joints: stiffness, rest, viscous, coulomb, coulomb_rate;
//!                        in version 2: on, 0 (4 each); suspension: stiffness (36), rest (6), damping (36),
//!                        6 struts: position (3), direction (3), length, stiffness, damping
//! 120 + s n       4      CRC-32 of all before (ISO-HDLC: that of zip and Ethernet)
//! ```
//!
//! J is 3 and s is 584 in version 1, J is 7 and s is 2320 in version 2. Each version of the interface writes
//! its own; version 2 reads both.
//! Units, axes and order of entries are those of the structures.

use core::ffi::c_void;

use crc::{CRC_32_ISO_HDLC, Crc, NoTable};

use crate::craft::{StoredSpacecraft, code_number, made, make_in, reporting};
use crate::error::{Code, Fault, Rejection};
use crate::memory::{OutputPointer, read, slice, slice_mut};
use crate::types::{Device, Entry, Hub, Passive, Strut};
use crate::version::{EntryOf, Interface, SetOf, Versions};
use crate::{MAX_DEVICES, VERSIONS};

/// `PRECESS_TABLE_VERSION` where a device has up to so many joints.
#[must_use]
pub const fn version(joints: usize) -> u32 {
    if joints == VERSIONS[0] { 1 } else { 2 }
}

/// `PRECESS_TABLE_SIZE(0)`: without devices.
pub const BARE: usize = 124;
/// What each device adds: kind, model, mount, 21 numbers per joint; in version 2 also `on`, a word that is
/// not read, and a suspension.
const fn per_device(joints: usize) -> usize {
    let standing = if joints == VERSIONS[0] { 0 } else { 8 + 8 * (36 + 6 + 36 + 6 * 9) };
    80 + 168 * joints + standing
}

const MAGIC: u32 = u32::from_le_bytes(*b"PREC");

/// Length of a table of so many devices with up to so many joints.
#[must_use]
pub const fn size(devices: usize, joints: usize) -> usize {
    BARE + per_device(joints) * devices
}

/// The checksum, bit by bit: no table of its own in memory.
fn checksum(bytes: &[u8]) -> u32 {
    Crc::<u32, NoTable>::new(&CRC_32_ISO_HDLC).checksum(bytes)
}

/// What is passed over each entry of a table in its order; only it differs between reading and
/// writing.
pub(crate) trait Pass {
    fn integer(&mut self, value: &mut i32) -> Option<()>;
    fn number(&mut self, value: &mut f64) -> Option<()>;

    fn numbers<'a>(&mut self, values: impl IntoIterator<Item = &'a mut f64>) -> Option<()> {
        values.into_iter().try_for_each(|value| self.number(value))
    }

    fn hub(&mut self, hub: &mut Hub) -> Option<()> {
        self.number(&mut hub.mass)?;
        self.numbers(hub.centre.iter_mut().chain(&mut hub.inertia))
    }

    /// A device of which the table holds so many joints.
    fn device<const J: usize>(&mut self, device: &mut Device<J>, joints: usize) -> Option<()> {
        self.integer(&mut device.kind)?;
        self.integer(&mut device.model)?;
        self.numbers(&mut device.mount)?;
        for body in device.bodies.iter_mut().take(joints) {
            self.number(&mut body.mass)?;
            self.numbers(body.origin.iter_mut().chain(&mut body.centre).chain(&mut body.inertia))?;
        }
        for joint in device.passive.iter_mut().take(joints) {
            let Passive { stiffness, rest, viscous, coulomb, coulomb_rate } = joint;
            self.numbers([stiffness, rest, viscous, coulomb, coulomb_rate])?;
        }
        Some(())
    }

    /// What an entry stands on, and its suspension.
    fn standing(&mut self, entry: &mut Entry) -> Option<()> {
        self.integer(&mut entry.on)?;
        self.integer(&mut entry.reserved)?;
        let of = &mut entry.suspension;
        self.numbers(of.stiffness.iter_mut().chain(&mut of.rest).chain(&mut of.damping))?;
        of.strut.iter_mut().try_for_each(|strut| {
            let Strut { position, direction, length, stiffness, damping } = strut;
            let numbers = [length, stiffness, damping];
            self.numbers(position.iter_mut().chain(direction).chain(numbers))
        })
    }
}

/// What is left to be read.
struct TableReader<'a>(&'a [u8]);

impl TableReader<'_> {
    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*first)
    }
}

impl Pass for TableReader<'_> {
    fn integer(&mut self, value: &mut i32) -> Option<()> {
        *value = i32::from_le_bytes(self.bytes()?);
        Some(())
    }

    fn number(&mut self, value: &mut f64) -> Option<()> {
        *value = f64::from_le_bytes(self.bytes()?);
        Some(())
    }
}

/// Where there is room to write.
struct Writing<'a>(&'a mut [u8]);

impl Writing<'_> {
    fn bytes<const N: usize>(&mut self, value: [u8; N]) -> Option<()> {
        let (first, rest) = core::mem::take(&mut self.0).split_first_chunk_mut()?;
        *first = value;
        self.0 = rest;
        Some(())
    }
}

impl Pass for Writing<'_> {
    fn integer(&mut self, value: &mut i32) -> Option<()> {
        self.bytes(value.to_le_bytes())
    }

    fn number(&mut self, value: &mut f64) -> Option<()> {
        self.bytes(value.to_le_bytes())
    }
}

/// Hub and devices of a table, and how many devices there are.
fn read_table<const J: usize>(table: &[u8]) -> Result<(Hub, [EntryOf<J>; MAX_DEVICES], usize), Code>
where
    Versions: Interface<J>,
{
    let mut reading = TableReader(table);
    let mut word = || reading.bytes().map(u32::from_le_bytes).ok_or(Code::TableLength);
    if word()? != MAGIC {
        return Err(Code::TableMagic);
    }
    let layout = word()?;
    let known = VERSIONS.into_iter().find(|joints| *joints <= J && version(*joints) == layout);
    let joints = known.ok_or(Code::TableVersion)?;
    let (length, count) = (word()? as usize, word()? as usize);
    if count > MAX_DEVICES {
        return Err(Code::TooMany);
    }
    let (body, sum) = table.split_last_chunk().ok_or(Code::TableLength)?;
    if length != table.len() || length != size(count, joints) {
        return Err(Code::TableLength);
    }
    if checksum(body) != u32::from_le_bytes(*sum) {
        return Err(Code::TableChecksum);
    }
    let mut hub = Hub { mass: 0.0, centre: [0.0; 3], inertia: [0.0; 9] };
    let mut devices = [Versions::EMPTY; MAX_DEVICES];
    let passed = reading.hub(&mut hub).and_then(|()| {
        devices
            .iter_mut()
            .take(count)
            .try_for_each(|device| Versions::pass(&mut reading, device, joints))
    });
    passed.map(|()| (hub, devices, count)).ok_or(Code::TableLength)
}

fn write_table<const J: usize>(hub: &Hub, devices: &[EntryOf<J>], table: &mut [u8]) -> Option<()>
where
    Versions: Interface<J>,
{
    let length = u32::try_from(table.len()).ok()?;
    let count = u32::try_from(devices.len()).ok()?;
    let (body, sum) = table.split_last_chunk_mut()?;
    let mut writing = Writing(body);
    for word in [MAGIC, version(J), length, count] {
        writing.bytes(word.to_le_bytes())?;
    }
    writing.hub(&mut { *hub })?;
    devices.iter().try_for_each(|device| Versions::pass(&mut writing, &mut { *device }, J))?;
    *sum = checksum(body).to_le_bytes();
    Some(())
}

/// See `precess.h`.
///
/// # Safety
///
/// `memory` points to `size` writable bytes, `table` to `length` readable ones, `fault` is null or
/// points to a fault.
pub(crate) unsafe fn init_from_table<const J: usize>(
    memory: *mut c_void,
    size: usize,
    table: *const u8,
    length: usize,
    fault: *mut Fault,
) -> i32
where
    Versions: Interface<J>,
{
    let make = || {
        if table.is_null() {
            return Err(Rejection::from(Code::Null));
        }
        // SAFETY: by contract.
        let (hub, devices, count) = read_table::<J>(unsafe { slice(table, length) }?)?;
        made::<J>(&hub, devices.get(..count).unwrap_or(&devices))
    };
    // SAFETY: by contract.
    let call =
        || (None::<&StoredSpacecraft<SetOf<J>>>, unsafe { make_in::<J>(memory, size, make) });
    // SAFETY: by contract.
    unsafe { reporting(fault, call) }
}

/// See `precess.h`.
///
/// # Safety
///
/// `hub` points to a hub, `devices` to `count` devices, `table` to `capacity` writable bytes,
/// `length` to a number.
pub(crate) unsafe fn table_write<const J: usize>(
    hub: *const Hub,
    devices: *const EntryOf<J>,
    count: u32,
    table: *mut u8,
    capacity: usize,
    length: *mut usize,
) -> i32
where
    Versions: Interface<J>,
{
    let done = || {
        let count = count as usize;
        if count > MAX_DEVICES {
            return Err(Code::TooMany);
        }
        // SAFETY: by contract.
        let (hub, devices) = unsafe { (read(hub)?, slice(devices, count)?) };
        // SAFETY: by contract.
        let length = unsafe { OutputPointer::new(length) }?;
        if table.is_null() {
            return Err(Code::Null);
        }
        // SAFETY: by contract.
        let table = unsafe { slice_mut(table, capacity) }?;
        let table = table.get_mut(..size(count, J)).ok_or(Code::TooSmall)?;
        write_table::<J>(&hub, devices, table).ok_or(Code::TooSmall)?;
        length.write(size(count, J));
        Ok(())
    };
    code_number(done())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::types::Body;

    const NO_BODY: Body = Device::<3>::EMPTY.bodies[0];

    /// The check value of the catalogue, so that others can write tables.
    #[test]
    fn checksum_is_that_of_zip() {
        assert_eq!(checksum(b"123456789"), 0xcbf4_3926);
    }

    fn read_back<const J: usize>(change: impl Fn(&mut EntryOf<J>))
    where
        Versions: Interface<J>,
        EntryOf<J>: PartialEq + core::fmt::Debug,
    {
        let hub = Hub { mass: 10.0, centre: [1.0, 2.0, 3.0], inertia: [4.0; 9] };
        let mut device = Versions::EMPTY;
        change(&mut device);
        let mut table = vec![0; size(2, J)];
        write_table::<J>(&hub, &[device, Versions::EMPTY], &mut table).unwrap();
        let (found, devices, count) = read_table::<J>(&table).unwrap();
        assert_eq!((found, devices[0], devices[1], count), (hub, device, Versions::EMPTY, 2));
        for byte in 0..table.len() {
            let mut changed = table.clone();
            changed[byte] ^= 0x10;
            assert!(read_table::<J>(&changed).is_err(), "byte {byte}");
        }
        for short in 0..table.len() {
            assert!(read_table::<J>(&table[..short]).is_err(), "{short} bytes");
        }
    }

    #[test]
    fn what_is_written_is_read_and_every_changed_byte_is_seen() {
        read_back::<3>(|device| {
            (device.kind, device.model, device.mount) = (9, 1, [7.0; 9]);
            device.passive[2].coulomb_rate = 5.0;
        });
        read_back::<7>(|entry| {
            (entry.device.kind, entry.on) = (9, 2);
            entry.device.passive[5].coulomb_rate = 5.0;
            (entry.suspension.damping[35], entry.suspension.strut[5].damping) = (6.0, 7.0);
        });
    }

    #[test]
    fn version_2_reads_both_and_version_1_its_own() {
        let hub = Hub { mass: 10.0, centre: [1.0, 2.0, 3.0], inertia: [4.0; 9] };
        let mut device = Device::<3>::EMPTY;
        device.bodies[2].mass = 8.0;
        let mut first = [0; size(1, 3)];
        write_table::<3>(&hub, &[device], &mut first).unwrap();
        let (found, devices, count) = read_table::<7>(&first).unwrap();
        assert_eq!((found, devices[0].device.bodies[2].mass, count), (hub, 8.0, 1));
        assert_eq!(devices[0].device.bodies[3..], [NO_BODY; 4]);
        let mut second = [0; size(1, 7)];
        write_table::<7>(&hub, &[Entry::EMPTY], &mut second).unwrap();
        assert_eq!(read_table::<3>(&second).unwrap_err(), Code::TableVersion);
    }
}
