/**
 * @file
 * What an instance over the emitted solver has. precess_fmu.h includes it.
 */

#ifndef PRECESS_FMU_DATA_H
#define PRECESS_FMU_DATA_H

/* model.h names the solver, its sizes, and the modes of hub and gravity. */
#include "model.h"

#define FMU_STATES (13 + 2 * FMU_JOINTS)
#define FMU_DERIVATIVE (FMU_STATE + FMU_STATES)
/** Force and torque on the hub, or its accelerations where they are prescribed; motors; wrenches. */
#define FMU_INPUTS (6 + FMU_DRIVEN + 6 * FMU_WRENCHES)
/** Step; a uniform field and mu of a central one; hub; device by device the mount, body by body the rest. */
#define FMU_PER_BODY 18
#define FMU_PARAMETERS (1 + 4 + 10 + 9 * FMU_DEVICES + FMU_PER_BODY * FMU_JOINTS)

/** Joint angles beyond this, rad, are brought into [-pi, pi] where no spring counts the turns. The solver takes angles up to
 * twice this. */
#define FMU_LARGE_ANGLE 8388608.0

#define FMU_EXCHANGES 1
#define FMU_DERIVES 1
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

#endif
