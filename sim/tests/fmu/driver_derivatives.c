/* Derivatives of an instance, of no version of FMI: writes what the derivatives of the states change by along each state, then
 * along each input, as doubles. Those of weighed sums are the same numbers. What was not as expected goes to standard error,
 * and how often is the exit status. */

#include <math.h>
#include <stdio.h>

#include "precess_instance.h"

#define KNOWNS (FMU_STATES + FMU_INPUTS)

static int unexpected;

#define CHECK(is_well)                               \
    do {                                             \
        if (!(is_well)) {                            \
            fprintf(stderr, "line %d\n", __LINE__); \
            unexpected++;                            \
        }                                            \
    } while (0)

static precess_reference knowns[KNOWNS];
static precess_reference unknowns[FMU_STATES];
static double columns[KNOWNS][FMU_STATES];

/* What is refused, and what is zero. */
static void others(struct precess_instance *of)
{
    const precess_reference known = FMU_STATE;
    const precess_reference parameter = FMU_PARAMETER;
    const precess_reference beyond = FMU_VALUES;
    const precess_reference time = 0;
    const precess_reference both[2] = { FMU_STATE, FMU_DERIVATIVE };
    const precess_reference motor = FMU_INPUT + 6;
    const precess_reference rate = FMU_DERIVATIVE + 13 + FMU_JOINTS;
    const double one = 1.0;
    const double infinite = INFINITY;
    double found[2] = { 7.0, 7.0 };

    CHECK(precess_instance_along(NULL, both, 2, &known, 1, &one, found));
    CHECK(precess_instance_along(of, NULL, 2, &known, 1, &one, found));
    CHECK(precess_instance_along(of, both, 2, NULL, 1, &one, found));
    CHECK(precess_instance_along(of, both, 2, &known, 1, NULL, found));
    CHECK(precess_instance_along(of, both, 2, &known, 1, &one, NULL));
    CHECK(precess_instance_along(of, both, 2, &known, 1, &infinite, found));
    CHECK(precess_instance_along(of, both, 2, &parameter, 1, &one, found));
    CHECK(precess_instance_along(of, both, 2, &beyond, 1, &one, found));
    CHECK(precess_instance_along(of, both, 2, &both[1], 1, &one, found));
    CHECK(precess_instance_along(of, &parameter, 1, &known, 1, &one, found));
    CHECK(precess_instance_along(of, &time, 1, &known, 1, &one, found));
    CHECK(precess_instance_gradient(of, both, 2, &known, 1, NULL, found));
    CHECK(precess_instance_gradient(of, both, 2, &known, 1, &one, NULL));
    CHECK(precess_instance_gradient(of, both, 2, &parameter, 1, &one, found));
    CHECK(found[0] == 7.0 && found[1] == 7.0);
    /* An output is a state: it changes by itself; nothing changes with time alone. */
    CHECK(!precess_instance_along(of, both, 2, &known, 1, &one, found));
    CHECK(found[0] == 1.0 && found[1] == 0.0);
    CHECK(!precess_instance_along(of, both, 2, &time, 1, &one, found));
    CHECK(found[0] == 0.0 && found[1] == 0.0);
    /* Beyond the limit of a motor nothing more is exerted. */
    CHECK(!precess_instance_along(of, &rate, 1, &motor, 1, &one, found));
    CHECK(found[0] != 0.0);
    of->state.fmu.values[motor] = 2.0 * precess_fmu_joints[0].limit;
    CHECK(!precess_instance_along(of, &rate, 1, &motor, 1, &one, found));
    CHECK(found[0] == 0.0);
    of->state.fmu.values[motor] = precess_fmu_start[motor];
    CHECK(!precess_instance_along(of, NULL, 0, NULL, 0, NULL, NULL));
    CHECK(!precess_instance_gradient(of, NULL, 0, NULL, 0, NULL, NULL));
}

int main(void)
{
    static struct precess_instance instance;
    struct precess_instance *const of = &instance;
    const double one = 1.0;
    int j, k;

    precess_instance_begin(of, 1, 0);
    CHECK(precess_instance_along(of, NULL, 0, NULL, 0, NULL, NULL));
    CHECK(!precess_instance_enter(of, IN(PHASE_INSTANTIATED), PHASE_INITIALISING));
    CHECK(!precess_instance_initialise(of));
    CHECK(!precess_instance_enter(of, IN(PHASE_EVENT), PHASE_CONTINUOUS));
    others(of);
    for (k = 0; k < FMU_STATES; k++) {
        unknowns[k] = (precess_reference)(FMU_DERIVATIVE + k);
    }
    for (k = 0; k < KNOWNS; k++) {
        knowns[k] = (precess_reference)(k < FMU_STATES ? FMU_STATE + k : FMU_INPUT + (k - FMU_STATES));
        CHECK(!precess_instance_along(of, unknowns, FMU_STATES, &knowns[k], 1, &one, columns[k]));
    }
    for (j = 0; j < FMU_STATES; j++) {
        double row[KNOWNS];

        CHECK(!precess_instance_gradient(of, &unknowns[j], 1, knowns, KNOWNS, &one, row));
        for (k = 0; k < KNOWNS; k++) {
            CHECK(row[k] == columns[k][j]);
        }
    }
    CHECK(fwrite(columns, sizeof columns[0], KNOWNS, stdout) == KNOWNS);
    precess_instance_end(of);
    return unexpected > 100 ? 100 : unexpected;
}
