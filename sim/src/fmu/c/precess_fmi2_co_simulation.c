/* FMI 2.0 of precess_fmu.h: Co-Simulation. Inputs are held over each step of the solver. */

#include "precess_fmi2.h"

#define NO_STATUS "steps are complete when fmi2DoStep returns; asked may be the last time and whether the unit has ended"

fmi2Status fmi2SetRealInputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr;
    (void)count;
    (void)order;
    (void)value;
    return precess_fmi2_refuse(c, "inputs are held over a step");
}

fmi2Status fmi2GetRealOutputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], fmi2Real value[])
{
    (void)vr;
    (void)count;
    (void)order;
    (void)value;
    return precess_fmi2_refuse(c, "the derivatives of outputs are variables of their own");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real point, fmi2Real size, fmi2Boolean no_earlier)
{
    struct precess_fmi2 *const of = c;
    fmi2Status status;
    double *time;
    double off;

    (void)no_earlier;
    if (!precess_fmi2_is_in(of, IN(PHASE_STEPPING))) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    time = &of->state.fmu.values[0];
    off = precess_magnitude(point - *time);
    /* Times that are sums of steps differ by rounding. */
    if (!(size >= 0.0) || !(off <= 1e-9 * (1.0 + precess_magnitude(point)))
        || !precess_is_finite(point + size)) {
        return precess_fmi2_refuse(
            of,
            "the step does not start where the last one ended, or its size is negative or not finite");
    }
    status = precess_fmi2_status(
        of, precess_fmu_advance(&of->state.fmu, point, size, &of->is_stopped));
    if (of->is_stopped) {
        (void)precess_fmi2_refuse(of, IS_STOPPED);
        return fmi2Discard;
    }
    if (status == fmi2OK) {
        *time = point + size;
    }
    return status;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return precess_fmi2_refuse(c, NO_STATUS);
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind;
    (void)value;
    return precess_fmi2_refuse(c, NO_STATUS);
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    const struct precess_fmi2 *const of = c;

    if (!of || !value || kind != fmi2LastSuccessfulTime) {
        return precess_fmi2_refuse(of, NO_STATUS);
    }
    *value = of->state.fmu.values[0];
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind;
    (void)value;
    return precess_fmi2_refuse(c, NO_STATUS);
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    const struct precess_fmi2 *const of = c;

    if (!of || !value || kind != fmi2Terminated) {
        return precess_fmi2_refuse(of, NO_STATUS);
    }
    *value = of->is_stopped ? fmi2True : fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind;
    (void)value;
    return precess_fmi2_refuse(c, NO_STATUS);
}
