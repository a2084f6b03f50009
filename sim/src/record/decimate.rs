//! [`Decimate`]: a history in bounded memory for figures: first, least and greatest value of each
//! column in buckets of 2^k samples.
//!
//! When all buckets are full, neighbours are merged and each is of twice as many samples; so a run
//! of any length has between half the capacity and the capacity, and no spike is lost.

use super::{Header, Outcome, RecordError, Recorder};

/// Keeps least and greatest values.
#[derive(Clone, Debug)]
pub struct Decimate {
    /// Most buckets, even.
    capacity: usize,
    /// Samples of a full bucket.
    per_bucket: u64,
    /// Samples in the last bucket.
    in_last: u64,
    buckets: Vec<Bucket>,
}

/// A run of samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Bucket {
    /// Time of the first sample, s.
    pub start: f64,
    /// Time of the last sample, s.
    pub end: f64,
    /// The first sample.
    pub first: Vec<f64>,
    /// Least value of each column; NaN only where every value is.
    pub min: Vec<f64>,
    /// Greatest value of each column.
    pub max: Vec<f64>,
}

impl Decimate {
    /// At most so many buckets, two at least.
    #[must_use]
    pub fn new(capacity: usize) -> Self {
        let capacity = capacity.max(2).next_multiple_of(2);
        Self { capacity, per_bucket: 1, in_last: 0, buckets: Vec::new() }
    }

    /// The buckets in the order of time.
    #[must_use]
    pub fn buckets(&self) -> &[Bucket] {
        &self.buckets
    }

    /// Samples of a full bucket; the last one may have fewer.
    #[must_use]
    pub fn samples_per_bucket(&self) -> u64 {
        self.per_bucket
    }

    fn merge(&mut self) {
        let mut buckets = std::mem::take(&mut self.buckets).into_iter();
        while let Some(mut bucket) = buckets.next() {
            if let Some(next) = buckets.next() {
                bucket.include(next.end, &next.min, &next.max);
            }
            self.buckets.push(bucket);
        }
        self.per_bucket *= 2;
        // The capacity is even, so every bucket is full.
        self.in_last = self.per_bucket;
    }
}

impl Bucket {
    fn include(&mut self, end: f64, min: &[f64], max: &[f64]) {
        self.end = end;
        for (least, value) in self.min.iter_mut().zip(min) {
            *least = least.min(*value);
        }
        for (greatest, value) in self.max.iter_mut().zip(max) {
            *greatest = greatest.max(*value);
        }
    }
}

impl Recorder for Decimate {
    fn begin(&mut self, _: &Header) -> Result<(), RecordError> {
        *self = Self::new(self.capacity);
        Ok(())
    }

    fn sample(&mut self, row: &[f64]) -> Result<(), RecordError> {
        let time = row.first().copied().unwrap_or_default();
        if self.in_last == self.per_bucket && self.buckets.len() == self.capacity {
            self.merge();
        }
        if let Some(bucket) = self.buckets.last_mut().filter(|_| self.in_last < self.per_bucket) {
            bucket.include(time, row, row);
            self.in_last += 1;
        } else {
            let [first, min, max] = std::array::from_fn(|_| row.to_vec());
            self.buckets.push(Bucket { start: time, end: time, first, min, max });
            self.in_last = 1;
        }
        Ok(())
    }

    fn finish(&mut self, _: &Outcome) -> Result<(), RecordError> {
        Ok(())
    }
}
