/**
 * @file
 * One instance of a scenario that the simulator's engine runs, without a version of FMI: for Co-Simulation.
 *
 * All numbers are in one array, and a value reference is a place in it: time; outputs; inputs. The order within each is that
 * of model.h. What the engine holds is the instance's own. No pointer may be null.
 */

#ifndef PRECESS_FMU_H
#define PRECESS_FMU_H

#include <stddef.h>

/* model.h has the numbers of outputs and inputs, and what identifies the unit. */
#include "model.h"
#include "precess_engine.h"

/** Where outputs and inputs start; there are no states that are set, and no parameters. */
#define FMU_STATES FMU_OUTPUTS
#define FMU_STATE 1
#define FMU_DERIVATIVE 1
#define FMU_INPUT (FMU_DERIVATIVE + FMU_OUTPUTS)
#define FMU_PARAMETER (FMU_INPUT + FMU_INPUTS)
#define FMU_DEVICES 0
#define FMU_VALUES FMU_PARAMETER

/** Most bytes of a message. */
#define FMU_MESSAGE 512
/** The engine takes the steps, and its state is not copied. */
#define FMU_EXCHANGES 0
#define FMU_SAVES 0
#define FMU_DERIVES 0
/** Why a step is discarded at the end. */
#define FMU_END "the run has ended: the scenario's duration, an end stop or a crossing"

/** Whether a function did what it is for. */
enum precess_status {
    PRECESS_OK,
    PRECESS_REFUSED
};

/** The values at the start; outputs are computed. */
extern const double precess_fmu_start[FMU_VALUES];
/** What sizes of the outputs are typical. */
extern const double precess_fmu_nominal[FMU_STATES];
/** The scenario, and how many bytes it has. */
extern const unsigned char precess_fmu_scenario[];
extern const size_t precess_fmu_scenario_size;

/** An instance. */
struct precess_fmu {
    double values[FMU_VALUES];
    /** The run, once it is needed. */
    struct precess_engine *engine;
    /** Whether the run has ended before the time that was asked for. */
    int is_over;
    /** Why the last function refused. */
    char why[FMU_MESSAGE];
};

/** Sets every value to that of the scenario, with no run begun. What is all zero may be reset, too. */
void precess_fmu_reset(struct precess_fmu *fmu);

/** There are no parameters. */
void precess_fmu_forget(struct precess_fmu *fmu);

/** Ends the run. */
void precess_fmu_release(struct precess_fmu *fmu);

/** Begins the run with these inputs: at 0 s. */
enum precess_status precess_fmu_check(struct precess_fmu *fmu);

/** The outputs at the present time. */
enum precess_status precess_fmu_evaluate(struct precess_fmu *fmu);

/** There are no derivatives: refused. */
enum precess_status precess_fmu_jvp(struct precess_fmu *fmu, const double *direction, double *along);

/** Runs to `start + duration` with inputs that are held. `is_stopped` is one where the run ends before that. */
enum precess_status precess_fmu_advance(
    struct precess_fmu *fmu, double start, double duration, int *is_stopped);

/** Nothing is stopped before the first step, and no angle is wrapped. */
int precess_fmu_is_stopped(const struct precess_fmu *fmu);
int precess_fmu_is_to_wrap(struct precess_fmu *fmu);
enum precess_status precess_fmu_wrap(struct precess_fmu *fmu);

/** Why the last function refused. */
const char *precess_fmu_message(
    const struct precess_fmu *fmu, enum precess_status status, char said[FMU_MESSAGE]);

/** Magnitude; and whether numbers are neither infinite nor NaN. */
double precess_magnitude(double x);
int precess_is_finite(double x);
int precess_are_finite(const double *numbers, int count);

#endif
