/* What the hand-written C refuses and where its sines end: says which check fails. */

#include <float.h>
#include <stdio.h>

#include "precess_sin_cos.h"
#include "precess_solve.h"

#define CHECK(claim)                                     \
    do {                                                 \
        if (!(claim)) {                                  \
            fprintf(stderr, "line %d: %s\n", __LINE__, #claim); \
            return 1;                                    \
        }                                                \
    } while (0)

static const double NOTHING[3] = {0.0, 0.0, 0.0};

/* A hub with a force along x, solved. */
static enum precess_solved solve(
    double mass, const double inertia[6], double force, struct precess_body_acceleration *out)
{
    const struct precess_body_rate still = {0.0, 0.0, 0.0};
    const double push[3] = {force, 0.0, 0.0};
    struct precess_body body;
    struct precess_assembly assembly;

    precess_body_of_hub(mass, NOTHING, inertia, &body);
    precess_assembly_start(&body, push, NOTHING, &assembly);
    return precess_assembly_solve(&assembly, &still, out);
}

int main(void)
{
    const double inertia[6] = {1.0, 0.0, 0.0, 2.0, 0.0, 4.0};
    const double overflown[6] = {1.0, 0.0, 0.0, DBL_MAX * 2.0, 0.0, 4.0};
    const double rod[6] = {1.0, 0.0, 0.0, 1.0, 0.0, 0.0};
    struct precess_body_acceleration moves = {7.0, 7.0, 7.0, 7.0, 7.0, 7.0};
    double sine;
    double cosine;

    /* Nothing is written unless it is solved. */
    CHECK(solve(0.0, inertia, 1.0, &moves) == PRECESS_SINGULAR);
    CHECK(solve(4.0, rod, 1.0, &moves) == PRECESS_SINGULAR);
    CHECK(solve(4.0, inertia, DBL_MAX * 2.0, &moves) == PRECESS_NOT_FINITE);
    CHECK(solve(0.25, inertia, DBL_MAX, &moves) == PRECESS_NOT_FINITE);
    CHECK(solve(4.0, overflown, 1.0, &moves) == PRECESS_NOT_FINITE);
    CHECK(moves.r_b_n_ddot_bx == 7.0 && moves.omega_dot_bz == 7.0);
    CHECK(solve(4.0, inertia, 1.0, &moves) == PRECESS_SOLVED);
    CHECK(moves.r_b_n_ddot_bx == 0.25 && moves.omega_dot_bz == 0.0);

    /* A moment of the hub that the moving share of a device cancels to rounding. */
    {
        static const struct precess_hub_share none;
        const struct precess_body_rate still = {0.0, 0.0, 0.0};
        struct precess_hub_share share = none;
        struct precess_body body;
        struct precess_assembly assembly;
        precess_body_of_hub(4.0, NOTHING, inertia, &body);
        precess_assembly_start(&body, NOTHING, NOTHING, &assembly);
        share.i_moving_22 = -2.0 * (1.0 - 4.0 * DBL_EPSILON);
        precess_assembly_add(&assembly, &share);
        CHECK(precess_assembly_solve(&assembly, &still, &moves) == PRECESS_SINGULAR);
        /* The same inertia, taken out by a joint. */
        precess_assembly_start(&body, NOTHING, NOTHING, &assembly);
        share.m_ww_22 = -share.i_moving_22;
        share.i_moving_22 = 0.0;
        precess_assembly_add(&assembly, &share);
        CHECK(precess_assembly_solve(&assembly, &still, &moves) == PRECESS_SINGULAR);
    }

    /* A pivot that is rounding of its scale, and one that is no number. */
    CHECK(!precess_pivot_is_sound(64.0 * DBL_EPSILON, 1.0));
    CHECK(precess_pivot_is_sound(128.0 * DBL_EPSILON, 1.0));
    CHECK(!precess_pivot_is_sound(DBL_MAX * 2.0 - DBL_MAX * 2.0, 1.0));

    /* Sine keeps the sign of zero; beyond the largest angle there is no number. */
    precess_sin_cos(-0.0, &sine, &cosine);
    CHECK(1.0 / sine < -DBL_MAX && cosine == 1.0);
    precess_sin_cos(PRECESS_LARGEST_ANGLE, &sine, &cosine);
    CHECK(sine * sine + cosine * cosine > 1.0 - 4.0 * DBL_EPSILON);
    precess_sin_cos(-PRECESS_LARGEST_ANGLE * (1.0 + DBL_EPSILON), &sine, &cosine);
    CHECK(sine != sine && cosine != cosine);
    precess_sin_cos(DBL_MAX * 2.0, &sine, &cosine);
    CHECK(sine != sine && cosine != cosine);
    return 0;
}
