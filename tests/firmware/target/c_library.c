/* SPDX-License-Identifier: BSD-3-Clause */
/* What newlib's printf() needs below it, through a debugger or an emulator (Arm's semihosting), and
 * the way from the start-up code into a C program. */
#include <stddef.h>
#include <stdint.h>
#include <string.h>

static uint64_t heap[8192 / sizeof(uint64_t)]; /* printf's buffers and floating-point digits */
static size_t heap_used;

static void semihost(uint32_t operation, const void* argument) {
  register uint32_t r0 __asm__("r0") = operation;
  register const void* r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

void* _sbrk(ptrdiff_t more) {
  if (more > (ptrdiff_t)(sizeof(heap) - heap_used)) return (void*)-1;
  void* const begin = (char*)heap + heap_used;
  heap_used += (size_t)more;
  return begin;
}

int _write(int file, const char* bytes, int count) {
  (void)file;
  char text[65];
  for (int done = 0; done < count; done += 64) {
    const size_t part = (size_t)(count - done < 64 ? count - done : 64);
    memcpy(text, bytes + done, part);
    text[part] = '\0';
    semihost(0x04, text);
  }
  return count;
}

__attribute__((noreturn)) void _exit(int status) {
  const uint32_t arguments[2] = {0x20026, (uint32_t)status};
  semihost(0x20, arguments);
  for (;;) {
  }
}

int _close(int file) { return file - file - 1; }
int _fstat(int file, void* status) { return file - file + 0 * (status == NULL); }
int _isatty(int file) { return file - file + 1; }
int _lseek(int file, int offset, int from) { return 0 * (file + offset + from); }
int _read(int file, char* bytes, int count) { return 0 * (file + count + (bytes == NULL)); }
int _kill(int process, int number) { return 0 * (process + number) - 1; }
int _getpid(void) { return 1; }
void abort(void) { _exit(134); }
/* Referred to by tables of virtual functions; never called. */
void __cxa_pure_virtual(void) { abort(); }

int disflow_c_main(void);
/* The start-up code does not expect main() to return. */
int main(void) { _exit(disflow_c_main()); }
