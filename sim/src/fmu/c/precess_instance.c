/* Life of an instance, and its variables. Compile with -std=c99 -ffp-contract=off. */

#include <string.h>

#include "precess_instance.h"

int precess_instance_is_token(const char *token)
{
    return token && strcmp(token, FMU_TOKEN) == 0;
}

void precess_instance_begin(struct precess_instance *of, int is_exchange, int sets_each_state)
{
    of->is_exchange = is_exchange;
    of->sets_each_state = sets_each_state;
    of->is_stopped = 0;
    of->state.phase = PHASE_INSTANTIATED;
    precess_fmu_reset(&of->state.fmu);
}

void precess_instance_end(struct precess_instance *of)
{
    precess_fmu_release(&of->state.fmu);
}

const char *precess_instance_reset(struct precess_instance *of)
{
    if (!of) {
        return IS_NULL;
    }
    precess_instance_begin(of, of->is_exchange, of->sets_each_state);
    return NULL;
}

int precess_instance_is_in(const struct precess_instance *of, unsigned phases)
{
    return of && (phases >> (unsigned)of->state.phase & 1u);
}

const char *precess_instance_enter(struct precess_instance *of, unsigned from, enum precess_phase to)
{
    if (!precess_instance_is_in(of, from)) {
        return OUT_OF_ORDER;
    }
    of->state.phase = to;
    return NULL;
}

const char *precess_instance_why(struct precess_instance *of, enum precess_status status)
{
    return status == PRECESS_OK ? NULL : precess_fmu_message(&of->state.fmu, status, of->said);
}

const char *precess_instance_set_start(
    struct precess_instance *of, double start, int has_stop, double stop)
{
    if (!precess_instance_is_in(of, IN(PHASE_INSTANTIATED))) {
        return OUT_OF_ORDER;
    }
    if (!precess_is_finite(start) || (has_stop && !(stop >= start))) {
        return "the start is not finite, or the stop is before it";
    }
    of->state.fmu.values[0] = start;
    return NULL;
}

const char *precess_instance_initialise(struct precess_instance *of)
{
    const char *why;

    if (!precess_instance_is_in(of, IN(PHASE_INITIALISING))) {
        return OUT_OF_ORDER;
    }
    if (precess_fmu_is_stopped(&of->state.fmu)) {
        return IS_STOPPED;
    }
    why = precess_instance_why(of, precess_fmu_check(&of->state.fmu));
    if (!why) {
        of->state.phase = of->is_exchange ? PHASE_EVENT : PHASE_STEPPING;
    }
    return why;
}

const char *precess_instance_get(
    struct precess_instance *of, const precess_reference vr[], size_t count, double value[])
{
    int evaluated = 0;
    size_t k;

    if (!of || (count && (!vr || !value))) {
        return IS_NULL;
    }
    for (k = 0; k < count; k++) {
        if (vr[k] >= FMU_VALUES) {
            return "no variable has this value reference";
        }
        if (vr[k] >= FMU_DERIVATIVE && vr[k] < FMU_INPUT && !evaluated) {
            const char *const why = precess_instance_why(of, precess_fmu_evaluate(&of->state.fmu));

            if (why) {
                return why;
            }
            evaluated = 1;
        }
        value[k] = of->state.fmu.values[vr[k]];
    }
    return NULL;
}

/* Why a variable may not be set now; null where it may. */
static const char *forbidden(const struct precess_instance *of, precess_reference vr)
{
    const int before = precess_instance_is_in(of, BEFORE);

    if (vr >= FMU_VALUES) {
        return "no variable has this value reference";
    }
    if (vr < FMU_STATE || (vr >= FMU_DERIVATIVE && vr < FMU_INPUT)) {
        return "time and derivatives are computed";
    }
    if (vr < FMU_DERIVATIVE) {
        const unsigned later = of->sets_each_state ? IN(PHASE_EVENT) | IN(PHASE_CONTINUOUS) : 0u;

        return precess_instance_is_in(of, BEFORE | later)
            ? NULL
            : "a state is set before the end of initialisation, later by the importer's integrator";
    }
    if (vr < FMU_PARAMETER) {
        return precess_instance_is_in(of, BEFORE | RUNNING) ? NULL : OUT_OF_ORDER;
    }
    if (vr == FMU_PARAMETER || (vr >= FMU_PARAMETER + 15 && vr < FMU_PARAMETER + 15 + 9 * FMU_DEVICES)) {
        return before ? NULL : "a fixed parameter is set before the end of initialisation";
    }
    return precess_instance_is_in(of, BEFORE | IN(PHASE_EVENT) | IN(PHASE_STEPPING))
        ? NULL
        : "a tunable parameter is set in event mode or between steps";
}

const char *precess_instance_set(
    struct precess_instance *of, const precess_reference vr[], size_t count, const double value[])
{
    size_t k;

    if (!of || (count && (!vr || !value))) {
        return IS_NULL;
    }
    for (k = 0; k < count; k++) {
        const char *const why = precess_is_finite(value[k]) ? forbidden(of, vr[k]) : "the value is not finite";

        if (why) {
            return why;
        }
    }
    for (k = 0; k < count; k++) {
        of->state.fmu.values[vr[k]] = value[k];
        if (vr[k] >= FMU_PARAMETER) {
            precess_fmu_forget(&of->state.fmu);
        }
    }
    return NULL;
}
