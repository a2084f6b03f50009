/* FMI 3.0 of precess_instance.h: life of an instance, its variables, state and derivatives. Every function of the standard is in one
 * of the files precess_fmi3*.c, also those that this unit does not offer, which return an error. Compile with -std=c99
 * -ffp-contract=off. */

#include <stdlib.h>
#include <string.h>

#include "precess_fmi3.h"

fmi3Status precess_fmi3_answer(fmi3Instance instance, const char *why)
{
    const struct precess_fmi3 *const of = instance;

    if (!why) {
        return fmi3OK;
    }
    if (of && of->log && of->logs) {
        of->log(of->environment, fmi3Error, CATEGORY, why);
    }
    return fmi3Error;
}

void precess_fmi3_end(fmi3Instance instance)
{
    const struct precess_fmi3 *const of = instance;

    if (of->log && of->logs) {
        of->log(of->environment, fmi3Warning, CATEGORY, IS_STOPPED);
    }
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(
    fmi3Instance instance, fmi3Boolean on, size_t count, const fmi3String categories[])
{
    struct precess_fmi3 *const of = instance;
    size_t k;

    if (!of || (count && !categories)) {
        return precess_fmi3_answer(of, IS_NULL);
    }
    for (k = 0; k < count; k++) {
        if (!categories[k] || strcmp(categories[k], CATEGORY) != 0) {
            return precess_fmi3_answer(of, "the one category of messages is " CATEGORY);
        }
    }
    of->logs = on;
    return fmi3OK;
}

/* Writes why there is no instance, whether or not other messages are wanted. */
static fmi3Instance none(
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, const char *why)
{
    if (log) {
        log(environment, fmi3Error, CATEGORY, why);
    }
    return NULL;
}

static struct precess_fmi3 *made(
    fmi3String name,
    fmi3String token,
    fmi3Boolean logs,
    fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log,
    int is_exchange)
{
    struct precess_fmi3 *of;

    if (!name || !precess_instance_is_token(token)) {
        return none(environment, log, "the name is null, or the token is not that of these sources");
    }
    of = calloc(1, sizeof *of);
    if (!of) {
        return none(environment, log, "no memory for an instance");
    }
    of->logs = logs;
    of->log = log;
    of->environment = environment;
    precess_instance_begin(&of->instance, is_exchange, 1);
    return of;
}

fmi3Instance fmi3InstantiateModelExchange(
    fmi3String name,
    fmi3String token,
    fmi3String resources,
    fmi3Boolean visible,
    fmi3Boolean logs,
    fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log)
{
    (void)resources;
    (void)visible;
    if (!FMU_EXCHANGES) {
        return none(environment, log, NO_EXCHANGE);
    }
    return made(name, token, logs, environment, log, 1);
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name,
    fmi3String token,
    fmi3String resources,
    fmi3Boolean visible,
    fmi3Boolean logs,
    fmi3Boolean has_events,
    fmi3Boolean may_return_early,
    const fmi3ValueReference required[],
    size_t required_count,
    fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback update)
{
    struct precess_fmi3 *of;

    (void)resources;
    (void)visible;
    (void)required;
    (void)update;
    if (has_events || required_count) {
        return none(
            environment, log, "this unit has no event mode in Co-Simulation, and no intermediate variables");
    }
    of = made(name, token, logs, environment, log, 0);
    if (of) {
        of->may_return_early = may_return_early;
    }
    return of;
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name,
    fmi3String token,
    fmi3String resources,
    fmi3Boolean visible,
    fmi3Boolean logs,
    fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log,
    fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock,
    fmi3UnlockPreemptionCallback unlock)
{
    (void)name;
    (void)token;
    (void)resources;
    (void)visible;
    (void)logs;
    (void)update;
    (void)lock;
    (void)unlock;
    return none(environment, log, "this unit has no Scheduled Execution; take Co-Simulation or Model Exchange");
}

void fmi3FreeInstance(fmi3Instance instance)
{
    if (instance) {
        precess_instance_end(instance);
        free(instance);
    }
}

fmi3Status fmi3EnterInitializationMode(
    fmi3Instance instance,
    fmi3Boolean has_tolerance,
    fmi3Float64 tolerance,
    fmi3Float64 start,
    fmi3Boolean has_stop,
    fmi3Float64 stop)
{
    const char *why = precess_instance_set_start(instance, start, has_stop, stop);

    /* Of Model Exchange the tolerance is the importer's, of Co-Simulation the parameter `step` sets it. */
    (void)has_tolerance;
    (void)tolerance;
    if (!why) {
        why = precess_instance_enter(instance, IN(PHASE_INSTANTIATED), PHASE_INITIALISING);
    }
    return precess_fmi3_answer(instance, why);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    return precess_fmi3_answer(instance, precess_instance_initialise(instance));
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    return precess_fmi3_answer(instance, precess_instance_enter(instance, RUNNING, PHASE_TERMINATED));
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    return precess_fmi3_answer(instance, precess_instance_reset(instance));
}

#define NOT_AS_MANY "there are not as many values as value references: each variable is one number"

fmi3Status fmi3GetFloat64(
    fmi3Instance instance, const fmi3ValueReference vr[], size_t count, fmi3Float64 values[], size_t value_count)
{
    return precess_fmi3_answer(
        instance, count == value_count ? precess_instance_get(instance, vr, count, values) : NOT_AS_MANY);
}

fmi3Status fmi3SetFloat64(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    const fmi3Float64 values[],
    size_t value_count)
{
    return precess_fmi3_answer(
        instance, count == value_count ? precess_instance_set(instance, vr, count, values) : NOT_AS_MANY);
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    return precess_fmi3_answer(instance, precess_instance_save(instance, state));
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state)
{
    return precess_fmi3_answer(instance, precess_instance_restore(instance, state));
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    return precess_fmi3_answer(instance, precess_instance_free_state(instance, state));
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size)
{
    return precess_fmi3_answer(instance, precess_instance_size(instance, state, size));
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    return precess_fmi3_answer(instance, precess_instance_write(instance, state, bytes, size));
}

fmi3Status fmi3DeserializeFMUState(
    fmi3Instance instance, const fmi3Byte bytes[], size_t size, fmi3FMUState *state)
{
    return precess_fmi3_answer(instance, precess_instance_read(instance, bytes, size, state));
}

/* Of both derivatives the seed weighs the variables of one list, and there is one sensitivity for each of the other. */
#define DERIVATIVES(name, compute, seeds, sensitivities)                                            \
    fmi3Status name(                                                                                \
        fmi3Instance instance,                                                                      \
        const fmi3ValueReference unknowns[],                                                        \
        size_t unknown_count,                                                                       \
        const fmi3ValueReference knowns[],                                                          \
        size_t known_count,                                                                         \
        const fmi3Float64 seed[],                                                                   \
        size_t seed_count,                                                                          \
        fmi3Float64 sensitivity[],                                                                  \
        size_t sensitivity_count)                                                                   \
    {                                                                                               \
        return precess_fmi3_answer(                                                                 \
            instance,                                                                               \
            seed_count == (seeds) && sensitivity_count == (sensitivities)                           \
                ? compute(instance, unknowns, unknown_count, knowns, known_count, seed, sensitivity) \
                : NOT_AS_MANY);                                                                     \
    }

DERIVATIVES(fmi3GetDirectionalDerivative, precess_instance_along, known_count, unknown_count)
DERIVATIVES(fmi3GetAdjointDerivative, precess_instance_gradient, unknown_count, known_count)
