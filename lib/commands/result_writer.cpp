#include "lib/commands/result_writer.hpp"

namespace taut::host {

ResultWriter::ResultWriter(const std::string& path, const SceneDescription& scene, ResultColumns columns,
                           const NumberFormat& format, const ResultChoice& choice)
    : scene_(scene),
      columns_(columns),
      format_(format),
      every_(static_cast<std::size_t>(choice.every)),
      selection_(choice.columns.empty() ? ResultSelection() : select_columns(choice.columns, scene, columns)),
      output_(path) {
  output_.write(result_header(scene_, columns_, selection_));
}

void ResultWriter::take(double time, const Answer& answer) {
  is_written_ = rows_++ % every_ == 0 || answer.alarms != answer_.alarms;
  if (is_written_) write(time, answer);
  if (every_ == 1) return;
  time_ = time;
  answer_ = answer;
}

void ResultWriter::finish() {
  if (!is_written_) write(time_, answer_);
  is_written_ = true;
  output_.finish();
}

void ResultWriter::write(double time, const Answer& answer) {
  output_.write(result_row(scene_, time, answer, format_, columns_, selection_));
}

}  // namespace taut::host
