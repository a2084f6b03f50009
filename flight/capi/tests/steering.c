/* Steering called from C: four VSCMGs turn a hub; what is out of range is rejected with its place. Also C++, in both versions
 * of the interface, which print the same bits. */

#include "check.h"
#include "precess_steering.h"

#define GYROS 4

static precess_spacecraft craft;
static precess_hub hub;
static precess_device devices[PRECESS_MAX_DEVICES];
static precess_state state;
static precess_inputs inputs;
static precess_steering_law law;
static precess_servo servo;

/* Rotations by quaternions of whole numbers: the same doubles on every machine. */
static void turn(double *m, int a, int b, int c, int d)
{
    double square = a * a + b * b + c * c + d * d;
    m[0] = (a * a + b * b - c * c - d * d) / square;
    m[1] = 2.0 * (b * c - a * d) / square;
    m[2] = 2.0 * (b * d + a * c) / square;
    m[3] = 2.0 * (b * c + a * d) / square;
    m[4] = (a * a - b * b + c * c - d * d) / square;
    m[5] = 2.0 * (c * d - a * b) / square;
    m[6] = 2.0 * (b * d - a * c) / square;
    m[7] = 2.0 * (c * d + a * b) / square;
    m[8] = (a * a - b * b - c * c + d * d) / square;
}

/* Off balance, in gimbals off their axes. */
static void example(void)
{
    static const int quaternions[GYROS][4] = {{3, 1, -2, 1}, {2, -1, 1, 3}, {1, 2, 2, -1}, {1, -1, 3, 2}};
    static precess_steering_law no_law; /* all zero */
    static precess_servo no_servo;
    int k, axis;
    hub.mass = 500.0;
    for (axis = 0; axis < 3; axis++) {
        hub.inertia[4 * axis] = 300.0 + 50.0 * axis;
    }
    for (k = 0; k < GYROS; k++) {
        const int *q = quaternions[k];
        devices[k].kind = PRECESS_KIND_VSCMG;
        turn(devices[k].mount, q[0], q[1], q[2], q[3]);
        devices[k].bodies[0].mass = 2.0;
        devices[k].bodies[0].origin[0] = 0.1 * k;
        devices[k].bodies[0].centre[0] = 0.01;
        devices[k].bodies[1].mass = 4.0;
        devices[k].bodies[1].centre[1] = 8e-5;
        for (axis = 0; axis < 3; axis++) {
            devices[k].bodies[0].inertia[4 * axis] = 0.03;
            devices[k].bodies[1].inertia[4 * axis] = axis == 0 ? 0.1 : 0.06;
        }
    }
    IS(precess_init(&craft, sizeof craft, &hub, devices, GYROS, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.omega[0] = 0.01;
    state.omega[2] = -0.02;
    law = no_law;
    servo = no_servo;
    for (k = 0; k < GYROS; k++) {
        state.coordinate[k][0] = 0.2 * k - 0.3;
        state.rate[k][0] = 0.01 * k;
        state.rate[k][1] = 200.0;
        law.steered[k][0] = servo.steered[k][0] = PRECESS_STEER_RATE;
        law.steered[k][1] = servo.steered[k][1] = PRECESS_STEER_ACCELERATION;
        law.weight[k][0] = 1.0;
        law.weight[k][1] = 100.0;
        servo.gain[k][0] = 20.0;
        servo.limit[k][0] = servo.limit[k][1] = 1e9;
    }
    law.reference = 20.0;
}

/* The moment about B that rates and accelerations require, less what accelerations of gimbals and of the hub do. */
static void moment_of(const precess_steering_terms *terms, const precess_allocation *found, double *sum)
{
    int k, axis;
    for (axis = 0; axis < 3; axis++) {
        sum[axis] = terms->gyroscopic[axis];
        for (k = 0; k < GYROS; k++) {
            sum[axis] += terms->by_rate[k][0][axis] * found->command[k][0];
            sum[axis] += terms->by_rate[k][1][axis] * state.rate[k][1];
            sum[axis] += terms->by_acceleration[k][1][axis] * found->command[k][1];
        }
    }
}

static void terms_and_allocation(void)
{
    static const double torque[3] = {0.5, -0.3, 0.4};
    precess_steering_terms terms;
    precess_allocation found, wheels, bounded;
    double sum[3];
    int k, axis;
    example();
    IS(precess_steering_terms_of(&craft, &state, &terms, 0), PRECESS_OK);
    for (axis = 0; axis < 3; axis++) {
        double momentum = 0.0;
        for (k = 0; k < GYROS; k++) {
            momentum += terms.by_acceleration[k][0][axis] * state.rate[k][0];
            momentum += terms.by_acceleration[k][1][axis] * state.rate[k][1];
        }
        NEAR(terms.momentum[axis], momentum, 1e-12);
        bits(terms.by_rate[1][0][axis]);
        bits(terms.inertia[4 * axis]);
    }
    IS(precess_allocate(&craft, &state, &law, torque, &found, 0), PRECESS_OK);
    moment_of(&terms, &found, sum);
    for (axis = 0; axis < 3; axis++) {
        NEAR(sum[axis], -torque[axis], 1e-13);
        NEAR(found.torque_error[axis], 0.0, 1e-13);
    }
    IS(found.at_bound, 0);
    IS(found.measure > 0.1, 1);
    for (k = 0; k < GYROS; k++) {
        bits(found.command[k][0]);
        bits(found.command[k][1]);
    }

    /* Far from a singular pose wheels help less. */
    law.wheel_mu = 3.0;
    IS(precess_allocate(&craft, &state, &law, torque, &wheels, 0), PRECESS_OK);
    for (k = 0; k < GYROS; k++) {
        double before = found.command[k][1], after = wheels.command[k][1];
        IS(after * after < before * before, 1);
        bits(after);
    }
    NEAR(wheels.measure, found.measure, 0.0);

    law.bounded = 1;
    for (k = 0; k < GYROS; k++) {
        law.lower[k][0] = -0.005;
        law.upper[k][0] = 0.005;
        law.lower[k][1] = -1.0;
        law.upper[k][1] = 1.0;
    }
    IS(precess_allocate(&craft, &state, &law, torque, &bounded, 0), PRECESS_OK);
    IS(bounded.at_bound > 0, 1);
    for (k = 0; k < GYROS; k++) {
        IS(bounded.command[k][0] >= -0.005 && bounded.command[k][0] <= 0.005, 1);
        bits(bounded.command[k][0]);
    }
}

/* Torques that are applied give the commanded accelerations. */
static void torques(void)
{
    precess_servo_torques found;
    precess_accelerations solved;
    int k;
    example();
    for (k = 0; k < GYROS; k++) {
        servo.command[k][0] = 0.1 - 0.02 * k;
        servo.command[k][1] = 1.0 + k;
        servo.feed_forward[k][0] = 0.05;
    }
    IS(precess_servo_torques_of(&craft, &state, &inputs, &servo, &found, 0), PRECESS_OK);
    IS(found.limited, 0);
    for (k = 0; k < GYROS; k++) {
        inputs.motor[k][0] = found.motor[k][0];
        inputs.motor[k][1] = found.motor[k][1];
        bits(found.motor[k][0]);
    }
    IS(precess_accelerations_of(&craft, &state, &inputs, &solved, 0), PRECESS_OK);
    for (k = 0; k < GYROS; k++) {
        NEAR(solved.joint[k][0], 0.05 + 20.0 * (servo.command[k][0] - state.rate[k][0]), 1e-10);
        NEAR(solved.joint[k][1], servo.command[k][1], 1e-10);
    }
    servo.limit[2][0] = 1e-3;
    servo.steered[3][1] = PRECESS_STEER_NOTHING;
    inputs.motor[3][1] = 0.25;
    IS(precess_servo_torques_of(&craft, &state, &inputs, &servo, &found, 0), PRECESS_OK);
    IS(found.limited, 1);
    NEAR(found.motor[3][1], 0.25, 0.0);
    NEAR(found.motor[2][0] * found.motor[2][0], 1e-6, 1e-18);
}

/* A second of law, servo and steps: the hub turns as demanded, and at rest it stays. */
static void loop(void)
{
    precess_allocation commands;
    precess_servo_torques found;
    double torque[3];
    int step, k, axis;
    example();
    for (step = 0; step < 4000; step++) {
        for (axis = 0; axis < 3; axis++) {
            torque[axis] = -800.0 * state.omega[axis];
        }
        IS(precess_allocate(&craft, &state, &law, torque, &commands, 0), PRECESS_OK);
        for (k = 0; k < GYROS; k++) {
            servo.command[k][0] = commands.command[k][0];
            servo.command[k][1] = commands.command[k][1];
        }
        IS(precess_servo_torques_of(&craft, &state, &inputs, &servo, &found, 0), PRECESS_OK);
        for (k = 0; k < GYROS; k++) {
            inputs.motor[k][0] = found.motor[k][0];
            inputs.motor[k][1] = found.motor[k][1];
        }
        IS(precess_step(&craft, &state, &inputs, 1e-3, 1, 0, 0), PRECESS_OK);
    }
    for (axis = 0; axis < 3; axis++) {
        NEAR(state.omega[axis], 0.0, 1e-4);
        bits(state.omega[axis]);
    }
}

static void is_at(const precess_fault *fault, int device, int joint, double value)
{
    IS(fault->device, device);
    IS(fault->joint, joint);
    NEAR(fault->value, value, 0.0);
}

static void rejections(void)
{
    double torque[3] = {0.5, -0.3, 0.4};
    precess_allocation found, before;
    precess_servo_torques torques;
    precess_fault fault;
    int k;
    example();
    IS(precess_allocate(&craft, &state, &law, torque, &found, &fault), PRECESS_OK);
    before = found;
    law.weight[2][1] = -1.0;
    IS(precess_allocate(&craft, &state, &law, torque, &found, &fault), PRECESS_ERROR_COMMAND);
    is_at(&fault, 2, 1, -1.0);
    IS(same(&found, &before, sizeof found), 1);
    example();
    law.bounded = 1;
    law.lower[1][0] = 2.0;
    IS(precess_allocate(&craft, &state, &law, torque, &found, &fault), PRECESS_ERROR_COMMAND);
    is_at(&fault, 1, 0, 0.0);
    example();
    law.reference = 0.0;
    IS(precess_allocate(&craft, &state, &law, torque, &found, &fault), PRECESS_ERROR_COMMAND);
    is_at(&fault, -1, -1, 0.0);
    example();
    law.inverse = PRECESS_INVERSE_GENERALISED;
    law.dither[1] = 0.5;
    IS(precess_allocate(&craft, &state, &law, torque, &found, &fault), PRECESS_ERROR_COMMAND);
    is_at(&fault, -1, -1, 0.5);
    example();
    law.inverse = 3;
    IS(precess_allocate(&craft, &state, &law, torque, &found, 0), PRECESS_ERROR_UNKNOWN_CHOICE);
    example();
    law.bounded = 2;
    IS(precess_allocate(&craft, &state, &law, torque, &found, 0), PRECESS_ERROR_UNKNOWN_CHOICE);
    example();
    law.steered[3][0] = 3;
    IS(precess_allocate(&craft, &state, &law, torque, &found, &fault), PRECESS_ERROR_UNKNOWN_CHOICE);
    IS(fault.device, 3);
    example();
    torque[1] = not_a_number();
    IS(precess_allocate(&craft, &state, &law, torque, &found, &fault), PRECESS_ERROR_NOT_FINITE);
    torque[1] = -0.3;

    /* One VSCMG gives no torque along its gimbal's axis; a robust inverse lacks it. */
    for (k = 1; k < GYROS; k++) {
        law.steered[k][0] = law.steered[k][1] = PRECESS_STEER_NOTHING;
    }
    IS(precess_allocate(&craft, &state, &law, torque, &found, &fault), PRECESS_ERROR_NO_TORQUE);
    IS(fault.value <= fault.bound, 1);
    law.inverse = PRECESS_INVERSE_ROBUST;
    law.lambda = 0.01;
    IS(precess_allocate(&craft, &state, &law, torque, &found, 0), PRECESS_OK);
    IS(found.torque_error[0] != 0.0, 1);
    NEAR(found.measure, 0.0, 1e-12);

    example();
    servo.limit[1][1] = -1.0;
    IS(precess_servo_torques_of(&craft, &state, &inputs, &servo, &torques, &fault), PRECESS_ERROR_COMMAND);
    is_at(&fault, 1, 1, -1.0);
    example();
    servo.gain[3][0] = not_a_number();
    IS(precess_servo_torques_of(&craft, &state, &inputs, &servo, &torques, &fault), PRECESS_ERROR_NOT_FINITE);
    IS(fault.device, 3);
    example();
    servo.steered[0][1] = -1;
    IS(precess_servo_torques_of(&craft, &state, &inputs, &servo, &torques, 0), PRECESS_ERROR_UNKNOWN_CHOICE);

#if PRECESS_TABLE_VERSION == 2
    {
        static precess_device on_platform[2];
        precess_steering_terms terms;
        example();
        on_platform[0].kind = PRECESS_KIND_PLATFORM;
        turn(on_platform[0].mount, 1, 0, 0, 0);
        on_platform[0].bodies[5].mass = 8.0;
        for (k = 0; k < 3; k++) {
            on_platform[0].bodies[5].inertia[4 * k] = 0.5;
        }
        on_platform[1] = devices[0];
        on_platform[1].on = 1;
        IS(precess_init(&craft, sizeof craft, &hub, on_platform, 2, 0), PRECESS_OK);
        IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
        IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
        IS(precess_steering_terms_of(&craft, &state, &terms, &fault), PRECESS_ERROR_NO_STEERING);
        IS(fault.device, 0);
        IS(precess_servo_torques_of(&craft, &state, &inputs, &servo, &torques, &fault), PRECESS_ERROR_NO_STEERING);
    }
#endif
}

int main(void)
{
    terms_and_allocation();
    torques();
    loop();
    rejections();
    return finish(150);
}
