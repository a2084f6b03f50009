/* FMI 2.0 of precess_instance.h: Co-Simulation. Inputs are held over each step of the solver. */

#include "precess_fmi2.h"

#define NO_STATUS "steps are complete when fmi2DoStep returns; asked may be the last time and whether the unit has ended"

fmi2Status fmi2SetRealInputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr;
    (void)count;
    (void)order;
    (void)value;
    return precess_fmi2_answer(c, "inputs are held over a step");
}

fmi2Status fmi2GetRealOutputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], fmi2Real value[])
{
    (void)vr;
    (void)count;
    (void)order;
    (void)value;
    return precess_fmi2_answer(c, NO_OUTPUT_DERIVATIVES);
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real point, fmi2Real size, fmi2Boolean no_earlier)
{
    int is_end;
    const fmi2Status status = precess_fmi2_answer(c, precess_instance_step(c, point, size, &is_end));

    (void)no_earlier;
    return is_end ? fmi2Discard : status;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return precess_fmi2_answer(c, NO_STATUS);
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind;
    (void)value;
    return precess_fmi2_answer(c, NO_STATUS);
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    const struct precess_fmi2 *const of = c;

    if (!of || !value || kind != fmi2LastSuccessfulTime) {
        return precess_fmi2_answer(c, NO_STATUS);
    }
    *value = of->instance.state.fmu.values[0];
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind;
    (void)value;
    return precess_fmi2_answer(c, NO_STATUS);
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    const struct precess_fmi2 *const of = c;

    if (!of || !value || kind != fmi2Terminated) {
        return precess_fmi2_answer(c, NO_STATUS);
    }
    *value = of->instance.is_stopped ? fmi2True : fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind;
    (void)value;
    return precess_fmi2_answer(c, NO_STATUS);
}
