//! Pointers of C made values: null and misaligned ones are rejected, everything else is the
//! caller's promise.

use crate::error::Code;

/// A structure of numbers only: every pattern of bits is a value of it.
///
/// # Safety
///
/// Implemented for `repr(C)` structures of integers and floating-point numbers only.
pub unsafe trait Plain: Copy {}

// SAFETY: every pattern of bits is a number.
unsafe impl Plain for f64 {}
// SAFETY: every pattern of bits is a number.
unsafe impl Plain for u32 {}
// SAFETY: every pattern of bits is a number.
unsafe impl Plain for usize {}
// SAFETY: every pattern of bits is a number.
unsafe impl Plain for u8 {}

/// Rejects a pointer that is null or misaligned.
///
/// # Errors
///
/// [`Code::Null`], [`Code::Misaligned`].
pub fn check<T>(pointer: *const T) -> Result<(), Code> {
    if pointer.is_null() {
        Err(Code::Null)
    } else if pointer.is_aligned() {
        Ok(())
    } else {
        Err(Code::Misaligned)
    }
}

/// The value at a pointer.
///
/// # Errors
///
/// [`Code::Null`], [`Code::Misaligned`].
///
/// # Safety
///
/// A pointer that is neither points to a readable `T`.
pub unsafe fn read<T: Plain>(pointer: *const T) -> Result<T, Code> {
    check(pointer)?;
    // SAFETY: not null, aligned, readable by contract; `Plain` has no invalid bits.
    Ok(unsafe { pointer.read() })
}

/// As [`read`], in place: structures are large, and copies of them take time.
///
/// # Errors
///
/// [`Code::Null`], [`Code::Misaligned`].
///
/// # Safety
///
/// A pointer that is neither points to a readable `T` that nobody changes while it is in use.
pub unsafe fn refer<'a, T: Plain>(pointer: *const T) -> Result<&'a T, Code> {
    check(pointer)?;
    // SAFETY: not null, aligned; readable and unchanged by contract; `Plain` has no invalid bits.
    Ok(unsafe { &*pointer })
}

/// Where a result is to be written: checked before anything is, so that a rejected call writes nothing.
///
/// There is no other way to write one number or structure.
#[derive(Debug)]
pub struct OutputPointer<T>(*mut T);

impl<T: Plain> OutputPointer<T> {
    /// The place at a pointer.
    ///
    /// # Errors
    ///
    /// [`Code::Null`], [`Code::Misaligned`].
    ///
    /// # Safety
    ///
    /// A pointer that is neither points to a `T` that stays writable until [`Self::write`].
    pub unsafe fn new(pointer: *mut T) -> Result<Self, Code> {
        check(pointer)?;
        Ok(Self(pointer))
    }

    /// As [`Self::new`], of an optional result: none at null.
    ///
    /// # Errors
    ///
    /// [`Code::Misaligned`].
    ///
    /// # Safety
    ///
    /// As [`Self::new`].
    pub unsafe fn optional(pointer: *mut T) -> Result<Option<Self>, Code> {
        if pointer.is_null() {
            return Ok(None);
        }
        // SAFETY: as promised to this function.
        unsafe { Self::new(pointer) }.map(Some)
    }

    /// Writes the result.
    pub fn write(self, value: T) {
        // SAFETY: not null, aligned; writable by the contract of `new`.
        unsafe { self.0.write(value) };
    }
}

/// Numbers in a row; none needs no pointer.
///
/// # Errors
///
/// [`Code::Null`], [`Code::Misaligned`], [`Code::TooMany`] for more than fits into any memory.
///
/// # Safety
///
/// The pointer points to `count` readable `T` that nobody changes while the slice is in use.
pub unsafe fn slice<'a, T: Plain>(pointer: *const T, count: usize) -> Result<&'a [T], Code> {
    if count == 0 {
        return Ok(&[]);
    }
    check(pointer)?;
    if count > isize::MAX as usize / size_of::<T>() {
        return Err(Code::TooMany);
    }
    // SAFETY: not null, aligned, not too long; readable and unchanged by contract.
    Ok(unsafe { core::slice::from_raw_parts(pointer, count) })
}

/// Three numbers.
///
/// # Errors
///
/// [`Code::Null`], [`Code::Misaligned`].
///
/// # Safety
///
/// A pointer that is neither points to three readable numbers.
pub unsafe fn vector(pointer: *const f64) -> Result<[f64; 3], Code> {
    // SAFETY: by contract.
    let &[x, y, z] = unsafe { slice(pointer, 3) }? else { return Err(Code::Null) };
    Ok([x, y, z])
}

/// Room for numbers in a row, to be written.
///
/// # Errors
///
/// [`Code::Null`], [`Code::Misaligned`], [`Code::TooMany`].
///
/// # Safety
///
/// The pointer points to `count` initialised, writable `T` that nobody else touches meanwhile.
pub unsafe fn slice_mut<'a, T: Plain>(pointer: *mut T, count: usize) -> Result<&'a mut [T], Code> {
    if count == 0 {
        return Ok(&mut []);
    }
    check(pointer)?;
    if count > isize::MAX as usize / size_of::<T>() {
        return Err(Code::TooMany);
    }
    // SAFETY: not null, aligned, not too long; writable and exclusive by contract.
    Ok(unsafe { core::slice::from_raw_parts_mut(pointer, count) })
}
