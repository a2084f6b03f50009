/* What version1.c does for version2.c. */
#ifndef VERSIONS_H
#define VERSIONS_H

#include <stddef.h>
#include <stdint.h>

uint32_t version_1_run(uint8_t *table, size_t capacity, size_t *length, double *numbers);
int32_t version_1_of(const void *craft);

#endif
