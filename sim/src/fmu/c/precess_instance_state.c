/* The state of an instance, copied and as bytes. Bytes are those of this processor. */

#include <stdlib.h>
#include <string.h>

#include "precess_instance.h"

/* What a serialised state starts with. */
static const char TOKEN[] = FMU_TOKEN;

#define NOT_OF_THIS_UNIT "the bytes are no state of this unit and type of simulation"
#define NO_MEMORY "no memory for a state"

/* Whether an instance of this type can be in a phase. */
static int is_of_type(const struct precess_instance *of, enum precess_phase phase)
{
    return of->is_exchange ? phase != PHASE_STEPPING
                           : phase != PHASE_EVENT && phase != PHASE_CONTINUOUS;
}

const char *precess_instance_save(const struct precess_instance *of, void **state)
{
    if (!FMU_SAVES) {
        return NO_STATES;
    }
    if (!of || !state) {
        return IS_NULL;
    }
    if (!*state) {
        *state = malloc(sizeof of->state);
    }
    if (!*state) {
        return NO_MEMORY;
    }
    memcpy(*state, &of->state, sizeof of->state);
    return NULL;
}

const char *precess_instance_restore(struct precess_instance *of, const void *state)
{
    const struct precess_saved *const from = state;

    if (!FMU_SAVES) {
        return NO_STATES;
    }
    if (!of || !from) {
        return IS_NULL;
    }
    if (!is_of_type(of, from->phase)) {
        return "the state is of the other type of simulation";
    }
    of->state = *from;
    of->is_stopped = 0;
    return NULL;
}

const char *precess_instance_free_state(const struct precess_instance *of, void **state)
{
    if (!of || !state) {
        return IS_NULL;
    }
    free(*state);
    *state = NULL;
    return NULL;
}

/* Token, phase, numbers. */
#define SERIALISED (sizeof TOKEN + 1 + FMU_VALUES * sizeof(double))

const char *precess_instance_size(const struct precess_instance *of, const void *state, size_t *size)
{
    if (!FMU_SAVES) {
        return NO_STATES;
    }
    if (!of || !state || !size) {
        return IS_NULL;
    }
    *size = SERIALISED;
    return NULL;
}

const char *precess_instance_write(
    const struct precess_instance *of, const void *state, void *bytes, size_t size)
{
    const struct precess_saved *const from = state;
    unsigned char *const to = bytes;

    if (!FMU_SAVES) {
        return NO_STATES;
    }
    if (!of || !from || !to || size < SERIALISED) {
        return "an argument is null, or the bytes are too few";
    }
    memcpy(to, TOKEN, sizeof TOKEN);
    to[sizeof TOKEN] = (unsigned char)from->phase;
    memcpy(to + sizeof TOKEN + 1, from->fmu.values, sizeof from->fmu.values);
    return NULL;
}

const char *precess_instance_read(
    const struct precess_instance *of, const void *bytes, size_t size, void **state)
{
    const unsigned char *const from = bytes;
    struct precess_saved *to;
    int phase;

    if (!FMU_SAVES) {
        return NO_STATES;
    }
    if (!of || !from || !state) {
        return IS_NULL;
    }
    if (size < SERIALISED || memcmp(from, TOKEN, sizeof TOKEN) != 0) {
        return NOT_OF_THIS_UNIT;
    }
    phase = from[sizeof TOKEN];
    if (phase > (int)PHASE_TERMINATED || !is_of_type(of, (enum precess_phase)phase)) {
        return NOT_OF_THIS_UNIT;
    }
    to = malloc(sizeof *to);
    if (!to) {
        return NO_MEMORY;
    }
    memset(to, 0, sizeof *to);
    precess_fmu_reset(&to->fmu);
    to->phase = (enum precess_phase)phase;
    memcpy(to->fmu.values, from + sizeof TOKEN + 1, sizeof to->fmu.values);
    if (!precess_are_finite(to->fmu.values, FMU_VALUES)) {
        free(to);
        return NOT_OF_THIS_UNIT;
    }
    if (*state) {
        memcpy(*state, to, sizeof *to);
        free(to);
    } else {
        *state = to;
    }
    return NULL;
}
