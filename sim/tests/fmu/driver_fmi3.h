/* What the parts of the importer of FMI 3.0 share. */

#ifndef DRIVER_FMI3_H
#define DRIVER_FMI3_H

#include "fmi3Functions.h"
#include "precess_fmu.h"

#define STEP 1e-3

/* How many messages there were. */
extern int messages;

/* Counts what is not as expected, and writes where. */
void check(int line, int is_well);

#define CHECK(is_well) check(__LINE__, is_well)
#define IS_ERROR(call) CHECK((call) == fmi3Error)
#define IS_OK(call) CHECK((call) == fmi3OK)

/* The logger. */
void say(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message);

/* Instances of Co-Simulation, and one of Model Exchange. */
fmi3Instance of_token(fmi3String name, fmi3String token, fmi3LogMessageCallback log);
fmi3Instance stepping_one(void);
fmi3Instance exchanged_one(void);

/* Begins initialisation at 0 s, and begins and ends it. */
fmi3Status start(fmi3Instance c);
void initialise(fmi3Instance c);

/* A step of which only the status is asked. */
fmi3Status step(fmi3Instance c, double point, double size);

/* A variable by its place. */
fmi3Status set(fmi3Instance c, int place, double value);
double get(fmi3Instance c, int place);

/* What is refused before the end of initialisation, and what this unit does not have. */
void before_initialisation(void);
void absent(void);

#endif
