/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h.
 */

#include "precess_gravity.h"

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

/* The direction r / R, and mu / R, mu / R², mu / R³ and mu / R⁴. */
static void powers_of(double mu, const double r[3], double n[3], double powers[4])
{
    const double size = precess_larger(
        precess_larger(precess_magnitude(r[0]), precess_magnitude(r[1])), precess_magnitude(r[2]));
    const double near = DBL_EPSILON * DBL_EPSILON;
    double scaled[3];
    double first;
    double second;
    double per_r;
    double per_square;
    int k;

    if (near < size && size < 1.0 / near) {
        per_r = 1.0 / precess_square_root(precess_dot(r, r));
        for (k = 0; k < 3; k++) {
            n[k] = per_r * r[k];
        }
        powers[0] = mu * per_r;
        per_square = per_r * per_r;
        powers[1] = powers[0] * per_r;
        powers[2] = powers[0] * per_square;
        powers[3] = powers[0] * per_r * per_square;
        return;
    }
    /* Beyond, R² or 1 / R² may be no number although the field is one. */
    precess_reciprocal_in_two(size, &first, &second);
    for (k = 0; k < 3; k++) {
        scaled[k] = r[k] * first * second;
    }
    per_r = 1.0 / precess_square_root(precess_dot(scaled, scaled));
    for (k = 0; k < 3; k++) {
        n[k] = per_r * scaled[k];
    }
    powers[0] = mu * per_r * first * second;
    for (k = 1; k < 4; k++) {
        powers[k] = powers[k - 1] * per_r * first * second;
    }
}

void precess_gravity_at(
    const struct precess_gravity *gravity,
    const struct precess_matrix *bn,
    const double r_b_n[3],
    double at_b[3],
    struct precess_central *central)
{
    double *const n = central->n;
    double *const g = central->gradient;
    double r[3];
    double powers[4];
    double three;
    int k;

    at_b[0] = at_b[1] = at_b[2] = 0.0;
    if (gravity->field == PRECESS_UNIFORM_FIELD) {
        precess_rotate(bn, gravity->uniform, at_b);
    }
    if (gravity->field != PRECESS_CENTRAL_FIELD) {
        return;
    }
    precess_rotate(bn, r_b_n, r);
    powers_of(gravity->mu, r, n, powers);
    for (k = 0; k < 3; k++) {
        at_b[k] = -powers[1] * n[k];
    }
    three = 3.0 * powers[2];
    g[0] = three * (n[0] * n[0]) + -powers[2];
    g[1] = three * (n[0] * n[1]) + 0.0;
    g[2] = three * (n[0] * n[2]) + 0.0;
    g[3] = three * (n[1] * n[1]) + -powers[2];
    g[4] = three * (n[1] * n[2]) + 0.0;
    g[5] = three * (n[2] * n[2]) + -powers[2];
    central->slope = powers[3];
}

void precess_second_moment(const double inertia[6], double out[6])
{
    const double half = 0.5 * (inertia[0] + inertia[3] + inertia[5]);

    out[0] = half + -1.0 * inertia[0];
    out[1] = 0.0 + -1.0 * inertia[1];
    out[2] = 0.0 + -1.0 * inertia[2];
    out[3] = half + -1.0 * inertia[3];
    out[4] = 0.0 + -1.0 * inertia[4];
    out[5] = half + -1.0 * inertia[5];
}

void precess_central_wrench(
    const struct precess_central *central,
    const double first_moment[3],
    const double second_moment[6],
    double force[3],
    double moment[3])
{
    const double *const s = second_moment;
    const double columns[3][3] = {{s[0], s[1], s[2]}, {s[1], s[3], s[4]}, {s[2], s[4], s[5]}};
    double g[3][3];
    int k;

    precess_tensor_times(central->gradient, first_moment, force);
    for (k = 0; k < 3; k++) {
        precess_tensor_times(central->gradient, columns[k], g[k]);
    }
    /* Component i: epsilon_ijk (S G)_jk. */
    moment[0] = g[1][2] - g[2][1];
    moment[1] = g[2][0] - g[0][2];
    moment[2] = g[0][1] - g[1][0];
}

void precess_central_third_order(
    const struct precess_central *central, const double second_moment[6], double force[3])
{
    const double *const n = central->n;
    const double three = 3.0 * central->slope;
    double along[3];
    double spread;
    int k;

    precess_tensor_times(second_moment, n, along);
    spread = 0.5 * (second_moment[0] + second_moment[3] + second_moment[5])
        - 2.5 * precess_dot(n, along);
    for (k = 0; k < 3; k++) {
        force[k] = three * (along[k] + spread * n[k]);
    }
}
