/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h.
 */

#include "precess_joint.h"
#include "precess_arithmetic.h"

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

int precess_passive_is_none(const struct precess_passive *passive)
{
    return passive->stiffness == 0.0 && passive->rest == 0.0 && passive->viscous == 0.0
        && passive->coulomb == 0.0 && passive->coulomb_rate == 0.0;
}

/* The rate and that below which friction fades, by the larger of the two, so that neither square
 * vanishes or overflows; the two factors that bring them there. */
static void scaled_rates(
    const struct precess_passive *passive, double rate, double factors[2], double out[2])
{
    const double larger = precess_larger(precess_magnitude(rate), passive->coulomb_rate);

    precess_reciprocal_in_two(larger, &factors[0], &factors[1]);
    out[0] = rate * factors[0] * factors[1];
    out[1] = passive->coulomb_rate * factors[0] * factors[1];
}

double precess_passive_torque(const struct precess_passive *passive, double coordinate, double rate)
{
    const double spring = -(passive->stiffness * (coordinate - passive->rest));
    const double viscous = -(passive->viscous * rate);
    double factors[2];
    double q[2];
    double root;

    if (passive->coulomb == 0.0) {
        return spring + viscous;
    }
    scaled_rates(passive, rate, factors, q);
    root = precess_square_root(q[0] * q[0] + q[1] * q[1]);
    return spring + (viscous - passive->coulomb * q[0] * (1.0 / root));
}

double precess_passive_damping(const struct precess_passive *passive, double rate)
{
    double factors[2];
    double q[2];
    double share;

    if (passive->coulomb == 0.0) {
        return passive->viscous;
    }
    scaled_rates(passive, rate, factors, q);
    share = 1.0 / (q[0] * q[0] + q[1] * q[1]);
    return passive->viscous
        + passive->coulomb * factors[0] * factors[1]
        * (q[1] * q[1] * share * precess_square_root(share));
}

enum precess_status precess_joint_drives(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_passive *passive,
    int is_free,
    const double *coordinates,
    const double *rates,
    const struct precess_joint_inputs *inputs,
    struct precess_drive *out)
{
    int k;

    for (k = 0; k < count; k++) {
        const enum precess_mode mode = inputs[k].mode;
        const double given = mode == PRECESS_PRESCRIBED ? inputs[k].acceleration : 0.0;

        if (mode != PRECESS_DRIVEN && mode != PRECESS_PRESCRIBED && mode != PRECESS_LOCKED) {
            return PRECESS_BAD_INPUT;
        }
        /* Locked at rest is what a kind does that keeps the rate. */
        if (!kinds[k].driven && !(mode == PRECESS_LOCKED && rates[k] == 0.0)
            && !(mode == PRECESS_PRESCRIBED && given == 0.0)) {
            return PRECESS_NOT_DRIVEN;
        }
        if (mode == PRECESS_LOCKED && rates[k] != 0.0) {
            return PRECESS_LOCKED_MOVES;
        }
        out[k].torque = 0.0;
        out[k].driven = 0.0;
        out[k].held = 1.0;
        out[k].given = given;
        if (mode == PRECESS_DRIVEN) {
            out[k].torque = inputs[k].torque;
            out[k].driven = 1.0;
            out[k].held = 0.0;
            if (!is_free) {
                out[k].torque += precess_passive_torque(&passive[k], coordinates[k], rates[k]);
            }
        }
    }
    return PRECESS_OK;
}

/* A share of nothing is nothing, also where the share is infinite. */
static double taken(double share, double number)
{
    return number == 0.0 ? 0.0 : share * number;
}

void precess_joint_reductions(
    int count,
    const struct precess_passive *passive,
    const double *rates,
    const struct precess_joint_inputs *inputs,
    const struct precess_reduction *reduction,
    struct precess_drive *out)
{
    int k;

    for (k = 0; k < count; k++) {
        const int driven = inputs[k].mode == PRECESS_DRIVEN;

        out[k].torque = 0.0;
        out[k].driven = driven ? 1.0 : 0.0;
        out[k].held = driven ? 0.0 : 1.0;
        out[k].given = 0.0;
        if (driven && !precess_passive_is_none(&passive[k])) {
            const double damping = precess_passive_damping(&passive[k], rates[k]);

            out[k].held = -(taken(reduction->damping, damping)
                            + taken(reduction->stiffness, passive[k].stiffness));
        }
    }
}

void precess_stiffness_add(
    struct precess_stiffness *stiffness,
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_passive *passive,
    const double *rates,
    const struct precess_pivot *pivots,
    const struct precess_drive *drives)
{
    /* No joint's response exceeds that to its own pivot, parents held, times the product of
     * diagonal over pivot of all joints. */
    double damping = 0.0;
    double spring = 0.0;
    double growth = 1.0;
    int k;

    for (k = 0; k < count; k++) {
        double response = 0.0;
        double over_pivot = 1.0;

        if (kinds[k].driven) {
            response = drives[k].driven * (1.0 / (pivots[k].pivot + drives[k].held));
            over_pivot = drives[k].held + pivots[k].diagonal * response;
        }
        damping = damping + precess_passive_damping(&passive[k], rates[k]) * response;
        spring = spring + passive[k].stiffness * response;
        growth = growth * over_pivot;
    }
    stiffness->damping = stiffness->damping + damping * growth;
    stiffness->spring = stiffness->spring + spring * growth;
}

int precess_stiffness_accepts(const struct precess_stiffness *stiffness, double dt)
{
    const double size = precess_magnitude(dt);

    return stiffness->damping * size <= 0.25 && stiffness->spring * size * size <= 0.25;
}

void precess_stable_reduction(
    enum precess_stable_line line, double dt, struct precess_reduction *out)
{
    /* Shares of a dt and of b dt² whose sum is at most one. FRICTION is the root s of R(-s) = 1. */
    static const double FRICTION = 2.785293563405282;
    double damping = 0.0;
    double stiffness = 0.0;

    switch (line) {
    case PRECESS_LINE_BOTH:
        damping = 1.0 / FRICTION;
        stiffness = 1.0 / 6.841;
        break;
    case PRECESS_LINE_UNDAMPED:
        stiffness = 1.0 / 8.0;
        break;
    case PRECESS_LINE_REAL_ROOT:
        damping = 1.0 / FRICTION;
        stiffness = -1.0 / (FRICTION * FRICTION);
        break;
    case PRECESS_LINE_LITTLE_DAMPING:
        damping = 1.56 / 10.65;
        stiffness = 1.0 / 10.65;
        break;
    case PRECESS_LINE_ANY_DAMPING:
        stiffness = 1.0 / 6.841;
        break;
    }
    out->damping = damping * dt;
    out->stiffness = stiffness * (dt * dt);
}
