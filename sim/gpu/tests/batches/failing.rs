//! Without a device, and with one that fails on the way, the processor computes the same, and the result says why.

use precess_dynamics::BuiltInKind;
use precess_gpu::{
    Array, Batch, BatchInputs, Device, GpuError, Kernels, SampleSettings, Segment, Sources, Steps,
    open,
};

use crate::host::{HostDevice, sources};
use crate::random::Random;
use crate::spacecraft::{SETTINGS, craft, inputs, random, row};

/// A device that fails from its second part of a batch on.
struct Failing(HostDevice);

struct FailingKernels(Box<dyn Kernels>, usize);

fn broken() -> GpuError {
    GpuError::Driver { at: "a kernel", code: "CUDA_ERROR_ILLEGAL_ADDRESS".to_owned() }
}

impl Device for Failing {
    fn name(&self) -> String {
        self.0.name()
    }

    fn compile(&self, sources: &Sources) -> Result<Box<dyn Kernels>, GpuError> {
        Ok(Box::new(FailingKernels(self.0.compile(sources)?, 0)))
    }
}

impl Kernels for FailingKernels {
    fn free_bytes(&self) -> Result<usize, GpuError> {
        self.0.free_bytes()
    }

    fn prepare(&mut self, parameters: &[f64], inputs: &[f64]) -> Result<i32, GpuError> {
        self.0.prepare(parameters, inputs)
    }

    fn begin(&mut self, count: i32) -> Result<(), GpuError> {
        self.0.begin(count)
    }

    fn write(&mut self, array: Array, numbers: &[f64]) -> Result<(), GpuError> {
        self.0.write(array, numbers)
    }

    fn zeros(&mut self, array: Array, length: usize) -> Result<(), GpuError> {
        self.0.zeros(array, length)
    }

    fn accelerations(&mut self) -> Result<(), GpuError> {
        self.0.accelerations()
    }

    fn run(&mut self, segment: Segment) -> Result<(), GpuError> {
        self.1 += 1;
        if self.1 > 1 { Err(broken()) } else { self.0.run(segment) }
    }

    fn read(&self, array: Array, out: &mut [f64]) -> Result<(), GpuError> {
        self.0.read(array, out)
    }

    fn statuses(&self, out: &mut [i32]) -> Result<(), GpuError> {
        self.0.statuses(out)
    }
}

/// Final states of five, and what became of them.
fn run(device: Result<&dyn Device, GpuError>) -> (Vec<f64>, precess_gpu::BatchResult) {
    let mut generator = Random::new(7);
    let case = random(&[BuiltInKind::Sgcmg], SETTINGS, &mut generator);
    let mut batch = Batch::new(vec![craft(&case)], false, device, sources).expect("a batch");
    let base = inputs(&case);
    let mut y: Vec<f64> = row(&case).repeat(5);
    let size = batch.state_size();
    y.chunks_mut(size).zip(0_u8..).for_each(|(row, k)| row[10] += 0.01 * f64::from(k));
    let steps = Steps { length: 1e-4, count: 20, normalises: true };
    let settings = SampleSettings { every: 20, history: false, reductions: Vec::new() };
    let acting = BatchInputs { base: &base, rows: &[] };
    let (_, result) = batch.run(&mut y, acting, steps, &settings, &|_| true).expect("lengths");
    (y, result)
}

#[test]
fn a_device_that_fails_on_the_way_leaves_the_rest_to_the_processor() {
    let (expected, without) = run(Err(GpuError::NoDriver));
    assert_eq!((without.fallback, without.recomputed), (Some(GpuError::NoDriver), 5));
    // Memory for two states, and as much again that is left free.
    let (found, result) = run(Ok(&Failing(HostDevice { bytes: 2 * 2 * 300, threads: 1 })));
    assert_eq!(result.fallback, Some(broken()));
    assert!((1..5).contains(&result.recomputed), "{}", result.recomputed);
    assert_eq!(found, expected);
}

#[test]
fn a_state_that_does_not_fit_is_said_with_its_size() {
    let (_, result) = run(Ok(&HostDevice { bytes: 100, threads: 1 }));
    let Some(GpuError::Memory { state, free: 100 }) = result.fallback else {
        panic!("{:?}", result.fallback)
    };
    assert!(state > 8 * 30 && result.states.iter().all(Result::is_ok), "{state}");
}

#[test]
fn kernels_that_cannot_be_derived_are_the_reason() {
    let case = random(&[BuiltInKind::Sgcmg], SETTINGS, &mut Random::new(7));
    let device = HostDevice { bytes: 1 << 20, threads: 1 };
    let none = |_: &[BuiltInKind]| Err(GpuError::Generator("it is not there".to_owned()));
    let batch = Batch::new(vec![craft(&case)], false, Ok(&device), none).expect("a batch");
    let reason = batch.fallback().expect("a reason").to_string();
    assert!(reason.contains("it is not there") && reason.contains("cargo install"), "{reason}");
}

#[test]
fn a_machine_without_a_driver_says_so() {
    // SAFETY: loads the driver by its name and closes it.
    let has_driver = unsafe { libloading::Library::new("libcuda.so.1") }.is_ok();
    match open() {
        Ok(device) => assert!(has_driver && !device.name().is_empty()),
        Err(error) => {
            assert_eq!(error == GpuError::NoDriver, !has_driver, "{error}");
            assert!(error.to_string().len() > 20);
        }
    }
}
