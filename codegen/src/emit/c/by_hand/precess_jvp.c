/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h.
 */

#include "precess_jvp.h"

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

static void add_cross_product(const double a[3], const double b[3], double out[3])
{
    out[0] = out[0] + (a[1] * b[2] - a[2] * b[1]);
    out[1] = out[1] + (a[2] * b[0] - a[0] * b[2]);
    out[2] = out[2] + (a[0] * b[1] - a[1] * b[0]);
}

/* What `first x (second x v)` is, added to `out`. */
static void add_twice(
    const double first[3], const double second[3], const double v[3], double out[3])
{
    double inner[3] = { 0.0, 0.0, 0.0 };

    add_cross_product(second, v, inner);
    add_cross_product(first, inner, out);
}

/* What a central field changes by where B moves by `by_r`: R by `along`, n by the rest. */
static void central_change(
    const struct precess_gravity *gravity,
    const double r[3],
    const double by_r[3],
    const struct precess_central *at,
    struct precess_central *by)
{
    static const int ROWS[6] = { 0, 0, 0, 1, 1, 2 };
    static const int COLUMNS[6] = { 0, 1, 2, 1, 2, 2 };
    const double *const n = at->n;
    const double along = precess_dot(n, by_r);
    const double distance = precess_dot(n, r);
    const double per_r = 1.0 / distance;
    const double cube = gravity->mu * per_r * per_r * per_r;
    int k;

    for (k = 0; k < 3; k++) {
        by->n[k] = per_r * (by_r[k] - along * n[k]);
    }
    for (k = 0; k < 6; k++) {
        const int i = ROWS[k];
        const int j = COLUMNS[k];

        by->gradient[k] = 3.0 * cube * (by->n[i] * n[j] + n[i] * by->n[j])
            - 3.0 * per_r * along * at->gradient[k];
    }
    by->slope = -4.0 * per_r * along * at->slope;
}

void precess_change_start(
    const struct precess_body *body,
    const struct precess_body *hub,
    const struct precess_gravity *gravity,
    const struct precess_matrix *bn,
    const double r_b_n[3],
    const double omega[3],
    const double r_b_n_ddot[3],
    const double omega_dot[3],
    const struct precess_hub_direction *direction,
    struct precess_change *out)
{
    static const struct precess_central NO_CENTRE = { { 0.0 }, { 0.0 }, 0.0 };
    static const double NONE[3] = { 0.0, 0.0, 0.0 };
    struct precess_evaluation *const by = &out->by;
    double momentum[3];
    double force[3] = { 0.0, 0.0, 0.0 };
    double moment[3] = { 0.0, 0.0, 0.0 };
    int k;

    precess_evaluation_start(body, omega, gravity, bn, r_b_n, NONE, NONE, &out->at);
    out->hub.r_b_n_ddot_bx = r_b_n_ddot[0] - out->at.at_b[0];
    out->hub.r_b_n_ddot_by = r_b_n_ddot[1] - out->at.at_b[1];
    out->hub.r_b_n_ddot_bz = r_b_n_ddot[2] - out->at.at_b[2];
    out->hub.omega_dot_bx = omega_dot[0];
    out->hub.omega_dot_by = omega_dot[1];
    out->hub.omega_dot_bz = omega_dot[2];

    by->omega.omega_bx = direction->omega[0];
    by->omega.omega_by = direction->omega[1];
    by->omega.omega_bz = direction->omega[2];
    by->is_central = out->at.is_central;
    by->central = NO_CENTRE;
    for (k = 0; k < 3; k++) {
        by->at_b[k] = 0.0;
    }
    for (k = 0; k < 6; k++) {
        by->second_moment[k] = 0.0;
    }
    by->stiffness = out->at.stiffness;
    if (by->is_central) {
        double r[3];
        double by_r[3];

        precess_rotate(bn, r_b_n, r);
        precess_rotate(bn, direction->r_b_n, by_r);
        precess_tensor_times(out->at.central.gradient, by_r, by->at_b);
        add_cross_product(r, direction->rotation, by_r);
        central_change(gravity, r, by_r, &out->at.central, &by->central);
    }
    /* The field turns in B. */
    add_cross_product(out->at.at_b, direction->rotation, by->at_b);

    /* Centrifugal and gyroscopic load of the hub by itself. */
    add_twice(direction->omega, omega, hub->first_moment, force);
    add_twice(omega, direction->omega, hub->first_moment, force);
    precess_tensor_times(hub->inertia, omega, momentum);
    add_cross_product(direction->omega, momentum, moment);
    precess_tensor_times(hub->inertia, direction->omega, momentum);
    add_cross_product(omega, momentum, moment);
    for (k = 0; k < 3; k++) {
        force[k] = direction->force[k] - force[k];
        moment[k] = direction->torque_b[k] - moment[k];
    }
    precess_assembly_start(body, force, moment, &by->assembly);
}

void precess_change_along_device(
    const struct precess_change *change,
    const struct precess_matrix *mount,
    struct precess_body_rate *omega,
    struct precess_body_acceleration *hub,
    double by_omega[3])
{
    const struct precess_body_rate *const at = &change->at.omega;
    const struct precess_body_rate *const by = &change->by.omega;
    const double rate[3] = { at->omega_bx, at->omega_by, at->omega_bz };
    const double by_rate[3] = { by->omega_bx, by->omega_by, by->omega_bz };
    const double acceleration[3] = { change->hub.r_b_n_ddot_bx, change->hub.r_b_n_ddot_by,
                                     change->hub.r_b_n_ddot_bz };
    const double angular[3] = { change->hub.omega_dot_bx, change->hub.omega_dot_by,
                                change->hub.omega_dot_bz };
    double own[3];

    precess_rotate_transposed(mount, rate, own);
    omega->omega_bx = own[0];
    omega->omega_by = own[1];
    omega->omega_bz = own[2];
    precess_rotate_transposed(mount, acceleration, own);
    hub->r_b_n_ddot_bx = own[0];
    hub->r_b_n_ddot_by = own[1];
    hub->r_b_n_ddot_bz = own[2];
    precess_rotate_transposed(mount, angular, own);
    hub->omega_dot_bx = own[0];
    hub->omega_dot_by = own[1];
    hub->omega_dot_bz = own[2];
    precess_rotate_transposed(mount, by_rate, by_omega);
}

void precess_add_column(const double *column, double by, int rows, double *sum)
{
    int k;

    for (k = 0; k < rows; k++) {
        sum[k] = sum[k] + by * column[k];
    }
}

void precess_direction_drives(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_passive *passive,
    const double *rates,
    const struct precess_joint_inputs *inputs,
    const struct precess_joint_direction *directions,
    const double *loads,
    struct precess_drive *out)
{
    int row = 0;
    int k;

    for (k = 0; k < count; k++) {
        const struct precess_joint_direction *const of = &directions[k];
        const int driven = inputs[k].mode == PRECESS_DRIVEN;

        out[k].torque = 0.0;
        out[k].driven = driven ? 1.0 : 0.0;
        out[k].held = driven ? 0.0 : 1.0;
        out[k].given = inputs[k].mode == PRECESS_PRESCRIBED && kinds[k].driven ? of->given : 0.0;
        if (driven) {
            const double springs = passive[k].stiffness * of->coordinate
                + precess_passive_damping(&passive[k], rates[k]) * of->rate;

            out[k].torque = of->given - (loads[row] + springs);
        }
        row = row + (kinds[k].driven ? 1 : 0);
    }
}

void precess_change_subtract(
    struct precess_change *change, const struct precess_matrix *mount, const double loads[6])
{
    double force[3];
    double moment[3];
    int k;

    precess_rotate(mount, loads, force);
    precess_rotate(mount, loads + 3, moment);
    for (k = 0; k < 3; k++) {
        force[k] = -force[k];
        moment[k] = -moment[k];
    }
    precess_assembly_add_wrench(&change->by.assembly, force, moment);
}

void precess_change_part(
    const struct precess_change *change,
    const struct precess_central *central,
    struct precess_evaluation *out)
{
    static const double NONE[3] = { 0.0, 0.0, 0.0 };
    int k;

    *out = change->at;
    out->central = *central;
    precess_assembly_start(&change->at.assembly.body, NONE, NONE, &out->assembly);
    for (k = 0; k < 6; k++) {
        out->second_moment[k] = 0.0;
    }
}

void precess_change_add(
    struct precess_change *change, const struct precess_evaluation *part, double weight)
{
    double force[3];
    double moment[3];
    int k;

    for (k = 0; k < 3; k++) {
        force[k] = weight * part->assembly.force[k];
        moment[k] = weight * part->assembly.torque_b[k];
    }
    precess_assembly_add_wrench(&change->by.assembly, force, moment);
    for (k = 0; k < 6; k++) {
        change->by.second_moment[k] =
            change->by.second_moment[k] + weight * part->second_moment[k];
    }
}

void precess_turned(int n, double sine, double cosine, double *turned_sine, double *turned_cosine)
{
    /* Of an eighth of a turn. */
    static const double HALF_ROOT = 0.70710678118654752440;
    const double s = n < 2 ? HALF_ROOT : -HALF_ROOT;
    const double c = n == 0 || n == 3 ? HALF_ROOT : -HALF_ROOT;

    *turned_sine = sine * c + cosine * s;
    *turned_cosine = cosine * c - sine * s;
}

double precess_turned_weight(int n)
{
    /* 1 / (8 sin² (pi / 8)) and 1 / (8 sin² (3 pi / 8)): (2 +- sqrt 2) / 4. */
    static const double WEIGHTS[4] = { 0.85355339059327376220, -0.14644660940672623780,
                                       0.14644660940672623780, -0.85355339059327376220 };

    return WEIGHTS[n];
}

/* What the gradient exerts more on the hub, and the third order on the whole. */
static void add_central_change(struct precess_change *change, const struct precess_body *hub)
{
    const struct precess_central *const at = &change->at.central;
    const struct precess_central *const by = &change->by.central;
    double own[6];
    double whole[6];
    double force[3];
    double moment[3];
    double third[3];
    double along[3];
    double by_along[3];
    double spread;
    double by_spread;
    int k;

    precess_second_moment(hub->inertia, own);
    precess_central_wrench(by, hub->first_moment, own, force, moment);
    for (k = 0; k < 6; k++) {
        whole[k] = change->at.second_moment[k] + own[k];
    }
    precess_central_third_order(at, change->by.second_moment, third);
    precess_tensor_times(whole, at->n, along);
    precess_tensor_times(whole, by->n, by_along);
    spread = 0.5 * (whole[0] + whole[3] + whole[5]) - 2.5 * precess_dot(at->n, along);
    by_spread = -5.0 * precess_dot(at->n, by_along);
    for (k = 0; k < 3; k++) {
        third[k] = third[k] + 3.0 * by->slope * (along[k] + spread * at->n[k])
            + 3.0 * at->slope * (by_along[k] + by_spread * at->n[k] + spread * by->n[k]);
        force[k] = force[k] + third[k];
    }
    precess_assembly_add_wrench(&change->by.assembly, force, moment);
}

enum precess_status precess_change_solve(
    struct precess_change *change,
    const struct precess_body *hub,
    const struct precess_hub_mode *mode,
    const struct precess_hub_direction *direction,
    struct precess_body_acceleration *out)
{
    static const struct precess_body_rate NOT_TURNING = { 0.0, 0.0, 0.0 };
    const int is_prescribed = mode->freedom == PRECESS_HUB_PRESCRIBED;
    const double *const by_at_b = change->by.at_b;

    if (change->by.is_central) {
        add_central_change(change, hub);
    }
    if (mode->freedom == PRECESS_HUB_FREE) {
        switch (precess_assembly_solve(&change->by.assembly, &NOT_TURNING, out)) {
        case PRECESS_SOLVED:
            return PRECESS_OK;
        case PRECESS_SINGULAR:
            return PRECESS_NO_INERTIA;
        case PRECESS_NOT_FINITE:
            break;
        }
        return PRECESS_OVERFLOWS;
    }
    out->r_b_n_ddot_bx = (is_prescribed ? direction->r_b_n_ddot[0] : 0.0) - by_at_b[0];
    out->r_b_n_ddot_by = (is_prescribed ? direction->r_b_n_ddot[1] : 0.0) - by_at_b[1];
    out->r_b_n_ddot_bz = (is_prescribed ? direction->r_b_n_ddot[2] : 0.0) - by_at_b[2];
    out->omega_dot_bx = is_prescribed ? direction->omega_dot[0] : 0.0;
    out->omega_dot_by = is_prescribed ? direction->omega_dot[1] : 0.0;
    out->omega_dot_bz = is_prescribed ? direction->omega_dot[2] : 0.0;
    return PRECESS_OK;
}

enum precess_status precess_change_finish(
    const struct precess_change *change,
    const struct precess_hub_mode *mode,
    const struct precess_hub_direction *direction,
    const struct precess_body_acceleration *relative,
    double r_b_n_ddot[3],
    double omega_dot[3])
{
    int k;

    r_b_n_ddot[0] = relative->r_b_n_ddot_bx + change->by.at_b[0];
    r_b_n_ddot[1] = relative->r_b_n_ddot_by + change->by.at_b[1];
    r_b_n_ddot[2] = relative->r_b_n_ddot_bz + change->by.at_b[2];
    for (k = 0; k < 3 && mode->freedom != PRECESS_HUB_FREE; k++) {
        r_b_n_ddot[k] =
            mode->freedom == PRECESS_HUB_FIXED ? 0.0 : direction->r_b_n_ddot[k];
    }
    omega_dot[0] = relative->omega_dot_bx;
    omega_dot[1] = relative->omega_dot_by;
    omega_dot[2] = relative->omega_dot_bz;
    return precess_are_finite(r_b_n_ddot, 3) && precess_are_finite(omega_dot, 3)
        ? PRECESS_OK
        : PRECESS_OVERFLOWS;
}
