/* What the C++ program in main.cpp needs of an STM32F405 or of the emulator's netduinoplus2: from reset to
 * main(), and standard output on USART1 (pin PA9) at 115200 baud. Registers: reference manual RM0090. The
 * clock is the internal one of 16 MHz, that after reset. */
#include <errno.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/stat.h>

#define REGISTER(address) (*(volatile uint32_t*)(address))
#define RCC_AHB1ENR REGISTER(0x40023830)
#define RCC_APB2ENR REGISTER(0x40023844)
#define GPIOA_MODER REGISTER(0x40020000)
#define GPIOA_AFRH REGISTER(0x40020024)
#define USART1_SR REGISTER(0x40011000)
#define USART1_DR REGISTER(0x40011004)
#define USART1_BRR REGISTER(0x40011008)
#define USART1_CR1 REGISTER(0x4001100C)
#define SCB_AIRCR REGISTER(0xE000ED0C)
#define SCB_CPACR REGISTER(0xE000ED88)

extern uint32_t stack_top[], data_load[], data_begin[], data_end[], bss_begin[], bss_end[], heap_begin[],
    heap_end[];
extern void (*const init_array_begin[])(void);
extern void (*const init_array_end[])(void);
int main(void);
void start_up(void);
int _write(int file, const char* text, int length);
void* _sbrk(ptrdiff_t more);
int _fstat(int file, struct stat* about);
int _isatty(int file);
int _close(int file);
int _lseek(int file, int to, int from);
int _read(int file, char* text, int length);

/* A fault stops here, where a debugger shows it. */
static void stop(void) {
  for (;;) {
  }
}

__attribute__((section(".vectors"), used)) static void* const vectors[16] = {
    stack_top,   (void*)start_up, (void*)stop, (void*)stop, (void*)stop, (void*)stop,
    (void*)stop, (void*)stop,     (void*)stop, (void*)stop, (void*)stop, (void*)stop,
    (void*)stop, (void*)stop,     (void*)stop, (void*)stop};

void start_up(void) {
  uint32_t *to, *from = data_load;
  void (*const* each)(void);
  SCB_CPACR |= 0xFUL << 20; /* access to the floating-point unit */
  __asm volatile("dsb\n isb" ::: "memory");
  for (to = data_begin; to != data_end; ++to) *to = *from++;
  for (to = bss_begin; to != bss_end; ++to) *to = 0;

  RCC_AHB1ENR |= 1UL;      /* port A */
  RCC_APB2ENR |= 1UL << 4; /* USART1 */
  GPIOA_MODER = (GPIOA_MODER & ~(3UL << 18)) | 2UL << 18;
  GPIOA_AFRH = (GPIOA_AFRH & ~(15UL << 4)) | 7UL << 4;
  USART1_BRR = 139;                  /* 16 MHz / 115200 */
  USART1_CR1 = 1UL << 13 | 1UL << 3; /* on, sends */

  for (each = init_array_begin; each != init_array_end; ++each) (*each)();
  main();
  while (!(USART1_SR & 1UL << 6)) { /* the last character is on its way */
  }
  SCB_AIRCR = 0x05FA0004; /* reset: the program begins again; the emulator ends, see the Makefile */
  stop();
}

/* What printf() of newlib needs. */
void abort(void) {
  for (;;) {
  }
}

int _write(int file, const char* text, int length) {
  int i;
  (void)file;
  for (i = 0; i < length; ++i) {
    while (!(USART1_SR & 1UL << 7)) { /* room for one more */
    }
    USART1_DR = (unsigned char)text[i];
  }
  return length;
}

void* _sbrk(ptrdiff_t more) {
  static char* top = (char*)heap_begin;
  char* const before = top;
  if (more > (char*)heap_end - top) {
    errno = ENOMEM;
    return (void*)-1;
  }
  top += more;
  return before;
}

int _fstat(int file, struct stat* about) {
  (void)file;
  about->st_mode = S_IFCHR;
  return 0;
}
int _isatty(int file) { return file >= 0; }
int _close(int file) { return file < 0; }
int _lseek(int file, int to, int from) { return file + to + from < 0; }
int _read(int file, char* text, int length) {
  (void)text;
  return file < 0 ? length : 0;
}
