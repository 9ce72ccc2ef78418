// Pieces of HTML and SVG whose tags are balanced and whose texts cannot break out of them.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace taut::host {

using Attributes = std::initializer_list<std::pair<const char*, std::string>>;

inline constexpr const char* en_dash = "\u2013";

/// Text with everything replaced that HTML would not take for text; broken UTF-8 and control characters too.
std::string escaped(std::string_view text);

/// An element; attribute values are escaped, the content is not.
std::string element(const char* name, const Attributes& attributes, const std::string& content = "");

/// An element without content or end tag, as `<meta/>`.
std::string void_element(const char* name, const Attributes& attributes);

/// Text for between the quotes of a string of a style sheet.
std::string css_string(std::string_view text);

/// `look` is the class; the content is HTML.
std::string paragraph(const char* look, const std::string& html);
/// Of a section.
std::string heading(const std::string& text);

/// The text, or its beginning and an ellipsis if it is longer than so many characters.
std::string shortened(const std::string& text, std::size_t most);

}  // namespace taut::host
