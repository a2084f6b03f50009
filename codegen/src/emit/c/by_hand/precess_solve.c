/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand.
 *
 * Compile with -std=c99 -ffp-contract=off: see precess_hub.h.
 */

#include "precess_solve.h"

/* The same for compilers that know the standard's own word; GCC knows the option alone. */
#if defined(__clang__) || !defined(__GNUC__)
#pragma STDC FP_CONTRACT OFF
#endif

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* A symmetric tensor applied to a vector. */
static void times(const double m[6], const double v[3], double out[3])
{
    out[0] = m[0] * v[0] + m[1] * v[1] + m[2] * v[2];
    out[1] = m[1] * v[0] + m[3] * v[1] + m[4] * v[2];
    out[2] = m[2] * v[0] + m[4] * v[1] + m[5] * v[2];
}

void precess_assembly_start(
    const struct precess_body *body,
    const double force[3],
    const double torque_b[3],
    struct precess_assembly *out)
{
    int k;

    out->body = *body;
    out->constant[0] = body->inertia[0];
    out->constant[1] = body->inertia[3];
    out->constant[2] = body->inertia[5];
    for (k = 0; k < 3; k++) {
        out->force[k] = force[k];
        out->torque_b[k] = torque_b[k];
        out->h_v[k] = 0.0;
        out->h_w[k] = 0.0;
    }
    for (k = 0; k < 6; k++) {
        out->m_vv[k] = 0.0;
        out->m_ww[k] = 0.0;
    }
    for (k = 0; k < 9; k++) {
        out->m_vw[k] = 0.0;
    }
}

void precess_assembly_add(struct precess_assembly *assembly, const struct precess_hub_share *share)
{
    double *const first_moment = assembly->body.first_moment;
    double *const inertia = assembly->body.inertia;

    first_moment[0] += share->mr_moving_bx;
    first_moment[1] += share->mr_moving_by;
    first_moment[2] += share->mr_moving_bz;
    inertia[0] += share->i_moving_11;
    inertia[1] += share->i_moving_12;
    inertia[2] += share->i_moving_13;
    inertia[3] += share->i_moving_22;
    inertia[4] += share->i_moving_23;
    inertia[5] += share->i_moving_33;
    assembly->m_vv[0] += share->m_vv_11;
    assembly->m_vv[1] += share->m_vv_12;
    assembly->m_vv[2] += share->m_vv_13;
    assembly->m_vv[3] += share->m_vv_22;
    assembly->m_vv[4] += share->m_vv_23;
    assembly->m_vv[5] += share->m_vv_33;
    assembly->m_vw[0] += share->m_vw_11;
    assembly->m_vw[1] += share->m_vw_12;
    assembly->m_vw[2] += share->m_vw_13;
    assembly->m_vw[3] += share->m_vw_21;
    assembly->m_vw[4] += share->m_vw_22;
    assembly->m_vw[5] += share->m_vw_23;
    assembly->m_vw[6] += share->m_vw_31;
    assembly->m_vw[7] += share->m_vw_32;
    assembly->m_vw[8] += share->m_vw_33;
    assembly->m_ww[0] += share->m_ww_11;
    assembly->m_ww[1] += share->m_ww_12;
    assembly->m_ww[2] += share->m_ww_13;
    assembly->m_ww[3] += share->m_ww_22;
    assembly->m_ww[4] += share->m_ww_23;
    assembly->m_ww[5] += share->m_ww_33;
    assembly->h_v[0] += share->h_v_1;
    assembly->h_v[1] += share->h_v_2;
    assembly->h_v[2] += share->h_v_3;
    assembly->h_w[0] += share->h_w_1;
    assembly->h_w[1] += share->h_w_2;
    assembly->h_w[2] += share->h_w_3;
}

void precess_assembly_add_wrench(
    struct precess_assembly *assembly, const double force[3], const double moment[3])
{
    int k;

    for (k = 0; k < 3; k++) {
        assembly->force[k] += force[k];
        assembly->torque_b[k] += moment[k];
    }
}

int precess_pivot_is_sound(double pivot, double scale)
{
    return pivot > 64.0 * DBL_EPSILON * scale;
}

/* L D L^T of a symmetric block: L below its unit diagonal, D and its reciprocals. */
struct factors {
    double l_21;
    double l_31;
    double l_32;
    double pivots[3];
    double reciprocals[3];
};

static void factorise(const double a[6], struct factors *out)
{
    const double d_1 = a[0];
    const double r_1 = 1.0 / d_1;
    const double l_21 = a[1] * r_1;
    const double l_31 = a[2] * r_1;
    const double d_2 = a[3] - l_21 * a[1];
    const double r_2 = 1.0 / d_2;
    const double below = a[4] - l_31 * a[1];
    const double l_32 = below * r_2;
    const double d_3 = a[5] - l_31 * a[2] - l_32 * below;

    out->l_21 = l_21;
    out->l_31 = l_31;
    out->l_32 = l_32;
    out->pivots[0] = d_1;
    out->pivots[1] = d_2;
    out->pivots[2] = d_3;
    out->reciprocals[0] = r_1;
    out->reciprocals[1] = r_2;
    out->reciprocals[2] = 1.0 / d_3;
}

/* L^-1 b. */
static void forward(const struct factors *f, const double b[3], double out[3])
{
    out[0] = b[0];
    out[1] = b[1] - f->l_21 * b[0];
    out[2] = b[2] - f->l_31 * b[0] - f->l_32 * out[1];
}

/* D^-1 b. */
static void divide(const struct factors *f, const double b[3], double out[3])
{
    out[0] = b[0] * f->reciprocals[0];
    out[1] = b[1] * f->reciprocals[1];
    out[2] = b[2] * f->reciprocals[2];
}

/* L^-T b. */
static void backward(const struct factors *f, const double b[3], double out[3])
{
    out[2] = b[2];
    out[1] = b[1] - f->l_32 * b[2];
    out[0] = b[0] - f->l_21 * out[1] - f->l_31 * b[2];
}

/* M and h of M [r_b_n_ddot; omega_dot] = h; m_vw by its columns. */
struct system {
    double m_vv[6];
    double m_vw[3][3];
    double m_ww[6];
    double h_v[3];
    double h_w[3];
};

/* That of the rigid body, less the sums of what eliminated joints subtract. */
static void put_together(
    const struct precess_assembly *assembly, const double omega[3], struct system *out)
{
    const double m = assembly->body.mass;
    const double *const s = assembly->body.first_moment;
    const double *const taken = assembly->m_vw;
    double momentum[3];
    double turning[3];
    double centrifugal[3];
    double gyroscopic[3];
    int k;

    cross(omega, s, turning);
    cross(omega, turning, centrifugal);
    times(assembly->body.inertia, omega, momentum);
    cross(omega, momentum, gyroscopic);

    out->m_vv[0] = m - assembly->m_vv[0];
    out->m_vv[1] = 0.0 - assembly->m_vv[1];
    out->m_vv[2] = 0.0 - assembly->m_vv[2];
    out->m_vv[3] = m - assembly->m_vv[3];
    out->m_vv[4] = 0.0 - assembly->m_vv[4];
    out->m_vv[5] = m - assembly->m_vv[5];
    /* -tilde(m c). */
    out->m_vw[0][0] = 0.0 - taken[0];
    out->m_vw[0][1] = -s[2] - taken[3];
    out->m_vw[0][2] = s[1] - taken[6];
    out->m_vw[1][0] = s[2] - taken[1];
    out->m_vw[1][1] = 0.0 - taken[4];
    out->m_vw[1][2] = -s[0] - taken[7];
    out->m_vw[2][0] = -s[1] - taken[2];
    out->m_vw[2][1] = s[0] - taken[5];
    out->m_vw[2][2] = 0.0 - taken[8];
    for (k = 0; k < 6; k++) {
        out->m_ww[k] = assembly->body.inertia[k] - assembly->m_ww[k];
    }
    for (k = 0; k < 3; k++) {
        out->h_v[k] = assembly->force[k] - centrifugal[k] - assembly->h_v[k];
        out->h_w[k] = assembly->torque_b[k] - gyroscopic[k] - assembly->h_w[k];
    }
}

/* L^-T e_k, from factors of rows up to k only: what follows a pivot of zero is no number. */
static void column(const struct factors *f, int k, double out[3])
{
    out[0] = 1.0;
    out[1] = 0.0;
    out[2] = 0.0;
    if (k == 1) {
        out[0] = 0.0 - f->l_21;
        out[1] = 1.0;
    } else if (k == 2) {
        out[2] = 1.0;
        out[1] = 0.0 - f->l_32;
        out[0] = 0.0 - f->l_21 * out[1] - f->l_31;
    }
}

/* Scale of each pivot: magnitude of the terms of M that are summed in it. Pivot k is v . M v with
 * L^T v = e_k, so rounding of M_ii counts v_i^2 times; small pivots before it make v long. */
static void grow(
    double mass,
    const double moments[3],
    const struct factors *vv,
    const double z[3][3],
    const struct factors *ww,
    double out[6])
{
    int k;
    int j;

    for (k = 0; k < 3; k++) {
        double coupled[3];
        double v[3];
        double w[3];

        column(vv, k, v);
        out[k] = mass * (v[0] * v[0]) + mass * (v[1] * v[1]) + mass * (v[2] * v[2]);
        column(ww, k, w);
        for (j = 0; j < 3; j++) {
            coupled[j] = z[0][j] * w[0];
            coupled[j] = k > 0 ? coupled[j] + z[1][j] * w[1] : coupled[j];
            coupled[j] = k > 1 ? coupled[j] + z[2][j] * w[2] : coupled[j];
        }
        backward(vv, coupled, v);
        out[3 + k] = (mass * (v[0] * v[0]) + mass * (v[1] * v[1]) + mass * (v[2] * v[2]))
            + (moments[0] * (w[0] * w[0]) + moments[1] * (w[1] * w[1])
               + moments[2] * (w[2] * w[2]));
    }
}

static int is_finite(double x)
{
    return x - x == 0.0;
}

/* Factors of rows one to three, rows four to six of L by columns, those of the Schur complement. */
static void factorise_system(
    const struct system *system, struct factors *vv, double z[3][3], struct factors *ww)
{
    double w[3][3];
    double schur[6];
    int k;

    factorise(system->m_vv, vv);
    /* Rows four to six of L times D, and of L: w = L_vv^-1 M_vw, z = D_vv^-1 w. */
    for (k = 0; k < 3; k++) {
        forward(vv, system->m_vw[k], w[k]);
        divide(vv, w[k], z[k]);
    }
    schur[0] = system->m_ww[0] - dot(w[0], z[0]);
    schur[1] = system->m_ww[1] - dot(w[0], z[1]);
    schur[2] = system->m_ww[2] - dot(w[0], z[2]);
    schur[3] = system->m_ww[3] - dot(w[1], z[1]);
    schur[4] = system->m_ww[4] - dot(w[1], z[2]);
    schur[5] = system->m_ww[5] - dot(w[2], z[2]);
    factorise(schur, ww);
}

/* Moments of inertia of the spacecraft with every joint locked; the moving share may cancel nearly
 * all of the constant one, whose rounding stays: both count. */
static void moments_of(const struct precess_assembly *assembly, double out[3])
{
    const double *const locked = assembly->body.inertia;

    out[0] = assembly->constant[0] + locked[0];
    out[1] = assembly->constant[1] + locked[3];
    out[2] = assembly->constant[2] + locked[5];
}

void precess_assembly_pivots(
    const struct precess_assembly *assembly, double pivots[6], double scales[6])
{
    static const double STILL[3] = {0.0, 0.0, 0.0};
    struct system system;
    struct factors vv;
    struct factors ww;
    double z[3][3];
    int k;

    put_together(assembly, STILL, &system);
    factorise_system(&system, &vv, z, &ww);
    for (k = 0; k < 3; k++) {
        pivots[k] = vv.pivots[k];
        pivots[3 + k] = ww.pivots[k];
        scales[k] = assembly->body.mass;
    }
    moments_of(assembly, scales + 3);
}

enum precess_solved precess_assembly_solve(
    const struct precess_assembly *assembly,
    const struct precess_body_rate *omega,
    struct precess_body_acceleration *out)
{
    const double rate[3] = {omega->omega_bx, omega->omega_by, omega->omega_bz};
    struct system system;
    struct factors vv;
    struct factors ww;
    double z[3][3];
    double y_v[3];
    double y_w[3];
    double reduced[3];
    double divided[3];
    double omega_dot[3];
    double r_b_n_ddot[3];
    double moments[3];
    double pivots[6];
    double scales[6];
    int k;

    put_together(assembly, rate, &system);
    factorise_system(&system, &vv, z, &ww);

    forward(&vv, system.h_v, y_v);
    for (k = 0; k < 3; k++) {
        reduced[k] = system.h_w[k] - dot(z[k], y_v);
    }
    forward(&ww, reduced, y_w);
    divide(&ww, y_w, divided);
    backward(&ww, divided, omega_dot);
    divide(&vv, y_v, divided);
    for (k = 0; k < 3; k++) {
        reduced[k] = divided[k]
            - (z[0][k] * omega_dot[0] + z[1][k] * omega_dot[1] + z[2][k] * omega_dot[2]);
    }
    backward(&vv, reduced, r_b_n_ddot);

    moments_of(assembly, moments);
    grow(assembly->body.mass, moments, &vv, (const double(*)[3])z, &ww, scales);
    for (k = 0; k < 3; k++) {
        pivots[k] = vv.pivots[k];
        pivots[3 + k] = ww.pivots[k];
    }
    for (k = 0; k < 6; k++) {
        if (!precess_pivot_is_sound(pivots[k], scales[k])) {
            return is_finite(pivots[k]) && is_finite(scales[k]) ? PRECESS_SINGULAR
                                                                : PRECESS_NOT_FINITE;
        }
    }
    for (k = 0; k < 3; k++) {
        if (!is_finite(r_b_n_ddot[k]) || !is_finite(omega_dot[k])) {
            return PRECESS_NOT_FINITE;
        }
    }
    out->r_b_n_ddot_bx = r_b_n_ddot[0];
    out->r_b_n_ddot_by = r_b_n_ddot[1];
    out->r_b_n_ddot_bz = r_b_n_ddot[2];
    out->omega_dot_bx = omega_dot[0];
    out->omega_dot_by = omega_dot[1];
    out->omega_dot_bz = omega_dot[2];
    return PRECESS_SOLVED;
}
