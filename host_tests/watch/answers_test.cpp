// What browsers, record and standard output are told is what `taut estimate` finds.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <vector>

#include "files/result_table.hpp"
#include "lib/live/answer_board.hpp"
#include "lib/live/live_answer.hpp"
#include "watch/http_client.hpp"
#include "watch/watched_program.hpp"
#include "watch/watched_scene.hpp"

namespace {

using Json = nlohmann::json;

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// All of an answer against a row of the result of `taut estimate`, number for number.
void check_answer(const Json& answer, const Table& table, std::size_t row) {
  CHECK(answer.at("time").get<double>() == table.number(row, "time"));
  for (int i = 1; i <= 4; ++i) {
    const std::string n = std::to_string(i);
    const Json& part = answer.at("segments").at("C").at(static_cast<std::size_t>(i - 1));
    const double force = table.number(row, "C.T" + n), sd = table.number(row, "C.sd" + n);
    CHECK(part.at("force").get<double>() == force);
    CHECK(part.at("sd").get<double>() == sd);
    CHECK(part.at("low").get<double>() == doctest::Approx(std::max(0.0, force - 1.96 * sd)));
    CHECK(part.at("high").get<double>() == doctest::Approx(force + 1.96 * sd));
  }
  for (int j = 1; j <= 3; ++j) {
    const std::string n = std::to_string(j);
    const Json& joint = answer.at("joints").at("C").at(static_cast<std::size_t>(j - 1));
    CHECK(joint.at("state").get<std::string>() == table.at(row, "C.state" + n));
    CHECK(joint.at("mu").get<double>() == table.number(row, "C.mu" + n));
    CHECK(joint.at("mu_sd").get<double>() == table.number(row, "C.mu_sd" + n));
  }
  std::string words;
  for (const Json& word : answer.at("alarms")) words += (words.empty() ? "" : " ") + word.get<std::string>();
  CHECK(words == table.at(row, "alarms"));
  CHECK(answer.at("jack").at("C.end").at("force").get<double>() == table.number(row, "C.T4"));
}

}  // namespace

TEST_CASE("every row is an event, and the last one is in answer.json, with the numbers of estimate") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(200);
  WatchedProgram watch(scratch, {"scene.json", "-", "--http", "0", "--record", "record.csv"});
  const int port = watch.port();
  int status = 0;
  page_at(port, "/answer.json", &status);
  CHECK(status == 503);  // there is none yet
  HttpClient listener(port);
  REQUIRE(listener.get("/events"));
  REQUIRE(comes_true([&] { return listener.take(5).find("text/event-stream") != std::string::npos; }));
  watch.write(log_header);
  // No faster than a logger: who is too slow for what comes goes on with the newest.
  for (const std::string& row : rows) {
    watch.write(row);
    listener.take(2);
  }
  CHECK(comes_true([&] { return (listener.take(5), listener.events().size() >= rows.size()); }));
  const Outcome expected = estimated(scratch, log_header + joined(rows));
  REQUIRE(expected.status == 0);
  const Table table(expected.out);
  const std::vector<std::string> events = listener.events();
  REQUIRE(events.size() == rows.size());
  for (std::size_t row = 0; row < events.size(); ++row) check_answer(Json::parse(events[row]), table, row);
  const Json last = Json::parse(page_at(port, "/answer.json", &status));
  CHECK(status == 200);
  check_answer(last, table, rows.size() - 1);
  // The reading and the stroke as they stand in the row.
  const std::vector<std::string> row = fields(rows.back().substr(0, rows.back().size() - 1));
  CHECK(last.at("jack").at("C.end").at("reading").get<double>() == std::strtod(row[2].c_str(), nullptr));
  CHECK(last.at("jack").at("C.end").at("stroke").get<double>() == std::strtod(row[3].c_str(), nullptr));
  CHECK(lines_of(text_of(scratch.path / "record.csv")) == rows.size() + 1);  // before the end of the log
  watch.close_input();
  CHECK(watch.ended() == 0);
  CHECK(text_of(scratch.path / "record.csv") == expected.out);
  CHECK(listener.receive(5).size() > 0);
  CHECK(listener.is_over());
}

TEST_CASE("who has come gets every answer that is put after that, however late it asks for the first one") {
  taut::host::AnswerBoard board;
  const auto put = [&](double time) {
    auto answer = std::make_shared<taut::host::LiveAnswer>();
    answer->time = time;
    board.put(answer);
  };
  const auto taken = [&](taut::host::AnswerBoard::Place place) {
    std::vector<double> times;
    while (const auto answer = board.next(place, std::chrono::milliseconds(0))) times.push_back(answer->time);
    return times;
  };
  const auto first = board.newest_place();
  put(1);
  put(2);
  const auto second = board.newest_place();
  put(3);
  CHECK(taken(first) == std::vector<double>{1, 2, 3});
  CHECK(taken(second) == std::vector<double>{2, 3});
}

TEST_CASE("twenty clients get every row, though one never reads and one goes away") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(2000);
  WatchedProgram watch(scratch, {"scene.json", "-", "--http", "0", "--record", "record.csv"});
  const int port = watch.port();
  const HttpClient silent(port, 2048);  // its window is full soon
  REQUIRE(silent.get("/events"));
  {
    const HttpClient gone(port);
    REQUIRE(gone.get("/events"));
  }
  std::vector<std::unique_ptr<HttpClient>> clients;
  for (int i = 0; i < 18; ++i) {
    clients.push_back(std::make_unique<HttpClient>(port));
    REQUIRE(clients.back()->get("/events"));
    REQUIRE(comes_true([&] { return clients.back()->take(5).find("event-stream") != std::string::npos; }));
  }
  watch.write(log_header);
  // In bursts that are shorter than what is kept for who is late.
  constexpr std::size_t burst = 200;
  for (std::size_t i = 0; i < rows.size(); i += burst) {
    watch.write(joined(rows, i, i + burst));
    for (auto& client : clients)
      CHECK(comes_true([&] { return (client->take(1), client->events().size() >= i + burst); }));
  }
  // The estimator has waited for nobody.
  CHECK(comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == rows.size() + 1; }));
  for (auto& client : clients) CHECK(client->events().size() == rows.size());
  watch.close_input();
  CHECK(watch.ended() == 0);
}

TEST_CASE("who is too slow goes on with the newest answer") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(4000);
  WatchedProgram watch(scratch, {"scene.json", "-", "--http", "0"});
  HttpClient slow(watch.port(), 2048);
  REQUIRE(slow.get("/events"));
  REQUIRE(comes_true([&] { return slow.take(5).find("event-stream") != std::string::npos; }));
  watch.write(log_header + joined(rows));  // megabytes of answers at once
  const std::string last_time = fields(rows.back())[0];
  CHECK(comes_true([&] { return page_at(watch.port(), "/answer.json").find("\"time\":" + last_time) == 1; }));
  CHECK(comes_true([&] {
    slow.take(5);
    const auto events = slow.events();
    return !events.empty() && events.back().find("\"time\":" + last_time) == 1;
  }));
  CHECK(slow.events().size() < rows.size());
}

TEST_CASE("a file is followed as it grows, and a signal ends that in good order") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(60);
  std::ofstream log(scratch.path / "log.csv");
  log << log_header << joined(rows, 0, 20) << std::flush;
  for (const int signal : {SIGINT, SIGTERM}) {
    std::filesystem::remove(scratch.path / "record.csv");
    WatchedProgram watch(scratch, {"scene.json", "log.csv", "--record", "record.csv"});
    const std::size_t before = lines_of(text_of(scratch.path / "log.csv"));
    CHECK(comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == before; }));
    log << joined(rows, before - 1, before + 9) << rows[before + 9].substr(0, 5)
        << std::flush;  // and part of a row
    CHECK(comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == before + 10; }));
    log << rows[before + 9].substr(5) << std::flush;
    CHECK(comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == before + 11; }));
    CHECK(watch.is_running());
    watch.send(signal);
    CHECK(watch.ended() == 0);
    CHECK(text_of(scratch.path / "record.csv") == estimated(scratch, text_of(scratch.path / "log.csv")).out);
  }
}

TEST_CASE("a log that is cut short while it is followed is refused") {
  const Scratch scratch;
  write_scene(scratch);
  std::ofstream(scratch.path / "log.csv") << log_header << joined(log_rows(30));
  WatchedProgram watch(scratch, {"scene.json", "log.csv", "--record", "record.csv"});
  REQUIRE(comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) == 31; }));
  std::ofstream(scratch.path / "log.csv") << log_header;
  CHECK(watch.ended() == 2);
  CHECK(watch.err().find("log.csv: has become shorter while it was followed; start again") !=
        std::string::npos);
}

TEST_CASE("a log is played at the speed that is asked for, to its end") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(21, 7, 0.5);  // 10 s
  std::ofstream(scratch.path / "log.csv") << log_header << joined(rows);
  const auto begin = std::chrono::steady_clock::now();
  WatchedProgram watch(scratch, {"scene.json", "log.csv", "--speed", "10", "--record", "record.csv"});
  REQUIRE(comes_true([&] { return lines_of(text_of(scratch.path / "record.csv")) >= 2; }));
  const auto first = std::chrono::steady_clock::now();
  CHECK(watch.ended() == 0);
  const auto end = std::chrono::steady_clock::now();
  // The program waits for the first row's time at the earliest from `begin` on; the machine may be slow,
  // never fast.
  CHECK(std::chrono::duration<double>(end - begin).count() >= 1.0);
  CHECK(std::chrono::duration<double>(end - first).count() < 5.0);
  CHECK(text_of(scratch.path / "record.csv") == estimated(scratch, log_header + joined(rows)).out);
}

TEST_CASE("what cannot be used is refused with a remedy") {
  const Scratch scratch;
  write_scene(scratch);
  std::ofstream(scratch.path / "log.csv") << log_header << joined(log_rows(5));
  const std::string scene = "watch " + scratch.quoted("scene.json") + " ";
  const std::string log = scratch.quoted("log.csv");
  const auto refused = [&](const std::string& arguments) {
    const Outcome outcome = run_taut(scratch, scene + arguments + " < /dev/null");
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    return outcome.err;
  };
  CHECK(refused("") ==
        "taut watch: has no rows to follow; name a log, - for standard input, or --serial DEVICE\n");
  CHECK(refused("- --serial /dev/null").find("has two logs to follow; name a log") != std::string::npos);
  CHECK(refused("nowhere.csv")
            .find("nowhere.csv: cannot be opened: No such file or directory; name a log file") !=
        std::string::npos);
  CHECK(refused("--serial nowhere").find("nowhere: cannot be opened as a serial line: ") !=
        std::string::npos);
  CHECK(refused("--serial nowhere:77").find("\"77\" is no speed of a serial line; write one of 1200") !=
        std::string::npos);
  CHECK(refused("- --speed 2").find("--speed: needs a log that is a file; leave it out") !=
        std::string::npos);
  CHECK(refused(log + " --speed 0").find("--speed: is not greater than zero; write 1") != std::string::npos);
  CHECK(refused("- --http x").find("--http: \"x\" is no address and port; write a port") !=
        std::string::npos);
  CHECK(refused("- --http 70000").find("--http: \"70000\" is no address and port") != std::string::npos);
  CHECK(refused("- --http 192.0.2.1:0").find("--http: nobody can listen at 192.0.2.1:0") !=
        std::string::npos);
  CHECK(refused("- --record " + log).find("is not a record of this scene; name another file") !=
        std::string::npos);
  CHECK(refused(log + " --record " + log).find("is an input of this run") != std::string::npos);
  CHECK(refused("-").find("standard input: line 1: the log is empty; write a header") != std::string::npos);
  CHECK(text_of(scratch.path / "log.csv") == log_header + joined(log_rows(5)));
}

TEST_CASE("a row that cannot be used ends the watch with its place, after the rows before it") {
  const Scratch scratch;
  write_scene(scratch);
  const std::vector<std::string> rows = log_rows(10);
  WatchedProgram watch(scratch, {"scene.json", "-", "--record", "record.csv"});
  watch.write(log_header + joined(rows) + "11,x,1,0\n");
  CHECK(watch.ended() == 2);
  CHECK(watch.err().find("standard input: line 12, column 2 (C.start): \"x\" is not a number; write") !=
        std::string::npos);
  CHECK(text_of(scratch.path / "record.csv") == estimated(scratch, log_header + joined(rows)).out);
}

TEST_CASE("nobody reads standard output, and nothing waits for that") {
  const Scratch scratch;
  write_scene(scratch);
  int ends[2] = {-1, -1};
  REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
  const std::vector<std::string> rows = log_rows(3000);
  WatchedProgram watch(scratch, {"scene.json", "-", "--record", "record.csv"}, ends[1]);
  watch.write(log_header + joined(rows));
  watch.close_input();
  CHECK(watch.ended() == 0);
  CHECK(lines_of(text_of(scratch.path / "record.csv")) == rows.size() + 1);
  close(ends[0]);
  close(ends[1]);
}
