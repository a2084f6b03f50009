/* Precess: error codes, kinds of devices, and choices. Included by precess.h. */
#ifndef PRECESS_CONSTANTS_H
#define PRECESS_CONSTANTS_H

/* Error codes. precess_error_text has the remedy. */
enum {
    PRECESS_OK = 0,
    PRECESS_ERROR_NULL = 1,
    PRECESS_ERROR_MISALIGNED = 2,
    PRECESS_ERROR_TOO_SMALL = 3,
    PRECESS_ERROR_NOT_INITIALISED = 4,
    PRECESS_ERROR_TOO_MANY = 5,
    PRECESS_ERROR_UNKNOWN_KIND = 6,
    PRECESS_ERROR_UNKNOWN_CHOICE = 7,
    PRECESS_ERROR_UNSUPPORTED_PARAMETER = 8,
    PRECESS_ERROR_NOT_FINITE = 9,
    PRECESS_ERROR_MASS = 10,
    PRECESS_ERROR_INERTIA = 11,
    PRECESS_ERROR_MOUNT = 12,
    PRECESS_ERROR_PASSIVE = 13,
    PRECESS_ERROR_SINGULAR = 14,
    PRECESS_ERROR_LOCKED_JOINT_MOVES = 15,
    PRECESS_ERROR_FIXED_HUB_MOVES = 16,
    PRECESS_ERROR_NOT_DRIVEN = 17,
    PRECESS_ERROR_AT_CENTRE = 18,
    PRECESS_ERROR_OVERFLOW = 19,
    PRECESS_ERROR_TABLE_MAGIC = 20,
    PRECESS_ERROR_TABLE_VERSION = 21,
    PRECESS_ERROR_TABLE_LENGTH = 22,
    PRECESS_ERROR_TABLE_CHECKSUM = 23,
    PRECESS_ERROR_OTHER = 24,
    PRECESS_ERROR_UNSTABLE = 25,
    PRECESS_ERROR_MANY_JOINTS = 26,
    PRECESS_ERROR_NO_PLATFORM = 27,
    PRECESS_ERROR_SUSPENSION = 28,
    PRECESS_ERROR_COMMAND = 29,
    PRECESS_ERROR_NO_TORQUE = 30,
    PRECESS_ERROR_NO_STEERING = 31,
    PRECESS_ERROR_RANGE = 32,
    PRECESS_ERROR_UNDETERMINED = 33
};

/* Kinds of devices, with their joints from the hub outwards. At zero, outer and only gimbals turn
 * about z, inner gimbals about y, wheels about x. A balanced kind has a wheel that is the same from
 * every angle; what it has no parameter for must be 0. The wheel of a DGCMG or SGCMG keeps its rate:
 * its torque is found by precess_loads. */
enum {
    PRECESS_KIND_DGVSCMG = 1,                 /* outer gimbal, inner gimbal, wheel */
    PRECESS_KIND_BALANCED_DGVSCMG = 2,        /* outer gimbal, inner gimbal, wheel */
    PRECESS_KIND_DGCMG = 3,                   /* outer gimbal, inner gimbal, wheel at its rate */
    PRECESS_KIND_BALANCED_DGCMG = 4,          /* outer gimbal, inner gimbal, wheel at its rate */
    PRECESS_KIND_VSCMG = 5,                   /* gimbal, wheel */
    PRECESS_KIND_BALANCED_VSCMG = 6,          /* gimbal, wheel */
    PRECESS_KIND_SGCMG = 7,                   /* gimbal, wheel at its rate */
    PRECESS_KIND_BALANCED_SGCMG = 8,          /* gimbal, wheel at its rate */
    PRECESS_KIND_REACTION_WHEEL = 9,          /* wheel */
    PRECESS_KIND_BALANCED_REACTION_WHEEL = 10, /* wheel */
    PRECESS_KIND_HINGED_PANEL = 11,           /* panel, which turns about z */
    PRECESS_KIND_SLOSH_MASS = 12,             /* point mass, which slides along x */
    PRECESS_KIND_FLEXIBLE_REACTION_WHEEL = 13, /* bearings: axial slide (x), radial slides y and z, tilts y
                                                  and z; wheel. Version 2. Only the wheel has a body, only
                                                  the first joint an origin */
    PRECESS_KIND_FLEXIBLE_VSCMG = 14           /* gimbal; bearings and wheel as above. Version 2. Only gimbal
                                                  and wheel have bodies, only gimbal and axial slide an
                                                  origin */
};

#if PRECESS_TABLE_VERSION == 2
/* An isolated platform: slides along x, y, z of its mount, then turns about x, the turned y, its own z. Only
 * the last of its bodies has mass, only the first joint an origin, with every coordinate zero. It stands on the
 * hub or on a platform there; entries that name it in `on` stand on it, their origins and mounts in its axes. */
enum { PRECESS_KIND_PLATFORM = 100 };
#endif

/* Model of a wheel's imbalance: the rotor itself, or the usual lumped disturbance (only
 * imbalanced kinds). */
enum { PRECESS_COUPLED = 0, PRECESS_LUMPED = 1 };

/* Mode of a joint: its torque is an input; its acceleration is; it is at rest. */
enum { PRECESS_DRIVEN = 0, PRECESS_PRESCRIBED = 1, PRECESS_LOCKED = 2 };

/* Mode of the hub: free; at rest; its accelerations are inputs. */
enum { PRECESS_HUB_FREE = 0, PRECESS_HUB_FIXED = 1, PRECESS_HUB_PRESCRIBED = 2 };

/* Gravity: none; the same everywhere; of a central body at the origin of N, with its gradient. */
enum { PRECESS_GRAVITY_NONE = 0, PRECESS_GRAVITY_UNIFORM = 1, PRECESS_GRAVITY_CENTRAL = 2 };

/* Axes of loads: of the child body of the joint; of its parent body; B; N. */
enum { PRECESS_AXES_BODY = 0, PRECESS_AXES_PARENT = 1, PRECESS_AXES_HUB = 2, PRECESS_AXES_INERTIAL = 3 };

/* The point about which angular momentum is taken: the origin of N; the centre of mass of the whole
 * spacecraft; a point fixed in N. */
enum { PRECESS_ABOUT_ORIGIN = 0, PRECESS_ABOUT_CENTRE_OF_MASS = 1, PRECESS_ABOUT_POINT = 2 };

#endif
