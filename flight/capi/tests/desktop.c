/* A run of the desktop tool, repeated by the library: `desktop TABLE CSV STEP`, the step in seconds.
 *
 * The spacecraft is that of the exported table. The CSV file has a sample at the start of each step: the
 * first one is the initial state; from each one the motor torques are held over the step, and each
 * further one must have the bits of the state that the library has reached. Also C++. */

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "precess.h"

enum {
    COLUMNS_MAX = 256,
    LINE = 16384,
    PER_JOINT = 4, /* columns of a joint: coordinate, rate, acceleration, motor torque */
    LEAST = 100    /* samples below which nothing has been shown */
};

static precess_spacecraft craft;
static uint8_t table[PRECESS_TABLE_SIZE(PRECESS_MAX_DEVICES) + 1];
static char line[LINE];
static char names[LINE];
static const char *name_of[COLUMNS_MAX];
static double sample[COLUMNS_MAX];
static int columns;

static void stop(const char *what, const char *which)
{
    fprintf(stderr, "desktop: %s: %s\n", what, which);
    exit(1);
}

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

/* The place of a column by its name. */
static int column(const char *name)
{
    int k;
    for (k = 0; k < columns; k++) {
        if (strcmp(name_of[k], name) == 0) {
            return k;
        }
    }
    stop("the CSV file has no column", name);
    return 0;
}

/* The first column of the joints: the first whose name has a device before a dot. */
static int first_of_joints(void)
{
    int k;
    for (k = 0; k < columns; k++) {
        if (strchr(name_of[k], '.') != NULL) {
            return k;
        }
    }
    return columns;
}

/* Reads the names; comments begin with a number sign. */
static void read_names(FILE *csv)
{
    char *name;
    do {
        if (fgets(names, sizeof names, csv) == NULL || strchr(names, '\n') == NULL) {
            stop("the CSV file has no names", "an empty file, or a line that is too long");
        }
    } while (names[0] == '#');
    for (name = strtok(names, ",\n"); name != NULL; name = strtok(NULL, ",\n")) {
        if (columns == COLUMNS_MAX) {
            stop("the CSV file has too many columns", name);
        }
        name_of[columns++] = name;
    }
}

/* Reads a sample; 0 at the end of the file. */
static int read_sample(FILE *csv)
{
    char *at = line;
    int k;
    if (fgets(line, sizeof line, csv) == NULL) {
        return 0;
    }
    for (k = 0; k < columns; k++) {
        char *end;
        sample[k] = strtod(at, &end);
        if (end == at || *end != (k + 1 < columns ? ',' : '\n')) {
            stop("the CSV file has no number", name_of[k]);
        }
        at = end + 1;
    }
    return 1;
}

/* The state and the motor torques of the sample. */
static void take(precess_state *state, precess_inputs *inputs)
{
    static const char *const axes[3] = {"x", "y", "z"};
    uint32_t device, joint, joints;
    int axis, next = first_of_joints();
    char name[32];
    for (axis = 0; axis < 3; axis++) {
        snprintf(name, sizeof name, "position_%s", axes[axis]);
        state->position[axis] = sample[column(name)];
        snprintf(name, sizeof name, "velocity_%s", axes[axis]);
        state->velocity[axis] = sample[column(name)];
        snprintf(name, sizeof name, "omega_%s", axes[axis]);
        state->omega[axis] = sample[column(name)];
    }
    for (axis = 0; axis < 4; axis++) {
        snprintf(name, sizeof name, "q%d", axis);
        state->attitude[axis] = sample[column(name)];
    }
    for (device = 0; device < PRECESS_MAX_DEVICES; device++) {
        if (precess_joints(&craft, device, &joints) != PRECESS_OK) {
            break;
        }
        for (joint = 0; joint < joints; joint++, next += PER_JOINT) {
            if (next + PER_JOINT > columns) {
                stop("the CSV file has too few columns", "of the joints");
            }
            state->coordinate[device][joint] = sample[next];
            state->rate[device][joint] = sample[next + 1];
            if (inputs->mode[device][joint] == PRECESS_DRIVEN) {
                inputs->motor[device][joint] = sample[next + 3];
            }
        }
    }
    if (next != columns) {
        stop("the CSV file has columns of no joint, the first is", name_of[next]);
    }
}

static void read_table(const char *path)
{
    precess_fault fault;
    int32_t code;
    size_t length;
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        stop("cannot read", path);
    }
    length = fread(table, 1, sizeof table, file);
    fclose(file);
    code = precess_init_from_table(&craft, sizeof craft, table, length, &fault);
    if (code != PRECESS_OK) {
        stop("the table is rejected", precess_error_name(code));
    }
}

int main(int count, char **arguments)
{
    precess_state state, desktop;
    precess_inputs inputs;
    precess_fault fault;
    double numbers[2][13 + 2 * PRECESS_MAX_DEVICES * PRECESS_MAX_JOINTS];
    uint32_t length = 0, k;
    long samples = 0;
    double step;
    FILE *csv;
    if (count != 4) {
        stop("usage", "desktop TABLE CSV STEP");
    }
    read_table(arguments[1]);
    csv = fopen(arguments[2], "r");
    if (csv == NULL) {
        stop("cannot read", arguments[2]);
    }
    step = strtod(arguments[3], NULL);
    read_names(csv);
    precess_state_at_rest(&craft, &state);
    precess_state_at_rest(&craft, &desktop);
    precess_inputs_none(&craft, &inputs);
    precess_state_length(&craft, &length);
    while (read_sample(csv)) {
        if (samples > 0) {
            int32_t code = precess_step(&craft, &state, &inputs, step, 1, NULL, &fault);
            if (code != PRECESS_OK) {
                stop("a step is rejected", precess_error_name(code));
            }
        }
        take(&desktop, &inputs);
        if (samples == 0) {
            state = desktop;
        }
        if (precess_state_save(&craft, &state, numbers[0], length) != PRECESS_OK
            || precess_state_save(&craft, &desktop, numbers[1], length) != PRECESS_OK) {
            stop("the state cannot be saved", arguments[2]);
        }
        for (k = 0; k < length; k++) {
            if (bits_of(numbers[0][k]) != bits_of(numbers[1][k])) {
                fprintf(stderr, "desktop: number %u of the state after %ld steps: %a here, %a in %s\n",
                        (unsigned)k, samples, numbers[0][k], numbers[1][k], arguments[2]);
                return 1;
            }
        }
        samples++;
    }
    fclose(csv);
    if (samples < LEAST) {
        stop("too few samples", arguments[2]);
    }
    printf("%ld states of %u numbers, the same bits\n", samples, (unsigned)length);
    return 0;
}
