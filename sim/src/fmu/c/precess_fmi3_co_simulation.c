/* FMI 3.0 of precess_instance.h: Co-Simulation; Scheduled Execution there is none. Inputs are held over each step of
 * the solver. */

#include "precess_fmi3.h"

fmi3Status fmi3EnterStepMode(fmi3Instance instance)
{
    return precess_fmi3_answer(instance, "this unit has no event mode in Co-Simulation: it is in step mode");
}

fmi3Status fmi3GetOutputDerivatives(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    const fmi3Int32 orders[],
    fmi3Float64 values[],
    size_t value_count)
{
    (void)vr;
    (void)count;
    (void)orders;
    (void)values;
    (void)value_count;
    return precess_fmi3_answer(instance, NO_OUTPUT_DERIVATIVES);
}

/* A step that a joint's end stop discards ends the simulation: the state stays that before it. */
fmi3Status fmi3DoStep(
    fmi3Instance instance,
    fmi3Float64 point,
    fmi3Float64 size,
    fmi3Boolean no_earlier,
    fmi3Boolean *needs_event,
    fmi3Boolean *is_end,
    fmi3Boolean *is_early,
    fmi3Float64 *time)
{
    const struct precess_fmi3 *const of = instance;
    int is_stopped = 0;
    const char *const why = needs_event && is_end && is_early && time
        ? precess_instance_step(instance, point, size, &is_stopped)
        : IS_NULL;

    (void)no_earlier;
    if (why && !is_stopped) {
        return precess_fmi3_answer(instance, why);
    }
    if (is_stopped) {
        precess_fmi3_end(instance);
    }
    *needs_event = fmi3False;
    *is_end = is_stopped != 0;
    *is_early = is_stopped && of->may_return_early;
    *time = of->instance.state.fmu.values[0];
    return fmi3OK;
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)clock;
    (void)time;
    return precess_fmi3_answer(instance, "this unit has no model partitions");
}
