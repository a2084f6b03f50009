#ifndef MODEL_H
#define MODEL_H
#include "bus.h"
#define FMU_SOLVER_PARAMETERS bus_parameters
#define FMU_SOLVER_SPACECRAFT bus_spacecraft
#define FMU_SOLVER_STATE bus_state
#define FMU_SOLVER_INPUTS bus_inputs
#define FMU_SOLVER_ACCELERATIONS bus_accelerations
#define FMU_SOLVER_INIT bus_init
#define FMU_SOLVER_EVALUATE bus_accelerations
#define FMU_SOLVER_STEP bus_step
#define FMU_SOLVER_WRAP bus_wrap
#define FMU_DEVICES BUS_DEVICES
#define FMU_JOINTS BUS_JOINTS
#define FMU_DRIVEN 1
#define FMU_HUB PRECESS_HUB_FREE
#define FMU_FIELD PRECESS_CENTRAL_FIELD
#define FMU_TOKEN "{t}"
#endif
