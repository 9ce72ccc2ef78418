// A long watch with many clients: rows lost, memory, and the time from a row at the program's input to its
// event at a client. A measurement, no test: long_watch [SECONDS] [CLIENTS] [ROWS_A_SECOND]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "watch/http_client.hpp"
#include "watch/watched_program.hpp"
#include "watch/watched_scene.hpp"

namespace {

using Clock = std::chrono::steady_clock;

/// Resident memory of a process [KiB].
long memory_of(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  long size = 0;
  for (std::string word; status >> word;)
    if (word == "VmRSS:") status >> size;
  return size;
}

/// The events of one client as they come; the text of those that are read is let go.
class Listener {
 public:
  explicit Listener(int port) : client_(port) { client_.get("/events"); }

  template <class Visit>
  void take(const Visit& visit) {
    const std::string& text = client_.take(0);
    for (std::size_t end = text.find("\n\n", read_); end != std::string::npos;
         end = text.find("\n\n", read_)) {
      const std::size_t time = text.find("\"time\":", read_);
      if (time < end) visit(std::atof(text.c_str() + time + 7));
      read_ = end + 2;
    }
    if (read_ > (std::size_t{1} << 20)) read_ -= client_.forget(read_);
  }

 private:
  HttpClient client_;
  std::size_t read_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  doctest::Context context;  // for what the helpers require
  context.setAsDefaultForAssertsOutOfTestCases();
  context.setAssertHandler([](const doctest::AssertData& data) {
    if (data.m_failed) std::printf("%s:%d: %s\n", data.m_file, data.m_line, data.m_expr), std::exit(1);
  });
  const auto parameter = [&](int i, int usual) { return argc > i ? std::atoi(argv[i]) : usual; };
  const int seconds = parameter(1, 600), clients = parameter(2, 20), rate = parameter(3, 50);
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(seconds * rate, 7, 1.0 / rate);
  WatchedProgram watch(scratch,
                       {"scene.json", "-", "--http", "0", "--record", "record.csv", "--state", "state"});
  const int port = watch.port();
  std::vector<std::unique_ptr<Listener>> listeners;
  for (int i = 0; i < clients; ++i) listeners.push_back(std::make_unique<Listener>(port));
  const HttpClient silent(port, 2048);  // besides these, one that never reads
  silent.get("/events");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));

  std::map<double, Clock::time_point> sent;
  std::vector<std::set<double>> seen(listeners.size());
  std::vector<double> latencies;
  const auto look = [&] {
    for (std::size_t i = 0; i < listeners.size(); ++i)
      listeners[i]->take([&](double time) {
        const auto found = sent.lower_bound(time - 1e-6);
        if (found == sent.end() || !seen[i].insert(found->first).second) return;
        latencies.push_back(std::chrono::duration<double, std::milli>(Clock::now() - found->second).count());
      });
  };
  watch.write(log_header);
  const auto begun = Clock::now();
  long memory = 0, first_memory = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto when = begun + std::chrono::duration_cast<Clock::duration>(
                                  std::chrono::duration<double>(static_cast<double>(i) / rate));
    while (Clock::now() < when) {
      look();
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    sent[std::atof(rows[i].c_str())] = Clock::now();
    watch.write(rows[i]);
    if (i % static_cast<std::size_t>(rate) != 0) continue;
    memory = memory_of(watch.process());
    if (i == static_cast<std::size_t>(10 * rate)) first_memory = memory;
  }
  for (int i = 0; i < 1000; ++i) {
    look();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  watch.close_input();
  const int status = watch.ended();
  const std::string record = text_of(scratch.path / "record.csv");
  std::size_t lost = 0;
  for (const auto& times : seen) lost += rows.size() - times.size();
  std::sort(latencies.begin(), latencies.end());
  const auto quantile = [&](double part) {
    return latencies.empty()
               ? 0
               : latencies[static_cast<std::size_t>(part * static_cast<double>(latencies.size() - 1))];
  };
  std::printf("%zu rows in %d s, %d clients and one that never reads, exit status %d\n", rows.size(), seconds,
              clients, status);
  std::printf("record: %td rows, as those of estimate: %s\n",
              std::count(record.begin(), record.end(), '\n') - 1,
              record == estimated(scratch, log_header + joined(rows)).out ? "yes" : "no");
  std::printf("events that clients lack: %zu of %zu\n", lost, rows.size() * seen.size());
  std::printf("row to event: median %.2f ms, 99 %% %.2f ms, largest %.2f ms\n", quantile(0.5), quantile(0.99),
              quantile(1));
  std::printf("memory: %ld KiB after 10 s, %ld KiB at the end\n", first_memory, memory);
  return lost == 0 && status == 0 ? 0 : 1;
}
