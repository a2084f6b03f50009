/* Reads spacecraft, states and inputs as doubles; writes statuses, accelerations, the state after
 * some steps, and its wrapped coordinates: see main.rs of this suite. NAME and UPPER are the set's. */

#include <stdio.h>

#include "NAME.h"

static int is_over;

static double next(void)
{
    double x = 0.0;

    is_over = fread(&x, sizeof x, 1, stdin) != 1;
    return x;
}

static void read_numbers(double *numbers, int count)
{
    int k;

    for (k = 0; k < count; k++) {
        numbers[k] = next();
    }
}

static void give(const double *numbers, int count)
{
    if (fwrite(numbers, sizeof *numbers, (size_t)count, stdout) != (size_t)count) {
        is_over = 1;
    }
}

static void read_parameters(struct NAME_parameters *p)
{
    int k;

    p->hub.mass = next();
    read_numbers(p->hub.centre_of_mass, 3);
    read_numbers(p->hub.inertia, 6);
    p->attitude = next() == 0.0 ? PRECESS_QUATERNION : PRECESS_MRP;
    for (k = 0; k < UPPER_DEVICES; k++) {
        read_numbers(p->mounts[k].columns[0], 3);
        read_numbers(p->mounts[k].columns[1], 3);
        read_numbers(p->mounts[k].columns[2], 3);
    }
    for (k = 0; k < UPPER_JOINTS; k++) {
        struct precess_body_parameters *const b = &p->bodies[k];
        struct precess_passive *const spring = &p->passive[k];

        b->mass = next();
        read_numbers(b->origin, 3);
        read_numbers(b->centre_of_mass, 3);
        read_numbers(b->inertia, 6);
        spring->stiffness = next();
        spring->rest = next();
        spring->viscous = next();
        spring->coulomb = next();
        spring->coulomb_rate = next();
    }
}

static void read_state(struct NAME_state *s)
{
    read_numbers(s->r_b_n, 3);
    read_numbers(s->r_b_n_dot, 3);
    read_numbers(s->attitude, 4);
    read_numbers(s->omega, 3);
    read_numbers(s->coordinates, UPPER_JOINTS);
    read_numbers(s->rates, UPPER_JOINTS);
}

static void read_inputs(struct NAME_inputs *u)
{
    int k;

    read_numbers(u->force, 3);
    read_numbers(u->torque_b, 3);
    for (k = 0; k < UPPER_JOINTS; k++) {
        u->joints[k].mode = (enum precess_mode)(int)next();
        u->joints[k].torque = next();
        u->joints[k].acceleration = next();
    }
    u->hub.freedom = (enum precess_hub_freedom)(int)next();
    read_numbers(u->hub.r_b_n_ddot, 3);
    read_numbers(u->hub.omega_dot, 3);
    u->gravity.field = (enum precess_field)(int)next();
    read_numbers(u->gravity.uniform, 3);
    u->gravity.mu = next();
    u->has_wrenches = next() != 0.0;
    for (k = 0; k < UPPER_JOINTS; k++) {
        read_numbers(u->wrenches[k].force, 3);
        read_numbers(u->wrenches[k].moment, 3);
    }
}

int main(void)
{
    for (;;) {
        struct NAME_parameters parameters;
        struct NAME_spacecraft spacecraft;
        struct NAME_state state;
        struct NAME_state wrapped;
        struct NAME_inputs inputs;
        struct NAME_accelerations found = { { 0.0 }, { 0.0 }, { 0.0 } };
        double dt;
        int steps;
        double numbers[4] = { 0.0, 0.0, 0.0, 0.0 };
        int device;
        int k;

        read_parameters(&parameters);
        read_state(&state);
        read_inputs(&inputs);
        dt = next();
        steps = (int)next();
        if (is_over) {
            return 0;
        }
        wrapped = state;
        numbers[0] = NAME_init(&parameters, &spacecraft, &device);
        if (numbers[0] == PRECESS_OK) {
            struct NAME_accelerations made;

            numbers[1] = NAME_accelerations(&spacecraft, &state, &inputs, &made);
            if (numbers[1] == PRECESS_OK) {
                found = made;
            }
            for (k = 0; k < steps && numbers[2] == PRECESS_OK; k++) {
                numbers[2] = NAME_step(&spacecraft, &state, &inputs, dt, &state);
                numbers[3] += numbers[2] == PRECESS_OK ? 1.0 : 0.0;
            }
            NAME_wrap(&spacecraft, &state, &wrapped);
        }
        give(numbers, 4);
        give(found.r_b_n_ddot, 3);
        give(found.omega_dot, 3);
        give(found.joints, UPPER_JOINTS);
        give(state.r_b_n, 3);
        give(state.r_b_n_dot, 3);
        give(state.attitude, 4);
        give(state.omega, 3);
        give(state.coordinates, UPPER_JOINTS);
        give(state.rates, UPPER_JOINTS);
        give(wrapped.coordinates, UPPER_JOINTS);
        if (is_over) {
            return 1;
        }
    }
}
