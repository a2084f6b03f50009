/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * Sine and cosine with the same bits on every target.
 */

#ifndef PRECESS_SIN_COS_H
#define PRECESS_SIN_COS_H

#include "precess_hub.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Up to this angle, rad, either way, sine and cosine are those of Rust. */
#define PRECESS_LARGEST_ANGLE 16777216.0

/**
 * Sine and cosine of an angle, rad; no numbers beyond PRECESS_LARGEST_ANGLE, where the Rust goes on
 * with other means. An angle may be wrapped at any time.
 */
void precess_sin_cos(double angle, double *sine, double *cosine);

#ifdef __cplusplus
}
#endif

#endif
