/* The devices of tables of version 1. */
#include <cstddef>
#include <cstdint>

#define PRECESS_TABLE_VERSION 1
#define VERSION precess_v1
#include "precessDevices.inc"
