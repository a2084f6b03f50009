/* FMI 2.0 of precess_fmu.h: life of an instance, and its variables. Every function of the standard is in one of the files
 * precess_fmi2*.c, also those that this unit does not offer, which return an error. Compile with -std=c99
 * -ffp-contract=off. */

#include <stdlib.h>
#include <string.h>

#include "precess_fmi2.h"

fmi2Status precess_fmi2_refuse(const struct precess_fmi2 *of, const char *text)
{
    if (of && of->log) {
        of->log(of->environment, of->name, fmi2Error, "logStatusError", "%s", text);
    }
    return fmi2Error;
}

fmi2Status precess_fmi2_status(const struct precess_fmi2 *of, enum precess_status status)
{
    const char *const text = precess_fmu_message(status);

    if (status == PRECESS_OK) {
        return fmi2OK;
    }
    if (status == PRECESS_BAD_PARAMETER && of->log) {
        of->log(
            of->environment, of->name, fmi2Error, "logStatusError", "%s: %s",
            precess_fmu_names[of->state.fmu.device], text);
        return fmi2Error;
    }
    return precess_fmi2_refuse(of, text);
}

int precess_fmi2_is_in(const struct precess_fmi2 *of, unsigned phases)
{
    return of && (phases >> (unsigned)of->state.phase & 1u);
}

fmi2Status precess_fmi2_enter(fmi2Component c, unsigned from, enum precess_fmi2_phase to)
{
    struct precess_fmi2 *const of = c;

    if (!precess_fmi2_is_in(of, from)) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    of->state.phase = to;
    return fmi2OK;
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[])
{
    /* There are messages of errors only. */
    (void)on;
    (void)count;
    (void)categories;
    return c ? fmi2OK : fmi2Error;
}

fmi2Component fmi2Instantiate(
    fmi2String name,
    fmi2Type type,
    fmi2String guid,
    fmi2String resources,
    const fmi2CallbackFunctions *callbacks,
    fmi2Boolean visible,
    fmi2Boolean logs)
{
    struct precess_fmi2 *of;
    size_t length;

    (void)resources;
    (void)visible;
    (void)logs;
    if (!callbacks || !name || !guid) {
        return NULL;
    }
    if (strcmp(guid, FMU_TOKEN) != 0 || (type != fmi2ModelExchange && type != fmi2CoSimulation)) {
        if (callbacks->logger) {
            callbacks->logger(
                callbacks->componentEnvironment, name, fmi2Error, "logStatusError", "%s",
                "the guid is not that of these sources, or the type is unknown");
        }
        return NULL;
    }
    length = strlen(name) + 1;
    of = calloc(1, sizeof *of);
    if (of) {
        of->name = malloc(length);
    }
    if (!of || !of->name) {
        free(of);
        return NULL;
    }
    memcpy(of->name, name, length);
    of->type = type;
    of->log = callbacks->logger;
    of->environment = callbacks->componentEnvironment;
    of->state.phase = PHASE_INSTANTIATED;
    precess_fmu_reset(&of->state.fmu);
    return of;
}

void fmi2FreeInstance(fmi2Component c)
{
    struct precess_fmi2 *const of = c;

    if (of) {
        free(of->name);
        free(of);
    }
}

fmi2Status fmi2SetupExperiment(
    fmi2Component c,
    fmi2Boolean has_tolerance,
    fmi2Real tolerance,
    fmi2Real start,
    fmi2Boolean has_stop,
    fmi2Real stop)
{
    struct precess_fmi2 *const of = c;

    /* Of Model Exchange the tolerance is the importer's, of Co-Simulation the parameter `step` sets it. */
    (void)has_tolerance;
    (void)tolerance;
    if (!precess_fmi2_is_in(of, IN(PHASE_INSTANTIATED))) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    if (!precess_is_finite(start) || (has_stop && !(stop >= start))) {
        return precess_fmi2_refuse(of, "the start is not finite, or the stop is before it");
    }
    of->state.fmu.values[0] = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return precess_fmi2_enter(c, IN(PHASE_INSTANTIATED), PHASE_INITIALISING);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    struct precess_fmi2 *const of = c;
    fmi2Status status;

    if (!precess_fmi2_is_in(of, IN(PHASE_INITIALISING))) {
        return precess_fmi2_refuse(of, OUT_OF_ORDER);
    }
    if (precess_fmu_is_stopped(&of->state.fmu)) {
        return precess_fmi2_refuse(of, IS_STOPPED);
    }
    status = precess_fmi2_status(of, precess_fmu_check(&of->state.fmu));
    if (status == fmi2OK) {
        of->state.phase = of->type == fmi2ModelExchange ? PHASE_EVENT : PHASE_STEPPING;
    }
    return status;
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return precess_fmi2_enter(c, RUNNING, PHASE_TERMINATED);
}

fmi2Status fmi2Reset(fmi2Component c)
{
    struct precess_fmi2 *const of = c;

    if (!of) {
        return fmi2Error;
    }
    precess_fmu_reset(&of->state.fmu);
    of->is_stopped = 0;
    of->state.phase = PHASE_INSTANTIATED;
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real value[])
{
    struct precess_fmi2 *const of = c;
    int evaluated = 0;
    size_t k;

    if (!of || (count && (!vr || !value))) {
        return precess_fmi2_refuse(of, IS_NULL);
    }
    for (k = 0; k < count; k++) {
        if (vr[k] >= FMU_VALUES) {
            return precess_fmi2_refuse(of, "no variable has this value reference");
        }
        if (vr[k] >= FMU_DERIVATIVE && vr[k] < FMU_INPUT && !evaluated) {
            const fmi2Status status = precess_fmi2_status(of, precess_fmu_evaluate(&of->state.fmu));

            if (status != fmi2OK) {
                return status;
            }
            evaluated = 1;
        }
        value[k] = of->state.fmu.values[vr[k]];
    }
    return fmi2OK;
}

/* Why a variable may not be set now; null where it may. */
static const char *forbidden(const struct precess_fmi2 *of, fmi2ValueReference vr)
{
    const int before = precess_fmi2_is_in(of, BEFORE);

    if (vr >= FMU_VALUES) {
        return "no variable has this value reference";
    }
    if (vr < FMU_STATE || (vr >= FMU_DERIVATIVE && vr < FMU_INPUT)) {
        return "time and derivatives are computed";
    }
    if (vr < FMU_DERIVATIVE) {
        return before ? NULL : "a state is set before the end of initialisation, later by fmi2SetContinuousStates";
    }
    if (vr < FMU_PARAMETER) {
        return precess_fmi2_is_in(of, BEFORE | RUNNING) ? NULL : OUT_OF_ORDER;
    }
    if (vr == FMU_PARAMETER || (vr >= FMU_PARAMETER + 15 && vr < FMU_PARAMETER + 15 + 9 * FMU_DEVICES)) {
        return before ? NULL : "a fixed parameter is set before the end of initialisation";
    }
    return precess_fmi2_is_in(of, BEFORE | IN(PHASE_EVENT) | IN(PHASE_STEPPING))
        ? NULL
        : "a tunable parameter is set in event mode or between steps";
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real value[])
{
    struct precess_fmi2 *const of = c;
    size_t k;

    if (!of || (count && (!vr || !value))) {
        return precess_fmi2_refuse(of, IS_NULL);
    }
    for (k = 0; k < count; k++) {
        const char *const why = precess_is_finite(value[k]) ? forbidden(of, vr[k]) : "the value is not finite";

        if (why) {
            return precess_fmi2_refuse(of, why);
        }
    }
    for (k = 0; k < count; k++) {
        of->state.fmu.values[vr[k]] = value[k];
        if (vr[k] >= FMU_PARAMETER) {
            of->state.fmu.is_prepared = 0;
        }
    }
    return fmi2OK;
}

/* Reads and writes of another type. */
static fmi2Status none_of(fmi2Component c, size_t count)
{
    return c && count == 0 ? fmi2OK : precess_fmi2_refuse(c, "all variables are real");
}

#define WITHOUT(type)                                                                               \
    fmi2Status fmi2Get##type(                                                                       \
        fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2##type value[])           \
    {                                                                                               \
        (void)vr;                                                                                   \
        (void)value;                                                                                \
        return none_of(c, count);                                                                   \
    }                                                                                               \
    fmi2Status fmi2Set##type(                                                                       \
        fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2##type value[])     \
    {                                                                                               \
        (void)vr;                                                                                   \
        (void)value;                                                                                \
        return none_of(c, count);                                                                   \
    }

WITHOUT(Integer)
WITHOUT(Boolean)
WITHOUT(String)
