//! Eigenvalues of a real square matrix: balanced, reduced to Hessenberg form, then by the QR algorithm with double shifts.
//!
//! Golub, Van Loan, *Matrix Computations*, 4th edition, 7.5, with exceptional shifts as LAPACK's `dlahqr` after each ten sweeps
//! without an eigenvalue. (nalgebra 0.35 has none: of loops with equal axes its Schur form does not converge.)

use alloc::vec::Vec;

use nalgebra::{Complex, DMatrix, Hessenberg};

use crate::linear::held::balanced;
use crate::model::error::ControlError;

/// Sweeps for one eigenvalue: two or three are usual. LAPACK has as many.
const SWEEPS: u32 = 300;
/// Sweeps after which an element is small beside the whole matrix, not only beside its neighbours: of many eigenvalues at zero, as
/// of commands that wait, these are rounding themselves.
const PATIENCE: u32 = 20;

/// In no stated order; those that are a pair are conjugate to the last bit.
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, ControlError> {
    let mut found = Vec::with_capacity(matrix.nrows());
    if matrix.is_empty() {
        return Ok(found);
    }
    let (h, _) = balanced(matrix);
    let mut h = if h.nrows() > 2 { Hessenberg::new(h).unpack_h() } else { h };
    let norm = h.amax();
    let mut sweeps = 0_u32;
    let mut size = h.nrows();
    while let Some(end) = size.checked_sub(1) {
        let least = if sweeps < PATIENCE { 0.0 } else { f64::EPSILON * norm };
        let start = deflated(&mut h, end, (norm, least));
        if start == end {
            found.push(Complex::new(h[(end, end)], 0.0));
            (size, sweeps) = (end, 0);
            continue;
        }
        let last = end.saturating_sub(1);
        let (x, y) = (h[(end, end)], h[(last, last)]);
        let product = h[(end, last)] * h[(last, end)];
        if start == last {
            found.extend(pair(x, y, product));
            (size, sweeps) = (last, 0);
            continue;
        }
        if sweeps == SWEEPS {
            return Err(ControlError::NotConverged { what: "eigenvalues" });
        }
        sweeps = sweeps.saturating_add(1);
        let shifts = if sweeps.is_multiple_of(10) {
            exceptional(&h, (start, end), sweeps)
        } else {
            (x, y, product)
        };
        sweep(&mut h, (start, end), shifts);
    }
    Ok(found)
}

/// Shifts of a sweep among many without an eigenvalue, by turns at the block's start and at its end: as far from the diagonal as
/// the elements below it are large, then as eigenvalues of a chain are apart, whose elements above are the larger ones.
fn exceptional(h: &DMatrix<f64>, (start, end): (usize, usize), sweeps: u32) -> (f64, f64, f64) {
    let turn = sweeps / 10;
    let (corner, rows) = if turn.is_multiple_of(2) {
        (end, [end, end.saturating_sub(1)])
    } else {
        (start, [start.saturating_add(1), start.saturating_add(2)])
    };
    let sizes = rows.map(|row| {
        let above = row.saturating_sub(1);
        let below = libm::fabs(h[(row, above)]);
        if turn % 4 < 2 { below } else { libm::sqrt(below * libm::fabs(h[(above, row)])) }
    });
    let size = sizes[0] + sizes[1];
    let centre = h[(corner, corner)] + 0.75 * size;
    (centre, centre, -0.4375 * size * size)
}

/// Sets an element below the diagonal to zero that is small beside its neighbours, or no larger than `least`; where the block that ends at `end` starts.
fn deflated(h: &mut DMatrix<f64>, end: usize, (norm, least): (f64, f64)) -> usize {
    for row in (1..=end).rev() {
        let above = row.saturating_sub(1);
        let beside = libm::fabs(h[(above, above)]) + libm::fabs(h[(row, row)]);
        let beside = if beside == 0.0 { norm } else { beside };
        if libm::fabs(h[(row, above)]) <= libm::fmax(f64::EPSILON * beside, least) {
            h[(row, above)] = 0.0;
            return row;
        }
    }
    0
}

/// Of a block of two, with the product of its elements off the diagonal.
fn pair(x: f64, y: f64, product: f64) -> [Complex<f64>; 2] {
    let half = 0.5 * (y - x);
    let square = half * half + product;
    let root = libm::sqrt(libm::fabs(square));
    if square >= 0.0 {
        let larger = half + libm::copysign(root, half);
        let first = x + larger;
        let second = if larger == 0.0 { first } else { x - product / larger };
        [Complex::new(first, 0.0), Complex::new(second, 0.0)]
    } else {
        [Complex::new(x + half, root), Complex::new(x + half, -root)]
    }
}

/// One implicit step with two shifts, given by their trace and determinant as `(x, y, product)`, on rows `start` to `end`.
fn sweep(h: &mut DMatrix<f64>, (start, end): (usize, usize), (x, y, product): (f64, f64, f64)) {
    let first = |k: usize, h: &DMatrix<f64>| {
        let z = h[(k, k)];
        let (r, s) = (x - z, y - z);
        let (below, next) = (h[(k + 1, k)], h[(k + 2, k + 1)]);
        [(r * s - product) / below + h[(k, k + 1)], h[(k + 1, k + 1)] - z - r - s, next]
    };
    // Two small elements below the diagonal end the block as one that is zero does.
    let mut from = end.saturating_sub(2);
    loop {
        let [p, q, r] = first(from, h).map(libm::fabs);
        if from == start {
            break;
        }
        let above = from.saturating_sub(1);
        let (own, before, after) = (h[(from, from)], h[(above, above)], h[(from + 1, from + 1)]);
        let scale = p * (libm::fabs(before) + libm::fabs(own) + libm::fabs(after));
        if libm::fabs(h[(from, above)]) * (q + r) <= f64::EPSILON * scale {
            break;
        }
        from = above;
    }
    for row in from + 2..=end {
        h[(row, row - 2)] = 0.0;
        if row > from + 2 {
            h[(row, row - 3)] = 0.0;
        }
    }
    for k in from..end {
        let three = k + 1 < end;
        let v = if k == from {
            first(k, h)
        } else {
            [h[(k, k - 1)], h[(k + 1, k - 1)], if three { h[(k + 2, k - 1)] } else { 0.0 }]
        };
        let scale = v.iter().map(|part| libm::fabs(*part)).sum::<f64>();
        if scale == 0.0 {
            continue;
        }
        let [p, q, r] = v.map(|part| part / scale);
        let length = libm::copysign(libm::sqrt(p * p + q * q + r * r), p);
        if k != from {
            h[(k, k - 1)] = -length * scale;
        } else if from != start {
            h[(k, k - 1)] = -h[(k, k - 1)];
        }
        reflect(h, (k, end, three), [p, q, r], length);
    }
}

/// The Householder reflection of `(p, q, r)` onto its first axis, from both sides.
fn reflect(
    h: &mut DMatrix<f64>,
    (k, end, three): (usize, usize, bool),
    [p, q, r]: [f64; 3],
    length: f64,
) {
    let p = p + length;
    let (x, y, z) = (p / length, q / length, r / length);
    let (q, r) = (q / p, r / p);
    for column in k..=end {
        let mut along = h[(k, column)] + q * h[(k + 1, column)];
        if three {
            along += r * h[(k + 2, column)];
            h[(k + 2, column)] -= along * z;
        }
        h[(k + 1, column)] -= along * y;
        h[(k, column)] -= along * x;
    }
    for row in 0..=end.min(k + 3) {
        let mut along = x * h[(row, k)] + y * h[(row, k + 1)];
        if three {
            along += z * h[(row, k + 2)];
            h[(row, k + 2)] -= along * r;
        }
        h[(row, k + 1)] -= along * q;
        h[(row, k)] -= along;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of a few sweeps, simple eigenvalues.
    const SIMPLE: f64 = 1e-13;

    /// The companion matrix of a polynomial with these roots and their conjugates.
    fn companion(roots: &[Complex<f64>]) -> DMatrix<f64> {
        let mut polynomial = std::vec![Complex::new(1.0, 0.0)];
        for root in roots {
            let mut next = polynomial.clone();
            next.push(Complex::new(0.0, 0.0));
            for (to, from) in next.iter_mut().skip(1).zip(&polynomial) {
                *to -= root * from;
            }
            polynomial = next;
        }
        let n = roots.len();
        DMatrix::from_fn(n, n, |row, column| match (row, column) {
            (0, column) => -polynomial[column + 1].re,
            (row, column) => f64::from(u8::from(row == column + 1)),
        })
    }

    fn worst(roots: &[Complex<f64>], found: &[Complex<f64>]) -> f64 {
        assert_eq!(roots.len(), found.len());
        let distance = |root: &Complex<f64>| {
            found.iter().map(|of| (of - root).norm_sqr().sqrt()).fold(f64::INFINITY, f64::min)
        };
        roots.iter().map(distance).fold(0.0, f64::max)
    }

    #[test]
    fn roots_of_polynomials_are_found() {
        let complex = Complex::new;
        let roots = [
            complex(0.9, 0.3),
            complex(0.9, -0.3),
            complex(-0.5, 0.0),
            complex(0.2, 0.7),
            complex(0.2, -0.7),
            complex(1.5, 0.0),
            complex(0.01, 0.0),
        ];
        for count in [1, 2, 3, 5, 6, 7] {
            let of = if count == 1 { &roots[2..3] } else { &roots[..count] };
            let found = eigenvalues(&companion(of)).expect("converges");
            assert!(worst(of, &found) < SIMPLE, "{found:?}");
        }
        // One shift has no effect: the exceptional ones are needed.
        let cyclic: [_; 4] =
            [complex(1.0, 0.0), complex(0.0, 1.0), complex(-1.0, 0.0), complex(0.0, -1.0)];
        let found = eigenvalues(&companion(&cyclic)).expect("converges");
        assert!(worst(&cyclic, &found) < SIMPLE);
    }

    /// Blocks of equal eigenvalues; a chain of four ones is found to the fourth root of rounding.
    #[test]
    fn equal_eigenvalues_converge() {
        let ones = [Complex::new(1.0, 0.0); 4];
        let found = eigenvalues(&companion(&ones)).expect("converges");
        assert!(worst(&ones, &found) < 1e-3);
        let block = companion(&[Complex::new(0.3, 0.4), Complex::new(0.3, -0.4)]);
        let mut three = DMatrix::zeros(6, 6);
        for number in 0..3 {
            three.view_mut((2 * number, 2 * number), (2, 2)).copy_from(&block);
        }
        let mixed = DMatrix::from_fn(6, 6, |row, column| {
            f64::from(u8::from(row == column))
                + 0.1 * f64::from(u8::try_from(row * column % 5).expect("small"))
        });
        let inverse = mixed.clone().try_inverse().expect("regular");
        for element in eigenvalues(&(&mixed * three * inverse)).expect("converges") {
            assert!((element.re - 0.3).abs() < SIMPLE && (element.im.abs() - 0.4).abs() < SIMPLE);
        }
        assert_eq!(
            eigenvalues(&DMatrix::zeros(5, 5)).expect("converges"),
            [Complex::new(0.0, 0.0); 5]
        );
    }

    /// Where sixty sweeps with EISPACK's shifts ended, in the loop of four gyros: commands that wait.
    #[test]
    fn a_block_of_waiting_commands_converges() {
        let rows = [
            [
                5.154_023_689_902_691_6e-5,
                1.616_814_243_421_939_5e-4,
                -0.590_045_582_586_545,
                -0.025_632_158_888_204_193,
            ],
            [
                -5.024_703_614_498_882e-8,
                5.300_534_076_095_114e-5,
                0.051_850_615_852_135_99,
                -0.575_898_395_565_054_4,
            ],
            [0.0, 4.337_378_144_060_083e-11, 6.700_805_125_602_642e-5, -1.573_810_091_634_119e-4],
            [0.0, 0.0, 1.503_890_149_151_506e-6, 3.677_709_503_050_468e-5],
        ];
        let block = DMatrix::from_fn(4, 4, |row, column| rows[row][column]);
        let found = eigenvalues(&block).expect("converges");
        let sum: f64 = found.iter().map(|of| of.re).sum();
        assert!((sum - block.trace()).abs() < 1e-15, "{sum} {}", block.trace());
        let product: Complex<f64> = found.iter().product();
        assert!((product.re - block.determinant()).abs() < 1e-4 * product.re.abs(), "{found:?}");
    }
}
