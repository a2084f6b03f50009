/**
 * @file
 * What an instance over the simulator's engine has. precess_fmu.h includes it.
 */

#ifndef PRECESS_FMU_DATA_H
#define PRECESS_FMU_DATA_H

#include <stddef.h>

/* model.h has the numbers of outputs and inputs, and what identifies the unit. */
#include "model.h"
#include "precess_engine.h"

/** Outputs are in the place of states and derivatives; no state is set, and there are no parameters. */
#define FMU_STATES FMU_OUTPUTS
#define FMU_DERIVATIVE FMU_STATE
#define FMU_PARAMETERS 0
#define FMU_DEVICES 0

/* The engine takes the steps. */
#define FMU_EXCHANGES 0
#define FMU_DERIVES 0
#define FMU_END "the run has ended: the scenario's duration, an end stop or a crossing"

/** Whether a function did what it is for. */
enum precess_status {
    PRECESS_OK,
    PRECESS_REFUSED
};

/** The scenario, and how many bytes it has. */
extern const unsigned char precess_fmu_scenario[];
extern const size_t precess_fmu_scenario_size;

/** An instance. */
struct precess_fmu {
    double values[FMU_VALUES];
    /** The run, once it is needed. */
    struct precess_engine *engine;
    /** Of a saved instance in the place of its run: what that depends on, in so many bytes; null where none had begun. */
    unsigned char *saved;
    size_t saved_size;
    /** Whether the run has ended before the time that was asked for. */
    int is_over;
    /** Why the last function refused. */
    char why[FMU_MESSAGE];
};

/** Magnitude; and whether numbers are neither infinite nor NaN. */
double precess_magnitude(double x);
int precess_is_finite(double x);
int precess_are_finite(const double *numbers, int count);

#endif
