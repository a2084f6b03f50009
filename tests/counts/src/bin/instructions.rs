//! Calls the solver a number of times: what `cargo xtask instructions` runs under callgrind.
//!
//! ```sh
//! instructions list                    # the cases, one a line
//! instructions accelerations/4 1000    # a thousand calls
//! ```

use std::hint::black_box;
use std::process::ExitCode;

use precess_dynamics::kind::Kind;
use precess_dynamics::{Angle, BuiltIn, Devices};
use precess_tests::measured::{EachKind, Measured, dgvscmg, each_kind};

/// Step of the integrator, s.
const STEP: f64 = 1e-3;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut cases = Cases { wanted: None, found: false };
    match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["list"] => {}
        [name, calls] => match calls.parse() {
            Ok(calls) => cases.wanted = Some(((*name).to_owned(), calls)),
            Err(error) => return rejected(&format!("`{calls}` calls: {error}")),
        },
        _ => return rejected("usage: instructions list | instructions CASE CALLS"),
    }
    cases.all();
    match &cases.wanted {
        Some((name, _)) if !cases.found => rejected(&format!("no case is called `{name}`")),
        _ => ExitCode::SUCCESS,
    }
}

fn rejected(why: &str) -> ExitCode {
    eprintln!("error: {why}");
    ExitCode::FAILURE
}

/// Lists the cases, or runs one of them.
struct Cases {
    wanted: Option<(String, u32)>,
    found: bool,
}

impl Cases {
    fn all(&mut self) {
        self.case("sin_cos", || {
            || {
                black_box(Angle::sin_cos(black_box(1.25)));
            }
        });
        self.cases("1", &[dgvscmg(); 1]);
        self.cases("4", &[dgvscmg(); 4]);
        self.cases("16", &[dgvscmg(); 16]);
        self.cases("list of 4", &vec![BuiltIn::from(dgvscmg()); 4]);
        each_kind(self);
    }

    fn cases<D: Devices<Scalar = f64>>(&mut self, name: &str, devices: &D) {
        self.case(&format!("accelerations/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            move || {
                let _ = black_box(craft.accelerations(black_box(&state), black_box(&inputs)));
            }
        });
        self.case(&format!("step/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            move || {
                let _ = black_box(craft.step(black_box(&state), black_box(&inputs), STEP));
            }
        });
    }

    /// Tells the name, or runs the case if it is the one that is wanted.
    fn case<F: Fn()>(&mut self, name: &str, call: impl FnOnce() -> F) {
        match &self.wanted {
            None => println!("{name}"),
            Some((wanted, calls)) if wanted == name => {
                let call = call();
                (0..*calls).for_each(|_| call());
                self.found = true;
            }
            Some(_) => {}
        }
    }
}

impl EachKind<f64> for Cases {
    fn visit<K: Kind<Scalar = f64>>(&mut self, name: &'static str, device: K) {
        // The paper's device is listed by its number already.
        if name != "dgvscmg" {
            self.cases(name, &[device]);
        }
    }
}
