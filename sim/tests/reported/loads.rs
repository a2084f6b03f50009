//! Loads about stated points, in stated axes, and what an evaluation says of them.
