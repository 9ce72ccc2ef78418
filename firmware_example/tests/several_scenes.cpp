// Several scenes in flash share one session: the device tells them apart, also after a power failure.
#include "rig.hpp"

namespace several_scenes_test {
using namespace rig;

namespace {

using monitor::FlashScene;
using Model = taut::Condensed<float, FlashScene::Capacity>;

/// The recorded experiment with more friction.
constexpr Model make_rough() {
  Model model = FlashScene::model();
  for (auto& ratio : model.rho.items) ratio *= 0.5;
  return model;
}
constexpr Model rough_model = make_rough();
struct Rough : FlashScene {
  static constexpr const Model& model() { return rough_model; }
};
constexpr std::uint32_t smooth = 0, rough = 1;

using Several = Rig<monitor::Application<monitor::host::MemoryBoard, monitor::Settings,
                                         monitor::FromFlash<FlashScene, Rough>>>;

std::uint32_t scene_of(const Fields& information) { return monitor::host::number_of(information.at(2)); }
std::uint32_t fingerprint_of(const Fields& information) {
  return monitor::host::number_of(information.at(12));
}
/// From zero.
Fields pull(Several& device) {
  device.ask(sample(1, {0, 0, 0}));
  return device.ask(sample(2, {40000, 30000, 20000}));
}

}  // namespace

TEST_CASE("scenes of one source have numbers one after the other, and answers of their own") {
  Several device;
  CHECK(scene_of(device.greeting) == smooth);
  CHECK(device.greeting.at(3) == number_field(2));
  const std::uint32_t of_smooth = fingerprint_of(device.greeting);
  const Fields with_smooth = pull(device);
  const Fields chosen = device.ask(choose(rough));
  CHECK(scene_of(chosen) == rough);
  CHECK(fingerprint_of(chosen) != of_smooth);
  const Fields with_rough = pull(device);
  CHECK(quality(with_rough) == 'g');
  // Segment 1 is at the jack, segment 0 behind the joint.
  CHECK(tension(with_rough, 1) == tension(with_smooth, 1));
  CHECK(tension(with_rough, 0) == doctest::Approx(static_cast<double>(tension(with_smooth, 0)) / 2));
  device.ask(choose(smooth));
  CHECK(state(pull(device)) == state(with_smooth));
  CHECK(device.ask(choose(2)) == Fields{"E", "scene"});
}

TEST_CASE("after a power failure the scene is the one that was chosen") {
  for (const std::uint32_t scene : {smooth, rough}) {
    Several device;
    device.ask(choose(scene));
    const Fields before = pull(device);
    device.boot();
    CHECK(scene_of(device.greeting) == scene);
    CHECK(state(device.ask("P")) == state(before));
  }
}

}  // namespace several_scenes_test
