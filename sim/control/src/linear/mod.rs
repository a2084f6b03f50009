//! The linear loop: a [`SampledPlant`] behind hold and delay, a [`Feedback`], and what the [`SampledLoop`] of both is worth.

pub(crate) mod curve;
mod eigenvalues;
pub(crate) mod feedback;
mod frequencies;
pub(crate) mod held;
pub(crate) mod margins;
pub(crate) mod plant;
mod resolvent;
pub(crate) mod sampled_loop;
#[cfg(test)]
mod tests;
