#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "fmi2Functions.h"
#include "precess_fmu.h"
static int told;
static void say(fmi2ComponentEnvironment e, fmi2String n, fmi2Status s, fmi2String c, fmi2String f, ...) { (void)e;(void)n;(void)s;(void)c;(void)f; told++; }
int main(void) {
  fmi2CallbackFunctions cb = { say, calloc, free, NULL, NULL };
  fmi2Component m[100]; int k, bad = 0; fmi2Boolean a, b; fmi2Real x[64]; fmi2FMUstate st = NULL, st2 = NULL; fmi2Byte *bytes; size_t n = 0; fmi2EventInfo info;
  struct precess_fmu f; static struct bus_state s; static struct bus_inputs in; fmi2ValueReference v[15];
  for (k = 0; k < 15; k++) v[k] = (fmi2ValueReference)(1 + k);
  for (k = 0; k < 100; k++) { m[k] = fmi2Instantiate("x", fmi2CoSimulation, "{t}", NULL, &cb, 0, 0); bad += !m[k]; }
  bad += fmi2Instantiate("x", fmi2CoSimulation, "other", NULL, &cb, 0, 0) != NULL;
  bad += fmi2DoStep(m[0], 0, 0.01, 1) != fmi2Error; bad += fmi2ExitInitializationMode(m[0]) != fmi2Error;
  bad += fmi2DoStep(NULL, 0, 0.01, 1) != fmi2Error; bad += fmi2GetReal(m[0], NULL, 3, x) != fmi2Error;
  v[0] = 9999; bad += fmi2GetReal(m[0], v, 1, x) != fmi2Error; v[0] = 1;
  for (k = 0; k < 100; k++) { bad += fmi2SetupExperiment(m[k],0,0,0,0,0) || fmi2EnterInitializationMode(m[k]) || fmi2ExitInitializationMode(m[k]); }
  bad += fmi2EnterContinuousTimeMode(m[0]) != fmi2Error; bad += fmi2GetDerivatives(m[0], x, 15) != fmi2Error;
  for (k = 0; k < 100; k++) { int j; for (j = 0; j < 100; j++) bad += fmi2DoStep(m[k], 0.01 * j, 0.01, 1); }
  bad += fmi2DoStep(m[0], 7, 0.01, 1) != fmi2Error;
  fmi2GetReal(m[99], v, 15, x);
  precess_fmu_reset(&f); bad += precess_fmu_evaluate(&f) != PRECESS_OK;
  s.r_b_n[0] = 7e6; s.r_b_n_dot[1] = 7546; s.attitude[0] = 1; in.gravity.field = PRECESS_CENTRAL_FIELD; in.gravity.mu = 3.986004418e14; in.joints[0].torque = 0.01;
  for (k = 0; k < 100; k++) { bad += bus_step(&f.spacecraft, &s, &in, 0.01, &s) != PRECESS_OK; bus_wrap(&f.spacecraft, &s, &s); }
  printf("bits %s\n", !memcmp(x, s.r_b_n, 24) && !memcmp(x + 3, s.r_b_n_dot, 24) && !memcmp(x + 6, s.attitude, 32) && !memcmp(x + 10, s.omega, 24) && x[13] == s.coordinates[0] && x[14] == s.rates[0] ? "same" : "differ");
  bad += fmi2GetFMUstate(m[1], &st) || fmi2SerializedFMUstateSize(m[1], st, &n); bytes = malloc(n); bad += fmi2SerializeFMUstate(m[1], st, bytes, n) || fmi2DeSerializeFMUstate(m[1], bytes, n, &st2);
  { fmi2Real p[15], q[15]; fmi2DoStep(m[1], 1.0, 0.01, 1); fmi2GetReal(m[1], v, 15, p); bad += fmi2SetFMUstate(m[1], st2); fmi2DoStep(m[1], 1.0, 0.01, 1); fmi2GetReal(m[1], v, 15, q); printf("restored %s\n", memcmp(p, q, sizeof p) ? "differ" : "same"); }
  bytes[0]++; bad += fmi2DeSerializeFMUstate(m[1], bytes, n, &st2) != fmi2Error; free(bytes); fmi2FreeFMUstate(m[1], &st); fmi2FreeFMUstate(m[1], &st2);
  { fmi2Component c = fmi2Instantiate("y", fmi2ModelExchange, "{t}", NULL, &cb, 0, 0); bad += fmi2SetupExperiment(c,0,0,0,0,0) || fmi2EnterInitializationMode(c) || fmi2ExitInitializationMode(c) || fmi2NewDiscreteStates(c, &info) || fmi2EnterContinuousTimeMode(c) || fmi2GetContinuousStates(c, x, 15) || fmi2SetContinuousStates(c, x, 15) || fmi2GetDerivatives(c, x, 15) || fmi2CompletedIntegratorStep(c, 1, &a, &b); bad += fmi2DoStep(c,0,0.1,1) != fmi2Error; bad += memcmp(x, f.values + FMU_DERIVATIVE, 15 * 8) != 0; fmi2FreeInstance(c); }
  for (k = 0; k < 100; k++) fmi2FreeInstance(m[k]);
  fmi2FreeInstance(NULL);
  printf("unexpected %d, messages %d\n", bad, told); return bad; }
