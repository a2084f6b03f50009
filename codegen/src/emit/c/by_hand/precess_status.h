/* Written by `cargo xtask regen --emit c` as it stands in codegen/src/emit/c/by_hand. */

/**
 * @file
 * How a call of the solver came out.
 */

#ifndef PRECESS_STATUS_H
#define PRECESS_STATUS_H

/** How a call of the solver came out. What it was to write counts only where this is zero. */
enum precess_status {
    /** Well. */
    PRECESS_OK = 0,
    /** A parameter is none that a spacecraft of these kinds can have. */
    PRECESS_BAD_PARAMETER = 1,
    /** A number of the state or of the inputs, or the time step, is infinite or NaN, or the
     * attitude is none. */
    PRECESS_BAD_INPUT = 2,
    /** An angle is beyond PRECESS_LARGEST_ANGLE. Wrap it by whole turns, unless the joint has a
     * spring. */
    PRECESS_BAD_ANGLE = 3,
    /** A driven joint, or the hub, is left without inertia: its pivot is only rounding. */
    PRECESS_NO_INERTIA = 4,
    /** A result overflows though every input is finite. */
    PRECESS_OVERFLOWS = 5,
    /** A locked joint moves. */
    PRECESS_LOCKED_MOVES = 6,
    /** A fixed hub moves. */
    PRECESS_FIXED_MOVES = 7,
    /** A joint whose rate its kind keeps is driven, or prescribed to accelerate. */
    PRECESS_NOT_DRIVEN = 8,
    /** B is at the centre of the central body. */
    PRECESS_AT_CENTRE = 9,
    /** The step is too long for a spring, a damper or dry friction of a joint. */
    PRECESS_UNSTABLE = 10
};

#endif
