#include "host/serial_line.hpp"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>

namespace monitor::host {
namespace {

speed_t speed_of(std::uint32_t baud) {
  switch (baud) {
    case 1200:
      return B1200;
    case 9600:
      return B9600;
    case 19200:
      return B19200;
    case 38400:
      return B38400;
    case 115200:
      return B115200;
    default:
      throw std::runtime_error("no serial line has " + std::to_string(baud) +
                               " bits a second; take 1200, 9600, 19200, 38400 or 115200");
  }
}

}  // namespace

SerialLine::SerialLine(const std::string& path, std::uint32_t baud) {
  const speed_t speed = speed_of(baud);
  line_ = open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  termios settings{};
  if (line_ < 0 || tcgetattr(line_, &settings) != 0)
    throw std::runtime_error(path + " is no serial line that can be used; name one as /dev/ttyUSB0");
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD | PARENB;
  cfsetispeed(&settings, speed);
  cfsetospeed(&settings, speed);
  // A pseudo-terminal may refuse the parity that it does not have.
  tcsetattr(line_, TCSANOW, &settings);
}

SerialLine::~SerialLine() { close(line_); }

bool SerialLine::read(std::uint8_t& byte, std::uint32_t& at) {
  if (taken_ == held_) {
    const ssize_t count = ::read(line_, bytes_.data(), bytes_.size());
    if (count <= 0) return false;
    taken_ = 0;
    held_ = static_cast<std::size_t>(count);
    found_at_ = microseconds();
  }
  byte = bytes_[taken_++];
  at = found_at_;
  return true;
}

std::uint32_t SerialLine::microseconds() const {
  using namespace std::chrono;
  return static_cast<std::uint32_t>(
      duration_cast<std::chrono::microseconds>(steady_clock::now().time_since_epoch()).count());
}

void SerialLine::write(const std::uint8_t* bytes, int count) {
  for (int sent = 0; sent < count;) {
    const ssize_t part = ::write(line_, bytes + sent, static_cast<std::size_t>(count - sent));
    // A line that takes nothing: the master asks again.
    if (part <= 0) return;
    sent += static_cast<int>(part);
  }
}

}  // namespace monitor::host
