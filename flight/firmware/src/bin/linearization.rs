//! Counts the instructions of the linearised system of one and four DGVSCMGs on a Cortex-M, and holds the matrices of the
//! calls to each other: the workspace carries nothing from one to the next.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::fmt::Write;
use core::hint::black_box;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{Accelerations, Dgvscmg, Inputs, Spacecraft, State};
use precess_firmware::board::Options;
use precess_firmware::count::{Counts, Stop, hub, moving};
use precess_flight_linearization as library;

precess_firmware::program!(program);

/// Counts each of these: `module devices`.
macro_rules! count {
    ($counts:ident, $device:ident, $($module:ident $devices:literal;)*) => {$(
        {
            use library::$module::{A, B, Set, Workspace, linearize};
            type Linearize = extern "C" fn(
                &Spacecraft<Set>,
                &State<Set>,
                &Inputs<Set>,
                &mut A,
                &mut B,
                &mut Workspace,
                &mut Accelerations<Set>,
            ) -> bool;
            let craft = Spacecraft::new(&hub(), &[$device; $devices]).map_err(Stop::Parameters)?;
            let (mut state, mut inputs) = (State::<Set>::at_rest(), Inputs::<Set>::none());
            moving(&mut state, &mut inputs);
            let mut found = craft.accelerations(&state, &inputs).map_err(Stop::Solve)?;
            let (mut a, mut b) = ([0.0; size_of::<A>() / 8], [0.0; size_of::<B>() / 8]);
            let mut workspace = Workspace::new();
            let first = craft.linearize_fixed(&state, &inputs, [&mut a, &mut b], &mut workspace);
            first.map_err(Stop::Derivatives)?;
            let expected = (a, b);
            // By address, so that nothing is inlined.
            let call: Linearize = black_box(linearize);
            $counts.line(concat!(stringify!($module), " linearize"), || {
                let into = (black_box(&mut a), black_box(&mut b));
                call(&craft, black_box(&state), &inputs, into.0, into.1, &mut workspace, &mut found)
            })?;
            if (a, b) != expected {
                return Err(Stop::Rejected);
            }
        }
    )*};
}

fn program(out: &mut dyn Write, _: Options) -> Result<(), Stop> {
    let mut counts = Counts::new(out);
    let disc = Matrix3::from_diagonal(&Vector3::new(0.2, 0.1, 0.1));
    let device = Dgvscmg::bare_wheel(4.0, disc);
    count! { counts, device,
        dgvscmg_1 1;
        dgvscmg_4 4;
    }
    counts.end()
}
