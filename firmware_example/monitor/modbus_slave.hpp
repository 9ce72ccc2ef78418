// The monitor as a Modbus RTU slave, on a line of its own beside that of the frames.
#pragma once

#include <cstdint>

#include "monitor/modbus_frame.hpp"
#include "monitor/modbus_map.hpp"
#include "monitor/modbus_server.hpp"

namespace monitor {

/// Holds all its storage: make it static. `Line` has
///
///   bool read(std::uint8_t& byte, std::uint32_t& at);   the next byte and when it came [us]
///   std::uint32_t microseconds();                       of the same clock, which may pass zero
///   void write(const std::uint8_t* bytes, int count);
template <class Application, class Line>
class ModbusSlave {
 public:
  /// `baud`: bits a second of the line.
  ModbusSlave(Application& application, Line& line, std::uint8_t address, std::uint32_t baud)
      : application_(application),
        line_(line),
        reader_(modbus_silence(baud)),
        map_(application),
        server_(map_, address) {}

  /// One pass of the main loop: at most one frame, a bounded number of bytes.
  void step() {
    for (int i = 0; i <= most_modbus_frame; ++i) {
      if (!has_next_) has_next_ = line_.read(next_, next_at_);
      if (reader_.has_ended(has_next_ ? next_at_ : line_.microseconds())) return answer();
      if (!has_next_) return;
      reader_.add(next_, next_at_);
      has_next_ = false;
    }
  }

 private:
  void answer() {
    if (reader_.is_good()) {
      const int count = server_.take(reader_.bytes(), reader_.size());
      if (count > 0) line_.write(server_.answer(), count);
    } else {
      map_.count_bad_frame();
    }
    reader_.clear();
    if (map_.take_restart()) application_.restart();
  }

  Application& application_;
  Line& line_;
  ModbusFrameReader reader_;
  ModbusMap<Application> map_;
  ModbusServer<ModbusMap<Application>> server_;
  std::uint8_t next_ = 0;  // a byte that may belong to the frame after this one
  std::uint32_t next_at_ = 0;
  bool has_next_ = false;
};

}  // namespace monitor
