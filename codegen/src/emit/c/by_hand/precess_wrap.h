/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * An angle less whole turns.
 */

#ifndef PRECESS_WRAP_H
#define PRECESS_WRAP_H

#include "precess_sin_cos.h"

#ifdef __cplusplus
extern "C" {
#endif

/**
 * The angle in [-pi, pi] with the same sine and cosine, rad, with the bits of the Rust library. One
 * in that range, one beyond PRECESS_LARGEST_ANGLE and one that is no number stay as they are.
 */
double precess_wrapped_angle(double angle);

#ifdef __cplusplus
}
#endif

#endif
