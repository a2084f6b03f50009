/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * Derivatives of the accelerations along a direction of state and inputs (Jacobian-vector
 * products): what devices and hub share.
 *
 * With `M a + bias = loads` the accelerations change by `M^-1` times what the loads change by at
 * given accelerations: by the kernel `load_derivatives`; of wrenches and of the gradient of
 * gravity, which are trigonometric polynomials of second order in each angle, by an exact rule of
 * four evaluations. Vectors along the axes of B unless a comment says otherwise. No pointer may be
 * null.
 */

#ifndef PRECESS_JVP_H
#define PRECESS_JVP_H

#include "precess_device.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The direction of a joint, and of what is given of it. */
struct precess_joint_direction {
    /** Of its coordinate, rad or m. */
    double coordinate;
    /** Of its rate, rad/s or m/s. */
    double rate;
    /** Of the torque or force of its motor where it is driven, N m or N; of its acceleration where
     * that is prescribed, rad/s² or m/s²; not read of one that is locked. */
    double given;
    /** Of the wrench on its child body, own axes. */
    struct precess_wrench wrench;
};

/** The direction of the hub, and of what acts on it. */
struct precess_hub_direction {
    /** Of its position, along the axes of N, m. */
    double r_b_n[3];
    /** Of its attitude: a small rotation about the axes of B, rad. */
    double rotation[3];
    /** Of its angular velocity, rad/s. */
    double omega[3];
    /** Of the force through B, N, and of the torque about B, N m. */
    double force[3];
    double torque_b[3];
    /** Of its accelerations where they are prescribed, m/s² and rad/s². */
    double r_b_n_ddot[3];
    double omega_dot[3];
};

/** An evaluation, and what it changes by along a direction. */
struct precess_change {
    /** The evaluation: angular velocity, field, second moment of the devices. */
    struct precess_evaluation at;
    /** The hub's accelerations there, relative to the frame that falls with the field at B. */
    struct precess_body_acceleration hub;
    /** What of it changes: angular velocity, field, second moment; loads at these accelerations. */
    struct precess_evaluation by;
};

/** Starts from an evaluation: hub and devices as one body, the hub by itself, where the hub is, the
 * accelerations of B and the angular one that were found, and the direction. */
void precess_change_start(
    const struct precess_body *body,
    const struct precess_body *hub,
    const struct precess_gravity *gravity,
    const struct precess_matrix *bn,
    const double r_b_n[3],
    const double omega[3],
    const double r_b_n_ddot[3],
    const double omega_dot[3],
    const struct precess_hub_direction *direction,
    struct precess_change *out);

/** The hub's motion along the axes of a device, and the direction of its angular velocity. */
void precess_change_along_device(
    const struct precess_change *change,
    const struct precess_matrix *mount,
    struct precess_body_rate *omega,
    struct precess_body_acceleration *hub,
    double by_omega[3]);

/** Adds a column of load derivatives: force and moment on the device, then `rows` joints. */
void precess_add_column(const double *column, double by, int rows, double *sum);

/** Drives of a direction: of driven joints what their motors give more, less what springs, friction
 * and the joints' own loads take more. */
void precess_direction_drives(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_passive *passive,
    const double *rates,
    const struct precess_joint_inputs *inputs,
    const struct precess_joint_direction *directions,
    const double *loads,
    struct precess_drive *out);

/** Subtracts force and moment on a device, along its axes, from what acts on the hub. */
void precess_change_subtract(
    struct precess_change *change, const struct precess_matrix *mount, const double loads[6]);

/** An evaluation without loads, in the field of a central body or in none. */
void precess_change_part(
    const struct precess_change *change,
    const struct precess_central *central,
    struct precess_evaluation *out);

/** Adds what acts on the hub in such an evaluation, and its second moment, times a weight. */
void precess_change_add(
    struct precess_change *change, const struct precess_evaluation *part, double weight);

/** Sine and cosine of an angle that is turned on by `2 n + 1` eighths of a turn. */
void precess_turned(int n, double sine, double cosine, double *turned_sine, double *turned_cosine);

/** The weight of the value at that angle: the four of them sum up to the derivative of a
 * trigonometric polynomial of second order. */
double precess_turned_weight(int n);

/** What the hub's accelerations change by once every device is eliminated; `hub` is the hub by
 * itself. */
enum precess_status precess_change_solve(
    struct precess_change *change,
    const struct precess_body *hub,
    const struct precess_hub_mode *mode,
    const struct precess_hub_direction *direction,
    struct precess_body_acceleration *out);

/** The same relative to N. */
enum precess_status precess_change_finish(
    const struct precess_change *change,
    const struct precess_hub_mode *mode,
    const struct precess_hub_direction *direction,
    const struct precess_body_acceleration *relative,
    double r_b_n_ddot[3],
    double omega_dot[3]);

#ifdef __cplusplus
}
#endif

#endif
