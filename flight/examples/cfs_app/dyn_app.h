/* A flight-software application in the shape of a cFS app: it computes the dynamics of its own
 * spacecraft along, woken up by the scheduler, commanded and watched from the ground. */
#ifndef DYN_APP_H
#define DYN_APP_H

#include "precess.h"

/* The scheduler wakes the app up at 10 Hz; the fastest wheel needs steps of 1 ms. */
#define DYN_SUBSTEPS 100
#define DYN_STEP 1e-3 /* s */

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
} dyn_housekeeping;

/* Command: torque, acceleration or mode of a joint from now on. A joint that moves is stopped before it is locked. */
typedef struct {
    uint32_t device;
    uint32_t joint;
    int32_t mode; /* PRECESS_DRIVEN, PRECESS_PRESCRIBED, PRECESS_LOCKED */
    double value; /* torque, N m, or acceleration, rad/s^2 */
} dyn_joint_command;

/* All that the app has; the caller owns it. */
typedef struct {
    precess_spacecraft craft;
    precess_state state;
    precess_inputs inputs;
    precess_momentum first;    /* at the start */
    double expected;           /* energy at the start and all work since, J */
    dyn_housekeeping telemetry;
} dyn_app;

/* Starts from a parameter table, at rest. A later table is checked first: one that is rejected leaves
 * all as it was. All three return a PRECESS_ code. */
int32_t dyn_app_load(dyn_app *app, const uint8_t *table, size_t length);

/* Executes a command. */
int32_t dyn_app_command(dyn_app *app, const dyn_joint_command *command);

/* Advances by one cycle of the scheduler and brings the telemetry up to date. */
int32_t dyn_app_wake_up(dyn_app *app);

#endif
