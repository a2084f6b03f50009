/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h.
 */

#include "precess_evaluation.h"

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

void precess_evaluation_start(
    const struct precess_body *body,
    const double omega[3],
    const struct precess_gravity *gravity,
    const struct precess_matrix *bn,
    const double r_b_n[3],
    const double force[3],
    const double torque_b[3],
    struct precess_evaluation *out)
{
    int k;

    out->omega.omega_bx = omega[0];
    out->omega.omega_by = omega[1];
    out->omega.omega_bz = omega[2];
    out->is_central = gravity->field == PRECESS_CENTRAL_FIELD;
    precess_gravity_at(gravity, bn, r_b_n, out->at_b, &out->central);
    precess_assembly_start(body, force, torque_b, &out->assembly);
    for (k = 0; k < 6; k++) {
        out->second_moment[k] = 0.0;
    }
    out->stiffness.damping = 0.0;
    out->stiffness.spring = 0.0;
}

static int is_finite_acceleration(const struct precess_body_acceleration *a)
{
    return precess_is_finite(a->r_b_n_ddot_bx) && precess_is_finite(a->r_b_n_ddot_by)
        && precess_is_finite(a->r_b_n_ddot_bz) && precess_is_finite(a->omega_dot_bx)
        && precess_is_finite(a->omega_dot_by) && precess_is_finite(a->omega_dot_bz);
}

/* What the gradient exerts on the hub, and the third order on the whole. */
static void add_central(struct precess_evaluation *evaluation, const struct precess_body *hub)
{
    double own[6];
    double whole[6];
    double force[3];
    double moment[3];
    double third[3];
    int k;

    precess_second_moment(hub->inertia, own);
    precess_central_wrench(&evaluation->central, hub->first_moment, own, force, moment);
    for (k = 0; k < 6; k++) {
        whole[k] = evaluation->second_moment[k] + own[k];
    }
    precess_central_third_order(&evaluation->central, whole, third);
    for (k = 0; k < 3; k++) {
        force[k] = force[k] + third[k];
    }
    precess_assembly_add_wrench(&evaluation->assembly, force, moment);
}

enum precess_status precess_evaluation_solve(
    struct precess_evaluation *evaluation,
    const struct precess_body *hub,
    const struct precess_hub_mode *mode,
    struct precess_body_acceleration *out)
{
    const double *const at_b = evaluation->at_b;

    if (evaluation->is_central) {
        add_central(evaluation, hub);
    }
    if (mode->freedom == PRECESS_HUB_FREE) {
        switch (precess_assembly_solve(&evaluation->assembly, &evaluation->omega, out)) {
        case PRECESS_SOLVED:
            return PRECESS_OK;
        case PRECESS_SINGULAR:
            return PRECESS_NO_INERTIA;
        case PRECESS_NOT_FINITE:
            break;
        }
        return PRECESS_OVERFLOWS;
    }
    out->r_b_n_ddot_bx = 0.0 - at_b[0];
    out->r_b_n_ddot_by = 0.0 - at_b[1];
    out->r_b_n_ddot_bz = 0.0 - at_b[2];
    out->omega_dot_bx = 0.0;
    out->omega_dot_by = 0.0;
    out->omega_dot_bz = 0.0;
    if (mode->freedom == PRECESS_HUB_PRESCRIBED) {
        out->r_b_n_ddot_bx = mode->r_b_n_ddot[0] - at_b[0];
        out->r_b_n_ddot_by = mode->r_b_n_ddot[1] - at_b[1];
        out->r_b_n_ddot_bz = mode->r_b_n_ddot[2] - at_b[2];
        out->omega_dot_bx = mode->omega_dot[0];
        out->omega_dot_by = mode->omega_dot[1];
        out->omega_dot_bz = mode->omega_dot[2];
    }
    return is_finite_acceleration(out) ? PRECESS_OK : PRECESS_OVERFLOWS;
}

enum precess_status precess_evaluation_finish(
    const struct precess_evaluation *evaluation,
    const struct precess_hub_mode *mode,
    const struct precess_body_acceleration *relative,
    double r_b_n_ddot[3],
    double omega_dot[3])
{
    int k;

    r_b_n_ddot[0] = relative->r_b_n_ddot_bx + evaluation->at_b[0];
    r_b_n_ddot[1] = relative->r_b_n_ddot_by + evaluation->at_b[1];
    r_b_n_ddot[2] = relative->r_b_n_ddot_bz + evaluation->at_b[2];
    for (k = 0; k < 3 && mode->freedom != PRECESS_HUB_FREE; k++) {
        r_b_n_ddot[k] = mode->freedom == PRECESS_HUB_FIXED ? 0.0 : mode->r_b_n_ddot[k];
    }
    omega_dot[0] = relative->omega_dot_bx;
    omega_dot[1] = relative->omega_dot_by;
    omega_dot[2] = relative->omega_dot_bz;
    return precess_are_finite(r_b_n_ddot, 3) ? PRECESS_OK : PRECESS_OVERFLOWS;
}

void precess_evaluation_stiffness(
    const struct precess_evaluation *evaluation,
    const struct precess_hub_mode *mode,
    struct precess_stiffness *out)
{
    double pivots[6];
    double scales[6];
    double growth;

    *out = evaluation->stiffness;
    if (mode->freedom != PRECESS_HUB_FREE) {
        return;
    }
    precess_assembly_pivots(&evaluation->assembly, pivots, scales);
    growth = (scales[0] * (1.0 / pivots[0])) * (scales[1] * (1.0 / pivots[1]))
        * (scales[2] * (1.0 / pivots[2]));
    growth = growth * (scales[3] * (1.0 / pivots[3])) * (scales[4] * (1.0 / pivots[4]))
        * (scales[5] * (1.0 / pivots[5]));
    out->damping = out->damping * growth;
    out->spring = out->spring * growth;
}

int precess_environment_is_finite(
    const struct precess_gravity *gravity, const struct precess_hub_mode *mode)
{
    switch (gravity->field) {
    case PRECESS_NO_FIELD:
        break;
    case PRECESS_UNIFORM_FIELD:
        if (!precess_are_finite(gravity->uniform, 3)) {
            return 0;
        }
        break;
    case PRECESS_CENTRAL_FIELD:
        if (!precess_is_finite(gravity->mu)) {
            return 0;
        }
        break;
    default:
        return 0;
    }
    switch (mode->freedom) {
    case PRECESS_HUB_FREE:
    case PRECESS_HUB_FIXED:
        return 1;
    case PRECESS_HUB_PRESCRIBED:
        return precess_are_finite(mode->r_b_n_ddot, 3) && precess_are_finite(mode->omega_dot, 3);
    default:
        return 0;
    }
}
