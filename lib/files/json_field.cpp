#include "lib/files/json_field.hpp"

#include <algorithm>
#include <cmath>

#include "lib/files/input_error.hpp"
#include "lib/files/number_range.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

// What a value is, in words: `the string "abc"`.
std::string shown(const JsonValue& value) {
  switch (value.kind) {
    case JsonValue::Kind::null:
      return "null";
    case JsonValue::Kind::boolean:
      return value.boolean ? "true" : "false";
    case JsonValue::Kind::number:
      return "the number " + plain(value.number);
    case JsonValue::Kind::string:
      return "the string " + quote(value.text);
    case JsonValue::Kind::array:
      return "a list";
    case JsonValue::Kind::object:
      return "an object";
  }
  return "a value";
}

}  // namespace

void Field::refuse(const std::string& problem, const std::string& remedy) const {
  throw InputError(*file_, place_.empty() ? "top level" : place_, problem, remedy);
}

void Field::require(JsonValue::Kind kind, const std::string& meaning) const {
  if (value_->kind != kind) refuse("found " + shown(*value_), "write " + meaning);
}

double Field::number(const std::string& meaning) const {
  require(JsonValue::Kind::number, meaning);
  if (std::fabs(value_->number) > largest_input)
    refuse("the number " + plain(value_->number) + " is too large",
           "write one of at most " + plain(largest_input) + " in size");
  return value_->number;
}

double Field::amount(const std::string& meaning) const {
  const double found = number(meaning);
  if (found > 0 && found < smallest_amount)
    refuse("the number " + plain(found) + " is too small", "write one of at least " + plain(smallest_amount));
  return found;
}

bool Field::boolean(const std::string& meaning) const {
  require(JsonValue::Kind::boolean, meaning);
  return value_->boolean;
}

const std::string& Field::text(const std::string& meaning) const {
  require(JsonValue::Kind::string, meaning);
  return value_->text;
}

Field Field::child(std::size_t i) const {
  const std::string step = is_object() ? pointer_step(value_->keys[i]) : "/" + std::to_string(i);
  return {value_->items[i], place_ + step, *file_};
}

std::vector<Field> Field::elements(const std::string& meaning) const {
  require(JsonValue::Kind::array, meaning);
  std::vector<Field> all;
  all.reserve(value_->items.size());
  for (std::size_t i = 0; i < value_->items.size(); ++i) all.push_back(child(i));
  return all;
}

std::vector<Field::Member> Field::members(const std::string& meaning) const {
  require(JsonValue::Kind::object, meaning);
  std::vector<Member> all;
  all.reserve(value_->items.size());
  for (std::size_t i = 0; i < value_->items.size(); ++i) all.push_back({value_->keys[i], child(i)});
  return all;
}

void Field::require_head(const std::string& kind, const std::string& example, const Keys& keys) const {
  constexpr int format_version = 1;
  if (!is_object()) members("a " + kind + ": " + example);
  // The version first: all that follows may differ in another one.
  if (const auto version = find("taut")) {
    const double found = version->number("1, the version of the format");
    if (found != format_version)
      version->refuse("version " + plain(found) + " of the format is not known",
                      "write a " + kind + " of version 1");
  }
  require_keys(keys, "");
}

void Field::require_keys(const Keys& keys, const std::string& meaning) const {
  require(JsonValue::Kind::object, meaning);
  for (std::size_t i = 0; i < value_->keys.size(); ++i) {
    const std::string& found = value_->keys[i];
    if (std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return found == key.name; })) continue;
    std::vector<std::string> known;
    for (const Key& key : keys) known.emplace_back(key.name);
    child(i).refuse("unknown key " + quote(found), suggestion(found, known, "the keys here are"));
  }
  for (const Key& key : keys) {
    if (!key.required || find(key.name)) continue;
    refuse("the key " + quote(key.name) + " is missing", "add " + quote(key.name) + ": " + key.meaning);
  }
}

std::optional<Field> Field::find(const char* key) const {
  const auto found = std::find(value_->keys.begin(), value_->keys.end(), key);
  if (found == value_->keys.end()) return std::nullopt;
  return child(static_cast<std::size_t>(found - value_->keys.begin()));
}

Field Field::at(const char* key) const { return find(key).value(); }

}  // namespace taut::host
