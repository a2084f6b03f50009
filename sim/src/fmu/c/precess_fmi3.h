/* What the faces of precess_fmi3 share: an instance of FMI 3.0. */

#ifndef PRECESS_FMI3_H
#define PRECESS_FMI3_H

#include "fmi3Functions.h"

#include "precess_instance.h"

struct precess_fmi3 {
    /* First: a pointer to this is one to the instance. */
    struct precess_instance instance;
    /* Whether messages are written. */
    int logs;
    /* Whether a step may say that it has ended early. */
    int may_return_early;
    fmi3LogMessageCallback log;
    fmi3InstanceEnvironment environment;
};

/* The one category of messages. */
#define CATEGORY "logStatusError"

/* fmi3OK of null, else writes the message and returns an error. */
fmi3Status precess_fmi3_answer(fmi3Instance instance, const char *why);

/* Writes, where there is an instance, that a joint is beyond an end stop. */
void precess_fmi3_end(fmi3Instance instance);

#endif
