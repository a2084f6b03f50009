//! Files that commands write, what they print, and how they end.
