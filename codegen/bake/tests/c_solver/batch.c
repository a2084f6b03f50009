/* Reads a batch as doubles; writes accelerations, states and what samples are reduced to, in columns: see
 * batch.rs of this suite. NAME and UPPER are the set's. */

#include <stdio.h>
#include <stdlib.h>

#include "NAME_batch.h"

static double *numbers(size_t count)
{
    double *const all = calloc(count == 0 ? 1 : count, sizeof *all);

    if (all == NULL) {
        exit(2);
    }
    return all;
}

static double *read_numbers(size_t count)
{
    double *const all = numbers(count);

    if (fread(all, sizeof *all, count, stdin) != count) {
        exit(3);
    }
    return all;
}

static void give(const double *all, size_t count)
{
    if (fwrite(all, sizeof *all, count, stdout) != count) {
        exit(4);
    }
}

static void give_statuses(const int *statuses, size_t count)
{
    size_t k;

    for (k = 0; k < count; k++) {
        const double status = statuses[k];

        give(&status, 1);
    }
}

int main(void)
{
    /* States, threads, parts of the run, whether parameters and inputs are each state's own; dt, steps,
     * steps between samples. */
    const double *const head = read_numbers(7);
    const size_t count = (size_t)head[0];
    const size_t threads = (size_t)head[1];
    const int parts = (int)head[2];
    const int steps = (int)head[5];
    const double *const parameters = read_numbers(UPPER_PARAMETER_NUMBERS);
    const double *const inputs = read_numbers(UPPER_SHARED_INPUT_NUMBERS);
    const double *const own_parameters = read_numbers(UPPER_PARAMETER_NUMBERS * count);
    const double *const own_inputs = read_numbers(UPPER_INPUT_NUMBERS * count);
    const size_t size = UPPER_STATE_NUMBERS * count;
    struct NAME_shared *const shared = calloc(1, sizeof *shared);
    struct precess_batch batch = { 0 };
    int status = -1;
    int bytes = 0;
    int part;
    size_t thread;

    if (shared == NULL) {
        return 2;
    }
    NAME_batch_size(&bytes, 0, 1);
    if (bytes != (int)sizeof *shared) {
        return 5;
    }
    for (thread = 0; thread < threads; thread++) {
        NAME_batch_prepare(parameters, inputs, shared, &status, thread, threads);
    }
    if (status != PRECESS_OK) {
        return 6;
    }
    batch.shared = shared;
    batch.parameters = head[3] == 0.0 ? NULL : own_parameters;
    batch.inputs = head[3] == 0.0 ? NULL : own_inputs;
    batch.states = read_numbers(size);
    batch.accelerations = numbers(UPPER_ACCELERATION_NUMBERS * count);
    batch.minimum = numbers(size);
    batch.maximum = numbers(size);
    batch.mean = numbers(size);
    batch.rms = numbers(size);
    batch.every = (int)head[6];
    batch.history = numbers(size * (size_t)(steps / batch.every + 1));
    batch.statuses = calloc(count, sizeof *batch.statuses);
    batch.dt = head[4];
    batch.count = (int)count;
    if (batch.statuses == NULL) {
        return 2;
    }
    for (thread = 0; thread < threads; thread++) {
        NAME_batch_accelerations(batch, thread, threads);
    }
    give_statuses(batch.statuses, count);
    for (thread = 0; thread < count; thread++) {
        batch.statuses[thread] = PRECESS_OK;
    }
    for (part = 0; part < parts; part++) {
        batch.first = part * steps / parts;
        batch.steps = (part + 1) * steps / parts - batch.first;
        batch.is_last = part + 1 == parts;
        for (thread = 0; thread < threads; thread++) {
            NAME_batch_run(batch, thread, threads);
        }
    }
    give_statuses(batch.statuses, count);
    give(batch.accelerations, UPPER_ACCELERATION_NUMBERS * count);
    give(batch.states, size);
    give(batch.minimum, size);
    give(batch.maximum, size);
    give(batch.mean, size);
    give(batch.rms, size);
    give(batch.history, size * (size_t)(steps / batch.every + 1));
    return 0;
}
