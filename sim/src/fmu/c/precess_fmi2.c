/* FMI 2.0 of precess_instance.h: life of an instance, its variables, state and derivatives. Every function of the standard is in one
 * of the files precess_fmi2*.c, also those that this unit does not offer, which return an error. Compile with -std=c99
 * -ffp-contract=off. */

#include <stdlib.h>
#include <string.h>

#include "precess_fmi2.h"

fmi2Status precess_fmi2_answer(fmi2Component c, const char *why)
{
    const struct precess_fmi2 *const of = c;

    if (!why) {
        return fmi2OK;
    }
    if (of && of->log) {
        of->log(of->environment, of->name, fmi2Error, "logStatusError", "%s", why);
    }
    return fmi2Error;
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
    if (!precess_instance_is_token(guid) || (type != fmi2ModelExchange && type != fmi2CoSimulation)) {
        if (callbacks->logger) {
            callbacks->logger(
                callbacks->componentEnvironment, name, fmi2Error, "logStatusError", "%s",
                "the guid is not that of these sources, or the type is unknown");
        }
        return NULL;
    }
    if (type == fmi2ModelExchange && !FMU_EXCHANGES) {
        if (callbacks->logger) {
            callbacks->logger(
                callbacks->componentEnvironment, name, fmi2Error, "logStatusError", "%s", NO_EXCHANGE);
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
    of->log = callbacks->logger;
    of->environment = callbacks->componentEnvironment;
    precess_instance_begin(&of->instance, type == fmi2ModelExchange, 0);
    return of;
}

void fmi2FreeInstance(fmi2Component c)
{
    struct precess_fmi2 *const of = c;

    if (of) {
        precess_instance_end(&of->instance);
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
    /* Of Model Exchange the tolerance is the importer's, of Co-Simulation the parameter `step` sets it. */
    (void)has_tolerance;
    (void)tolerance;
    return precess_fmi2_answer(c, precess_instance_set_start(c, start, has_stop != fmi2False, stop));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return precess_fmi2_answer(
        c, precess_instance_enter(c, IN(PHASE_INSTANTIATED), PHASE_INITIALISING));
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    return precess_fmi2_answer(c, precess_instance_initialise(c));
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return precess_fmi2_answer(c, precess_instance_enter(c, RUNNING, PHASE_TERMINATED));
}

fmi2Status fmi2Reset(fmi2Component c)
{
    return precess_fmi2_answer(c, precess_instance_reset(c));
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real value[])
{
    return precess_fmi2_answer(c, precess_instance_get(c, vr, count, value));
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real value[])
{
    return precess_fmi2_answer(c, precess_instance_set(c, vr, count, value));
}

/* Reads and writes of another type. */
static fmi2Status none_of(fmi2Component c, size_t count)
{
    return c && count == 0 ? fmi2OK : precess_fmi2_answer(c, "all variables are real");
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

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    return precess_fmi2_answer(c, precess_instance_save(c, state));
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    return precess_fmi2_answer(c, precess_instance_restore(c, state));
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    return precess_fmi2_answer(c, precess_instance_free_state(c, state));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    return precess_fmi2_answer(c, precess_instance_size(c, state, size));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    return precess_fmi2_answer(c, precess_instance_write(c, state, bytes, size));
}

fmi2Status fmi2DeSerializeFMUstate(
    fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    return precess_fmi2_answer(c, precess_instance_read(c, bytes, size, state));
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
    return precess_fmi2_answer(
        c, precess_instance_along(c, unknowns, unknown_count, knowns, known_count, seed, sensitivity));
}
