/* An importer of a unit over an engine that is none: a run is the sum of time by inputs. States are copied, also where no run has
 * begun, where one has failed and where one has ended; what is not as expected goes to standard error, and how often is the exit
 * status. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "precess_fmu.h"

/* The end of a run, s, and an input that makes it fail. */
#define END 0.5
#define FAILS 1e9

static int unexpected;
static int runs;

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

struct precess_engine {
    double kept[2];
    int has_failed;
};

static int refused(const char *message, char *why, size_t room)
{
    CHECK(strlen(message) < room);
    memcpy(why, message, strlen(message) + 1);
    return 0;
}

struct precess_engine *precess_engine_new(
    const unsigned char *scenario, size_t size, char *why, size_t room)
{
    CHECK(scenario[size] == 0 && why && room);
    runs++;
    return calloc(1, sizeof(struct precess_engine));
}

void precess_engine_free(struct precess_engine *engine)
{
    runs -= engine != NULL;
    free(engine);
}

int precess_engine_advance(
    struct precess_engine *engine,
    const double *inputs,
    size_t input_count,
    double time,
    int *is_over,
    char *why,
    size_t room)
{
    CHECK(input_count == FMU_INPUTS);
    if (engine->has_failed || inputs[0] == FAILS) {
        engine->has_failed = 1;
        return refused("it has failed", why, room);
    }
    *is_over = time > END;
    engine->kept[0] += inputs[0] * (time - engine->kept[1]);
    engine->kept[1] = time;
    return 1;
}

int precess_engine_outputs(
    struct precess_engine *engine,
    const double *inputs,
    size_t input_count,
    double *outputs,
    size_t output_count,
    char *why,
    size_t room)
{
    CHECK(inputs && input_count == FMU_INPUTS && output_count == FMU_OUTPUTS);
    if (engine->has_failed) {
        return refused("it has failed", why, room);
    }
    outputs[0] = engine->kept[0];
    /* What has not been measured. */
    outputs[1] = engine->kept[0] - engine->kept[0];
    outputs[1] /= outputs[1];
    return 1;
}

const unsigned char *precess_engine_save(
    struct precess_engine *engine, size_t *size, char *why, size_t room)
{
    if (engine->has_failed) {
        refused("it has failed", why, room);
        return NULL;
    }
    *size = sizeof engine->kept;
    return (const unsigned char *)engine->kept;
}

int precess_engine_restore(
    struct precess_engine *engine, const unsigned char *bytes, size_t size, char *why, size_t room)
{
    if (size != sizeof engine->kept) {
        return refused("no state", why, room);
    }
    memcpy(engine->kept, bytes, size);
    engine->has_failed = 0;
    return 1;
}

static void say(
    fmi2ComponentEnvironment environment,
    fmi2String name,
    fmi2Status status,
    fmi2String category,
    fmi2String format,
    ...)
{
    (void)environment;
    CHECK(name && category && format && status == fmi2Error);
}

static const fmi2CallbackFunctions CALLBACKS = { say, NULL, NULL, NULL, NULL };

static fmi2Component made(void)
{
    return fmi2Instantiate("unit", fmi2CoSimulation, FMU_TOKEN, NULL, &CALLBACKS, fmi2False, fmi2False);
}

static void push(fmi2Component c, double force)
{
    const fmi2ValueReference reference = FMU_INPUT;

    IS_OK(fmi2SetReal(c, &reference, 1, &force));
}

/* Steps of an eighth of a second, which are exact; the first output after them. */
static double run(fmi2Component c, int from, int to)
{
    const fmi2ValueReference reference = FMU_STATE;
    double value = -1.0;
    int k;

    for (k = from; k < to; k++) {
        IS_OK(fmi2DoStep(c, 0.125 * k, 0.125, fmi2True));
    }
    IS_OK(fmi2GetReal(c, &reference, 1, &value));
    return value;
}

static void initialise(fmi2Component c)
{
    IS_OK(fmi2EnterInitializationMode(c));
    IS_OK(fmi2ExitInitializationMode(c));
}

static void bytes_of_a_state(fmi2Component c, fmi2FMUstate state, double later)
{
    fmi2Component other = made();
    fmi2FMUstate of_bytes = NULL;
    size_t size = 0, k;
    char *bytes;

    IS_OK(fmi2SerializedFMUstateSize(c, state, &size));
    CHECK(size > FMU_VALUES * sizeof(double) + 2 * sizeof(double));
    bytes = malloc(size);
    IS_ERROR(fmi2SerializeFMUstate(c, state, bytes, size - 1));
    IS_OK(fmi2SerializeFMUstate(c, state, bytes, size));
    for (k = 0; k < size; k++) {
        IS_ERROR(fmi2DeSerializeFMUstate(other, bytes, k, &of_bytes));
    }
    CHECK(of_bytes == NULL);
    IS_OK(fmi2DeSerializeFMUstate(other, bytes, size, &of_bytes));
    IS_OK(fmi2DeSerializeFMUstate(other, bytes, size, &of_bytes));
    free(bytes);
    /* Where no run has begun. */
    IS_OK(fmi2SetFMUstate(other, of_bytes));
    CHECK(run(other, 2, 4) == later);
    IS_OK(fmi2FreeFMUstate(other, &of_bytes));
    fmi2FreeInstance(other);
}

int main(void)
{
    fmi2Component c = made();
    fmi2FMUstate first = NULL, state = NULL, none = NULL;
    double later;

    IS_OK(fmi2GetFMUstate(c, &first));
    CHECK(runs == 0);
    initialise(c);
    push(c, 8.0);
    CHECK(run(c, 0, 1) == 1.0);
    push(c, 16.0);
    CHECK(run(c, 1, 2) == 3.0);
    IS_OK(fmi2GetFMUstate(c, &state));
    later = run(c, 2, 4);
    CHECK(later == 7.0);
    /* It has ended. */
    CHECK(fmi2DoStep(c, 0.5, 0.125, fmi2True) == fmi2Discard);
    IS_OK(fmi2SetFMUstate(c, state));
    CHECK(run(c, 2, 4) == later);
    bytes_of_a_state(c, state, later);
    /* The input is restored, too. */
    IS_OK(fmi2SetFMUstate(c, state));
    push(c, FAILS);
    IS_ERROR(fmi2DoStep(c, 0.25, 0.125, fmi2True));
    IS_ERROR(fmi2GetFMUstate(c, &none));
    CHECK(none == NULL);
    IS_OK(fmi2SetFMUstate(c, state));
    CHECK(run(c, 2, 4) == later);
    /* One in the place of another. */
    IS_OK(fmi2GetFMUstate(c, &state));
    IS_OK(fmi2SetFMUstate(c, state));
    CHECK(run(c, 4, 4) == later);
    /* Before initialisation, where there was no run. */
    IS_OK(fmi2SetFMUstate(c, first));
    CHECK(runs == 0);
    IS_ERROR(fmi2DoStep(c, 0.0, 0.125, fmi2True));
    initialise(c);
    push(c, 8.0);
    CHECK(run(c, 0, 2) == 2.0);
    IS_OK(fmi2FreeFMUstate(c, &first));
    IS_OK(fmi2FreeFMUstate(c, &state));
    fmi2FreeInstance(c);
    CHECK(runs == 0);
    return unexpected;
}
