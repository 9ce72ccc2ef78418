// Status: errors as values.
#include "taut/status.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

namespace status_test {
using taut::Code;
using taut::Place;
using taut::Status;

namespace {
constexpr Code last_code = Code::not_started;
}

TEST_CASE("a status is true when all is well and only then") {
  CHECK(Status::success());
  CHECK(Status{}.ok());
  for (int code = 1; code <= static_cast<int>(last_code); ++code)
    CHECK_FALSE(Status::at(static_cast<Code>(code), Place::node, 0));
}

TEST_CASE("a status keeps the place, the number and the cable it was made with") {
  constexpr Status node = Status::at(Code::unknown_node, Place::strut, 3, 17);
  static_assert(node.code == Code::unknown_node && node.place == Place::strut && node.index == 3 &&
                node.cable == -1 && node.amount == 17);
  constexpr Status joint = Status::along(Code::folded_cable, Place::joint, 2, 5);
  static_assert(joint.cable == 2 && joint.index == 5 && joint.amount == 0);
  CHECK(node.amount == 17);
  CHECK(joint.cable == 2);
}

TEST_CASE("every code has a sentence of its own") {
  std::set<std::string> sentences;
  for (int code = 0; code <= static_cast<int>(last_code); ++code)
    sentences.insert(taut::describe(static_cast<Code>(code)));
  CHECK(sentences.size() == static_cast<std::size_t>(last_code) + 1);
  CHECK(sentences.count(taut::describe(static_cast<Code>(static_cast<int>(last_code) + 1))) == 0);
}

}  // namespace status_test
