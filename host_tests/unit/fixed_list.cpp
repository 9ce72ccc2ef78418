// Storage inside the object.
#include "taut/numerics/fixed_list.hpp"

#include <doctest/doctest.h>

namespace fixed_list_test {
using taut::FixedArray;
using taut::FixedList;

TEST_CASE("a list numbers its items in the order of addition") {
  FixedList<int, 3> list;
  CHECK(list.empty());
  CHECK(list.add(10) == 0);
  CHECK(list.add(20) == 1);
  CHECK(list.size() == 2);
  CHECK(list[0] == 10);
  CHECK(list[1] == 20);
}

TEST_CASE("a full list drops what is added and counts it") {
  FixedList<int, 2> list;
  for (int i = 0; i < 5; ++i) list.add(i);
  CHECK(list.add(5) == -1);
  CHECK(list.size() == 2);
  CHECK(list.excess() == 4);
  CHECK(list[1] == 1);
}

TEST_CASE("iteration visits the items that were added and no others") {
  FixedList<int, 8> list;
  list.add(1);
  list.add(2);
  int sum = 0, visits = 0;
  for (const int item : list) {
    sum += item;
    ++visits;
  }
  CHECK(sum == 3);
  CHECK(visits == 2);
}

TEST_CASE("a list of capacity zero has no room and no items") {
  FixedList<double, 0> list;
  CHECK(list.add(1.0) == -1);
  CHECK(list.empty());
  CHECK(list.excess() == 1);
  CHECK(list.begin() == list.end());
}

TEST_CASE("a list is usable in constant expressions") {
  constexpr auto made = [] {
    FixedList<int, 2> list;
    list.add(4);
    list.add(5);
    list.add(6);
    return list;
  }();
  static_assert(made.size() == 2 && made.excess() == 1 && made[1] == 5 && made.capacity() == 2);
  CHECK(made[0] == 4);
}

TEST_CASE("a fixed array starts at zero and is filled as a whole") {
  FixedArray<int, 3> array;
  for (int i = 0; i < array.size(); ++i) CHECK(array[i] == 0);
  array.fill(7);
  for (int i = 0; i < array.size(); ++i) CHECK(array[i] == 7);
  CHECK(FixedArray<int, 0>::size() == 0);
}

}  // namespace fixed_list_test
