#include "lib/live/serial_source.hpp"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <iostream>
#include <system_error>
#include <utility>

#include "lib/files/input_error.hpp"
#include "lib/files/text.hpp"

namespace taut::host {
namespace {

constexpr std::array<std::pair<int, speed_t>, 11> speeds = {{{1200, B1200},
                                                             {2400, B2400},
                                                             {4800, B4800},
                                                             {9600, B9600},
                                                             {19200, B19200},
                                                             {38400, B38400},
                                                             {57600, B57600},
                                                             {115200, B115200},
                                                             {230400, B230400},
#ifdef B460800
                                                             {460800, B460800},
#else
                                                             {0, B0},
#endif
#ifdef B921600
                                                             {921600, B921600}}};
#else
                                                             {0, B0}}};
#endif

const std::pair<int, speed_t>* find_speed(int baud) {
  const auto* const found = std::find_if(speeds.begin(), speeds.end(),
                                         [&](const auto& speed) { return speed.first == baud && baud > 0; });
  return found == speeds.end() ? nullptr : found;
}

// Neither numbers nor dates have this word in them.
bool is_header(const std::string& line) {
  const std::size_t first = line.find_first_not_of(" \t\"");
  return first != std::string::npos && line[first] != '#' && line.find("time") != std::string::npos;
}

}  // namespace

SerialLine serial_line(const std::string& text) {
  SerialLine line{text};
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return line;
  const std::string digits = text.substr(colon + 1);
  const bool is_number = !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number) return line;  // a colon in the name of a device
  line.device = text.substr(0, colon);
  const auto error = std::from_chars(digits.data(), digits.data() + digits.size(), line.baud).ec;
  if (error != std::errc() || find_speed(line.baud) == nullptr)
    throw InputError(
        "--serial", "", quote(digits) + " is no speed of a serial line",
        "write one of 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800, 921600");
  return line;
}

SerialSource::SerialSource(const SerialLine& line, std::string header, const StopSignal& stop, Tell tell,
                           FrameRows frames)
    : serial_(line),
      header_(std::move(header)),
      stop_(stop),
      tell_(std::move(tell)),
      frames_(std::move(frames)),
      heard_(Clock::now()) {
  errno = 0;
  if (!open_device())
    throw InputError(serial_.device, "",
                     "cannot be opened as a serial line: " + std::generic_category().message(errno),
                     "name the device of the line, as in /dev/ttyUSB0:115200, that you may read");
}

SerialSource::~SerialSource() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool SerialSource::open_device() {
  const int descriptor = open(serial_.device.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  termios settings{};
  bool is_good = tcgetattr(descriptor, &settings) == 0;
  if (is_good) {
    settings.c_iflag = IGNBRK | IGNPAR;
    settings.c_oflag = 0;
    settings.c_lflag = 0;
    settings.c_cflag = CS8 | CREAD | CLOCAL;
    settings.c_cc[VMIN] = 1;
    settings.c_cc[VTIME] = 0;
    const speed_t speed = find_speed(serial_.baud)->second;
    is_good = cfsetispeed(&settings, speed) == 0 && cfsetospeed(&settings, speed) == 0 &&
              tcsetattr(descriptor, TCSANOW, &settings) == 0;
  }
  if (!is_good) {
    const int reason = errno;
    close(descriptor);
    errno = reason;
    return false;
  }
  descriptor_ = descriptor;
  is_fresh_ = true;
  lines_.forget();
  return true;
}

void SerialSource::lose() {
  close(descriptor_);
  descriptor_ = -1;
  lines_.forget();
  say(true);
}

void SerialSource::say(bool is_silent) {
  if (is_silent_ == is_silent) return;
  is_silent_ = is_silent;
  if (tell_) tell_(is_silent);
}

// False if the line is lost.
bool SerialSource::wait_for_bytes() {
  std::array<pollfd, 2> waiting = {pollfd{descriptor_, POLLIN, 0}, pollfd{stop_.descriptor(), POLLIN, 0}};
  const int found = poll(waiting.data(), waiting.size(), static_cast<int>(retry.count()));
  if (found <= 0 || waiting[0].revents == 0) return true;
  std::array<char, 4096> bytes;
  const ssize_t count = read(descriptor_, bytes.data(), bytes.size());
  if (count > 0) {
    lines_.add({bytes.data(), static_cast<std::size_t>(count)});
    return true;
  }
  return count < 0 && (errno == EINTR || errno == EAGAIN);
}

// The next whole line; nothing if the line is lost or the program is to end.
std::optional<std::string> SerialSource::line() {
  while (!stop_.is_requested()) {
    if (descriptor_ < 0) {
      if (!open_device()) stop_.wait(static_cast<int>(retry.count()));
      continue;
    }
    if (std::optional<std::string> text = lines_.take()) {
      heard_ = Clock::now();
      say(false);
      const bool is_frame = text->find('$') != std::string::npos;
      const bool counts = !is_fresh_ || is_header(*text) || (is_frame && frame_body(*text));
      is_fresh_ = false;
      if (!counts) continue;
      if (!is_frame) return text;
      text = frames_.row(*text);
      if (text && header_.empty()) header_ = frames_.header();
      if (text) return text;
      continue;
    }
    if (Clock::now() - heard_ > silence) say(true);
    if (!wait_for_bytes()) {
      lose();
      return std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<std::string> SerialSource::next() {
  if (kept_) return std::exchange(kept_, std::nullopt);
  if (header_waits_) {
    header_waits_ = false;
    has_begun_ = true;
    return header_;
  }
  while (!stop_.is_requested()) {
    std::optional<std::string> text = line();
    // The log ends here if it has begun; where the line is lost before that, nothing is lost.
    if (!text && has_begun_) {
      has_begun_ = false;
      return std::nullopt;
    }
    if (!text) continue;
    const bool begins = is_header(*text);
    if (has_begun_ && begins) {
      header_ = *text;
      header_waits_ = true;
      has_begun_ = false;
      return std::nullopt;
    }
    if (has_begun_) return text;
    if (begins) {
      header_ = *text;
    } else if (header_.empty()) {
      if (!std::exchange(is_asked_, true))
        std::cerr << "remark: " << serial_.device
                  << ": a line came before any header; lines are left out until one comes\n";
      continue;
    } else {
      kept_ = std::move(text);
    }
    has_begun_ = true;
    return header_.back() == '\n' ? header_ : header_ + "\n";
  }
  return std::nullopt;
}

}  // namespace taut::host
