/* Version 2 of the interface, with devices of up to seven joints: a wheel on flexible bearings, the same in a
 * gimbal, and what a program of version 1 does, with the same bits. Also C++. */

#define PRECESS_TABLE_VERSION 2

#include "check.h"
#include "precess.h"
#include "versions.h"

enum { AXIAL, RADIAL_Y, RADIAL_Z, TILT_Y, TILT_Z, WHEEL, JOINTS };

/* Rotor: kg, kg m^2. Springs of the bearings: N/m, N m/rad. With the tilts' one, the square root of the closed
 * form of the whirls is a whole number. */
#define MASS 4.0
#define AXIAL_INERTIA 0.03
#define ACROSS 0.02
#define STIFFNESS 5.0e4
#define TILT_STIFFNESS 3200.0

static precess_spacecraft craft;
static precess_hub hub;
static precess_device wheel;

static void diagonal(double *m, double x, double y, double z)
{
    m[0] = x;
    m[4] = y;
    m[8] = z;
}

static void example(void)
{
    int joint;
    hub.mass = 80.0;
    diagonal(hub.inertia, 12.0, 10.0, 9.0);
    wheel.kind = PRECESS_KIND_FLEXIBLE_REACTION_WHEEL;
    diagonal(wheel.mount, 1.0, 1.0, 1.0);
    wheel.bodies[AXIAL].origin[0] = 0.3;
    wheel.bodies[WHEEL].mass = MASS;
    diagonal(wheel.bodies[WHEEL].inertia, AXIAL_INERTIA, ACROSS, ACROSS);
    for (joint = AXIAL; joint < WHEEL; joint++) {
        wheel.passive[joint].stiffness = joint < TILT_Y ? STIFFNESS : TILT_STIFFNESS;
    }
}

static int32_t init(precess_fault *fault)
{
    return precess_init(&craft, sizeof craft, &hub, &wheel, 1, fault);
}

/* Each bearing gives as its spring and the inertia behind it say. */
static void springs(void)
{
    precess_state state;
    precess_inputs inputs;
    precess_accelerations found;
    uint32_t joints = 0, length = 0;
    int joint, other;
    IS(init(0), PRECESS_OK);
    IS(precess_joints(&craft, 0, &joints), PRECESS_OK);
    IS(joints, JOINTS);
    IS(precess_state_length(&craft, &length), PRECESS_OK);
    IS(length, 13 + 2 * JOINTS);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    inputs.hub_mode = PRECESS_HUB_FIXED;
    for (joint = AXIAL; joint < WHEEL; joint++) {
        double expected = joint < TILT_Y ? STIFFNESS / MASS : TILT_STIFFNESS / ACROSS;
        IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
        state.coordinate[0][joint] = 1e-3;
        IS(precess_accelerations_of(&craft, &state, &inputs, &found, 0), PRECESS_OK);
        for (other = 0; other < JOINTS; other++) {
            NEAR(found.joint[0][other], other == joint ? -1e-3 * expected : 0.0, 1e-10 * expected);
            bits(found.joint[0][other]);
        }
    }
}

/* One period of each whirl on a fixed hub: w = g / 2 +- sqrt(g^2 / 4 + k / I_r), g = I_s Omega / I_r. */
static void whirls(void)
{
    static const double rates[2] = {800.0, -200.0};
    const double tilt = 1e-5;
    int whirl, sample;
    for (whirl = 0; whirl < 2; whirl++) {
        precess_state state;
        precess_inputs inputs;
        double rate = rates[whirl];
        double period = 6.283185307179586 / (rate < 0.0 ? -rate : rate);
        IS(init(0), PRECESS_OK);
        IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
        IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
        inputs.hub_mode = PRECESS_HUB_FIXED;
        state.rate[0][WHEEL] = 400.0;
        state.coordinate[0][TILT_Y] = tilt;
        state.rate[0][TILT_Z] = tilt * rate;
        for (sample = 0; sample < 40; sample++) {
            IS(precess_step(&craft, &state, &inputs, period / 4000, 100, 0, 0), PRECESS_OK);
            bits(state.coordinate[0][TILT_Y]);
        }
        /* The bound: terms of the third order in the tilt, and those of the fourth order in dt. */
        NEAR(state.coordinate[0][TILT_Y] / tilt, 1.0, 1e-8);
        NEAR(state.coordinate[0][TILT_Z] / tilt, 0.0, 1e-8);
        NEAR(state.rate[0][TILT_Z] / (tilt * rate), 1.0, 1e-8);
    }
}

/* On a free hub, with dampers and a motor: energy gains the work, momentum stays; loads and a stop. */
static void conserved(void)
{
    precess_state state, restored;
    precess_inputs inputs;
    precess_momentum first, last;
    precess_power work;
    precess_loads loads;
    precess_fault fault;
    double before, after, lost, numbers[13 + 2 * PRECESS_MAX_DEVICES * PRECESS_MAX_JOINTS];
    int axis, joint;
    for (joint = AXIAL; joint < WHEEL; joint++) {
        wheel.passive[joint].viscous = joint < TILT_Y ? 30.0 : 0.1;
    }
    wheel.bodies[WHEEL].centre[1] = 1e-4;
    IS(init(0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.omega[1] = 0.1;
    state.rate[0][WHEEL] = 100.0;
    state.coordinate[0][RADIAL_Y] = 1e-4;
    inputs.motor[0][WHEEL] = 0.1;
    IS(precess_energy(&craft, &state, &before, 0), PRECESS_OK);
    IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_ORIGIN, 0, &first, 0), PRECESS_OK);
    IS(precess_step(&craft, &state, &inputs, 1e-5, 1000, &work, 0), PRECESS_OK);
    IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_ORIGIN, 0, &last, 0), PRECESS_OK);
    IS(precess_energy(&craft, &state, &after, 0), PRECESS_OK);
    for (axis = 0; axis < 3; axis++) {
        NEAR(last.linear[axis], first.linear[axis], 1e-12);
        NEAR(last.angular[axis], first.angular[axis], 1e-11);
    }
    /* The integral of the powers is of the same order as the step: 1e-5 s. */
    NEAR(after - before, work.motors + work.springs + work.friction, 1e-9);
    IS(work.friction < 0.0, 1);
    IS(precess_loads_of(&craft, &state, &inputs, PRECESS_AXES_BODY, &loads, 0), PRECESS_OK);
    NEAR(loads.motor[0][WHEEL], 0.1, 1e-12);
    IS(precess_state_save(&craft, &state, numbers, 25), PRECESS_OK);
    IS(precess_state_restore(&craft, numbers, 25, &restored, 0), PRECESS_OK);
    IS(same(&state, &restored, sizeof state), 1);
    IS(precess_state_wrap(&craft, &state), PRECESS_OK);
    for (joint = AXIAL; joint < WHEEL; joint++) {
        inputs.mode[0][joint] = PRECESS_LOCKED;
    }
    IS(precess_stop(&craft, &state, &inputs, &lost, &fault), PRECESS_OK);
    IS(lost > 0.0, 1);
    NEAR(state.rate[0][TILT_Z], 0.0, 0.0);
}

/* In a gimbal whose axis runs through the bearing centre: where it is locked the rotor moves as on the hub,
 * and at rest the bearings let it turn without the rotor, which stays where it is. */
static void in_a_gimbal(void)
{
    static uint8_t table[PRECESS_TABLE_SIZE(1)];
    static precess_spacecraft other;
    precess_device gyro = wheel;
    precess_state state, of_wheel;
    precess_inputs inputs, of_wheels;
    precess_accelerations found, expected;
    uint32_t joints = 0;
    size_t length = 0;
    int joint;
    gyro.kind = PRECESS_KIND_FLEXIBLE_VSCMG;
    for (joint = 0; joint < JOINTS; joint++) {
        gyro.bodies[1 + joint] = wheel.bodies[joint];
        gyro.passive[1 + joint] = wheel.passive[joint];
    }
    gyro.passive[0] = wheel.passive[WHEEL];
    gyro.bodies[0].mass = 2.0;
    diagonal(gyro.bodies[0].inertia, 0.05, 0.06, 0.04);
    gyro.bodies[1].origin[0] = 0.0;
    gyro.bodies[1].origin[2] = 0.07;
    IS(precess_table_write(&hub, &gyro, 1, table, sizeof table, &length), PRECESS_OK);
    IS(length, sizeof table);
    IS(precess_init_from_table(&other, sizeof other, table, length, 0), PRECESS_OK);
    IS(precess_joints(&other, 0, &joints), PRECESS_OK);
    IS(joints, PRECESS_MAX_JOINTS);
    IS(precess_state_at_rest(&other, &state), PRECESS_OK);
    IS(precess_inputs_none(&other, &inputs), PRECESS_OK);
    inputs.hub_mode = PRECESS_HUB_FIXED;
    inputs.motor[0][0] = 0.2;
    IS(precess_accelerations_of(&other, &state, &inputs, &found, 0), PRECESS_OK);
    NEAR(found.joint[0][0], 0.2 / 0.04, 1e-12);
    NEAR(found.joint[0][1 + TILT_Z], -0.2 / 0.04, 1e-12);
    IS(init(0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &of_wheel), PRECESS_OK);
    IS(precess_inputs_none(&craft, &of_wheels), PRECESS_OK);
    of_wheels.hub_mode = PRECESS_HUB_FIXED;
    inputs.mode[0][0] = PRECESS_LOCKED;
    for (joint = 0; joint < JOINTS; joint++) {
        of_wheel.coordinate[0][joint] = 1e-4 * (joint + 1);
        of_wheel.rate[0][joint] = joint == WHEEL ? 400.0 : 1e-2 * (joint + 1);
        state.coordinate[0][1 + joint] = of_wheel.coordinate[0][joint];
        state.rate[0][1 + joint] = of_wheel.rate[0][joint];
    }
    IS(precess_accelerations_of(&other, &state, &inputs, &found, 0), PRECESS_OK);
    IS(precess_accelerations_of(&craft, &of_wheel, &of_wheels, &expected, 0), PRECESS_OK);
    NEAR(found.joint[0][0], 0.0, 0.0);
    for (joint = 0; joint < JOINTS; joint++) {
        NEAR(found.joint[0][1 + joint], expected.joint[0][joint], 1e-10);
        bits(found.joint[0][1 + joint]);
    }
}

/* Of the bearings' links there are no bodies to state. */
static void rejected(void)
{
    precess_fault fault;
    wheel.bodies[RADIAL_Y].mass = 1.0;
    IS(init(&fault), PRECESS_ERROR_UNSUPPORTED_PARAMETER);
    IS(fault.device, 0);
    wheel.bodies[RADIAL_Y].mass = 0.0;
    wheel.bodies[WHEEL].origin[2] = 0.1;
    IS(init(&fault), PRECESS_ERROR_UNSUPPORTED_PARAMETER);
    wheel.bodies[WHEEL].origin[2] = 0.0;
    wheel.passive[TILT_Y].stiffness = not_a_number();
    IS(init(&fault), PRECESS_ERROR_NOT_FINITE);
    IS(fault.device, 0);
    wheel.passive[TILT_Y].stiffness = TILT_STIFFNESS;
    wheel.kind = PRECESS_KIND_FLEXIBLE_VSCMG + 1;
    IS(init(&fault), PRECESS_ERROR_UNKNOWN_KIND);
    wheel.kind = PRECESS_KIND_FLEXIBLE_REACTION_WHEEL;
    IS(init(&fault), PRECESS_OK);
}

/* Tables of version 2 are written and read, those of version 1 are read, with the same bits after. */
static void tables(void)
{
    static uint8_t table[PRECESS_TABLE_SIZE(2)];
    static precess_spacecraft other;
    precess_state state, twin;
    precess_inputs inputs;
    double first[64], second[64];
    uint32_t count, found = 0;
    size_t length = 0;
    IS(precess_table_write(&hub, &wheel, 1, table, sizeof table, &length), PRECESS_OK);
    IS(length, PRECESS_TABLE_SIZE(1));
    IS(table[4], 2);
    IS(precess_init_from_table(&other, sizeof other, table, length, 0), PRECESS_OK);
    IS(init(0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    state.rate[0][WHEEL] = 100.0;
    twin = state;
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    IS(precess_step(&craft, &state, &inputs, 1e-5, 10, 0, 0), PRECESS_OK);
    IS(precess_step(&other, &twin, &inputs, 1e-5, 10, 0, 0), PRECESS_OK);
    IS(same(&state, &twin, sizeof state), 1);
    IS(version_1_of(&craft), PRECESS_ERROR_NOT_INITIALISED);

    count = version_1_run(table, sizeof table, &length, first);
    IS(count, 13 + 2 * 4);
    IS(length, 124 + 584 * 2);
    IS(table[4], 1);
    IS(precess_init_from_table(&craft, sizeof craft, table, length, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.omega[1] = 0.1;
    state.rate[0][2] = 50.0;
    state.rate[1][0] = 20.0;
    inputs.motor[0][1] = 0.2;
    IS(precess_step(&craft, &state, &inputs, 1e-3, 100, 0, 0), PRECESS_OK);
    IS(precess_state_length(&craft, &found), PRECESS_OK);
    IS(found, count);
    IS(precess_state_save(&craft, &state, second, count), PRECESS_OK);
    IS(same(first, second, count * sizeof *first), 1);
}

int main(void)
{
    example();
    springs();
    whirls();
    conserved();
    in_a_gimbal();
    rejected();
    tables();
    return finish(190);
}
