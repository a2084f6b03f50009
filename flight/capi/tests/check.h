/* Checks for programs without a C library: output by the kernel's own call, Linux on x86-64. With
 * -DHOSTED the C library prints. */
#ifndef CHECK_H
#define CHECK_H

#include <stddef.h>
#include <stdint.h>

#define IS(found, expected) is((long)(found), (long)(expected), #found, __LINE__)
#define NEAR(found, expected, bound) near((found), (expected), (bound), #found, __LINE__)

static int failures;
static int checks;

#ifdef HOSTED
#include <stdio.h>
static void print_bytes(const char *text, size_t length)
{
    fwrite(text, 1, length, stdout);
}
#else
static void print_bytes(const char *text, size_t length)
{
    long result;
    __asm__ volatile("syscall"
                     : "=a"(result)
                     : "a"(1L), "D"(1L), "S"(text), "d"(length)
                     : "rcx", "r11", "memory");
    (void)result;
}
#endif

static void say(const char *text)
{
    size_t length = 0;
    while (text[length] != '\0') {
        length++;
    }
    print_bytes(text, length);
}

static void say_hex(uint64_t number)
{
    char digits[17];
    int index;
    for (index = 0; index < 16; index++) {
        digits[index] = "0123456789abcdef"[(number >> (60 - 4 * index)) & 15];
    }
    digits[16] = '\n';
    print_bytes(digits, 17);
}

static uint64_t bits_of(double value)
{
    union {
        double value;
        uint64_t bits;
    } both;
    both.value = value;
    return both.bits;
}

/* Prints a number bit by bit. */
static void bits(double value)
{
    say_hex(bits_of(value));
}

static void fail(const char *what, int line)
{
    failures++;
    say("failed: ");
    say(what);
    say(" in line (hexadecimal) ");
    say_hex((uint64_t)line);
}

static void is(long found, long expected, const char *what, int line)
{
    checks++;
    if (found != expected) {
        fail(what, line);
    }
}

static void near(double found, double expected, double bound, const char *what, int line)
{
    double difference = found - expected;
    checks++;
    if (!(difference <= bound && -difference <= bound)) {
        fail(what, line);
    }
}

static int same(const void *a, const void *b, size_t length)
{
    const unsigned char *first = (const unsigned char *)a, *second = (const unsigned char *)b;
    size_t index;
    for (index = 0; index < length; index++) {
        if (first[index] != second[index]) {
            return 0;
        }
    }
    return 1;
}

static double not_a_number(void)
{
    volatile double zero = 0.0;
    return zero / zero;
}

static int finish(int least)
{
    say(failures == 0 ? "passed\n" : "FAILED\n");
    return failures != 0 || checks < least;
}

#endif
