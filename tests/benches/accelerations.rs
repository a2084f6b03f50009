//! `accelerations` timed over the number of devices and over the kinds.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use precess_dynamics::Devices;
use precess_tests::measured::{EachSet, Measured, each_set};

struct Bench<'a>(&'a mut Criterion);

impl EachSet for Bench<'_> {
    fn visit<D: Devices<Scalar = f64>>(&mut self, name: &str, devices: &D) {
        let Measured { craft, state, inputs } = Measured::new(devices);
        self.0.bench_function(&format!("accelerations/{name}"), |bencher| {
            bencher.iter(|| craft.accelerations(black_box(&state), black_box(&inputs)));
        });
    }
}

fn sets(criterion: &mut Criterion) {
    each_set(&mut Bench(criterion));
}

criterion_group!(benches, sets);
criterion_main!(benches);
