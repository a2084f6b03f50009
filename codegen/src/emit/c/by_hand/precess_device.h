/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * What the devices of every kind have in common: bodies, checks of parameters, bounds of pivots,
 * wrenches on bodies.
 *
 * No pointer may be null.
 */

#ifndef PRECESS_DEVICE_H
#define PRECESS_DEVICE_H

#include "precess_evaluation.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A body of a device, and the joint that it moves on. */
struct precess_body_parameters {
    /** Mass, kg. */
    double mass;
    /** Origin of the joint from that of the parent body, in its axes, m; of the first from B, along
     * the axes of B. */
    double origin[3];
    /** Centre of mass from the joint's origin, own axes, m. */
    double centre_of_mass[3];
    /** Inertia about the centre of mass, own axes, entries 11, 12, 13, 22, 23, 33, kg m². */
    double inertia[6];
};

/** Whether a number is rounding beside a scale: within four epsilons of it. */
int precess_is_rounding(double off, double scale);

/** The largest offset of the bodies, m. */
double precess_largest_offset(const struct precess_body_parameters *bodies, int count);

/** The sum of the moments of inertia of a body, kg m². */
double precess_trace(const struct precess_body_parameters *body);

/** Whether these are parameters of a hub: finite, mass above zero, no principal moment of inertia
 * below zero by more than 4096 epsilons of the largest element. */
int precess_hub_is_possible(const struct precess_hub_parameters *hub);

/**
 * Whether these are parameters of a device: finite, the mount a rotation to 4096 epsilons, masses
 * not negative, that of the last body above zero, principal moments of inertia not below zero by
 * more than 4096 epsilons of the largest element, springs and friction not negative. The triangle
 * inequality is not checked.
 */
int precess_device_is_possible(
    const struct precess_matrix *mount,
    const struct precess_body_parameters *bodies,
    const struct precess_passive *passive,
    int count);

/** What the pivot of each joint must exceed: 64 epsilons of the mass or inertia outboard of it in
 * the pose that makes the most of it. */
void precess_pivot_bounds(
    const struct precess_joint_kind *kinds,
    const struct precess_body_parameters *bodies,
    int count,
    double *out);

/** Whether the pivot of each driven joint exceeds its bound, all of them finite. */
enum precess_status precess_check_pivots(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_pivot *pivots,
    const double *bounds,
    const struct precess_drive *drives);

/** Whether the pivot of each driven joint is above zero with what is added to it. */
int precess_pivots_are_positive(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_pivot *pivots,
    const struct precess_drive *drives);

/** Adds wrenches across joints to their drives, and that on the hub, along the device's axes, to
 * the hub's equations. */
void precess_add_carried(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_matrix *mount,
    const struct precess_wrench *joints,
    const struct precess_wrench *hub,
    struct precess_drive *drives,
    struct precess_evaluation *evaluation);

/** The gradient of gravity along the axes of a device. */
void precess_gradient_along(
    const struct precess_matrix *mount,
    const struct precess_central *central,
    struct precess_gradient *out);

#ifdef __cplusplus
}
#endif

#endif
