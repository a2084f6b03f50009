/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h.
 */

#include "precess_attitude.h"

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

static double norm_squared(const double q[4])
{
    return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
}

/* The quaternion over a size at which no square overflows or underflows; one of about unit length
 * is not scaled. */
static void scaled(const double q[4], double out[4])
{
    const double vector = precess_larger(
        precess_larger(precess_magnitude(q[1]), precess_magnitude(q[2])), precess_magnitude(q[3]));
    const double size = precess_larger(vector, precess_magnitude(q[0]));
    double first;
    double second;
    int k;

    if (size >= DBL_EPSILON && size <= 1.0 / DBL_EPSILON) {
        for (k = 0; k < 4; k++) {
            out[k] = q[k];
        }
        return;
    }
    precess_reciprocal_in_two(size, &first, &second);
    for (k = 0; k < 4; k++) {
        out[k] = q[k] * first * second;
    }
}

static void dcm_of_quaternion(const double attitude[4], struct precess_matrix *out)
{
    double q[4];
    double s;
    double s1;
    double s2;
    double s3;

    scaled(attitude, q);
    s = 2.0 * (1.0 / norm_squared(q));
    s1 = s * q[1];
    s2 = s * q[2];
    s3 = s * q[3];
    out->columns[0][0] = 1.0 - (s2 * q[2] + s3 * q[3]);
    out->columns[0][1] = s1 * q[2] - s3 * q[0];
    out->columns[0][2] = s1 * q[3] + s2 * q[0];
    out->columns[1][0] = s1 * q[2] + s3 * q[0];
    out->columns[1][1] = 1.0 - (s1 * q[1] + s3 * q[3]);
    out->columns[1][2] = s2 * q[3] - s1 * q[0];
    out->columns[2][0] = s1 * q[3] - s2 * q[0];
    out->columns[2][1] = s2 * q[3] + s1 * q[0];
    out->columns[2][2] = 1.0 - (s1 * q[1] + s2 * q[2]);
}

static void dcm_of_mrp(const double sigma[4], struct precess_matrix *out)
{
    const double x = sigma[0];
    const double y = sigma[1];
    const double z = sigma[2];
    const double xx = x * x;
    const double yy = y * y;
    const double zz = z * z;
    const double s2 = xx + yy + zz;
    const double root = 1.0 / (1.0 + s2);
    const double scale = root * root;
    const double a = 8.0 * scale;
    const double b = 4.0 * (1.0 - s2) * scale;
    const double xy = a * (x * y);
    const double xz = a * (x * z);
    const double yz = a * (y * z);
    const double bx = b * x;
    const double by = b * y;
    const double bz = b * z;

    out->columns[0][0] = 1.0 - a * (yy + zz);
    out->columns[0][1] = xy - bz;
    out->columns[0][2] = xz + by;
    out->columns[1][0] = xy + bz;
    out->columns[1][1] = 1.0 - a * (xx + zz);
    out->columns[1][2] = yz - bx;
    out->columns[2][0] = xz - by;
    out->columns[2][1] = yz + bx;
    out->columns[2][2] = 1.0 - a * (xx + yy);
}

void precess_attitude_dcm(
    enum precess_parameterisation by, const double attitude[4], struct precess_matrix *out)
{
    if (by == PRECESS_MRP) {
        dcm_of_mrp(attitude, out);
    } else {
        dcm_of_quaternion(attitude, out);
    }
}

static void rate_of_mrp(const double sigma[4], const double omega[3], double out[4])
{
    const double along = precess_dot(sigma, omega);
    const double rest = 1.0 - precess_dot(sigma, sigma);
    double crossed[3];
    int k;

    crossed[0] = sigma[1] * omega[2] - sigma[2] * omega[1];
    crossed[1] = sigma[2] * omega[0] - sigma[0] * omega[2];
    crossed[2] = sigma[0] * omega[1] - sigma[1] * omega[0];
    for (k = 0; k < 3; k++) {
        out[k] = 0.25 * (rest * omega[k] + 2.0 * (crossed[k] + along * sigma[k]));
    }
    out[3] = 0.0;
}

void precess_attitude_rate(
    enum precess_parameterisation by,
    const double attitude[4],
    const double omega[3],
    double out[4])
{
    const double *const q = attitude;
    double x;
    double y;
    double z;

    if (by == PRECESS_MRP) {
        rate_of_mrp(attitude, omega, out);
        return;
    }
    x = 0.5 * omega[0];
    y = 0.5 * omega[1];
    z = 0.5 * omega[2];
    out[0] = -(q[1] * x + q[2] * y + q[3] * z);
    out[1] = q[0] * x - q[3] * y + q[2] * z;
    out[2] = q[3] * x + q[0] * y - q[1] * z;
    out[3] = q[1] * y - q[2] * x + q[0] * z;
}

void precess_attitude_regular(
    enum precess_parameterisation by, const double attitude[4], double out[4])
{
    if (by == PRECESS_MRP) {
        precess_attitude_normalised(by, attitude, out);
    } else {
        scaled(attitude, out);
    }
}

void precess_attitude_normalised(
    enum precess_parameterisation by, const double attitude[4], double out[4])
{
    double q[4];
    double scale;
    int k;

    if (by == PRECESS_MRP) {
        const double square = precess_dot(attitude, attitude);

        /* The shadow set beyond half a turn: the same attitude. */
        scale = -(1.0 / square);
        for (k = 0; k < 3; k++) {
            out[k] = square > 1.0 ? scale * attitude[k] : attitude[k];
        }
        out[3] = 0.0;
        return;
    }
    scaled(attitude, q);
    scale = 1.0 / precess_square_root(norm_squared(q));
    for (k = 0; k < 4; k++) {
        out[k] = scale * q[k];
    }
}

int precess_attitude_is_valid(enum precess_parameterisation by, const double attitude[4])
{
    double q[4];

    if (by == PRECESS_MRP) {
        return precess_is_finite(4.0 * precess_dot(attitude, attitude));
    }
    scaled(attitude, q);
    return precess_is_finite(norm_squared(q));
}
