/* See dyn_app.h. */

#include "dyn_app.h"

/* Where a table is tried before the spacecraft in use is replaced. */
static precess_spacecraft trial;

static int32_t report(dyn_app *app, int32_t code, const precess_fault *fault)
{
    if (code != PRECESS_OK) {
        app->telemetry.last_error = code;
        app->telemetry.fault_device = fault->device;
        app->telemetry.fault_joint = fault->joint;
    }
    return code;
}

static int32_t momentum(const dyn_app *app, precess_momentum *out, precess_fault *fault)
{
    return precess_momentum_of(&app->craft, &app->state, PRECESS_ABOUT_CENTRE_OF_MASS, NULL, out,
                               fault);
}

int32_t dyn_app_load(dyn_app *app, const uint8_t *table, size_t length)
{
    precess_fault fault;
    int32_t code = precess_init_from_table(&trial, sizeof trial, table, length, &fault);
    if (code != PRECESS_OK) {
        return report(app, code, &fault);
    }
    app->craft = trial;
    code = precess_state_at_rest(&app->craft, &app->state);
    if (code == PRECESS_OK) {
        code = precess_inputs_none(&app->craft, &app->inputs);
    }
    if (code == PRECESS_OK) {
        code = momentum(app, &app->first, &fault);
    }
    app->expected = 0.0;
    app->points = 0;
    app->telemetry.tables++;
    return report(app, code, &fault);
}

int32_t dyn_app_command(dyn_app *app, const dyn_joint_command *command)
{
    precess_fault fault = {0, -1, -1, 0, 0.0, 0.0};
    precess_inputs inputs = app->inputs;
    precess_accelerations found;
    uint32_t joints = 0;
    double lost = 0.0;
    int32_t code = precess_joints(&app->craft, command->device, &joints);
    if (code == PRECESS_OK && command->joint >= joints) {
        code = PRECESS_ERROR_UNKNOWN_CHOICE;
    }
    if (code == PRECESS_OK) {
        inputs.mode[command->device][command->joint] = command->mode;
        inputs.motor[command->device][command->joint] = command->value;
        inputs.prescribed[command->device][command->joint] = command->value;
        if (command->mode == PRECESS_LOCKED) {
            code = precess_stop(&app->craft, &app->state, &inputs, &lost, &fault);
        } else {
            /* What the library would reject at the next step is rejected now. */
            code = precess_accelerations_of(&app->craft, &app->state, &inputs, &found, &fault);
        }
    }
    if (code != PRECESS_OK) {
        app->telemetry.commands_rejected++;
        return report(app, code, &fault);
    }
    app->expected -= lost;
    app->inputs = inputs;
    app->telemetry.commands++;
    return PRECESS_OK;
}

/* Twice the vector part of the rotation from the commanded to the present attitude: an angle where it is small. */
static void attitude_error(const double *wanted, const double *is, double *error)
{
    double scalar = wanted[0] * is[0] + wanted[1] * is[1] + wanted[2] * is[2] + wanted[3] * is[3];
    double sign = scalar < 0.0 ? -2.0 : 2.0; /* the shorter way */
    error[0] = sign * (wanted[0] * is[1] - wanted[1] * is[0] - wanted[2] * is[3] + wanted[3] * is[2]);
    error[1] = sign * (wanted[0] * is[2] - wanted[2] * is[0] - wanted[3] * is[1] + wanted[1] * is[3]);
    error[2] = sign * (wanted[0] * is[3] - wanted[3] * is[0] - wanted[1] * is[2] + wanted[2] * is[1]);
}

/* A sample of the controller: what the motors exert until the next one. `inputs` are those of the app, or a trial. */
static int32_t control(dyn_app *app, const dyn_pointing_command *pointing, precess_inputs *inputs,
                       precess_fault *fault)
{
    precess_allocation found;
    precess_servo servo;
    precess_servo_torques torques;
    double error[3], torque[3];
    uint32_t device, joint;
    int axis;
    int32_t code;
    attitude_error(pointing->attitude, app->state.attitude, error);
    for (axis = 0; axis < 3; axis++) {
        torque[axis] = -(pointing->stiffness * error[axis] + pointing->damping * app->state.omega[axis]);
    }
    code = precess_allocate(&app->craft, &app->state, &pointing->law, torque, &found, fault);
    if (code != PRECESS_OK) {
        return code;
    }
    for (device = 0; device < PRECESS_MAX_DEVICES; device++) {
        for (joint = 0; joint < PRECESS_MAX_JOINTS; joint++) {
            servo.steered[device][joint] = pointing->law.steered[device][joint];
            servo.command[device][joint] = found.command[device][joint];
            servo.feed_forward[device][joint] = 0.0;
            servo.gain[device][joint] = pointing->gain;
            servo.limit[device][joint] = pointing->limit;
            if (servo.steered[device][joint] != PRECESS_STEER_NOTHING) {
                inputs->mode[device][joint] = PRECESS_DRIVEN;
            }
        }
    }
    code = precess_servo_torques_of(&app->craft, &app->state, inputs, &servo, &torques, fault);
    if (code != PRECESS_OK) {
        return code;
    }
    for (device = 0; device < PRECESS_MAX_DEVICES; device++) {
        for (joint = 0; joint < PRECESS_MAX_JOINTS; joint++) {
            if (servo.steered[device][joint] != PRECESS_STEER_NOTHING) {
                inputs->motor[device][joint] = torques.motor[device][joint];
            }
        }
    }
    for (axis = 0; axis < 3; axis++) {
        app->telemetry.torque[axis] = torque[axis];
        app->telemetry.torque_error[axis] = found.torque_error[axis];
    }
    app->telemetry.at_bound += (uint32_t)found.at_bound;
    return PRECESS_OK;
}

int32_t dyn_app_point(dyn_app *app, const dyn_pointing_command *command)
{
    precess_fault fault = {0, -1, -1, 0, 0.0, 0.0};
    precess_inputs inputs = app->inputs;
    /* What the library would reject at the next sample is rejected now. */
    int32_t code = control(app, command, &inputs, &fault);
    if (code != PRECESS_OK) {
        app->telemetry.commands_rejected++;
        return report(app, code, &fault);
    }
    app->inputs = inputs;
    app->pointing = *command;
    app->points = 1;
    app->telemetry.commands++;
    return PRECESS_OK;
}

/* The steps of a cycle, with a sample of the controller before some of them. */
static int32_t advance(dyn_app *app, precess_fault *fault)
{
    uint32_t substeps = app->points != 0 ? DYN_CONTROL_SUBSTEPS : DYN_SUBSTEPS, made;
    for (made = 0; made < DYN_SUBSTEPS; made += substeps) {
        precess_power work;
        int32_t code = PRECESS_OK;
        if (app->points != 0) {
            code = control(app, &app->pointing, &app->inputs, fault);
        }
        if (code == PRECESS_OK) {
            code = precess_step(&app->craft, &app->state, &app->inputs, DYN_STEP, substeps, &work, fault);
        }
        if (code != PRECESS_OK) {
            return code;
        }
        app->expected += work.external;
        app->expected += work.motors;
        app->expected += work.springs;
        app->expected += work.friction;
    }
    return PRECESS_OK;
}

int32_t dyn_app_wake_up(dyn_app *app)
{
    precess_fault fault;
    precess_momentum now;
    double energy = 0.0, largest = 0.0;
    int axis;
    int32_t code = advance(app, &fault);
    if (code == PRECESS_OK) {
        code = precess_state_wrap(&app->craft, &app->state);
    }
    if (code == PRECESS_OK) {
        code = precess_energy(&app->craft, &app->state, &energy, &fault);
    }
    if (code == PRECESS_OK) {
        code = momentum(app, &now, &fault);
    }
    if (code != PRECESS_OK) {
        return report(app, code, &fault);
    }
    for (axis = 0; axis < 3; axis++) {
        double change = now.angular[axis] - app->first.angular[axis];
        if (change < 0.0) {
            change = -change;
        }
        if (change > largest) {
            largest = change;
        }
        app->telemetry.omega[axis] = app->state.omega[axis];
    }
    app->telemetry.wake_ups++;
    app->telemetry.energy = energy;
    app->telemetry.energy_residual = energy - app->expected;
    app->telemetry.momentum_residual = largest;
    return PRECESS_OK;
}
