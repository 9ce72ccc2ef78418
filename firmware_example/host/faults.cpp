// Maltreats a device over its line: noise, samples too fast, restarts, a main loop that hangs. After each the
// next good sample must get the answer of an undisturbed device.
#include <cstdio>
#include <exception>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "host/device.hpp"
#include "host/memory_link.hpp"
#include "host/memory_monitor.hpp"
#include "host/process_link.hpp"

namespace {

using monitor::host::Device;
using monitor::host::DeviceAnswer;
using monitor::host::framed;
using monitor::host::MemoryBoard;
using monitor::host::number_field;
using monitor::host::Reading;
using Application = monitor::host::MemoryMonitor;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

/// The line with something done to one frame in three.
class NoisyLink : public monitor::host::Link {
 public:
  explicit NoisyLink(monitor::host::Link& link) : link_(link) {}

  bool noisy = true;

  void send(const std::string& bytes) override {
    std::string sent = bytes;
    const std::size_t at = random_() % sent.size();
    if (noisy && random_() % 3 == 0) {
      switch (random_() % 3) {
        case 0:
          sent.erase(at, 1);
          break;
        case 1:
          sent.insert(at, 1, sent[at]);
          break;
        default:
          sent[at] = static_cast<char>(static_cast<unsigned char>(sent[at]) ^ 1U << random_() % 8);
          break;
      }
      // A frame whose line feed was lost is waited for in vain; the next one ends it at once.
      if (sent.back() != '\n') sent += '\n';
    }
    link_.send(sent);
  }
  std::optional<std::string> receive(int milliseconds) override { return link_.receive(milliseconds); }

 private:
  monitor::host::Link& link_;
  std::mt19937 random_{4711};
};

/// Of every cable of the recorded experiment the cell at the anchor, the one at the jack, and the stroke.
std::vector<Reading> row(int number) {
  return {33000.0F,
          1000.0F * static_cast<float>(number % 37),
          {},
          {},
          40000 + 7 * static_cast<float>(number % 11),
          {},
          {},
          number % 7 == 0 ? Reading() : Reading(500.0F * static_cast<float>(number % 5)),
          0.001F};
}

void same(const DeviceAnswer& found, const DeviceAnswer& expected, const std::string& where) {
  if (found.quality != monitor::Quality::good) fail(where + ": the answer is not good");
  if (found.values != expected.values) fail(where + ": the forces have other bits");
}

void run(const std::string& command) {
  static MemoryBoard board;
  static Application application(board);
  application.begin();
  monitor::host::MemoryLink<Application> here(board, application);
  Device expected(here);
  expected.choose(0);

  monitor::host::ProcessLink link(command);
  NoisyLink noise(link);
  Device device(noise);
  device.choose(0);
  int number = 0;
  for (; number < 2000; ++number)
    same(device.sample(1, row(number)), expected.sample(1, row(number)),
         "noise, sample " + std::to_string(number));
  noise.noisy = false;
  std::printf("noise: 2000 samples, %u bad frames\n", static_cast<unsigned>(device.information().bad_frames));

  for (int restarts = 0; restarts < 20; ++restarts, ++number) {
    device.restart();
    same(device.sample(1, row(number)), expected.sample(1, row(number)),
         "restart " + std::to_string(restarts));
  }
  std::puts("restarts: 20, nothing lost");

  // All at once, and nobody waits for an answer.
  std::string burst;
  for (std::uint32_t i = 0; i < 500; ++i) burst += framed("S " + number_field(0x10000 + i));
  link.send(burst);
  while (link.receive(500)) {
  }
  same(device.sample(1, row(number)), expected.sample(1, row(number)), "after a burst");
  ++number;
  std::printf("burst: 500 frames at once, %u bytes lost\n",
              static_cast<unsigned>(device.information().lost_bytes));

  const auto before = device.information();
  link.send(framed("H"));
  link.receive(1000);
  bool greeted = false;
  for (int waited = 0; waited < 30 && !greeted; ++waited) {
    const auto line = link.receive(1000);
    greeted = line && monitor::host::body_of(*line).value_or("E")[0] == 'I';
  }
  if (!greeted) fail("a main loop that hangs: the watchdog does not reset the device");
  const auto after = device.information();
  if (after.restarts != before.restarts + 1 ||
      after.start != static_cast<std::uint32_t>(monitor::Start::watchdog))
    fail("a main loop that hangs: the device does not know of the watchdog's reset");
  same(device.sample(1, row(number)), expected.sample(1, row(number)), "after the watchdog");
  std::puts("hang: reset by the watchdog, nothing lost");
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::puts("usage: monitor_faults COMMAND    whose standard input and output are the line to a device");
    return 2;
  }
  try {
    run(arguments[1]);
    return 0;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "monitor_faults: %s\n", problem.what());
  }
  return 1;
}
