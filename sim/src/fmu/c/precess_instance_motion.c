/* An instance in motion: steps of Co-Simulation, in which inputs are held, and what Model Exchange integrates. */

#include <string.h>

#include "precess_instance.h"

const char *precess_instance_step(struct precess_instance *of, double point, double size, int *is_end)
{
    const char *why;
    double *time;
    double off;

    *is_end = 0;
    if (!precess_instance_is_in(of, IN(PHASE_STEPPING))) {
        return OUT_OF_ORDER;
    }
    time = &of->state.fmu.values[0];
    off = precess_magnitude(point - *time);
    /* Times that are sums of steps differ by rounding. */
    if (!(size >= 0.0) || !(off <= 1e-9 * (1.0 + precess_magnitude(point)))
        || !precess_is_finite(point + size)) {
        return "the step does not start where the last one ended, or its size is negative or not finite";
    }
    why = precess_instance_why(
        of, precess_fmu_advance(&of->state.fmu, point, size, &of->is_stopped));
    *is_end = of->is_stopped;
    if (*is_end) {
        return IS_STOPPED;
    }
    if (!why) {
        *time = point + size;
    }
    return why;
}

const char *precess_instance_event(struct precess_instance *of, int *is_changed)
{
    if (!is_changed || !precess_instance_is_in(of, IN(PHASE_EVENT))) {
        return OUT_OF_ORDER;
    }
    *is_changed = precess_fmu_is_to_wrap(&of->state.fmu);
    return *is_changed ? precess_instance_why(of, precess_fmu_wrap(&of->state.fmu)) : NULL;
}

const char *precess_instance_completed(struct precess_instance *of, int *is_event, int *is_end)
{
    if (!is_event || !is_end || !precess_instance_is_in(of, IN(PHASE_CONTINUOUS))) {
        return OUT_OF_ORDER;
    }
    *is_event = precess_fmu_is_to_wrap(&of->state.fmu);
    *is_end = precess_fmu_is_stopped(&of->state.fmu);
    return NULL;
}

const char *precess_instance_set_time(struct precess_instance *of, double time)
{
    if (!precess_instance_is_in(of, IN(PHASE_EVENT) | IN(PHASE_CONTINUOUS)) || !precess_is_finite(time)) {
        return OUT_OF_ORDER;
    }
    of->state.fmu.values[0] = time;
    return NULL;
}

/* Whether an array of all states may be read or written. */
static int has_states(const struct precess_instance *of, unsigned phases, const double x[], size_t count)
{
    return x && count == FMU_STATES && precess_instance_is_in(of, phases);
}

const char *precess_instance_set_states(struct precess_instance *of, const double x[], size_t count)
{
    if (!has_states(of, IN(PHASE_CONTINUOUS), x, count)) {
        return OUT_OF_ORDER;
    }
    if (!precess_are_finite(x, FMU_STATES)) {
        return "a state is not finite";
    }
    memcpy(of->state.fmu.values + FMU_STATE, x, FMU_STATES * sizeof *x);
    return NULL;
}

const char *precess_instance_states(struct precess_instance *of, double x[], size_t count)
{
    if (!has_states(of, ALL, x, count) || !of->is_exchange) {
        return OUT_OF_ORDER;
    }
    memcpy(x, of->state.fmu.values + FMU_STATE, FMU_STATES * sizeof *x);
    return NULL;
}

const char *precess_instance_derivatives(struct precess_instance *of, double rates[], size_t count)
{
    const char *why;

    if (!has_states(of, ALL, rates, count) || !of->is_exchange) {
        return OUT_OF_ORDER;
    }
    why = precess_instance_why(of, precess_fmu_evaluate(&of->state.fmu));
    if (!why) {
        memcpy(rates, of->state.fmu.values + FMU_DERIVATIVE, FMU_STATES * sizeof *rates);
    }
    return why;
}

const char *precess_instance_nominals(struct precess_instance *of, double nominal[], size_t count)
{
    size_t k;

    if (!has_states(of, ALL, nominal, count)) {
        return OUT_OF_ORDER;
    }
    for (k = 0; k < count; k++) {
        nominal[k] = precess_fmu_nominal[k];
    }
    return NULL;
}
