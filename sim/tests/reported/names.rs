//! Names, and the files named after them.
