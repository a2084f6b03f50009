/* Functional Mock-up Interface 2.0: Model Exchange and Co-Simulation of precess_fmu.h. Every function is here, also those that
 * this unit does not offer, which return an error. Compile with -std=c99 -ffp-contract=off. */

#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

#include "precess_fmu.h"

/* Where an instance is in its life. */
enum phase {
    PHASE_INSTANTIATED,
    PHASE_INITIALISING,
    PHASE_EVENT,
    PHASE_CONTINUOUS,
    PHASE_STEPPING,
    PHASE_TERMINATED
};

/* What is copied as the state of an instance. */
struct kept {
    struct precess_fmu fmu;
    enum phase phase;
};

struct instance {
    struct kept kept;
    fmi2Type type;
    fmi2Boolean logs;
    fmi2CallbackLogger log;
    void (*release)(void *);
    fmi2ComponentEnvironment environment;
    char *name;
};

/* What a serialised state starts with. */
static const char TOKEN[] = FMU_TOKEN;

static void *make(const fmi2CallbackFunctions *callbacks, size_t size)
{
    return callbacks->allocateMemory ? callbacks->allocateMemory(1, size) : calloc(1, size);
}

static fmi2Status refuse(struct instance *of, const char *text)
{
    if (of && of->log) {
        of->log(of->environment, of->name, fmi2Error, "logStatusError", "%s", text);
    }
    return fmi2Error;
}

/* fmi2OK of a well status, else a message. */
static fmi2Status told(struct instance *of, enum precess_status status)
{
    return status == PRECESS_OK ? fmi2OK : refuse(of, precess_fmu_message(status));
}

static int is_in(const struct instance *of, unsigned phases)
{
    return of && (phases >> (unsigned)of->kept.phase & 1u);
}

#define IN(phase) (1u << (unsigned)(phase))
#define BEFORE (IN(PHASE_INSTANTIATED) | IN(PHASE_INITIALISING))
#define RUNNING (IN(PHASE_EVENT) | IN(PHASE_CONTINUOUS) | IN(PHASE_STEPPING))
#define ALL (BEFORE | RUNNING | IN(PHASE_TERMINATED))
#define OUT_OF_ORDER "the function may not be called now; see the state machine of FMI 2.0"

static fmi2Status move(fmi2Component c, unsigned from, enum phase to)
{
    struct instance *const of = c;

    if (!is_in(of, from)) {
        return refuse(of, OUT_OF_ORDER);
    }
    of->kept.phase = to;
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
    struct instance *const of = c;

    (void)count;
    (void)categories;
    if (!of) {
        return fmi2Error;
    }
    of->logs = on;
    return fmi2OK;
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
    struct instance *of;
    size_t length;

    (void)resources;
    (void)visible;
    if (!callbacks || !name || !guid) {
        return NULL;
    }
    if (strcmp(guid, TOKEN) != 0 || (type != fmi2ModelExchange && type != fmi2CoSimulation)) {
        if (callbacks->logger) {
            callbacks->logger(
                callbacks->componentEnvironment, name, fmi2Error, "logStatusError",
                "%s", "the guid is not that of these sources, or the type is unknown");
        }
        return NULL;
    }
    of = make(callbacks, sizeof *of);
    if (!of) {
        return NULL;
    }
    length = strlen(name) + 1;
    of->release = callbacks->allocateMemory ? callbacks->freeMemory : free;
    of->name = make(callbacks, length);
    if (!of->name) {
        if (of->release) {
            of->release(of);
        }
        return NULL;
    }
    memcpy(of->name, name, length);
    of->type = type;
    of->logs = logs;
    of->log = callbacks->logger;
    of->environment = callbacks->componentEnvironment;
    of->kept.phase = PHASE_INSTANTIATED;
    precess_fmu_reset(&of->kept.fmu);
    return of;
}

void fmi2FreeInstance(fmi2Component c)
{
    struct instance *const of = c;

    if (of && of->release) {
        void (*const release)(void *) = of->release;

        release(of->name);
        release(of);
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
    struct instance *const of = c;

    (void)has_tolerance;
    (void)tolerance;
    if (!is_in(of, IN(PHASE_INSTANTIATED))) {
        return refuse(of, OUT_OF_ORDER);
    }
    if (!precess_is_finite(start) || (has_stop && !(stop >= start))) {
        return refuse(of, "the start is not finite, or the stop is before it");
    }
    of->kept.fmu.values[0] = start;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    return move(c, IN(PHASE_INSTANTIATED), PHASE_INITIALISING);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    struct instance *const of = c;
    fmi2Status status;

    if (!is_in(of, IN(PHASE_INITIALISING))) {
        return refuse(of, OUT_OF_ORDER);
    }
    status = told(of, precess_fmu_evaluate(&of->kept.fmu));
    if (status == fmi2OK) {
        of->kept.phase = of->type == fmi2ModelExchange ? PHASE_EVENT : PHASE_STEPPING;
    }
    return status;
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return move(c, RUNNING, PHASE_TERMINATED);
}

fmi2Status fmi2Reset(fmi2Component c)
{
    struct instance *const of = c;

    if (!of) {
        return fmi2Error;
    }
    precess_fmu_reset(&of->kept.fmu);
    of->kept.phase = PHASE_INSTANTIATED;
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real value[])
{
    struct instance *const of = c;
    int evaluated = 0;
    size_t k;

    if (!of || (count && (!vr || !value))) {
        return refuse(of, "an argument is null");
    }
    for (k = 0; k < count; k++) {
        if (vr[k] >= FMU_VALUES) {
            return refuse(of, "no variable has this value reference");
        }
        if (vr[k] >= FMU_DERIVATIVE && vr[k] < FMU_INPUT && !evaluated) {
            const fmi2Status status = told(of, precess_fmu_evaluate(&of->kept.fmu));

            if (status != fmi2OK) {
                return status;
            }
            evaluated = 1;
        }
        value[k] = of->kept.fmu.values[vr[k]];
    }
    return fmi2OK;
}

/* Why a variable may not be set now; null where it may. */
static const char *forbidden(const struct instance *of, fmi2ValueReference vr)
{
    const int before = is_in(of, BEFORE);

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
        return is_in(of, BEFORE | RUNNING) ? NULL : OUT_OF_ORDER;
    }
    if (vr == FMU_PARAMETER || (vr >= FMU_PARAMETER + 15 && vr < FMU_PARAMETER + 15 + 9 * FMU_DEVICES)) {
        return before ? NULL : "a fixed parameter is set before the end of initialisation";
    }
    return is_in(of, BEFORE | IN(PHASE_EVENT) | IN(PHASE_STEPPING))
        ? NULL
        : "a tunable parameter is set in event mode or between steps";
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real value[])
{
    struct instance *const of = c;
    size_t k;

    if (!of || (count && (!vr || !value))) {
        return refuse(of, "an argument is null");
    }
    for (k = 0; k < count; k++) {
        const char *const why = precess_is_finite(value[k]) ? forbidden(of, vr[k]) : "the value is not finite";

        if (why) {
            return refuse(of, why);
        }
    }
    for (k = 0; k < count; k++) {
        of->kept.fmu.values[vr[k]] = value[k];
        if (vr[k] >= FMU_PARAMETER) {
            of->kept.fmu.is_prepared = 0;
        }
    }
    return fmi2OK;
}

#define WITHOUT(type, constant)                                                                    \
    fmi2Status fmi2Get##type(                                                                      \
        fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2##type value[])          \
    {                                                                                              \
        (void)vr;                                                                                  \
        (void)value;                                                                               \
        return c && count == 0 ? fmi2OK : refuse(c, "all variables are real");                     \
    }                                                                                              \
    fmi2Status fmi2Set##type(                                                                      \
        fmi2Component c, const fmi2ValueReference vr[], size_t count, constant fmi2##type value[]) \
    {                                                                                              \
        (void)vr;                                                                                  \
        (void)value;                                                                               \
        return c && count == 0 ? fmi2OK : refuse(c, "all variables are real");                     \
    }

WITHOUT(Integer, const)
WITHOUT(Boolean, const)
WITHOUT(String, const)

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    struct instance *const of = c;

    if (!of || !state) {
        return refuse(of, "an argument is null");
    }
    if (!*state) {
        *state = malloc(sizeof of->kept);
    }
    if (!*state) {
        return refuse(of, "no memory for a state");
    }
    memcpy(*state, &of->kept, sizeof of->kept);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    struct instance *const of = c;

    if (!of || !state) {
        return refuse(of, "an argument is null");
    }
    memcpy(&of->kept, state, sizeof of->kept);
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    if (!c || !state) {
        return refuse(c, "an argument is null");
    }
    free(*state);
    *state = NULL;
    return fmi2OK;
}

/* A token, the phase, and the numbers. */
#define SERIALISED (sizeof TOKEN + 1 + FMU_VALUES * sizeof(double))

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    if (!c || !state || !size) {
        return refuse(c, "an argument is null");
    }
    *size = SERIALISED;
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    const struct kept *const kept = state;

    if (!c || !state || !bytes || size < SERIALISED) {
        return refuse(c, "an argument is null, or the bytes are too few");
    }
    memcpy(bytes, TOKEN, sizeof TOKEN);
    bytes[sizeof TOKEN] = (fmi2Byte)kept->phase;
    memcpy(bytes + sizeof TOKEN + 1, kept->fmu.values, sizeof kept->fmu.values);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(
    fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    struct kept *kept;

    if (!c || !bytes || !state || size < SERIALISED || memcmp(bytes, TOKEN, sizeof TOKEN) != 0
        || bytes[sizeof TOKEN] < 0 || bytes[sizeof TOKEN] > (fmi2Byte)PHASE_TERMINATED) {
        return refuse(c, "the bytes are no state of this unit");
    }
    kept = *state ? *state : malloc(sizeof *kept);
    if (!kept) {
        return refuse(c, "no memory for a state");
    }
    precess_fmu_reset(&kept->fmu);
    kept->phase = (enum phase)bytes[sizeof TOKEN];
    memcpy(kept->fmu.values, bytes + sizeof TOKEN + 1, sizeof kept->fmu.values);
    *state = kept;
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
    return refuse(c, "this unit has no directional derivatives");
}

fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    return move(c, IN(PHASE_CONTINUOUS) | IN(PHASE_EVENT), PHASE_EVENT);
}

fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    struct instance *const of = c;

    if (!info || !is_in(of, IN(PHASE_EVENT))) {
        return refuse(of, OUT_OF_ORDER);
    }
    info->newDiscreteStatesNeeded = fmi2False;
    info->terminateSimulation = fmi2False;
    info->nominalsOfContinuousStatesChanged = fmi2False;
    info->valuesOfContinuousStatesChanged = fmi2False;
    info->nextEventTimeDefined = fmi2False;
    info->nextEventTime = 0.0;
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    return move(c, IN(PHASE_EVENT), PHASE_CONTINUOUS);
}

fmi2Status fmi2CompletedIntegratorStep(
    fmi2Component c, fmi2Boolean no_earlier, fmi2Boolean *enter_event_mode, fmi2Boolean *terminate)
{
    struct instance *const of = c;

    (void)no_earlier;
    if (!enter_event_mode || !terminate || !is_in(of, IN(PHASE_CONTINUOUS))) {
        return refuse(of, OUT_OF_ORDER);
    }
    *enter_event_mode = fmi2False;
    *terminate = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    struct instance *const of = c;

    if (!is_in(of, IN(PHASE_EVENT) | IN(PHASE_CONTINUOUS)) || !precess_is_finite(time)) {
        return refuse(of, OUT_OF_ORDER);
    }
    of->kept.fmu.values[0] = time;
    return fmi2OK;
}

/* Whether an array of all states may be read or written. */
static int has_states(const struct instance *of, unsigned phases, const fmi2Real x[], size_t count)
{
    return x && count == FMU_STATES && is_in(of, phases);
}

fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t count)
{
    struct instance *const of = c;

    if (!has_states(of, IN(PHASE_CONTINUOUS), x, count)) {
        return refuse(of, OUT_OF_ORDER);
    }
    if (!precess_are_finite(x, FMU_STATES)) {
        return refuse(of, "a state is not finite");
    }
    memcpy(of->kept.fmu.values + FMU_STATE, x, FMU_STATES * sizeof *x);
    return fmi2OK;
}

fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t count)
{
    struct instance *const of = c;
    fmi2Status status;

    if (!has_states(of, ALL, derivatives, count) || of->type != fmi2ModelExchange) {
        return refuse(of, OUT_OF_ORDER);
    }
    status = told(of, precess_fmu_evaluate(&of->kept.fmu));
    if (status == fmi2OK) {
        memcpy(derivatives, of->kept.fmu.values + FMU_DERIVATIVE, FMU_STATES * sizeof *derivatives);
    }
    return status;
}

fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t count)
{
    (void)indicators;
    return c && count == 0 ? fmi2OK : refuse(c, "there are no event indicators");
}

fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t count)
{
    struct instance *const of = c;

    if (!has_states(of, ALL, x, count) || of->type != fmi2ModelExchange) {
        return refuse(of, OUT_OF_ORDER);
    }
    memcpy(x, of->kept.fmu.values + FMU_STATE, FMU_STATES * sizeof *x);
    return fmi2OK;
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominal[], size_t count)
{
    struct instance *const of = c;
    size_t k;

    if (!has_states(of, ALL, nominal, count)) {
        return refuse(of, OUT_OF_ORDER);
    }
    for (k = 0; k < count; k++) {
        nominal[k] = 1.0;
    }
    return fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr;
    (void)count;
    (void)order;
    (void)value;
    return refuse(c, "inputs are held over a step");
}

fmi2Status fmi2GetRealOutputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer order[], fmi2Real value[])
{
    (void)vr;
    (void)count;
    (void)order;
    (void)value;
    return refuse(c, "the derivatives of outputs are variables of their own");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real point, fmi2Real size, fmi2Boolean no_earlier)
{
    struct instance *const of = c;
    fmi2Status status;
    double *time;
    double off;

    (void)no_earlier;
    if (!is_in(of, IN(PHASE_STEPPING))) {
        return refuse(of, OUT_OF_ORDER);
    }
    time = &of->kept.fmu.values[0];
    off = precess_magnitude(point - *time);
    /* Times that are sums of steps differ by rounding. */
    if (!(size >= 0.0) || !(off <= 1e-9 * (1.0 + precess_magnitude(point))) || !precess_is_finite(point + size)) {
        return refuse(of, "the step does not start where the last one ended, or its size is negative or not finite");
    }
    status = told(of, precess_fmu_advance(&of->kept.fmu, size));
    if (status == fmi2OK) {
        *time = point + size;
    }
    return status;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    return refuse(c, "steps are complete when fmi2DoStep returns");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind;
    (void)value;
    return refuse(c, "steps are complete when fmi2DoStep returns");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    (void)kind;
    (void)value;
    return refuse(c, "steps are complete when fmi2DoStep returns");
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind;
    (void)value;
    return refuse(c, "steps are complete when fmi2DoStep returns");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    (void)kind;
    (void)value;
    return refuse(c, "steps are complete when fmi2DoStep returns");
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind;
    (void)value;
    return refuse(c, "steps are complete when fmi2DoStep returns");
}
