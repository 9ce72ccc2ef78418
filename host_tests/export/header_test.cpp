// The names in an exported header, its size, and where it is written.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "arch.hpp"
#include "beam_string.hpp"
#include "export/loose_scene.hpp"
#include "files/run_program.hpp"
#include "lib/commands/scene_header.hpp"
#include "lib/files/scene_file.hpp"
#include "lib/kinds/condensed_size.hpp"
#include "mast.hpp"
#include "saddles.hpp"
#include "taut/tracking/tracker.hpp"

namespace header_test {

namespace arch = scene_2_arches_ber;
using namespace taut::host;

namespace {

std::string quoted(const char* file) { return std::string("'") + TAUT_EXPORT "/" + file + "'"; }

template <class Cap, class Scalar>
using Scene = taut::Condensed<Scalar, Cap>;

template <class Exported>
void check_size(const char* file, ScalarType scalar) {
  constexpr bool has_struts = Exported::Capacity::struts > 0;
  const SceneDescription scene = read_scene_file(std::string(TAUT_EXPORT "/") + file);
  const CondensedSize size = condensed_size(condensed_counts(scene, condense(scene, scalar)), scalar);
  const auto off = [](std::size_t told, std::size_t taken) {
    return std::labs(static_cast<long>(told) - static_cast<long>(taken));
  };
  CHECK(off(size.scene, sizeof(Exported)) < (Exported::AtLevel::has_level ? 40 : 1));
  CHECK(off(size.strut_rows, has_struts ? sizeof(typename Exported::Struts) : 0) <
        (Exported::AtLevel::has_level ? 10 : 1));
  CHECK(off(size.tracker, sizeof(taut::Tracker<Exported>)) < 40);
}

}  // namespace

TEST_CASE("a scene name becomes an identifier that C++ takes for a namespace") {
  CHECK(identifier("suspen-dome") == "suspen_dome");
  CHECK(identifier("  cable -- roller (model)") == "cable_roller_model");
  CHECK(identifier("3 hoops") == "scene_3_hoops");
  CHECK(identifier("namespace") == "scene_namespace");
  CHECK(identifier("taut") == "scene_taut");
  CHECK(identifier("__x__") == "x");
  CHECK(identifier("\xE5\xB1\x8B") == "scene");
}

TEST_CASE("the bytes that are told are those of the exported types") {
  check_size<Scene<arch::Capacity, float>>("arch.json", ScalarType::float32);
  check_size<Scene<arch::Capacity, double>>("arch.json", ScalarType::float64);
  check_size<Scene<saddles::Capacity, float>>("saddles.json", ScalarType::float32);
  check_size<Scene<saddles::Capacity, double>>("saddles.json", ScalarType::float64);
  check_size<taut::SecondOrder<float, beam_string::Capacity>>("beam_string.json", ScalarType::float32);
  check_size<taut::SecondOrder<double, beam_string::Capacity>>("beam_string.json", ScalarType::float64);
  check_size<taut::SecondOrder<float, mast::Capacity>>("mast.json", ScalarType::float32);
  check_size<taut::SecondOrder<double, mast::Capacity>>("mast.json", ScalarType::float64);
}

TEST_CASE("a capacity says what a scene has not, and nothing that it has") {
  // A prestrain and a load; one of the two cables has no joint that locks.
  CHECK(taut::check_capacity(saddles::condensed<float>).ok());
  CHECK(taut::check_capacity(arch::condensed<double>).ok());
  CHECK(taut::check_capacity(beam_string::condensed<float>.low).ok());
  CHECK(taut::check_capacity(mast::condensed<float>.low).ok());
  CHECK(saddles::Capacity::spans == 2);
  CHECK_FALSE(saddles::Capacity::hoops);
  CHECK(saddles::Capacity::prestrain);
  CHECK_FALSE(saddles::Capacity::smooth);
  CHECK_FALSE(saddles::Capacity::strokes);
  CHECK(arch::Capacity::strokes);
  CHECK_FALSE(saddles::Capacity::lags);
  CHECK(mast::Capacity::lags);
  CHECK(mast::prior<float>.cell[0][0].lag == 0.25F);
  CHECK(mast::prior<float>.cell[0][1].lag == 0);
}

TEST_CASE("a header goes to standard output or, the same, to a file") {
  const Scratch scratch;
  const Outcome shown = run_taut(scratch, "export " + quoted("arch.json"));
  CHECK(shown.status == 0);
  CHECK(shown.err.empty());
  const Outcome kept = run_taut(scratch, "export " + quoted("arch.json") + " -o " + scratch.quoted("a.hpp"));
  CHECK(kept.status == 0);
  CHECK(kept.out.empty());
  CHECK(text_of(scratch.path / "a.hpp") == shown.out);
}

TEST_CASE("scenes of linear and of second-order theory have no header together") {
  const Scratch scratch;
  const Outcome outcome = run_taut(scratch, "export " + quoted("arch.json") + " " + quoted("mast.json") +
                                                " -o " + scratch.quoted("a.hpp"));
  CHECK(outcome.status == 2);
  CHECK(outcome.err.find("/second_order") != std::string::npos);
  CHECK(outcome.err.find("a header of their own") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch.path / "a.hpp"));
}

TEST_CASE("a header does not overwrite its scene") {
  const Scratch scratch;
  std::filesystem::copy_file(TAUT_EXPORT "/wire.json", scratch.path / "wire.json");
  const Outcome outcome =
      run_taut(scratch, "export " + scratch.quoted("wire.json") + " -o " + scratch.quoted("wire.json"));
  CHECK(outcome.status == 2);
  CHECK(text_of(scratch.path / "wire.json") == text_of(TAUT_EXPORT "/wire.json"));
}

TEST_CASE("a scene that does not stand is not exported") {
  const Scratch scratch;
  write_loose_scene(scratch.path / "loose.json");
  const Outcome outcome =
      run_taut(scratch, "export " + scratch.quoted("loose.json") + " -o " + scratch.quoted("loose.hpp"));
  CHECK(outcome.status == 1);
  CHECK(outcome.err.find("node \"loose\": mechanism") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(scratch.path / "loose.hpp"));
}

}  // namespace header_test
