/* Trackers called from C: a line and a drag are found exactly without noise; what is wrong is rejected and changes nothing. Also C++. */

#include "check.h"
#include "precess_tracking.h"

static precess_line_tracker line;
static precess_drag_tracker drag;
static precess_line_estimate found;
static precess_drag_estimate torque;

/* A rotor that turns by atan2(4, 3) a sample, its cosines exact rationals. */
static void lines(void)
{
    static const double TURN = 0.92729521800161223; /* atan2(4, 3) */
    double cosine = 1.0, sine = 0.0;
    int k;
    IS(precess_line_start(&line, 50.0), PRECESS_OK);
    IS(precess_line_estimate_of(&line, &found), PRECESS_ERROR_UNDETERMINED);
    for (k = 0; k < 200; k++) {
        const double next = 0.6 * cosine - 0.8 * sine;
        IS(precess_line_update(&line, TURN * k, 2.0, 1.0 + 2.0 * (0.03 * cosine - 0.04 * sine)), PRECESS_OK);
        sine = 0.8 * cosine + 0.6 * sine;
        cosine = next;
        if (k % 20 == 19) {
            IS(precess_line_estimate_of(&line, &found), PRECESS_OK);
            bits(found.amplitude);
            bits(found.phase);
        }
    }
    IS(precess_line_estimate_of(&line, &found), PRECESS_OK);
    NEAR(found.mean, 1.0, 1e-12);
    NEAR(found.amplitude, 0.05, 1e-12);
    NEAR(found.phase, TURN, 1e-11);
    NEAR(found.noise, 0.0, 1e-8); /* squares are known to 1e-16 of those of the first samples */
    bits(found.amplitude);
}

static void drags(void)
{
    double rate = 300.0;
    int k;
    IS(precess_drag_start(&drag, 0.0191, 50.0), PRECESS_OK);
    IS(precess_drag_estimate_of(&drag, &torque), PRECESS_ERROR_UNDETERMINED);
    for (k = 0; k < 200; k++) {
        rate += (0.01 - 1.5 * 0.004) * 0.01 / 0.0191;
        IS(precess_drag_update(&drag, 0.01, 0.01, 0.004, rate), PRECESS_OK);
        if (k % 20 == 19) {
            IS(precess_drag_estimate_of(&drag, &torque), PRECESS_OK);
            bits(torque.coefficient);
            bits(torque.rate);
        }
    }
    IS(precess_drag_estimate_of(&drag, &torque), PRECESS_OK);
    NEAR(torque.coefficient, 1.5, 1e-9);
    NEAR(torque.rate, rate, 1e-10);
    bits(torque.coefficient);
}

static void rejections(void)
{
    const double nan = not_a_number();
    precess_line_tracker before = line;
    IS(precess_line_start(&line, 7.0), PRECESS_ERROR_RANGE);
    IS(precess_drag_start(&drag, 0.0, 50.0), PRECESS_ERROR_RANGE);
    IS(precess_line_start(0, 50.0), PRECESS_ERROR_NULL);
    IS(precess_drag_update(&drag, -1.0, 0.0, 0.0, 0.0), PRECESS_ERROR_RANGE);
    IS(precess_line_update(&line, 0.0, 1.0, nan), PRECESS_ERROR_NOT_FINITE);
    IS(precess_line_update(&line, nan, 1.0, 0.0), PRECESS_ERROR_NOT_FINITE);
    IS(same(&line, &before, sizeof line), 1);
}

int main(void)
{
    lines();
    drags();
    rejections();
    return finish(435);
}
