/* Written by `precess-bake --general --batch`. In place of the system's header, which NVRTC has not. */

#ifndef PRECESS_NVRTC_STDINT_H
#define PRECESS_NVRTC_STDINT_H

typedef int int32_t;
typedef unsigned int uint32_t;
typedef long long int64_t;
typedef unsigned long long uint64_t;

#define UINT64_MAX 0xffffffffffffffffULL

#endif
