/* Compile with -std=c99 -ffp-contract=off. */

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
