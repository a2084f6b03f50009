#include "precess_dgvscmg.h"
#include "precess_sin_cos.h"
#include "precess_solve.h"

#define DEVICES 4

/* A device: its constants, where its joints are and how they move, and what is given of them. */
struct device {
    struct precess_dgvscmg_prepared constants;
    double gamma_o;
    double gamma_i;
    double theta;
    struct precess_dgvscmg_rates rates;
    struct precess_dgvscmg_motors motors;
    struct precess_dgvscmg_modes modes;
    /* What the pivots of outer gimbal, inner gimbal and wheel are checked against, kg m^2. */
    double scale[3];
};

/* Whether a joint that is driven has a pivot that is more than rounding. */
static int is_sound(double driven, double pivot, double diagonal, double scale)
{
    return driven == 0.0 || precess_pivot_is_sound(pivot, diagonal > scale ? diagonal : scale);
}

/* Accelerations of the hub and of every joint. */
static enum precess_solved evaluate(
    const struct precess_body *body,
    const struct device devices[DEVICES],
    const struct precess_body_rate *omega,
    const double force[3],
    const double torque_b[3],
    struct precess_body_acceleration *hub,
    struct precess_dgvscmg_joint_accelerations joints[DEVICES])
{
    struct precess_dgvscmg_gains gains[DEVICES];
    struct precess_assembly assembly;
    enum precess_solved solved;
    int k;

    precess_assembly_start(body, force, torque_b, &assembly);
    for (k = 0; k < DEVICES; k++) {
        const struct device *const d = &devices[k];
        struct precess_dgvscmg_trig trig;
        struct precess_dgvscmg_eliminated e;

        precess_sin_cos(d->gamma_o, &trig.sin_gamma_o, &trig.cos_gamma_o);
        precess_sin_cos(d->gamma_i, &trig.sin_gamma_i, &trig.cos_gamma_i);
        precess_sin_cos(d->theta, &trig.sin_theta, &trig.cos_theta);
        precess_dgvscmg_eliminate(
            &d->constants, &trig, &d->rates, omega, &d->motors, &d->modes, &e);
        if (!is_sound(d->modes.driven_o, e.pivot_o, e.diagonal_o, d->scale[0])
            || !is_sound(d->modes.driven_i, e.pivot_i, e.diagonal_i, d->scale[1])
            || !is_sound(d->modes.driven_w, e.pivot_w, e.pivot_w, d->scale[2])) {
            return PRECESS_SINGULAR;
        }
        precess_assembly_add(&assembly, &e.share);
        gains[k] = e.gains;
    }
    solved = precess_assembly_solve(&assembly, omega, hub);
    if (solved != PRECESS_SOLVED) {
        return solved;
    }
    for (k = 0; k < DEVICES; k++) {
        precess_dgvscmg_back_substitute(&gains[k], hub, &joints[k]);
    }
    return PRECESS_SOLVED;
}
