/**
 * @file
 * One instance of a unit, without a version of FMI. There are two implementations: over the emitted solver of a spacecraft, and
 * over the simulator's engine, which runs a scenario in Co-Simulation alone.
 *
 * All numbers are in one array, and a value reference is a place in it. Over the solver: time; states; their derivatives;
 * inputs; parameters. Over the engine: time; outputs; inputs. The order within each is that of model.h. Nothing is kept outside of
 * an instance. No pointer may be null.
 */

#ifndef PRECESS_FMU_H
#define PRECESS_FMU_H

/** Where states or outputs, inputs and parameters start, and how many values there are. */
#define FMU_STATE 1
#define FMU_INPUT (FMU_DERIVATIVE + FMU_STATES)
#define FMU_PARAMETER (FMU_INPUT + FMU_INPUTS)
#define FMU_VALUES (FMU_PARAMETER + FMU_PARAMETERS)

/** Most bytes of a message. */
#define FMU_MESSAGE 512

/* Of the solver or of the engine: FMU_STATES, FMU_DERIVATIVE, FMU_INPUTS, FMU_PARAMETERS, FMU_DEVICES; `struct precess_fmu`;
 * whether the importer may integrate, FMU_EXCHANGES, and there are derivatives along directions, FMU_DERIVES; why a step is
 * discarded at the end, FMU_END; `enum precess_status`. */
#include <stddef.h>

#include "precess_fmu_data.h"

/** The values of the scenario; what is computed is zero. */
extern const double precess_fmu_start[FMU_VALUES];
/** What sizes of the states or outputs are typical. */
extern const double precess_fmu_nominal[FMU_STATES];

/** Sets every value to that of the scenario, with no run begun. What is all zero may be reset, too. */
void precess_fmu_reset(struct precess_fmu *fmu);

/** A parameter has another value: what was computed from parameters is computed again. */
void precess_fmu_forget(struct precess_fmu *fmu);

/** Gives back what an instance, or a saved one, holds but itself: the run of the engine. */
void precess_fmu_release(struct precess_fmu *fmu);

/** Copies an instance to a saved one, which is all zero or was copied to before, and back. The message of a refusal is of
 * `fmu`; nothing is changed then. */
enum precess_status precess_fmu_save(struct precess_fmu *fmu, struct precess_fmu *saved);
enum precess_status precess_fmu_restore(struct precess_fmu *fmu, const struct precess_fmu *saved);

/** What a saved instance has beside its values, as bytes: how many, and these. */
size_t precess_fmu_rest_size(const struct precess_fmu *saved);
void precess_fmu_write_rest(const struct precess_fmu *saved, unsigned char *bytes);

/** Reads it to a saved instance that has values only; whether values and bytes, of which there are so many or more, are those of
 * an instance. */
int precess_fmu_read_rest(struct precess_fmu *saved, const unsigned char *bytes, size_t size);

/** Whether the solver takes parameters, states and inputs: a locked joint, and a hub that is fixed, have to be at rest. The
 * engine begins the run with the inputs: at 0 s. */
enum precess_status precess_fmu_check(struct precess_fmu *fmu);

/** Derivatives of the states, where what is locked or fixed is at rest, whatever its rates are; or the outputs at the present
 * time. */
enum precess_status precess_fmu_evaluate(struct precess_fmu *fmu);

/** What the derivatives of the states change by along a direction, a number of each variable, of which those of states and
 * inputs count: exact to rounding. Refused by the engine. */
enum precess_status precess_fmu_jvp(struct precess_fmu *fmu, const double *direction, double *along);

/** Steps over `duration` seconds from `start`, with inputs that are held. Of the solver each step is as long as the parameter
 * `step` where that divides the duration but for the rounding of both times, else each as long as the others and shorter than
 * `step`; angles beyond FMU_LARGE_ANGLE are wrapped after each. The engine takes the steps of its scenario. Ends early, with
 * `is_stopped` one: after a step that leaves a joint beyond an end stop, or with the run. Nothing is changed unless all succeed
 * and there is no end. */
enum precess_status precess_fmu_advance(
    struct precess_fmu *fmu, double start, double duration, int *is_stopped);

/** Whether a joint is beyond an end stop, or the run has ended. */
int precess_fmu_is_stopped(const struct precess_fmu *fmu);

/** Whether precess_fmu_wrap would change a joint's angle, one of which is beyond FMU_LARGE_ANGLE. The engine wraps by
 * itself. */
int precess_fmu_is_to_wrap(struct precess_fmu *fmu);

/** Brings joint angles beyond FMU_LARGE_ANGLE into [-pi, pi], where neither a spring nor an end stop counts the turns. */
enum precess_status precess_fmu_wrap(struct precess_fmu *fmu);

/** What a status of the last function means, and what to do; written to `said` where it has a name in it. */
const char *precess_fmu_message(
    const struct precess_fmu *fmu, enum precess_status status, char said[FMU_MESSAGE]);

#endif
