/* A program that takes a unit for an importer would: calls out of order, a hundred instances, states that are restored, both
 * types. The unit has a wheel and, second, a panel with end stops. Writes the states after steps of 1 ms as doubles; what was
 * not as expected goes to standard error, and how often is the exit status. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "precess_fmu.h"

#define INSTANCES 100
#define STEP 1e-3

static int unexpected;
static int messages;

static void check(int line, int is_well)
{
    if (!is_well) {
        fprintf(stderr, "line %d\n", line);
        unexpected++;
    }
}

#define CHECK(is_well) check(__LINE__, is_well)
#define IS_ERROR(call) CHECK((call) == fmi2Error)
#define IS_OK(call) CHECK((call) == fmi2OK)

static void say(
    fmi2ComponentEnvironment environment,
    fmi2String name,
    fmi2Status status,
    fmi2String category,
    fmi2String format,
    ...)
{
    (void)environment;
    CHECK(name && format && status == fmi2Error && strcmp(category, "logStatusError") == 0);
    messages++;
}

static const fmi2CallbackFunctions CALLBACKS = { say, NULL, NULL, NULL, NULL };

static fmi2Component made(fmi2Type type)
{
    return fmi2Instantiate("unit", type, FMU_TOKEN, NULL, &CALLBACKS, fmi2False, fmi2False);
}

static void initialise(fmi2Component c)
{
    IS_OK(fmi2SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0));
    IS_OK(fmi2EnterInitializationMode(c));
    IS_OK(fmi2ExitInitializationMode(c));
}

static fmi2Status set(fmi2Component c, int place, double value)
{
    const fmi2ValueReference reference = (fmi2ValueReference)place;

    return fmi2SetReal(c, &reference, 1, &value);
}

static double get(fmi2Component c, int place)
{
    const fmi2ValueReference reference = (fmi2ValueReference)place;
    double value = 0.0;

    IS_OK(fmi2GetReal(c, &reference, 1, &value));
    return value;
}

static void states(fmi2Component c, double x[FMU_STATES])
{
    int k;

    for (k = 0; k < FMU_STATES; k++) {
        x[k] = get(c, FMU_STATE + k);
    }
}

static void run(fmi2Component c, int from, int count)
{
    int k;

    for (k = from; k < from + count; k++) {
        IS_OK(fmi2DoStep(c, k * STEP, STEP, fmi2True));
    }
}

/* Of instances that are none, and of one that is not yet initialised. */
static void before_initialisation(void)
{
    fmi2CallbackFunctions silent = { NULL, NULL, NULL, NULL, NULL };
    fmi2Component c = made(fmi2CoSimulation);
    const fmi2ValueReference none = FMU_VALUES;
    double value = 0.0;

    CHECK(c != NULL);
    CHECK(!fmi2Instantiate("unit", fmi2CoSimulation, "other", NULL, &CALLBACKS, 0, 0));
    CHECK(!fmi2Instantiate("unit", fmi2CoSimulation, "other", NULL, &silent, 0, 0));
    CHECK(!fmi2Instantiate("unit", (fmi2Type)7, FMU_TOKEN, NULL, &CALLBACKS, 0, 0));
    CHECK(!fmi2Instantiate(NULL, fmi2CoSimulation, FMU_TOKEN, NULL, &CALLBACKS, 0, 0));
    CHECK(!fmi2Instantiate("unit", fmi2CoSimulation, NULL, NULL, &CALLBACKS, 0, 0));
    CHECK(!fmi2Instantiate("unit", fmi2CoSimulation, FMU_TOKEN, NULL, NULL, 0, 0));
    fmi2FreeInstance(NULL);
    IS_ERROR(fmi2DoStep(NULL, 0.0, STEP, fmi2True));
    IS_ERROR(fmi2Reset(NULL));
    IS_ERROR(fmi2Terminate(NULL));
    IS_ERROR(fmi2GetReal(NULL, &none, 1, &value));
    IS_ERROR(fmi2EnterInitializationMode(NULL));
    IS_ERROR(fmi2SetDebugLogging(NULL, fmi2True, 0, NULL));
    IS_OK(fmi2SetDebugLogging(c, fmi2True, 0, NULL));
    IS_ERROR(fmi2DoStep(c, 0.0, STEP, fmi2True));
    IS_ERROR(fmi2ExitInitializationMode(c));
    IS_ERROR(fmi2Terminate(c));
    IS_ERROR(fmi2SetupExperiment(c, 0, 0.0, NAN, 0, 0.0));
    IS_ERROR(fmi2SetupExperiment(c, 0, 0.0, 1.0, 1, 0.0));
    IS_ERROR(fmi2GetReal(c, NULL, 1, &value));
    IS_ERROR(fmi2GetReal(c, &none, 1, &value));
    IS_ERROR(fmi2SetReal(c, &none, 1, &value));
    IS_ERROR(set(c, FMU_STATE, INFINITY));
    IS_ERROR(set(c, 0, 1.0));
    IS_ERROR(set(c, FMU_DERIVATIVE, 1.0));
    IS_ERROR(fmi2GetInteger(c, &none, 1, NULL));
    IS_ERROR(fmi2SetString(c, &none, 1, NULL));
    IS_OK(fmi2GetBoolean(c, NULL, 0, NULL));
    /* Beyond an end stop, and a massless hub: named, and well again afterwards. */
    IS_OK(fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0));
    IS_OK(fmi2EnterInitializationMode(c));
    IS_ERROR(fmi2EnterInitializationMode(c));
    IS_OK(set(c, FMU_STATE + 14, 3.0));
    IS_ERROR(fmi2ExitInitializationMode(c));
    IS_OK(set(c, FMU_STATE + 14, 0.0));
    IS_OK(set(c, FMU_PARAMETER + 5, -1.0));
    IS_ERROR(fmi2ExitInitializationMode(c));
    IS_OK(set(c, FMU_PARAMETER + 5, 90.0));
    IS_OK(fmi2ExitInitializationMode(c));
    fmi2FreeInstance(c);
}

/* Of an instance that steps. */
static void stepping(void)
{
    const fmi2ValueReference known = FMU_STATE + 3, unknown = FMU_DERIVATIVE;
    const double seed = 2.0;
    fmi2Component c = made(fmi2CoSimulation);
    fmi2Boolean flag = fmi2False;
    fmi2Status status;
    double x[FMU_STATES];
    double time, slope = 0.0;
    int k;

    initialise(c);
    IS_ERROR(fmi2EnterContinuousTimeMode(c));
    IS_ERROR(fmi2EnterEventMode(c));
    IS_ERROR(fmi2SetTime(c, 1.0));
    IS_ERROR(fmi2GetDerivatives(c, x, FMU_STATES));
    IS_ERROR(fmi2GetContinuousStates(c, x, FMU_STATES));
    IS_ERROR(fmi2SetContinuousStates(c, x, FMU_STATES));
    IS_ERROR(fmi2DoStep(c, 7.0, STEP, fmi2True));
    IS_ERROR(fmi2DoStep(c, 0.0, -STEP, fmi2True));
    IS_ERROR(fmi2DoStep(c, 0.0, NAN, fmi2True));
    IS_ERROR(fmi2DoStep(c, 0.0, INFINITY, fmi2True));
    IS_ERROR(fmi2DoStep(c, NAN, STEP, fmi2True));
    IS_OK(fmi2DoStep(c, 0.0, 0.0, fmi2True));
    IS_ERROR(set(c, FMU_PARAMETER, 1.0));
    IS_ERROR(set(c, FMU_STATE, 1.0));
    IS_ERROR(fmi2CancelStep(c));
    IS_ERROR(fmi2GetStatus(c, fmi2DoStepStatus, &status));
    IS_ERROR(fmi2GetIntegerStatus(c, fmi2DoStepStatus, NULL));
    IS_ERROR(fmi2GetStringStatus(c, fmi2PendingStatus, NULL));
    IS_ERROR(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, NULL));
    IS_ERROR(fmi2SetRealInputDerivatives(c, NULL, 0, NULL, NULL));
    IS_ERROR(fmi2GetRealOutputDerivatives(c, NULL, 0, NULL, NULL));
    IS_OK(fmi2GetDirectionalDerivative(c, &unknown, 1, &known, 1, &seed, &slope));
    CHECK(slope == seed);
    IS_ERROR(fmi2GetDirectionalDerivative(c, &known, 1, &known, 1, &seed, NULL));
    /* A parameter that no device has is an error until it is another one; nothing has moved. */
    states(c, x);
    IS_OK(set(c, FMU_PARAMETER + 5, -1.0));
    IS_ERROR(fmi2DoStep(c, 0.0, STEP, fmi2True));
    CHECK(get(c, FMU_STATE + 13) == x[13]);
    IS_OK(set(c, FMU_PARAMETER + 5, 90.0));
    run(c, 0, 10);
    IS_OK(fmi2Terminate(c));
    IS_ERROR(fmi2Terminate(c));
    IS_ERROR(fmi2DoStep(c, 0.01, STEP, fmi2True));
    /* A panel that moves out to its stop: the step is discarded, and the unit says that it has ended. */
    IS_OK(fmi2Reset(c));
    IS_OK(set(c, FMU_STATE + 13 + FMU_JOINTS + 1, 2.0));
    initialise(c);
    for (k = 0; k < 10000; k++) {
        status = fmi2DoStep(c, k * STEP, STEP, fmi2True);
        if (status != fmi2OK) {
            break;
        }
    }
    CHECK(status == fmi2Discard && k > 100);
    CHECK(get(c, FMU_STATE + 14) < precess_fmu_joints[1].upper);
    IS_OK(fmi2GetBooleanStatus(c, fmi2Terminated, &flag));
    CHECK(flag == fmi2True);
    IS_OK(fmi2GetRealStatus(c, fmi2LastSuccessfulTime, &time));
    CHECK(fabs(time - k * STEP) < 1e-9);
    /* A wheel that has turned for hours is wrapped. */
    IS_OK(fmi2Reset(c));
    IS_OK(set(c, FMU_STATE + 13, 1.6e7));
    initialise(c);
    run(c, 0, 1);
    CHECK(fabs(get(c, FMU_STATE + 13)) < 3.2);
    fmi2FreeInstance(c);
}

/* A state that is set again, and one of bytes in another instance, are followed by the same. */
static void restoring(void)
{
    fmi2Component c = made(fmi2CoSimulation);
    fmi2Component other = made(fmi2CoSimulation);
    fmi2Component of_other_type = made(fmi2ModelExchange);
    fmi2FMUstate state = NULL;
    fmi2FMUstate of_bytes = NULL;
    fmi2Byte *bytes;
    double first[FMU_STATES];
    double again[FMU_STATES];
    const double not_finite = NAN;
    size_t size = 0;

    initialise(c);
    run(c, 0, 20);
    IS_ERROR(fmi2GetFMUstate(c, NULL));
    IS_ERROR(fmi2SetFMUstate(c, NULL));
    IS_ERROR(fmi2FreeFMUstate(NULL, &state));
    IS_OK(fmi2GetFMUstate(c, &state));
    IS_OK(fmi2GetFMUstate(c, &state));
    IS_ERROR(fmi2SetFMUstate(of_other_type, state));
    IS_ERROR(fmi2SerializedFMUstateSize(c, NULL, &size));
    IS_OK(fmi2SerializedFMUstateSize(c, state, &size));
    bytes = malloc(size);
    if (!bytes) {
        exit(1);
    }
    IS_ERROR(fmi2SerializeFMUstate(c, state, bytes, size - 1));
    IS_OK(fmi2SerializeFMUstate(c, state, bytes, size));
    run(c, 20, 20);
    states(c, first);
    IS_OK(fmi2SetFMUstate(c, state));
    run(c, 20, 20);
    states(c, again);
    CHECK(memcmp(first, again, sizeof first) == 0);
    IS_ERROR(fmi2DeSerializeFMUstate(other, bytes, size - 1, &of_bytes));
    IS_ERROR(fmi2DeSerializeFMUstate(of_other_type, bytes, size, &of_bytes));
    IS_OK(fmi2DeSerializeFMUstate(other, bytes, size, &of_bytes));
    IS_OK(fmi2DeSerializeFMUstate(other, bytes, size, &of_bytes));
    IS_OK(fmi2SetFMUstate(other, of_bytes));
    run(other, 20, 20);
    states(other, again);
    CHECK(memcmp(first, again, sizeof first) == 0);
    memcpy(bytes + size - sizeof not_finite, &not_finite, sizeof not_finite);
    IS_ERROR(fmi2DeSerializeFMUstate(other, bytes, size, &of_bytes));
    bytes[0]++;
    IS_ERROR(fmi2DeSerializeFMUstate(other, bytes, size, &of_bytes));
    IS_OK(fmi2FreeFMUstate(c, &state));
    IS_OK(fmi2FreeFMUstate(c, &state));
    IS_OK(fmi2FreeFMUstate(other, &of_bytes));
    free(bytes);
    fmi2FreeInstance(c);
    fmi2FreeInstance(other);
    fmi2FreeInstance(of_other_type);
}

static void model_exchange(void)
{
    fmi2Component c = made(fmi2ModelExchange);
    fmi2EventInfo info;
    fmi2Boolean event = fmi2False;
    fmi2Boolean end = fmi2False;
    double x[FMU_STATES];
    double rates[FMU_STATES];
    int k;

    initialise(c);
    IS_ERROR(fmi2DoStep(c, 0.0, STEP, fmi2True));
    IS_ERROR(fmi2SetContinuousStates(c, x, FMU_STATES));
    IS_ERROR(fmi2NewDiscreteStates(c, NULL));
    IS_OK(fmi2NewDiscreteStates(c, &info));
    CHECK(!info.newDiscreteStatesNeeded && !info.valuesOfContinuousStatesChanged);
    IS_OK(fmi2EnterContinuousTimeMode(c));
    IS_ERROR(fmi2NewDiscreteStates(c, &info));
    IS_ERROR(fmi2SetTime(c, NAN));
    IS_OK(fmi2SetTime(c, 0.5));
    CHECK(get(c, 0) == 0.5);
    IS_ERROR(fmi2GetContinuousStates(c, x, FMU_STATES - 1));
    IS_OK(fmi2GetContinuousStates(c, x, FMU_STATES));
    IS_OK(fmi2SetContinuousStates(c, x, FMU_STATES));
    IS_OK(fmi2GetDerivatives(c, rates, FMU_STATES));
    for (k = 0; k < FMU_STATES; k++) {
        CHECK(get(c, FMU_DERIVATIVE + k) == rates[k]);
    }
    IS_OK(fmi2GetNominalsOfContinuousStates(c, rates, FMU_STATES));
    IS_ERROR(fmi2GetEventIndicators(c, rates, 1));
    IS_OK(fmi2GetEventIndicators(c, rates, 0));
    IS_OK(fmi2CompletedIntegratorStep(c, fmi2True, &event, &end));
    CHECK(!event && !end);
    IS_ERROR(set(c, FMU_PARAMETER + 5, 91.0));
    IS_OK(set(c, FMU_INPUT, 1.0));
    /* A wheel that has turned for hours needs an event, and is wrapped there; beyond twice that its sine is refused. */
    x[13] = 1.6e7;
    IS_OK(fmi2SetContinuousStates(c, x, FMU_STATES));
    IS_OK(fmi2CompletedIntegratorStep(c, fmi2True, &event, &end));
    CHECK(event && !end);
    IS_OK(fmi2EnterEventMode(c));
    IS_OK(set(c, FMU_PARAMETER + 5, 91.0));
    IS_OK(fmi2NewDiscreteStates(c, &info));
    CHECK(info.valuesOfContinuousStatesChanged && !info.newDiscreteStatesNeeded);
    IS_OK(fmi2GetContinuousStates(c, x, FMU_STATES));
    CHECK(fabs(x[13]) < 3.2);
    IS_OK(fmi2EnterContinuousTimeMode(c));
    x[13] = 1.7e7;
    IS_OK(fmi2SetContinuousStates(c, x, FMU_STATES));
    IS_ERROR(fmi2GetDerivatives(c, rates, FMU_STATES));
    x[13] = NAN;
    IS_ERROR(fmi2SetContinuousStates(c, x, FMU_STATES));
    x[13] = 0.0;
    x[14] = 3.0;
    IS_OK(fmi2SetContinuousStates(c, x, FMU_STATES));
    IS_OK(fmi2CompletedIntegratorStep(c, fmi2True, &event, &end));
    CHECK(end);
    IS_OK(fmi2Terminate(c));
    IS_ERROR(fmi2SetTime(c, 1.0));
    fmi2FreeInstance(c);
}

/* The states after a step of one instance with its wheel at an angle, by each type. */
static void wrapped(double angle)
{
    const int wheel = FMU_STATE + 13;
    double x[FMU_STATES];
    fmi2EventInfo event;
    fmi2Component c = made(fmi2CoSimulation);

    IS_OK(set(c, wheel, angle));
    initialise(c);
    run(c, 0, 1);
    states(c, x);
    fmi2FreeInstance(c);
    CHECK(fwrite(x, sizeof x[0], FMU_STATES, stdout) == FMU_STATES);
    c = made(fmi2ModelExchange);
    IS_OK(set(c, wheel, angle));
    initialise(c);
    IS_OK(fmi2NewDiscreteStates(c, &event));
    states(c, x);
    fmi2FreeInstance(c);
    CHECK(fwrite(x, sizeof x[0], FMU_STATES, stdout) == FMU_STATES);
}

int main(int count, char **arguments)
{
    const int steps = count > 1 ? atoi(arguments[1]) : 0;
    fmi2Component all[INSTANCES];
    double x[FMU_STATES];
    int k;

    if (count > 2) {
        wrapped(atof(arguments[2]));
        return unexpected;
    }
    CHECK(strcmp(fmi2GetVersion(), "2.0") == 0 && strcmp(fmi2GetTypesPlatform(), "default") == 0);
    before_initialisation();
    stepping();
    restoring();
    model_exchange();
    CHECK(messages > 40);
    for (k = 0; k < INSTANCES; k++) {
        all[k] = made(fmi2CoSimulation);
        initialise(all[k]);
    }
    /* Side by side, the last by steps of another length, of which the solver's are parts. */
    for (k = 0; k < steps; k++) {
        int n;

        for (n = 0; n + 1 < INSTANCES; n++) {
            IS_OK(fmi2DoStep(all[n], k * STEP, STEP, fmi2True));
        }
    }
    for (k = 0; k < steps; k += 10) {
        IS_OK(fmi2DoStep(all[INSTANCES - 1], k * STEP, 10 * STEP, fmi2True));
    }
    states(all[0], x);
    for (k = 0; k < INSTANCES; k++) {
        double other[FMU_STATES];

        states(all[k], other);
        CHECK(memcmp(x, other, sizeof x) == 0);
        fmi2FreeInstance(all[k]);
    }
    CHECK(fwrite(x, sizeof x[0], FMU_STATES, stdout) == FMU_STATES);
    return unexpected > 100 ? 100 : unexpected;
}
