/* A program that takes a unit for an importer would: calls out of order, a hundred instances, states that are restored, both
 * types. The unit has a wheel and, second, a panel with end stops. Writes the states after steps of 1 ms as doubles; what was
 * not as expected goes to standard error, and how often is the exit status. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "driver_fmi3.h"

#define INSTANCES 100

static int unexpected;
int messages;

void check(int line, int is_well)
{
    if (!is_well) {
        fprintf(stderr, "line %d\n", line);
        unexpected++;
    }
}

void say(
    fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    CHECK(environment == &messages && message && strcmp(category, "logStatusError") == 0);
    CHECK(status == fmi3Error || status == fmi3Warning);
    messages++;
}

fmi3Instance of_token(fmi3String name, fmi3String token, fmi3LogMessageCallback log)
{
    return fmi3InstantiateCoSimulation(
        name, token, NULL, fmi3False, fmi3True, fmi3False, fmi3False, NULL, 0, &messages, log, NULL);
}

fmi3Instance stepping_one(void)
{
    return of_token("unit", FMU_TOKEN, say);
}

fmi3Instance exchanged_one(void)
{
    return fmi3InstantiateModelExchange("unit", FMU_TOKEN, NULL, fmi3False, fmi3True, &messages, say);
}

fmi3Status start(fmi3Instance c)
{
    return fmi3EnterInitializationMode(c, fmi3False, 0.0, 0.0, fmi3False, 0.0);
}

void initialise(fmi3Instance c)
{
    IS_OK(start(c));
    IS_OK(fmi3ExitInitializationMode(c));
}

fmi3Status step(fmi3Instance c, double point, double size)
{
    fmi3Boolean flags[3];
    double time;

    return fmi3DoStep(c, point, size, fmi3True, &flags[0], &flags[1], &flags[2], &time);
}

fmi3Status set(fmi3Instance c, int place, double value)
{
    const fmi3ValueReference reference = (fmi3ValueReference)place;

    return fmi3SetFloat64(c, &reference, 1, &value, 1);
}

double get(fmi3Instance c, int place)
{
    const fmi3ValueReference reference = (fmi3ValueReference)place;
    double value = 0.0;

    IS_OK(fmi3GetFloat64(c, &reference, 1, &value, 1));
    return value;
}

static void states(fmi3Instance c, double x[FMU_STATES])
{
    int k;

    for (k = 0; k < FMU_STATES; k++) {
        x[k] = get(c, FMU_STATE + k);
    }
}

static void run(fmi3Instance c, int from, int count)
{
    int k;

    for (k = from; k < from + count; k++) {
        IS_OK(step(c, k * STEP, STEP));
    }
}

/* Of an instance that steps. */
static void stepping(void)
{
    fmi3Instance c = stepping_one();
    fmi3Boolean event = fmi3True;
    fmi3Boolean end = fmi3False;
    fmi3Boolean early = fmi3True;
    double x[FMU_STATES];
    double time;
    int k;

    initialise(c);
    IS_ERROR(fmi3EnterContinuousTimeMode(c));
    IS_ERROR(fmi3EnterEventMode(c));
    IS_ERROR(fmi3SetTime(c, 1.0));
    IS_ERROR(fmi3GetContinuousStateDerivatives(c, x, FMU_STATES));
    IS_ERROR(fmi3GetContinuousStates(c, x, FMU_STATES));
    IS_ERROR(fmi3SetContinuousStates(c, x, FMU_STATES));
    IS_ERROR(step(c, 7.0, STEP));
    IS_ERROR(step(c, 0.0, -STEP));
    IS_ERROR(step(c, 0.0, NAN));
    IS_ERROR(step(c, 0.0, INFINITY));
    IS_ERROR(step(c, NAN, STEP));
    IS_OK(step(c, 0.0, 0.0));
    IS_ERROR(set(c, FMU_PARAMETER, 1.0));
    IS_ERROR(set(c, FMU_STATE, 1.0));
    IS_ERROR(fmi3DoStep(c, 0.0, STEP, fmi3True, NULL, NULL, NULL, NULL));
    /* A parameter that no device has is an error until it is another one; nothing has moved. */
    states(c, x);
    IS_OK(set(c, FMU_PARAMETER + 5, -1.0));
    IS_ERROR(step(c, 0.0, STEP));
    CHECK(get(c, FMU_STATE + 13) == x[13]);
    IS_OK(set(c, FMU_PARAMETER + 5, 90.0));
    run(c, 0, 10);
    IS_OK(fmi3Terminate(c));
    IS_ERROR(fmi3Terminate(c));
    IS_ERROR(step(c, 0.01, STEP));
    /* A panel that moves out to its stop: the step is discarded, and the unit says that it has ended. */
    IS_OK(fmi3Reset(c));
    IS_OK(set(c, FMU_STATE + 13 + FMU_JOINTS + 1, 2.0));
    initialise(c);
    for (k = 0; k < 10000 && !end; k++) {
        IS_OK(fmi3DoStep(c, k * STEP, STEP, fmi3True, &event, &end, &early, &time));
    }
    CHECK(end && !event && !early && k > 100);
    CHECK(get(c, FMU_STATE + 14) < precess_fmu_joints[1].upper);
    CHECK(fabs(time - (k - 1) * STEP) < 1e-9);
    IS_ERROR(step(c, 7.0, STEP));
    /* A wheel that has turned for hours is wrapped. */
    IS_OK(fmi3Reset(c));
    IS_OK(set(c, FMU_STATE + 13, 1.6e7));
    initialise(c);
    run(c, 0, 1);
    CHECK(fabs(get(c, FMU_STATE + 13)) < 3.2);
    fmi3FreeInstance(c);
}

/* A state that is set again, and one of bytes in another instance, are followed by the same. */
static void restoring(void)
{
    fmi3Instance c = stepping_one();
    fmi3Instance other = stepping_one();
    fmi3Instance of_other_type = exchanged_one();
    fmi3FMUState state = NULL;
    fmi3FMUState of_bytes = NULL;
    fmi3Byte *bytes;
    double first[FMU_STATES];
    double again[FMU_STATES];
    const double not_finite = NAN;
    size_t size = 0;

    initialise(c);
    run(c, 0, 20);
    IS_ERROR(fmi3GetFMUState(c, NULL));
    IS_ERROR(fmi3SetFMUState(c, NULL));
    IS_ERROR(fmi3FreeFMUState(NULL, &state));
    IS_OK(fmi3GetFMUState(c, &state));
    IS_OK(fmi3GetFMUState(c, &state));
    IS_ERROR(fmi3SetFMUState(of_other_type, state));
    IS_ERROR(fmi3SerializedFMUStateSize(c, NULL, &size));
    IS_OK(fmi3SerializedFMUStateSize(c, state, &size));
    bytes = malloc(size);
    if (!bytes) {
        exit(1);
    }
    IS_ERROR(fmi3SerializeFMUState(c, state, bytes, size - 1));
    IS_OK(fmi3SerializeFMUState(c, state, bytes, size));
    run(c, 20, 20);
    states(c, first);
    IS_OK(fmi3SetFMUState(c, state));
    run(c, 20, 20);
    states(c, again);
    CHECK(memcmp(first, again, sizeof first) == 0);
    IS_ERROR(fmi3DeserializeFMUState(other, bytes, size - 1, &of_bytes));
    IS_ERROR(fmi3DeserializeFMUState(of_other_type, bytes, size, &of_bytes));
    IS_OK(fmi3DeserializeFMUState(other, bytes, size, &of_bytes));
    IS_OK(fmi3DeserializeFMUState(other, bytes, size, &of_bytes));
    IS_OK(fmi3SetFMUState(other, of_bytes));
    run(other, 20, 20);
    states(other, again);
    CHECK(memcmp(first, again, sizeof first) == 0);
    memcpy(bytes + size - sizeof not_finite, &not_finite, sizeof not_finite);
    IS_ERROR(fmi3DeserializeFMUState(other, bytes, size, &of_bytes));
    bytes[0]++;
    IS_ERROR(fmi3DeserializeFMUState(other, bytes, size, &of_bytes));
    IS_OK(fmi3FreeFMUState(c, &state));
    IS_OK(fmi3FreeFMUState(c, &state));
    IS_OK(fmi3FreeFMUState(other, &of_bytes));
    free(bytes);
    fmi3FreeInstance(c);
    fmi3FreeInstance(other);
    fmi3FreeInstance(of_other_type);
}

/* Whether states are needed again, the end, other nominals, other states, a next event. */
static fmi3Status update(fmi3Instance c, fmi3Boolean flags[5], double *next)
{
    return fmi3UpdateDiscreteStates(c, &flags[0], &flags[1], &flags[2], &flags[3], &flags[4], next);
}

static void model_exchange(void)
{
    fmi3Instance c = exchanged_one();
    fmi3Boolean flags[5];
    double next = 1.0;
    fmi3Boolean event = fmi3False;
    fmi3Boolean end = fmi3False;
    double x[FMU_STATES];
    double rates[FMU_STATES];
    size_t count = 0;
    int k;

    initialise(c);
    IS_ERROR(step(c, 0.0, STEP));
    IS_ERROR(fmi3SetContinuousStates(c, x, FMU_STATES));
    IS_ERROR(fmi3UpdateDiscreteStates(c, NULL, NULL, NULL, NULL, NULL, NULL));
    IS_OK(update(c, flags, &next));
    CHECK(!flags[0] && !flags[1] && !flags[2] && !flags[3] && !flags[4] && next == 0.0);
    IS_OK(fmi3EnterContinuousTimeMode(c));
    IS_ERROR(update(c, flags, &next));
    IS_ERROR(fmi3SetTime(c, NAN));
    IS_OK(fmi3SetTime(c, 0.5));
    CHECK(get(c, 0) == 0.5);
    IS_ERROR(fmi3GetContinuousStates(c, x, FMU_STATES - 1));
    IS_OK(fmi3GetContinuousStates(c, x, FMU_STATES));
    IS_OK(fmi3SetContinuousStates(c, x, FMU_STATES));
    IS_OK(fmi3GetContinuousStateDerivatives(c, rates, FMU_STATES));
    for (k = 0; k < FMU_STATES; k++) {
        CHECK(get(c, FMU_DERIVATIVE + k) == rates[k]);
    }
    IS_OK(fmi3GetNominalsOfContinuousStates(c, rates, FMU_STATES));
    IS_OK(fmi3GetNumberOfContinuousStates(c, &count));
    CHECK(count == FMU_STATES);
    IS_OK(fmi3GetNumberOfEventIndicators(c, &count));
    CHECK(count == 0);
    IS_ERROR(fmi3GetNumberOfEventIndicators(c, NULL));
    /* In this mode each state is a variable that may be set. */
    IS_OK(set(c, FMU_STATE, 1.5));
    IS_OK(fmi3GetContinuousStates(c, x, FMU_STATES));
    CHECK(x[0] == 1.5);
    IS_ERROR(fmi3GetEventIndicators(c, rates, 1));
    IS_OK(fmi3GetEventIndicators(c, rates, 0));
    IS_OK(fmi3CompletedIntegratorStep(c, fmi3True, &event, &end));
    CHECK(!event && !end);
    IS_ERROR(set(c, FMU_PARAMETER + 5, 91.0));
    IS_OK(set(c, FMU_INPUT, 1.0));
    /* A wheel that has turned for hours needs an event, and is wrapped there; beyond twice that its sine is refused. */
    x[13] = 1.6e7;
    IS_OK(fmi3SetContinuousStates(c, x, FMU_STATES));
    IS_OK(fmi3CompletedIntegratorStep(c, fmi3True, &event, &end));
    CHECK(event && !end);
    IS_OK(fmi3EnterEventMode(c));
    IS_OK(set(c, FMU_PARAMETER + 5, 91.0));
    IS_OK(update(c, flags, &next));
    CHECK(flags[3] && !flags[0] && !flags[1]);
    IS_OK(fmi3GetContinuousStates(c, x, FMU_STATES));
    CHECK(fabs(x[13]) < 3.2);
    IS_OK(fmi3EnterContinuousTimeMode(c));
    x[13] = 1.7e7;
    IS_OK(fmi3SetContinuousStates(c, x, FMU_STATES));
    IS_ERROR(fmi3GetContinuousStateDerivatives(c, rates, FMU_STATES));
    x[13] = NAN;
    IS_ERROR(fmi3SetContinuousStates(c, x, FMU_STATES));
    x[13] = 0.0;
    x[14] = 3.0;
    IS_OK(fmi3SetContinuousStates(c, x, FMU_STATES));
    IS_OK(fmi3CompletedIntegratorStep(c, fmi3True, &event, &end));
    CHECK(end);
    IS_OK(fmi3Terminate(c));
    IS_ERROR(fmi3SetTime(c, 1.0));
    fmi3FreeInstance(c);
}

/* The states after a step of one instance with its wheel at an angle, by each type. */
static void wrapped(double angle)
{
    const int wheel = FMU_STATE + 13;
    double x[FMU_STATES];
    double next;
    fmi3Boolean flags[5];
    fmi3Instance c = stepping_one();

    IS_OK(set(c, wheel, angle));
    initialise(c);
    run(c, 0, 1);
    states(c, x);
    fmi3FreeInstance(c);
    CHECK(fwrite(x, sizeof x[0], FMU_STATES, stdout) == FMU_STATES);
    c = exchanged_one();
    IS_OK(set(c, wheel, angle));
    initialise(c);
    IS_OK(update(c, flags, &next));
    states(c, x);
    fmi3FreeInstance(c);
    CHECK(fwrite(x, sizeof x[0], FMU_STATES, stdout) == FMU_STATES);
}

int main(int count, char **arguments)
{
    const int steps = count > 1 ? atoi(arguments[1]) : 0;
    fmi3Instance all[INSTANCES];
    double x[FMU_STATES];
    int k;

    if (count > 2) {
        wrapped(atof(arguments[2]));
        return unexpected;
    }
    CHECK(strcmp(fmi3GetVersion(), "3.0") == 0);
    before_initialisation();
    absent();
    stepping();
    restoring();
    model_exchange();
    CHECK(messages > 40);
    for (k = 0; k < INSTANCES; k++) {
        all[k] = stepping_one();
        initialise(all[k]);
    }
    /* Side by side, the last by steps of another length, of which the solver's are parts. */
    for (k = 0; k < steps; k++) {
        int n;

        for (n = 0; n + 1 < INSTANCES; n++) {
            IS_OK(step(all[n], k * STEP, STEP));
        }
    }
    for (k = 0; k < steps; k += 10) {
        IS_OK(step(all[INSTANCES - 1], k * STEP, 10 * STEP));
    }
    states(all[0], x);
    for (k = 0; k < INSTANCES; k++) {
        double other[FMU_STATES];

        states(all[k], other);
        CHECK(memcmp(x, other, sizeof x) == 0);
        fmi3FreeInstance(all[k]);
    }
    CHECK(fwrite(x, sizeof x[0], FMU_STATES, stdout) == FMU_STATES);
    return unexpected > 100 ? 100 : unexpected;
}
