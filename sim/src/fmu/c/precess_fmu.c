/* Compile with -std=c99 -ffp-contract=off. */

#include <float.h>

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

void precess_fmu_forget(struct precess_fmu *fmu)
{
    fmu->is_prepared = 0;
}

void precess_fmu_release(struct precess_fmu *fmu)
{
    (void)fmu;
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

        from = copy(from, 3, force);
        from = copy(from, 3, moment);
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

static void inputs_of(
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
        (void)copy(from, 3, inputs->hub.r_b_n_ddot);
        (void)copy(from + 3, 3, inputs->hub.omega_dot);
    } else {
        (void)copy(from, 3, inputs->force);
        (void)copy(from + 3, 3, inputs->torque_b);
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
    (void)copy(gravity, 3, inputs->gravity.uniform);
    inputs->gravity.mu = gravity[3];
    if (FMU_WRENCHES > 0) {
        add_wrenches(from + 6 + FMU_DRIVEN, state, inputs);
    }
}

/* Sets the rates to zero that are: of locked joints, and of a hub that is fixed. An integrator may vary them. */
static void hold(struct FMU_SOLVER_STATE *state)
{
    const enum precess_hub_freedom freedom = FMU_HUB;
    static const double ZERO[3] = { 0.0, 0.0, 0.0 };
    int k;

    if (freedom == PRECESS_HUB_FIXED) {
        (void)copy(ZERO, 3, state->r_b_n_dot);
        (void)copy(ZERO, 3, state->omega);
    }
    for (k = 0; k < FMU_JOINTS; k++) {
        if (precess_fmu_joints[k].mode == PRECESS_LOCKED) {
            state->rates[k] = 0.0;
        }
    }
}

enum precess_status precess_fmu_check(struct precess_fmu *fmu)
{
    struct FMU_SOLVER_STATE state;
    struct FMU_SOLVER_INPUTS inputs;
    struct FMU_SOLVER_ACCELERATIONS found;
    const enum precess_status status = prepare(fmu);

    if (status != PRECESS_OK) {
        return status;
    }
    state_of(fmu, &state);
    inputs_of(fmu, &state, &inputs);
    return FMU_SOLVER_EVALUATE(&fmu->spacecraft, &state, &inputs, &found);
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
    hold(&state);
    inputs_of(fmu, &state, &inputs);
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

/* How many steps a duration takes, and how long each is. */
static long steps_of(double start, double duration, double step, double *length)
{
    const double ratio = duration / step;
    const long nearest = (long)(ratio + 0.5);
    const double rest = precess_magnitude(duration - (double)nearest * step);
    /* The duration is a difference of two times, each of which is rounded. */
    const double rounding = 8.0 * DBL_EPSILON * (precess_magnitude(start) + duration);
    const long count = (long)ratio + 1;

    if (rest <= rounding) {
        *length = step;
        return nearest;
    }
    *length = duration / (double)count;
    return count;
}

/* Whether a joint is beyond an end stop. */
static int is_beyond(const double *coordinates)
{
    int k;

    for (k = 0; k < FMU_JOINTS; k++) {
        if (coordinates[k] < precess_fmu_joints[k].lower
            || coordinates[k] > precess_fmu_joints[k].upper) {
            return 1;
        }
    }
    return 0;
}

int precess_fmu_is_stopped(const struct precess_fmu *fmu)
{
    return is_beyond(fmu->values + FMU_STATE + 13);
}

/* Whether an angle is so large that it is wrapped: of a joint without an end stop, which counts the turns. */
static int is_large(const double *coordinates, int joint)
{
    const struct precess_fmu_joint *const of = &precess_fmu_joints[joint];

    return precess_magnitude(coordinates[joint]) > FMU_LARGE_ANGLE
        && of->lower <= -DBL_MAX && of->upper >= DBL_MAX;
}

/* Wraps the angles that are so large, and no other: one that jumped beside them would seem to have turned. */
static void wrap_large(const struct precess_fmu *fmu, struct FMU_SOLVER_STATE *state)
{
    struct FMU_SOLVER_STATE wrapped;
    int is_wrapped = 0;
    int k;

    for (k = 0; k < FMU_JOINTS; k++) {
        if (is_large(state->coordinates, k)) {
            if (!is_wrapped) {
                FMU_SOLVER_WRAP(&fmu->spacecraft, state, &wrapped);
                is_wrapped = 1;
            }
            state->coordinates[k] = wrapped.coordinates[k];
        }
    }
}

enum precess_status precess_fmu_advance(
    struct precess_fmu *fmu, double start, double duration, int *is_stopped)
{
    const double step = fmu->values[FMU_PARAMETER];
    struct FMU_SOLVER_STATE state;
    struct FMU_SOLVER_INPUTS inputs;
    enum precess_status status = prepare(fmu);
    long count, k;
    double length;

    *is_stopped = 0;
    if (status != PRECESS_OK) {
        return status;
    }
    if (!(step > 0.0) || !(duration >= 0.0) || !(duration / step < 1e9)) {
        return PRECESS_BAD_INPUT;
    }
    count = steps_of(start, duration, step, &length);
    state_of(fmu, &state);
    for (k = 0; k < count; k++) {
        inputs_of(fmu, &state, &inputs);
        status = FMU_SOLVER_STEP(&fmu->spacecraft, &state, &inputs, length, &state);
        if (status != PRECESS_OK) {
            return status;
        }
        if (is_beyond(state.coordinates)) {
            *is_stopped = 1;
            return PRECESS_OK;
        }
        wrap_large(fmu, &state);
    }
    set_state(fmu, &state);
    return PRECESS_OK;
}

int precess_fmu_is_to_wrap(struct precess_fmu *fmu)
{
    const double *const coordinates = fmu->values + FMU_STATE + 13;
    struct FMU_SOLVER_STATE state;
    int k;

    for (k = 0; k < FMU_JOINTS && !is_large(coordinates, k); k++) {
    }
    if (k == FMU_JOINTS || prepare(fmu) != PRECESS_OK) {
        return 0;
    }
    state_of(fmu, &state);
    wrap_large(fmu, &state);
    for (k = 0; k < FMU_JOINTS; k++) {
        if (state.coordinates[k] != coordinates[k]) {
            return 1;
        }
    }
    return 0;
}

enum precess_status precess_fmu_wrap(struct precess_fmu *fmu)
{
    struct FMU_SOLVER_STATE state;
    const enum precess_status status = prepare(fmu);

    if (status == PRECESS_OK) {
        state_of(fmu, &state);
        wrap_large(fmu, &state);
        set_state(fmu, &state);
    }
    return status;
}
