/* FMI 2.0 of precess_fmu.h: Model Exchange. */

#include <string.h>

#include "precess_fmi2.h"

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    return precess_fmi2_enter(c, IN(PHASE_CONTINUOUS) | IN(PHASE_EVENT), PHASE_EVENT);
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    struct precess_fmi2 *const of = c;

    if (!info || !precess_fmi2_is_in(of, IN(PHASE_EVENT))) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    info->newDiscreteStatesNeeded = fmi2False;
    info->terminateSimulation = fmi2False;
    info->nominalsOfContinuousStatesChanged = fmi2False;
    info->valuesOfContinuousStatesChanged = fmi2False;
    if (precess_fmu_is_to_wrap(&of->state.fmu)) {
        const fmi2Status status = precess_fmi2_status(of, precess_fmu_wrap(&of->state.fmu));

        if (status != fmi2OK) {
            return status;
        }
        info->valuesOfContinuousStatesChanged = fmi2True;
    }
    info->nextEventTimeDefined = fmi2False;
    info->nextEventTime = 0.0;
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    return precess_fmi2_enter(c, IN(PHASE_EVENT), PHASE_CONTINUOUS);
}

fmi2Status fmi2CompletedIntegratorStep(
    fmi2Component c, fmi2Boolean no_earlier, fmi2Boolean *enter_event_mode, fmi2Boolean *terminate)
{
    struct precess_fmi2 *const of = c;

    (void)no_earlier;
    if (!enter_event_mode || !terminate || !precess_fmi2_is_in(of, IN(PHASE_CONTINUOUS))) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    *enter_event_mode = precess_fmu_is_to_wrap(&of->state.fmu) ? fmi2True : fmi2False;
    *terminate = fmi2False;
    if (precess_fmu_is_stopped(&of->state.fmu)) {
        (void)precess_fmi2_refuse(of, IS_STOPPED);
        *terminate = fmi2True;
    }
    return fmi2OK;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    struct precess_fmi2 *const of = c;

    if (!precess_fmi2_is_in(of, IN(PHASE_EVENT) | IN(PHASE_CONTINUOUS)) || !precess_is_finite(time)) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    of->state.fmu.values[0] = time;
    return fmi2OK;
}

/* Whether an array of all states may be read or written. */
static int has_states(const struct precess_fmi2 *of, unsigned phases, const fmi2Real x[], size_t count)
{
    return x && count == FMU_STATES && precess_fmi2_is_in(of, phases);
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t count)
{
    struct precess_fmi2 *const of = c;

    if (!has_states(of, IN(PHASE_CONTINUOUS), x, count)) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    if (!precess_are_finite(x, FMU_STATES)) {
        return precess_fmi2_refuse(of, "a state is not finite");
    }
    memcpy(of->state.fmu.values + FMU_STATE, x, FMU_STATES * sizeof *x);
    return fmi2OK;
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t count)
{
    struct precess_fmi2 *const of = c;
    fmi2Status status;

    if (!has_states(of, ALL, derivatives, count) || of->type != fmi2ModelExchange) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    status = precess_fmi2_status(of, precess_fmu_evaluate(&of->state.fmu));
    if (status == fmi2OK) {
        memcpy(derivatives, of->state.fmu.values + FMU_DERIVATIVE, FMU_STATES * sizeof *derivatives);
    }
    return status;
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t count)
{
    (void)indicators;
    return c && count == 0 ? fmi2OK : precess_fmi2_refuse(c, "there are no event indicators");
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t count)
{
    struct precess_fmi2 *const of = c;

    if (!has_states(of, ALL, x, count) || of->type != fmi2ModelExchange) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    memcpy(x, of->state.fmu.values + FMU_STATE, FMU_STATES * sizeof *x);
    return fmi2OK;
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominal[], size_t count)
{
    struct precess_fmi2 *const of = c;
    size_t k;

    if (!has_states(of, ALL, nominal, count)) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    for (k = 0; k < count; k++) {
        nominal[k] = precess_fmu_nominal[k];
    }
    return fmi2OK;
}

fmi2Status fmi2GetDirectionalDerivative(
    fmi2Component c,
    const fmi2ValueReference unknowns[],
    size_t unknown_count,
    const fmi2ValueReference knowns[],
    size_t known_count,
    const fmi2Real seed[],
    fmi2Real sensitivity[])
{
    (void)unknowns;
    (void)unknown_count;
    (void)knowns;
    (void)known_count;
    (void)seed;
    (void)sensitivity;
    return precess_fmi2_refuse(c, "this unit has no directional derivatives");
}
