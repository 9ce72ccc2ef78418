// x
#include <doctest/doctest.h>
