//! Accelerations and their derivatives as foreign functions of XLA, which JAX calls on the CPU: the buffers
//! of XLA are read and written in place, without the interpreter and its lock.
//!
//! A function of a spacecraft is registered under a number, which its calls pass as their one attribute.

mod abi;

use std::collections::BTreeMap;
use std::ffi::CString;
use std::mem::offset_of;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null_mut;
use std::sync::atomic::{AtomicI64, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use precess::evaluation::{CraftInputs, EvaluationError};
use pyo3::prelude::*;

use crate::batch::{BatchRows, InputRows, Linearized, NativeBatch};
use crate::errors;
use crate::inputs::NativeInputs;
use abi::{Buffer, CallFrame, Error, ScalarAttribute};

/// Names of the functions, as JAX registers them.
const NAMES: [&str; 2] = ["precess_accelerations", "precess_linearize"];

/// The functions of a spacecraft.
struct Function {
    batch: Arc<BatchRows>,
    base: CraftInputs,
    /// None where there is friction that sticks.
    linearized: Result<Arc<Linearized>, EvaluationError>,
    /// Calls of each of [`NAMES`].
    calls: [AtomicU64; 2],
}

static FUNCTIONS: Mutex<BTreeMap<i64, Arc<Function>>> = Mutex::new(BTreeMap::new());
static NEXT: AtomicI64 = AtomicI64::new(1);

fn functions() -> MutexGuard<'static, BTreeMap<i64, Arc<Function>>> {
    FUNCTIONS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The functions of a spacecraft, registered as long as this lives.
#[pyclass(frozen, module = "precess._native")]
pub(crate) struct NativeFunction {
    number: i64,
    function: Arc<Function>,
}

#[pymethods]
impl NativeFunction {
    #[new]
    fn new(batch: &NativeBatch, inputs: &NativeInputs) -> PyResult<Self> {
        let (batch, base) = (batch.of_one()?.clone(), inputs.get()?.clone());
        let linearized = batch.linearized(&base);
        let function = Arc::new(Function { batch, base, linearized, calls: Default::default() });
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        functions().insert(number, function.clone());
        Ok(Self { number, function })
    }

    /// The attribute of its calls.
    #[getter]
    fn number(&self) -> i64 {
        self.number
    }

    /// Names of the linearised system: accelerations, states, inputs.
    #[getter]
    fn linearized(&self) -> PyResult<(Vec<String>, Vec<String>, Vec<String>)> {
        let found = self.function.linearized.as_ref().map_err(errors::evaluation)?;
        let Linearized { outputs, states, inputs } = &**found;
        Ok((outputs.clone(), states.clone(), inputs.clone()))
    }

    /// Calls of accelerations and of derivatives so far, once for a batch.
    #[getter]
    fn calls(&self) -> [u64; 2] {
        self.function.calls.each_ref().map(|calls| calls.load(Ordering::Relaxed))
    }
}

impl Drop for NativeFunction {
    fn drop(&mut self) {
        functions().remove(&self.number);
    }
}

/// Names and addresses of the functions, for `jax.ffi.register_ffi_target`.
#[pyfunction]
pub(crate) fn xla_functions() -> Vec<(&'static str, usize)> {
    let handlers = [accelerations as Handler, linearize as Handler];
    NAMES.into_iter().zip(handlers.map(|handler| handler as usize)).collect()
}

type Handler = unsafe extern "C" fn(*mut CallFrame) -> Error;

/// `precess_accelerations(y, u; number) -> a`.
///
/// # Safety
///
/// As XLA calls its handlers: with a call frame of [`abi::VERSION`].
unsafe extern "C" fn accelerations(frame: *mut CallFrame) -> Error {
    // SAFETY: as this function.
    unsafe {
        call_handler(frame, |of, [y, u], [a]: [&mut [f64]; 1]| {
            let acting = of.acting(y, u, &[(a.len(), of.batch.acceleration_size())])?;
            of.calls[0].fetch_add(1, Ordering::Relaxed);
            of.batch.accelerations((y, &acting), a, 0, &|_| true);
            Ok(())
        })
    }
}

/// `precess_linearize(y, u; number) -> (C, D)`.
///
/// # Safety
///
/// As [`accelerations`].
unsafe extern "C" fn linearize(frame: *mut CallFrame) -> Error {
    // SAFETY: as this function.
    unsafe {
        call_handler(frame, |of, [y, u], [c, d]: [&mut [f64]; 2]| {
            let system = of.linearized.as_ref().map_err(ToString::to_string)?;
            let sizes = system.sizes();
            let (of_c, of_d) = (sizes.rows * sizes.states, sizes.rows * sizes.inputs);
            let acting = of.acting(y, u, &[(c.len(), of_c), (d.len(), of_d)])?;
            of.calls[1].fetch_add(1, Ordering::Relaxed);
            of.batch.linearize((y, &acting), sizes, (c, d), 0, &|_| true);
            Ok(())
        })
    }
}

impl Function {
    /// The rows of inputs, where all buffers have as many rows as there are states.
    fn acting(&self, y: &[f64], u: &[f64], out: &[(usize, usize)]) -> Result<InputRows, String> {
        let (size, width) = (self.batch.state_size(), self.batch.input_size());
        let count = y.len() / size;
        let fits = |&(numbers, of_one): &(usize, usize)| numbers == count * of_one;
        if ![(y.len(), size), (u.len(), width)].iter().chain(out).all(fits) {
            return Err(format!(
                "{} numbers of states and {} of inputs; a state has {size}, its inputs {width}",
                y.len(),
                u.len()
            ));
        }
        Ok(InputRows { base: self.base.clone(), rows: u.to_vec(), width })
    }
}

/// Returns the version on a metadata query; otherwise calls `work` with the arguments and results.
///
/// # Safety
///
/// As [`accelerations`].
unsafe fn call_handler<const R: usize>(
    frame: *mut CallFrame,
    work: impl FnOnce(&Function, [&[f64]; 2], [&mut [f64]; R]) -> Result<(), String>,
) -> Error {
    // SAFETY: XLA passes a call frame that outlives the call.
    let frame = unsafe { &mut *frame };
    // SAFETY: an extension begins with its kind; one of this kind is a `MetadataExtension`, to be filled in.
    // Metadata begin with their size.
    unsafe {
        if let Some(extension) = frame.extension_start.as_mut()
            && extension.kind == abi::METADATA
        {
            let metadata = (*frame.extension_start.cast::<abi::MetadataExtension>()).metadata;
            let needed = offset_of!(abi::Metadata, traits) + size_of::<u32>();
            if (*metadata).struct_size < needed {
                return failed(frame, "metadata are too short".to_string(), abi::INTERNAL);
            }
            let (major, minor) = abi::VERSION;
            let struct_size = size_of::<abi::ApiVersion>();
            let extension_start = null_mut();
            (*metadata).api_version =
                abi::ApiVersion { struct_size, extension_start, major, minor };
            (*metadata).traits = 0;
            return null_mut();
        }
    }
    let attempt = catch_unwind(AssertUnwindSafe(|| {
        // SAFETY: arguments and results are those of this call, which do not overlap.
        let (number, arguments, results) = unsafe { taken(frame) }?;
        let of = functions().get(&number).cloned();
        let of = of.ok_or(
            "the function of precess.jax no longer exists; keep it as long as what was compiled of it",
        )?;
        work(&of, arguments, results)
    }));
    // SAFETY: as this function.
    unsafe {
        match attempt {
            Ok(Ok(())) => null_mut(),
            Ok(Err(message)) => failed(frame, message, abi::INVALID_ARGUMENT),
            Err(_) => failed(frame, "a call panicked".to_string(), abi::INTERNAL),
        }
    }
}

/// An error of XLA's.
///
/// # Safety
///
/// As [`accelerations`].
unsafe fn failed(frame: &CallFrame, message: String, code: i32) -> Error {
    let message = CString::new(format!("precess: {message}")).unwrap_or_default();
    let struct_size = offset_of!(abi::ErrorArguments, code) + size_of::<i32>();
    let (extension_start, message) = (null_mut(), message.as_c_str());
    let mut error =
        abi::ErrorArguments { struct_size, extension_start, message: message.as_ptr(), code };
    // SAFETY: XLA's own function, which copies the message.
    unsafe { ((*frame.api).create_error)(&raw mut error) }
}

/// What a call passes: the number, two arguments, and so many results.
type CallArguments<'a, const R: usize> = (i64, [&'a [f64]; 2], [&'a mut [f64]; R]);

/// The number, arguments and results of a call.
///
/// # Safety
///
/// As [`accelerations`]; results overlap neither arguments nor each other.
unsafe fn taken<const R: usize>(frame: &CallFrame) -> Result<CallArguments<'_, R>, String> {
    let attributes = &frame.attributes;
    // SAFETY: XLA has as many kinds and items as it says.
    let number = unsafe {
        if attributes.size != 1 || *attributes.kinds != abi::SCALAR {
            return Err("a call has one attribute, a number".to_string());
        }
        let scalar = &*(*attributes.items).cast::<ScalarAttribute>();
        if scalar.dtype != abi::S64 {
            return Err("the attribute is an integer of 64 bits".to_string());
        }
        scalar.value.cast::<i64>().read_unaligned()
    };
    // SAFETY: as above; a buffer of XLA is as long as its dimensions say, and lives as long as the call.
    unsafe {
        let [y, u] = numbers::<2>(&frame.arguments)?;
        let results = numbers::<R>(&frame.results)?;
        let read =
            |(data, count): (*mut f64, usize)| std::slice::from_raw_parts(data.cast_const(), count);
        let write = |(data, count): (*mut f64, usize)| {
            // XLA's results are not initialised: NaN where nothing is written.
            (0..count).for_each(|k| data.add(k).write(f64::NAN));
            std::slice::from_raw_parts_mut(data, count)
        };
        Ok((number, [read(y), read(u)], results.map(write)))
    }
}

/// Address and length of so many buffers of numbers of 64 bits.
///
/// # Safety
///
/// As [`accelerations`].
unsafe fn numbers<const N: usize>(of: &abi::Buffers) -> Result<[(*mut f64, usize); N], String> {
    if usize::try_from(of.size) != Ok(N) {
        return Err(format!("{} buffers; a call has {N}", of.size));
    }
    let mut found = [(std::ptr::NonNull::<f64>::dangling().as_ptr(), 0); N];
    for (index, found) in found.iter_mut().enumerate() {
        // SAFETY: XLA has as many kinds and items as it says; an item of this kind is a buffer, and has as many
        // dimensions as its rank.
        unsafe {
            if *of.kinds.add(index) != abi::BUFFER {
                return Err("an argument is no buffer".to_string());
            }
            let buffer = &*(*of.items.add(index)).cast::<Buffer>();
            if buffer.dtype != abi::F64 {
                return Err("numbers are of 64 bits".to_string());
            }
            let rank = usize::try_from(buffer.rank).unwrap_or(0);
            let dims = (0..rank).map(|k| usize::try_from(*buffer.dims.add(k)).unwrap_or(0));
            let count = dims.product();
            if count > 0 {
                *found = (buffer.data.cast(), count);
            }
        }
    }
    Ok(found)
}
