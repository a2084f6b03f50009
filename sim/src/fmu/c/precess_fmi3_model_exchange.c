/* FMI 3.0 of precess_instance.h: Model Exchange. */

#include "precess_fmi3.h"

fmi3Status fmi3EnterEventMode(fmi3Instance instance)
{
    return precess_fmi3_answer(
        instance, precess_instance_enter(instance, IN(PHASE_CONTINUOUS) | IN(PHASE_EVENT), PHASE_EVENT));
}

fmi3Status fmi3UpdateDiscreteStates(
    fmi3Instance instance,
    fmi3Boolean *is_needed_again,
    fmi3Boolean *is_end,
    fmi3Boolean *has_other_nominals,
    fmi3Boolean *has_other_states,
    fmi3Boolean *has_next,
    fmi3Float64 *next)
{
    const int are_given
        = is_needed_again && is_end && has_other_nominals && has_other_states && has_next && next;
    int is_changed = 0;
    const char *const why = are_given ? precess_instance_event(instance, &is_changed) : IS_NULL;

    if (!why) {
        *is_needed_again = fmi3False;
        *is_end = fmi3False;
        *has_other_nominals = fmi3False;
        *has_other_states = is_changed != 0;
        *has_next = fmi3False;
        *next = 0.0;
    }
    return precess_fmi3_answer(instance, why);
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance)
{
    return precess_fmi3_answer(
        instance, precess_instance_enter(instance, IN(PHASE_EVENT), PHASE_CONTINUOUS));
}

fmi3Status fmi3CompletedIntegratorStep(
    fmi3Instance instance, fmi3Boolean no_earlier, fmi3Boolean *enter_event_mode, fmi3Boolean *terminate)
{
    int is_event = 0;
    int is_end = 0;
    const char *const why = enter_event_mode && terminate
        ? precess_instance_completed(instance, &is_event, &is_end)
        : IS_NULL;

    (void)no_earlier;
    if (!why) {
        *enter_event_mode = is_event != 0;
        *terminate = is_end != 0;
        if (is_end) {
            precess_fmi3_end(instance);
        }
    }
    return precess_fmi3_answer(instance, why);
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    return precess_fmi3_answer(instance, precess_instance_set_time(instance, time));
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 x[], size_t count)
{
    return precess_fmi3_answer(instance, precess_instance_set_states(instance, x, count));
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[], size_t count)
{
    return precess_fmi3_answer(instance, precess_instance_derivatives(instance, derivatives, count));
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 indicators[], size_t count)
{
    (void)indicators;
    return precess_fmi3_answer(instance, instance && count == 0 ? NULL : NO_INDICATORS);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 x[], size_t count)
{
    return precess_fmi3_answer(instance, precess_instance_states(instance, x, count));
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t count)
{
    return precess_fmi3_answer(instance, precess_instance_nominals(instance, nominals, count));
}

/* A size of an instance that is there. */
static fmi3Status size_of(fmi3Instance instance, size_t size, size_t *to)
{
    if (!instance || !to) {
        return precess_fmi3_answer(instance, IS_NULL);
    }
    *to = size;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *count)
{
    return size_of(instance, 0, count);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *count)
{
    return size_of(instance, FMU_STATES, count);
}
