/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * Attitude of B with respect to N: a quaternion, or modified Rodrigues parameters (MRPs).
 *
 * Four numbers: the quaternion with its scalar first, or the three MRPs and zero. `out` is none of
 * the other arguments unless a function says so. No pointer may be null.
 */

#ifndef PRECESS_ATTITUDE_H
#define PRECESS_ATTITUDE_H

#include "precess_arithmetic.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The parameters of an attitude. */
enum precess_parameterisation {
    /** `cos(phi / 2)`, and `sin(phi / 2)` along the axis. */
    PRECESS_QUATERNION = 0,
    /** `tan(phi / 4)` along the axis. */
    PRECESS_MRP = 1
};

/** `[BN]`: maps components expressed in N to components expressed in B. */
void precess_attitude_dcm(
    enum precess_parameterisation by, const double attitude[4], struct precess_matrix *out);

/** Rates of the parameters, 1/s, for the angular velocity of B, expressed in B, rad/s. */
void precess_attitude_rate(
    enum precess_parameterisation by,
    const double attitude[4],
    const double omega[3],
    double out[4]);

/** The same attitude by parameters that a step may start from; `out` may be `attitude`. */
void precess_attitude_regular(
    enum precess_parameterisation by, const double attitude[4], double out[4]);

/** The same attitude by a quaternion of unit length, or the MRPs of at most half a turn; `out` may
 * be `attitude`. */
void precess_attitude_normalised(
    enum precess_parameterisation by, const double attitude[4], double out[4]);

/** Whether the parameters are an attitude. */
int precess_attitude_is_valid(enum precess_parameterisation by, const double attitude[4]);

#ifdef __cplusplus
}
#endif

#endif
