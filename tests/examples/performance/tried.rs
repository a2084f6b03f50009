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
        "one state: devices side by side in lanes, their shares added one device after another",
        "kept, with the bits of one after another",
    ),
    (
        "the same sums device by device, each from memory",
        "the evaluation took half as long again; each number over all devices instead",
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
        "RK4 step: three reaction wheels side by side in lanes",
        "the same bits in 0.74 of the time of the typed set, on an AMD EPYC with AVX2: a row of its own \
         in the table of steps",
    ),
    (
        "batch: a thread keeps the slots of its last call, which were allocated, filled and freed in \
         each",
        "kept: on an AMD EPYC 64 states of four DGVSCMGs take 131 instead of 143 ns each, of 64 \
         DGVSCMGs 1998 instead of 4535. Slots of more than 128 kB, 20 DGVSCMGs, were returned to \
         the system, and each call had 70 pages mapped again",
    ),
    (
        "batch and devices in lanes: constants loaded where the elimination reads them, after the \
         branch on springs; before it, the compiler copied them to the stack",
        "kept: on an AMD EPYC with AVX-512 a step of 256 states takes 550 instead of 601 ns, 64 \
         states with parameters per lane 143 instead of 171. Accelerations alone of 64 states of one \
         spacecraft became slower, 135 instead of 131",
    ),
    (
        "devices in lanes: what back substitution needs of all groups allocated at once, not as it \
         grows; shares not masked where every lane has a device",
        "kept: with the row above, in lanes with fused multiply-add, 64 devices took 2420 instead of \
         3028 to 3525 ns, 16 took 713 to 791 instead of 798 to 912, four the same 263",
    ),
    (
        "devices in lanes: what back substitution needs of eight groups on the stack",
        "not kept: the compiler fills that with zeros first. On an AMD EPYC four devices took 308 \
         instead of 263 ns, 64 took 2375 to 2427 instead of 2420",
    ),
    (
        "batch: lanes of four (AVX2) instead of eight (AVX-512), which this core processes by halves",
        "not kept: on an AMD EPYC 64 states of four DGVSCMGs took 160 instead of 135 ns each",
    ),
    (
        "portable: the kernel writes the device's share, its caller adds it",
        "not kept: on an AMD EPYC four DGVSCMGs took 694 instead of 658 ns, 16 took 2599 instead of \
         2394",
    ),
    (
        "portable: sines and cosines of two joints side by side, as pairs of numbers",
        "not kept: on an AMD EPYC four DGVSCMGs took 738 instead of 658 ns, 16 took 2694 instead of \
         2396",
    ),
    (
        "portable: built without the compiler's vectoriser of straight-line code",
        "not kept: on an AMD EPYC four DGVSCMGs took 735 instead of 659 ns, 16 took 2812 instead of \
         2396",
    ),
    (
        "portable: joints read where the caller has them, not copied",
        "not kept: on an AMD EPYC four DGVSCMGs took 726 to 745 instead of 658 to 662 ns, on a Cortex-M7 \
         9144 instead of 9044 instructions",
    ),
    (
        "portable: the device's share added before its gains are written",
        "not kept: on an AMD EPYC four DGVSCMGs took 691 to 694 instead of 658 to 662 ns, though a \
         Cortex-M7 needs 16 to 100 instructions less of 4304 to 9144",
    ),
    (
        "products and sums rounded once (fused multiply-add), in every service",
        "not kept, with other bits: on an Intel and an AMD it took -13 to +2 % of the time of one state, 4 to \
         18 % of devices in lanes, 17 % of a batch. There is one result instead",
    ),
];
