//! A GPU of NVIDIA: [`open`] looks for one, [`compile`] makes PTX of the kernels by NVRTC, without contraction. Both libraries
//! are loaded at run time. The only `unsafe` of this crate: a kernel is launched with addresses that it reads and writes.
#![allow(unsafe_code, reason = "kernels are launched by address, as the driver has it")]

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};

use cudarc::driver::sys::CUdevice_attribute::CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT;
use cudarc::driver::{
    CudaContext, CudaFunction, CudaModule, CudaSlice, CudaStream, DevicePtr as _, DeviceRepr,
    DriverError, LaunchConfig, PushKernelArg as _,
};
use cudarc::nvrtc::{CompileError, CompileOptions, Ptx, compile_ptx_with_opts};

use crate::launch::{launch_size, threads};
use crate::{Array, Device, GpuError, Kernels, LaunchSize, PrecessBatch, Segment, Sources};

// SAFETY: it is `repr(C)`, has no padding, and is the struct that the kernels take by value.
unsafe impl DeviceRepr for PrecessBatch {}

/// Of errors of the driver at some call.
fn at(what: &'static str) -> impl Fn(DriverError) -> GpuError {
    move |error| GpuError::Driver { at: what, code: format!("{:?}", error.0) }
}

/// The first GPU.
///
/// # Errors
/// [`GpuError::NoDriver`], [`GpuError::NoCompiler`], or the driver has no GPU that it can use.
pub fn open() -> Result<Box<dyn Device>, GpuError> {
    let device = open_compiled(Vec::new())?;
    has_compiler()?;
    Ok(device)
}

/// The first GPU, with kernels that [`compile`] has made elsewhere: of these sets it needs no NVRTC.
///
/// # Errors
/// [`GpuError::NoDriver`], or the driver has no GPU that it can use.
pub fn open_compiled(ptx: Vec<(Sources, String)>) -> Result<Box<dyn Device>, GpuError> {
    // SAFETY: loads a library by its name and closes it, whose constructors are those of the driver.
    if !unsafe { cudarc::driver::sys::is_culib_present() } {
        return Err(GpuError::NoDriver);
    }
    // A driver that is too old for a function of these bindings ends in a panic of `cudarc`.
    let made = catch_unwind(AssertUnwindSafe(|| {
        let context = CudaContext::new(0).map_err(at("the first GPU"))?;
        let multiprocessors = context.attribute(CU_DEVICE_ATTRIBUTE_MULTIPROCESSOR_COUNT);
        let (major, minor) = context.compute_capability().map_err(at("its architecture"))?;
        Ok(CudaDevice {
            name: context.name().map_err(at("its name"))?,
            multiprocessors: unsigned(multiprocessors.map_err(at("its multiprocessors"))?),
            architecture: format!("compute_{major}{minor}"),
            context,
            ptx,
            compiled: Mutex::new(None),
        })
    }));
    let device = made.unwrap_or_else(|_| {
        Err(GpuError::Driver { at: "the first GPU", code: "the driver is too old".to_owned() })
    });
    Ok(Box::new(device?))
}

/// Whether there is NVRTC.
fn has_compiler() -> Result<(), GpuError> {
    // SAFETY: loads a library by its name and closes it, whose constructors are those of NVRTC.
    if unsafe { cudarc::nvrtc::sys::is_culib_present() } {
        Ok(())
    } else {
        Err(GpuError::NoCompiler)
    }
}

/// PTX of the kernels for an architecture such as `compute_90`; without one, for the oldest that NVRTC knows, which every
/// later GPU takes. Needs no GPU.
///
/// # Errors
/// [`GpuError::NoCompiler`], [`GpuError::Compile`].
pub fn compile(sources: &Sources, architecture: Option<&str>) -> Result<String, GpuError> {
    has_compiler()?;
    let text = sources.one_text()?;
    let mut options = vec!["--device-as-default-execution-space".to_owned()];
    options.extend(architecture.map(|of| format!("--gpu-architecture={of}")));
    let options = CompileOptions { fmad: Some(false), options, ..CompileOptions::default() };
    let made = catch_unwind(AssertUnwindSafe(|| compile_ptx_with_opts(text, options)));
    match made {
        Ok(Ok(ptx)) => Ok(ptx.to_src()),
        Ok(Err(CompileError::CompileError { log, .. })) => {
            Err(GpuError::Compile(log.to_string_lossy().into_owned()))
        }
        Ok(Err(error)) => Err(GpuError::Compile(error.to_string())),
        Err(_) => Err(GpuError::Compile("a function of NVRTC is missing".to_owned())),
    }
}

fn unsigned(of: i32) -> u32 {
    u32::try_from(of).unwrap_or(0)
}

/// A GPU.
struct CudaDevice {
    context: Arc<CudaContext>,
    name: String,
    multiprocessors: u32,
    architecture: String,
    /// What was compiled elsewhere.
    ptx: Vec<(Sources, String)>,
    /// The last kernels: campaigns have one set of devices and many batches.
    compiled: Mutex<Option<(Sources, Arc<CudaModule>)>>,
}

impl CudaDevice {
    fn module(&self, sources: &Sources) -> Result<Arc<CudaModule>, GpuError> {
        let mut compiled = self.compiled.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((of, module)) = &*compiled
            && of == sources
        {
            return Ok(module.clone());
        }
        let elsewhere = self.ptx.iter().find(|(of, _)| of == sources);
        let own = match elsewhere {
            Some((_, ptx)) => Ok(ptx.clone()),
            None => compile(sources, Some(&self.architecture)),
        };
        // A GPU that is newer than NVRTC takes what is compiled for older ones.
        let ptx = own.or_else(|error| match &error {
            GpuError::Compile(log) if log.contains("gpu-architecture") => compile(sources, None),
            _ => Err(error),
        })?;
        let module = self.context.load_module(Ptx::from_src(ptx)).map_err(at("the kernels"))?;
        *compiled = Some((sources.clone(), module.clone()));
        Ok(module)
    }
}

impl Device for CudaDevice {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn compile(&self, sources: &Sources) -> Result<Box<dyn Kernels>, GpuError> {
        let module = self.module(sources)?;
        let function = |kernel: &str| {
            let name = format!("{}_batch_{kernel}", sources.name);
            module.load_function(&name).map_err(at("a kernel"))
        };
        // Batches of several threads do not wait for each other.
        let stream = self.context.new_stream().map_err(at("a stream"))?;
        let size = function("size")?;
        let mut bytes = stream.alloc_zeros::<i32>(1).map_err(at("memory"))?;
        let mut launch = stream.launch_builder(&size);
        launch.arg(&mut bytes);
        // SAFETY: the kernel `size` writes one `int`.
        unsafe { launch.launch(config(LaunchSize { blocks: 1, threads: 1 })) }
            .map_err(at("the kernel `size`"))?;
        let mut found = [0];
        stream.memcpy_dtoh(&bytes, &mut found).map_err(at("a result"))?;
        stream.synchronize().map_err(at("the kernel `size`"))?;
        let length = usize::try_from(found[0]).unwrap_or(0);
        Ok(Box::new(CudaKernels {
            shared: stream.alloc_zeros::<u8>(length).map_err(at("memory"))?,
            prepare: function("prepare")?,
            accelerations: function("accelerations")?,
            run: function("run")?,
            multiprocessors: self.multiprocessors,
            arrays: [const { None }; Array::ALL.len()],
            statuses: stream.alloc_zeros::<i32>(1).map_err(at("memory"))?,
            batch: PrecessBatch::default(),
            context: self.context.clone(),
            stream,
        }))
    }
}

fn config(LaunchSize { blocks, threads }: LaunchSize) -> LaunchConfig {
    LaunchConfig { grid_dim: (blocks, 1, 1), block_dim: (threads, 1, 1), shared_mem_bytes: 0 }
}

/// Kernels, and the arrays of a batch, all on one stream: what is done with them is done in order.
struct CudaKernels {
    context: Arc<CudaContext>,
    stream: Arc<CudaStream>,
    prepare: CudaFunction,
    accelerations: CudaFunction,
    run: CudaFunction,
    multiprocessors: u32,
    shared: CudaSlice<u8>,
    arrays: [Option<CudaSlice<f64>>; Array::ALL.len()],
    statuses: CudaSlice<i32>,
    batch: PrecessBatch,
}

impl CudaKernels {
    fn put(&mut self, array: Array, slice: CudaSlice<f64>) {
        *self.batch.address(array) = slice.device_ptr(&self.stream).0;
        self.arrays[array as usize] = Some(slice);
    }

    /// Launches a kernel over the states, and waits for it.
    fn launch(&self, kernel: &CudaFunction, batch: PrecessBatch) -> Result<(), GpuError> {
        let registers = unsigned(kernel.num_regs().map_err(at("a kernel"))?);
        let most = unsigned(kernel.max_threads_per_block().map_err(at("a kernel"))?);
        let own = threads(registers, most);
        let blocks = kernel.occupancy_max_active_blocks_per_multiprocessor(own, 0, None);
        let resident = blocks.map_err(at("a kernel"))? * self.multiprocessors;
        let size = launch_size(registers, most, resident, unsigned(batch.count));
        let mut launch = self.stream.launch_builder(kernel);
        launch.arg(&batch);
        // SAFETY: the kernel takes this struct by value; its addresses are of arrays of `count` columns that `self` owns, of the
        // lengths that `Batch` gives them, or zero where the kernel takes none; `shared` was written by `prepare`.
        unsafe { launch.launch(config(size)) }.map_err(at("a kernel"))?;
        self.stream.synchronize().map_err(at("a kernel"))
    }
}

impl Kernels for CudaKernels {
    fn free_bytes(&self) -> Result<usize, GpuError> {
        // What the last batch takes is given back before the next.
        let own = self.arrays.iter().flatten().map(CudaSlice::num_bytes).sum::<usize>();
        let (free, _) = self.context.mem_get_info().map_err(at("the memory"))?;
        Ok(free + own)
    }

    fn prepare(&mut self, parameters: &[f64], inputs: &[f64]) -> Result<i32, GpuError> {
        let parameters = self.stream.clone_htod(parameters).map_err(at("memory"))?;
        let inputs = self.stream.clone_htod(inputs).map_err(at("memory"))?;
        let mut status = self.stream.alloc_zeros::<i32>(1).map_err(at("memory"))?;
        let mut launch = self.stream.launch_builder(&self.prepare);
        launch.arg(&parameters).arg(&inputs).arg(&mut self.shared).arg(&mut status);
        // SAFETY: the kernel `prepare` reads both arrays, of the lengths that `Batch` gives them, and writes a struct of the
        // size that the kernel `size` has returned, and one `int`.
        unsafe { launch.launch(config(LaunchSize { blocks: 1, threads: 1 })) }
            .map_err(at("the kernel `prepare`"))?;
        let mut found = [0];
        self.stream.memcpy_dtoh(&status, &mut found).map_err(at("a result"))?;
        self.stream.synchronize().map_err(at("the kernel `prepare`"))?;
        Ok(found[0])
    }

    fn begin(&mut self, count: i32) -> Result<(), GpuError> {
        self.arrays = [const { None }; Array::ALL.len()];
        let length = usize::try_from(count).unwrap_or(0);
        self.statuses = self.stream.alloc_zeros::<i32>(length.max(1)).map_err(at("memory"))?;
        self.batch = PrecessBatch {
            shared: self.shared.device_ptr(&self.stream).0,
            statuses: self.statuses.device_ptr(&self.stream).0,
            count,
            ..PrecessBatch::default()
        };
        Ok(())
    }

    fn write(&mut self, array: Array, numbers: &[f64]) -> Result<(), GpuError> {
        let slice = self.stream.clone_htod(numbers).map_err(at("memory"))?;
        self.put(array, slice);
        Ok(())
    }

    fn zeros(&mut self, array: Array, length: usize) -> Result<(), GpuError> {
        let slice = self.stream.alloc_zeros::<f64>(length).map_err(at("memory"))?;
        self.put(array, slice);
        Ok(())
    }

    fn accelerations(&mut self) -> Result<(), GpuError> {
        self.launch(&self.accelerations, self.batch)
    }

    fn run(&mut self, segment: Segment) -> Result<(), GpuError> {
        let Segment { dt, first, steps, every, is_last } = segment;
        let is_last = i32::from(is_last);
        self.launch(&self.run, PrecessBatch { dt, first, steps, every, is_last, ..self.batch })
    }

    fn read(&self, array: Array, out: &mut [f64]) -> Result<(), GpuError> {
        let found = self.arrays[array as usize].as_ref();
        let length = found.map_or(0, CudaSlice::len);
        match found {
            Some(slice) if length == out.len() => {
                self.stream.memcpy_dtoh(slice, out).map_err(at("a result"))?;
                self.stream.synchronize().map_err(at("a result"))
            }
            _ => Err(GpuError::Length { array: "an array", expected: out.len(), found: length }),
        }
    }

    fn statuses(&self, out: &mut [i32]) -> Result<(), GpuError> {
        if self.statuses.len() != out.len().max(1) {
            let found = self.statuses.len();
            return Err(GpuError::Length { array: "statuses", expected: out.len(), found });
        }
        self.stream.memcpy_dtoh(&self.statuses, out).map_err(at("a result"))?;
        self.stream.synchronize().map_err(at("a result"))
    }
}
