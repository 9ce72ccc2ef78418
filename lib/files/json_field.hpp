// A value of a JSON file together with its place, so that whatever is wrong with it can be said exactly.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lib/files/json_tree.hpp"

namespace taut::host {

/// A key that an object may or must have, and what belongs there, for messages.
struct Key {
  const char* name;
  bool required;
  const char* meaning;
};
using Keys = std::vector<Key>;

/// A view of a value; the tree and the file name must outlive it. Every function that asks for a kind of
/// value throws InputError if it finds another.
class Field {
 public:
  Field(const JsonValue& value, std::string place, const std::string& file)
      : value_(&value), place_(std::move(place)), file_(&file) {}

  /// Throws InputError at this place.
  [[noreturn]] void refuse(const std::string& problem, const std::string& remedy) const;

  /// JSON pointer.
  const std::string& place() const { return place_; }

  /// Of at most `largest_input` in size.
  double number(const std::string& meaning) const;
  /// A number that is at least `smallest_amount` if it is greater than zero.
  double amount(const std::string& meaning) const;
  bool boolean(const std::string& meaning) const;
  const std::string& text(const std::string& meaning) const;

  /// Elements of an array.
  std::vector<Field> elements(const std::string& meaning) const;
  /// Values of an object in the order of the file, with their keys.
  struct Member;
  std::vector<Member> members(const std::string& meaning) const;

  bool is_null() const { return value_->kind == JsonValue::Kind::null; }
  bool is_number() const { return value_->kind == JsonValue::Kind::number; }
  bool is_array() const { return value_->kind == JsonValue::Kind::array; }
  bool is_object() const { return value_->kind == JsonValue::Kind::object; }

  /// Refuses an object that has a key beside `keys` or lacks a required one.
  void require_keys(const Keys& keys, const std::string& meaning) const;
  /// Of a whole file, which is `kind`, as in `goal`, and looks like `example`: refuses what is no object, is
  /// of another version of the format, or has other keys.
  void require_head(const std::string& kind, const std::string& example, const Keys& keys) const;
  /// The value at a key of an object, if there is one.
  std::optional<Field> find(const char* key) const;
  /// The value at a key that is there.
  Field at(const char* key) const;

 private:
  void require(JsonValue::Kind kind, const std::string& meaning) const;
  Field child(std::size_t i) const;

  const JsonValue* value_;
  std::string place_;
  const std::string* file_;
};

struct Field::Member {
  std::string key;
  Field value;
};

}  // namespace taut::host
