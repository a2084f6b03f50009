/* What a unit of FMI 3.0 refuses: calls before the end of initialisation, and what it does not have. */

#include <math.h>

#include "driver_fmi3.h"

/* Of instances that are none, and of one that is not yet initialised. */
void before_initialisation(void)
{
    fmi3Instance c = stepping_one();
    const fmi3ValueReference none = FMU_VALUES;
    const fmi3String categories[2] = { "logStatusError", "logAll" };
    double value = 0.0;
    int said;

    CHECK(c != NULL);
    CHECK(!of_token("unit", "other", say));
    CHECK(!of_token("unit", "other", NULL));
    CHECK(!of_token(NULL, FMU_TOKEN, say));
    CHECK(!of_token("unit", NULL, say));
    CHECK(!fmi3InstantiateModelExchange("unit", "other", NULL, 0, 0, &messages, say));
    /* No events, and no intermediate variables, in Co-Simulation; no Scheduled Execution: with a message. */
    said = messages;
    CHECK(!fmi3InstantiateCoSimulation("unit", FMU_TOKEN, NULL, 0, 0, 1, 0, NULL, 0, &messages, say, NULL));
    CHECK(!fmi3InstantiateCoSimulation("unit", FMU_TOKEN, NULL, 0, 0, 0, 0, &none, 1, &messages, say, NULL));
    CHECK(!fmi3InstantiateScheduledExecution("unit", FMU_TOKEN, NULL, 0, 0, &messages, say, NULL, NULL, NULL));
    CHECK(messages == said + 3);
    fmi3FreeInstance(NULL);
    IS_ERROR(step(NULL, 0.0, STEP));
    IS_ERROR(fmi3Reset(NULL));
    IS_ERROR(fmi3Terminate(NULL));
    IS_ERROR(fmi3GetFloat64(NULL, &none, 1, &value, 1));
    IS_ERROR(start(NULL));
    IS_ERROR(fmi3SetDebugLogging(NULL, fmi3True, 0, NULL));
    IS_ERROR(fmi3SetDebugLogging(c, fmi3True, 1, NULL));
    IS_ERROR(fmi3SetDebugLogging(c, fmi3True, 2, categories));
    /* Silent until it is asked to write messages. */
    IS_OK(fmi3SetDebugLogging(c, fmi3False, 0, NULL));
    said = messages;
    IS_ERROR(step(c, 0.0, STEP));
    CHECK(messages == said);
    IS_OK(fmi3SetDebugLogging(c, fmi3True, 1, categories));
    IS_ERROR(fmi3ExitInitializationMode(c));
    CHECK(messages == said + 1);
    IS_ERROR(fmi3Terminate(c));
    IS_ERROR(fmi3EnterInitializationMode(c, 0, 0.0, NAN, 0, 0.0));
    IS_ERROR(fmi3EnterInitializationMode(c, 0, 0.0, 1.0, 1, 0.0));
    IS_ERROR(fmi3GetFloat64(c, NULL, 1, &value, 1));
    IS_ERROR(fmi3GetFloat64(c, &none, 1, &value, 1));
    IS_ERROR(fmi3SetFloat64(c, &none, 1, &value, 1));
    IS_ERROR(set(c, FMU_STATE, INFINITY));
    IS_ERROR(set(c, 0, 1.0));
    IS_ERROR(set(c, FMU_DERIVATIVE, 1.0));
    /* Beyond an end stop, and a massless hub: named, and well again afterwards. */
    IS_OK(start(c));
    IS_ERROR(start(c));
    IS_OK(set(c, FMU_STATE + 14, 3.0));
    IS_ERROR(fmi3ExitInitializationMode(c));
    IS_OK(set(c, FMU_STATE + 14, 0.0));
    IS_OK(set(c, FMU_PARAMETER + 5, -1.0));
    IS_ERROR(fmi3ExitInitializationMode(c));
    IS_OK(set(c, FMU_PARAMETER + 5, 90.0));
    IS_OK(fmi3ExitInitializationMode(c));
    fmi3FreeInstance(c);
}

/* What this unit does not have is refused, with a message, and nothing is written. */
void absent(void)
{
    const fmi3ValueReference one = 1;
    fmi3Instance c = stepping_one();
    fmi3Float32 float32 = 0.0f;
    fmi3UInt64 counter = 0;
    size_t size = 7;
    const int said = messages;

    initialise(c);
    IS_OK(fmi3GetFloat32(c, NULL, 0, NULL, 0));
    IS_OK(fmi3SetClock(c, NULL, 0, NULL));
    IS_ERROR(fmi3GetFloat64(c, &one, 1, NULL, 0));
    IS_ERROR(fmi3GetFloat32(c, &one, 1, &float32, 1));
    IS_ERROR(fmi3SetInt8(c, &one, 1, NULL, 1));
    IS_ERROR(fmi3GetUInt64(c, &one, 1, &counter, 1));
    IS_ERROR(fmi3GetBoolean(c, &one, 1, NULL, 1));
    IS_ERROR(fmi3SetString(c, &one, 1, NULL, 1));
    IS_ERROR(fmi3GetBinary(c, &one, 1, &size, NULL, 1));
    IS_ERROR(fmi3SetBinary(c, &one, 1, &size, NULL, 1));
    IS_ERROR(fmi3GetClock(c, &one, 1, NULL));
    IS_ERROR(fmi3GetIntervalDecimal(c, &one, 1, NULL, NULL));
    IS_ERROR(fmi3GetIntervalFraction(c, &one, 1, &counter, &counter, NULL));
    IS_ERROR(fmi3GetShiftDecimal(c, &one, 1, NULL));
    IS_ERROR(fmi3GetShiftFraction(c, &one, 1, &counter, &counter));
    IS_ERROR(fmi3SetIntervalDecimal(c, &one, 1, NULL));
    IS_ERROR(fmi3SetIntervalFraction(c, &one, 1, &counter, &counter));
    IS_ERROR(fmi3SetShiftDecimal(c, &one, 1, NULL));
    IS_ERROR(fmi3SetShiftFraction(c, &one, 1, &counter, &counter));
    IS_ERROR(fmi3EvaluateDiscreteStates(c));
    IS_ERROR(fmi3EnterConfigurationMode(c));
    IS_ERROR(fmi3ExitConfigurationMode(c));
    IS_ERROR(fmi3GetNumberOfVariableDependencies(c, one, &size));
    IS_ERROR(fmi3GetVariableDependencies(c, one, NULL, NULL, NULL, NULL, 0));
    IS_ERROR(fmi3GetDirectionalDerivative(c, &one, 1, &one, 1, NULL, 0, NULL, 0));
    IS_ERROR(fmi3GetAdjointDerivative(c, &one, 1, &one, 1, NULL, 0, NULL, 0));
    IS_ERROR(fmi3GetDirectionalDerivative(c, &one, 1, &one, 1, NULL, 1, NULL, 1));
    IS_ERROR(fmi3GetAdjointDerivative(c, &one, 1, &one, 1, NULL, 1, NULL, 1));
    IS_ERROR(fmi3GetOutputDerivatives(c, &one, 1, NULL, NULL, 0));
    IS_ERROR(fmi3ActivateModelPartition(c, one, 0.0));
    IS_ERROR(fmi3EnterStepMode(c));
    CHECK(messages == said + 29 && counter == 0 && size == 7);
    fmi3FreeInstance(c);
}
