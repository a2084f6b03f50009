/* A flight-software application in the shape of a cFS app: it computes the dynamics of its own
 * spacecraft along, woken up by the scheduler, commanded and watched from the ground. On command it points the
 * spacecraft: a law on the attitude demands a torque, steering allocates it, a servo gives it to the motors. */
#ifndef DYN_APP_H
#define DYN_APP_H

#include "precess_steering.h"

/* The scheduler wakes the app up at 10 Hz; the fastest wheel needs steps of 1 ms. */
#define DYN_SUBSTEPS 100
#define DYN_STEP 1e-3 /* s */
/* While it points, the controller samples every ten of them, at 100 Hz. */
#define DYN_CONTROL_SUBSTEPS 10

/* Housekeeping telemetry. */
typedef struct {
    uint32_t wake_ups;
    uint32_t commands;         /* accepted */
    uint32_t commands_rejected;
    uint32_t tables;           /* loaded */
    int32_t last_error;        /* PRECESS_ERROR_ of the last rejection */
    int32_t fault_device;      /* where it came from; -1 for none */
    int32_t fault_joint;
    double omega[3];           /* B axes, rad/s */
    double energy;             /* kinetic, J */
    double energy_residual;    /* energy less what it was and less all work since, J */
    double momentum_residual;  /* largest change of a component since the start, kg m^2/s */
    double torque[3];          /* demanded of the devices, B axes, N m; 0 while it does not point */
    double torque_error[3];    /* what they give less that, N m */
    uint32_t at_bound;         /* commands at their bound, since the start */
} dyn_housekeeping;

/* Command: torque, acceleration or mode of a joint from now on. A joint that moves is stopped before it is locked. */
typedef struct {
    uint32_t device;
    uint32_t joint;
    int32_t mode; /* PRECESS_DRIVEN, PRECESS_PRESCRIBED, PRECESS_LOCKED */
    double value; /* torque, N m, or acceleration, rad/s^2 */
} dyn_joint_command;

/* Command: the attitude in N that the hub is to have, and the joints that turn it there. */
typedef struct {
    double attitude[4];        /* quaternion, scalar first */
    double stiffness;          /* N m/rad */
    double damping;            /* N m s/rad */
    precess_steering_law law;  /* weights, bounds, inverse; its steered joints are driven from now on */
    double gain;               /* of the servos of gimbals, 1/s */
    double limit;              /* of every motor, N m */
} dyn_pointing_command;

/* All that the app has; the caller owns it. */
typedef struct {
    precess_spacecraft craft;
    precess_state state;
    precess_inputs inputs;
    precess_momentum first;    /* at the start */
    double expected;           /* energy at the start and all work since, J */
    int32_t points;            /* whether it points: 0 or 1 */
    dyn_pointing_command pointing;
    dyn_housekeeping telemetry;
} dyn_app;

/* Starts from a parameter table, at rest. A later table is checked first: one that is rejected leaves
 * all as it was. All four return a PRECESS_ code. */
int32_t dyn_app_load(dyn_app *app, const uint8_t *table, size_t length);

/* Executes a command. */
int32_t dyn_app_command(dyn_app *app, const dyn_joint_command *command);

/* Points from now on, until a later table. */
int32_t dyn_app_point(dyn_app *app, const dyn_pointing_command *command);

/* Advances by one cycle of the scheduler and brings the telemetry up to date. */
int32_t dyn_app_wake_up(dyn_app *app);

#endif
