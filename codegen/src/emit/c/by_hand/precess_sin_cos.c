/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h. After Cody and Waite, in the order of
 * operations of dynamics/src/sincos.rs, which says why each step is exact.
 */

#include "precess_sin_cos.h"

#include <stdint.h>
#include <string.h>

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

/* A polynomial of the fifth degree in x, in pairs. */
static double polynomial(double x, double squared, const double c[6])
{
    const double low = x * c[1] + c[0];
    const double middle = x * c[3] + c[2];
    const double high = x * c[5] + c[4];

    return squared * (squared * high + middle) + low;
}

static uint64_t bits_of(double x)
{
    uint64_t bits;

    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static double from_bits(uint64_t bits)
{
    double x;

    memcpy(&x, &bits, sizeof x);
    return x;
}

void precess_sin_cos(double angle, double *sine, double *cosine)
{
    static const double SINE[6] = {
        0.1666666666666663,     -0.00833333333332184,  0.00019841269829358528,
        -2.7557313538514657e-6, 2.5050734389421444e-8, -1.5895433304863317e-10};
    static const double COSINE[6] = {
        0.041666666666666595,   -0.0013888888888873342, 2.480158728900208e-5,
        -2.7557314217039046e-7, 2.087570539610012e-9,   -1.1358749246650696e-11};
    /* 1.5 * 2^52: between 2^52 and 2^53 numbers are one apart. */
    const double shift = 6755399441055744.0;
    double count;
    double quarters;
    double before;
    double step;
    double x;
    double excess;
    double x2;
    double x4;
    double half;
    double parabola;
    double s;
    double c;
    uint64_t turns;
    uint64_t swap;

    if (!(angle <= PRECESS_LARGEST_ANGLE && angle >= -PRECESS_LARGEST_ANGLE)) {
        /* No number, for whatever reason. */
        *sine = (angle - angle) / (angle - angle);
        *cosine = *sine;
        return;
    }

    /* Less the nearest whole number of quarter turns, with pi / 2 in four parts. */
    count = angle * 0.63661977236758134308 + shift;
    quarters = count - shift;
    before = -quarters * 0x1.921fb54p0 + angle;
    before = -quarters * 0x1.10b46p-30 + before;
    step = -quarters * 0x1.1a62633p-54;
    x = before + step;
    excess = quarters * 0x1.45c06e0e68948p-86 + (x - before - step);

    /* Sine and cosine of what is left. */
    x2 = x * x;
    x4 = x2 * x2;
    half = x2 * 0.5;
    parabola = 1.0 - half;
    s = x - (x * x2 * polynomial(x2, x4, SINE) + excess * parabola);
    c = parabola + (1.0 - parabola - half + (x4 * polynomial(x2, x4, COSINE) + x * excess));

    /* The last two bits of the count are the quarter turns modulo 4: swapped, and signs set. */
    turns = bits_of(count);
    swap = (bits_of(s) ^ bits_of(c)) & ((turns & 1U) != 0U ? UINT64_MAX : 0U);
    *sine = from_bits(bits_of(s) ^ swap ^ ((turns & 2U) << 62));
    *cosine = from_bits(bits_of(c) ^ swap ^ (((turns + 1U) & 2U) << 62));
}
