/* Derivatives along a direction of states and inputs. Compile with -std=c99 -ffp-contract=off. */

#include "precess_fmu_solver.h"

/* Adds the cross product of two vectors. */
static void add_cross(const double a[3], const double b[3], double to[3])
{
    to[0] = to[0] + (a[1] * b[2] - a[2] * b[1]);
    to[1] = to[1] + (a[2] * b[0] - a[0] * b[2]);
    to[2] = to[2] + (a[0] * b[1] - a[1] * b[0]);
}

/* The small rotation, about the axes of B, of a direction of a quaternion; its length turns nothing. */
static void rotation_of(const double q[4], const double by[4], double rotation[3])
{
    const double two = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    double crossed[3] = { 0.0, 0.0, 0.0 };
    int k;

    add_cross(q + 1, by + 1, crossed);
    for (k = 0; k < 3; k++) {
        rotation[k] = two * (q[0] * by[1 + k] - by[0] * q[1 + k] - crossed[k]);
    }
}

/* The direction of wrenches, of which `from` and `by` have force and moment of each, and the direction of them. */
static void add_wrenches(
    const double *from,
    const double *by,
    const struct precess_matrix *bn,
    struct FMU_SOLVER_DIRECTION *direction)
{
    int k;

    for (k = 0; k < FMU_WRENCHES; k++, from += 6, by += 6) {
        const struct precess_fmu_wrench *const wrench = &precess_fmu_wrenches[k];
        double force[3];
        double moment[3];
        int axis;

        (void)precess_fmu_copy(by, 3, force);
        (void)precess_fmu_copy(by + 3, 3, moment);
        if (wrench->inertial) {
            double turned[3];

            precess_rotate(bn, by, force);
            precess_rotate(bn, by + 3, moment);
            precess_rotate(bn, from, turned);
            add_cross(turned, direction->hub.rotation, force);
            precess_rotate(bn, from + 3, turned);
            add_cross(turned, direction->hub.rotation, moment);
        }
        add_cross(wrench->point, force, moment);
        for (axis = 0; axis < 3; axis++) {
            if (wrench->joint == FMU_JOINTS) {
                direction->hub.force[axis] += force[axis];
                direction->hub.torque_b[axis] += moment[axis];
            } else {
                direction->joints[wrench->joint].wrench.force[axis] += force[axis];
                direction->joints[wrench->joint].wrench.moment[axis] += moment[axis];
            }
        }
    }
}

/* The direction that the solver takes, from that of states and inputs; of the state only what may move. */
static void direction_of(
    const struct precess_fmu *fmu,
    const struct FMU_SOLVER_STATE *state,
    const struct FMU_SOLVER_STATE *of_state,
    const double *of_inputs,
    const struct precess_matrix *bn,
    struct FMU_SOLVER_DIRECTION *direction)
{
    static const struct FMU_SOLVER_DIRECTION NONE;
    const double *const inputs = fmu->values + FMU_INPUT;
    const enum precess_hub_freedom freedom = FMU_HUB;
    int k;

    *direction = NONE;
    (void)precess_fmu_copy(of_state->r_b_n, 3, direction->hub.r_b_n);
    (void)precess_fmu_copy(of_state->omega, 3, direction->hub.omega);
    rotation_of(state->attitude, of_state->attitude, direction->hub.rotation);
    if (freedom == PRECESS_HUB_PRESCRIBED) {
        (void)precess_fmu_copy(of_inputs, 3, direction->hub.r_b_n_ddot);
        (void)precess_fmu_copy(of_inputs + 3, 3, direction->hub.omega_dot);
    } else {
        (void)precess_fmu_copy(of_inputs, 3, direction->hub.force);
        (void)precess_fmu_copy(of_inputs + 3, 3, direction->hub.torque_b);
    }
    for (k = 0; k < FMU_JOINTS; k++) {
        const struct precess_fmu_joint *const joint = &precess_fmu_joints[k];
        struct precess_joint_direction *const to = &direction->joints[k];
        /* Beyond the limit of a motor nothing more is given. */
        const int is_given = joint->input >= 0
            && !(joint->mode == PRECESS_DRIVEN
                 && precess_magnitude(inputs[6 + joint->input]) > joint->limit);

        to->coordinate = of_state->coordinates[k];
        to->rate = of_state->rates[k];
        to->given = is_given ? of_inputs[6 + joint->input] : 0.0;
    }
    if (FMU_WRENCHES > 0) {
        add_wrenches(inputs + 6 + FMU_DRIVEN, of_inputs + 6 + FMU_DRIVEN, bn, direction);
    }
}

enum precess_status precess_fmu_jvp(struct precess_fmu *fmu, const double *direction, double *along)
{
    struct FMU_SOLVER_STATE state;
    struct FMU_SOLVER_STATE of_state;
    struct FMU_SOLVER_INPUTS inputs;
    struct FMU_SOLVER_DIRECTION given;
    struct FMU_SOLVER_ACCELERATIONS found;
    struct FMU_SOLVER_ACCELERATIONS by;
    struct precess_matrix bn;
    double rate[4];
    double turned[3];
    enum precess_status status = precess_fmu_prepare(fmu);
    int k;

    if (status != PRECESS_OK) {
        return status;
    }
    precess_fmu_state_of(fmu, &state);
    precess_fmu_hold(&state);
    precess_fmu_inputs_of(fmu, &state, &inputs);
    precess_attitude_dcm(PRECESS_QUATERNION, state.attitude, &bn);
    precess_fmu_state_at(direction + FMU_STATE, &of_state);
    precess_fmu_hold(&of_state);
    direction_of(fmu, &state, &of_state, direction + FMU_INPUT, &bn, &given);
    status = FMU_SOLVER_JVP(&fmu->spacecraft, &state, &inputs, &given, &found, &by);
    if (status != PRECESS_OK) {
        return status;
    }
    (void)precess_fmu_copy(of_state.r_b_n_dot, 3, along);
    (void)precess_fmu_copy(by.r_b_n_ddot, 3, turned);
    add_cross(given.hub.rotation, found.r_b_n_ddot, turned);
    precess_rotate_transposed(&bn, turned, along + 3);
    precess_attitude_rate(PRECESS_QUATERNION, of_state.attitude, state.omega, along + 6);
    precess_attitude_rate(PRECESS_QUATERNION, state.attitude, of_state.omega, rate);
    for (k = 0; k < 4; k++) {
        along[6 + k] = along[6 + k] + rate[k];
    }
    (void)precess_fmu_copy(by.omega_dot, 3, along + 10);
    (void)precess_fmu_copy(of_state.rates, FMU_JOINTS, along + 13);
    (void)precess_fmu_copy(by.joints, FMU_JOINTS, along + 13 + FMU_JOINTS);
    return precess_are_finite(along, FMU_STATES) ? PRECESS_OK : PRECESS_OVERFLOWS;
}
