/* Compile with -std=c99 -ffp-contract=off. */

#include <float.h>

#include "precess_fmu_solver.h"

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

enum precess_status precess_fmu_save(struct precess_fmu *fmu, struct precess_fmu *saved)
{
    *saved = *fmu;
    return PRECESS_OK;
}

enum precess_status precess_fmu_restore(struct precess_fmu *fmu, const struct precess_fmu *saved)
{
    *fmu = *saved;
    return PRECESS_OK;
}

size_t precess_fmu_rest_size(const struct precess_fmu *saved)
{
    (void)saved;
    return 0;
}

void precess_fmu_write_rest(const struct precess_fmu *saved, unsigned char *bytes)
{
    (void)saved;
    (void)bytes;
}

int precess_fmu_read_rest(struct precess_fmu *saved, const unsigned char *bytes, size_t size)
{
    (void)bytes;
    (void)size;
    return precess_are_finite(saved->values, FMU_VALUES);
}

static void set_state(struct precess_fmu *fmu, const struct FMU_SOLVER_STATE *state)
{
    double *const to = fmu->values + FMU_STATE;

    (void)precess_fmu_copy(state->r_b_n, 3, to);
    (void)precess_fmu_copy(state->r_b_n_dot, 3, to + 3);
    (void)precess_fmu_copy(state->attitude, 4, to + 6);
    (void)precess_fmu_copy(state->omega, 3, to + 10);
    (void)precess_fmu_copy(state->coordinates, FMU_JOINTS, to + 13);
    (void)precess_fmu_copy(state->rates, FMU_JOINTS, to + 13 + FMU_JOINTS);
}

enum precess_status precess_fmu_check(struct precess_fmu *fmu)
{
    struct FMU_SOLVER_STATE state;
    struct FMU_SOLVER_INPUTS inputs;
    struct FMU_SOLVER_ACCELERATIONS found;
    const enum precess_status status = precess_fmu_prepare(fmu);

    if (status != PRECESS_OK) {
        return status;
    }
    precess_fmu_state_of(fmu, &state);
    precess_fmu_inputs_of(fmu, &state, &inputs);
    return FMU_SOLVER_EVALUATE(&fmu->spacecraft, &state, &inputs, &found);
}

enum precess_status precess_fmu_evaluate(struct precess_fmu *fmu)
{
    struct FMU_SOLVER_STATE state;
    struct FMU_SOLVER_INPUTS inputs;
    struct FMU_SOLVER_ACCELERATIONS found;
    struct precess_matrix bn;
    double *const to = fmu->values + FMU_DERIVATIVE;
    enum precess_status status = precess_fmu_prepare(fmu);

    if (status != PRECESS_OK) {
        return status;
    }
    precess_fmu_state_of(fmu, &state);
    precess_fmu_hold(&state);
    precess_fmu_inputs_of(fmu, &state, &inputs);
    status = FMU_SOLVER_EVALUATE(&fmu->spacecraft, &state, &inputs, &found);
    if (status != PRECESS_OK) {
        return status;
    }
    precess_attitude_dcm(PRECESS_QUATERNION, state.attitude, &bn);
    (void)precess_fmu_copy(state.r_b_n_dot, 3, to);
    precess_rotate_transposed(&bn, found.r_b_n_ddot, to + 3);
    precess_attitude_rate(PRECESS_QUATERNION, state.attitude, state.omega, to + 6);
    (void)precess_fmu_copy(found.omega_dot, 3, to + 10);
    (void)precess_fmu_copy(state.rates, FMU_JOINTS, to + 13);
    (void)precess_fmu_copy(found.joints, FMU_JOINTS, to + 13 + FMU_JOINTS);
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
    enum precess_status status = precess_fmu_prepare(fmu);
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
    precess_fmu_state_of(fmu, &state);
    for (k = 0; k < count; k++) {
        precess_fmu_inputs_of(fmu, &state, &inputs);
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
    if (k == FMU_JOINTS || precess_fmu_prepare(fmu) != PRECESS_OK) {
        return 0;
    }
    precess_fmu_state_of(fmu, &state);
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
    const enum precess_status status = precess_fmu_prepare(fmu);

    if (status == PRECESS_OK) {
        precess_fmu_state_of(fmu, &state);
        wrap_large(fmu, &state);
        set_state(fmu, &state);
    }
    return status;
}
