#include "lib/report/html.hpp"

#include "lib/files/text.hpp"

namespace taut::host {
namespace {

constexpr const char* replacement = "\xEF\xBF\xBD";  // U+FFFD
constexpr const char* ellipsis = "\xE2\x80\xA6";

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string opened(const char* name, const Attributes& attributes) {
  std::string tag = std::string("<") + name;
  for (const auto& [key, value] : attributes) tag += std::string(" ") + key + "=\"" + escaped(value) + "\"";
  return tag;
}

}  // namespace

std::string escaped(std::string_view text) {
  const bool is_broken = !is_utf8(text);
  std::string safe;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '"') {
      safe += "&quot;";
    } else if (c == '\n' || c == '\t') {
      safe += ' ';
    } else if (byte < 0x20 || byte == 0x7F || (is_broken && byte >= 0x80)) {
      safe += replacement;
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string css_string(std::string_view text) {
  constexpr const char* digits = "0123456789abcdef";
  std::string safe;
  for (const char c : is_utf8(text) ? text : std::string_view()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = byte >= 0x80 || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                          (c >= 'A' && c <= 'Z') || c == ' ' || c == '.' || c == ',';
    if (is_plain)
      safe += c;
    else
      safe += std::string("\\") + digits[byte >> 4] + digits[byte & 0xF] + ' ';
  }
  return safe;
}

std::string element(const char* name, const Attributes& attributes, const std::string& content) {
  return opened(name, attributes) + ">" + content + "</" + name + ">";
}

std::string void_element(const char* name, const Attributes& attributes) {
  return opened(name, attributes) + "/>";
}

std::string shortened(const std::string& text, std::size_t most) {
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (continues(text[i]) || ++characters <= most) continue;
    std::size_t cut = i;
    while (cut > 0 && continues(text[--cut])) {
    }
    return text.substr(0, cut) + ellipsis;
  }
  return text;
}

std::string paragraph(const char* look, const std::string& html) {
  return element("p", {{"class", look}}, html);
}
std::string heading(const std::string& text) { return element("h2", {}, escaped(text)); }

}  // namespace taut::host
