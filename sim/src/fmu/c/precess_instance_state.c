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

/* Gives back a state. */
static void discard(struct precess_saved *state)
{
    precess_fmu_release(&state->fmu);
    free(state);
}

const char *precess_instance_save(struct precess_instance *of, void **state)
{
    struct precess_saved *to;
    const char *why;

    if (!of || !state) {
        return IS_NULL;
    }
    to = *state ? *state : calloc(1, sizeof *to);
    if (!to) {
        return NO_MEMORY;
    }
    why = precess_instance_why(of, precess_fmu_save(&of->state.fmu, &to->fmu));
    if (!why) {
        to->phase = of->state.phase;
        *state = to;
    } else if (!*state) {
        discard(to);
    }
    return why;
}

const char *precess_instance_restore(struct precess_instance *of, const void *state)
{
    const struct precess_saved *const from = state;
    const char *why;

    if (!of || !from) {
        return IS_NULL;
    }
    if (!is_of_type(of, from->phase)) {
        return "the state is of the other type of simulation";
    }
    why = precess_instance_why(of, precess_fmu_restore(&of->state.fmu, &from->fmu));
    if (!why) {
        of->state.phase = from->phase;
        of->is_stopped = 0;
    }
    return why;
}

const char *precess_instance_free_state(const struct precess_instance *of, void **state)
{
    if (!of || !state) {
        return IS_NULL;
    }
    if (*state) {
        discard(*state);
    }
    *state = NULL;
    return NULL;
}

/* Token, phase, numbers; then what there is beside them. */
#define SERIALISED (sizeof TOKEN + 1 + FMU_VALUES * sizeof(double))

/* How many bytes a state is. */
static size_t size_of(const struct precess_saved *state)
{
    return SERIALISED + precess_fmu_rest_size(&state->fmu);
}

const char *precess_instance_size(const struct precess_instance *of, const void *state, size_t *size)
{
    if (!of || !state || !size) {
        return IS_NULL;
    }
    *size = size_of(state);
    return NULL;
}

const char *precess_instance_write(
    const struct precess_instance *of, const void *state, void *bytes, size_t size)
{
    const struct precess_saved *const from = state;
    unsigned char *const to = bytes;

    if (!of || !from || !to || size < size_of(from)) {
        return "an argument is null, or the bytes are too few";
    }
    memcpy(to, TOKEN, sizeof TOKEN);
    to[sizeof TOKEN] = (unsigned char)from->phase;
    memcpy(to + sizeof TOKEN + 1, from->fmu.values, sizeof from->fmu.values);
    precess_fmu_write_rest(&from->fmu, to + SERIALISED);
    return NULL;
}

const char *precess_instance_read(
    const struct precess_instance *of, const void *bytes, size_t size, void **state)
{
    const unsigned char *const from = bytes;
    struct precess_saved *to;
    int phase;

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
    to = calloc(1, sizeof *to);
    if (!to) {
        return NO_MEMORY;
    }
    precess_fmu_reset(&to->fmu);
    to->phase = (enum precess_phase)phase;
    memcpy(to->fmu.values, from + sizeof TOKEN + 1, sizeof to->fmu.values);
    if (!precess_fmu_read_rest(&to->fmu, from + SERIALISED, size - SERIALISED)) {
        discard(to);
        return NOT_OF_THIS_UNIT;
    }
    if (*state) {
        precess_fmu_release(&((struct precess_saved *)*state)->fmu);
        memcpy(*state, to, sizeof *to);
        free(to);
    } else {
        *state = to;
    }
    return NULL;
}
