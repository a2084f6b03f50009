//! [`HostDevice`]: the emitted kernels as a library of the host's compiler, which is given the same arrays and the same struct as a
//! GPU is; a thread after another.

use std::ffi::c_void;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use libloading::Library;
use precess_bake::{batch, solver};
use precess_codegen::emit::EmittedFile;
use precess_dynamics::BuiltInKind;
use precess_gpu::{Array, Device, GpuError, Kernels, PrecessBatch, Segment, SourceFile, Sources};

/// A device with so much memory and so many threads.
pub(crate) struct HostDevice {
    pub(crate) bytes: usize,
    pub(crate) threads: usize,
}

/// The sources of a set, as `precess-bake` writes them; derived once.
#[expect(clippy::unnecessary_wraps, reason = "as batches take it")]
pub(crate) fn sources(kinds: &[BuiltInKind]) -> Result<Sources, GpuError> {
    static DERIVED: Mutex<Vec<(Vec<BuiltInKind>, Sources)>> = Mutex::new(Vec::new());
    let mut derived = DERIVED.lock().expect("no test fails here");
    if let Some((_, sources)) = derived.iter().find(|(of, _)| of == kinds) {
        return Ok(sources.clone());
    }
    let description = Sources::description(kinds);
    let files = solver(&description).expect("a solver").into_iter();
    let files = files.chain(batch(&description).expect("kernels"));
    let file = |file: EmittedFile| SourceFile { path: file.path, text: file.text };
    let sources = Sources { name: description.name, files: files.map(file).collect() };
    derived.push((kinds.to_vec(), sources.clone()));
    Ok(sources)
}

/// The library of a set, compiled once: the processor's precision does not depend on optimisation.
fn compiled(sources: &Sources) -> PathBuf {
    static COMPILED: Mutex<Vec<(Sources, PathBuf)>> = Mutex::new(Vec::new());
    let mut compiled = COMPILED.lock().expect("no test fails here");
    if let Some((_, path)) = compiled.iter().find(|(of, _)| of == sources) {
        return path.clone();
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("gpu_{}", compiled.len()));
    fs::create_dir_all(&folder).expect("a folder");
    let mut compiler = Command::new("cc");
    compiler.args(["-std=c99", "-O0", "-ffp-contract=off", "-fPIC", "-shared", "-o", "kernels"]);
    for file in sources.files.iter().filter(|file| !file.path.contains('/')) {
        fs::write(folder.join(&file.path), &file.text).expect("a file");
        if Path::new(&file.path).extension() == Some("c".as_ref()) {
            compiler.arg(&file.path);
        }
    }
    let output = compiler.current_dir(&folder).output().expect("a compiler of C");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let path = folder.join("kernels");
    compiled.push((sources.clone(), path.clone()));
    path
}

impl Device for HostDevice {
    fn name(&self) -> String {
        "this machine".to_owned()
    }

    fn compile(&self, sources: &Sources) -> Result<Box<dyn Kernels>, GpuError> {
        let path = compiled(sources);
        // SAFETY: the library has no constructors.
        let library = unsafe { Library::new(path) }.expect("the kernels");
        let mut kernels = HostKernels {
            library,
            name: sources.name.clone(),
            bytes: self.bytes,
            threads: self.threads,
            shared: Vec::new(),
            arrays: [const { Vec::new() }; Array::ALL.len()],
            statuses: Vec::new(),
            batch: PrecessBatch::default(),
        };
        let mut size = 0_i32;
        // SAFETY: the kernel `size` writes one `int`.
        unsafe {
            let kernel: unsafe extern "C" fn(*mut i32, usize, usize) = kernels.kernel("size");
            kernel(&raw mut size, 0, 1);
        }
        // In numbers of eight bytes, for their alignment.
        kernels.shared = vec![0.0; usize::try_from(size).expect("a size").div_ceil(8)];
        Ok(Box::new(kernels))
    }
}

type BatchKernel = unsafe extern "C" fn(PrecessBatch, usize, usize);

struct HostKernels {
    library: Library,
    name: String,
    bytes: usize,
    threads: usize,
    shared: Vec<f64>,
    arrays: [Vec<f64>; Array::ALL.len()],
    statuses: Vec<i32>,
    batch: PrecessBatch,
}

impl HostKernels {
    /// A kernel of the set.
    ///
    /// # Safety
    /// `F` is the type of the function of that name.
    unsafe fn kernel<F: Copy>(&self, name: &str) -> F {
        let name = format!("{}_batch_{name}", self.name);
        // SAFETY: by the caller.
        *unsafe { self.library.get::<F>(name.as_bytes()) }.expect("a kernel")
    }

    fn launch(&mut self, kernel: &str, mut batch: PrecessBatch) {
        batch.shared = self.shared.as_ptr() as u64;
        batch.statuses = self.statuses.as_mut_ptr() as u64;
        for array in Array::ALL {
            let own = &mut self.arrays[array as usize];
            let address = if own.is_empty() { 0 } else { own.as_mut_ptr() as u64 };
            batch = batch.with(array, address);
        }
        // SAFETY: the kernel takes the struct by value, whose addresses are of arrays that `self` owns.
        let kernel: BatchKernel = unsafe { self.kernel(kernel) };
        for thread in 0..self.threads {
            // SAFETY: the same; threads are one after another.
            unsafe { kernel(batch, thread, self.threads) };
        }
    }
}

impl Kernels for HostKernels {
    fn free_bytes(&self) -> Result<usize, GpuError> {
        Ok(self.bytes)
    }

    fn prepare(&mut self, parameters: &[f64], inputs: &[f64]) -> Result<i32, GpuError> {
        let mut status = -1;
        let shared: *mut c_void = self.shared.as_mut_ptr().cast();
        // SAFETY: the kernel reads both arrays and writes a struct of the size that it says, and one `int`.
        unsafe {
            let kernel: unsafe extern "C" fn(
                *const f64,
                *const f64,
                *mut c_void,
                *mut i32,
                usize,
                usize,
            ) = self.kernel("prepare");
            kernel(parameters.as_ptr(), inputs.as_ptr(), shared, &raw mut status, 0, 1);
        }
        Ok(status)
    }

    fn begin(&mut self, count: i32) -> Result<(), GpuError> {
        self.arrays = [const { Vec::new() }; Array::ALL.len()];
        self.statuses = vec![0; usize::try_from(count).expect("a count")];
        self.batch = PrecessBatch { count, ..PrecessBatch::default() };
        Ok(())
    }

    fn write(&mut self, array: Array, numbers: &[f64]) -> Result<(), GpuError> {
        self.arrays[array as usize] = numbers.to_vec();
        Ok(())
    }

    fn zeros(&mut self, array: Array, length: usize) -> Result<(), GpuError> {
        self.arrays[array as usize] = vec![0.0; length];
        Ok(())
    }

    fn accelerations(&mut self) -> Result<(), GpuError> {
        self.launch("accelerations", self.batch);
        Ok(())
    }

    fn run(&mut self, segment: Segment) -> Result<(), GpuError> {
        let Segment { dt, first, steps, every, is_last } = segment;
        let is_last = i32::from(is_last);
        self.launch("run", PrecessBatch { dt, first, steps, every, is_last, ..self.batch });
        Ok(())
    }

    fn read(&self, array: Array, out: &mut [f64]) -> Result<(), GpuError> {
        out.copy_from_slice(&self.arrays[array as usize]);
        Ok(())
    }

    fn statuses(&self, out: &mut [i32]) -> Result<(), GpuError> {
        out.copy_from_slice(&self.statuses);
        Ok(())
    }
}
