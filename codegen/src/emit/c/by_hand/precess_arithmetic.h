/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * Vectors, symmetric tensors and roots, in the order of operations of the Rust library.
 *
 * A symmetric tensor is given by its entries 11, 12, 13, 22, 23, 33. `out` is none of the other
 * arguments. No pointer may be null.
 */

#ifndef PRECESS_ARITHMETIC_H
#define PRECESS_ARITHMETIC_H

#include "precess_hub.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A matrix by its columns. Of a rotation: the new axes in the old frame. */
struct precess_matrix {
    /** Column by column: columns[column][row]. */
    double columns[3][3];
};

/** `a . b`. */
double precess_dot(const double a[3], const double b[3]);

/** `m v`: components in the old frame of a vector expressed in the columns. */
void precess_rotate(const struct precess_matrix *m, const double v[3], double out[3]);

/** `m^T v`: components in the columns of a vector expressed in the old frame. */
void precess_rotate_transposed(const struct precess_matrix *m, const double v[3], double out[3]);

/** `m^T`. */
void precess_transpose(const struct precess_matrix *m, struct precess_matrix *out);

/** A symmetric tensor applied to a vector. */
void precess_tensor_times(const double s[6], const double v[3], double out[3]);

/** `m s m^T`: components in the old frame of a tensor expressed in the columns of `m`. */
void precess_tensor_rotated(const double s[6], const struct precess_matrix *m, double out[6]);

/** `a += b`. */
void precess_tensor_add(double a[6], const double b[6]);

/** Magnitude; NaN stays NaN. */
double precess_magnitude(double x);

/** The larger of two numbers; `a` if either is NaN. */
double precess_larger(double a, double b);

/** Whether a number is neither infinite nor NaN. */
int precess_is_finite(double x);

/** Whether all of them are. */
int precess_are_finite(const double *numbers, int count);

/** Square root, correctly rounded; NaN of a negative number. */
double precess_square_root(double x);

/**
 * The reciprocal of a magnitude, in two factors to be multiplied by one after the other: the first
 * is a power of two, so that neither factor overflows or is subnormal for any finite magnitude but
 * zero.
 */
void precess_reciprocal_in_two(double magnitude, double *first, double *second);

#ifdef __cplusplus
}
#endif

#endif
