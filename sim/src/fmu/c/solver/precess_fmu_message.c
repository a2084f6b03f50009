/* What a status of the solver means, and what to do. */

#include "precess_fmu.h"

/* Most bytes of the name of a device in a message. */
#define FMU_NAME 256

static const char *text_of(enum precess_status status)
{
    switch (status) {
    case PRECESS_OK: return "well";
    case PRECESS_BAD_PARAMETER:
        return "a parameter of hub or device is none that its kind can have; check masses, inertias and mounts";
    case PRECESS_BAD_INPUT:
        return "a state, an input or the step is infinite, NaN, or no step; check what is set";
    case PRECESS_BAD_ANGLE:
        return "an angle is beyond 2^24 rad; take whole turns from it";
    case PRECESS_NO_INERTIA:
        return "a driven joint, or the hub, has no inertia; check masses and inertias";
    case PRECESS_OVERFLOWS:
        return "a result overflows; check rates, inputs and the step";
    case PRECESS_LOCKED_MOVES:
        return "a locked joint has a rate; set it to zero";
    case PRECESS_FIXED_MOVES:
        return "the fixed hub has a velocity; set it to zero";
    case PRECESS_NOT_DRIVEN:
        return "a joint without a motor is driven";
    case PRECESS_AT_CENTRE:
        return "the spacecraft is at the centre of the central body";
    case PRECESS_UNSTABLE:
        return "the step is too long for a spring, a damper or friction; make the parameter step smaller";
    }
    return "unknown status";
}

/* Copies at most `room` characters of a text and a zero; where the zero is. */
static char *append(char *to, const char *text, int room)
{
    int k;

    for (k = 0; k < room && text[k]; k++) {
        to[k] = text[k];
    }
    to[k] = '\0';
    return to + k;
}

const char *precess_fmu_message(
    const struct precess_fmu *fmu, enum precess_status status, char said[FMU_MESSAGE])
{
    const char *const text = text_of(status);
    char *to;

    if (status != PRECESS_BAD_PARAMETER) {
        return text;
    }
    to = append(said, precess_fmu_names[fmu->device], FMU_NAME);
    to = append(to, ": ", 2);
    (void)append(to, text, FMU_MESSAGE - FMU_NAME - 3);
    return said;
}
