/* Written by `precess-bake --general --batch`. In place of the system's header, which NVRTC has not. */

#ifndef PRECESS_NVRTC_FLOAT_H
#define PRECESS_NVRTC_FLOAT_H

/* Doubles of a GPU are IEEE-754 binary64, subnormal numbers included. */
#undef DBL_MANT_DIG
#define DBL_MANT_DIG 53
#undef DBL_EPSILON
#define DBL_EPSILON 2.2204460492503131e-16
#undef DBL_MIN
#define DBL_MIN 2.2250738585072014e-308
#undef DBL_MAX
#define DBL_MAX 1.7976931348623157e308

#endif
