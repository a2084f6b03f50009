/* Written by `precess-bake --general --batch` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * Batches: many states in columns, one thread a state, of CUDA or of a loop.
 *
 * Number k of state i is at `numbers[k * count + i]`, so that neighbouring threads read neighbouring
 * numbers. A thread takes every state whose index is its own modulo the number of threads: any
 * launch size has the same bits. Compile CUDA with --fmad=false, C99 with -ffp-contract=off.
 */

#ifndef PRECESS_BATCH_H
#define PRECESS_BATCH_H

#include <stddef.h>

#include "precess_arithmetic.h"
#include "precess_status.h"

#if defined(__CUDACC__)
/** Of a kernel. */
#define PRECESS_KERNEL extern "C" __global__ void
/** In place of what a loop passes to a kernel. */
#define PRECESS_THREAD_PARAMETERS
/** The thread, and how many there are. */
#define PRECESS_THREAD ((size_t)blockIdx.x * blockDim.x + threadIdx.x)
#define PRECESS_THREADS ((size_t)gridDim.x * blockDim.x)
#else
#define PRECESS_KERNEL void
#define PRECESS_THREAD_PARAMETERS , size_t precess_thread, size_t precess_threads
#define PRECESS_THREAD precess_thread
#define PRECESS_THREADS precess_threads
#endif

/** A batch, and where its results go. Arrays are of `count` columns; what is null is not there. */
struct precess_batch {
    /** What all states share, written by the kernel `prepare` of the set. */
    const void *shared;
    /** Parameters of the spacecraft of each state; null where all have the shared one. */
    const double *parameters;
    /** Force and torque on the hub, and the motor torque of each joint, its acceleration where it is
     * prescribed, of each state; null where all have the shared ones. */
    const double *inputs;
    /** The states; after a run those at its end, of a state that failed the last one before. */
    double *states;
    /** The first samples, where these are not to be the states at the start, or null: states as they
     * were given, before their attitudes were normalised. */
    const double *start;
    /** Written by the kernel `accelerations`: of B along the axes of B, of the hub, of the joints. */
    double *accelerations;
    /** What samples are reduced to, each of the size of `states`, or null. */
    double *minimum;
    /** See above. */
    double *maximum;
    /** Sum of the samples; their mean at the end of a run. */
    double *mean;
    /** Sum of the squares of the samples; the root of their mean at the end of a run. */
    double *rms;
    /** Samples, one after another of the size of `states`, or null. */
    double *history;
    /** The status of each state, of enum precess_status. A run leaves a state whose status is not
     * zero at its start as it is. */
    int *statuses;
    /** Step, s. */
    double dt;
    /** States. */
    int count;
    /** Steps of the run that earlier calls have taken: the run is the same in any parts. */
    int first;
    /** Steps of this call. */
    int steps;
    /** Steps between samples, at least one. The first sample is the state at the start. */
    int every;
    /** Whether this call ends the run. */
    int is_last;
};

/** A column of numbers that is read from the first to the last. */
struct precess_column {
    /** The next number. */
    const double *next;
    /** From one to the next. */
    size_t stride;
};

/** The column of a state. */
static inline struct precess_column precess_column_of(
    const double *numbers, int count, size_t state)
{
    struct precess_column column;

    column.next = numbers + state;
    column.stride = (size_t)count;
    return column;
}

/** The next number of a column. */
static inline double precess_column_next(struct precess_column *column)
{
    const double number = *column->next;

    column->next += column->stride;
    return number;
}

/** The next numbers of a column. */
static inline void precess_column_read(struct precess_column *column, double *out, int count)
{
    int k;

    for (k = 0; k < count; k++) {
        out[k] = precess_column_next(column);
    }
}

/** Writes numbers into the column of a state. */
static inline void precess_column_write(
    const double *from, int size, int count, size_t state, double *numbers)
{
    int k;

    for (k = 0; k < size; k++) {
        numbers[(size_t)k * (size_t)count + state] = from[k];
    }
}

/** Takes a sample of `size` numbers in: sample number `sample` of its state, from zero. */
static inline void precess_batch_sample(
    const struct precess_batch *batch, size_t state, const double *numbers, int size, int sample)
{
    int k;

    for (k = 0; k < size; k++) {
        const size_t place = (size_t)k * (size_t)batch->count + state;
        const double x = numbers[k];

        if (batch->minimum != NULL && (sample == 0 || x < batch->minimum[place])) {
            batch->minimum[place] = x;
        }
        if (batch->maximum != NULL && (sample == 0 || x > batch->maximum[place])) {
            batch->maximum[place] = x;
        }
        if (batch->mean != NULL) {
            batch->mean[place] = (sample == 0 ? 0.0 : batch->mean[place]) + x;
        }
        if (batch->rms != NULL) {
            batch->rms[place] = (sample == 0 ? 0.0 : batch->rms[place]) + x * x;
        }
        if (batch->history != NULL) {
            batch->history[(size_t)sample * (size_t)size * (size_t)batch->count + place] = x;
        }
    }
}

/** Ends the reductions of a state over so many samples. */
static inline void precess_batch_end(
    const struct precess_batch *batch, size_t state, int size, int samples)
{
    int k;

    for (k = 0; k < size; k++) {
        const size_t place = (size_t)k * (size_t)batch->count + state;

        if (batch->mean != NULL) {
            batch->mean[place] = batch->mean[place] / (double)samples;
        }
        if (batch->rms != NULL) {
            batch->rms[place] = precess_square_root(batch->rms[place] / (double)samples);
        }
    }
}

#endif
