//! Laws in closed loop with a rigid body: Lyapunov's functions, and exact solutions of sampled loops.

mod lyapunov;
mod random;
