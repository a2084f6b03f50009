//! What a campaign on a GPU does not support is refused by its name, whether there is a GPU or not; with the feature `cuda` rows
//! do not depend on what makes the steps.

use std::fs;
use std::path::Path;

use precess::file::Template;
use precess::scenario::NotOnGpu;

use super::shared::folder;
use super::side_by_side::GYROS;

/// Overrides of a scenario, and what is refused.
fn refused(template: &Template, set: &[&str]) -> Option<NotOnGpu> {
    let overrides: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
    let read = template.scenario(&overrides);
    read.unwrap_or_else(|errors| panic!("{set:?}: {errors}")).0.not_on_gpu()
}

fn written(name: &str, text: &str) -> Template {
    let (folder, _) = folder(name);
    let file = folder.join("gyros.toml");
    fs::write(&file, text).expect("a file");
    Template::from_file(&file).unwrap_or_else(|errors| panic!("{errors}"))
}

fn of_repository(name: &str) -> Template {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(name);
    Template::from_file(&file).unwrap_or_else(|errors| panic!("{errors}"))
}

const FIXED: [&str; 2] = ["run.integrator = \"rk4\"", "run.step = \"1 ms\""];

#[test]
fn what_no_gpu_has_is_refused_by_its_name() {
    let gyros = written("refused-on-gpu", GYROS);
    assert_eq!(refused(&gyros, &[]), None);
    let friction =
        ["device.a.wheel.static_friction = \"0.01 N m\"", "device.a.wheel.coulomb = \"0.01 N m\""];
    let crossing = ["crossing = [{ name = \"fast\", column = \"a.spin\", value = \"400 rad/s\" }]"];
    let joint = |name: &str| name.to_owned();
    for (set, expected) in [
        (&friction[..], NotOnGpu::Friction(joint("a.theta"))),
        (&crossing, NotOnGpu::Crossing(joint("fast"))),
        (&["device.b.inner_gimbal.upper_stop = \"1 rad\""], NotOnGpu::EndStop(joint("b.gamma_i"))),
        (&["device.a.wheel.power_limit = \"9 W\""], NotOnGpu::MotorLimit(joint("a.theta"))),
    ] {
        let found = refused(&gyros, set);
        assert_eq!(found.as_ref(), Some(&expected));
        assert!(expected.to_string().contains("a GPU has no"), "{expected}");
    }
    let adaptive = GYROS.replace("integrator = \"rk4\"\nstep = \"1 ms\"\n", "");
    assert_eq!(refused(&written("adaptive-on-gpu", &adaptive), &[]), Some(NotOnGpu::AdaptiveSteps));
    for (file, expected) in [
        ("wheels-on-isolator.toml", "devices on the hub only"),
        ("beam-tip-wheel.toml", "no flexible structure"),
        ("four-wheel-slew.toml", "no controllers"),
        ("wheel-data-sheet.toml", "no sources"),
    ] {
        let template = of_repository(file);
        let found = refused(&template, &FIXED).map(|found| found.to_string()).unwrap_or_default();
        assert!(found.contains(expected), "{file}: {found}");
    }
}

/// A device whose kernels refuse every state: all that a batch hands over is computed by the solver.
#[cfg(feature = "cuda")]
mod refusing {
    use precess_gpu::{Array, Device, GpuError, Kernels, Segment, Sources};

    pub(super) struct Refusing;

    struct RefusingKernels;

    impl Device for Refusing {
        fn name(&self) -> String {
            "none".to_owned()
        }

        fn compile(&self, _: &Sources) -> Result<Box<dyn Kernels>, GpuError> {
            Ok(Box::new(RefusingKernels))
        }
    }

    impl Kernels for RefusingKernels {
        fn free_bytes(&self) -> Result<usize, GpuError> {
            Ok(1 << 20)
        }

        fn prepare(&mut self, _: &[f64], _: &[f64]) -> Result<i32, GpuError> {
            Ok(0)
        }

        fn begin(&mut self, _: i32) -> Result<(), GpuError> {
            Ok(())
        }

        fn write(&mut self, _: Array, _: &[f64]) -> Result<(), GpuError> {
            Ok(())
        }

        fn zeros(&mut self, _: Array, _: usize) -> Result<(), GpuError> {
            Ok(())
        }

        fn accelerations(&mut self) -> Result<(), GpuError> {
            Ok(())
        }

        fn run(&mut self, _: Segment) -> Result<(), GpuError> {
            Ok(())
        }

        fn read(&self, _: Array, _: &mut [f64]) -> Result<(), GpuError> {
            Ok(())
        }

        fn statuses(&self, out: &mut [i32]) -> Result<(), GpuError> {
            out.fill(3);
            Ok(())
        }
    }
}

#[cfg(feature = "cuda")]
#[test]
fn rows_do_not_depend_on_what_makes_the_steps() {
    use precess::campaign::{run_reduced, run_reduced_on};
    use precess::engine::Gpu;
    use precess_gpu::Sources;

    use super::side_by_side::{CASES, bits, scenario, selection};

    let template = written("rows-on-gpu", GYROS);
    let scenarios: Vec<_> = CASES.iter().map(|case| scenario(&template, case)).collect();
    let sources = Sources { name: "set".to_owned(), files: Vec::new() };
    let gpu = Gpu::new(Box::new(refusing::Refusing), sources).expect("a device");
    let rows = |of: Vec<Option<Result<Vec<f64>, String>>>| -> Vec<Vec<u64>> {
        of.into_iter().map(|row| bits(&row.expect("not cancelled").expect("a row"))).collect()
    };
    let mut selection = selection();
    // Work is not kept, and energy's drift neither.
    selection.columns.retain(|column| column != "energy");
    let without = rows(run_reduced(scenarios.clone(), &selection, &|| false));
    assert_eq!(rows(run_reduced_on(Some(&gpu), scenarios, &selection, &|| false)), without);
}
