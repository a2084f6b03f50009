//! The part of XLA's foreign function interface that is used: the leading fields of structures of
//! `xla/ffi/api/c_api.h`. XLA sets the others to zero.

use std::ffi::{c_char, c_int, c_void};

/// The first version: nothing of a later one is used.
pub(super) const VERSION: (c_int, c_int) = (0, 1);

/// `XLA_FFI_Extension_Metadata`.
pub(super) const METADATA: c_int = 1;
/// `XLA_FFI_ArgType_BUFFER` and `XLA_FFI_RetType_BUFFER`.
pub(super) const BUFFER: c_int = 1;
/// `XLA_FFI_AttrType_SCALAR`.
pub(super) const SCALAR: c_int = 3;
/// `XLA_FFI_DataType_S64`.
pub(super) const S64: c_int = 5;
/// `XLA_FFI_DataType_F64`.
pub(super) const F64: c_int = 12;
/// `XLA_FFI_Error_Code_INVALID_ARGUMENT`.
pub(super) const INVALID_ARGUMENT: c_int = 3;
/// `XLA_FFI_Error_Code_INTERNAL`.
pub(super) const INTERNAL: c_int = 13;

/// An error of XLA's, or null.
pub(super) type Error = *mut c_void;

#[repr(C)]
pub(super) struct Extension {
    pub(super) struct_size: usize,
    pub(super) kind: c_int,
    pub(super) next: *mut Self,
}

#[repr(C)]
pub(super) struct ApiVersion {
    pub(super) struct_size: usize,
    pub(super) extension_start: *mut Extension,
    pub(super) major: c_int,
    pub(super) minor: c_int,
}

#[repr(C)]
pub(super) struct Metadata {
    pub(super) struct_size: usize,
    pub(super) api_version: ApiVersion,
    pub(super) traits: u32,
}

#[repr(C)]
pub(super) struct MetadataExtension {
    pub(super) base: Extension,
    pub(super) metadata: *mut Metadata,
}

#[repr(C)]
pub(super) struct ErrorArguments {
    pub(super) struct_size: usize,
    pub(super) extension_start: *mut Extension,
    pub(super) message: *const c_char,
    pub(super) code: c_int,
}

/// Its first functions.
#[repr(C)]
pub(super) struct Api {
    pub(super) struct_size: usize,
    pub(super) extension_start: *mut Extension,
    pub(super) version: ApiVersion,
    pub(super) internal: *const c_void,
    pub(super) create_error: unsafe extern "C" fn(*mut ErrorArguments) -> Error,
}

#[repr(C)]
pub(super) struct Buffer {
    pub(super) struct_size: usize,
    pub(super) extension_start: *mut Extension,
    pub(super) dtype: c_int,
    pub(super) data: *mut c_void,
    pub(super) rank: i64,
    pub(super) dims: *const i64,
}

/// Arguments or results.
#[repr(C)]
pub(super) struct Buffers {
    pub(super) struct_size: usize,
    pub(super) extension_start: *mut Extension,
    pub(super) size: i64,
    pub(super) kinds: *const c_int,
    pub(super) items: *const *mut c_void,
}

#[repr(C)]
pub(super) struct Attributes {
    pub(super) struct_size: usize,
    pub(super) extension_start: *mut Extension,
    pub(super) size: i64,
    pub(super) kinds: *const c_int,
    pub(super) names: *const *const c_void,
    pub(super) items: *const *mut c_void,
}

#[repr(C)]
pub(super) struct ScalarAttribute {
    pub(super) dtype: c_int,
    pub(super) value: *const c_void,
}

#[repr(C)]
pub(super) struct CallFrame {
    pub(super) struct_size: usize,
    pub(super) extension_start: *mut Extension,
    pub(super) api: *const Api,
    pub(super) context: *mut c_void,
    pub(super) stage: c_int,
    pub(super) arguments: Buffers,
    pub(super) results: Buffers,
    pub(super) attributes: Attributes,
}
