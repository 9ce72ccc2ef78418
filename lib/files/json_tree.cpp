#include "lib/files/json_tree.hpp"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_set>
#include <utility>

#include "lib/files/input_error.hpp"
#include "lib/files/number_range.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

constexpr std::size_t deepest = 16;           // a scene has 5 levels; bounds the recursion of destructors
constexpr std::size_t most_values = 1000000;  // the largest scene has fewer than 200000

// `line 3, column 7` of a byte of the text.
std::string line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t newline = before.rfind('\n');
  const std::size_t column = newline == std::string_view::npos ? before.size() : before.size() - newline - 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column + 1);
}

// The part of the line around a byte of the text, for a message.
std::string surroundings(std::string_view text, std::size_t offset) {
  constexpr std::size_t before = 32, after = 12;
  const std::size_t newline = text.substr(0, offset).rfind('\n');
  std::size_t begin =
      std::max(newline == std::string_view::npos ? 0 : newline + 1, offset - std::min(offset, before));
  const std::size_t end = std::min({text.find('\n', offset), offset + after, text.size()});
  while (begin < end && text[begin] == ' ') ++begin;
  return quote(text.substr(begin, end - begin));
}

// Receives the parser's events and grows the tree; stops the parser by returning false, with `error` set.
class TreeBuilder {
 public:
  TreeBuilder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  JsonValue root;
  std::optional<InputError> error;

  bool null() { return add(JsonValue::Kind::null) != nullptr; }
  bool boolean(bool value) {
    JsonValue* added = add(JsonValue::Kind::boolean);
    if (added != nullptr) added->boolean = value;
    return added != nullptr;
  }
  bool number_integer(std::int64_t value) { return number(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) { return number(static_cast<double>(value)); }
  bool number_float(double value, const std::string&) { return number(value); }
  bool string(std::string& value) {
    JsonValue* added = add(JsonValue::Kind::string);
    if (added != nullptr) added->text = std::move(value);
    return added != nullptr;
  }
  bool binary(std::vector<std::uint8_t>&) { return false; }  // does not occur in text

  bool start_object(std::size_t) { return open(JsonValue::Kind::object); }
  bool end_object() { return close(); }
  bool start_array(std::size_t) { return open(JsonValue::Kind::array); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    Frame& frame = open_.back();
    if (!frame.seen.insert(name).second) {
      return stop(place() + pointer_step(name), "the key " + quote(name) + " comes twice",
                  "keep one of the two");
    }
    frame.value->keys.push_back(std::move(name));
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token, const std::exception& reason) {
    const std::size_t offset = position == 0 ? 0 : position - 1;
    const std::string where = line_and_column(text_, offset);
    const auto* known = dynamic_cast<const nlohmann::json::exception*>(&reason);
    if (known != nullptr && known->id == number_overflow) {
      return stop(where, "the number " + quote(token) + " is too large",
                  "write one of at most " + plain(largest_input) + " in size");
    }
    if (text_.find_first_not_of(" \t\r\n") == std::string_view::npos) {
      return stop(where, "the file is empty", "write a scene: { \"taut\": 1, ... }");
    }
    if (!is_utf8(text_)) return stop(where, "the text is not UTF-8", "save the file as UTF-8");
    if (offset >= text_.size()) {
      return stop(where, "the file ends too early", "close every bracket, brace, quote and comment");
    }
    return stop(where, "JSON syntax error in " + surroundings(text_, offset),
                "look for a missing or an extra comma, quote or bracket at or before it");
  }

 private:
  static constexpr int number_overflow = 406;  // as the parser numbers its errors

  struct Frame {
    JsonValue* value;
    std::unordered_set<std::string> seen;
  };

  bool stop(const std::string& where, const std::string& problem, const std::string& remedy) {
    error.emplace(file_, where, problem, remedy);
    return false;
  }

  // JSON pointer of the innermost open container.
  std::string place() const {
    std::string pointer;
    for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
      const JsonValue& value = *open_[i].value;
      pointer += value.kind == JsonValue::Kind::object ? pointer_step(value.keys.back())
                                                       : "/" + std::to_string(value.items.size() - 1);
    }
    return pointer;
  }

  JsonValue* add(JsonValue::Kind kind) {
    if (++values_ > most_values) {
      stop(place(), "the file holds more than " + std::to_string(most_values) + " values",
           "check that it is a scene");
      return nullptr;
    }
    JsonValue* added = open_.empty() ? &root : &open_.back().value->items.emplace_back();
    added->kind = kind;
    return added;
  }

  bool number(double value) {
    JsonValue* added = add(JsonValue::Kind::number);
    if (added != nullptr) added->number = value;
    return added != nullptr;
  }

  bool open(JsonValue::Kind kind) {
    JsonValue* added = add(kind);
    if (added == nullptr) return false;
    open_.push_back({added, {}});
    if (open_.size() > deepest) {
      return stop("", "brackets are nested more than " + std::to_string(deepest) + " deep",
                  "check that it is a scene");
    }
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  std::string_view text_;
  const std::string& file_;
  std::vector<Frame> open_;  // the innermost one last; a parent does not grow while a child is open
  std::size_t values_ = 0;
};

}  // namespace

JsonValue parse_json(std::string_view text, const std::string& file) {
  TreeBuilder builder(text, file);
  const bool comments_allowed = true;
  const bool whole = nlohmann::json::sax_parse(text.begin(), text.end(), &builder,
                                               nlohmann::json::input_format_t::json, true, comments_allowed);
  if (!whole) throw *builder.error;
  return std::move(builder.root);
}

}  // namespace taut::host
