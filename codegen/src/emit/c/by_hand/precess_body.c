/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h.
 */

#include "precess_solve.h"

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

void precess_along_device(const double mount[9], const double r[3], double out[3])
{
    out[0] = mount[0] * r[0] + mount[3] * r[1] + mount[6] * r[2];
    out[1] = mount[1] * r[0] + mount[4] * r[1] + mount[7] * r[2];
    out[2] = mount[2] * r[0] + mount[5] * r[1] + mount[8] * r[2];
}

void precess_body_of_hub(
    double mass, const double r_bc_b[3], const double i_b_bc[6], struct precess_body *out)
{
    const double *r = r_bc_b;
    const double m[3] = {mass * r[0], mass * r[1], mass * r[2]};

    out->mass = mass;
    out->first_moment[0] = m[0];
    out->first_moment[1] = m[1];
    out->first_moment[2] = m[2];
    /* The parallel-axis term: m (r . r 1 - r r^T). */
    out->inertia[0] = i_b_bc[0] + (m[1] * r[1] + m[2] * r[2]);
    out->inertia[1] = i_b_bc[1] + -(m[0] * r[1]);
    out->inertia[2] = i_b_bc[2] + -(m[0] * r[2]);
    out->inertia[3] = i_b_bc[3] + (m[0] * r[0] + m[2] * r[2]);
    out->inertia[4] = i_b_bc[4] + -(m[1] * r[2]);
    out->inertia[5] = i_b_bc[5] + (m[0] * r[0] + m[1] * r[1]);
}

void precess_body_add_constant_share(struct precess_body *body,
                                     const struct precess_constant_share *share)
{
    body->mass += share->constant_m;
    body->first_moment[0] += share->constant_mr_bx;
    body->first_moment[1] += share->constant_mr_by;
    body->first_moment[2] += share->constant_mr_bz;
    body->inertia[0] += share->constant_i_11;
    body->inertia[1] += share->constant_i_12;
    body->inertia[2] += share->constant_i_13;
    body->inertia[3] += share->constant_i_22;
    body->inertia[4] += share->constant_i_23;
    body->inertia[5] += share->constant_i_33;
}
