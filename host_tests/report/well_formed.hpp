// Whether a page is well-formed: a strict reader of the little XML that reports are made of.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

/// What is wrong with a page; empty if nothing is.
class WellFormed {
 public:
  explicit WellFormed(std::string_view page) : rest_(page) {}

  std::string operator()() {
    constexpr std::string_view doctype = "<!DOCTYPE html>\n";
    if (rest_.substr(0, doctype.size()) != doctype) return "no doctype";
    rest_.remove_prefix(doctype.size());
    while (problem_.empty() && !rest_.empty()) step();
    if (problem_.empty() && !open_.empty()) problem_ = "not closed: " + open_.back();
    return problem_;
  }

 private:
  void step() {
    const std::string_view text = rest_.substr(0, rest_.find('<'));
    check_text(text);
    rest_.remove_prefix(text.size());
    if (rest_.empty()) return;
    const std::size_t end = rest_.find('>');
    if (end == std::string_view::npos) return fail("a tag without an end");
    const std::string_view tag = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    if (tag.substr(0, 1) == "/") return close(std::string(tag.substr(1)));
    const bool is_void = tag.back() == '/';
    const std::string name(tag.substr(0, tag.find_first_of(" /")));
    check_attributes(tag.substr(name.size(), tag.size() - name.size() - (is_void ? 1 : 0)));
    if (is_void) return;
    open_.push_back(name);
    // Browsers do not look for tags and entities in these.
    if (name == "style" || name == "script") rest_.remove_prefix(std::min(rest_.find('<'), rest_.size()));
  }

  void close(const std::string& name) {
    if (open_.empty() || open_.back() != name) return fail("closed, but not open: " + name);
    open_.pop_back();
  }

  // ` key="value"` again and again.
  void check_attributes(std::string_view text) {
    while (!text.empty()) {
      const std::size_t equal = text.find("=\"");
      if (text[0] != ' ' || equal == std::string_view::npos) return fail("attribute: " + std::string(text));
      const std::size_t end = text.find('"', equal + 2);
      if (end == std::string_view::npos) return fail("attribute without an end: " + std::string(text));
      check_text(text.substr(equal + 2, end - equal - 2));
      text.remove_prefix(end + 1);
    }
  }

  void check_text(std::string_view text) {
    if (text.find('>') != std::string_view::npos) fail("a bare >: " + std::string(text));
    for (std::size_t at = text.find('&'); at != std::string_view::npos; at = text.find('&', at + 1)) {
      const std::string_view entity = text.substr(at, text.find(';', at) - at + 1);
      if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;")
        fail("entity: " + std::string(entity));
    }
  }

  void fail(const std::string& what) {
    if (problem_.empty()) problem_ = what;
  }

  std::string_view rest_;
  std::vector<std::string> open_;
  std::string problem_;
};
