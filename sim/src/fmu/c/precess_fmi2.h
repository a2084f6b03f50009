/* What the faces of precess_fmi2 share: an instance of FMI 2.0, and where it is in its life. */

#ifndef PRECESS_FMI2_H
#define PRECESS_FMI2_H

#include "fmi2Functions.h"

#include "precess_fmu.h"

/* Where an instance is in its life. */
enum precess_fmi2_phase {
    PHASE_INSTANTIATED,
    PHASE_INITIALISING,
    PHASE_EVENT,
    PHASE_CONTINUOUS,
    PHASE_STEPPING,
    PHASE_TERMINATED
};

/* What is copied as the state of an instance. */
struct precess_fmi2_state {
    struct precess_fmu fmu;
    enum precess_fmi2_phase phase;
};

struct precess_fmi2 {
    struct precess_fmi2_state state;
    /* Whether the last step was discarded because a joint passed an end stop. */
    int is_stopped;
    fmi2Type type;
    fmi2CallbackLogger log;
    fmi2ComponentEnvironment environment;
    char *name;
};

#define IN(phase) (1u << (unsigned)(phase))
#define BEFORE (IN(PHASE_INSTANTIATED) | IN(PHASE_INITIALISING))
#define RUNNING (IN(PHASE_EVENT) | IN(PHASE_CONTINUOUS) | IN(PHASE_STEPPING))
#define ALL (BEFORE | RUNNING | IN(PHASE_TERMINATED))
#define OUT_OF_ORDER "the function may not be called now; see the state machine of FMI 2.0"
#define IS_NULL "an argument is null"
#define IS_STOPPED "a joint is beyond an end stop; the scenario ends there"

/* Writes a message and returns an error. */
fmi2Status precess_fmi2_refuse(const struct precess_fmi2 *of, const char *text);

/* fmi2OK of PRECESS_OK, else a message and an error. */
fmi2Status precess_fmi2_status(const struct precess_fmi2 *of, enum precess_status status);

/* Whether there is an instance, in one of these phases. */
int precess_fmi2_is_in(const struct precess_fmi2 *of, unsigned phases);

/* Enters a phase from one of others. */
fmi2Status precess_fmi2_enter(fmi2Component c, unsigned from, enum precess_fmi2_phase to);

#endif
