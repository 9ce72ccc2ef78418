// Scenes that are exported together share their types, and give the answers that each gives alone.
#include <doctest/doctest.h>

#include <type_traits>

#include "export/loose_scene.hpp"
#include "exported.hpp"
#include "together.hpp"

namespace arch = scene_2_arches_ber;
namespace wire = scene_double;

namespace {

template <class Scalar>
void check_all() {
  constexpr int unknowns = arch::unknowns;
  const auto check = [](const char* name, const auto& condensed, const auto& prior, const auto*... rows) {
    exported::check_answers<unknowns>(name, false, condensed, prior, rows...);
  };
  check("wire", wire::condensed<Scalar>, wire::prior<Scalar>);
  check("arch", arch::condensed<Scalar>, arch::prior<Scalar>, &arch::struts<Scalar>);
  check("net", net::condensed<Scalar>, net::prior<Scalar>);
  check("saddles", saddles::condensed<Scalar>, saddles::prior<Scalar>);
}

std::string in_quotes(const std::filesystem::path& file) { return "'" + file.string() + "'"; }
std::string here(const std::string& file) { return in_quotes(TAUT_EXPORT "/" + file); }

/// A scene under another name.
std::filesystem::path renamed(const Scratch& scratch, const std::string& file, const std::string& name) {
  std::string text = text_of(TAUT_EXPORT "/" + file);
  const std::string key = "\"name\": \"";
  const std::size_t from = text.find(key) + key.size();
  text.replace(from, text.find('"', from) - from, name);
  std::ofstream(scratch.path / file) << text;
  return scratch.path / file;
}

}  // namespace

TEST_CASE("scenes of one header have one type, and the answers that each has alone, in double") {
  check_all<double>();
}
TEST_CASE("the same in float, between rigid saddles too") { check_all<float>(); }

TEST_CASE("the capacity holds the most that any scene has of something") {
  static_assert(std::is_same_v<wire::Capacity, arch::Capacity>);
  static_assert(std::is_same_v<wire::Capacity, net::Capacity>);
  static_assert(std::is_same_v<wire::Capacity, saddles::Capacity>);
  using Cap = wire::Capacity;
  CHECK(Cap::cables == 3);
  CHECK(Cap::segments >= arch::condensed<float>.segments);
  CHECK(Cap::joints >= saddles::condensed<float>.joints);
  CHECK(Cap::struts == arch::strut_count);
  CHECK(wire::strut_count == 0);
  CHECK_FALSE(taut::has_rigid_saddles<Cap>);
  static_assert(wire::unknowns == arch::unknowns && arch::unknowns == saddles::unknowns);
  CHECK(wire::unknowns == 6);
}

TEST_CASE("names are those of each scene") {
  CHECK(std::string(arch::names::cables[1]) == "\xC3\xBC?");
  CHECK(std::string(arch::names::loads[0]) == "snow");
}

TEST_CASE("two scenes with the same namespace are refused") {
  const Scratch scratch;
  const auto other = renamed(scratch, "wire.json", "Net");
  const auto same = renamed(scratch, "saddles.json", "net");
  const Outcome good = run_taut(scratch, "export " + here("net.json") + " " + in_quotes(other));
  CHECK(good.status == 0);
  const Outcome outcome = run_taut(
      scratch, "export " + here("net.json") + " " + in_quotes(same) + " -o " + scratch.quoted("header.hpp"));
  CHECK(outcome.status == 2);
  CHECK(outcome.err.find("saddles.json: /name: the name \"net\" gives the namespace \"net\"") !=
        std::string::npos);
  CHECK(outcome.err.find("give every scene of a header another name") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch.path / "header.hpp"));
}

TEST_CASE("if one scene does not stand nothing is written, and the message names its file") {
  const Scratch scratch;
  write_loose_scene(scratch.path / "loose.json");
  const Outcome outcome =
      run_taut(scratch, "export " + here("net.json") + " " + scratch.quoted("loose.json") + " -o " +
                            scratch.quoted("header.hpp"));
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("loose.json") != std::string::npos);
  CHECK(outcome.err.find("node \"loose\": mechanism") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch.path / "header.hpp"));
}

TEST_CASE("a header does not overwrite any of its scenes") {
  const Scratch scratch;
  const auto copy = renamed(scratch, "wire.json", "copy");
  const std::string before = text_of(copy);
  const Outcome outcome =
      run_taut(scratch, "export " + here("net.json") + " " + in_quotes(copy) + " -o " + in_quotes(copy));
  CHECK(outcome.status == 2);
  CHECK(text_of(copy) == before);
}
