//! What was tried to make evaluations quicker, written by hand: the idea, and what came of it, each
//! measured in turns with the text before it.

/// Ideas with their outcome, the latest last.
pub(crate) const TRIED: &[(&str, &str)] = &[
    (
        "one state: the elimination of a device by three-operand instructions (AVX2), all else as it was",
        "nothing by itself: operations that wait for each other take the time, not their number. \
         Kept for the rows below",
    ),
    (
        "one state: the kernel writes the device's share of the hub's equations, its caller adds it",
        "kept: a device no longer waits for the sums of the one before it",
    ),
    (
        "one state: sines and cosines of one device side by side in lanes, with the same bits",
        "kept: brought more than the row above",
    ),
    (
        "both for kinds of one joint",
        "slower: the compiler makes vectors of a short kernel, and its results take longer through \
         memory than the sums. Such kinds stay as they were",
    ),
    (
        "one state, fused: AVX-512 for single numbers",
        "slower than not fused at all: the compiler gathers single numbers into vectors. AVX2 is \
         used instead",
    ),
    (
        "one state: devices side by side in lanes that do not fuse, their shares added one device \
         after another",
        "kept, `AcrossDevices`: the bits of one state",
    ),
    (
        "the same sums device by device, each from memory",
        "the evaluation took half as long again; each number over all devices instead",
    ),
    (
        "the same order of sums in fused lanes",
        "N = 4: next to nothing; from N = 16 on slower by a seventh. Fused lanes add lane by lane",
    ),
    (
        "statements of a kernel in an order with few live values (random exchanges that keep \
         what is kept if better): on average 41 instead of 61 live at once in that of the \
         DGVSCMG, 31 of 43 VSCMG, 24 of 28 SGCMG, 21 of 25 reaction wheel",
        "not kept: the kernel by itself, on an AMD EPYC, took 1.04, 0.91 to 0.98, 0.99 to 1.01 \
         and 0.99 of the time. The compiler orders instructions itself; loads and stores changed \
         by +3, -8, -6 and -11 %",
    ),
    (
        "a device's share added where each sum stands, not by a new record of all sums",
        "kept: on a Cortex-M7 up to a store and a load a number less; an evaluation of four DGVSCMGs \
         or four reaction wheels has 1 % fewer instructions",
    ),
    (
        "on board, a zero to fill the hub's sums with whose value the compiler does not know",
        "kept for pointers of 32 bits: it no longer calls a function to clear them, five \
         instructions a word. An evaluation of one reaction wheel takes 1624 instead of 1960 \
         instructions",
    ),
    (
        "kinds of one joint by three-operand instructions (AVX2), their share added at once",
        "not kept: a step of three reaction wheels has 10 % fewer instructions and takes, on an \
         AMD EPYC, 0.99 of the time. Operations that wait for each other take it",
    ),
    (
        "the hub's six reciprocals in two groups of three that do not wait for each other, by \
         minors of each 3 by 3 block",
        "not kept, with other bits: on an AMD EPYC a step of three reaction wheels took 0.97 of \
         the time, one state of four DGVSCMGs 0.99, a hub alone 1.05",
    ),
    (
        "parameters per lane: torques and modes that all states share taken in once, as with one \
         spacecraft, and not once for each group of lanes",
        "kept: on an AMD EPYC (AVX2) 64 states take 0.86 of the time, 1.22 instead of 1.46 times \
         that of one spacecraft",
    ),
    (
        "parameters per lane: the constants of the DGVSCMG that its elimination reads, 45 of 163, \
         side by side in the order in which it reads them",
        "not kept: on an AMD EPYC 0.99 of the time for 64 states, 1.00 for 8, 0.98 to 1.02 for 256",
    ),
    (
        "C library: the caller's structures read where they stand, its own inputs filled in \
         place, not returned",
        "kept: on an AMD EPYC a step of three reaction wheels takes 0.88 of the time, 7 % fewer \
         instructions; an evaluation 0.73, 21 % fewer. 13 copies by `memcpy` a call became 4",
    ),
    (
        "C library: state, motors, modes and results of the joints each by one pass over the \
         list, and not by a search for each number; modes written once",
        "kept: an evaluation of three reaction wheels takes 0.95 of the time, 9 % fewer \
         instructions, a step 0.98",
    ),
    (
        "C library: arrays of data made by number instead of from references, and their functions \
         inlined",
        "not kept: the same instructions, to the last",
    ),
    (
        "list, C library: sums of slopes and stages device by device, numbers of members compared \
         within the elimination, accelerations checked finite where they are written",
        "kept: a step of three reaction wheels takes 0.89 of the time as a list, 0.91 in the C \
         library, 9 and 8 % fewer instructions",
    ),
    (
        "list, C library: the gains of a device written and read where they are, not converted \
         from and to those of any kind",
        "kept: a step of three reaction wheels takes 0.99 of the time as a list, 0.95 in the C \
         library",
    ),
    (
        "list: gains allocated once a step, not once a stage",
        "not kept: a step of three reaction wheels takes 0.95 of the time, but on a Cortex-M7 one of \
         four DGVSCMGs needs 8984 instead of 7840 bytes of stack",
    ),
    (
        "RK4 step: the last stage sets the end of the step at once, without a stage that nobody \
         reads and a pass over all joints",
        "not kept: of three reaction wheels a typed step has 1 % more instructions, as the \
         compiler no longer keeps the sums in one loop, and takes 1.01 to 1.03 of the time; a \
         list's takes 1.00",
    ),
    (
        "RK4 step: three reaction wheels by `AcrossDevices`, side by side in lanes that do not \
         fuse",
        "the same bits in 0.74 of the time of the typed set, on an AMD EPYC with AVX2. Not in the \
         rows of this page: it is another set than those",
    ),
];
