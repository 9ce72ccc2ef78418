// The rows of a result that are asked for, as a run goes on.
#pragma once

#include <string>
#include <vector>

#include "lib/files/output_file.hpp"
#include "lib/files/result_file.hpp"

namespace taut::host {

/// What of a result is written.
struct ResultChoice {
  std::vector<std::string> columns;  ///< beside the time; empty: all
  int every = 1;                     ///< every so many rows one is
};

/// Writes the first row of a result, every so many rows from there one more, every row whose alarms are not
/// those of the row before, and the last one.
class ResultWriter {
 public:
  /// Throws InputError for a column that the result does not have, before anything is written. What it is
  /// given must outlive it.
  ResultWriter(const std::string& path, const SceneDescription& scene, ResultColumns columns,
               const NumberFormat& format, const ResultChoice& choice);

  void take(double time, const Answer& answer);
  /// All that is to be written until now can be read by others.
  void flush() { output_.flush(); }
  /// The last row was the last.
  void finish();

 private:
  void write(double time, const Answer& answer);

  const SceneDescription& scene_;
  ResultColumns columns_;
  NumberFormat format_;
  std::size_t every_;
  ResultSelection selection_;
  OutputFile output_;
  std::size_t rows_ = 0;
  // The row before.
  bool is_written_ = true;
  double time_ = 0;
  Answer answer_;
};

}  // namespace taut::host
