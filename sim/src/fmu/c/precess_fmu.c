/* Compile with -std=c99 -ffp-contract=off. */

#include "precess_fmu.h"

#if defined(__FAST_MATH__)
#error "compile without -ffast-math: results would not be those of the library"
#endif

void precess_fmu_reset(struct precess_fmu *fmu)
{
    int k;

    for (k = 0; k < FMU_VALUES; k++) {
        fmu->values[k] = precess_fmu_start[k];
    }
    fmu->is_prepared = 0;
    fmu->device = FMU_DEVICES;
}

static const double *copy(const double *from, int count, double *to)
{
    int k;

    for (k = 0; k < count; k++) {
        to[k] = from[k];
    }
    return from + count;
}

/* Prepares the solver from the parameters. */
static enum precess_status prepare(struct precess_fmu *fmu)
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
    from = copy(from, 3, parameters.hub.centre_of_mass);
    from = copy(from, 6, parameters.hub.inertia);
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
        from = copy(from, 3, body->origin);
        from = copy(from, 3, body->centre_of_mass);
        from = copy(from, 6, body->inertia);
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

static void state_of(const struct precess_fmu *fmu, struct FMU_SOLVER_STATE *state)
{
    const double *from = fmu->values + FMU_STATE;

    from = copy(from, 3, state->r_b_n);
    from = copy(from, 3, state->r_b_n_dot);
    from = copy(from, 4, state->attitude);
    from = copy(from, 3, state->omega);
    from = copy(from, FMU_JOINTS, state->coordinates);
    (void)copy(from, FMU_JOINTS, state->rates);
}

static void set_state(struct precess_fmu *fmu, const struct FMU_SOLVER_STATE *state)
{
    double *const to = fmu->values + FMU_STATE;

    (void)copy(state->r_b_n, 3, to);
    (void)copy(state->r_b_n_dot, 3, to + 3);
    (void)copy(state->attitude, 4, to + 6);
    (void)copy(state->omega, 3, to + 10);
    (void)copy(state->coordinates, FMU_JOINTS, to + 13);
    (void)copy(state->rates, FMU_JOINTS, to + 13 + FMU_JOINTS);
}

static void inputs_of(const struct precess_fmu *fmu, struct FMU_SOLVER_INPUTS *inputs)
{
    static const struct FMU_SOLVER_INPUTS NONE;
    const double *const from = fmu->values + FMU_INPUT;
    const double *const gravity = fmu->values + FMU_PARAMETER + 1;
    int k;

    *inputs = NONE;
    (void)copy(from, 3, inputs->force);
    (void)copy(from + 3, 3, inputs->torque_b);
    for (k = 0; k < FMU_JOINTS; k++) {
        const double given = precess_fmu_inputs[k] < 0 ? 0.0 : from[6 + precess_fmu_inputs[k]];

        inputs->joints[k].mode = precess_fmu_modes[k];
        inputs->joints[k].torque = precess_fmu_modes[k] == PRECESS_DRIVEN ? given : 0.0;
        inputs->joints[k].acceleration = precess_fmu_modes[k] == PRECESS_PRESCRIBED ? given : 0.0;
    }
    inputs->hub.freedom = FMU_HUB;
    inputs->gravity.field = FMU_FIELD;
    (void)copy(gravity, 3, inputs->gravity.uniform);
    inputs->gravity.mu = gravity[3];
}

enum precess_status precess_fmu_evaluate(struct precess_fmu *fmu)
{
    struct FMU_SOLVER_STATE state;
    struct FMU_SOLVER_INPUTS inputs;
    struct FMU_SOLVER_ACCELERATIONS found;
    struct precess_matrix bn;
    double *const to = fmu->values + FMU_DERIVATIVE;
    enum precess_status status = prepare(fmu);

    if (status != PRECESS_OK) {
        return status;
    }
    state_of(fmu, &state);
    inputs_of(fmu, &inputs);
    status = FMU_SOLVER_EVALUATE(&fmu->spacecraft, &state, &inputs, &found);
    if (status != PRECESS_OK) {
        return status;
    }
    precess_attitude_dcm(PRECESS_QUATERNION, state.attitude, &bn);
    (void)copy(state.r_b_n_dot, 3, to);
    precess_rotate_transposed(&bn, found.r_b_n_ddot, to + 3);
    precess_attitude_rate(PRECESS_QUATERNION, state.attitude, state.omega, to + 6);
    (void)copy(found.omega_dot, 3, to + 10);
    (void)copy(state.rates, FMU_JOINTS, to + 13);
    (void)copy(found.joints, FMU_JOINTS, to + 13 + FMU_JOINTS);
    return PRECESS_OK;
}

enum precess_status precess_fmu_advance(struct precess_fmu *fmu, double duration)
{
    const double longest = fmu->values[FMU_PARAMETER];
    const double ratio = duration / longest;
    struct FMU_SOLVER_STATE state;
    struct FMU_SOLVER_INPUTS inputs;
    enum precess_status status = prepare(fmu);
    long count;
    long k;

    if (status != PRECESS_OK) {
        return status;
    }
    if (!(longest > 0.0) || !(duration >= 0.0) || !(ratio < 1e9)) {
        return PRECESS_BAD_INPUT;
    }
    count = (long)ratio;
    /* A part of a step that is only rounding is none. */
    if (ratio - (double)count > 1e-9 * ratio) {
        count = count + 1;
    }
    state_of(fmu, &state);
    inputs_of(fmu, &inputs);
    for (k = 0; k < count; k++) {
        status = FMU_SOLVER_STEP(
            &fmu->spacecraft, &state, &inputs, duration / (double)count, &state);
        if (status != PRECESS_OK) {
            return status;
        }
        FMU_SOLVER_WRAP(&fmu->spacecraft, &state, &state);
    }
    set_state(fmu, &state);
    return PRECESS_OK;
}

const char *precess_fmu_message(enum precess_status status)
{
    switch (status) {
    case PRECESS_OK:
        return "well";
    case PRECESS_BAD_PARAMETER:
        return "a parameter of hub or device is none that its kind can have; check masses, inertias and mounts";
    case PRECESS_BAD_INPUT:
        return "a state, an input or the step is infinite, NaN, or no step; check what is set";
    case PRECESS_BAD_ANGLE:
        return "an angle is beyond 2^24 rad; take whole turns from it";
    case PRECESS_NO_INERTIA:
        return "a driven joint, or the hub, has no inertia; check masses and inertias";
    case PRECESS_OVERFLOWS:
        return "a result overflows; check rates, inputs and the step";
    case PRECESS_LOCKED_MOVES:
        return "a locked joint has a rate; set it to zero";
    case PRECESS_FIXED_MOVES:
        return "the fixed hub has a velocity; set it to zero";
    case PRECESS_NOT_DRIVEN:
        return "a joint without a motor is driven";
    case PRECESS_AT_CENTRE:
        return "the spacecraft is at the centre of the central body";
    case PRECESS_UNSTABLE:
        return "the step is too long for a spring, a damper or friction; make the parameter step smaller";
    }
    return "unknown status";
}
