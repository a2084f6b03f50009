/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h.
 */

#include "precess_device.h"

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

int precess_is_rounding(double off, double scale)
{
    return precess_magnitude(off) <= 4.0 * DBL_EPSILON * scale;
}

double precess_largest_offset(const struct precess_body_parameters *bodies, int count)
{
    double largest = 0.0;
    int k;
    int c;

    for (k = 0; k < count; k++) {
        for (c = 0; c < 3; c++) {
            largest = precess_larger(largest, precess_magnitude(bodies[k].origin[c]));
            largest = precess_larger(largest, precess_magnitude(bodies[k].centre_of_mass[c]));
        }
    }
    return largest;
}

double precess_trace(const struct precess_body_parameters *body)
{
    const double *const i = body->inertia;

    return precess_magnitude(i[0]) + precess_magnitude(i[3]) + precess_magnitude(i[5]);
}

/* Whether a tensor has no principal moment below -4096 epsilons of its largest element: with that
 * much added to its diagonal it is positive definite, so that every pivot of its factors is above
 * zero. Pivots of a definite tensor are accurate to some epsilons of the largest element. */
static int is_semidefinite(const double i[6])
{
    const double bound = 4096.0 * DBL_EPSILON;
    double largest = 0.0;
    double factors[2];
    double s[6];
    double below;
    double second;
    double third;
    int k;

    for (k = 0; k < 6; k++) {
        largest = precess_larger(largest, precess_magnitude(i[k]));
    }
    if (largest == 0.0) {
        return 1;
    }
    precess_reciprocal_in_two(largest, &factors[0], &factors[1]);
    for (k = 0; k < 6; k++) {
        s[k] = i[k] * factors[0] * factors[1];
    }
    s[0] = s[0] + bound;
    s[3] = s[3] + bound;
    s[5] = s[5] + bound;
    if (!(s[0] > 0.0)) {
        return 0;
    }
    second = s[3] - s[1] * (s[1] / s[0]);
    if (!(second > 0.0)) {
        return 0;
    }
    below = s[4] - s[2] * (s[1] / s[0]);
    third = s[5] - s[2] * (s[2] / s[0]) - below * (below / second);
    return third > 0.0;
}

int precess_hub_is_possible(const struct precess_hub_parameters *hub)
{
    const double *const i = hub->inertia;

    return precess_is_finite(hub->mass) && hub->mass > 0.0
        && precess_are_finite(hub->centre_of_mass, 3) && precess_are_finite(i, 6)
        && is_semidefinite(i);
}

/* Whether it is right-handed, and its columns are orthonormal. */
static int is_rotation(const struct precess_matrix *m)
{
    const double *const x = m->columns[0];
    const double *const y = m->columns[1];
    const double *const z = m->columns[2];
    int i;
    int k;

    for (i = 0; i < 3; i++) {
        for (k = 0; k < 3; k++) {
            const double off =
                precess_dot(m->columns[i], m->columns[k]) - (i == k ? 1.0 : 0.0);

            if (!(precess_magnitude(off) <= 4096.0 * DBL_EPSILON)) {
                return 0;
            }
        }
    }
    return x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2])
            + x[2] * (y[0] * z[1] - y[1] * z[0])
        > 0.0;
}

static int is_possible_passive(const struct precess_passive *p)
{
    return precess_is_finite(p->stiffness) && precess_is_finite(p->rest)
        && precess_is_finite(p->viscous) && precess_is_finite(p->coulomb)
        && precess_is_finite(p->coulomb_rate) && p->stiffness >= 0.0 && p->viscous >= 0.0
        && p->coulomb >= 0.0 && p->coulomb_rate >= 0.0
        && (p->coulomb == 0.0 || p->coulomb_rate > 0.0);
}

int precess_device_is_possible(
    const struct precess_matrix *mount,
    const struct precess_body_parameters *bodies,
    const struct precess_passive *passive,
    int count)
{
    int k;

    for (k = 0; k < count; k++) {
        const struct precess_body_parameters *const b = &bodies[k];

        if (!precess_is_finite(b->mass) || !precess_are_finite(b->origin, 3)
            || !precess_are_finite(b->centre_of_mass, 3) || !precess_are_finite(b->inertia, 6)
            || b->mass < 0.0 || !is_semidefinite(b->inertia)
            || !is_possible_passive(&passive[k])) {
            return 0;
        }
    }
    return bodies[count - 1].mass > 0.0 && is_rotation(mount);
}

/* Length of an offset; where it keeps its angle with the axis, of what it has across it. */
static double lever(const double offset[3], int axis, int parallel)
{
    double across[3];
    int c;

    for (c = 0; c < 3; c++) {
        across[c] = parallel && c == axis ? 0.0 : offset[c];
    }
    return precess_square_root(precess_dot(across, across));
}

/* Mass or inertia outboard of a joint, in the pose that makes the most of it. */
static double outboard(
    const struct precess_joint_kind *kinds,
    const struct precess_body_parameters *bodies,
    int count,
    int joint)
{
    static const int DIAGONAL[3] = {0, 3, 5};
    const struct precess_joint_kind own = kinds[joint];
    double sum = 0.0;
    double arm = 0.0;
    /* Whether a body turns only about the joint's axis, in any pose. */
    int parallel = 1;
    int k;

    for (k = joint; k < count; k++) {
        const struct precess_body_parameters *const b = &bodies[k];
        double moment;
        double reach;

        if (own.slides) {
            sum = sum + b->mass;
            continue;
        }
        if (k > joint) {
            arm = arm + lever(b->origin, own.axis, parallel);
            parallel = parallel && (kinds[k].slides || kinds[k].axis == own.axis);
        }
        moment = parallel ? precess_magnitude(b->inertia[DIAGONAL[own.axis]]) : precess_trace(b);
        reach = arm + lever(b->centre_of_mass, own.axis, parallel);
        sum = sum + moment + b->mass * reach * reach;
    }
    return sum;
}

void precess_pivot_bounds(
    const struct precess_joint_kind *kinds,
    const struct precess_body_parameters *bodies,
    int count,
    double *out)
{
    int k;

    for (k = 0; k < count; k++) {
        out[k] = 64.0 * DBL_EPSILON * outboard(kinds, bodies, count, k);
    }
}

enum precess_status precess_check_pivots(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_pivot *pivots,
    const double *bounds,
    const struct precess_drive *drives)
{
    enum precess_status status = PRECESS_OK;
    int k;

    /* The joint nearest the tip was eliminated first: it is the cause. */
    for (k = 0; k < count; k++) {
        if (kinds[k].driven && drives[k].driven == 1.0 && !(pivots[k].pivot > bounds[k])) {
            status = precess_is_finite(pivots[k].pivot) && precess_is_finite(bounds[k])
                ? PRECESS_NO_INERTIA
                : PRECESS_OVERFLOWS;
        }
    }
    return status;
}

int precess_pivots_are_positive(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_pivot *pivots,
    const struct precess_drive *drives)
{
    int k;

    for (k = 0; k < count; k++) {
        if (kinds[k].driven && drives[k].driven == 1.0
            && !(pivots[k].pivot + drives[k].held > 0.0)) {
            return 0;
        }
    }
    return 1;
}

void precess_add_carried(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_matrix *mount,
    const struct precess_wrench *joints,
    const struct precess_wrench *hub,
    struct precess_drive *drives,
    struct precess_evaluation *evaluation)
{
    double force[3];
    double moment[3];
    int k;

    for (k = 0; k < count; k++) {
        const double *const along = kinds[k].slides ? joints[k].force : joints[k].moment;

        drives[k].torque = drives[k].torque + along[kinds[k].axis] * drives[k].driven;
    }
    precess_rotate(mount, hub->force, force);
    precess_rotate(mount, hub->moment, moment);
    precess_assembly_add_wrench(&evaluation->assembly, force, moment);
}

void precess_gradient_along(
    const struct precess_matrix *mount,
    const struct precess_central *central,
    struct precess_gradient *out)
{
    struct precess_matrix transposed;
    double g[6];

    precess_transpose(mount, &transposed);
    precess_tensor_rotated(central->gradient, &transposed, g);
    out->g_11 = g[0];
    out->g_12 = g[1];
    out->g_13 = g[2];
    out->g_22 = g[3];
    out->g_23 = g[4];
    out->g_33 = g[5];
}
