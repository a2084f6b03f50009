#include <stdio.h>

#include "bus.h"

int main(void)
{
    static const struct bus_parameters PARAMETERS = {
        .hub = { .mass = 120.0, .inertia = { 14.0, 0.0, 0.0, 16.0, 0.0, 11.0 } },
        .attitude = PRECESS_QUATERNION,
        .mounts = { { { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } } } },
        .bodies = { {
            .mass = 2.6,
            .origin = { 0.3, 0.0, 0.0 },
            .centre_of_mass = { 0.0, 3e-7, 0.0 },
            .inertia = { 0.0069, 2e-8, -1.5e-8, 0.0041, 0.0, 0.0041 },
        } },
        .passive = { { .viscous = 1e-5 } },
    };
    struct bus_state state = {
        .r_b_n = { 7e6 }, .r_b_n_dot = { 0.0, 7546.0 }, .attitude = { 1.0 }
    };
    struct bus_inputs inputs = {
        .gravity = { .field = PRECESS_CENTRAL_FIELD, .mu = 3.986004418e14 }
    };
    struct bus_spacecraft bus;
    int device;
    int k;

    if (bus_init(&PARAMETERS, &bus, &device) != PRECESS_OK) {
        printf("device %d has parameters that no device of its kind has\n", device);
        return 1;
    }
    inputs.joints[BUS_WHEEL_X_WHEEL].torque = 0.01;
    for (k = 0; k < 1000; k++) {
        const enum precess_status status = bus_step(&bus, &state, &inputs, 0.01, &state);

        if (status != PRECESS_OK) {
            printf("step %d: status %d\n", k, (int)status);
            return 1;
        }
    }
    printf("%.17g %.17g\n", state.rates[BUS_WHEEL_X_WHEEL], state.omega[0]);
    return 0;
}
