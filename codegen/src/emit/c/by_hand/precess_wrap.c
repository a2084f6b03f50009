/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h. The arc tangent is that of FreeBSD's
 * msun (s_atan.c, e_atan2.c), in its order of operations:
 *
 * ====================================================
 * Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved.
 *
 * Developed at SunPro, a Sun Microsystems, Inc. business.
 * Permission to use, copy, modify, and distribute this
 * software is freely granted, provided that this notice
 * is preserved.
 * ====================================================
 */

#include "precess_wrap.h"

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

/* Arc tangent of a number that is not negative, infinity included. */
static double arc_tangent(double t)
{
    /* Arc tangents of 1/2, 1, 3/2 and infinity, and what is left of them. */
    static const double HIGH[4] = {
        4.63647609000806093515e-01, 7.85398163397448278999e-01, 9.82793723247329054082e-01,
        1.57079632679489655800e+00};
    static const double LOW[4] = {
        2.26987774529616870924e-17, 3.06161699786838301793e-17, 1.39033110312309984516e-17,
        6.12323399573676603587e-17};
    static const double C[11] = {
        3.33333333333329318027e-01,  -1.99999999998764832476e-01, 1.42857142725034663711e-01,
        -1.11111104054623557880e-01, 9.09088713343650656196e-02,  -7.69187620504482999495e-02,
        6.66107313738753120669e-02,  -5.83357013379057348645e-02, 4.97687799461593236017e-02,
        -3.65315727442169155270e-02, 1.62858201153657823623e-02};
    int part = -1;
    double x = t;
    double z;
    double w;
    double odd;
    double even;

    if (t < 1.0 / 134217728.0) {
        return t;
    }
    if (t >= 2.4375) {
        part = 3;
        x = -1.0 / t;
    } else if (t >= 1.1875) {
        part = 2;
        x = (t - 1.5) / (1.0 + 1.5 * t);
    } else if (t >= 0.6875) {
        part = 1;
        x = (t - 1.0) / (t + 1.0);
    } else if (t >= 0.4375) {
        part = 0;
        x = (2.0 * t - 1.0) / (2.0 + t);
    }
    z = x * x;
    w = z * z;
    odd = z * (C[0] + w * (C[2] + w * (C[4] + w * (C[6] + w * (C[8] + w * C[10])))));
    even = w * (C[1] + w * (C[3] + w * (C[5] + w * (C[7] + w * C[9]))));
    if (part < 0) {
        return x - x * (odd + even);
    }
    return HIGH[part] - (x * (odd + even) - LOW[part] - x);
}

/* The angle with this sine and cosine, neither NaN, not both zero. */
static double angle_of(double sine, double cosine)
{
    const double ratio = sine / cosine;
    const double acute = arc_tangent(ratio < 0.0 ? -ratio : ratio);
    const double left = 3.1415926535897931160e+00 - (acute - 1.2246467991473531772e-16);
    const double angle = cosine < 0.0 ? left : acute;

    return sine < 0.0 ? -angle : angle;
}

double precess_wrapped_angle(double angle)
{
    double sine;
    double cosine;
    double sine_guess;
    double cosine_guess;
    double guess;

    if (!(angle <= PRECESS_LARGEST_ANGLE && angle >= -PRECESS_LARGEST_ANGLE)
        || (angle <= 3.1415926535897931160e+00 && angle >= -3.1415926535897931160e+00)) {
        return angle;
    }
    precess_sin_cos(angle, &sine, &cosine);
    guess = angle_of(sine, cosine);
    precess_sin_cos(guess, &sine_guess, &cosine_guess);
    /* One step of Newton's method: what it leaves is the cube of the guess's error. */
    return guess + (sine * cosine_guess - cosine * sine_guess);
}
