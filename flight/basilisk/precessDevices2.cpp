/* The devices of tables of version 2. */
#include <cstddef>
#include <cstdint>

#define PRECESS_TABLE_VERSION 2
#define VERSION precess_v2
#include "precessDevices.inc"
