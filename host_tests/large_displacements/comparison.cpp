#include "large_displacements/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace large_displacements {

Table table_of(const std::string& text) {
  Table table;
  std::vector<std::string> header;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::vector<std::string> row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    if (header.empty()) {
      header = row;
      continue;
    }
    for (std::size_t i = 0; i < header.size(); ++i) table[header[i]].push_back(i < row.size() ? row[i] : "");
  }
  return table;
}

namespace {

/// C.T1, strut2, C.end.extension, C.slip3, node.x; empty for others.
std::string kind_of(const std::string& column) {
  const auto last = column.rfind('.');
  const std::string word = last == std::string::npos ? column : column.substr(last + 1);
  const auto numbered = [&](const std::string& stem) {
    return word.size() > stem.size() && word.compare(0, stem.size(), stem) == 0 &&
           std::all_of(word.begin() + static_cast<std::ptrdiff_t>(stem.size()), word.end(),
                       [](char c) { return c >= '0' && c <= '9'; });
  };
  if (last == std::string::npos) return numbered("strut") ? "struts" : "";
  if (word == "payout") return "payouts";
  if (word == "x" || word == "y" || word == "z") return "displacements";
  return numbered("T") ? "segments" : numbered("slip") ? "slips" : "";
}

}  // namespace

std::vector<Difference> compare(const std::string& result, const std::string& reference, double until) {
  const Table found = table_of(result), expected = table_of(reference);
  std::vector<Difference> differences;
  for (const char* kind : {"segments", "struts", "payouts", "slips", "displacements"}) {
    Difference worst;
    worst.kind = kind;
    double most = 0;
    for (const auto& [column, values] : expected) {
      const auto other = found.find(column);
      if (kind_of(column) != kind || other == found.end()) continue;
      for (std::size_t row = 0; row < std::min(values.size(), other->second.size()); ++row) {
        if (std::stod(expected.at("time")[row]) > until) break;
        const double right = std::stod(values[row]), off = std::fabs(std::stod(other->second[row]) - right);
        worst.largest = std::max(worst.largest, std::fabs(right));
        if (!(off > most)) continue;
        most = off;
        worst.column = column;
        worst.time = std::stod(expected.at("time")[row]);
      }
    }
    if (worst.largest > 0) worst.part = most / worst.largest;
    if (worst.largest > 0) differences.push_back(worst);
  }
  return differences;
}

double end_difference(const std::string& message, const std::string& reference, const std::string& log) {
  const auto load_in = [](const std::string& text) {
    const std::string jack = "C.end ";
    const auto at = text.find(jack);
    return at == std::string::npos ? 0.0 : std::stod(text.substr(at + jack.size()));
  };
  const double load = load_in(message), expected = load_in(reference);
  if (load <= 0 && expected <= 0) return -1;
  double most = 0;
  const Table rows = table_of(log);
  for (const std::string& force : rows.at("C.end")) most = std::max(most, std::stod(force));
  return std::fabs((load > 0 ? load : most) / (expected > 0 ? expected : most) - 1);
}

namespace {

/// One scene of random.cmake: rows that came of it, and differences.
struct Followed {
  int rows = 0, reference_rows = 0;
  std::map<std::string, std::map<std::string, double>> parts;  ///< "target" or "within", then the kind
};

std::string per_cent(double part) {
  std::ostringstream text;
  text.precision(2);
  text << 100 * part;
  return text.str();
}

}  // namespace

std::string summary(const std::string& lines) {
  constexpr int rows_to_target = 40;
  std::map<std::string, std::vector<Followed>> kinds;
  Followed* scene = nullptr;
  std::string kind;
  std::istringstream all(lines);
  for (std::string line; std::getline(all, line);) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    if (first == "scene") {
      // random-7-hoop-1-closed
      kind = second.substr(second.find('-', second.find('-') + 1) + 1);
      kinds[kind].emplace_back();
      scene = &kinds[kind].back();
    } else if (scene != nullptr && first == "reference") {
      words >> scene->reference_rows;
    } else if (scene != nullptr && first == "taut") {
      words >> scene->rows;
    } else if (scene != nullptr) {
      words >> scene->parts[first][second];
    }
  }
  for (const auto& [name, scenes] : std::map(kinds))
    kinds["~all"].insert(kinds["~all"].end(), scenes.begin(), scenes.end());

  std::ostringstream text;
  for (const char* until : {"target", "within"}) {
    text << "\n| " << until
         << " | scenes | both to the target | neither begins | taut ends earlier | later | segments | struts "
            "| extension | displacements |\n|";
    for (int i = 0; i < 10; ++i) text << " --- |";
    text << "\n";
    for (const auto& [name, scenes] : kinds) {
      const auto count = [&list = scenes](const auto& is) {
        return std::count_if(list.begin(), list.end(), is);
      };
      text << "| " << name << " | " << scenes.size() << " | " << count([](const Followed& each) {
        return each.rows >= rows_to_target && each.reference_rows >= rows_to_target;
      }) << " | "
           << count([](const Followed& each) { return each.rows == 0 && each.reference_rows == 0; }) << " | "
           << count([](const Followed& each) { return each.rows < each.reference_rows; }) << " | "
           << count([](const Followed& each) { return each.rows > each.reference_rows; }) << " |";
      for (const char* what : {"segments", "struts", "payouts", "displacements"}) {
        std::vector<double> parts;
        for (const Followed& each : scenes) {
          const auto found = each.parts.find(until);
          if (found != each.parts.end() && found->second.count(what) > 0)
            parts.push_back(found->second.at(what));
        }
        std::sort(parts.begin(), parts.end());
        if (parts.empty())
          text << " |";
        else
          text << " " << per_cent(parts.back()) << " / " << per_cent(parts[parts.size() * 95 / 100]) << " |";
      }
      text << "\n";
    }
  }
  return text.str();
}

}  // namespace large_displacements
