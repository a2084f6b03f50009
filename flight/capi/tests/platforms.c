/* Platforms, in version 2 of the interface: entries that stand on one, springs and struts, and what is rejected.
 * Also C++. */

#define PRECESS_TABLE_VERSION 2

#include <string.h>

#include "platforms.h"

/* A slide gives as its spring and all mass on the platform say: by the spring of the joint, by the matrix, and
 * by a strut along it, whose force is linear in a slide along it. */
static void springs(void)
{
    const double expected = -1e-3 * STIFFNESS / (PLATFORM_MASS + WHEEL_MASS);
    precess_state state;
    precess_inputs inputs;
    precess_accelerations found;
    uint32_t joints = 0, length = 0;
    int way, axis;
    for (way = 0; way < 3; way++) {
        example();
        if (way == 0) {
            entries[ISOLATOR].passive[Y].stiffness = STIFFNESS;
        } else if (way == 1) {
            entries[ISOLATOR].suspension.stiffness[7 * Y] = STIFFNESS;
        } else {
            entries[ISOLATOR].suspension.strut[5].direction[1] = 1.0;
            entries[ISOLATOR].suspension.strut[5].length = 0.1;
            entries[ISOLATOR].suspension.strut[5].stiffness = STIFFNESS;
        }
        IS(init(2, 0), PRECESS_OK);
        IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
        IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
        inputs.hub_mode = PRECESS_HUB_FIXED;
        state.coordinate[ISOLATOR][Y] = 1e-3;
        IS(precess_accelerations_of(&craft, &state, &inputs, &found, 0), PRECESS_OK);
        for (axis = 0; axis < AXES; axis++) {
            NEAR(found.joint[ISOLATOR][axis], axis == Y ? expected : 0.0, 1e-12);
            bits(found.joint[ISOLATOR][axis]);
        }
        NEAR(found.joint[WHEEL][0], 0.0, 1e-12);
    }
    IS(precess_joints(&craft, ISOLATOR, &joints), PRECESS_OK);
    IS(joints, AXES);
    IS(precess_joints(&craft, WHEEL, &joints), PRECESS_OK);
    IS(joints, 1);
    IS(precess_joints(&craft, 2, &joints), PRECESS_OK);
    IS(joints, 0);
    IS(precess_state_length(&craft, &length), PRECESS_OK);
    IS(length, 13 + 2 * (AXES + 1));
}

/* Locked, a platform is a part of the hub. */
static void locked(void)
{
    precess_state state;
    precess_inputs inputs;
    precess_accelerations found, rigid;
    int axis;
    example();
    entries[WHEEL].bodies[0].centre[1] = 1e-4;
    IS(init(2, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.omega[2] = 0.2;
    state.rate[WHEEL][0] = 100.0;
    inputs.motor[WHEEL][0] = 0.1;
    for (axis = 0; axis < AXES; axis++) {
        inputs.mode[ISOLATOR][axis] = PRECESS_LOCKED;
    }
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, 0), PRECESS_OK);
    hub.mass += PLATFORM_MASS;
    diagonal(hub.inertia, 120.0 + 0.15, 110.0 + 0.16, 90.0 + 0.28);
    entries[0] = entries[WHEEL];
    entries[0].on = 0;
    IS(init(1, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.omega[2] = 0.2;
    state.rate[0][0] = 100.0;
    inputs.motor[0][0] = 0.1;
    IS(precess_accelerations_of(&craft, &state, &inputs, &rigid, 0), PRECESS_OK);
    for (axis = 0; axis < 3; axis++) {
        NEAR(found.linear[axis], rigid.linear[axis], 1e-14);
        NEAR(found.angular[axis], rigid.angular[axis], 1e-14);
    }
    /* Of a wheel of 0.02 kg m^2 with 0.1 N m: 5 rad/s^2. */
    NEAR(found.joint[WHEEL][0], rigid.joint[0][0], 1e-12);
    NEAR(rigid.joint[0][0], 5.0, 0.1);
}

/* On a free hub, all in motion: energy gains the work, momentum stays, loads are those of the springs; and
 * entries in another order have the same bits. */
static void conserved(void)
{
    static const int orders[2][ENTRIES] = {{0, 1, 2}, {2, 0, 1}};
    double saved[2][13 + 2 * (AXES + 3)];
    int turn, axis, place;
    for (turn = 0; turn < 2; turn++) {
        const int *const at = orders[turn];
        const int isolator = at[ISOLATOR], rw = at[WHEEL], gyro = at[GYRO];
        precess_device all[ENTRIES];
        precess_state state, restored;
        precess_inputs inputs;
        precess_momentum first, last;
        precess_power work;
        precess_loads loads;
        double before, after, lost;
        uint32_t length = 0;
        hub.mass = 400.0;
        diagonal(hub.inertia, 120.0, 110.0, 90.0);
        example();
        for (axis = 0; axis < AXES; axis++) {
            entries[ISOLATOR].passive[axis].stiffness = axis < ALPHA ? STIFFNESS : 150.0;
            entries[ISOLATOR].passive[axis].viscous = axis < ALPHA ? 20.0 : 0.4;
        }
        entries[ISOLATOR].suspension.stiffness[X * AXES + X] = 100.0;
        entries[ISOLATOR].suspension.stiffness[X * AXES + BETA] = 3.0;
        entries[ISOLATOR].suspension.stiffness[BETA * AXES + X] = 3.0;
        entries[ISOLATOR].suspension.stiffness[BETA * AXES + BETA] = 2.0;
        entries[ISOLATOR].bodies[X].origin[2] = 0.6;
        entries[WHEEL].bodies[0].origin[0] = 0.18;
        entries[WHEEL].bodies[0].centre[1] = 1e-4;
        entries[GYRO].bodies[0].origin[1] = -0.15;
        for (place = 0; place < ENTRIES; place++) {
            all[at[place]] = entries[place];
            all[at[place]].on = place == ISOLATOR ? 0 : 1 + isolator;
        }
        for (place = 0; place < ENTRIES; place++) {
            entries[place] = all[place];
        }
        IS(init(ENTRIES, 0), PRECESS_OK);
        IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
        IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
        state.omega[1] = 0.1;
        state.coordinate[isolator][X] = 1e-3;
        state.coordinate[isolator][GAMMA] = 0.01;
        state.rate[rw][0] = 100.0;
        state.rate[gyro][1] = -80.0;
        inputs.motor[rw][0] = 0.1;
        inputs.motor[gyro][0] = 0.05;
        IS(precess_energy(&craft, &state, &before, 0), PRECESS_OK);
        IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_ORIGIN, 0, &first, 0), PRECESS_OK);
        IS(precess_step(&craft, &state, &inputs, 1e-4, 1000, &work, 0), PRECESS_OK);
        IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_ORIGIN, 0, &last, 0), PRECESS_OK);
        IS(precess_energy(&craft, &state, &after, 0), PRECESS_OK);
        for (axis = 0; axis < 3; axis++) {
            NEAR(last.linear[axis], first.linear[axis], 1e-11);
            NEAR(last.angular[axis], first.angular[axis], 1e-11);
        }
        /* The error of the steps, of order dt^4. */
        NEAR(after - before, work.motors + work.springs + work.friction, 1e-9);
        IS(work.friction < 0.0, 1);
        IS(precess_loads_of(&craft, &state, &inputs, PRECESS_AXES_BODY, &loads, 0), PRECESS_OK);
        NEAR(loads.motor[rw][0], 0.1, 1e-10);
        NEAR(loads.motor[isolator][Y], 0.0, 1e-8);
        for (axis = 0; axis < 3; axis++) {
            bits(loads.mount[isolator].force[axis]);
            bits(loads.mount[rw].force[axis]);
        }
        IS(precess_state_length(&craft, &length), PRECESS_OK);
        IS(length, 13 + 2 * (AXES + 3));
        IS(precess_state_save(&craft, &state, saved[turn], length), PRECESS_OK);
        IS(precess_state_restore(&craft, saved[turn], length, &restored, 0), PRECESS_OK);
        IS(same(&state, &restored, sizeof state), 1);
        /* In the order of the example, to be compared. */
        saved[turn][13] = state.rate[rw][0];
        saved[turn][14] = state.rate[gyro][1];
        for (axis = 0; axis < AXES; axis++) {
            saved[turn][15 + 2 * axis] = state.coordinate[isolator][axis];
            saved[turn][16 + 2 * axis] = state.rate[isolator][axis];
        }
        IS(precess_state_wrap(&craft, &state), PRECESS_OK);
        for (axis = 0; axis < AXES; axis++) {
            inputs.mode[isolator][axis] = PRECESS_LOCKED;
        }
        IS(precess_energy(&craft, &state, 0, 0), PRECESS_ERROR_NULL);
        IS(precess_stop(&craft, &state, &inputs, &lost, 0), PRECESS_OK);
        IS(lost > 0.0, 1);
        NEAR(state.rate[isolator][BETA], 0.0, 0.0);
    }
    IS(same(saved[0], saved[1], (15 + 2 * AXES) * sizeof saved[0][0]), 1);
}

/* A slide on a slide: with all else locked, two masses in series, and the table of them. The force of the upper
 * spring is k2 x2 on the upper mass, and against it on the lower one. */
static void stacked(void)
{
    enum { UPPER, LOWER, RW, ALL };
    static const double place[2] = {2e-3, -1e-3};
    static const int orders[2][ALL] = {{0, 1, 2}, {2, 0, 1}};
    static uint8_t table[PRECESS_TABLE_SIZE(ALL)];
    static precess_spacecraft other;
    const double m1 = PLATFORM_MASS, m2 = PLATFORM_MASS + WHEEL_MASS, k1 = STIFFNESS, k2 = 2.0 * STIFFNESS;
    const double lower = (-k1 * place[0] + k2 * place[1]) / m1;
    double first[3];
    int turn, axis;
    for (turn = 0; turn < 2; turn++) {
        const int up = orders[turn][UPPER], low = orders[turn][LOWER], rw = orders[turn][RW];
        precess_state state, twin;
        precess_inputs inputs;
        precess_accelerations found;
        precess_loads loads;
        precess_momentum before, after;
        size_t length = 0;
        platform(&entries[up]);
        platform(&entries[low]);
        wheel(&entries[rw], 1 + up);
        entries[up].on = 1 + low;
        entries[up].bodies[0].origin[2] = 0.1;
        entries[low].passive[Y].stiffness = k1;
        entries[up].passive[Y].stiffness = k2;
        IS(init(ALL, 0), PRECESS_OK);
        IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
        IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
        inputs.hub_mode = PRECESS_HUB_FIXED;
        for (axis = 0; axis < AXES; axis++) {
            inputs.mode[low][axis] = axis == Y ? PRECESS_DRIVEN : PRECESS_LOCKED;
            inputs.mode[up][axis] = inputs.mode[low][axis];
        }
        state.coordinate[low][Y] = place[0];
        state.coordinate[up][Y] = place[1];
        IS(precess_accelerations_of(&craft, &state, &inputs, &found, 0), PRECESS_OK);
        NEAR(found.joint[low][Y], lower, 1e-12);
        NEAR(found.joint[up][Y], -k2 * place[1] / m2 - lower, 1e-12);
        IS(precess_loads_of(&craft, &state, &inputs, PRECESS_AXES_BODY, &loads, 0), PRECESS_OK);
        NEAR(loads.mount[low].force[Y], -k1 * place[0], 1e-11);
        NEAR(loads.mount[up].force[Y], -k2 * place[1], 1e-11);
        /* All free: momentum stays. */
        IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
        state.omega[1] = 0.1;
        state.rate[rw][0] = 100.0;
        IS(precess_table_write(&hub, entries, ALL, table, sizeof table, &length), PRECESS_OK);
        IS(precess_init_from_table(&other, sizeof other, table, length, 0), PRECESS_OK);
        twin = state;
        IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_ORIGIN, 0, &before, 0), PRECESS_OK);
        IS(precess_step(&craft, &state, &inputs, 1e-4, 1000, 0, 0), PRECESS_OK);
        IS(precess_step(&other, &twin, &inputs, 1e-4, 1000, 0, 0), PRECESS_OK);
        IS(same(&state, &twin, sizeof state), 1);
        IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_ORIGIN, 0, &after, 0), PRECESS_OK);
        for (axis = 0; axis < 3; axis++) {
            NEAR(after.angular[axis], before.angular[axis], 1e-11);
            bits(state.omega[axis]);
            if (turn == 0) {
                first[axis] = state.omega[axis];
            }
            IS(same(&first[axis], &state.omega[axis], sizeof first[axis]), 1);
        }
    }
    /* On a third, in a circle, and one more than there is room for. */
    for (turn = 0; turn < ALL; turn++) {
        platform(&entries[turn]);
        entries[turn].on = turn;
    }
    rejects(2, PRECESS_ERROR_NO_PLATFORM, ALL);
    entries[0].on = 1 + 1;
    rejects(0, PRECESS_ERROR_NO_PLATFORM, 2);
    entries[0].on = 0;
    entries[2].on = 1 + 0;
    rejects(2, PRECESS_ERROR_TOO_MANY, ALL);
}

/* Tables say what entries stand on. */
static void tables(void)
{
    static uint8_t table[PRECESS_TABLE_SIZE(ENTRIES)];
    static precess_spacecraft other;
    precess_state state, twin;
    precess_inputs inputs;
    size_t length = 0;
    example();
    entries[ISOLATOR].suspension.damping[7 * Z] = 9.0;
    entries[ISOLATOR].suspension.stiffness[7 * Z] = STIFFNESS;
    entries[ISOLATOR].suspension.rest[Z] = 1e-3;
    IS(precess_table_write(&hub, entries, ENTRIES, table, sizeof table, &length), PRECESS_OK);
    IS(length, PRECESS_TABLE_SIZE(ENTRIES));
    IS(precess_init_from_table(&other, sizeof other, table, length, 0), PRECESS_OK);
    IS(init(ENTRIES, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    state.rate[WHEEL][0] = 100.0;
    twin = state;
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    IS(precess_step(&craft, &state, &inputs, 1e-4, 100, 0, 0), PRECESS_OK);
    IS(precess_step(&other, &twin, &inputs, 1e-4, 100, 0, 0), PRECESS_OK);
    IS(same(&state, &twin, sizeof state), 1);
    /* On its way to rest, for 0.01 s of a period of half a second. */
    IS(state.coordinate[ISOLATOR][Z] > 8e-6, 1);
}

int main(void)
{
    hub.mass = 400.0;
    springs();
    locked();
    conserved();
    stacked();
    tables();
    rejected();
    return finish(200);
}
