/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h.
 */

#include "precess_arithmetic.h"

#include <stdint.h>
#include <string.h>

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

double precess_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void precess_rotate(const struct precess_matrix *m, const double v[3], double out[3])
{
    int k;

    for (k = 0; k < 3; k++) {
        out[k] = m->columns[0][k] * v[0] + m->columns[1][k] * v[1] + m->columns[2][k] * v[2];
    }
}

void precess_rotate_transposed(const struct precess_matrix *m, const double v[3], double out[3])
{
    int k;

    for (k = 0; k < 3; k++) {
        out[k] = precess_dot(m->columns[k], v);
    }
}

void precess_transpose(const struct precess_matrix *m, struct precess_matrix *out)
{
    int i;
    int k;

    for (i = 0; i < 3; i++) {
        for (k = 0; k < 3; k++) {
            out->columns[i][k] = m->columns[k][i];
        }
    }
}

void precess_tensor_times(const double s[6], const double v[3], double out[3])
{
    out[0] = s[0] * v[0] + s[1] * v[1] + s[2] * v[2];
    out[1] = s[1] * v[0] + s[3] * v[1] + s[4] * v[2];
    out[2] = s[2] * v[0] + s[4] * v[1] + s[5] * v[2];
}

void precess_tensor_rotated(const double s[6], const struct precess_matrix *m, double out[6])
{
    const double columns[3][3] = {{s[0], s[1], s[2]}, {s[1], s[3], s[4]}, {s[2], s[4], s[5]}};
    /* m s by its columns, then its rows; rows of m. */
    struct precess_matrix product;
    struct precess_matrix rows;
    struct precess_matrix own;
    int k;

    for (k = 0; k < 3; k++) {
        precess_rotate(m, columns[k], product.columns[k]);
    }
    precess_transpose(&product, &rows);
    precess_transpose(m, &own);
    out[0] = precess_dot(rows.columns[0], own.columns[0]);
    out[1] = precess_dot(rows.columns[0], own.columns[1]);
    out[2] = precess_dot(rows.columns[0], own.columns[2]);
    out[3] = precess_dot(rows.columns[1], own.columns[1]);
    out[4] = precess_dot(rows.columns[1], own.columns[2]);
    out[5] = precess_dot(rows.columns[2], own.columns[2]);
}

void precess_tensor_add(double a[6], const double b[6])
{
    int k;

    for (k = 0; k < 6; k++) {
        a[k] = a[k] + b[k];
    }
}

double precess_magnitude(double x)
{
    return x < 0.0 ? -x : x;
}

double precess_larger(double a, double b)
{
    return b > a ? b : a;
}

int precess_is_finite(double x)
{
    return x - x == 0.0;
}

int precess_are_finite(const double *numbers, int count)
{
    int finite = 1;
    int k;

    for (k = 0; k < count; k++) {
        finite = finite && precess_is_finite(numbers[k]);
    }
    return finite;
}

/* The square root of a number with these bits: normal, positive. Its significand with an even
 * exponent, s 2^52, is between 2^104 and 2^106; the largest integer r with r r <= s 2^52 has 53
 * bits, and the root is r or r + 1, whichever is nearer: a root is never half way. */
static uint64_t root_of_bits(uint64_t bits)
{
    const uint64_t significand = (bits & 0xFFFFFFFFFFFFFu) | 0x10000000000000u;
    const uint64_t exponent = bits >> 52;
    /* The exponent is 1023 + 2 e, or one more. */
    const uint64_t odd = (exponent + 1) & 1;
    const uint64_t s = significand << odd;
    const double target = (double)s * 4503599627370496.0;
    double root;
    uint64_t guess;
    uint64_t r;
    int64_t rest;
    int k;

    /* Newton's method: half the exponent is right to 7 %, each step doubles the digits. */
    memcpy(&guess, &target, sizeof guess);
    guess = (guess >> 1) + ((uint64_t)1023 << 51);
    memcpy(&root, &guess, sizeof root);
    for (k = 0; k < 4; k++) {
        root = 0.5 * (root + target / root);
    }
    r = (uint64_t)root;
    /* s 2^52 - r r is less than 2^60 in magnitude, so that 64 bits are enough. */
    rest = (int64_t)((s << 52) - r * r);
    while (rest < 0) {
        r--;
        rest += (int64_t)(2 * r + 1);
    }
    while (rest > (int64_t)(2 * r)) {
        rest -= (int64_t)(2 * r + 1);
        r++;
    }
    if (rest > (int64_t)r) {
        r++;
    }
    /* A carry of r into 2^53 counts in the exponent, as it has to. */
    return (((exponent - odd + 1023) >> 1) << 52) + (r - 0x10000000000000u);
}

double precess_square_root(double x)
{
    double scaled = x;
    double factor = 1.0;
    double root;
    uint64_t bits;

    if (x == 0.0 || (x > 0.0 && !precess_is_finite(x))) {
        return x;
    }
    if (!(x > 0.0)) {
        return (x - x) / (x - x);
    }
    if (x < DBL_MIN) {
        /* 2^54: of a subnormal number all digits are kept. */
        scaled = x * 18014398509481984.0;
        factor = 1.0 / 134217728.0;
    }
    memcpy(&bits, &scaled, sizeof bits);
    bits = root_of_bits(bits);
    memcpy(&root, &bits, sizeof root);
    return root * factor;
}

void precess_reciprocal_in_two(double magnitude, double *first, double *second)
{
    double power = 1.0;

    if (magnitude < DBL_EPSILON) {
        power = 1.0 / DBL_EPSILON;
    } else if (magnitude > 1.0 / DBL_EPSILON) {
        power = DBL_EPSILON;
    }
    *first = power;
    *second = 1.0 / (power * magnitude);
}
