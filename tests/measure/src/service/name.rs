//! The services by name: what each is, and what is comparable with it.

use clap::ValueEnum;
use serde_json::{Value, json};

use crate::floor;

/// The services of this build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Name {
    /// One state, one evaluation after another, by a solver built without `lanes`
    #[cfg(not(feature = "lanes"))]
    Portable,
    /// One state, one evaluation after another, with `lanes`: by instructions chosen at run time
    #[cfg(feature = "lanes")]
    Dispatched,
    /// One state, the devices in a list of any kinds
    #[cfg(feature = "lanes")]
    List,
    /// Many states of one spacecraft in lanes
    #[cfg(feature = "lanes")]
    Batch,
    /// Many spacecraft of one shape in lanes, each in its state
    #[cfg(feature = "lanes")]
    Parameters,
    /// Many states of one spacecraft in lanes, on several threads
    #[cfg(feature = "lanes")]
    Threads,
    /// Steps of one state
    #[cfg(feature = "lanes")]
    Step,
    /// Steps of one state, the devices in a list of any kinds
    #[cfg(feature = "lanes")]
    StepList,
    /// Steps of many states of one spacecraft
    #[cfg(feature = "lanes")]
    Steps,
    /// Steps of many spacecraft of one shape
    #[cfg(feature = "lanes")]
    StepsParameters,
    /// Steps of many states of one spacecraft, on several threads
    #[cfg(feature = "lanes")]
    StepsThreads,
    /// The imaging satellite by the kernels of its kind
    General,
    /// The imaging satellite by kernels of its own
    #[cfg(feature = "lanes")]
    Baked,
    /// Four wheels on a rigid hub, on bearings, on a platform, on a flexible structure
    #[cfg(feature = "lanes")]
    Flexible,
    /// One evaluation, what derivatives of accelerations are compared with
    #[cfg(feature = "lanes")]
    Evaluation,
    /// Derivatives of accelerations by the same variables, over dual numbers
    #[cfg(feature = "lanes")]
    Derivatives,
    /// Accelerations linearised about a state and inputs
    #[cfg(feature = "lanes")]
    Linearized,
    /// The same into matrices that are kept
    #[cfg(feature = "lanes")]
    LinearizedInto,
    /// Derivatives of the accelerations, and nothing else, into matrices that are kept
    #[cfg(feature = "lanes")]
    AccelerationDerivatives,
    /// The derivative of the accelerations along a direction
    #[cfg(feature = "lanes")]
    Jvp,
    /// The gradient of a weighted sum of the accelerations
    #[cfg(feature = "lanes")]
    Vjp,
    /// Central differences of accelerations by the same variables
    #[cfg(feature = "lanes")]
    Differences,
    /// Accelerations by parameters of the devices
    #[cfg(feature = "lanes")]
    ByParameters,
    /// One step, what derivatives of a step are compared with
    #[cfg(feature = "lanes")]
    SingleStep,
    /// A step linearised about a state and inputs
    #[cfg(feature = "lanes")]
    LinearizedStep,
    /// The same into matrices that are kept
    #[cfg(feature = "lanes")]
    LinearizedStepInto,
}

impl Name {
    /// Title, subject (who is compared with whom), the row of the issue floor that bounds it, and how
    /// many threads it runs on; none of a service that this machine cannot run.
    pub(crate) fn description(self) -> Option<Value> {
        let (title, subject, floor, threads) = match self {
            #[cfg(not(feature = "lanes"))]
            Self::Portable => ("one state, portable", "evaluation", Some(floor::ONE), 1),
            #[cfg(not(feature = "lanes"))]
            Self::General => ("general kernels, portable", "baked", None, 1),
            #[cfg(feature = "lanes")]
            _ => self.with_lanes()?,
        };
        let name = self.to_possible_value()?.get_name().to_owned();
        let title =
            if threads > 1 { format!("{title} on {threads} threads") } else { title.into() };
        Some(json!({
            "name": name, "title": format!("Precess, {title}"), "subject": subject, "floor": floor,
            "threads": threads,
        }))
    }

    #[cfg(feature = "lanes")]
    fn with_lanes(self) -> Option<(&'static str, &'static str, Option<&'static str>, usize)> {
        let (one, widest) = (Some(floor::ONE), Some(floor::widest()));
        // One thread is the service without threads.
        let threads = Some(rayon::current_num_threads()).filter(|threads| *threads > 1);
        Some(match self {
            Self::Dispatched => ("one state, dispatched", "evaluation", one, 1),
            Self::List => ("one state, list of any kinds", "evaluation", one, 1),
            Self::Batch => ("batch", "batch", widest, 1),
            Self::Parameters => ("batch, parameters per lane", "batch", widest, 1),
            Self::Threads => ("batch", "batch", None, threads?),
            Self::Step => ("step, typed", "step", None, 1),
            Self::StepList => ("step, list of any kinds", "step", None, 1),
            Self::Steps => ("steps of a batch", "batch step", None, 1),
            Self::StepsParameters => {
                ("steps of a batch, parameters per lane", "batch step", None, 1)
            }
            Self::StepsThreads => ("steps of a batch", "batch step", None, threads?),
            Self::General => ("general kernels, dispatched", "baked", None, 1),
            Self::Baked => ("baked kernels", "baked", None, 1),
            Self::Flexible => ("one state, dispatched", "flexible", None, 1),
            Self::Evaluation => ("an evaluation", "derivatives", None, 1),
            Self::Derivatives => ("`derivatives`", "derivatives", None, 1),
            Self::Linearized => ("`linearize`", "derivatives", None, 1),
            Self::LinearizedInto => ("`linearize_into`", "derivatives", None, 1),
            Self::AccelerationDerivatives => {
                ("`acceleration_derivatives_into`", "derivatives", None, 1)
            }
            Self::Jvp => ("`jvp`", "derivatives", None, 1),
            Self::Vjp => ("`vjp`", "derivatives", None, 1),
            Self::Differences => ("central differences", "derivatives", None, 1),
            Self::ByParameters => ("`parameter_derivatives`", "derivatives", None, 1),
            Self::SingleStep => ("an RK4 step", "derivatives", None, 1),
            Self::LinearizedStep => ("`linearize_step`", "derivatives", None, 1),
            Self::LinearizedStepInto => ("`linearize_step_into`", "derivatives", None, 1),
        })
    }
}
