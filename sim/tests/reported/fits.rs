//! Fits of wheel measurements: what is not explained or not determined.
