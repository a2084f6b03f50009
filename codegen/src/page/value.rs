//! What an expression of a page stands for: a scalar, or a vector or tensor along `Gi` axes.

use crate::graph::{Expr, Graph};

/// A value; vectors and tensors are held by their components along the inner gimbal's axes.
#[derive(Clone, Copy, Debug)]
pub enum Value<'g> {
    /// One number.
    Scalar(Expr<'g>),
    /// Components along `s_x`, `s_y`, `g_z`.
    Vector([Expr<'g>; 3]),
    /// Entries along `s_x`, `s_y`, `g_z`.
    Tensor([[Expr<'g>; 3]; 3]),
}

use Value::{Scalar, Tensor, Vector};

impl<'g> Value<'g> {
    /// The primitive vector number `axis`.
    #[must_use]
    pub fn unit(graph: &'g Graph, axis: usize) -> Self {
        Vector(std::array::from_fn(|i| graph.constant(i64::from(i == axis))))
    }

    /// What kind of thing this is, for messages.
    #[must_use]
    pub fn kind(self) -> &'static str {
        match self {
            Scalar(_) => "scalar",
            Vector(_) => "vector",
            Tensor(_) => "tensor",
        }
    }

    /// `self + other`, for two of a kind.
    #[must_use]
    pub fn plus(self, other: Self) -> Option<Self> {
        Some(match (self, other) {
            (Scalar(a), Scalar(b)) => Scalar(a + b),
            (Vector(a), Vector(b)) => Vector(each(|i| a[i] + b[i])),
            (Tensor(a), Tensor(b)) => Tensor(each(|i| each(|j| a[i][j] + b[i][j]))),
            _ => return None,
        })
    }

    /// `-self`.
    #[must_use]
    pub fn negated(self) -> Self {
        match self {
            Scalar(a) => Scalar(-a),
            Vector(a) => Vector(a.map(|e| -e)),
            Tensor(a) => Tensor(a.map(|row| row.map(|e| -e))),
        }
    }

    /// `self * other`: with a scalar, tensor times vector, tensor times tensor.
    pub(super) fn times(self, other: Self) -> Option<Self> {
        Some(match (self, other) {
            (Scalar(a), Scalar(b)) => Scalar(a * b),
            (Scalar(a), Vector(v)) | (Vector(v), Scalar(a)) => Vector(v.map(|e| a * e)),
            (Scalar(a), Tensor(t)) | (Tensor(t), Scalar(a)) => {
                Tensor(t.map(|row| row.map(|e| a * e)))
            }
            (Tensor(t), Vector(v)) => Vector(t.map(|row| inner(row, v))),
            (Tensor(s), Tensor(t)) => Tensor(each(|i| each(|j| inner(s[i], each(|k| t[k][j]))))),
            _ => return None,
        })
    }

    /// A scalar or vector function of one or two values by name; `None` when the kinds do not fit.
    pub(super) fn call(name: &str, arguments: &[Self]) -> Option<Self> {
        Some(match (name, arguments) {
            ("sq", [Scalar(a)]) => Scalar(a.squared()),
            ("dot", [Vector(a), Vector(b)]) => Scalar(inner(*a, *b)),
            ("cross", [Vector(a), Vector(b)]) => Vector(cross(*a, *b)),
            ("tilde", [Vector([x, y, z])]) => {
                let zero = x.graph().zero();
                Tensor([[zero, -*z, *y], [*z, zero, -*x], [-*y, *x, zero]])
            }
            ("outer", [Vector(a), Vector(b)]) => Tensor(each(|i| each(|j| a[i] * b[j]))),
            ("transpose", [Tensor(t)]) => Tensor(each(|i| each(|j| t[j][i]))),
            _ => return None,
        })
    }

    /// The tensor with these entries along three unit vectors: `sum t_ij e_i e_j^T`.
    #[must_use]
    pub fn along(axes: [[Expr<'g>; 3]; 3], entries: [[Expr<'g>; 3]; 3]) -> Self {
        let zero = entries[0][0].graph().zero();
        Tensor(each(|a| {
            each(|b| {
                let mut sum = zero;
                for (i, row) in entries.iter().enumerate() {
                    for (j, entry) in row.iter().enumerate() {
                        sum = sum + *entry * (axes[i][a] * axes[j][b]);
                    }
                }
                sum
            })
        }))
    }
}

pub(super) fn inner<'g>(a: [Expr<'g>; 3], b: [Expr<'g>; 3]) -> Expr<'g> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<'g>(a: [Expr<'g>; 3], b: [Expr<'g>; 3]) -> [Expr<'g>; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn each<T>(make: impl FnMut(usize) -> T) -> [T; 3] {
    std::array::from_fn(make)
}
