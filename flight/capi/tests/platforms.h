/* Platforms that are rejected, and the platform with a wheel and a gyro that other programs begin with. Also C++. */
#ifndef PLATFORMS_H
#define PLATFORMS_H

#include <string.h>

#include "check.h"
#include "precess.h"

enum { X, Y, Z, ALPHA, BETA, GAMMA, AXES };
enum { ISOLATOR, WHEEL, GYRO, ENTRIES };

#define PLATFORM_MASS 8.0
#define WHEEL_MASS 6.0
#define STIFFNESS 4.0e3

static precess_spacecraft craft;
static precess_hub hub;
static precess_device entries[PRECESS_MAX_DEVICES + 1];

static void diagonal(double *m, double x, double y, double z)
{
    m[0] = x;
    m[4] = y;
    m[8] = z;
}

static void mounted(precess_device *device, int32_t kind, int32_t on)
{
    static precess_device none;
    *device = none;
    device->kind = kind;
    device->on = on;
    diagonal(device->mount, 1.0, 1.0, 1.0);
}

static void wheel(precess_device *device, int32_t on)
{
    mounted(device, PRECESS_KIND_REACTION_WHEEL, on);
    device->bodies[0].mass = WHEEL_MASS;
    diagonal(device->bodies[0].inertia, 0.02, 0.01, 0.01);
}

static void platform(precess_device *device)
{
    mounted(device, PRECESS_KIND_PLATFORM, 0);
    device->bodies[GAMMA].mass = PLATFORM_MASS;
    diagonal(device->bodies[GAMMA].inertia, 0.15, 0.16, 0.28);
}

/* A platform with a wheel and a gyro on it. */
static void example(void)
{
    hub.mass = 400.0;
    diagonal(hub.inertia, 120.0, 110.0, 90.0);
    platform(&entries[ISOLATOR]);
    wheel(&entries[WHEEL], 1 + ISOLATOR);
    mounted(&entries[GYRO], PRECESS_KIND_VSCMG, 1 + ISOLATOR);
    entries[GYRO].bodies[0].mass = 2.0;
    entries[GYRO].bodies[1].mass = 5.0;
    diagonal(entries[GYRO].bodies[0].inertia, 0.02, 0.02, 0.03);
    diagonal(entries[GYRO].bodies[1].inertia, 0.03, 0.02, 0.02);
}

static int32_t init(uint32_t count, precess_fault *fault)
{
    return precess_init(&craft, sizeof craft, &hub, entries, count, fault);
}

/* Panels, each on the one before it. */
static void row(int count)
{
    int index;
    for (index = 0; index < count; index++) {
        precess_device *panel = &entries[index];
        memset(panel, 0, sizeof *panel);
        panel->kind = PRECESS_KIND_HINGED_PANEL;
        panel->on = index;
        panel->mount[0] = panel->mount[4] = panel->mount[8] = 1.0;
        panel->bodies[0].mass = 2.0;
        panel->bodies[0].origin[0] = panel->bodies[0].centre[0] = 0.5;
        panel->bodies[0].inertia[0] = panel->bodies[0].inertia[4] = panel->bodies[0].inertia[8] = 0.2;
    }
}

static void rejects(int entry, int32_t code, uint32_t count)
{
    precess_fault fault;
    IS(init(count, &fault), code);
    IS(fault.device, entry);
    IS(fault.code, code);
}

static void rejected(void)
{
    precess_state state;
    precess_inputs inputs;
    precess_accelerations found;
    precess_fault fault;
    int index;
    /* On itself, on a wheel, on nothing, on less than nothing; a platform on itself. */
    for (index = 0; index < 4; index++) {
        static const int32_t on[4] = {1 + WHEEL, 1 + GYRO, 9, -1};
        example();
        entries[WHEEL].on = on[index];
        rejects(WHEEL, PRECESS_ERROR_NO_PLATFORM, ENTRIES);
    }
    example();
    platform(&entries[GYRO]);
    entries[GYRO].on = 1 + GYRO;
    rejects(GYRO, PRECESS_ERROR_NO_PLATFORM, ENTRIES);
    /* One device more than a platform takes, and one platform more than a hub. */
    example();
    for (index = 1; index < 2 + PRECESS_MAX_ON_PLATFORM; index++) {
        wheel(&entries[index], 1 + ISOLATOR);
    }
    IS(init(1 + PRECESS_MAX_ON_PLATFORM, 0), PRECESS_OK);
    rejects(1 + PRECESS_MAX_ON_PLATFORM, PRECESS_ERROR_TOO_MANY, 2 + PRECESS_MAX_ON_PLATFORM);
    for (index = 0; index < 1 + PRECESS_MAX_PLATFORMS; index++) {
        platform(&entries[index]);
    }
    IS(init(PRECESS_MAX_PLATFORMS, 0), PRECESS_OK);
    rejects(PRECESS_MAX_PLATFORMS, PRECESS_ERROR_TOO_MANY, 1 + PRECESS_MAX_PLATFORMS);
    for (index = 0; index <= PRECESS_MAX_DEVICES; index++) {
        wheel(&entries[index], 0);
    }
    rejects(-1, PRECESS_ERROR_TOO_MANY, PRECESS_MAX_DEVICES + 1);
    /* Rows of panels: five in one, two panels on a panel, a wheel on one, a row on a platform, one row too many. */
    row(PRECESS_MAX_IN_ROW);
    IS(init(PRECESS_MAX_IN_ROW, 0), PRECESS_OK);
    row(PRECESS_MAX_IN_ROW + 1);
    rejects(PRECESS_MAX_IN_ROW, PRECESS_ERROR_NO_PLATFORM, PRECESS_MAX_IN_ROW + 1);
    row(3);
    entries[2].on = 1 + 0;
    rejects(2, PRECESS_ERROR_TOO_MANY, 3);
    row(2);
    wheel(&entries[1], 1 + 0);
    rejects(1, PRECESS_ERROR_NO_PLATFORM, 2);
    row(3);
    platform(&entries[0]);
    rejects(1, PRECESS_ERROR_NO_PLATFORM, 3);
    row(6);
    for (index = 0; index < 3; index++) {
        entries[2 * index].on = 0;
        entries[2 * index + 1].on = 1 + 2 * index;
    }
    IS(init(4, 0), PRECESS_OK);
    rejects(4, PRECESS_ERROR_TOO_MANY, 6);
    /* Links of a platform have no mass; suspensions. */
    example();
    entries[ISOLATOR].bodies[Z].mass = 1.0;
    rejects(ISOLATOR, PRECESS_ERROR_UNSUPPORTED_PARAMETER, ENTRIES);
    example();
    entries[ISOLATOR].model = PRECESS_LUMPED;
    rejects(ISOLATOR, PRECESS_ERROR_UNSUPPORTED_PARAMETER, ENTRIES);
    example();
    entries[ISOLATOR].suspension.stiffness[1] = 1.0;
    rejects(ISOLATOR, PRECESS_ERROR_SUSPENSION, ENTRIES);
    example();
    entries[ISOLATOR].suspension.damping[0] = -1.0;
    rejects(ISOLATOR, PRECESS_ERROR_SUSPENSION, ENTRIES);
    example();
    entries[ISOLATOR].suspension.strut[2].stiffness = 1.0;
    rejects(ISOLATOR, PRECESS_ERROR_SUSPENSION, ENTRIES);
    example();
    entries[ISOLATOR].suspension.rest[2] = not_a_number();
    entries[ISOLATOR].suspension.damping[0] = 1.0;
    rejects(ISOLATOR, PRECESS_ERROR_NOT_FINITE, ENTRIES);
    example();
    entries[GYRO].bodies[1].mass = 0.0;
    rejects(GYRO, PRECESS_ERROR_MASS, ENTRIES);
    /* A fault names the entry, not the place in the set: here the wheel on the hub is the first of that. */
    example();
    entries[GYRO] = entries[WHEEL];
    entries[GYRO].on = 0;
    IS(init(ENTRIES, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    inputs.motor[GYRO][0] = not_a_number();
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault), PRECESS_ERROR_NOT_FINITE);
    IS(fault.device, GYRO);
    IS(fault.joint, 0);
    inputs.motor[GYRO][0] = 0.0;
    state.rate[ISOLATOR][BETA] = not_a_number();
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault), PRECESS_ERROR_NOT_FINITE);
    IS(fault.device, ISOLATOR);
    state.rate[ISOLATOR][BETA] = 0.0;
    inputs.mode[WHEEL][0] = 7;
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault), PRECESS_ERROR_UNKNOWN_CHOICE);
    IS(fault.device, WHEEL);
}

#endif
