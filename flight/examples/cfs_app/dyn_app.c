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

int32_t dyn_app_wake_up(dyn_app *app)
{
    precess_fault fault;
    precess_power work;
    precess_momentum now;
    double energy = 0.0, largest = 0.0;
    int axis;
    int32_t code = precess_step(&app->craft, &app->state, &app->inputs, DYN_STEP, DYN_SUBSTEPS,
                                &work, &fault);
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
    app->expected += work.external;
    app->expected += work.motors;
    app->expected += work.springs;
    app->expected += work.friction;
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
