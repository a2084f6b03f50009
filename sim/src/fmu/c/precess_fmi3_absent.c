/* FMI 3.0: what this unit does not have, which is variables of other types than Float64, clocks and structural parameters.
 * Each function returns an error, with a message; of no variables reads and writes are well. */

#include "precess_fmi3.h"

#define NO_CLOCKS "this unit has no clocks"
#define NO_CONFIGURATION "this unit has no structural parameters"
#define NO_ARRAYS "no variable is an array: what each depends on is in modelDescription.xml"

/* Reads and writes of another type. */
static fmi3Status none_of(fmi3Instance instance, size_t count)
{
    return precess_fmi3_answer(
        instance, instance && count == 0 ? NULL : "all variables are of the type Float64");
}

#define WITHOUT(type)                                                                                  \
    fmi3Status fmi3Get##type(                                                                          \
        fmi3Instance instance, const fmi3ValueReference vr[], size_t count, fmi3##type values[],       \
        size_t value_count)                                                                            \
    {                                                                                                  \
        (void)vr;                                                                                      \
        (void)values;                                                                                  \
        (void)value_count;                                                                             \
        return none_of(instance, count);                                                               \
    }                                                                                                  \
    fmi3Status fmi3Set##type(                                                                          \
        fmi3Instance instance, const fmi3ValueReference vr[], size_t count, const fmi3##type values[], \
        size_t value_count)                                                                            \
    {                                                                                                  \
        (void)vr;                                                                                      \
        (void)values;                                                                                  \
        (void)value_count;                                                                             \
        return none_of(instance, count);                                                               \
    }

WITHOUT(Float32)
WITHOUT(Int8)
WITHOUT(UInt8)
WITHOUT(Int16)
WITHOUT(UInt16)
WITHOUT(Int32)
WITHOUT(UInt32)
WITHOUT(Int64)
WITHOUT(UInt64)
WITHOUT(Boolean)
WITHOUT(String)

fmi3Status fmi3GetBinary(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    size_t sizes[],
    fmi3Binary values[],
    size_t value_count)
{
    (void)vr;
    (void)sizes;
    (void)values;
    (void)value_count;
    return none_of(instance, count);
}

fmi3Status fmi3SetBinary(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    const size_t sizes[],
    const fmi3Binary values[],
    size_t value_count)
{
    (void)vr;
    (void)sizes;
    (void)values;
    (void)value_count;
    return none_of(instance, count);
}

fmi3Status fmi3GetClock(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    fmi3Clock values[])
{
    (void)vr;
    (void)values;
    return none_of(instance, count);
}

fmi3Status fmi3SetClock(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    const fmi3Clock values[])
{
    (void)vr;
    (void)values;
    return none_of(instance, count);
}

fmi3Status fmi3GetIntervalDecimal(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    fmi3Float64 intervals[],
    fmi3IntervalQualifier qualifiers[])
{
    (void)vr;
    (void)count;
    (void)intervals;
    (void)qualifiers;
    return precess_fmi3_answer(instance, NO_CLOCKS);
}

fmi3Status fmi3GetIntervalFraction(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    fmi3UInt64 counters[],
    fmi3UInt64 resolutions[],
    fmi3IntervalQualifier qualifiers[])
{
    (void)vr;
    (void)count;
    (void)counters;
    (void)resolutions;
    (void)qualifiers;
    return precess_fmi3_answer(instance, NO_CLOCKS);
}

fmi3Status fmi3GetShiftDecimal(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    fmi3Float64 shifts[])
{
    (void)vr;
    (void)count;
    (void)shifts;
    return precess_fmi3_answer(instance, NO_CLOCKS);
}

fmi3Status fmi3GetShiftFraction(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    fmi3UInt64 counters[],
    fmi3UInt64 resolutions[])
{
    (void)vr;
    (void)count;
    (void)counters;
    (void)resolutions;
    return precess_fmi3_answer(instance, NO_CLOCKS);
}

fmi3Status fmi3SetIntervalDecimal(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    const fmi3Float64 intervals[])
{
    (void)vr;
    (void)count;
    (void)intervals;
    return precess_fmi3_answer(instance, NO_CLOCKS);
}

fmi3Status fmi3SetIntervalFraction(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    const fmi3UInt64 counters[],
    const fmi3UInt64 resolutions[])
{
    (void)vr;
    (void)count;
    (void)counters;
    (void)resolutions;
    return precess_fmi3_answer(instance, NO_CLOCKS);
}

fmi3Status fmi3SetShiftDecimal(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    const fmi3Float64 shifts[])
{
    (void)vr;
    (void)count;
    (void)shifts;
    return precess_fmi3_answer(instance, NO_CLOCKS);
}

fmi3Status fmi3SetShiftFraction(
    fmi3Instance instance,
    const fmi3ValueReference vr[],
    size_t count,
    const fmi3UInt64 counters[],
    const fmi3UInt64 resolutions[])
{
    (void)vr;
    (void)count;
    (void)counters;
    (void)resolutions;
    return precess_fmi3_answer(instance, NO_CLOCKS);
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance)
{
    return precess_fmi3_answer(instance, "this unit has no discrete states");
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance)
{
    return precess_fmi3_answer(instance, NO_CONFIGURATION);
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance)
{
    return precess_fmi3_answer(instance, NO_CONFIGURATION);
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference vr, size_t *count)
{
    (void)vr;
    (void)count;
    return precess_fmi3_answer(instance, NO_ARRAYS);
}

fmi3Status fmi3GetVariableDependencies(
    fmi3Instance instance,
    fmi3ValueReference vr,
    size_t elements[],
    fmi3ValueReference independents[],
    size_t independent_elements[],
    fmi3DependencyKind kinds[],
    size_t count)
{
    (void)vr;
    (void)elements;
    (void)independents;
    (void)independent_elements;
    (void)kinds;
    (void)count;
    return precess_fmi3_answer(instance, NO_ARRAYS);
}
