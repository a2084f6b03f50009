//! References: slews within their limits and in the least time, and rates of every reference against differences.

mod differences;
mod slews;
