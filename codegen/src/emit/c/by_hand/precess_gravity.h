/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * Gravity: a uniform field, or that of a central body with its gradient.
 *
 * `a(r) = g + G r`, `G = mu / R³ (3 n nᵀ - 1)`, r from B, n from the centre to B. Expressed in B
 * unless an argument says otherwise. No pointer may be null.
 */

#ifndef PRECESS_GRAVITY_H
#define PRECESS_GRAVITY_H

#include "precess_arithmetic.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Which field there is. */
enum precess_field {
    /** None. */
    PRECESS_NO_FIELD = 0,
    /** The same acceleration everywhere. */
    PRECESS_UNIFORM_FIELD = 1,
    /** That of a central body at the inertial origin. */
    PRECESS_CENTRAL_FIELD = 2
};

/** The gravity that acts on hub and devices. */
struct precess_gravity {
    /** Which. */
    enum precess_field field;
    /** Acceleration of a uniform field, expressed in N, m/s². */
    double uniform[3];
    /** Gravitational parameter of a central body, m³/s². */
    double mu;
};

/** What a central body adds to the field at B. */
struct precess_central {
    /** G, 1/s². */
    double gradient[6];
    /** n, from the centre to B. */
    double n[3];
    /** `mu / R⁴`, 1/(m s²). */
    double slope;
};

/** The field at B, m/s², for `[BN]` and the position of B, expressed in N, m; `central` is written
 * of a central field only. */
void precess_gravity_at(
    const struct precess_gravity *gravity,
    const struct precess_matrix *bn,
    const double r_b_n[3],
    double at_b[3],
    struct precess_central *central);

/** Second moment of a mass distribution from its inertia about the same point, kg m². */
void precess_second_moment(const double inertia[6], double out[6]);

/** Force, N, and moment about B, N m, that the gradient exerts on a rigid body, by its first
 * moment, kg m, and second moment, kg m², about B. */
void precess_central_wrench(
    const struct precess_central *central,
    const double first_moment[3],
    const double second_moment[6],
    double force[3],
    double moment[3]);

/** Third-order force on the whole spacecraft, N, by its second moment about B, kg m². */
void precess_central_third_order(
    const struct precess_central *central, const double second_moment[6], double force[3]);

#ifdef __cplusplus
}
#endif

#endif
