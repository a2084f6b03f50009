/* Reads spacecraft and states as doubles, writes their accelerations: see main.rs of this suite.
 *
 * A structure of doubles has no gaps, so it is read at once. */

#include <stdio.h>

#include "evaluate.h"

static struct {
    double mass;
    double r_bc_b[3];
    double i_b_bc[6];
    struct precess_body_rate omega;
    double force[3];
    double torque_b[3];
} hub;

static struct {
    struct precess_dgvscmg_parameters parameters;
    double angles[3];
    struct precess_dgvscmg_rates rates;
    struct precess_dgvscmg_motors motors;
    struct precess_dgvscmg_modes modes;
} given;

int main(void)
{
    while (fread(&hub, sizeof hub, 1, stdin) == 1) {
        struct precess_body body;
        struct device devices[DEVICES];
        struct precess_body_acceleration hub_moves;
        struct precess_dgvscmg_joint_accelerations joints[DEVICES];
        int k;

        precess_body_of_hub(hub.mass, hub.r_bc_b, hub.i_b_bc, &body);
        for (k = 0; k < DEVICES; k++) {
            struct precess_dgvscmg_parameters *const p = &given.parameters;
            struct precess_constant_share constant_share;
            double mount[9];
            double along_b[3];
            double along_device[3];

            if (fread(&given, sizeof given, 1, stdin) != 1) {
                return 2;
            }
            mount[0] = p->mount_11;
            mount[1] = p->mount_12;
            mount[2] = p->mount_13;
            mount[3] = p->mount_21;
            mount[4] = p->mount_22;
            mount[5] = p->mount_23;
            mount[6] = p->mount_31;
            mount[7] = p->mount_32;
            mount[8] = p->mount_33;
            along_b[0] = p->r_go_b_bx;
            along_b[1] = p->r_go_b_by;
            along_b[2] = p->r_go_b_bz;
            precess_along_device(mount, along_b, along_device);
            p->r_go_b_bx = along_device[0];
            p->r_go_b_by = along_device[1];
            p->r_go_b_bz = along_device[2];
            precess_dgvscmg_prepare(p, &devices[k].constants);
            precess_dgvscmg_constant_share(&devices[k].constants, &constant_share);
            precess_body_add_constant_share(&body, &constant_share);
            devices[k].gamma_o = given.angles[0];
            devices[k].gamma_i = given.angles[1];
            devices[k].theta = given.angles[2];
            devices[k].rates = given.rates;
            devices[k].motors = given.motors;
            devices[k].modes = given.modes;
            /* These spacecraft have no joint without inertia in any pose. */
            devices[k].scale[0] = devices[k].scale[1] = devices[k].scale[2] = 0.0;
        }
        if (evaluate(&body, devices, &hub.omega, hub.force, hub.torque_b, &hub_moves, joints)
            != PRECESS_SOLVED) {
            return 3;
        }
        if (fwrite(&hub_moves, sizeof hub_moves, 1, stdout) != 1
            || fwrite(joints, sizeof joints, 1, stdout) != 1) {
            return 4;
        }
    }
    return 0;
}
