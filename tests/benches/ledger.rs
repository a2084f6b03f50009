//! `ledger`, `energy` and `momentum` timed over the number of devices and over the kinds.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use precess_dynamics::{About, Devices};
use precess_tests::measured::{EachSet, Measured, each_set};

struct Bench<'a>(&'a mut Criterion);

impl EachSet for Bench<'_> {
    fn visit<D: Devices<Scalar = f64>>(&mut self, name: &str, devices: &D) {
        let measured = Measured::new(devices);
        let found = measured.accelerations().expect("the state is regular");
        let Measured { craft, state, inputs } = measured;
        self.0.bench_function(&format!("ledger/{name}"), |bencher| {
            bencher.iter(|| craft.ledger(black_box(&state), black_box(&inputs), &found));
        });
        self.0.bench_function(&format!("energy/{name}"), |bencher| {
            bencher.iter(|| craft.energy(black_box(&state)));
        });
        self.0.bench_function(&format!("momentum/{name}"), |bencher| {
            bencher.iter(|| craft.momentum(black_box(&state), About::CentreOfMass));
        });
    }
}

fn sets(criterion: &mut Criterion) {
    each_set(&mut Bench(criterion));
}

criterion_group!(benches, sets);
criterion_main!(benches);
