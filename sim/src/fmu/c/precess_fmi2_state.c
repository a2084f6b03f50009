/* FMI 2.0 of precess_fmu.h: the state of an instance, copied and as bytes. Bytes are those of this processor. */

#include <stdlib.h>
#include <string.h>

#include "precess_fmi2.h"

/* What a serialised state starts with. */
static const char TOKEN[] = FMU_TOKEN;

#define NOT_OF_THIS_UNIT "the bytes are no state of this unit and type of simulation"

/* Whether an instance of this type can be in a phase. */
static int is_of_type(const struct precess_fmi2 *of, enum precess_fmi2_phase phase)
{
    return of->type == fmi2ModelExchange
        ? phase != PHASE_STEPPING
        : phase != PHASE_EVENT && phase != PHASE_CONTINUOUS;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    const struct precess_fmi2 *const of = c;

    if (!of || !state) {
        return precess_fmi2_refuse(of, IS_NULL);
    }
    if (!*state) {
        *state = malloc(sizeof of->state);
    }
    if (!*state) {
        return precess_fmi2_refuse(of, "no memory for a state");
    }
    memcpy(*state, &of->state, sizeof of->state);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    struct precess_fmi2 *const of = c;
    const struct precess_fmi2_state *const from = state;

    if (!of || !from) {
        return precess_fmi2_refuse(of, IS_NULL);
    }
    if (!is_of_type(of, from->phase)) {
        return precess_fmi2_refuse(of, "the state is of the other type of simulation");
    }
    of->state = *from;
    of->is_stopped = 0;
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    if (!c || !state) {
        return precess_fmi2_refuse(c, IS_NULL);
    }
    free(*state);
    *state = NULL;
    return fmi2OK;
}

/* Token, phase, numbers. */
#define SERIALISED (sizeof TOKEN + 1 + FMU_VALUES * sizeof(double))

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    if (!c || !state || !size) {
        return precess_fmi2_refuse(c, IS_NULL);
    }
    *size = SERIALISED;
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    const struct precess_fmi2_state *const from = state;

    if (!c || !from || !bytes || size < SERIALISED) {
        return precess_fmi2_refuse(c, "an argument is null, or the bytes are too few");
    }
    memcpy(bytes, TOKEN, sizeof TOKEN);
    bytes[sizeof TOKEN] = (fmi2Byte)from->phase;
    memcpy(bytes + sizeof TOKEN + 1, from->fmu.values, sizeof from->fmu.values);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(
    fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    const struct precess_fmi2 *const of = c;
    struct precess_fmi2_state *to;
    int phase;

    if (!of || !bytes || !state) {
        return precess_fmi2_refuse(of, IS_NULL);
    }
    if (size < SERIALISED || memcmp(bytes, TOKEN, sizeof TOKEN) != 0) {
        return precess_fmi2_refuse(of, NOT_OF_THIS_UNIT);
    }
    phase = bytes[sizeof TOKEN];
    if (phase < 0 || phase > (int)PHASE_TERMINATED
        || !is_of_type(of, (enum precess_fmi2_phase)phase)) {
        return precess_fmi2_refuse(of, NOT_OF_THIS_UNIT);
    }
    to = malloc(sizeof *to);
    if (!to) {
        return precess_fmi2_refuse(of, "no memory for a state");
    }
    memset(to, 0, sizeof *to);
    precess_fmu_reset(&to->fmu);
    to->phase = (enum precess_fmi2_phase)phase;
    memcpy(to->fmu.values, bytes + sizeof TOKEN + 1, sizeof to->fmu.values);
    if (!precess_are_finite(to->fmu.values, FMU_VALUES)) {
        free(to);
        return precess_fmi2_refuse(of, NOT_OF_THIS_UNIT);
    }
    if (*state) {
        memcpy(*state, to, sizeof *to);
        free(to);
    } else {
        *state = to;
    }
    return fmi2OK;
}
