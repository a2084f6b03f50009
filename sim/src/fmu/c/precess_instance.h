/* An instance of a unit and where it is in its life, without a version of FMI.
 *
 * A function that returns a text does what is asked and returns null, or does nothing and returns why. The instance may be
 * null, which is refused; that any other pointer is null is refused as well. Nothing is kept outside of an instance. */

#ifndef PRECESS_INSTANCE_H
#define PRECESS_INSTANCE_H

#include <stddef.h>

#include "precess_fmu.h"

/* Where an instance is in its life. */
enum precess_phase {
    PHASE_INSTANTIATED,
    PHASE_INITIALISING,
    PHASE_EVENT,
    PHASE_CONTINUOUS,
    PHASE_STEPPING,
    PHASE_TERMINATED
};

/* What is copied as the state of an instance. */
struct precess_saved {
    struct precess_fmu fmu;
    enum precess_phase phase;
};

struct precess_instance {
    struct precess_saved state;
    /* Whether the last step was discarded because a joint passed an end stop. */
    int is_stopped;
    /* Whether the importer integrates; else the unit takes steps. */
    int is_exchange;
    /* Whether in Model Exchange each state may be set as a variable, as FMI 3.0 has it; else all at once. */
    int sets_each_state;
    /* The last message that has a name in it. */
    char said[FMU_MESSAGE];
};

/* What both versions refer to a variable by. FMI 3.0 has uint32_t: where that is another type this does not compile. */
typedef unsigned int precess_reference;

#define IN(phase) (1u << (unsigned)(phase))
#define BEFORE (IN(PHASE_INSTANTIATED) | IN(PHASE_INITIALISING))
#define RUNNING (IN(PHASE_EVENT) | IN(PHASE_CONTINUOUS) | IN(PHASE_STEPPING))
#define ALL (BEFORE | RUNNING | IN(PHASE_TERMINATED))

/* Messages of more than one place. */
#define OUT_OF_ORDER "the function may not be called now; see the state machine of FMI"
#define IS_NULL "an argument is null"
#define IS_STOPPED FMU_END
#define NO_DIRECTIONAL "this unit has no directional derivatives"
#define NO_OUTPUT_DERIVATIVES "the derivatives of outputs are variables of their own"
#define NO_INDICATORS "there are no event indicators"

/* Messages of what a unit may not have. */
#define NO_EXCHANGE "this unit is for Co-Simulation alone"

/* Whether a text identifies these sources. */
int precess_instance_is_token(const char *token);

/* Fills what is all zero: values of the scenario, nothing initialised. */
void precess_instance_begin(struct precess_instance *of, int is_exchange, int sets_each_state);

/* Gives back what an instance holds but itself. */
void precess_instance_end(struct precess_instance *of);

/* As precess_instance_begin, of the same type of simulation. */
const char *precess_instance_reset(struct precess_instance *of);

/* Whether there is an instance, in one of these phases. */
int precess_instance_is_in(const struct precess_instance *of, unsigned phases);

/* Enters a phase from one of others. */
const char *precess_instance_enter(struct precess_instance *of, unsigned from, enum precess_phase to);

/* Sets the time at which a simulation starts, s; that at which it stops is checked where it has one. */
const char *precess_instance_set_start(
    struct precess_instance *of, double start, int has_stop, double stop);

/* Ends initialisation: what is set is checked. */
const char *precess_instance_initialise(struct precess_instance *of);

/* Variables by their places. All are set, or none. */
const char *precess_instance_get(
    struct precess_instance *of, const precess_reference vr[], size_t count, double value[]);
const char *precess_instance_set(
    struct precess_instance *of, const precess_reference vr[], size_t count, const double value[]);

/* Co-Simulation from a time over a duration, s. Where a joint passes an end stop it is the end, and no value is changed. */
const char *precess_instance_step(struct precess_instance *of, double point, double size, int *is_end);

/* An event, of which there is one: angles are wrapped. Whether states have changed. */
const char *precess_instance_event(struct precess_instance *of, int *is_changed);

/* After a step of the importer's integrator: whether there is an event, and whether a joint has passed an end stop. */
const char *precess_instance_completed(struct precess_instance *of, int *is_event, int *is_end);

/* Time and states of Model Exchange; derivatives are computed. */
const char *precess_instance_set_time(struct precess_instance *of, double time);
const char *precess_instance_set_states(struct precess_instance *of, const double x[], size_t count);
const char *precess_instance_states(struct precess_instance *of, double x[], size_t count);
const char *precess_instance_derivatives(struct precess_instance *of, double rates[], size_t count);
const char *precess_instance_nominals(struct precess_instance *of, double nominal[], size_t count);

/* Derivatives of outputs and of the derivatives of states by states and inputs: along the direction `seed` of the knowns;
 * and of the sum of the unknowns that `seed` weighs. */
const char *precess_instance_along(
    struct precess_instance *of,
    const precess_reference unknowns[],
    size_t unknown_count,
    const precess_reference knowns[],
    size_t known_count,
    const double seed[],
    double sensitivity[]);
const char *precess_instance_gradient(
    struct precess_instance *of,
    const precess_reference unknowns[],
    size_t unknown_count,
    const precess_reference knowns[],
    size_t known_count,
    const double seed[],
    double sensitivity[]);

/* The state of an instance: copied to one that is there or is made, restored, freed, and as bytes of this processor. */
const char *precess_instance_save(struct precess_instance *of, void **state);
const char *precess_instance_restore(struct precess_instance *of, const void *state);
const char *precess_instance_free_state(const struct precess_instance *of, void **state);
const char *precess_instance_size(const struct precess_instance *of, const void *state, size_t *size);
const char *precess_instance_write(
    const struct precess_instance *of, const void *state, void *bytes, size_t size);
const char *precess_instance_read(
    const struct precess_instance *of, const void *bytes, size_t size, void **state);

/* Null of PRECESS_OK, else why, with the name of the device whose parameters are refused. */
const char *precess_instance_why(struct precess_instance *of, enum precess_status status);

#endif
