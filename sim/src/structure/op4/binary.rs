//! The binary form of op4: Fortran records, each between two markers of its length in bytes.
//!
//! The first record of a matrix has columns, rows, form, type and name: 24 bytes, or 48 with integers of
//! 64 bits. Each column is a record of three integers (column, first row, count of words) and its numbers,
//! in runs where the first row is 0. A word has 4 bytes, or 8 with integers of 64 bits.

use super::super::{Fault, FileLocation, StructureError};
use super::{Header, Layout, Matrix, Run, unpacked};

/// Lengths of a header, bytes.
const HEADERS: [u32; 2] = [24, 48];

#[derive(Clone, Copy)]
struct Order {
    big: bool,
    /// Bytes of an integer and of a word.
    word: usize,
}

/// A part of the file.
#[derive(Clone, Copy)]
struct Bytes<'a> {
    rest: &'a [u8],
    /// Bytes before it.
    at: usize,
    order: Order,
}

/// Byte order and size of integers, where the first marker is that of a header.
fn order(bytes: &[u8]) -> Option<Order> {
    let first = *bytes.first_chunk::<4>()?;
    let [little, big] = [u32::from_le_bytes(first), u32::from_be_bytes(first)];
    let of = |length: u32| HEADERS.contains(&length).then_some(if length == 24 { 4 } else { 8 });
    let found = |big: bool, word: usize| Order { big, word };
    of(little).map(|word| found(false, word)).or_else(|| of(big).map(|word| found(true, word)))
}

pub(super) fn is_binary(bytes: &[u8]) -> bool {
    order(bytes).is_some()
}

pub(super) fn read(bytes: &[u8]) -> Result<Vec<Matrix>, StructureError> {
    let Some(order) = order(bytes) else { return Err(Fault::Format.into()) };
    let mut file = Bytes { rest: bytes, at: 0, order };
    let mut matrices = Vec::new();
    while !file.rest.is_empty() {
        matrices.push(matrix(&mut file)?);
    }
    Ok(matrices)
}

impl<'a> Bytes<'a> {
    fn fault(&self, fault: Fault) -> StructureError {
        fault.at(FileLocation::Byte(self.at))
    }

    fn take(&mut self, count: usize, wanted: &str) -> Result<&'a [u8], StructureError> {
        let Some((taken, rest)) = self.rest.split_at_checked(count) else {
            return Err(self.fault(Fault::Ended { wanted: wanted.to_owned() }));
        };
        (self.rest, self.at) = (rest, self.at + count);
        Ok(taken)
    }

    fn number<const N: usize>(&mut self, wanted: &str) -> Result<[u8; N], StructureError> {
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N, wanted)?);
        if self.order.big {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// An integer of the file's size.
    fn integer(&mut self, wanted: &str) -> Result<i64, StructureError> {
        if self.order.word == 8 {
            Ok(i64::from_le_bytes(self.number(wanted)?))
        } else {
            Ok(i32::from_le_bytes(self.number(wanted)?).into())
        }
    }

    /// Numbers of one word, or of eight bytes.
    fn numbers(&mut self, count: usize, single: bool) -> Result<Vec<f64>, StructureError> {
        let wanted = "the numbers of a column";
        let mut values = Vec::with_capacity(count.min(self.rest.len()));
        for _ in 0..count {
            let value = if single && self.order.word == 4 {
                f32::from_le_bytes(self.number(wanted)?).into()
            } else {
                f64::from_le_bytes(self.number(wanted)?)
            };
            if !value.is_finite() {
                return Err(self.fault(Fault::NotFinite { what: "a column".into(), value }));
            }
            values.push(value);
        }
        Ok(values)
    }

    /// The content of the next record.
    fn record(&mut self, wanted: &str) -> Result<Self, StructureError> {
        let before = i32::from_le_bytes(self.number(wanted)?);
        let length = usize::try_from(before).map_err(|_| {
            let range = [0, i32::MAX.into()];
            let what = "length, in bytes, of a record";
            self.fault(Fault::Integer { what, found: before.into(), range })
        })?;
        let at = self.at;
        let rest = self.take(length, wanted)?;
        let behind = i32::from_le_bytes(self.number("the marker behind a record")?);
        if before != behind {
            let (before, behind) = (before.into(), behind.into());
            return Err(self.fault(Fault::Record { before, behind }));
        }
        Ok(Self { rest, at, order: self.order })
    }
}

fn matrix(file: &mut Bytes<'_>) -> Result<Matrix, StructureError> {
    let wanted = "the header of a matrix";
    let mut record = file.record(wanted)?;
    let mut integers = [0; 4];
    for integer in &mut integers {
        *integer = record.integer(wanted)?;
    }
    let name = record.take(2 * file.order.word, wanted)?;
    let mut header = Header::new(integers, &String::from_utf8_lossy(name))
        .map_err(|fault| record.fault(fault))?;
    let mut layout = None;
    loop {
        let mut record = file.record("the record of a column")?;
        let wanted = "the header of a column";
        let number = record.integer(wanted)?;
        let row = record.integer(wanted)?;
        let words = record.integer(wanted)?;
        let Some(column) = header.column(number).map_err(|fault| record.fault(fault))? else {
            return Ok(header.matrix);
        };
        let layout = *layout.get_or_insert_with(|| header.layout(row));
        let runs = runs(&mut record, &header, layout, [row, words])?;
        header.matrix.runs.extend(runs.into_iter().map(|(row, values)| Run {
            column,
            row,
            values,
        }));
    }
}

/// The runs of a column: first row, from 0, and numbers.
fn runs(
    record: &mut Bytes<'_>,
    header: &Header,
    layout: Layout,
    [row, mut words]: [i64; 2],
) -> Result<Vec<(usize, Vec<f64>)>, StructureError> {
    // Words that a number takes: two for a double where integers have 32 bits.
    let per_number = if header.single || record.order.word == 8 { 1 } else { 2 };
    let mut runs = Vec::new();
    if layout == Layout::Dense {
        let numbers = words / per_number;
        let (row, count) = header.run(row, numbers).map_err(|fault| record.fault(fault))?;
        runs.push((row, record.numbers(count, header.single)?));
        return Ok(runs);
    }
    while words > 0 {
        let wanted = "the header of a run";
        let (length, row, own) = if layout == Layout::Wide {
            let length = record.integer(wanted)?;
            (length, record.integer(wanted)?, 1)
        } else {
            let (length, row) = unpacked(record.integer(wanted)?);
            (length, row, 0)
        };
        if length < 1 || length > words - own {
            let what = "length, in words, of a run";
            let fault = Fault::Integer { what, found: length, range: [1, words - own] };
            return Err(record.fault(fault));
        }
        words -= length + own;
        let numbers = (length - 1) / per_number;
        let (row, count) = header.run(row, numbers).map_err(|fault| record.fault(fault))?;
        runs.push((row, record.numbers(count, header.single)?));
    }
    Ok(runs)
}
