/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * Joints: modes, motors, springs, dampers, dry friction, and the drive that a kernel takes.
 *
 * Numbers are in rad and N m where a joint turns, in m and N where it slides. No pointer may be
 * null.
 */

#ifndef PRECESS_JOINT_H
#define PRECESS_JOINT_H

#include "precess_hub.h"
#include "precess_status.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Spring, damper and dry friction of a joint; all zero of a free one. They act beside the motor:
 * `-k (q - q_0) - c q' - u_c q' / sqrt(q'^2 + q_c'^2)`. */
struct precess_passive {
    /** `k`, N m/rad or N/m. */
    double stiffness;
    /** `q_0`, the coordinate at which the spring is at rest, rad or m. */
    double rest;
    /** `c`, N m s/rad or N s/m. */
    double viscous;
    /** `u_c`, N m or N. */
    double coulomb;
    /** `q_c'`, the rate below which dry friction fades, rad/s or m/s. */
    double coulomb_rate;
};

/** What is given of a joint. */
enum precess_mode {
    /** The torque, N m, or the force, N, of its motor. */
    PRECESS_DRIVEN = 0,
    /** Its acceleration, rad/s² or m/s². */
    PRECESS_PRESCRIBED = 1,
    /** It does not move: its rate has to be zero. */
    PRECESS_LOCKED = 2
};

/** Motor and mode of a joint. */
struct precess_joint_inputs {
    /** What is given. */
    enum precess_mode mode;
    /** Torque or force of the motor; not read unless the joint is driven, but finite. */
    double torque;
    /** Acceleration; not read unless the joint is prescribed. */
    double acceleration;
};

/** What the kind says of a joint. */
struct precess_joint_kind {
    /** The axis that it turns about or slides along: 0, 1, 2 of x, y, z. */
    int axis;
    /** Whether it slides. */
    int slides;
    /** Whether it has a motor; otherwise the kind keeps its rate. */
    int driven;
};

/** Torque and mode of a joint as weights. */
struct precess_drive {
    /** Torque or force of a driven joint, N m or N. */
    double torque;
    /** One of a driven joint, else zero. */
    double driven;
    /** Zero of a driven joint, else one. */
    double held;
    /** The acceleration of a joint that is not driven, else zero. */
    double given;
};

/** Inertia that a joint moves, kg m² or kg. */
struct precess_pivot {
    /** With all joints outboard of it eliminated. */
    double pivot;
    /** With all joints outboard of it locked. */
    double diagonal;
};

/** Bounds of the largest `c / m`, 1/s, and `k / m`, 1/s², over all motions. */
struct precess_stiffness {
    /** Of dampers and friction. */
    double damping;
    /** Of springs. */
    double spring;
};

/** Shares of damping, s, and stiffness, s², that are subtracted from the mass matrix. */
struct precess_reduction {
    /** `x` of `M - x C - y K`. */
    double damping;
    /** `y`. */
    double stiffness;
};

/** Whether the joint has neither spring nor friction. */
int precess_passive_is_none(const struct precess_passive *passive);

/** Torque or force of spring and friction. */
double precess_passive_torque(
    const struct precess_passive *passive, double coordinate, double rate);

/** By how much friction grows with the rate, N m s/rad or N s/m. */
double precess_passive_damping(const struct precess_passive *passive, double rate);

/** The drives of the joints of a device; springs and friction are added where `is_free` is zero. */
enum precess_status precess_joint_drives(
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_passive *passive,
    int is_free,
    const double *coordinates,
    const double *rates,
    const struct precess_joint_inputs *inputs,
    struct precess_drive *out);

/** Drives without torques; of driven joints what is subtracted from their inertia, at these
 * rates. */
void precess_joint_reductions(
    int count,
    const struct precess_passive *passive,
    const double *rates,
    const struct precess_joint_inputs *inputs,
    const struct precess_reduction *reduction,
    struct precess_drive *out);

/** Adds the joints of a device: pivot and diagonal of each driven one. */
void precess_stiffness_add(
    struct precess_stiffness *stiffness,
    const struct precess_joint_kind *kinds,
    int count,
    const struct precess_passive *passive,
    const double *rates,
    const struct precess_pivot *pivots,
    const struct precess_drive *drives);

/** Whether a step is far below the limit of stability; NaN is not. */
int precess_stiffness_accepts(const struct precess_stiffness *stiffness, double dt);

/** Lines within which steps are stable: (S2) of dynamics/src/integrate/longest_step.rs. */
enum precess_stable_line {
    /** The real root and any damping at once. */
    PRECESS_LINE_BOTH = 0,
    /** Vibrations of little damping by springs. */
    PRECESS_LINE_UNDAMPED = 1,
    /** Friction. */
    PRECESS_LINE_REAL_ROOT = 2,
    /** How little damping that is. */
    PRECESS_LINE_LITTLE_DAMPING = 3,
    /** Vibrations of any damping. */
    PRECESS_LINE_ANY_DAMPING = 4
};

/** What a step of magnitude `dt` subtracts from the mass matrix by a line. */
void precess_stable_reduction(
    enum precess_stable_line line, double dt, struct precess_reduction *out);

#ifdef __cplusplus
}
#endif

#endif
