/* What devices contribute to a hub, and their joints by the gains of the elimination. Included by abi.c. */

/* The equation of forces of a hub whose centre of mass is B, with what its devices contribute; and their joints. */
static void contributes(const precess_state *state, const precess_inputs *inputs, uint32_t joints)
{
    precess_contributions devices_of, eliminated;
    precess_joint_gains gains;
    precess_accelerations found, again;
    precess_inputs prescribed = *inputs;
    uint32_t joint;
    int row, column;
    IS(precess_accelerations_of(&craft, state, inputs, &found, 0), PRECESS_OK);
    IS(precess_contributions_of(&craft, state, inputs, &devices_of, 0), PRECESS_OK);
    for (row = 0; row < 3; row++) {
        double sum = hub.mass * found.linear[row] - devices_of.force[row];
        for (column = 0; column < 3; column++) {
            sum += devices_of.force_by_linear[3 * row + column] * found.linear[column];
            sum += devices_of.force_by_angular[3 * row + column] * found.angular[column];
        }
        NEAR(sum, 0.0, 1e-10);
    }
    for (row = 0; row < 3; row++) {
        prescribed.hub_linear[row] = found.linear[row];
        prescribed.hub_angular[row] = found.angular[row];
    }
    prescribed.hub_mode = PRECESS_HUB_PRESCRIBED;
    IS(precess_accelerations_of(&craft, state, &prescribed, &again, 0), PRECESS_OK);
    for (joint = 0; joint < joints; joint++) {
        NEAR(again.joint[0][joint], found.joint[0][joint], 1e-12);
    }
    IS(precess_eliminate(&craft, state, inputs, &eliminated, &gains, 0), PRECESS_OK);
    for (row = 0; row < 3; row++) {
        NEAR(eliminated.force[row], devices_of.force[row], 0.0);
        NEAR(eliminated.moment[row], devices_of.moment[row], 0.0);
    }
    IS(precess_joint_accelerations_of(&craft, &gains, found.linear, found.angular, &again, 0), PRECESS_OK);
    for (joint = 0; joint < joints; joint++) {
        NEAR(again.joint[0][joint], found.joint[0][joint], 1e-12);
    }
}
