/* Written by `precess-bake --general --batch`. In place of the system's header, which NVRTC has not:
 * size_t and memcpy are there without one, NULL is not. */

#ifndef NULL
#define NULL 0
#endif
