/* Precess: fully coupled dynamics of a spacecraft with momentum devices, for flight software.
 *
 * Everything is in SI units and radians. A spacecraft is in memory that the caller owns; states
 * and inputs are structures of numbers. No function allocates, keeps anything elsewhere, or unwinds. All
 * may be called by several tasks at once, each with its own state; a spacecraft may be shared, since
 * only precess_init and precess_init_from_table change it.
 *
 * Every function that can be rejected returns an error code, 0 (PRECESS_OK) if all went well; then,
 * and only then, has it written its results (a text that does not fit is cut): a call that is rejected
 * changes nothing but `fault`. `fault` may be null; otherwise the cause of the rejection is written to
 * it. Any other pointer that is null is rejected, and any pointer that is misaligned, `fault` too.
 *
 * Axes: N is inertial, B fixed in the hub. A device's own axes are those of its first body where its
 * joint is at zero. Vectors are x, y, z; matrices are stored row by row. Values of joints are in
 * [device][joint], joints counted from the hub outwards; entries without a joint are not read, and
 * are 0 in results.
 */
#ifndef PRECESS_H
#define PRECESS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this header, 0x00MMmmpp; precess_version() is that of the library. */
#define PRECESS_VERSION 0x00000100

/* Version of the interface: that of the layout of a parameter table, and of the structures below. 1 unless
 * it is defined before this header is included; 2 is for devices of up to seven joints, and for platforms. The
 * library has the functions of both: a program compiled with version 1 needs no change. Structures and
 * spacecraft of one version are not for functions of the other; tables of version 1 are read by both. */
#ifndef PRECESS_TABLE_VERSION
#define PRECESS_TABLE_VERSION 1
#endif

#define PRECESS_MAX_DEVICES 8
#define PRECESS_MAX_SUBSTEPS 1000

/* Joints of a device, and length of a parameter table in bytes for so many devices. */
#if PRECESS_TABLE_VERSION == 1
#define PRECESS_MAX_JOINTS 3
#define PRECESS_TABLE_SIZE(devices) (124 + 584 * (devices))
#define PRECESS_SPACECRAFT_SIZE 16384
#define PRECESS_JOINT_GAINS_SIZE 5120
#elif PRECESS_TABLE_VERSION == 2
#define PRECESS_MAX_JOINTS 7
#define PRECESS_TABLE_SIZE(devices) (124 + 2320 * (devices))
#define PRECESS_SPACECRAFT_SIZE 73728
#define PRECESS_JOINT_GAINS_SIZE 28672
#define PRECESS_MAX_PLATFORMS 4   /* platforms on the hub without platforms on them, */
#define PRECESS_MAX_LOWER 1       /* on the hub with platforms on them, */
#define PRECESS_MAX_UPPER 1       /* platforms on each of these, */
#define PRECESS_MAX_ON_PLATFORM 4 /* devices on each platform: all count as devices; */
#define PRECESS_MAX_ROWS 2        /* panels on the hub that carry one, */
#define PRECESS_MAX_IN_ROW 4      /* panels in a row with it */
#define precess_init precess_init_v2
#define precess_init_from_table precess_init_from_table_v2
#define precess_table_write precess_table_write_v2
#define precess_state_at_rest precess_state_at_rest_v2
#define precess_state_wrap precess_state_wrap_v2
#define precess_state_save precess_state_save_v2
#define precess_state_restore precess_state_restore_v2
#define precess_inputs_none precess_inputs_none_v2
#define precess_accelerations_of precess_accelerations_of_v2
#define precess_step precess_step_v2
#define precess_stop precess_stop_v2
#define precess_energy precess_energy_v2
#define precess_momentum_of precess_momentum_of_v2
#define precess_loads_of precess_loads_of_v2
#define precess_contributions_of precess_contributions_of_v2
#define precess_eliminate precess_eliminate_v2
#define precess_joint_accelerations_of precess_joint_accelerations_of_v2
#else
#error "PRECESS_TABLE_VERSION is 1 or 2"
#endif

/* Alignment of the memory of a spacecraft, in bytes; its size is above. */
#define PRECESS_SPACECRAFT_ALIGN 8

#include "precess_constants.h"

/* Memory of a spacecraft; its contents are the library's. May be copied as a whole. */
typedef struct precess_spacecraft {
    uint64_t opaque[PRECESS_SPACECRAFT_SIZE / 8];
} precess_spacecraft;

/* Where a rejection comes from. */
typedef struct precess_fault {
    int32_t code;     /* the error code */
    int32_t device;   /* index of the device; -1 for the hub, or for none */
    int32_t joint;    /* index of the joint in its device; -1 for none */
    int32_t reserved; /* 0 */
    double value;     /* the value at fault; 0 where there is none */
    double bound;     /* the bound it breaks; 0 where there is none */
} precess_fault;

/* The hub without its devices. */
typedef struct precess_hub {
    double mass;       /* kg, above 0 */
    double centre[3];  /* centre of mass from the reference point B, B axes, m */
    double inertia[9]; /* about the centre of mass, B axes, kg m^2 */
} precess_hub;

/* A body of a device. */
typedef struct precess_body {
    double mass;       /* kg; above 0 for the last body, not below 0 for the others */
    double origin[3];  /* origin of its joint; of the first body from B along B axes, of the others
                          from the origin of the parent body in its axes, m */
    double centre[3];  /* centre of mass from its origin, own axes, m; of a wheel on its y axis, 0 of
                          a balanced one and of a slosh mass */
    double inertia[9]; /* about its centre of mass, own axes, kg m^2; 0 of a slosh mass; diagonal
                          with equal y and z moments of a balanced wheel */
} precess_body;

/* Spring, damper and friction of a joint: u = -k (q - rest) - viscous q' - coulomb q' / sqrt(q'^2 + rate^2). */
typedef struct precess_passive {
    double stiffness;    /* N m/rad, sliding joint N/m; not below 0 */
    double rest;         /* coordinate at which the spring rests, rad or m */
    double viscous;      /* N m s/rad or N s/m; not below 0 */
    double coulomb;      /* N m or N; not below 0 */
    double coulomb_rate; /* rad/s or m/s; above 0 where coulomb is */
} precess_passive;

#if PRECESS_TABLE_VERSION == 2
/* A strut between base and platform that turns freely at both ends; all zero where there is none. */
typedef struct precess_strut {
    double position[3];  /* its end on the platform, from its origin, its axes, m */
    double direction[3]; /* unit vector from base to platform with every coordinate zero, mount axes */
    double length;       /* with every coordinate zero, where it exerts no force, m; above 0 */
    double stiffness;    /* N/m; not below 0 */
    double damping;      /* N s/m; not below 0 */
} precess_strut;

/* Springs and dampers that couple the six joints of a platform, beside those of single joints; all zero where
 * there are none. Potential 1/2 (q - rest)' stiffness (q - rest), q the coordinates of the joints in order. */
typedef struct precess_suspension {
    double stiffness[36]; /* N/m, N/rad, N m/rad; symmetric, positive semidefinite */
    double rest[6];       /* m, rad */
    double damping[36];   /* N s/m, N s/rad, N m s/rad; symmetric, positive semidefinite */
    precess_strut strut[6];
} precess_suspension;
#endif

/* A device: as many bodies and joints are read as its kind has. */
typedef struct precess_device {
    int32_t kind;                                /* PRECESS_KIND_ */
    int32_t model;                               /* PRECESS_COUPLED or PRECESS_LUMPED */
    double mount[9];                             /* its columns are the device's axes along B */
    precess_body bodies[PRECESS_MAX_JOINTS];     /* from the hub outwards */
    precess_passive passive[PRECESS_MAX_JOINTS]; /* of the joint of each body */
#if PRECESS_TABLE_VERSION == 2
    int32_t on;       /* 0: on the hub; otherwise 1 + index of the platform that it stands on, or panel a panel */
    int32_t reserved; /* 0 */
    precess_suspension suspension; /* of a platform; not read of other kinds */
#endif
} precess_device;

/* State of the hub and of the joints. */
typedef struct precess_state {
    double position[3]; /* of B from the origin of N, N axes, m */
    double velocity[3]; /* of B, N axes, m/s */
    double attitude[4]; /* of B in N: quaternion, scalar first */
    double omega[3];    /* angular velocity of B in N, B axes, rad/s */
    double coordinate[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* rad, sliding joint m */
    double rate[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* relative to the parent body, rad/s or m/s */
} precess_state;

/* A force and its moment about the point that each use names. */
typedef struct precess_wrench {
    double force[3];  /* N */
    double moment[3]; /* N m */
} precess_wrench;

/* Forces, torques and modes; constant during a call in the axes that each field names. */
typedef struct precess_inputs {
    double force[3];  /* external force through B, B axes, N */
    double torque[3]; /* external torque about B, B axes, N m */
    double motor[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS];      /* of driven joints, N m or N */
    double prescribed[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* of prescribed joints, rad/s^2 or
                                                                   m/s^2 */
    double hub_linear[3];  /* of a prescribed hub: acceleration of B, B axes, m/s^2 */
    double hub_angular[3]; /* of a prescribed hub: angular acceleration, B axes, rad/s^2 */
    double gravity[3];     /* uniform field, N axes, m/s^2 */
    double mu;             /* gravitational parameter of the central body, m^3/s^2 */
    precess_wrench wrench[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* on the child body of each
                              joint, about its origin, the body's own axes */
    int32_t mode[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* PRECESS_DRIVEN, _PRESCRIBED, _LOCKED */
    int32_t hub_mode;      /* PRECESS_HUB_ */
    int32_t gravity_model; /* PRECESS_GRAVITY_ */
    int32_t wrenches;      /* 1: wrench is read; 0: it is not */
    int32_t reserved;      /* 0 */
} precess_inputs;

/* All accelerations. */
typedef struct precess_accelerations {
    double linear[3];  /* inertial acceleration of B, B axes (velocity is along N), m/s^2 */
    double angular[3]; /* angular acceleration of B, B axes, rad/s^2 */
    double joint[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* rad/s^2 or m/s^2 */
} precess_accelerations;

/* Momenta of the whole spacecraft. */
typedef struct precess_momentum {
    double linear[3];  /* N axes, kg m/s */
    double angular[3]; /* N axes, kg m^2/s */
} precess_momentum;

/* Work of each source during a step, J. */
typedef struct precess_power {
    double external; /* force, torque, wrenches on bodies, lumped disturbances */
    double hub;      /* wrench that a prescribed hub needs */
    double gravity;
    double motors;   /* those of prescribed joints among them */
    double springs;
    double friction; /* not above 0 */
} precess_power;

/* Loads of joints and mounts. */
typedef struct precess_loads {
    precess_wrench hub; /* what must act on the hub in addition to the inputs, about B, B axes: rounding on a
                           free hub, what a table exerts on a fixed one */
    precess_wrench mount[PRECESS_MAX_DEVICES]; /* what the hub, or its platform, exerts on each device, about
                           the device's place: the origin of its first joint at coordinate zero; N axes with
                           PRECESS_AXES_INERTIAL, B axes with PRECESS_AXES_HUB, otherwise those of what it
                           stands on, B or the platform's */
    precess_wrench joint[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* what the parent body exerts on
                           the child body of each joint, about its origin, along PRECESS_AXES_ */
    double motor[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* torque of each motor, N m or N: the
                           input of a driven joint, computed for a prescribed or locked one */
} precess_loads;

/* What the devices contribute to the equations of a hub that the caller has, their joints eliminated; B axes.
 * [force_by_linear  force_by_angular ] and (force, moment) are added to the hub's own mass matrix and load of
 * [force_by_angular' moment_by_angular]   (M_hub + M) (a, omega') = load_hub + load, a being the inertial
 * acceleration of B; in a uniform field g, along B, a is that acceleration less g. Accelerations of the
 * joints are those on a prescribed hub with this a and omega', without gravity. */
typedef struct precess_contributions {
    double force_by_linear[9];    /* symmetric, kg */
    double force_by_angular[9];   /* kg m; its transpose is moment by a */
    double moment_by_angular[9];  /* symmetric, kg m^2 */
    double force[3];              /* N */
    double moment[3];             /* about B, N m */
    double mass;                  /* of the devices, kg */
    double first_moment[3];       /* of the devices about B, kg m */
    double first_moment_prime[3]; /* its derivative seen from B, kg m/s */
    double inertia[9];            /* of the devices about B, joints locked, kg m^2 */
} precess_contributions;

/* Memory of what precess_eliminate keeps of the joints; its contents are the library's. May be copied as a whole. */
typedef struct precess_joint_gains {
    uint64_t opaque[PRECESS_JOINT_GAINS_SIZE / 8];
} precess_joint_gains;

/* Version of the library: PRECESS_VERSION of the header it belongs to. */
uint32_t precess_version(void);

/* Name of an error code, "PRECESS_ERROR_NULL"; static, never null. */
const char *precess_error_name(int32_t code);

/* Writes what a code means and its remedy, cut to `length` bytes with the zero that ends it
 * (PRECESS_ERROR_TOO_SMALL if it was cut). 128 bytes hold every text. */
int32_t precess_error_text(int32_t code, char *buffer, size_t length);

/* Makes a spacecraft in `size` bytes of `memory`, of a hub and `count` devices (null if none). If
 * rejected, the memory is as it was: what was a spacecraft still is one. */
int32_t precess_init(void *memory, size_t size, const precess_hub *hub,
                     const precess_device *devices, uint32_t count, precess_fault *fault);

/* The same from a parameter table of `length` bytes, aligned or not. */
int32_t precess_init_from_table(void *memory, size_t size, const uint8_t *table, size_t length,
                                precess_fault *fault);

/* Writes the parameter table of a hub and `count` devices; its bytes are counted in `length`.
 * The parameters are checked by precess_init_from_table, not here. Little-endian on every target:
 * offset 0 "PREC"; 4 version; 8 length in bytes; 12 number of devices n (32 bits each); 16 the hub,
 * 13 doubles; 120 + s k device k, 2 integers of 32 bits and 72 doubles (in version 2: 156 doubles, 2 integers,
 * 132 doubles); both in the order of their structures, nothing padded; 120 + s n CRC-32 of all before (ISO-HDLC,
 * that of zip). s is 584, in version 2 2320. */
int32_t precess_table_write(const precess_hub *hub, const precess_device *devices, uint32_t count,
                            uint8_t *table, size_t capacity, size_t *length);

/* Mass of hub and devices, kg. */
int32_t precess_mass(const precess_spacecraft *craft, double *mass);

/* How many joints a device has: 0 for a device that does not exist. */
int32_t precess_joints(const precess_spacecraft *craft, uint32_t device, uint32_t *joints);

/* The state in which all is at zero: B at the origin of N, axes along N, nothing moving. */
int32_t precess_state_at_rest(const precess_spacecraft *craft, precess_state *state);

/* Brings joint angles into [-pi, pi] (rad), without a jump in anything else: the angle of a joint with
 * a spring stays, because its spring counts the turns. Other calls do not wrap angles; wrap a wheel's from
 * time to time, since sines of large angles cost more. */
int32_t precess_state_wrap(const precess_spacecraft *craft, precess_state *state);

/* How many doubles save a state: 13 and two per joint. */
int32_t precess_state_length(const precess_spacecraft *craft, uint32_t *count);

/* Saves a state as doubles in a row, bit by bit: position (m), velocity (m/s), attitude, omega
 * (rad/s), then coordinate and rate of each joint. `count` is the capacity of `numbers`. */
int32_t precess_state_save(const precess_spacecraft *craft, const precess_state *state,
                           double *numbers, uint32_t count);

/* Restores a saved state. `count` must be precess_state_length (PRECESS_ERROR_TOO_SMALL for any
 * other); rejected if a number is not finite. */
int32_t precess_state_restore(const precess_spacecraft *craft, const double *numbers,
                              uint32_t count, precess_state *state, precess_fault *fault);

/* The inputs in which nothing acts: motors off, hub free, every joint as its kind has it (a wheel
 * that keeps its rate is PRECESS_PRESCRIBED with 0). Start from these. */
int32_t precess_inputs_none(const precess_spacecraft *craft, precess_inputs *inputs);

/* All accelerations (m/s^2, rad/s^2) for a state and its inputs. */
int32_t precess_accelerations_of(const precess_spacecraft *craft, const precess_state *state,
                                 const precess_inputs *inputs, precess_accelerations *out,
                                 precess_fault *fault);

/* Advances the state by `substeps` Runge-Kutta steps (fourth order) of `dt` seconds each, 1 to
 * PRECESS_MAX_SUBSTEPS. With a good dt the fastest wheel turns by a tenth of a radian. A dt that a spring,
 * damper or dry friction makes unstable is PRECESS_ERROR_UNSTABLE, with the longest stable one in
 * fault.bound. `work` (J) may be null, which is cheaper. If rejected, the state is as it was. */
int32_t precess_step(const precess_spacecraft *craft, precess_state *state,
                     const precess_inputs *inputs, double dt, uint32_t substeps,
                     precess_power *work, precess_fault *fault);

/* Stops every locked joint, and a fixed hub, impulsively: momentum is conserved (unless the hub is
 * fixed or prescribed), `lost` is the energy dissipated, J (may be null). Needed before a moving joint
 * is locked. */
int32_t precess_stop(const precess_spacecraft *craft, precess_state *state,
                     const precess_inputs *inputs, double *lost, precess_fault *fault);

/* Kinetic energy of hub and devices, J. */
int32_t precess_energy(const precess_spacecraft *craft, const precess_state *state, double *energy,
                       precess_fault *fault);

/* Linear momentum, kg m/s, and angular momentum, kg m^2/s, about PRECESS_ABOUT_; `point` (N axes, m,
 * three doubles) is read only for PRECESS_ABOUT_POINT, otherwise it may be null. */
int32_t precess_momentum_of(const precess_spacecraft *craft, const precess_state *state,
                            int32_t about, const double *point, precess_momentum *out,
                            precess_fault *fault);

/* What the devices contribute to the equations of the caller's hub. Of the inputs motors, modes and wrenches of the
 * joints are read; the hub of the spacecraft and what acts on it, gravity included, are not. */
int32_t precess_contributions_of(const precess_spacecraft *craft, const precess_state *state,
                                 const precess_inputs *inputs, precess_contributions *out,
                                 precess_fault *fault);

/* The same, and the gains by which the accelerations of the joints follow. */
int32_t precess_eliminate(const precess_spacecraft *craft, const precess_state *state,
                          const precess_inputs *inputs, precess_contributions *out,
                          precess_joint_gains *gains, precess_fault *fault);

/* Accelerations of the joints where those of the hub are a = `linear` (m/s^2) and omega' = `angular` (rad/s^2) of
 * precess_contributions, three numbers each, which are copied to `out`. The gains are those of this spacecraft. */
int32_t precess_joint_accelerations_of(const precess_spacecraft *craft, const precess_joint_gains *gains,
                                       const double *linear, const double *angular,
                                       precess_accelerations *out, precess_fault *fault);

/* Loads (N, N m) at this instant, joints' along PRECESS_AXES_. */
int32_t precess_loads_of(const precess_spacecraft *craft, const precess_state *state,
                         const precess_inputs *inputs, int32_t axes, precess_loads *out,
                         precess_fault *fault);

#ifdef __cplusplus
}
#endif

#endif
