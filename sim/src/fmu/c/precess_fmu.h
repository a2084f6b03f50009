/**
 * @file
 * One instance of a spacecraft as a functional mock-up unit, without a version of FMI.
 *
 * All numbers are in one array, and a value reference is a place in it: time; states; their derivatives; inputs;
 * parameters. The order within each is that of model.h. Nothing is kept outside of an instance. No pointer may be null.
 */

#ifndef PRECESS_FMU_H
#define PRECESS_FMU_H

/* model.h names the solver, its sizes, and the modes of hub and gravity. */
#include "model.h"

/** Where states, derivatives, inputs and parameters start. */
#define FMU_STATES (13 + 2 * FMU_JOINTS)
#define FMU_STATE 1
#define FMU_DERIVATIVE (FMU_STATE + FMU_STATES)
#define FMU_INPUT (FMU_DERIVATIVE + FMU_STATES)
/** Force and torque on the hub, or its accelerations where they are prescribed; motors; wrenches. */
#define FMU_INPUTS (6 + FMU_DRIVEN + 6 * FMU_WRENCHES)
#define FMU_PARAMETER (FMU_INPUT + FMU_INPUTS)
/** Step; a uniform field and mu of a central one; hub; device by device the mount, body by body the rest. */
#define FMU_PER_BODY 18
#define FMU_PARAMETERS (1 + 4 + 10 + 9 * FMU_DEVICES + FMU_PER_BODY * FMU_JOINTS)
#define FMU_VALUES (FMU_PARAMETER + FMU_PARAMETERS)

/** Joint angles beyond this, rad, are brought into [-pi, pi] where no spring counts the turns. The solver takes angles up to
 * twice this. */
#define FMU_LARGE_ANGLE 8388608.0

/** Most bytes of a message. */
#define FMU_MESSAGE 512
/** The importer may integrate, and an instance's state may be copied. */
#define FMU_EXCHANGES 1
#define FMU_SAVES 1
/** It has derivatives along directions. */
#define FMU_DERIVES 1
/** Why a step is discarded at the end. */
#define FMU_END "a joint is beyond an end stop; the scenario ends there"

/** What is fixed of a joint. */
struct precess_fmu_joint {
    /** What is given of it. */
    enum precess_mode mode;
    /** The input that gives it, counted from the first motor; -1 of none. */
    int input;
    /** The largest torque of its motor, N m or N. */
    double limit;
    /** Its end stops, rad or m. */
    double lower;
    double upper;
};

/** Where a wrench acts, the inputs of which are its force and its moment about the point. */
struct precess_fmu_wrench {
    /** The joint on whose child body; FMU_JOINTS: on the hub. */
    int joint;
    /** Whether its components are expressed in N; else in the body's axes. */
    int inertial;
    /** From the body's origin, or B, in the body's axes, m. */
    double point[3];
};

/** The values of the scenario. */
extern const double precess_fmu_start[FMU_VALUES];
/** What sizes of the states are typical. */
extern const double precess_fmu_nominal[FMU_STATES];
/** Names of the devices, and that of the hub. */
extern const char *const precess_fmu_names[FMU_DEVICES + 1];
extern const struct precess_fmu_joint precess_fmu_joints[FMU_JOINTS];
/** One more than there are: an array has at least one. */
extern const struct precess_fmu_wrench precess_fmu_wrenches[FMU_WRENCHES + 1];

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

/** A parameter has another value: what was computed from parameters is computed again. */
void precess_fmu_forget(struct precess_fmu *fmu);

/** Gives back what an instance holds but itself: nothing. */
void precess_fmu_release(struct precess_fmu *fmu);

/** Whether the solver takes parameters, states and inputs: a locked joint, and a hub that is fixed, have to be at rest. */
enum precess_status precess_fmu_check(struct precess_fmu *fmu);

/** Derivatives of the states. What is locked or fixed is at rest, whatever its rates are. */
enum precess_status precess_fmu_evaluate(struct precess_fmu *fmu);

/** What the derivatives of the states change by along a direction, a number of each variable, of which those of states and
 * inputs count: exact to rounding. */
enum precess_status precess_fmu_jvp(struct precess_fmu *fmu, const double *direction, double *along);

/** Steps over `duration` seconds from `start`: each as long as the parameter `step` where that divides the duration but for
 * the rounding of both times, else each as long as the others and shorter than `step`. Angles beyond FMU_LARGE_ANGLE are
 * wrapped after each. Ends early, with `is_stopped` one, after a step that leaves a joint beyond an end stop. Nothing is
 * changed unless all succeed and no stop is passed. */
enum precess_status precess_fmu_advance(
    struct precess_fmu *fmu, double start, double duration, int *is_stopped);

/** Whether a joint is beyond an end stop. */
int precess_fmu_is_stopped(const struct precess_fmu *fmu);

/** Whether precess_fmu_wrap would change a joint's angle, one of which is beyond FMU_LARGE_ANGLE. */
int precess_fmu_is_to_wrap(struct precess_fmu *fmu);

/** Brings joint angles beyond FMU_LARGE_ANGLE into [-pi, pi], where neither a spring nor an end stop counts the turns. */
enum precess_status precess_fmu_wrap(struct precess_fmu *fmu);

/** What a status of the last function means, and what to do; written to `said` where it has a name in it. */
const char *precess_fmu_message(
    const struct precess_fmu *fmu, enum precess_status status, char said[FMU_MESSAGE]);

#endif
