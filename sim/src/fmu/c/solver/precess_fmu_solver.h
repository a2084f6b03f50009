/**
 * @file
 * What the solver takes of an instance: parameters, state, inputs. No pointer may be null.
 */

#ifndef PRECESS_FMU_SOLVER_H
#define PRECESS_FMU_SOLVER_H

#include "precess_fmu.h"

/** Copies numbers; what follows the last of them. */
const double *precess_fmu_copy(const double *from, int count, double *to);

/** Prepares the solver from the parameters, where they have changed. */
enum precess_status precess_fmu_prepare(struct precess_fmu *fmu);

/** A state, or a direction of one, from its numbers. */
void precess_fmu_state_at(const double *from, struct FMU_SOLVER_STATE *state);

/** The state. */
void precess_fmu_state_of(const struct precess_fmu *fmu, struct FMU_SOLVER_STATE *state);

/** Sets the rates to zero that are: of locked joints, and of a hub that is fixed. An integrator may vary them. */
void precess_fmu_hold(struct FMU_SOLVER_STATE *state);

/** Inputs in this state: motors within their limits, wrenches along B. */
void precess_fmu_inputs_of(
    const struct precess_fmu *fmu, const struct FMU_SOLVER_STATE *state, struct FMU_SOLVER_INPUTS *inputs);

#endif
