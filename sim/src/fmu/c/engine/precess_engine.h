/**
 * @file
 * What the library of the simulator's engine has for C: a run of a scenario that is given time and inputs.
 *
 * A function that returns an int returns one where it did what it is for; else it writes why to `why`, of `room` bytes with the
 * zero. A run belongs to one caller at a time; runs share nothing. No pointer may be null but where a comment says so.
 */

#ifndef PRECESS_ENGINE_H
#define PRECESS_ENGINE_H

#include <stddef.h>

/** A run in progress. */
struct precess_engine;

/** Begins a run of a scenario, TOML in `size` bytes; null where it is refused. */
struct precess_engine *precess_engine_new(
    const unsigned char *scenario, size_t size, char *why, size_t room);

/** Ends a run; null is none. */
void precess_engine_free(struct precess_engine *engine);

/** Runs to a time, s, with inputs that are held; `is_over` is one where the run ends before. */
int precess_engine_advance(
    struct precess_engine *engine,
    const double *inputs,
    size_t input_count,
    double time,
    int *is_over,
    char *why,
    size_t room);

/** The outputs at the time that was reached, with these inputs. */
int precess_engine_outputs(
    struct precess_engine *engine,
    const double *inputs,
    size_t input_count,
    double *outputs,
    size_t output_count,
    char *why,
    size_t room);

/** All that a run depends on: bytes that it holds until the next call of this, and how many; null where it is refused. */
const unsigned char *precess_engine_save(
    struct precess_engine *engine, size_t *size, char *why, size_t room);

/** Goes on from such bytes, of a run of the same scenario; one that has failed goes on, too. Where it is refused nothing is
 * changed. */
int precess_engine_restore(
    struct precess_engine *engine, const unsigned char *bytes, size_t size, char *why, size_t room);

#endif
