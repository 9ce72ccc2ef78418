// Runs the program taut and keeps what it says.
#pragma once

#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder that goes away with the test, also where a browser that was just killed still writes into it.
struct Scratch {
  std::filesystem::path path;
  Scratch() {
    std::string name = (std::filesystem::temp_directory_path() / "taut.XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path = name;
  }
  ~Scratch() {
    std::error_code failed;
    for (int attempt = 0; attempt < 100; ++attempt) {
      std::filesystem::remove_all(path, failed);
      if (!failed) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  /// Path of a file in the folder, in quotes for the shell.
  std::string quoted(const std::string& file) const { return "'" + (path / file).string() + "'"; }
};

struct Outcome {
  int status = -1;  ///< exit status; -1 if the program was killed
  std::string out, err;
};

/// Runs a program with the arguments, by a shell that has run `before`.
inline Outcome run_program(const Scratch& scratch, const std::string& program, const std::string& arguments,
                           const std::string& before = "true") {
  const std::string command = before + " && exec '" + program + "' " + arguments + " > " +
                              scratch.quoted("out") + " 2> " + scratch.quoted("err");
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(scratch.path / "out"),
          text_of(scratch.path / "err")};
}

#ifdef TAUT_PROGRAM
/// The same of taut; TAUT_PROGRAM is its path.
inline Outcome run_taut(const Scratch& scratch, const std::string& arguments,
                        const std::string& before = "true") {
  return run_program(scratch, TAUT_PROGRAM, arguments, before);
}
#endif
