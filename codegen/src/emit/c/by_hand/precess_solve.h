/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * The hub's six equations: what an evaluation needs besides the kernels.
 *
 * The order of operations is that of the Rust solver, so an evaluation has its bits. Vectors are
 * along B axes; a symmetric tensor is given by its entries 11, 12, 13, 22, 23, 33. No memory but
 * the arguments, no state, no loop that depends on data. No pointer may be null.
 */

#ifndef PRECESS_SOLVE_H
#define PRECESS_SOLVE_H

#include "precess_hub.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How a solution came out. */
enum precess_solved {
    /** The accelerations are found. */
    PRECESS_SOLVED = 0,
    /** A pivot of the hub is only rounding beside the mass or inertia that was there before any
     * joint was eliminated: it is left without inertia. */
    PRECESS_SINGULAR = 1,
    /** An acceleration, or the first pivot that is not above its bound, or that bound, is infinite
     * or no number: so is an input, or a result overflows. */
    PRECESS_NOT_FINITE = 2
};

/** The hub with the constant shares of its devices, as one rigid body. */
struct precess_body {
    /** Mass, kg. */
    double mass;
    /** First moment about B, kg m. */
    double first_moment[3];
    /** Inertia about B, kg m². */
    double inertia[6];
};

/** The hub's equations so far. */
struct precess_assembly {
    /** Hub and devices as one rigid body. */
    struct precess_body body;
    /** Moments of inertia of its constant share, entries 11, 22, 33: what the moving share may
     * cancel. */
    double constant[3];
    /** What acts from outside through B, N. */
    double force[3];
    /** What acts from outside about B, N m. */
    double torque_b[3];
    /** What eliminated joints subtract from the equations: sums of the fields of the shares. */
    double m_vv[6];
    /** Likewise, row by row. */
    double m_vw[9];
    /** Likewise. */
    double m_ww[6];
    /** Likewise. */
    double h_v[3];
    /** Likewise. */
    double h_w[3];
};

/**
 * Components along a device's axes of a place given along B's, as `prepare` takes the origin of its
 * first joint. The mount row by row: entries 11, 12, 13, 21 and so on. `out` is not `r`.
 */
void precess_along_device(const double mount[9], const double r[3], double out[3]);

/**
 * The hub by itself: mass, kg, centre of mass from B, m, inertia about it, kg m².
 */
void precess_body_of_hub(
    double mass, const double r_bc_b[3], const double i_b_bc[6], struct precess_body *out);

/**
 * Adds the constant share of a device. Once, in the order of the devices.
 */
void precess_body_add_constant_share(struct precess_body *body,
                                     const struct precess_constant_share *share);

/**
 * Starts an evaluation: force through B, N, and torque about B, N m, from outside.
 */
void precess_assembly_start(
    const struct precess_body *body,
    const double force[3],
    const double torque_b[3],
    struct precess_assembly *out);

/**
 * Adds a device whose joints are eliminated. In the order of the devices.
 */
void precess_assembly_add(struct precess_assembly *assembly, const struct precess_hub_share *share);

/** Adds a force through B, N, and a moment about B, N m, from outside. */
void precess_assembly_add_wrench(
    struct precess_assembly *assembly, const double force[3], const double moment[3]);

/** The hub's six pivots, kg and kg m², and the mass and moments of inertia that they are compared
 * with: those of the spacecraft with every joint locked. */
void precess_assembly_pivots(
    const struct precess_assembly *assembly, double pivots[6], double scales[6]);

/**
 * Solves the equations where the hub turns at `omega`. Nothing is written unless they are solved.
 */
enum precess_solved precess_assembly_solve(
    const struct precess_assembly *assembly,
    const struct precess_body_rate *omega,
    struct precess_body_acceleration *out);

/**
 * Whether a pivot is above 64 epsilons of its scale; below, the acceleration is only rounding. To
 * be checked of each driven joint after `eliminate`. The scale of a joint is the larger of its
 * diagonal and of the inertia of all bodies outboard of it in the pose that makes the most of it.
 */
int precess_pivot_is_sound(double pivot, double scale);

#ifdef __cplusplus
}
#endif

#endif
