//! Requirements without data: neither met nor violated.
