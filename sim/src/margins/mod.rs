//! The loop of a controller in the frequency domain: a scenario's spacecraft about rest, averaged over the turns of its rotors, the
//! law, the division among joints and the servo of a [`SampledController`](crate::scenario::SampledController), exactly discretised
//! with hold and delay.
//!
//! ```text
//! M x'' + C x' + K x = E u + F      x = [theta; modes; free joints]      (the translation is eliminated)
//! u_k = S x_k + N c_k      c_k = P tau_k + R x_k      tau = filters(law(r)) at the samples
//! r = filters(estimator(sensors(theta, omega)))      (as they are without sensors)
//! L = -K_law(z) G(z), from torque to torque, three axes of B      S = (1 + L)^-1      T = 1 - S
//! ```
//!
//! `M`, `C`, `K` are the means over the turns of the rotors, as [`jitter`](crate::jitter) has them; commanded joints are free, and
//! `E u` are the torques of their motors, held as a run holds them. The servo (`S`, `N`) is the evaluation with prescribed
//! accelerations of the same equations. With a rate of its own it computes several times in a period: the same recursion, with
//! these times in it. The loop is open at the torque of the law: what its margins say is what a factor or a delay of that
//! torque does.
//!
//! | what | module |
//! |---|---|
//! | equations of motion, servo, what loads do | [`plant`] |
//! | from sample to sample | [`sampled`] |
//! | sensors, estimator, filters | [`measurement`] |
//! | the law | [`feedback`] |
//! | what is taken otherwise than in a run | [`notes`] |
//! | margins, curves, poles | [`analysis`] |
//! | requirements on margins | [`requirements`] |
//! | lines of rotors through the loop, and their aliases | [`lines`] |
//! | the lines of a jitter budget with the loop closed | [`closed_sweep`] |
//! | noise of sources and sensors in a jitter budget with the loop closed | [`closed_noise`] |
//! | noise of what is measured | [`noise`] |

pub mod analysis;
pub mod closed_noise;
pub mod closed_sweep;
mod error;
pub mod feedback;
pub mod lines;
pub mod measurement;
mod moving;
pub mod noise;
pub mod notes;
pub mod plant;
pub mod requirements;
mod response;
pub mod sampled;
mod through;

pub use error::MarginsError;
