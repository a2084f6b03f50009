#include "precess_fmu.h"
const double precess_fmu_start[FMU_VALUES] = {
 0, 7e6,0,0, 0,7546,0, 1,0,0,0, 0,0,0, 0, 0,
 0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,
 0,0,0,0,0,0, 0.01,
 0.01, 0,0,0, 3.986004418e14,
 120, 0,0,0, 14,0,0,16,0,11,
 1,0,0,0,1,0,0,0,1,
 2.6, 0.3,0,0, 0,3e-7,0, 0.0069,2e-8,-1.5e-8,0.0041,0,0.0041, 0,0,1e-5,0,0 };
const enum precess_mode precess_fmu_modes[FMU_JOINTS] = { PRECESS_DRIVEN };
const int precess_fmu_inputs[FMU_JOINTS] = { 0 };
