/* What the faces of precess_fmi2 share: an instance of FMI 2.0. */

#ifndef PRECESS_FMI2_H
#define PRECESS_FMI2_H

#include "fmi2Functions.h"

#include "precess_instance.h"

struct precess_fmi2 {
    /* First: a pointer to this is one to the instance. */
    struct precess_instance instance;
    fmi2CallbackLogger log;
    fmi2ComponentEnvironment environment;
    char *name;
};

/* fmi2OK of null, else writes the message and returns an error. */
fmi2Status precess_fmi2_answer(fmi2Component c, const char *why);

#endif
