//! `Spacecraft::new`, timed over the number of devices and over the kinds.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use precess_dynamics::{Devices, Spacecraft};
use precess_tests::measured::{EachSet, each_set, hub};

struct Bench<'a>(&'a mut Criterion);

impl EachSet for Bench<'_> {
    fn visit<D: Devices<Scalar = f64>>(&mut self, name: &str, devices: &D) {
        let hub = hub();
        self.0.bench_function(&format!("new/{name}"), |bencher| {
            bencher.iter(|| Spacecraft::new(black_box(&hub), black_box(devices)));
        });
    }
}

fn sets(criterion: &mut Criterion) {
    each_set(&mut Bench(criterion));
}

criterion_group!(benches, sets);
criterion_main!(benches);
