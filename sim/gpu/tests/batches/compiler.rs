//! NVRTC, where it is installed, compiles the kernels without a GPU, and without contraction.

use std::env;
use std::fs;
use std::path::Path;

use libloading::Library;
use precess_dynamics::BuiltInKind;
use precess_gpu::{GpuError, SourceFile, Sources, compile};

use crate::host::sources;

/// Loads the NVRTC of the engines' packages, where they are installed, so that it is found by its name.
fn package() -> Option<Library> {
    let engines = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../target/engines/lib");
    let versions = fs::read_dir(engines).ok()?.flatten();
    let place = "site-packages/nvidia/cuda_nvrtc/lib/libnvrtc.so.12";
    let found = versions.map(|version| version.path().join(place)).find(|path| path.is_file())?;
    // SAFETY: a library of NVIDIA, whose constructors are those that every program with NVRTC runs.
    unsafe { Library::new(found) }.ok()
}

#[test]
fn nvrtc_compiles_the_kernels_without_contraction() {
    let _package = package();
    let kernels = sources(&[BuiltInKind::ReactionWheel]).expect("the kernels");
    let ptx = match compile(&kernels, Some("compute_90")) {
        Err(GpuError::NoCompiler) => {
            let skipped = "skipped: NVRTC (install with: pip install nvidia-cuda-nvrtc-cu12)";
            assert!(
                env::var_os("PRECESS_REQUIRE_ALL").is_none_or(|value| value != "1"),
                "{skipped}"
            );
            eprintln!("{skipped}");
            return;
        }
        found => found.expect("PTX"),
    };
    for kernel in ["size", "prepare", "accelerations", "run"] {
        assert!(ptx.contains(&format!(".entry set_batch_{kernel}(")), "{kernel}");
    }
    assert!(ptx.contains("mul.rn.f64") && !ptx.contains("fma.rn.f64"));
    let wrong = SourceFile { path: "set_batch.cu".to_owned(), text: "no C".to_owned() };
    let wrong = Sources { name: "set".to_owned(), files: vec![wrong] };
    let error = compile(&wrong, None).unwrap_err();
    assert!(matches!(&error, GpuError::Compile(log) if log.contains("error")), "{error}");
    let old = compile(&kernels, Some("compute_1")).unwrap_err();
    assert!(matches!(&old, GpuError::Compile(log) if log.contains("gpu-architecture")), "{old}");
}
