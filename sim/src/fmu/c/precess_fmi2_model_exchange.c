/* FMI 2.0 of precess_instance.h: Model Exchange. */

#include "precess_fmi2.h"

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    return precess_fmi2_answer(
        c, precess_instance_enter(c, IN(PHASE_CONTINUOUS) | IN(PHASE_EVENT), PHASE_EVENT));
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    int is_changed = 0;
    const char *const why = info ? precess_instance_event(c, &is_changed) : IS_NULL;

    if (!why) {
        info->newDiscreteStatesNeeded = fmi2False;
        info->terminateSimulation = fmi2False;
        info->nominalsOfContinuousStatesChanged = fmi2False;
        info->valuesOfContinuousStatesChanged = is_changed ? fmi2True : fmi2False;
        info->nextEventTimeDefined = fmi2False;
        info->nextEventTime = 0.0;
    }
    return precess_fmi2_answer(c, why);
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    return precess_fmi2_answer(c, precess_instance_enter(c, IN(PHASE_EVENT), PHASE_CONTINUOUS));
}

fmi2Status fmi2CompletedIntegratorStep(
    fmi2Component c, fmi2Boolean no_earlier, fmi2Boolean *enter_event_mode, fmi2Boolean *terminate)
{
    int is_event = 0;
    int is_end = 0;
    const char *const why
        = enter_event_mode && terminate ? precess_instance_completed(c, &is_event, &is_end) : IS_NULL;

    (void)no_earlier;
    if (!why) {
        *enter_event_mode = is_event ? fmi2True : fmi2False;
        *terminate = is_end ? fmi2True : fmi2False;
        if (is_end) {
            (void)precess_fmi2_answer(c, IS_STOPPED);
        }
    }
    return precess_fmi2_answer(c, why);
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    return precess_fmi2_answer(c, precess_instance_set_time(c, time));
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t count)
{
    return precess_fmi2_answer(c, precess_instance_set_states(c, x, count));
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t count)
{
    return precess_fmi2_answer(c, precess_instance_derivatives(c, derivatives, count));
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t count)
{
    (void)indicators;
    return precess_fmi2_answer(c, c && count == 0 ? NULL : NO_INDICATORS);
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t count)
{
    return precess_fmi2_answer(c, precess_instance_states(c, x, count));
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominal[], size_t count)
{
    return precess_fmi2_answer(c, precess_instance_nominals(c, nominal, count));
}
