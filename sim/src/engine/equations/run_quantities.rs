//! [`RunQuantities`]: what a run computes beside its motion.

/// What a run computes beside the motion and its samples. Motion and samples are the same, to the bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RunQuantities {
    /// Work of all sources, drift of what is conserved, the largest rate of each joint.
    #[default]
    All,
    /// None of these, which take as long as two of the four evaluations of a step of RK4. DOP853
    /// integrates the work with the motion nevertheless: its steps depend on it.
    Motion,
}
