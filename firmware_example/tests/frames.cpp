// Frames: what is good is taken, and nothing else.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "host/device.hpp"
#include "monitor/frame.hpp"

namespace frames_test {
namespace {

using Reader = monitor::FrameReader<64>;
using Event = Reader::Event;

struct Heard {
  int frames = 0, refused = 0;
  bool operator==(const Heard& other) const { return frames == other.frames && refused == other.refused; }
};

Heard hear(Reader& reader, const std::string& bytes) {
  Heard heard;
  for (const char byte : bytes) {
    const Event event = reader.take(byte);
    heard.frames += event == Event::frame ? 1 : 0;
    heard.refused += event == Event::refused ? 1 : 0;
  }
  return heard;
}
Heard hear(const std::string& bytes) {
  Reader reader;
  return hear(reader, bytes);
}

const std::string good = monitor::host::framed("S 0000002a 3f800000 475ac000");

}  // namespace

TEST_CASE("a frame is what the README says") {
  // Computed with zlib.
  CHECK(monitor::host::framed("I") == "$I*dd0216b9\n");
}

TEST_CASE("a good frame is heard, and its numbers keep every bit") {
  Reader reader;
  CHECK(hear(reader, good) == Heard{1, 0});
  auto fields = reader.fields();
  char kind = 0;
  std::uint32_t sequence = 0;
  float factor = 0, force = 0;
  CHECK(fields.letter(kind));
  CHECK(kind == 'S');
  CHECK(fields.number(sequence));
  CHECK(sequence == 42);
  CHECK(fields.real(factor));
  CHECK(factor == 1);
  CHECK(fields.real(force));
  CHECK(force == 56000);
  CHECK(fields.done());
  CHECK_FALSE(fields.number(sequence));
}

TEST_CASE("every single flipped bit is heard as no frame, and the next frame is good") {
  for (std::size_t i = 0; i < good.size(); ++i)
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string bytes = good;
      bytes[i] = static_cast<char>(static_cast<unsigned char>(bytes[i]) ^ 1U << bit);
      Reader reader;
      const Heard heard = hear(reader, bytes + good);
      INFO("byte " << i << " bit " << bit);
      // A bit can make a $ or a line feed, and two pieces of one frame.
      CHECK(heard.frames == 1);
      CHECK(heard.refused >= 1);
    }
}

TEST_CASE("every single dropped or doubled byte is heard as no frame, and the next frame is good") {
  for (std::size_t i = 0; i < good.size(); ++i) {
    INFO("byte " << i);
    std::string dropped = good, doubled = good;
    dropped.erase(i, 1);
    doubled.insert(i, 1, good[i]);
    CHECK(hear(dropped + good) == Heard{1, 1});
    const bool harmless = good[i] == '\n';  // an empty line
    CHECK(hear(doubled + good) == (harmless ? Heard{2, 0} : i == 0 ? Heard{2, 1} : Heard{1, 1}));
  }
}

TEST_CASE("rubbish of any length is one refusal a line") {
  CHECK(hear(std::string(100000, 'x') + "\n" + good) == Heard{1, 1});
  CHECK(hear("$" + std::string(100000, 'x') + "\n" + good) == Heard{1, 1});
  CHECK(hear("$$$$\n" + good) == Heard{1, 4});
  CHECK(hear("\n\n\n" + good) == Heard{1, 0});
  CHECK(hear("$*00000000\n" + good) == Heard{1, 1});
  CHECK(hear("$I*DD0216B9\n" + good) == Heard{1, 1});
}

TEST_CASE("fields that are too few, too many or misshapen are refused") {
  for (const char* text : {"", "S ", "S 0", "S 0000000g", "S 00000000 ", "S  00000000", "S 000000000"}) {
    INFO(text);
    monitor::Fields fields(text, static_cast<int>(std::string(text).size()));
    char kind = 0;
    std::uint32_t number = 0;
    CHECK_FALSE((fields.letter(kind) && fields.number(number) && fields.done()));
  }
}

TEST_CASE("a body that does not fit makes no frame") {
  monitor::FrameWriter<10> writer;
  writer.begin('A');
  writer.number(7);
  writer.finish();
  CHECK(std::string(writer.text(), static_cast<std::size_t>(writer.size())) ==
        monitor::host::framed("A 00000007"));
  writer.begin('A');
  writer.number(7);
  writer.letter('x');
  writer.finish();
  CHECK(writer.size() == 0);
  writer.begin('B');
  writer.finish();
  CHECK(writer.size() > 0);
}

}  // namespace frames_test
