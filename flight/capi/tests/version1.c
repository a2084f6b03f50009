/* A program of version 1 of the interface in one executable with one of version 2, which is version2.c: it
 * writes a table and steps a spacecraft of it, for the other to do the same. */

#include "versions.h"
#include "precess.h"

/* Writes a table of a DGVSCMG and a reaction wheel; steps it and saves its state as doubles. */
uint32_t version_1_run(uint8_t *table, size_t capacity, size_t *length, double *numbers)
{
    static precess_spacecraft craft;
    static precess_device devices[2];
    precess_hub hub = {800.0, {0.0, 0.0, 0.0}, {900.0, 0.0, 0.0, 0.0, 800.0, 0.0, 0.0, 0.0, 600.0}};
    precess_state state;
    precess_inputs inputs;
    uint32_t count = 0;
    int device, joint, axis;
    devices[0].kind = PRECESS_KIND_DGVSCMG;
    devices[1].kind = PRECESS_KIND_REACTION_WHEEL;
    for (device = 0; device < 2; device++) {
        for (joint = 0; joint < PRECESS_MAX_JOINTS; joint++) {
            devices[device].bodies[joint].mass = 2.0;
            for (axis = 0; axis < 3; axis++) {
                devices[device].mount[4 * axis] = 1.0;
                devices[device].bodies[joint].inertia[4 * axis] = axis == 0 ? 0.2 : 0.1;
            }
        }
    }
    devices[0].bodies[2].centre[1] = 8e-5;
    devices[1].passive[0].viscous = 1e-3;
    if (precess_table_write(&hub, devices, 2, table, capacity, length) != PRECESS_OK
        || precess_init(&craft, sizeof craft, &hub, devices, 2, 0) != PRECESS_OK
        || precess_state_at_rest(&craft, &state) != PRECESS_OK
        || precess_inputs_none(&craft, &inputs) != PRECESS_OK) {
        return 0;
    }
    state.omega[1] = 0.1;
    state.rate[0][2] = 50.0;
    state.rate[1][0] = 20.0;
    inputs.motor[0][1] = 0.2;
    if (precess_step(&craft, &state, &inputs, 1e-3, 100, 0, 0) != PRECESS_OK
        || precess_state_length(&craft, &count) != PRECESS_OK
        || precess_state_save(&craft, &state, numbers, count) != PRECESS_OK) {
        return 0;
    }
    return count;
}

/* What version 1 says of a spacecraft that version 2 made. */
int32_t version_1_of(const void *craft)
{
    precess_state state;
    return precess_state_at_rest((const precess_spacecraft *)craft, &state);
}
