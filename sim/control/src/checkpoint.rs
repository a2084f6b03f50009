//! [`Checkpoint`]: what a run keeps, as bytes: one visit of all of it, which writes its numbers or reads them.
//!
//! What is written and what is read are the same statements, so neither leaves out what the other has. A number is its 64 bits,
//! the low byte first: the same on every host, NaN included. Whoever reads has built what is read anew, so that only what varies is
//! in the bytes. Bytes that are too few or too many, or a count beyond its bound, are damaged: what is visited then keeps some of its
//! numbers and has others, and is to be discarded or read again.

use alloc::collections::VecDeque;
use alloc::vec::Vec;

use nalgebra::Vector3;
use precess_dynamics::Quaternion;

/// A visit of what a run keeps.
#[derive(Debug)]
pub struct Checkpoint<'b> {
    way: Way<'b>,
    is_refused: bool,
}

/// What a visit does.
#[derive(Debug)]
enum Way<'b> {
    Writes(Vec<u8>),
    /// What has not been read yet.
    Reads(&'b [u8]),
}

/// Bytes of a number.
const WORD: usize = 8;

impl Checkpoint<'static> {
    /// The bytes that a visit writes; none where something refuses it.
    #[must_use]
    pub fn written(visit: impl FnOnce(&mut Self)) -> Option<Vec<u8>> {
        let mut checkpoint = Self { way: Way::Writes(Vec::new()), is_refused: false };
        visit(&mut checkpoint);
        match checkpoint.way {
            Way::Writes(bytes) if !checkpoint.is_refused => Some(bytes),
            _ => None,
        }
    }
}

impl<'b> Checkpoint<'b> {
    /// Reads bytes in a visit; whether they are those of one, all of them.
    #[must_use]
    pub fn read(bytes: &'b [u8], visit: impl FnOnce(&mut Self)) -> bool {
        let mut checkpoint = Self { way: Way::Reads(bytes), is_refused: false };
        visit(&mut checkpoint);
        let is_read = matches!(checkpoint.way, Way::Reads([]));
        is_read && !checkpoint.is_refused
    }

    /// Refuses the visit: of something that keeps what it cannot write, or cannot be what is read.
    pub fn refuse(&mut self) {
        self.is_refused = true;
    }

    fn word(&mut self, value: u64) -> u64 {
        match &mut self.way {
            Way::Writes(bytes) => bytes.extend_from_slice(&value.to_le_bytes()),
            Way::Reads(rest) => match rest.split_first_chunk::<WORD>() {
                Some((word, others)) => {
                    *rest = others;
                    return u64::from_le_bytes(*word);
                }
                None => self.refuse(),
            },
        }
        value
    }

    /// A number.
    pub fn number(&mut self, number: &mut f64) {
        *number = f64::from_bits(self.word(number.to_bits()));
    }

    /// Numbers, as many as there are.
    pub fn numbers<'n>(&mut self, numbers: impl IntoIterator<Item = &'n mut f64>) {
        for number in numbers {
            self.number(number);
        }
    }

    /// An attitude.
    pub fn attitude(&mut self, Quaternion { q0, q1, q2, q3 }: &mut Quaternion) {
        self.numbers([q0, q1, q2, q3]);
    }

    /// A count without a bound.
    pub fn count(&mut self, count: &mut u64) {
        *count = self.word(*count);
    }

    /// A number from 0 that is below an end: a larger one is not taken.
    pub fn index(&mut self, index: &mut usize, end: usize) {
        match usize::try_from(self.word(*index as u64)) {
            Ok(read) if read < end => *index = read,
            _ => self.refuse(),
        }
    }

    /// Whether something is so.
    pub fn flag(&mut self, flag: &mut bool) {
        let mut index = usize::from(*flag);
        self.index(&mut index, 2);
        *flag = index == 1;
    }

    /// Something that may be there, read into a blank.
    pub fn optional<T>(
        &mut self,
        of: &mut Option<T>,
        blank: impl FnOnce() -> T,
        each: impl FnOnce(&mut Self, &mut T),
    ) {
        let mut is_there = of.is_some();
        self.flag(&mut is_there);
        if is_there {
            each(self, of.get_or_insert_with(blank));
        } else {
            *of = None;
        }
    }

    /// A vector that may be there.
    pub fn optional_vector(&mut self, of: &mut Option<Vector3<f64>>) {
        self.optional(of, Vector3::zeros, |checkpoint, vector| checkpoint.numbers(vector));
    }

    /// A queue, each of which has a number at least and is read into a blank.
    pub fn queue<T>(
        &mut self,
        queue: &mut VecDeque<T>,
        blank: impl FnMut() -> T,
        mut each: impl FnMut(&mut Self, &mut T),
    ) {
        let mut count = queue.len();
        let most = match &self.way {
            Way::Writes(_) => count,
            Way::Reads(rest) => rest.len() / WORD,
        };
        self.index(&mut count, most.saturating_add(1));
        queue.resize_with(count, blank);
        for of in queue {
            each(self, of);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Everything that a visit can have.
    #[derive(Clone, Debug, Default, PartialEq)]
    struct Kept {
        number: f64,
        count: u64,
        index: usize,
        flag: bool,
        vector: Option<Vector3<f64>>,
        queue: VecDeque<f64>,
    }

    impl Kept {
        fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
            checkpoint.number(&mut self.number);
            checkpoint.count(&mut self.count);
            checkpoint.index(&mut self.index, 5);
            checkpoint.flag(&mut self.flag);
            checkpoint.optional_vector(&mut self.vector);
            checkpoint.queue(&mut self.queue, || 0.0, Checkpoint::number);
        }
    }

    fn written(visit: impl FnOnce(&mut Checkpoint<'static>)) -> Vec<u8> {
        Checkpoint::written(visit).expect("nothing refuses it")
    }

    fn kept() -> Kept {
        let vector = Some(Vector3::new(1.0, -2.0, 3.0));
        Kept { number: 0.1, count: 7, index: 4, flag: true, vector, queue: [5.0, 6.0].into() }
    }

    #[test]
    fn what_is_written_is_read_again() {
        let mut of = kept();
        let bytes = written(|checkpoint| of.visit(checkpoint));
        let longer = Kept { queue: [9.0, 9.0, 9.0].into(), ..Kept::default() };
        for mut other in [Kept::default(), longer] {
            assert!(Checkpoint::read(&bytes, |checkpoint| other.visit(checkpoint)));
            assert_eq!(other, of);
        }
        let nothing = written(|checkpoint| Kept::default().visit(checkpoint));
        assert!(Checkpoint::read(&nothing, |checkpoint| of.visit(checkpoint)));
        assert_eq!(of, Kept::default());
    }

    #[test]
    fn a_number_that_is_none_keeps_its_bits() {
        let mut nan = f64::from_bits(0x7ff8_0000_0000_1234);
        let bytes = written(|checkpoint| checkpoint.number(&mut nan));
        let mut read = 0.0;
        assert!(Checkpoint::read(&bytes, |checkpoint| checkpoint.number(&mut read)));
        assert_eq!(read.to_bits(), nan.to_bits());
    }

    #[test]
    fn damaged_bytes_are_found() {
        let mut of = kept();
        let bytes = written(|checkpoint| of.visit(checkpoint));
        let mut read = |bytes: &[u8]| Checkpoint::read(bytes, |checkpoint| of.visit(checkpoint));
        for length in 0..bytes.len() {
            assert!(!read(&bytes[..length]), "{length}");
        }
        assert!(!read(&[&bytes[..], &[0]].concat()));
        assert_eq!(Checkpoint::written(Checkpoint::refuse), None);
        // Index, flag, whether there is a vector, and how many are queued: each beyond its bound.
        for place in [2, 3, 4, 8] {
            let mut changed = bytes.clone();
            changed[place * WORD + 1] = 1;
            assert!(!read(&changed), "{place}");
        }
        assert!(read(&bytes));
    }
}
