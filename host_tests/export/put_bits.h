/* A number as the bits of its IEEE single precision. */
#ifndef PUT_BITS_H
#define PUT_BITS_H

#include <stdio.h>
#include <string.h>

static void put_bits(float value) {
  unsigned char bytes[sizeof value];
  unsigned long bits = 0;
  int i;
  memcpy(bytes, &value, sizeof value);
  for (i = 3; i >= 0; --i) bits = bits << 8 | bytes[i];
  printf("%08lx", bits);
}

#endif
