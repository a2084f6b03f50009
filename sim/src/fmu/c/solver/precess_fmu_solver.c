/* Compile with -std=c99 -ffp-contract=off. */

#include "precess_fmu_solver.h"

const double *precess_fmu_copy(const double *from, int count, double *to)
{
    int k;

    for (k = 0; k < count; k++) {
        to[k] = from[k];
    }
    return from + count;
}

enum precess_status precess_fmu_prepare(struct precess_fmu *fmu)
{
    struct FMU_SOLVER_PARAMETERS parameters;
    const double *from = fmu->values + FMU_PARAMETER + 5;
    enum precess_status status;
    int k;

    if (fmu->is_prepared) {
        return PRECESS_OK;
    }
    parameters.attitude = PRECESS_QUATERNION;
    parameters.hub.mass = *from++;
    from = precess_fmu_copy(from, 3, parameters.hub.centre_of_mass);
    from = precess_fmu_copy(from, 6, parameters.hub.inertia);
    for (k = 0; k < FMU_DEVICES; k++) {
        int row;

        for (row = 0; row < 3; row++) {
            int column;

            for (column = 0; column < 3; column++) {
                parameters.mounts[k].columns[column][row] = *from++;
            }
        }
    }
    for (k = 0; k < FMU_JOINTS; k++) {
        struct precess_body_parameters *const body = &parameters.bodies[k];
        struct precess_passive *const passive = &parameters.passive[k];

        body->mass = *from++;
        from = precess_fmu_copy(from, 3, body->origin);
        from = precess_fmu_copy(from, 3, body->centre_of_mass);
        from = precess_fmu_copy(from, 6, body->inertia);
        passive->stiffness = *from++;
        passive->rest = *from++;
        passive->viscous = *from++;
        passive->coulomb = *from++;
        passive->coulomb_rate = *from++;
    }
    status = FMU_SOLVER_INIT(&parameters, &fmu->spacecraft, &fmu->device);
    fmu->is_prepared = status == PRECESS_OK;
    return status;
}

void precess_fmu_state_at(const double *from, struct FMU_SOLVER_STATE *state)
{
    from = precess_fmu_copy(from, 3, state->r_b_n);
    from = precess_fmu_copy(from, 3, state->r_b_n_dot);
    from = precess_fmu_copy(from, 4, state->attitude);
    from = precess_fmu_copy(from, 3, state->omega);
    from = precess_fmu_copy(from, FMU_JOINTS, state->coordinates);
    (void)precess_fmu_copy(from, FMU_JOINTS, state->rates);
}

void precess_fmu_state_of(const struct precess_fmu *fmu, struct FMU_SOLVER_STATE *state)
{
    precess_fmu_state_at(fmu->values + FMU_STATE, state);
}

/* Adds the cross product of two vectors. */
static void add_cross(const double a[3], const double b[3], double to[3])
{
    to[0] = to[0] + (a[1] * b[2] - a[2] * b[1]);
    to[1] = to[1] + (a[2] * b[0] - a[0] * b[2]);
    to[2] = to[2] + (a[0] * b[1] - a[1] * b[0]);
}

static void add(const double from[3], double to[3])
{
    to[0] = to[0] + from[0];
    to[1] = to[1] + from[1];
    to[2] = to[2] + from[2];
}

/* Adds the wrenches, of which `from` has force and moment of each. */
static void add_wrenches(
    const double *from, const struct FMU_SOLVER_STATE *state, struct FMU_SOLVER_INPUTS *inputs)
{
    struct precess_matrix bn;
    int k;

    precess_attitude_dcm(PRECESS_QUATERNION, state->attitude, &bn);
    for (k = 0; k < FMU_WRENCHES; k++) {
        const struct precess_fmu_wrench *const wrench = &precess_fmu_wrenches[k];
        double force[3];
        double moment[3];

        from = precess_fmu_copy(from, 3, force);
        from = precess_fmu_copy(from, 3, moment);
        if (wrench->inertial) {
            precess_rotate(&bn, from - 6, force);
            precess_rotate(&bn, from - 3, moment);
        }
        if (wrench->joint == FMU_JOINTS) {
            add(moment, inputs->torque_b);
            add(force, inputs->force);
            add_cross(wrench->point, force, inputs->torque_b);
        } else {
            struct precess_wrench *const sum = &inputs->wrenches[wrench->joint];
            double about[3] = { 0.0, 0.0, 0.0 };

            add_cross(wrench->point, force, about);
            add(moment, about);
            add(force, sum->force);
            add(about, sum->moment);
            inputs->has_wrenches = 1;
        }
    }
}

void precess_fmu_inputs_of(
    const struct precess_fmu *fmu,
    const struct FMU_SOLVER_STATE *state,
    struct FMU_SOLVER_INPUTS *inputs)
{
    static const struct FMU_SOLVER_INPUTS NONE;
    const double *const from = fmu->values + FMU_INPUT;
    const double *const gravity = fmu->values + FMU_PARAMETER + 1;
    int k;

    *inputs = NONE;
    inputs->hub.freedom = FMU_HUB;
    if (inputs->hub.freedom == PRECESS_HUB_PRESCRIBED) {
        (void)precess_fmu_copy(from, 3, inputs->hub.r_b_n_ddot);
        (void)precess_fmu_copy(from + 3, 3, inputs->hub.omega_dot);
    } else {
        (void)precess_fmu_copy(from, 3, inputs->force);
        (void)precess_fmu_copy(from + 3, 3, inputs->torque_b);
    }
    for (k = 0; k < FMU_JOINTS; k++) {
        const struct precess_fmu_joint *const joint = &precess_fmu_joints[k];
        const double given = joint->input < 0 ? 0.0 : from[6 + joint->input];

        inputs->joints[k].mode = joint->mode;
        if (joint->mode == PRECESS_DRIVEN) {
            const double below = given > joint->limit ? joint->limit : given;

            inputs->joints[k].torque = below < -joint->limit ? -joint->limit : below;
        } else {
            inputs->joints[k].acceleration = given;
        }
    }
    inputs->gravity.field = FMU_FIELD;
    (void)precess_fmu_copy(gravity, 3, inputs->gravity.uniform);
    inputs->gravity.mu = gravity[3];
    if (FMU_WRENCHES > 0) {
        add_wrenches(from + 6 + FMU_DRIVEN, state, inputs);
    }
}

void precess_fmu_hold(struct FMU_SOLVER_STATE *state)
{
    const enum precess_hub_freedom freedom = FMU_HUB;
    static const double ZERO[3] = { 0.0, 0.0, 0.0 };
    int k;

    if (freedom == PRECESS_HUB_FIXED) {
        (void)precess_fmu_copy(ZERO, 3, state->r_b_n_dot);
        (void)precess_fmu_copy(ZERO, 3, state->omega);
    }
    for (k = 0; k < FMU_JOINTS; k++) {
        if (precess_fmu_joints[k].mode == PRECESS_LOCKED) {
            state->rates[k] = 0.0;
        }
    }
}
