// What a sketch sees of a board's core: its macros, and a serial line that is standard output. With SHOW_BITS in the
// environment a number is written as the bits of its float, for a test to compare them.
#pragma once

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HIGH 0x1
#define LOW 0x0
#define INPUT 0x0
#define OUTPUT 0x1
#define CHANGE 1
#define FALLING 2
#define RISING 3
#define DEFAULT 1
#define EXTERNAL 0
#define INTERNAL 3
#define SERIAL 0x0
#define DISPLAY 0x1
#define PI 3.1415926535897932384626433832795
#define HALF_PI 1.5707963267948966192313216916398
#define TWO_PI 6.283185307179586476925286766559
#define EULER 2.718281828459045235360287471352
#define DEC 10
#define HEX 16
#define B0 0
#define B1 1
#define B10 2
#define F_CPU 64000000L
#define F(string_literal) (string_literal)
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define abs(x) ((x) > 0 ? (x) : -(x))
#define round(x) ((x) >= 0 ? (long)((x) + 0.5) : (long)((x)-0.5))
#define constrain(amt, low, high) ((amt) < (low) ? (low) : ((amt) > (high) ? (high) : (amt)))
#define radians(deg) ((deg)*0.017453292519943295769236907684886)
#define degrees(rad) ((rad)*57.295779513082320876798154814105)
#define sq(x) ((x) * (x))
#define bit(b) (1UL << (b))
#define lowByte(w) ((uint8_t)((w) & 0xff))
#define highByte(w) ((uint8_t)((w) >> 8))
#define bitRead(value, bit) (((value) >> (bit)) & 0x01)
#define bitSet(value, bit) ((value) |= (1UL << (bit)))
#define interrupts()
#define noInterrupts()
#define word(...) makeWord(__VA_ARGS__)
#define _BV(b) (1UL << (b))

typedef uint8_t byte;
typedef bool boolean;

struct SerialLine {
  void begin(unsigned long) {}
  void print(const char* text) { fputs(text, stdout); }
  void println(const char* text) { puts(text); }
  void print(double value, int digits) {
    if (getenv("SHOW_BITS") == NULL) {
      printf("%.*f", digits, value);
      return;
    }
    const float narrow = (float)value;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    printf("%08lx", (unsigned long)bits);
  }
  void println(double value, int digits) {
    print(value, digits);
    puts("");
  }
};
static SerialLine Serial;

static inline void delay(unsigned long) {}

void setup();
void loop();
