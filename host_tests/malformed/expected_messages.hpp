// The table of malformed files and the message that each must get.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

/// Messages by file name, out of a table with one message a line: a message begins with its file.
inline std::map<std::string, std::string> expected_messages(const std::filesystem::path& folder) {
  std::map<std::string, std::string> messages;
  std::ifstream table(folder / "expected.txt");
  for (std::string line; std::getline(table, line);) messages[line.substr(0, line.find(": "))] = line;
  return messages;
}

/// Names of the files with this ending.
inline std::set<std::string> files_in(const std::filesystem::path& folder, const std::string& extension) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == extension) names.insert(entry.path().filename().string());
  }
  return names;
}
