/* What a program without a C library needs on Linux, x86-64: a beginning, and the two functions that
 * the library calls. */

#include <stddef.h>

void *memcpy(void *to, const void *from, size_t length);
void *memset(void *to, int value, size_t length);
void _start(void);

void *memcpy(void *to, const void *from, size_t length)
{
    unsigned char *out = (unsigned char *)to;
    const unsigned char *in = (const unsigned char *)from;
    while (length-- != 0) {
        *out++ = *in++;
    }
    return to;
}

void *memset(void *to, int value, size_t length)
{
    unsigned char *out = (unsigned char *)to;
    while (length-- != 0) {
        *out++ = (unsigned char)value;
    }
    return to;
}

__asm__(".globl _start\n"
        "_start:\n"
        "    xor %ebp, %ebp\n"
        "    and $-16, %rsp\n"
        "    call main\n"
        "    mov %eax, %edi\n"
        "    mov $60, %eax\n"
        "    syscall\n");
