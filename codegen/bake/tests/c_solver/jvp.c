/* Derivatives along a direction whose components are a pattern; of what is locked or fixed they are zero. */

/* The component of a number. */
static double component(int k)
{
    return (double)((k * 37 + 11) % 101 - 50) / 50.0;
}

static void components(int first, double out[3])
{
    int k;

    for (k = 0; k < 3; k++) {
        out[k] = component(first + k);
    }
}

static void direction_of(const struct NAME_inputs *inputs, struct NAME_direction *out)
{
    static const struct NAME_direction NONE = { 0 };
    int k;

    *out = NONE;
    if (inputs->hub.freedom != PRECESS_HUB_FIXED) {
        components(0, out->hub.r_b_n);
        components(3, out->hub.rotation);
        components(6, out->hub.omega);
    }
    components(9, out->hub.force);
    components(12, out->hub.torque_b);
    components(15, out->hub.r_b_n_ddot);
    components(18, out->hub.omega_dot);
    for (k = 0; k < UPPER_JOINTS; k++) {
        struct precess_joint_direction *const joint = &out->joints[k];

        if (inputs->joints[k].mode != PRECESS_LOCKED) {
            joint->coordinate = component(21 + 9 * k);
            joint->rate = component(22 + 9 * k);
            joint->given = component(23 + 9 * k);
        }
        components(24 + 9 * k, joint->wrench.force);
        components(27 + 9 * k, joint->wrench.moment);
    }
}

int main(void)
{
    for (;;) {
        struct NAME_parameters parameters;
        struct NAME_spacecraft spacecraft;
        struct NAME_state state;
        struct NAME_inputs inputs;
        struct NAME_direction direction;
        struct NAME_accelerations found;
        struct NAME_accelerations along = { { 0.0 }, { 0.0 }, { 0.0 } };
        double status;
        int device;

        read_parameters(&parameters);
        read_state(&state);
        read_inputs(&inputs);
        (void)next();
        (void)next();
        if (is_over) {
            return 0;
        }
        direction_of(&inputs, &direction);
        status = NAME_init(&parameters, &spacecraft, &device);
        if (status == PRECESS_OK) {
            status = NAME_jvp(&spacecraft, &state, &inputs, &direction, &found, &along);
        }
        give(&status, 1);
        give(along.r_b_n_ddot, 3);
        give(along.omega_dot, 3);
        give(along.joints, UPPER_JOINTS);
        if (is_over) {
            return 1;
        }
    }
}
