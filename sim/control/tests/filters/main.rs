//! Filters: coefficients, states and outputs against those of `SciPy`, and frequency responses against the analog ones.

mod response;
mod scipy;
