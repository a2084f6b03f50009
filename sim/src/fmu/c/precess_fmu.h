/**
 * @file
 * One instance of a spacecraft as a functional mock-up unit, without a version of FMI.
 *
 * All numbers are in one array, and a value reference is a place in it: time; states; their derivatives; inputs;
 * parameters. The order within each is that of model.h. Nothing is kept outside of an instance. No pointer may be null.
 */

#ifndef PRECESS_FMU_H
#define PRECESS_FMU_H

/* model.h names the solver, its sizes and where inputs are. */
#include "model.h"

/** Where states, derivatives, inputs and parameters start. */
#define FMU_STATES (13 + 2 * FMU_JOINTS)
#define FMU_STATE 1
#define FMU_DERIVATIVE (FMU_STATE + FMU_STATES)
#define FMU_INPUT (FMU_DERIVATIVE + FMU_STATES)
#define FMU_INPUTS (6 + FMU_DRIVEN)
#define FMU_PARAMETER (FMU_INPUT + FMU_INPUTS)
/** Step; three or one of gravity; hub; device by device the mount, body by body the rest. */
#define FMU_PER_BODY 18
#define FMU_PARAMETERS (1 + 4 + 10 + 9 * FMU_DEVICES + FMU_PER_BODY * FMU_JOINTS)
#define FMU_VALUES (FMU_PARAMETER + FMU_PARAMETERS)

/** The values of the scenario. */
extern const double precess_fmu_start[FMU_VALUES];
/** The mode of each joint, and the input that drives it: -1 of none. */
extern const enum precess_mode precess_fmu_modes[FMU_JOINTS];
extern const int precess_fmu_inputs[FMU_JOINTS];

/** An instance's numbers, and the solver that is prepared from them. */
struct precess_fmu {
    double values[FMU_VALUES];
    /** Whether `spacecraft` is that of the parameters. */
    int is_prepared;
    /** Device whose parameters were refused; FMU_DEVICES: the hub. */
    int device;
    struct FMU_SOLVER_SPACECRAFT spacecraft;
};

/** Sets every value to that of the scenario. */
void precess_fmu_reset(struct precess_fmu *fmu);

/** Derivatives of the states. */
enum precess_status precess_fmu_evaluate(struct precess_fmu *fmu);

/** Steps over `duration` seconds, each as long as the others and no longer than the parameter `step`; wheel angles are
 * wrapped after each. Nothing is changed unless all succeed. */
enum precess_status precess_fmu_advance(struct precess_fmu *fmu, double duration);

/** What a status means, and what to do. */
const char *precess_fmu_message(enum precess_status status);

#endif
