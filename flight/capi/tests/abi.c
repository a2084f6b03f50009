/* The library called from C: valid calls succeed, invalid ones are rejected with a code of their own.
 * Also C++. Prints what it computes as bit patterns and needs nothing of a C library but its output. */

#include "check.h"
#include "precess.h"

static precess_spacecraft craft;
static precess_hub hub;
static precess_device devices[PRECESS_MAX_DEVICES + 1];

static void diagonal(double *m, double x, double y, double z)
{
    int i;
    for (i = 0; i < 9; i++) {
        m[i] = 0.0;
    }
    m[0] = x;
    m[4] = y;
    m[8] = z;
}

static precess_device device_of(int32_t kind)
{
    static precess_device none;
    precess_device device = none;
    int joint;
    device.kind = kind;
    diagonal(device.mount, 1.0, 1.0, 1.0);
    device.bodies[0].origin[0] = 0.3;
    for (joint = 0; joint < PRECESS_MAX_JOINTS; joint++) {
        device.bodies[joint].mass = 2.0;
        if (kind != PRECESS_KIND_SLOSH_MASS) {
            diagonal(device.bodies[joint].inertia, 0.2, 0.1, 0.1);
        }
    }
    return device;
}

static void example(void)
{
    hub.mass = 800.0;
    diagonal(hub.inertia, 900.0, 800.0, 600.0);
    devices[0] = device_of(PRECESS_KIND_DGVSCMG);
    devices[0].bodies[2].centre[1] = 8e-5;
    devices[1] = device_of(PRECESS_KIND_REACTION_WHEEL);
    devices[2] = device_of(PRECESS_KIND_SLOSH_MASS);
    devices[2].passive[0].stiffness = 9.0;
}

static int32_t init(uint32_t count, precess_fault *fault)
{
    return precess_init(&craft, sizeof craft, &hub, devices, count, fault);
}

#include "contributions.h"

/* Every kind, by itself: steps conserve momentum, devices and hub make the equations. */
static void every_kind(void)
{
    int32_t kind;
    for (kind = PRECESS_KIND_DGVSCMG; kind <= PRECESS_KIND_SLOSH_MASS; kind++) {
        precess_state state;
        precess_inputs inputs;
        precess_momentum before, after;
        precess_accelerations found;
        uint32_t joints = 0, joint;
        int axis;
        devices[0] = device_of(kind);
        IS(init(1, 0), PRECESS_OK);
        IS(precess_joints(&craft, 0, &joints), PRECESS_OK);
        IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
        IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
        state.omega[1] = 0.1;
        for (joint = 0; joint < joints; joint++) {
            state.rate[0][joint] = 0.5 + joint;
        }
        if (inputs.mode[0][0] == PRECESS_DRIVEN) {
            inputs.motor[0][0] = 0.01;
        }
        IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_ORIGIN, 0, &before, 0), PRECESS_OK);
        IS(precess_accelerations_of(&craft, &state, &inputs, &found, 0), PRECESS_OK);
        contributes(&state, &inputs, joints);
        IS(precess_step(&craft, &state, &inputs, 1e-3, 100, 0, 0), PRECESS_OK);
        IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_ORIGIN, 0, &after, 0), PRECESS_OK);
        for (axis = 0; axis < 3; axis++) {
            NEAR(after.angular[axis], before.angular[axis], 1e-10);
            NEAR(after.linear[axis], before.linear[axis], 1e-10);
            bits(found.angular[axis]);
            bits(state.omega[axis]);
        }
        for (joint = 0; joint < joints; joint++) {
            bits(found.joint[0][joint]);
            bits(state.coordinate[0][joint]);
        }
    }
}

/* Work of the motors is what energy gains; a state comes back bit by bit. */
static void ledger(void)
{
    precess_state state, restored;
    precess_inputs inputs;
    precess_power work;
    double before, after, numbers[13 + 2 * PRECESS_MAX_DEVICES * PRECESS_MAX_JOINTS];
    uint32_t length = 0;
    example();
    IS(init(3, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.rate[0][2] = 50.0;
    state.rate[1][0] = 20.0;
    inputs.motor[0][2] = 0.2;
    inputs.mode[1][0] = PRECESS_PRESCRIBED;
    inputs.prescribed[1][0] = 0.5;
    IS(precess_energy(&craft, &state, &before, 0), PRECESS_OK);
    IS(precess_step(&craft, &state, &inputs, 1e-3, 1000, &work, 0), PRECESS_OK);
    IS(precess_energy(&craft, &state, &after, 0), PRECESS_OK);
    NEAR(after - before, work.motors + work.springs, 1e-9);
    NEAR(state.rate[1][0], 20.5, 1e-11); /* 1000 roundings of up to 2e-15 each */

    IS(precess_state_length(&craft, &length), PRECESS_OK);
    IS(length, 23);
    IS(precess_state_save(&craft, &state, numbers, length), PRECESS_OK);
    IS(precess_state_restore(&craft, numbers, length, &restored, 0), PRECESS_OK);
    IS(same(&state, &restored, sizeof state), 1);
    IS(precess_state_save(&craft, &state, numbers, length - 1), PRECESS_ERROR_TOO_SMALL);
    IS(precess_state_restore(&craft, numbers, length - 1, &restored, 0), PRECESS_ERROR_TOO_SMALL);
    numbers[3] = not_a_number();
    IS(precess_state_restore(&craft, numbers, length, &restored, 0), PRECESS_ERROR_NOT_FINITE);

    /* A turn that is whole changes nothing else. */
    state.coordinate[0][0] = 100.0;
    IS(precess_state_wrap(&craft, &state), PRECESS_OK);
    NEAR(state.coordinate[0][0], 100.0 - 16 * 6.283185307179586, 1e-12);
}

/* A brake: what moves cannot be locked before it is stopped; its load is what holds it. */
static void modes_and_loads(void)
{
    precess_state state;
    precess_inputs inputs;
    precess_accelerations found;
    precess_loads loads;
    precess_fault fault;
    precess_momentum before, after;
    double lost = 0.0;
    example();
    IS(init(3, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.rate[1][0] = 20.0;
    inputs.mode[1][0] = PRECESS_LOCKED;
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault),
       PRECESS_ERROR_LOCKED_JOINT_MOVES);
    IS(fault.code, PRECESS_ERROR_LOCKED_JOINT_MOVES);
    IS(fault.device, 1);
    IS(fault.joint, 0);
    NEAR(fault.value, 20.0, 0.0);
    IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_CENTRE_OF_MASS, 0, &before, 0), PRECESS_OK);
    IS(precess_stop(&craft, &state, &inputs, &lost, &fault), PRECESS_OK);
    IS(fault.code, PRECESS_OK);
    IS(lost > 39.0 && lost < 40.0, 1);
    NEAR(state.rate[1][0], 0.0, 0.0);
    IS(precess_momentum_of(&craft, &state, PRECESS_ABOUT_CENTRE_OF_MASS, 0, &after, 0), PRECESS_OK);
    NEAR(after.angular[0], before.angular[0], 1e-12);

    /* On a table, a force of 1 N is held by the table. */
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    inputs.hub_mode = PRECESS_HUB_FIXED;
    inputs.force[1] = 1.0;
    IS(precess_loads_of(&craft, &state, &inputs, PRECESS_AXES_BODY, &loads, &fault), PRECESS_OK);
    NEAR(loads.hub.force[1], -1.0, 1e-15);
    state.omega[2] = 0.1;
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault),
       PRECESS_ERROR_FIXED_HUB_MOVES);
    inputs.hub_mode = PRECESS_HUB_FREE;

    /* On a free hub, motors push what the loads say. */
    inputs.mode[1][0] = PRECESS_DRIVEN;
    inputs.motor[1][0] = 0.3;
    IS(precess_loads_of(&craft, &state, &inputs, PRECESS_AXES_INERTIAL, &loads, 0), PRECESS_OK);
    NEAR(loads.motor[1][0], 0.3, 1e-12);
    NEAR(loads.hub.force[0], 0.0, 1e-12);
    IS(precess_loads_of(&craft, &state, &inputs, 4, &loads, 0), PRECESS_ERROR_UNKNOWN_CHOICE);

    /* The wheel of an SGCMG keeps its rate in every mode. */
    devices[0] = device_of(PRECESS_KIND_SGCMG);
    IS(init(1, 0), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    IS(inputs.mode[0][1], PRECESS_PRESCRIBED);
    inputs.mode[0][1] = PRECESS_DRIVEN;
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault), PRECESS_ERROR_NOT_DRIVEN);
    IS(fault.joint, 1);
    inputs.mode[0][1] = 3;
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, 0), PRECESS_ERROR_UNKNOWN_CHOICE);
    inputs.mode[0][1] = PRECESS_PRESCRIBED;
    inputs.gravity_model = PRECESS_GRAVITY_CENTRAL;
    inputs.mu = 4e14;
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, 0), PRECESS_ERROR_AT_CENTRE);
    state.position[0] = 7e6;
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, 0), PRECESS_OK);
    NEAR(found.linear[0], -4e14 / 49e12, 1e-6);
}

/* What is wrong with parameters, each named. */
static void rejected_parameters(void)
{
    precess_fault fault;
    example();
    devices[1].bodies[0].mass = -1.0;
    IS(init(3, &fault), PRECESS_ERROR_MASS);
    IS(fault.device, 1);
    IS(fault.joint, -1);
    NEAR(fault.value, -1.0, 0.0);
    example();
    devices[1].bodies[0].mass = not_a_number();
    IS(init(3, &fault), PRECESS_ERROR_NOT_FINITE);
    example();
    devices[1].bodies[0].inertia[1] = 0.05;
    IS(init(3, &fault), PRECESS_ERROR_INERTIA);
    example();
    devices[2].mount[0] = 2.0;
    IS(init(3, &fault), PRECESS_ERROR_MOUNT);
    IS(fault.device, 2);
    example();
    devices[2].passive[0].stiffness = -9.0;
    IS(init(3, &fault), PRECESS_ERROR_PASSIVE);
    example();
    devices[1].kind = 15;
    IS(init(3, &fault), PRECESS_ERROR_UNKNOWN_KIND);
    IS(fault.device, 1);
    devices[1].kind = PRECESS_KIND_FLEXIBLE_REACTION_WHEEL;
    IS(init(3, &fault), PRECESS_ERROR_MANY_JOINTS);
    IS(fault.device, 1);
    example();
    devices[1].model = 2;
    IS(init(3, &fault), PRECESS_ERROR_UNKNOWN_CHOICE);
    example();
    devices[1].bodies[0].centre[2] = 0.1;
    IS(init(3, &fault), PRECESS_ERROR_UNSUPPORTED_PARAMETER);
    example();
    hub.mass = 0.0;
    IS(init(3, &fault), PRECESS_ERROR_MASS);
    IS(fault.device, -1);
    example();
    IS(init(PRECESS_MAX_DEVICES + 1, &fault), PRECESS_ERROR_TOO_MANY);
    IS(init(0, &fault), PRECESS_OK);
}

/* Memory and pointers. */
static void rejected_pointers(void)
{
    static precess_spacecraft blank;
    precess_state state, before;
    precess_inputs inputs;
    precess_accelerations found;
    precess_fault fault;
    double mass;
    char *unaligned = (char *)&craft + 4;
    void *misaligned = unaligned;
    example();
    IS(precess_init(0, sizeof craft, &hub, devices, 3, 0), PRECESS_ERROR_NULL);
    IS(precess_init(misaligned, sizeof craft - 8, &hub, devices, 3, 0), PRECESS_ERROR_MISALIGNED);
    IS(precess_init(&craft, sizeof craft - 1, &hub, devices, 3, 0), PRECESS_ERROR_TOO_SMALL);
    IS(precess_init(&craft, sizeof craft, 0, devices, 3, 0), PRECESS_ERROR_NULL);
    IS(precess_init(&craft, sizeof craft, &hub, 0, 3, &fault), PRECESS_ERROR_NULL);
    IS(fault.code, PRECESS_ERROR_NULL);
    /* What is rejected leaves the spacecraft that was there, of a hub only. */
    IS(precess_mass(&craft, &mass), PRECESS_OK);
    NEAR(mass, 800.0, 1e-12);
    IS(precess_init(&craft, sizeof craft, &hub, devices, 3, (precess_fault *)misaligned),
       PRECESS_ERROR_MISALIGNED);
    IS(precess_mass(&craft, &mass), PRECESS_OK);
    NEAR(mass, 800.0, 1e-12);
    IS(init(3, 0), PRECESS_OK);
    IS(precess_mass(&craft, &mass), PRECESS_OK);
    NEAR(mass, 810.0, 1e-12);
    IS(precess_mass(&blank, &mass), PRECESS_ERROR_NOT_INITIALISED);
    IS(precess_mass(0, &mass), PRECESS_ERROR_NULL);
    IS(precess_mass(&craft, 0), PRECESS_ERROR_NULL);
    IS(precess_mass((precess_spacecraft *)misaligned, &mass), PRECESS_ERROR_MISALIGNED);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    IS(precess_accelerations_of(&craft, 0, &inputs, &found, 0), PRECESS_ERROR_NULL);
    IS(precess_accelerations_of(&craft, &state, 0, &found, 0), PRECESS_ERROR_NULL);
    IS(precess_accelerations_of(&craft, &state, &inputs, 0, 0), PRECESS_ERROR_NULL);
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, (precess_fault *)misaligned),
       PRECESS_ERROR_MISALIGNED);
    before = state;
    IS(precess_step(&craft, &state, &inputs, 1e-3, 1, 0, (precess_fault *)misaligned),
       PRECESS_ERROR_MISALIGNED);
    IS(same(&state, &before, sizeof state), 1);
    IS(precess_step(&craft, &state, &inputs, 1e-3, 0, 0, 0), PRECESS_ERROR_TOO_MANY);
    IS(precess_step(&craft, &state, &inputs, 1e-3, PRECESS_MAX_SUBSTEPS + 1, 0, 0),
       PRECESS_ERROR_TOO_MANY);
    IS(precess_step(&craft, &state, &inputs, not_a_number(), 1, 0, 0), PRECESS_ERROR_NOT_FINITE);
    state.rate[1][0] = not_a_number();
    IS(precess_step(&craft, &state, &inputs, 1e-3, 1, 0, &fault), PRECESS_ERROR_NOT_FINITE);
    IS(fault.device, 1);
    IS(fault.joint, 0);
}

/* The same spacecraft from a table; every damage is seen. */
static void tables(void)
{
    static uint8_t table[PRECESS_TABLE_SIZE(3) + 1];
    static precess_spacecraft other;
    precess_state state, twin;
    precess_inputs inputs;
    size_t length = 0;
    example();
    IS(precess_table_write(&hub, devices, 3, table, sizeof table, &length), PRECESS_OK);
    IS(length, PRECESS_TABLE_SIZE(3));
    IS(precess_table_write(&hub, devices, 3, table, length - 1, &length), PRECESS_ERROR_TOO_SMALL);
    IS(precess_table_write(&hub, devices, 9, table, length, &length), PRECESS_ERROR_TOO_MANY);
    IS(precess_init_from_table(&other, sizeof other, table, length, 0), PRECESS_OK);
    IS(init(3, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    state.rate[0][2] = 50.0;
    twin = state;
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    IS(precess_step(&craft, &state, &inputs, 1e-3, 10, 0, 0), PRECESS_OK);
    IS(precess_step(&other, &twin, &inputs, 1e-3, 10, 0, 0), PRECESS_OK);
    IS(same(&state, &twin, sizeof state), 1);

    IS(precess_init_from_table(&other, sizeof other, 0, length, 0), PRECESS_ERROR_NULL);
    IS(precess_init_from_table(&other, sizeof other, table, length - 1, 0),
       PRECESS_ERROR_TABLE_LENGTH);
    IS(precess_init_from_table(&other, sizeof other, table, 3, 0), PRECESS_ERROR_TABLE_LENGTH);
    IS(precess_init_from_table(&other, sizeof other, table, length + 1, 0),
       PRECESS_ERROR_TABLE_LENGTH);
    table[200] ^= 1;
    IS(precess_init_from_table(&other, sizeof other, table, length, 0),
       PRECESS_ERROR_TABLE_CHECKSUM);
    table[200] ^= 1;
    table[4] = 2;
    IS(precess_init_from_table(&other, sizeof other, table, length, 0),
       PRECESS_ERROR_TABLE_VERSION);
    table[4] = 1;
    table[0] = 'p';
    IS(precess_init_from_table(&other, sizeof other, table, length, 0), PRECESS_ERROR_TABLE_MAGIC);
}

static void texts(void)
{
    char text[128], little[5];
    int32_t code;
    for (code = PRECESS_OK; code <= PRECESS_ERROR_SUSPENSION; code++) {
        IS(precess_error_text(code, text, sizeof text), PRECESS_OK);
        IS(text[0] != '\0', 1);
    }
    IS(precess_error_text(PRECESS_OK, little, sizeof little), PRECESS_OK);
    IS(same(little, "done", 5), 1);
    IS(precess_error_text(PRECESS_OK, little, 4), PRECESS_ERROR_TOO_SMALL);
    IS(same(little, "don", 4), 1);
    IS(precess_error_text(PRECESS_OK, 0, 4), PRECESS_ERROR_NULL);
    IS(same(precess_error_name(PRECESS_ERROR_MASS), "PRECESS_ERROR_MASS", 19), 1);
    IS(precess_version(), PRECESS_VERSION);
}

#include "promises.h"

int main(void)
{
    example();
    every_kind();
    ledger();
    modes_and_loads();
    rejected_parameters();
    rejected_pointers();
    tables();
    texts();
    promises();
    return finish(200);
}
