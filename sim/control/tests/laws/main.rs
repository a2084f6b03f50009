//! Laws in closed loop with a rigid body: Lyapunov's functions, and exact solutions of sampled loops.

mod basilisk;
mod dumping;
mod eigen_axis;
mod lyapunov;
mod lyapunov_of_quaternions;
mod random;
mod rigid_body;
mod sampled_loop;
mod wheels;
