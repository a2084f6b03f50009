/* Compile with -std=c99 -ffp-contract=off. */

#include <stdlib.h>
#include <string.h>

#include "precess_fmu.h"

void precess_fmu_reset(struct precess_fmu *fmu)
{
    precess_fmu_release(fmu);
    memcpy(fmu->values, precess_fmu_start, sizeof fmu->values);
    fmu->is_over = 0;
    fmu->why[0] = '\0';
}

void precess_fmu_forget(struct precess_fmu *fmu)
{
    (void)fmu;
}

void precess_fmu_release(struct precess_fmu *fmu)
{
    precess_engine_free(fmu->engine);
    fmu->engine = NULL;
    free(fmu->saved);
    fmu->saved = NULL;
    fmu->saved_size = 0;
}

/* Begins the run where there is none. */
static int has_engine(struct precess_fmu *fmu)
{
    if (!fmu->engine) {
        fmu->engine = precess_engine_new(
            precess_fmu_scenario, precess_fmu_scenario_size, fmu->why, sizeof fmu->why);
    }
    return fmu->engine != NULL;
}

/* Bytes of a run in the place of those that a saved instance has. */
static int keep(struct precess_fmu *saved, const unsigned char *bytes, size_t size)
{
    unsigned char *const kept = malloc(size);

    if (!kept) {
        return 0;
    }
    memcpy(kept, bytes, size);
    precess_fmu_release(saved);
    saved->saved = kept;
    saved->saved_size = size;
    return 1;
}

enum precess_status precess_fmu_save(struct precess_fmu *fmu, struct precess_fmu *saved)
{
    static const char NO_MEMORY[] = "no memory for a state";
    size_t size = 0;

    if (!fmu->engine) {
        precess_fmu_release(saved);
    } else {
        const unsigned char *const bytes = precess_engine_save(fmu->engine, &size, fmu->why, sizeof fmu->why);

        if (!bytes) {
            return PRECESS_REFUSED;
        }
        if (!keep(saved, bytes, size)) {
            memcpy(fmu->why, NO_MEMORY, sizeof NO_MEMORY);
            return PRECESS_REFUSED;
        }
    }
    memcpy(saved->values, fmu->values, sizeof saved->values);
    saved->is_over = fmu->is_over;
    return PRECESS_OK;
}

enum precess_status precess_fmu_restore(struct precess_fmu *fmu, const struct precess_fmu *saved)
{
    if (!saved->saved) {
        precess_fmu_release(fmu);
    } else if (
        !has_engine(fmu)
        || !precess_engine_restore(
            fmu->engine, saved->saved, saved->saved_size, fmu->why, sizeof fmu->why)) {
        return PRECESS_REFUSED;
    }
    memcpy(fmu->values, saved->values, sizeof fmu->values);
    fmu->is_over = saved->is_over;
    return PRECESS_OK;
}

/* Whether the run has ended, how many bytes, and these. */
#define REST (1 + sizeof(size_t))

size_t precess_fmu_rest_size(const struct precess_fmu *saved)
{
    return REST + saved->saved_size;
}

void precess_fmu_write_rest(const struct precess_fmu *saved, unsigned char *bytes)
{
    bytes[0] = saved->is_over != 0;
    memcpy(bytes + 1, &saved->saved_size, sizeof saved->saved_size);
    if (saved->saved) {
        memcpy(bytes + REST, saved->saved, saved->saved_size);
    }
}

int precess_fmu_read_rest(struct precess_fmu *saved, const unsigned char *bytes, size_t size)
{
    size_t run;

    /* An output may be NaN: what has not been measured yet. */
    if (size < REST || bytes[0] > 1 || !precess_is_finite(saved->values[0])
        || !precess_are_finite(saved->values + FMU_INPUT, FMU_INPUTS)) {
        return 0;
    }
    memcpy(&run, bytes + 1, sizeof run);
    if (run > size - REST || (run && !keep(saved, bytes + REST, run))) {
        return 0;
    }
    saved->is_over = bytes[0];
    return 1;
}

enum precess_status precess_fmu_check(struct precess_fmu *fmu)
{
    static const char LATE[] = "a scenario starts at 0 s; set the start time to that";

    if (fmu->values[0] != 0.0) {
        memcpy(fmu->why, LATE, sizeof LATE);
        return PRECESS_REFUSED;
    }
    return precess_fmu_evaluate(fmu);
}

enum precess_status precess_fmu_evaluate(struct precess_fmu *fmu)
{
    return has_engine(fmu)
            && precess_engine_outputs(
                fmu->engine, fmu->values + FMU_INPUT, FMU_INPUTS, fmu->values + FMU_STATE, FMU_OUTPUTS,
                fmu->why, sizeof fmu->why)
        ? PRECESS_OK
        : PRECESS_REFUSED;
}

enum precess_status precess_fmu_jvp(struct precess_fmu *fmu, const double *direction, double *along)
{
    static const char NONE[] = "a run has no derivatives";

    (void)direction;
    (void)along;
    memcpy(fmu->why, NONE, sizeof NONE);
    return PRECESS_REFUSED;
}

enum precess_status precess_fmu_advance(
    struct precess_fmu *fmu, double start, double duration, int *is_stopped)
{
    *is_stopped = 0;
    if (!has_engine(fmu)
        || !precess_engine_advance(
            fmu->engine, fmu->values + FMU_INPUT, FMU_INPUTS, start + duration, &fmu->is_over, fmu->why,
            sizeof fmu->why)) {
        return PRECESS_REFUSED;
    }
    *is_stopped = fmu->is_over;
    return PRECESS_OK;
}

int precess_fmu_is_stopped(const struct precess_fmu *fmu)
{
    return fmu->is_over;
}

int precess_fmu_is_to_wrap(struct precess_fmu *fmu)
{
    (void)fmu;
    return 0;
}

enum precess_status precess_fmu_wrap(struct precess_fmu *fmu)
{
    (void)fmu;
    return PRECESS_OK;
}

const char *precess_fmu_message(
    const struct precess_fmu *fmu, enum precess_status status, char said[FMU_MESSAGE])
{
    (void)said;
    return status == PRECESS_OK ? "well" : fmu->why;
}

double precess_magnitude(double x)
{
    return x < 0.0 ? -x : x;
}

int precess_is_finite(double x)
{
    return x - x == 0.0;
}

int precess_are_finite(const double *numbers, int count)
{
    int k;

    for (k = 0; k < count; k++) {
        if (!precess_is_finite(numbers[k])) {
            return 0;
        }
    }
    return 1;
}
