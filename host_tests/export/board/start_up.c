/* From reset to main(), whose arguments are in arguments.h, and out of the emulator with its status. */
#include <stdint.h>
#include <stdlib.h>

extern uint32_t stack_top[], bss_begin[], bss_end[];
extern void (*const init_array_begin[])(void);
extern void (*const init_array_end[])(void);
extern void initialise_monitor_handles(void); /* files and standard output are those of the host */
int main(int argc, char** argv);
void start_up(void);
void _fini(void);

static char* arguments[] = {
#include "arguments.h"
};

void _fini(void) {} /* exit() calls it */
static void fault(void) { exit(70); }

__attribute__((section(".vectors"), used)) static void* const vectors[] = {
    stack_top,    (void*)start_up, (void*)fault, (void*)fault, (void*)fault, (void*)fault, (void*)fault, (void*)fault,
    (void*)fault, (void*)fault,    (void*)fault, (void*)fault, (void*)fault, (void*)fault, (void*)fault, (void*)fault};

void start_up(void) {
  uint32_t* to;
  void (*const* each)(void);
  *(volatile uint32_t*)0xE000ED88 |= 0xFUL << 20; /* access to the floating-point unit */
  __asm volatile("dsb\n isb" ::: "memory");
  for (to = bss_begin; to != bss_end; ++to) *to = 0;
  for (each = init_array_begin; each != init_array_end; ++each) (*each)();
  initialise_monitor_handles();
  exit(main((int)(sizeof arguments / sizeof *arguments), arguments));
}
