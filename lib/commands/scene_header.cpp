#include "lib/commands/scene_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <set>
#include <vector>

#include "lib/files/text.hpp"
#include "lib/kinds/condensed_size.hpp"
#include "taut/estimation/estimator.hpp"

namespace taut::host {
namespace {

using Row = CondensedArrays::Row;

constexpr std::size_t widest = 110;

bool is_letter_or_digit(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

// Keywords, what the standard library or this one own, and macros of common compilers.
bool has_a_meaning(const std::string& word) {
  static const std::set<std::string> words = {"alignas",
                                              "alignof",
                                              "and",
                                              "asm",
                                              "assert",
                                              "auto",
                                              "bitand",
                                              "bitor",
                                              "bool",
                                              "break",
                                              "case",
                                              "catch",
                                              "char",
                                              "class",
                                              "compl",
                                              "concept",
                                              "const",
                                              "constexpr",
                                              "constinit",
                                              "continue",
                                              "decltype",
                                              "default",
                                              "delete",
                                              "do",
                                              "double",
                                              "else",
                                              "enum",
                                              "errno",
                                              "explicit",
                                              "export",
                                              "extern",
                                              "false",
                                              "float",
                                              "for",
                                              "friend",
                                              "goto",
                                              "if",
                                              "import",
                                              "inline",
                                              "int",
                                              "linux",
                                              "long",
                                              "main",
                                              "module",
                                              "mutable",
                                              "namespace",
                                              "new",
                                              "noexcept",
                                              "not",
                                              "nullptr",
                                              "operator",
                                              "or",
                                              "posix",
                                              "private",
                                              "protected",
                                              "public",
                                              "register",
                                              "requires",
                                              "return",
                                              "short",
                                              "signed",
                                              "sizeof",
                                              "static",
                                              "std",
                                              "struct",
                                              "switch",
                                              "taut",
                                              "template",
                                              "this",
                                              "throw",
                                              "true",
                                              "try",
                                              "typedef",
                                              "typeid",
                                              "typename",
                                              "union",
                                              "unix",
                                              "unsigned",
                                              "using",
                                              "virtual",
                                              "void",
                                              "volatile",
                                              "while",
                                              "xor",
                                              "and_eq",
                                              "char8_t",
                                              "char16_t",
                                              "char32_t",
                                              "co_await",
                                              "co_return",
                                              "co_yield",
                                              "const_cast",
                                              "consteval",
                                              "dynamic_cast",
                                              "not_eq",
                                              "or_eq",
                                              "static_cast",
                                              "wchar_t",
                                              "xor_eq",
                                              "static_assert",
                                              "reinterpret_cast",
                                              "thread_local",
                                              "i386",
                                              "arm",
                                              "EOF",
                                              "NULL",
                                              "NAN",
                                              "INFINITY"};
  return words.count(word) > 0;
}

// Printable ASCII as it is, every other byte as an octal escape, so that the literal has the same bytes under
// every compiler; a question mark could be part of a trigraph.
std::string literal(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7F || c == '?') {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\%03o", static_cast<unsigned>(byte));
      quoted += escape.data();
    } else {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += c;
    }
  }
  return quoted + "\"";
}

// Grows lines of a list in braces, none wider than the rest of the file.
class List {
 public:
  explicit List(std::size_t indent) : indent_(indent) {}

  void item(const std::string& text) {
    const bool fits = !text_.empty() && column_ + text.size() + 2 <= widest;
    text_ += fits ? " " : "\n" + std::string(indent_, ' ');
    column_ = (fits ? column_ + 1 : indent_) + text.size() + 1;
    text_ += text + ",";
  }
  /// Without its last comma.
  std::string finished() const { return text_.substr(0, text_.size() - 1); }

 private:
  std::size_t indent_, column_ = 0;
  std::string text_;
};

// A FixedArray: braces for itself, for the array inside, and for what is inside that.
std::string fixed_array(const std::vector<std::string>& items, std::size_t indent) {
  if (items.empty()) return "{}";
  List list(indent + 2);
  for (const std::string& item : items) list.item(item);
  return "{{{" + list.finished() + "}}}";
}

std::string layout(const CableLayout<double>& cable, const std::string& seating) {
  const auto end = [&](std::size_t i) {
    return std::string("::taut::End::") + (cable.ends[i] == End::jacked ? "jacked" : "anchored");
  };
  return "{" + std::string(cable.closed ? "true" : "false") + ", {" + end(0) + ", " + end(1) + "}, " +
         seating + ", " + std::to_string(cable.nodes) + ", " + std::to_string(cable.first_segment) + ", " +
         std::to_string(cable.first_joint) + "}";
}

// Writes the constants of one floating-point type for a capacity that holds the scene.
class Constants {
 public:
  Constants(const ExportedArrays& arrays, const CondensedCounts& capacity, ScalarType scalar)
      : arrays_(arrays.condensed),
        prior_(arrays.prior),
        capacity_(capacity),
        single_(scalar == ScalarType::float32) {}

  std::string condensed() const {
    const CondensedArrays& a = arrays_;
    const std::string cables = type() + " make_cables(" + name() + ") {\n" + this->cables() + "}\n";
    if (!a.level) return cables + linear("make_condensed", a);
    return cables + linear("make_low", a) + lean(*a.level) + "constexpr ::taut::SecondOrder<" + name() +
           ", Capacity> make_condensed(" + name() + ") {\n" + "  return {make_low(" + name() + "()),\n" +
           field("low_by_bar", rows(by_bar(a.level->low_by_bar))) + field("rise", leaning(a.level->rise)) +
           field("bow", leaning(a.level->bow)) + field("lean", "make_lean(" + name() + "())") +
           "          /*target_force*/ " + number(a.level->target_force) + ", /*curve*/ {" +
           number(a.level->curve) + "}};\n}\n";
  }
  std::string struts() const {
    const CondensedArrays& a = arrays_;
    if (!a.level)
      return "constexpr ::taut::CondensedStruts<" + name() + ", Capacity> make_struts(" + name() + ") {\n" +
             "  return " + table(a.struts) + ";\n}\n";
    return "constexpr ::taut::LevelStruts<" + name() + ", Capacity> make_struts(" + name() + ") {\n" +
           "  return {/*low*/ " + leaning({a.struts, a.level->low_strut_by_bar}) + ",\n" +
           field("rise", leaning(a.level->strut_rise)) + field("bow", leaning(a.level->strut_bow)) +
           field("by_push", rows(by_push(a.level->strut_by_push, *a.level))) +
           field("curve", numbers(a.level->strut_curve, 10)) + "          /*count*/ " +
           std::to_string(a.level->struts) + "};\n}\n";
  }
  std::string prior() const {
    const FrictionPriorArrays& k = prior_;
    return "constexpr ::taut::FrictionPrior<" + name() + ", Capacity> make_prior(" + name() + ") {\n" +
           "  return {/*mu*/ " + numbers(k.mu, 10) + ",\n" +
           field("contact_factor", numbers(k.contact_factor, 10)) + field("capstan", truths(k.capstan)) +
           field("mu_sd", scalars(k.mu_sd, 10)) + field("shared", truths(k.shared)) +
           field("scatter", scalars(k.scatter, 10)) + field("seating_sd", scalars(k.seating_sd, 10)) +
           field("drift_sd", scalars(k.drift_sd, 10)) + field("length", scalars(k.length, 10)) +
           "          /*cell*/ " + cells(k.cell) + "};\n}\n";
  }
  std::string strokes() const {
    std::vector<std::string> items;
    for (const StrokeGauge<double>& stroke : prior_.stroke)
      items.push_back("{" + cell(stroke) + ", " + std::to_string(stroke.cable) + ", " +
                      std::to_string(stroke.end) + "}");
    if (items.empty()) return "";
    const std::string list =
        "::taut::FixedArray<::taut::StrokeGauge<" + name() + ">, " + std::to_string(items.size()) + ">";
    return "constexpr " + list + " make_strokes(" + name() + ") {\n  return " + fixed_array(items, 10) +
           ";\n}\n";
  }

 private:
  std::string name() const { return single_ ? "float" : "double"; }
  std::string type() const {
    return "constexpr ::taut::FixedList<::taut::CableLayout<" + name() + ">, Capacity::cables>";
  }
  static std::string count(const Row& row) { return std::to_string(row.size()); }
  std::string linear(const std::string& function, const LinearArrays& a) const {
    return "constexpr ::taut::Condensed<" + name() + ", Capacity> " + function + "(" + name() + ") {\n" +
           "  return {make_cables(" + name() + "()), " + count(a.prestrain) + ", " + count(a.rho) + ", " +
           std::to_string(a.load.size()) + ",\n" + field("coupling", "{" + coupling(a) + "}") +
           field("prestrain", numbers(a.prestrain, 10)) + field("load", rows(a.load)) +
           field("rho", numbers(a.rho, 10)) + field("cos_alpha", scalars(a.cos_alpha, 10)) +
           field("sin_alpha", scalars(a.sin_alpha, 10)) + field("most_force", scalars(a.most_force, 10)) +
           "          /*most_factor*/ " + scalars(a.most_factor, 10) + "};\n}\n";
  }
  std::string lean(const LevelArrays& level) const {
    return "constexpr ::taut::CondensedLean<" + name() + ", Capacity> make_lean(" + name() + ") {\n" +
           "  return {/*bends*/ " + leaning(level.bends) + ",\n" +
           field("kappa_by_bend", numbers(level.kappa_by_bend, 10)) + field("aside", table(asides(level))) +
           field("by_own_lean", numbers(placed(level.by_own_lean, level, 1, 1), 10)) +
           field("own_aside", numbers(placed(level.own_aside, level, level.normals, capacity_.normals), 10)) +
           field("thrust", leaning(level.thrust)) + field("low_thrust", numbers(level.low_thrust, 10)) +
           field("thrust_rise", numbers(level.thrust_rise, 10)) +
           field("thrust_bow", numbers(level.thrust_bow, 10)) +
           field("bends_by_push", rows(by_push(level.bends_by_push, level))) +
           field("aside_by_push", rows(by_push(asides(level.aside_by_push, level), level))) +
           "          /*struts*/ " + std::to_string(level.struts) + ", /*beams*/ " +
           std::to_string(level.beams) + "};\n}\n";
  }
  // CondensedRows.
  static std::string table(const RowsArrays& all) {
    return "{/*load*/ " + rows(all.load) + ",\n" + field("prestrain", numbers(all.prestrain, 10)) +
           "          /*elongation*/ " + rows(all.elongation) + "}";
  }
  // LeaningRows.
  std::string leaning(const LeaningArrays& all) const {
    return "{/*rows*/ " + table(all.rows) + ",\n          /*by_bar*/ " + rows(by_bar(all.by_bar)) + "}";
  }
  // From the bars of the scene, with `given` numbers each, to those of the capacity, with `stride`: segments,
  // struts and beams have their places there.
  Row placed(const Row& row, const LevelArrays& level, int given, int stride) const {
    Row all;
    auto from = row.begin();
    const auto add = [&](int first, int bars) {
      all.resize(static_cast<std::size_t>(first * stride));
      for (int bar = 0; bar < bars; ++bar, from += given) {
        all.insert(all.end(), from, from + given);
        all.resize(all.size() + static_cast<std::size_t>(stride - given));
      }
    };
    add(0, static_cast<int>(arrays_.prestrain.size()));
    add(capacity_.segments, level.struts);
    add(capacity_.segments + capacity_.struts, level.beams);
    return all;
  }
  RowsArrays asides(const LevelArrays& level) const {
    return {asides(level.aside.load, level), asides({level.aside.prestrain}, level).front(),
            asides(level.aside.elongation, level)};
  }
  std::vector<Row> asides(const std::vector<Row>& given, const LevelArrays& level) const {
    std::vector<Row> all;
    for (const Row& row : given) all.push_back(placed(row, level, level.normals, capacity_.normals));
    return all;
  }
  std::vector<Row> by_push(const std::vector<Row>& of, const LevelArrays& level) const {
    std::vector<Row> all;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const std::size_t normals = static_cast<std::size_t>(level.normals), strut = i / normals;
      all.resize(strut * static_cast<std::size_t>(capacity_.normals) + i % normals);
      all.push_back(of[i]);
    }
    return all;
  }
  std::vector<Row> by_bar(const std::vector<Row>& of) const {
    const auto struts = static_cast<std::ptrdiff_t>(arrays_.level->struts);
    std::vector<Row> all(of.begin(), of.begin() + struts);
    if (arrays_.level->beams > 0) all.resize(static_cast<std::size_t>(capacity_.struts));
    all.insert(all.end(), of.begin() + struts, of.end());
    return all;
  }
  static std::string field(const std::string& label, const std::string& value) {
    return "          /*" + label + "*/ " + value + ",\n";
  }

  // Hexadecimal digits give back the very value.
  static std::string number(double value) {
    std::array<char, 40> digits{};
    std::snprintf(digits.data(), digits.size(), "%a", value);
    return digits.data();
  }
  // Of the scene's own scalar type; all that tensions are added up from is double.
  std::string scalar(double value) const { return number(value) + (single_ ? "F" : ""); }
  std::string scalars(const Row& row, std::size_t indent) const {
    std::vector<std::string> items;
    for (const double value : row) items.push_back(scalar(value));
    return fixed_array(items, indent);
  }
  static std::string truths(const std::vector<bool>& row) {
    std::vector<std::string> items;
    for (const bool value : row) items.emplace_back(value ? "true" : "false");
    return fixed_array(items, 10);
  }
  std::string cell(const LoadCell<double>& of) const {
    const std::string zero =
        std::isfinite(of.zero_sd) ? scalar(of.zero_sd) : "::taut::free_zero<" + name() + ">";
    return "{" + scalar(of.sd) + ", " + scalar(of.gain_sd) + ", " + zero + ", " + scalar(of.hysteresis_sd) +
           ", " + scalar(of.up) + ", " + scalar(of.down) + (of.lag > 0 ? ", " + scalar(of.lag) : "") + "}";
  }
  std::string cells(const std::vector<std::array<LoadCell<double>, 2>>& table) const {
    std::vector<std::string> items;
    for (const auto& pair : table) items.push_back("{{" + cell(pair[0]) + ", " + cell(pair[1]) + "}}");
    return fixed_array(items, 10);
  }
  static std::string numbers(const Row& row, std::size_t indent) {
    std::vector<std::string> items;
    for (const double value : row) items.push_back(number(value));
    return fixed_array(items, indent);
  }
  static std::string rows(const std::vector<Row>& table) {
    std::string text;
    for (const Row& row : table)
      text += (text.empty() ? "{{{\n" : ",\n") + std::string(14, ' ') + numbers(row, 14);
    return text.empty() ? "{}" : text + "}}}";
  }
  // Between rigid saddles the diagonal is all there is; otherwise every row is as long as the capacity says.
  std::string coupling(const LinearArrays& of) const {
    Row entries;
    for (std::size_t i = 0; i < of.coupling.size(); ++i) {
      const Row& row = of.coupling[i];
      if (capacity_.has_rigid_saddles()) {
        entries.push_back(row[i]);
        continue;
      }
      entries.insert(entries.end(), row.begin(), row.end());
      if (i + 1 < of.coupling.size()) entries.resize((i + 1) * static_cast<std::size_t>(capacity_.segments));
    }
    return numbers(entries, 10);
  }
  std::string cables() const {
    std::string text = "  ::taut::FixedList<::taut::CableLayout<" + name() + ">, Capacity::cables> cables;\n";
    for (const auto& cable : arrays_.cables)
      text += "  cables.add(" + layout(cable, scalar(cable.seating)) + ");\n";
    return text + "  return cables;\n";
  }

  const CondensedArrays& arrays_;
  const FrictionPriorArrays& prior_;
  const CondensedCounts& capacity_;
  bool single_;
};

// As Estimator counts them.
UnknownCounts unknowns(const ExportedArrays& arrays) {
  const auto is_self_locking = [&](int j) {
    return !(arrays.condensed.rho[static_cast<std::size_t>(j)] > 0);
  };
  UnknownCounts count = count_unknowns(arrays.condensed.cables, is_self_locking, arrays.prior,
                                       static_cast<int>(arrays.condensed.load.size()));
  const auto& strokes = arrays.prior.stroke;
  for (const StrokeGauge<double>& stroke : strokes) count.further += stroke.unknowns();
  // Every gauge has a place, with unknowns or without.
  count.further = std::max(count.further, static_cast<int>(strokes.size()));
  return count;
}

std::string space_of(const ExportedScene& scene) { return identifier(scene.description.name); }

std::string sizes(const CondensedCounts& counts, ScalarType scalar) {
  const CondensedSize size = condensed_size(counts, scalar);
  return std::string(scalar == ScalarType::float32 ? "float" : "double") + ": " + std::to_string(size.scene) +
         " bytes of flash" +
         (size.strut_rows > 0 ? ", " + std::to_string(size.strut_rows) + " more for strut forces" : "") +
         "; the tracker takes " + std::to_string(size.tracker) + " bytes of RAM";
}

std::string head(const std::vector<ExportedScene>& scenes, const CondensedCounts& capacity,
                 bool has_strokes) {
  std::string text;
  if (scenes.size() == 1) {
    text = "// The scene " + literal(scenes[0].description.name) +
           " after static condensation, written by `taut export`: do not edit.\n";
  } else {
    text =
        "// Scenes after static condensation with one Capacity, so that one Tracker or Estimator serves them "
        "all;\n"
        "// written by `taut export`: do not edit.\n//\n";
    for (const ExportedScene& scene : scenes)
      text += "// - " + literal(scene.description.name) + ": namespace " + space_of(scene) + "\n";
  }
  const std::string each = scenes.size() == 1 ? "" : ", flash for each scene";
  return text +
         "//\n"
         "// What is not used takes no room. About, where pointers have 64 bits" +
         each + ":\n// " + sizes(capacity, ScalarType::float32) + ".\n// " +
         sizes(capacity, ScalarType::float64) +
         ".\n"
         "#pragma once\n"
         "\n"
         "#ifndef TAUT_DEVICE_HPP\n"
         "#if __has_include(\"taut/device.hpp\")\n"
         "#include \"taut/condensation/" +
         (capacity.leans() ? "second_order" : "condensed") + ".hpp\"\n" +
         (has_strokes ? "#include \"taut/estimation/gauges.hpp\"\n" : "") +
         "#include \"taut/estimation/friction_prior.hpp\"\n"
         "#else\n"
         "#include \"taut_device.hpp\"  // taut in one header\n"
         "#endif\n"
         "#endif\n";
}

// What only an estimator needs to know.
struct EstimatedParts {
  bool strokes = false, seating = false, lags = false;
};

// What none of the scenes has.
std::string has_not(const CondensedCounts& counts, const EstimatedParts& has) {
  std::string names;
  const auto add = [&](const char* name, bool any) {
    if (!any) names += (names.empty() ? "" : ", ") + std::string(name) + " = false";
  };
  add("hoops", counts.hoops);
  add("prestrain", counts.prestrain);
  add("smooth", counts.smooth);
  add("strokes", has.strokes);
  add("seating", has.seating);
  add("lags", has.lags);
  return names.empty() ? "" : "  static constexpr bool " + names + ";\n";
}

std::string capacity_of(const CondensedCounts& counts, const EstimatedParts& has) {
  const auto is = [](const char* name, int count) {
    return std::string(name) + " = " + std::to_string(count);
  };
  return "struct Capacity : ::taut::Capacity {\n"
         "  static constexpr int " +
         is("nodes", 0) + ", " + is("struts", counts.struts) + ", " + is("cables", counts.cables) + ", " +
         is("jacks", counts.jacks) + ", " + is("spans", counts.spans) + ", " +
         is("segments", counts.segments) + ", " + is("joints", counts.joints) + ", " +
         is("substructures", counts.substructures) + ", " + is("loads", counts.loads) +
         (counts.leans() ? ", " + is("beams", counts.beams) + ", " + is("normals", counts.normals) : "") +
         ";\n" + (counts.saddles ? "  static constexpr bool saddles = true;\n" : "") + has_not(counts, has) +
         "};\n";
}

// A list of names that costs nothing unless it is used.
std::string list_of_names(const std::string& comment, const std::string& size, const std::string& name,
                          const std::vector<std::string>& names) {
  std::vector<std::string> literals;
  for (const std::string& each : names) literals.push_back(literal(each));
  return "/// " + comment + "\ninline constexpr ::taut::FixedArray<const char*, " + size + "> " + name +
         " = " + fixed_array(literals, 2) + ";\n";
}

std::string names(const SceneDescription& scene) {
  std::vector<std::string> cables, loads, nodes;
  for (const LoadDescription& load : scene.loads) loads.push_back(load.name);
  for (const CableDescription& cable : scene.cables) {
    cables.push_back(cable.name);
    for (std::size_t j = 0; j < cable.joints(); ++j)
      nodes.push_back(scene.nodes[static_cast<std::size_t>(cable.path[cable.closed ? j : j + 1])].name);
  }
  return "/// Names, by the numbers that samples, responses and statuses use.\nnamespace names {\n\n" +
         list_of_names("Cables, as in Sample::jack.", "Capacity::cables", "cables", cables) +
         list_of_names("Load patterns, as in Sample::factor.", "Capacity::loads", "loads", loads) +
         list_of_names("The nodes at which the joints lie.", "Capacity::joints", "joint_nodes", nodes) +
         "\n}  // namespace names\n";
}

bool has_lags(const SceneDescription& scene) {
  bool any = false;
  for (const CableDescription& cable : scene.cables) {
    for (const InstrumentDescription& cell : cable.cell) any |= cell.lag > 0;
    for (const InstrumentDescription& force : cable.force) any |= force.lag > 0;
  }
  for (const StrutDescription& strut : scene.struts) any |= strut.gauge.lag > 0;
  return any;
}

// What all scenes of a header have in common.
struct Shared {
  explicit Shared(const std::vector<ExportedScene>& scenes)
      : is_one(scenes.size() == 1), space(space_of(scenes[0])) {
    std::optional<CondensedCounts> most;
    for (const ExportedScene& scene : scenes) {
      for (const ExportedArrays* arrays : {&scene.in_float, &scene.in_double}) {
        if (!arrays->condensed.condensing.status) continue;
        const CondensedCounts counts = condensed_counts(scene.description, arrays->condensed);
        most = most ? larger(*most, counts) : counts;
      }
      for (const UnknownCounts& count : {unknowns(scene.in_float), unknowns(scene.in_double)}) {
        most_unknowns.carried = std::max(most_unknowns.carried, count.carried);
        most_unknowns.further = std::max(most_unknowns.further, count.further);
      }
      has.strokes |= !scene.in_double.prior.stroke.empty();
      for (const double sd : scene.in_double.prior.seating_sd) has.seating |= sd > 0;
      has.lags |= has_lags(scene.description);
    }
    capacity = most.value_or(CondensedCounts{});
  }

  bool is_one;
  std::string space;  // of the first scene, where the capacity is
  CondensedCounts capacity;
  UnknownCounts most_unknowns = {1, 0};
  EstimatedParts has;
};

std::string capacity(const ExportedScene& scene, const Shared& shared) {
  if (shared.is_one)
    return "/// Fits the condensed scene exactly.\n" + capacity_of(shared.capacity, shared.has);
  if (space_of(scene) == shared.space)
    return "/// Holds every scene of this header.\n" + capacity_of(shared.capacity, shared.has);
  return "/// The same for every scene of this header.\nusing Capacity = ::" + shared.space + "::Capacity;\n";
}

std::string constants(const ExportedScene& scene, const CondensedCounts& capacity, bool has_struts) {
  std::string text;
  for (const ScalarType scalar : {ScalarType::float32, ScalarType::float64}) {
    const ExportedArrays& arrays = scalar == ScalarType::float32 ? scene.in_float : scene.in_double;
    if (!arrays.condensed.condensing.status) continue;
    const Constants written(arrays, capacity, scalar);
    text += written.condensed() + (has_struts ? written.struts() : "") + written.prior() + written.strokes() +
            "\n";
  }
  return text;
}

std::string objects(const Shared& shared) {
  return "/// The scene for Tracker and Estimator, as condensed<float> or condensed<double>.\n"
         "template <class Scalar>\n"
         "inline constexpr ::taut::" +
         std::string(shared.capacity.leans() ? "SecondOrder" : "Condensed") +
         "<Scalar, Capacity> condensed = "
         "detail::make_condensed(Scalar());\n\n"
         "/// What is known of friction and load cells, for Estimator. Where the scene has no mu_sd it is "
         "half of the mean mu.\n"
         "/// Of a jack that the scene does not say to be exact, an ordinary cell is taken, at an anchored "
         "end only one whose sd it says.\n"
         "template <class Scalar>\n"
         "inline constexpr ::taut::FrictionPrior<Scalar, Capacity> prior = "
         "detail::make_prior(Scalar());\n\n"
         "/// The Parameters of an Estimator of " +
         std::string(shared.is_one ? "this scene" : "every scene of this header") +
         ".\n"
         "constexpr int unknowns = " +
         std::to_string(shared.most_unknowns.carried) + ";\n" +
         "/// And its Further: unknowns of load cells at anchored ends" +
         (shared.has.strokes ? ", and strokes" : "") +
         ".\n"
         "constexpr int reading_unknowns = " +
         std::to_string(shared.most_unknowns.further) + ";\n\n";
}

std::string strut_objects(std::size_t struts, const Shared& shared) {
  std::string text;
  if (!shared.is_one)
    text +=
        "/// How many struts this scene has; the capacity may have room for more.\n"
        "constexpr int strut_count = " +
        std::to_string(struts) + ";\n\n";
  if (struts > 0)
    text +=
        "/// The rows that give strut forces, for Tracker::respond().\n"
        "template <class Scalar>\n"
        "inline constexpr ::taut::" +
        std::string(shared.capacity.leans() ? "LevelStruts" : "CondensedStruts") +
        "<Scalar, Capacity> struts = "
        "detail::make_struts(Scalar());\n\n";
  return text;
}

std::string stroke_objects(const ExportedScene& scene) {
  const std::size_t count = scene.in_double.prior.stroke.size();
  if (count == 0) return "";
  return "/// The strokes of jacks that are measurements, for start() and take_stroke() of Estimator.\n"
         "template <class Scalar>\n"
         "inline constexpr ::taut::FixedArray<::taut::StrokeGauge<Scalar>, " +
         std::to_string(count) + "> strokes = detail::make_strokes(Scalar());\n\n";
}

std::string namespace_of(const ExportedScene& scene, const Shared& shared) {
  const std::size_t struts = scene.description.struts.size();
  return "namespace " + space_of(scene) + " {\n\n" + capacity(scene, shared) + "\nnamespace detail {\n\n" +
         constants(scene, shared.capacity, struts > 0) + "}  // namespace detail\n\n" + objects(shared) +
         strut_objects(struts, shared) + stroke_objects(scene) + names(scene.description) +
         "\n}  // namespace " + space_of(scene) + "\n";
}

}  // namespace

std::string identifier(const std::string& name) {
  std::string word;
  for (const char c : name) {
    if (is_letter_or_digit(c))
      word += c;
    else if (!word.empty() && word.back() != '_')
      word += '_';
  }
  if (!word.empty() && word.back() == '_') word.pop_back();
  const bool starts_with_digit = !word.empty() && word[0] >= '0' && word[0] <= '9';
  if (word.empty()) return "scene";
  return starts_with_digit || has_a_meaning(word) ? "scene_" + word : word;
}

std::string scene_header(const std::vector<ExportedScene>& scenes) {
  const Shared shared(scenes);
  std::string text = head(scenes, shared.capacity, shared.has.strokes);
  for (const ExportedScene& scene : scenes) text += "\n" + namespace_of(scene, shared);
  return text;
}

}  // namespace taut::host
