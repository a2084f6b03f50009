//! Calls the solver a number of times: what `cargo xtask instructions` runs under callgrind.
//!
//! ```sh
//! instructions list                    # the cases, one a line
//! instructions accelerations/4 1000    # a thousand calls
//! ```

use std::cell::RefCell;
use std::hint::black_box;
use std::process::ExitCode;

use nalgebra::Vector3;
use precess_dynamics::set::WithNumbers;
use precess_dynamics::{
    Angle, Dgvscmg, Outputs, Servo, Spacecraft, Steered, SteeringLaw, SteeringTerms,
};
#[cfg(feature = "every-set")]
use precess_dynamics::{BuiltIn, kind::Kind};
#[cfg(feature = "every-set")]
use precess_tests::measured::{EachKind, each_kind};
use precess_tests::measured::{Measured, dgvscmg, hub, imbalance_of};
use precess_tracker::{DragSample, DragTracker, LineTracker};

/// What is commanded of four DGVSCMGs.
const STEERED: [Steered; 12] = {
    let (rate, acceleration) = (Steered::Rate, Steered::Acceleration);
    [
        rate,
        rate,
        acceleration,
        rate,
        rate,
        acceleration,
        rate,
        rate,
        acceleration,
        rate,
        rate,
        acceleration,
    ]
};

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
        #[cfg(feature = "every-set")]
        self.cases("1", &[dgvscmg(); 1]);
        self.cases("4", &[dgvscmg(); 4]);
        #[cfg(feature = "every-set")]
        self.cases("16", &[dgvscmg(); 16]);
        #[cfg(feature = "every-set")]
        self.products("1", &[dgvscmg(); 1]);
        self.products("4", &[dgvscmg(); 4]);
        #[cfg(feature = "every-set")]
        self.products("16", &[dgvscmg(); 16]);
        #[cfg(feature = "every-set")]
        self.allocated("1", &[dgvscmg(); 1]);
        self.allocated("4", &[dgvscmg(); 4]);
        #[cfg(feature = "every-set")]
        self.allocated("16", &[dgvscmg(); 16]);
        #[cfg(feature = "every-set")]
        {
            self.cases("list of 4", &vec![BuiltIn::from(dgvscmg()); 4]);
            each_kind(self);
        }
        self.steering();
        self.trackers();
    }

    /// A sample of a rotor's line and of its drag, and what is estimated from the samples.
    fn trackers(&mut self) {
        let line = || {
            let mut tracker = LineTracker::new(100.0).ok()?;
            (0..200).map(f64::from).try_for_each(|k| tracker.update(2.1 * k, 1.0, k)).ok()?;
            Some(tracker)
        };
        let sample = DragSample { elapsed: 0.01, torque: 0.01, drag: 4e-3, rate: 300.0 };
        let drag = move || {
            let mut tracker = DragTracker::new(0.02, 100.0).ok()?;
            (0..200).try_for_each(|_| tracker.update(&sample)).ok()?;
            Some(tracker)
        };
        self.case("line_tracker update", || {
            let tracker = RefCell::new(line());
            move || {
                if let Some(tracker) = tracker.borrow_mut().as_mut() {
                    let _ = black_box(tracker.update(black_box(1.25), 1.0, black_box(0.3)));
                }
            }
        });
        self.case("line_tracker estimate", || {
            let tracker = line();
            move || {
                let _ = black_box(black_box(&tracker).as_ref().and_then(LineTracker::estimate));
            }
        });
        self.case("drag_tracker update", || {
            let tracker = RefCell::new(drag());
            move || {
                if let Some(tracker) = tracker.borrow_mut().as_mut() {
                    let _ = black_box(tracker.update(black_box(&sample)));
                }
            }
        });
        self.case("drag_tracker estimate", || {
            let tracker = drag();
            move || {
                let _ = black_box(black_box(&tracker).as_ref().and_then(DragTracker::estimate));
            }
        });
    }

    /// From a torque to motor torques of four DGVSCMGs: the terms, the allocation, and the servo.
    fn steering(&mut self) {
        let measured = || Measured::new(&[dgvscmg(); 4]);
        let terms = |measured: &Measured<[Dgvscmg; 4]>| -> Option<SteeringTerms<f64, 12>> {
            measured.craft.steering_terms(black_box(&measured.state)).ok()
        };
        let steered = STEERED;
        self.case("steering_terms/4", || {
            let measured = measured();
            move || {
                let _ = black_box(terms(&measured));
            }
        });
        self.case("allocate/4", || {
            let matrix = terms(&measured()).map(|terms| terms.matrix(&steered));
            move || {
                let torque = Vector3::new(0.3, -0.2, 0.1);
                let law = SteeringLaw::exact();
                let found = matrix.as_ref().map(|of| law.allocate(black_box(of), &torque));
                let _ = black_box(found);
            }
        });
        self.case("servo/4", || {
            let Measured { craft, state, inputs } = measured();
            let servo = Servo { steered, gains: [20.0; 12], limits: [f64::INFINITY; 12] };
            move || {
                let commands = black_box([0.1; 12]);
                let _ = black_box(craft.servo(&servo, &state, &inputs, &commands, &[0.0; 12]));
            }
        });
    }

    /// Matrices that are allocated, and a step with its derivatives.
    fn allocated<D: WithNumbers<Scalar = f64>>(&mut self, name: &str, devices: &D) {
        self.case(&format!("linearize/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            move || {
                let (state, inputs) = (black_box(&state), black_box(&inputs));
                let _ = black_box(craft.linearize(state, inputs, &Outputs::accelerations()));
            }
        });
        self.case(&format!("parameter_derivatives/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            let count = craft.joints().last().map_or(0, |(device, _)| device + 1);
            move || {
                let by = (0..count).flat_map(imbalance_of);
                let (at, none) =
                    ((black_box(&state), black_box(&inputs)), Outputs::accelerations());
                let column = |_, column: &_| {
                    black_box(column);
                };
                let _ = black_box(Spacecraft::parameter_derivatives(
                    &hub(),
                    devices,
                    at,
                    &none,
                    by,
                    column,
                ));
            }
        });
        self.case(&format!("linearize_step/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            move || {
                let (state, inputs) = (black_box(&state), black_box(&inputs));
                let _ = black_box(craft.linearize_step(state, inputs, STEP));
            }
        });
        self.case(&format!("linearize_step_into/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            let kept = RefCell::new(craft.linearize_step(&state, &inputs, STEP).ok());
            move || {
                if let Some(kept) = kept.borrow_mut().as_mut() {
                    let (state, inputs) = (black_box(&state), black_box(&inputs));
                    let _ = black_box(craft.linearize_step_into(state, inputs, STEP, kept));
                }
            }
        });
    }

    fn cases<D: WithNumbers<Scalar = f64>>(&mut self, name: &str, devices: &D) {
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
        self.case(&format!("linearize_into/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            let outputs = Outputs::accelerations();
            let kept = RefCell::new(craft.linearize(&state, &inputs, &outputs).ok());
            move || {
                if let Some(kept) = kept.borrow_mut().as_mut() {
                    let (state, inputs) = (black_box(&state), black_box(&inputs));
                    let _ = black_box(craft.linearize_into(state, inputs, &outputs, kept));
                }
            }
        });
    }

    /// Derivatives of the accelerations only, and their products with a direction and with weights.
    fn products<D: WithNumbers<Scalar = f64>>(&mut self, name: &str, devices: &D) {
        self.case(&format!("acceleration_derivatives_into/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            let kept = RefCell::new(craft.acceleration_derivatives(&state, &inputs).ok());
            move || {
                if let Some(kept) = kept.borrow_mut().as_mut() {
                    let (state, inputs) = (black_box(&state), black_box(&inputs));
                    let _ = black_box(craft.acceleration_derivatives_into(state, inputs, kept));
                }
            }
        });
        self.case(&format!("jvp/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            let of_state = vec![0.25; craft.state_variables(&inputs).count()];
            let of_inputs = vec![0.5; craft.input_variables(&inputs).count()];
            move || {
                let direction = (black_box(of_state.as_slice()), of_inputs.as_slice());
                let _ = black_box(craft.jvp(black_box(&state), black_box(&inputs), direction));
            }
        });
        self.case(&format!("vjp/{name}"), || {
            let Measured { craft, state, inputs } = Measured::new(devices);
            let weights = craft.accelerations(&state, &inputs).ok();
            let by_states = vec![0.0; craft.state_variables(&inputs).count()];
            let by_inputs = vec![0.0; craft.input_variables(&inputs).count()];
            let gradient = RefCell::new((by_states, by_inputs));
            move || {
                if let Some(weights) = &weights {
                    let mut gradient = gradient.borrow_mut();
                    let (by_states, by_inputs) = &mut *gradient;
                    let (state, inputs) = (black_box(&state), black_box(&inputs));
                    let _ = black_box(craft.vjp(state, inputs, weights, (by_states, by_inputs)));
                }
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

#[cfg(feature = "every-set")]
impl EachKind<f64> for Cases {
    fn visit<K: Kind<Scalar = f64>>(&mut self, name: &'static str, device: K) {
        // The paper's device is listed by its number already.
        if name != "dgvscmg" {
            self.cases(name, &[device]);
        }
    }
}
