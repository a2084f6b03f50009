/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * One evaluation of a spacecraft with a rigid hub: what devices and hub share.
 *
 * Vectors along the axes of B unless a comment says otherwise. No pointer may be null.
 */

#ifndef PRECESS_EVALUATION_H
#define PRECESS_EVALUATION_H

#include "precess_gravity.h"
#include "precess_joint.h"
#include "precess_solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What is given of the hub. */
enum precess_hub_freedom {
    /** It is free: force and torque are given. */
    PRECESS_HUB_FREE = 0,
    /** It is fixed, and has to be at rest. */
    PRECESS_HUB_FIXED = 1,
    /** Its accelerations are given. */
    PRECESS_HUB_PRESCRIBED = 2
};

/** Mode of the hub. */
struct precess_hub_mode {
    /** What is given. */
    enum precess_hub_freedom freedom;
    /** Acceleration of B where it is prescribed, m/s². */
    double r_b_n_ddot[3];
    /** Angular acceleration where it is prescribed, rad/s². */
    double omega_dot[3];
};

/** A force, N, with its moment, N m. */
struct precess_wrench {
    /** Force. */
    double force[3];
    /** Moment. */
    double moment[3];
};

/** The hub by itself. */
struct precess_hub_parameters {
    /** Mass, kg. */
    double mass;
    /** Centre of mass from B, m. */
    double centre_of_mass[3];
    /** Inertia about the centre of mass, entries 11, 12, 13, 22, 23, 33, kg m². */
    double inertia[6];
};

/** An evaluation so far. */
struct precess_evaluation {
    /** Angular velocity of the hub. */
    struct precess_body_rate omega;
    /** The field at B, m/s². */
    double at_b[3];
    /** Whether there is a central field. */
    int is_central;
    /** What it adds to that at B. */
    struct precess_central central;
    /** The hub's equations. */
    struct precess_assembly assembly;
    /** Second moment of the devices about B in a central field, kg m². */
    double second_moment[6];
    /** Of springs and friction. */
    struct precess_stiffness stiffness;
};

/** Starts an evaluation: angular velocity, rad/s, gravity, `[BN]`, position of B along N's axes, m,
 * force through B, N, and torque about B, N m. */
void precess_evaluation_start(
    const struct precess_body *body,
    const double omega[3],
    const struct precess_gravity *gravity,
    const struct precess_matrix *bn,
    const double r_b_n[3],
    const double force[3],
    const double torque_b[3],
    struct precess_evaluation *out);

/** The hub's accelerations once every device is eliminated, relative to the frame that falls with
 * the field at B; `hub` is the hub by itself. */
enum precess_status precess_evaluation_solve(
    struct precess_evaluation *evaluation,
    const struct precess_body *hub,
    const struct precess_hub_mode *mode,
    struct precess_body_acceleration *out);

/** The hub's accelerations, m/s² and rad/s², from those that fall with the field. */
enum precess_status precess_evaluation_finish(
    const struct precess_evaluation *evaluation,
    const struct precess_hub_mode *mode,
    const struct precess_body_acceleration *relative,
    double r_b_n_ddot[3],
    double omega_dot[3]);

/** The stiffness of springs and friction on a hub of this mode, once every device is eliminated. */
void precess_evaluation_stiffness(
    const struct precess_evaluation *evaluation,
    const struct precess_hub_mode *mode,
    struct precess_stiffness *out);

/** Whether gravity and mode of the hub have finite numbers and known modes. */
int precess_environment_is_finite(
    const struct precess_gravity *gravity, const struct precess_hub_mode *mode);

#ifdef __cplusplus
}
#endif

#endif
