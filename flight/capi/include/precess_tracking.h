/* Precess: what a rotor does, followed from sample to sample: its imbalance line in a measured signal, its drag torque.
 * Recursive least squares with exponential forgetting; the memory is the caller's, a sample takes the same operations
 * whatever its numbers are. No spacecraft is needed.
 *
 * A memory of so many samples: weights fall by a factor of e in that time; from 8 to 1e9. Rules of precess.h hold for
 * pointers and codes. Variances are those of white noise, whose deviation is found from the residuals.
 */
#ifndef PRECESS_TRACKING_H
#define PRECESS_TRACKING_H

#include "precess.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Trackers: set by _start, changed by _update; copies of one are trackers of their own. */
typedef struct precess_line_tracker {
    double numbers[27];
} precess_line_tracker;

typedef struct precess_drag_tracker {
    double numbers[16];
} precess_drag_tracker;

/* signal = mean + gain amplitude cos(angle + phase) */
typedef struct precess_line_estimate {
    double mean;          /* of the signal, in its unit */
    double amplitude;     /* of the line by the gain */
    double phase;         /* rad, from -pi to pi */
    double parts[2];      /* amplitude cos(phase), -amplitude sin(phase): of cosine and sine of the angle */
    double covariance[3]; /* variances of the parts, and their covariance */
    double noise;         /* standard deviation, in the unit of the signal */
} precess_line_estimate;

/* inertia rate' = torque - coefficient drag */
typedef struct precess_drag_estimate {
    double coefficient; /* the drag torque by the expected one */
    double variance;    /* of the coefficient */
    double rate;        /* of the rotor about its spin axis, filtered, rad/s */
    double noise;       /* standard deviation of that of the rate, rad/s */
} precess_drag_estimate;

/* Starts a tracker. PRECESS_ERROR_RANGE: a memory that is not from 8 to 1e9, an inertia (about the spin axis, kg m^2) not
 * above 0. */
int32_t precess_line_start(precess_line_tracker *line, double memory);
int32_t precess_drag_start(precess_drag_tracker *drag, double inertia, double memory);

/* Takes a sample: angle of the rotor, rad; the line's gain, 1 or what the line grows by with the speed (rate^2 of a force,
 * rate of a body rate: the amplitude is then that of the imbalance); the signal. */
int32_t precess_line_update(precess_line_tracker *line, double angle, double gain, double signal);

/* Takes a sample: the time since the sample before, s; mean torque of the motor, N m, and mean expected drag, N m with the sign of
 * the rate, since then; the rate of the rotor about its spin axis relative to inertial space (tachometer and body rate), rad/s. */
int32_t precess_drag_update(precess_drag_tracker *drag, double elapsed, double torque, double expected, double rate);

/* What the last samples say. PRECESS_ERROR_UNDETERMINED where they do not: too few, a rotor that stands, no expected drag. */
int32_t precess_line_estimate_of(const precess_line_tracker *line, precess_line_estimate *out);
int32_t precess_drag_estimate_of(const precess_drag_tracker *drag, precess_drag_estimate *out);

#ifdef __cplusplus
}
#endif

#endif
