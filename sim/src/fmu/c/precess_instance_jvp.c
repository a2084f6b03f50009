/* Derivatives of an instance: along directions, and of weighed sums. */

#include <string.h>

#include "precess_instance.h"

/* Why there are no derivatives now, or of these variables; null where there are. */
static const char *unavailable(
    const struct precess_instance *of,
    const precess_reference unknowns[],
    size_t unknown_count,
    const precess_reference knowns[],
    size_t known_count)
{
    size_t k;

    if (!FMU_DERIVES) {
        return NO_DIRECTIONAL;
    }
    if (!of || (unknown_count && !unknowns) || (known_count && !knowns)) {
        return IS_NULL;
    }
    if (!precess_instance_is_in(of, IN(PHASE_INITIALISING) | RUNNING | IN(PHASE_TERMINATED))) {
        return OUT_OF_ORDER;
    }
    for (k = 0; k < unknown_count; k++) {
        if (unknowns[k] < FMU_STATE || unknowns[k] >= FMU_INPUT) {
            return "derivatives are of outputs, which are the states, and of the derivatives of states";
        }
    }
    for (k = 0; k < known_count; k++) {
        if (knowns[k] >= FMU_PARAMETER || (knowns[k] >= FMU_DERIVATIVE && knowns[k] < FMU_INPUT)) {
            return "derivatives are by time, states and inputs; by parameters there are none";
        }
    }
    return NULL;
}

/* What an unknown changes by. */
static double changed(precess_reference unknown, const double *direction, const double *along)
{
    return unknown < FMU_DERIVATIVE ? direction[unknown] : along[unknown - FMU_DERIVATIVE];
}

const char *precess_instance_along(
    struct precess_instance *of,
    const precess_reference unknowns[],
    size_t unknown_count,
    const precess_reference knowns[],
    size_t known_count,
    const double seed[],
    double sensitivity[])
{
    const char *why = unavailable(of, unknowns, unknown_count, knowns, known_count);
    double direction[FMU_VALUES];
    double along[FMU_STATES];
    size_t k;

    if (why) {
        return why;
    }
    if ((known_count && !seed) || (unknown_count && !sensitivity)) {
        return IS_NULL;
    }
    memset(direction, 0, sizeof direction);
    for (k = 0; k < known_count; k++) {
        if (!precess_is_finite(seed[k])) {
            return "a seed is not finite";
        }
        direction[knowns[k]] += seed[k];
    }
    why = precess_instance_why(of, precess_fmu_jvp(&of->state.fmu, direction, along));
    for (k = 0; k < unknown_count && !why; k++) {
        sensitivity[k] = changed(unknowns[k], direction, along);
    }
    return why;
}

const char *precess_instance_gradient(
    struct precess_instance *of,
    const precess_reference unknowns[],
    size_t unknown_count,
    const precess_reference knowns[],
    size_t known_count,
    const double seed[],
    double sensitivity[])
{
    const char *why = unavailable(of, unknowns, unknown_count, knowns, known_count);
    double direction[FMU_VALUES];
    double along[FMU_STATES];
    size_t j, k;

    if (why) {
        return why;
    }
    if ((unknown_count && !seed) || (known_count && !sensitivity)) {
        return IS_NULL;
    }
    memset(direction, 0, sizeof direction);
    for (k = 0; k < known_count; k++) {
        double sum = 0.0;

        direction[knowns[k]] = 1.0;
        why = precess_instance_why(of, precess_fmu_jvp(&of->state.fmu, direction, along));
        if (why) {
            return why;
        }
        for (j = 0; j < unknown_count; j++) {
            sum += seed[j] * changed(unknowns[j], direction, along);
        }
        if (!precess_is_finite(sum)) {
            return "a weighed sum is not finite";
        }
        sensitivity[k] = sum;
        direction[knowns[k]] = 0.0;
    }
    return NULL;
}
