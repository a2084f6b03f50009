/* The ground and the scheduler, on this machine: ten seconds of the app, with a table, commands, and
 * what goes wrong; forty more in which it points. Prints telemetry; exits with 1 unless all is as it must be. */

#include <stdio.h>
#include <string.h>

#include "dyn_app.h"

/* Bounds of the residuals after ten seconds: energy to 1e-12 of what the motors did. */
#define ENERGY_BOUND 1e-9   /* J */
#define MOMENTUM_BOUND 1e-11 /* kg m^2/s */

static dyn_app app;
static uint8_t table[PRECESS_TABLE_SIZE(PRECESS_MAX_DEVICES)];

/* The table as a tool on the ground writes it: a hub, a DGVSCMG off balance, a wheel, a panel. */
static size_t write_table(void)
{
    static const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const double across[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    precess_hub hub;
    precess_device devices[3];
    size_t length = 0;
    int axis, joint;
    memset(&hub, 0, sizeof hub);
    memset(devices, 0, sizeof devices);
    hub.mass = 800.0;
    devices[0].kind = PRECESS_KIND_DGVSCMG;
    devices[1].kind = PRECESS_KIND_REACTION_WHEEL;
    devices[2].kind = PRECESS_KIND_HINGED_PANEL;
    for (axis = 0; axis < 3; axis++) {
        hub.inertia[4 * axis] = 600.0 + 100.0 * axis;
        for (joint = 0; joint < 3; joint++) {
            devices[joint].bodies[0].inertia[4 * axis] = 0.1;
            devices[0].bodies[joint].inertia[4 * axis] = 0.1;
            devices[0].bodies[joint].mass = 4.0;
        }
    }
    memcpy(devices[0].mount, unit, sizeof unit);
    memcpy(devices[1].mount, across, sizeof across);
    memcpy(devices[2].mount, unit, sizeof unit);
    devices[0].bodies[0].origin[0] = 0.3;
    devices[0].bodies[2].centre[1] = 8e-5;
    devices[1].bodies[0].mass = 4.0;
    devices[1].bodies[0].centre[1] = 8e-5;
    devices[2].bodies[0].mass = 15.0;
    devices[2].bodies[0].origin[0] = 1.0;
    devices[2].bodies[0].centre[0] = 0.8;
    devices[2].passive[0].stiffness = 20.0;
    devices[2].passive[0].viscous = 0.5;
    if (precess_table_write(&hub, devices, 3, table, sizeof table, &length) != PRECESS_OK) {
        return 0;
    }
    return length;
}

static void send(int32_t expected, uint32_t device, uint32_t joint, int32_t mode, double value)
{
    dyn_joint_command command;
    char text[128];
    int32_t code;
    command.device = device;
    command.joint = joint;
    command.mode = mode;
    command.value = value;
    code = dyn_app_command(&app, &command);
    (void)precess_error_text(code, text, sizeof text);
    printf("command to joint %u of device %u: %s\n", (unsigned)joint, (unsigned)device, text);
    if (code != expected) {
        printf("expected %s\n", precess_error_name(expected));
        app.telemetry.last_error = -1;
    }
}

/* Points back to where it started, by the gimbals and the wheel of the DGVSCMG and by the other wheel. */
static int point(void)
{
    static dyn_pointing_command command;
    static const uint32_t joints[4][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 0}};
    const dyn_housekeeping *telemetry = &app.telemetry;
    int k, cycle;
    command.attitude[0] = 1.0;
    command.stiffness = 60.0;
    command.damping = 380.0;
    command.gain = 20.0;
    command.limit = 5.0;
    command.law.reference = 2.0;
    command.law.bounded = 1;
    for (k = 0; k < 4; k++) {
        uint32_t device = joints[k][0], joint = joints[k][1];
        int is_gimbal = device == 0 && joint < 2;
        command.law.steered[device][joint] = is_gimbal ? PRECESS_STEER_RATE : PRECESS_STEER_ACCELERATION;
        command.law.weight[device][joint] = is_gimbal ? 1.0 : 100.0;
        command.law.upper[device][joint] = is_gimbal ? 0.5 : 20.0;
        command.law.lower[device][joint] = -command.law.upper[device][joint];
    }
    command.law.weight[0][1] = -1.0;
    if (dyn_app_point(&app, &command) != PRECESS_ERROR_COMMAND || telemetry->fault_joint != 1) {
        printf("a weight below zero: not rejected as it must be\n");
        return 1;
    }
    command.law.weight[0][1] = 1.0;
    if (dyn_app_point(&app, &command) != PRECESS_OK) {
        printf("pointing rejected: %s\n", precess_error_name(telemetry->last_error));
        return 1;
    }
    for (cycle = 0; cycle < 400; cycle++) {
        if (dyn_app_wake_up(&app) != PRECESS_OK) {
            printf("sample rejected: %s\n", precess_error_name(telemetry->last_error));
            return 1;
        }
        if (cycle % 80 == 79) {
            printf("%4.1f s  omega %+.2e %+.2e %+.2e rad/s  axis %+.2e %+.2e %+.2e  torque %+.2e %+.2e %+.2e N m\n",
                   10.0 + 0.1 * (cycle + 1), telemetry->omega[0], telemetry->omega[1], telemetry->omega[2],
                   app.state.attitude[1], app.state.attitude[2], app.state.attitude[3], telemetry->torque[0],
                   telemetry->torque[1], telemetry->torque[2]);
        }
    }
    fprintf(stderr, "pointing: residuals %.1e J, %.1e kg m^2/s, %u commands at their bounds\n",
            telemetry->energy_residual, telemetry->momentum_residual, (unsigned)telemetry->at_bound);
    for (k = 0; k < 3; k++) {
        double angle = 2.0 * app.state.attitude[1 + k], bound = 1e-5;
        if (angle > bound || angle < -bound) {
            printf("axis %d is off by %.1e rad\n", k, angle);
            return 1;
        }
    }
    return telemetry->energy_residual < ENERGY_BOUND && telemetry->energy_residual > -ENERGY_BOUND &&
                   telemetry->momentum_residual < MOMENTUM_BOUND
               ? 0
               : 1;
}

int main(void)
{
    const dyn_housekeeping *telemetry = &app.telemetry;
    size_t length = write_table();
    int cycle, within_bounds;
    if (dyn_app_load(&app, table, length) != PRECESS_OK) {
        printf("table rejected: %s\n", precess_error_name(telemetry->last_error));
        return 1;
    }
    for (cycle = 0; cycle < 100; cycle++) {
        if (cycle == 0) {
            send(PRECESS_OK, 0, 2, PRECESS_DRIVEN, 0.2);
            send(PRECESS_OK, 1, 0, PRECESS_PRESCRIBED, 5.0);
        }
        if (cycle == 30) {
            send(PRECESS_OK, 0, 0, PRECESS_LOCKED, 0.0);
            send(PRECESS_ERROR_UNKNOWN_CHOICE, 1, 0, 7, 0.0);
        }
        if (cycle == 60) {
            send(PRECESS_OK, 1, 0, PRECESS_LOCKED, 0.0);
            send(PRECESS_OK, 0, 0, PRECESS_DRIVEN, 0.0);
            send(PRECESS_ERROR_UNKNOWN_CHOICE, 5, 0, PRECESS_LOCKED, 0.0);
        }
        if (dyn_app_wake_up(&app) != PRECESS_OK) {
            printf("step rejected: %s\n", precess_error_name(telemetry->last_error));
            return 1;
        }
        if (cycle % 20 == 19) {
            printf("%4.1f s  omega %+.6e %+.6e %+.6e rad/s  energy %.6f J\n", 0.1 * (cycle + 1),
                   telemetry->omega[0], telemetry->omega[1], telemetry->omega[2], telemetry->energy);
            within_bounds = telemetry->energy_residual < ENERGY_BOUND && telemetry->energy_residual > -ENERGY_BOUND &&
                    telemetry->momentum_residual < MOMENTUM_BOUND && telemetry->last_error >= 0;
            if (!within_bounds) {
                printf("residuals %.1e J, %.1e kg m^2/s out of bounds\n", telemetry->energy_residual,
                       telemetry->momentum_residual);
                return 1;
            }
        }
    }
    fprintf(stderr, "residuals %.1e J, %.1e kg m^2/s\n", telemetry->energy_residual,
            telemetry->momentum_residual);

    if (point() != 0) {
        return 1;
    }

    /* A table that was damaged in transmission changes nothing. */
    table[500] ^= 0x40;
    if (dyn_app_load(&app, table, length) != PRECESS_ERROR_TABLE_CHECKSUM || telemetry->tables != 1 ||
        dyn_app_wake_up(&app) != PRECESS_OK || telemetry->wake_ups != 501) {
        printf("damaged table: not rejected as it must be\n");
        return 1;
    }
    printf("damaged table rejected, %u commands accepted, %u rejected\n", (unsigned)telemetry->commands,
           (unsigned)telemetry->commands_rejected);
    return 0;
}
