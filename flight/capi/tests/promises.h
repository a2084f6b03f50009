/* Promises at the points where each has been broken once: the same cases as those of the typed
 * library, through the C interface. Included by abi.c. */

/* A wheel of 4 kg in massless gimbals that turn freely. */
static precess_device gimballed(void)
{
    precess_device device = device_of(PRECESS_KIND_DGVSCMG);
    int body;
    for (body = 0; body < 2; body++) {
        device.bodies[body].mass = 0.0;
        diagonal(device.bodies[body].inertia, 0.0, 0.0, 0.0);
    }
    device.bodies[0].origin[0] = 0.0;
    device.bodies[2].mass = 4.0;
    return device;
}

static void a_light_hub(double inertia)
{
    hub.mass = 10.0;
    diagonal(hub.inertia, inertia, inertia, inertia);
}

/* What is left of a hub is only rounding of what the device took out. */
static void singular(void)
{
    precess_state state;
    precess_inputs inputs;
    precess_accelerations found;
    precess_fault fault;
    int step;
    a_light_hub(0.0);
    devices[0] = gimballed();
    IS(init(1, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.rate[0][2] = 100.0;
    inputs.motor[0][2] = 0.1;
    for (step = -10; step <= 10; step++) {
        state.coordinate[0][0] = 0.37 * step;
        state.coordinate[0][1] = 0.093 * step;
        IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault),
           PRECESS_ERROR_SINGULAR);
        IS(fault.device, -1);
    }

    /* A point mass brought onto the outer gimbal's axis: cos(1/2) m, and back. */
    a_light_hub(1.0);
    devices[0] = gimballed();
    devices[0].kind = PRECESS_KIND_DGCMG;
    diagonal(devices[0].bodies[2].inertia, 0.0, 0.0, 0.0);
    devices[0].bodies[1].origin[0] = 0.8775825618903728;
    devices[0].bodies[2].origin[0] = -1.0;
    IS(init(1, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.coordinate[0][1] = 0.5;
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault), PRECESS_ERROR_SINGULAR);
    IS(fault.device, 0);
    state.coordinate[0][1] = 0.6;
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault), PRECESS_OK);
}

/* A spring counts turns; an angle that no equation depends on is checked all the same. */
static void angles(void)
{
    precess_state state;
    precess_inputs inputs;
    precess_accelerations found;
    precess_fault fault;
    a_light_hub(1.0);
    devices[0] = device_of(PRECESS_KIND_REACTION_WHEEL);
    devices[0].passive[0].stiffness = 1e-3;
    IS(init(1, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    state.coordinate[0][0] = 100.0;
    IS(precess_state_wrap(&craft, &state), PRECESS_OK);
    NEAR(state.coordinate[0][0], 100.0, 0.0);

    devices[0] = device_of(PRECESS_KIND_BALANCED_REACTION_WHEEL);
    IS(init(1, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.coordinate[0][0] = not_a_number();
    IS(precess_accelerations_of(&craft, &state, &inputs, &found, &fault), PRECESS_ERROR_NOT_FINITE);
    IS(fault.device, 0);
    IS(precess_step(&craft, &state, &inputs, 1e-3, 1, 0, &fault), PRECESS_ERROR_NOT_FINITE);
}

/* A step that friction makes unstable is rejected, with the longest that holds. */
static void stability(void)
{
    precess_state state;
    precess_inputs inputs;
    precess_fault fault;
    a_light_hub(10.0);
    devices[0] = device_of(PRECESS_KIND_BALANCED_REACTION_WHEEL);
    diagonal(devices[0].bodies[0].inertia, 1e-3, 6e-4, 6e-4);
    devices[0].passive[0].coulomb = 1e-3;
    devices[0].passive[0].coulomb_rate = 1e-4;
    IS(init(1, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.rate[0][0] = 1.0;
    IS(precess_step(&craft, &state, &inputs, 1e-3, 900, 0, &fault), PRECESS_OK);
    IS(precess_step(&craft, &state, &inputs, 1e-3, 200, 0, &fault), PRECESS_ERROR_UNSTABLE);
    IS(fault.device, 0);
    IS(fault.joint, 0);
    NEAR(fault.value, 1e-3, 0.0);
    NEAR(fault.bound, 2.785e-4, 1e-7);
    IS(precess_step(&craft, &state, &inputs, 0.9 * fault.bound, 1000, 0, &fault), PRECESS_OK);
}

/* Powers and work that are not finite are an overflow, not an error of an input. */
static void overflow(void)
{
    precess_state state;
    precess_inputs inputs;
    precess_loads loads;
    precess_power work;
    precess_fault fault;
    a_light_hub(1.0);
    devices[0] = device_of(PRECESS_KIND_BALANCED_REACTION_WHEEL);
    IS(init(1, 0), PRECESS_OK);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.rate[0][0] = 1e150;
    inputs.motor[0][0] = 1e200;
    IS(precess_loads_of(&craft, &state, &inputs, PRECESS_AXES_BODY, &loads, &fault),
       PRECESS_ERROR_OVERFLOW);
    IS(fault.device, 0);
    IS(precess_step(&craft, &state, &inputs, 1e-9, 1, &work, &fault), PRECESS_ERROR_OVERFLOW);
    IS(precess_state_at_rest(&craft, &state), PRECESS_OK);
    IS(precess_inputs_none(&craft, &inputs), PRECESS_OK);
    state.velocity[0] = 1e200;
    IS(precess_step(&craft, &state, &inputs, 1e200, 1, &work, &fault), PRECESS_ERROR_OVERFLOW);
}

static void promises(void)
{
    singular();
    angles();
    stability();
    overflow();
}
