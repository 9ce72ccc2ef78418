// Nothing is allocated while a scene is validated, started and followed.
#include <cstdlib>
#include <new>

#ifdef EIGEN_RUNTIME_NO_MALLOC
// Eigen asserts that it may allocate; here its assertions count, in release builds too.
namespace {
volatile long failed_assertions = 0;
void count_failed_assertion() { failed_assertions = failed_assertions + 1; }
}  // namespace
#define eigen_assert(condition) ((condition) ? static_cast<void>(0) : count_failed_assertion())
#endif

#include <doctest/doctest.h>

#include <Eigen/Dense>

#include "support/scenes.hpp"
#include "taut/taut.hpp"

namespace {
// The compiler takes for granted that malloc() changes no variable of ours.
volatile long allocations = 0;
}  // namespace

// The linker sends every call of malloc() in this program to __wrap_malloc(), and so on.
extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* old, std::size_t size);
void* __real_aligned_alloc(std::size_t alignment, std::size_t size);
void* __real_memalign(std::size_t alignment, std::size_t size);
int __real_posix_memalign(void** made, std::size_t alignment, std::size_t size);

void* __wrap_malloc(std::size_t size) {
  allocations = allocations + 1;
  return __real_malloc(size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  allocations = allocations + 1;
  return __real_calloc(count, size);
}
void* __wrap_realloc(void* old, std::size_t size) {
  allocations = allocations + 1;
  return __real_realloc(old, size);
}
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t size) {
  allocations = allocations + 1;
  return __real_aligned_alloc(alignment, size);
}
void* __wrap_memalign(std::size_t alignment, std::size_t size) {
  allocations = allocations + 1;
  return __real_memalign(alignment, size);
}
int __wrap_posix_memalign(void** made, std::size_t alignment, std::size_t size) {
  allocations = allocations + 1;
  return __real_posix_memalign(made, alignment, size);
}
}

// The nothrow forms end in these.
[[gnu::noinline]] void* operator new(std::size_t size) {
  allocations = allocations + 1;
  void* const made = __real_malloc(size > 0 ? size : 1);
  if (made == nullptr) std::abort();
  return made;
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  allocations = allocations + 1;
  void* made = nullptr;
  if (__real_posix_memalign(&made, static_cast<std::size_t>(alignment), size) != 0) std::abort();
  return made;
}
[[gnu::noinline]] void* operator new[](std::size_t size) { return operator new(size); }
// Not inlined, so that the compiler does not see which of its functions the memory came from.
[[gnu::noinline]] void operator delete(void* old) noexcept { std::free(old); }
[[gnu::noinline]] void operator delete(void* old, std::size_t) noexcept { std::free(old); }
[[gnu::noinline]] void operator delete[](void* old) noexcept { std::free(old); }
[[gnu::noinline]] void operator delete[](void* old, std::size_t) noexcept { std::free(old); }
[[gnu::noinline]] void operator delete(void* old, std::align_val_t) noexcept { std::free(old); }
[[gnu::noinline]] void operator delete(void* old, std::size_t, std::align_val_t) noexcept { std::free(old); }

using namespace support;

namespace {

/// Allocations during a call; with Eigen's own guard also those that Eigen would not allow.
template <class Call>
long allocations_of(Call call) {
  const long before = allocations;
#ifdef EIGEN_RUNTIME_NO_MALLOC
  const long failed_before = failed_assertions;
  Eigen::internal::set_is_malloc_allowed(false);
  call();
  Eigen::internal::set_is_malloc_allowed(true);
  return allocations - before + failed_assertions - failed_before;
#else
  call();
  return allocations - before;
#endif
}

/// Hides from the compiler that nobody needs the memory.
void* volatile kept;

template <class Scalar, class SceneType>
void check_follows_without_allocating(const SceneType& scene) {
  static taut::Stepwise<Scalar, SceneType> solver;
  taut::Sample<Scalar, typename SceneType::Capacity> sample;
  taut::Status status;
  CHECK(allocations_of([&] { status = validate(scene); }) == 0);
  REQUIRE(status.ok());
  CHECK(allocations_of([&] { status = solver.start(scene, 3); }) == 0);
  REQUIRE(status.ok());
  bool moved = false;
  for (const Scalar part : {Scalar(1), Scalar(0.4), Scalar(1.3), Scalar(0)}) {
    sample.factor[0] = part;
    sample.jack[0][1].force = part * Scalar(2e5);
    CHECK(allocations_of([&] { status = solver.advance(sample, 2); }) == 0);
    REQUIRE(status.ok());
    moved = moved || solver.response().slip[0] != Scalar(0);
  }
  CHECK(moved);
  sample.jack[0][1] = {Scalar(-1), false};
  CHECK(allocations_of([&] { status = solver.advance(sample); }) == 0);
}

Plane plane;
Space space;

}  // namespace

TEST_CASE("what is allocated by C, by C++ and by Eigen is counted") {
  const auto counted = [](auto allocate) {
    const long before = allocations;
    allocate();
    return allocations - before;
  };
  CHECK(counted([] {
          kept = std::malloc(8);
          std::free(kept);
        }) == 1);
  CHECK(counted([] {
          kept = std::calloc(8, 8);
          kept = std::realloc(kept, 256);
          std::free(kept);
        }) == 2);
  CHECK(counted([] {
          int* const made = new int(3);
          kept = made;
          delete made;
        }) == 1);
  CHECK(counted([] {
          int* const made = new int[30];
          kept = made;
          delete[] made;
        }) == 1);
  CHECK(counted([] {
          Eigen::MatrixXd made(7, 7);
          kept = made.data();
        }) == 1);
}

#ifdef EIGEN_RUNTIME_NO_MALLOC
TEST_CASE("Eigen's own guard sees an allocation") {
  const long before = failed_assertions;
  Eigen::internal::set_is_malloc_allowed(false);
  Eigen::MatrixXd made(7, 7);
  Eigen::internal::set_is_malloc_allowed(true);
  kept = made.data();
  CHECK(failed_assertions - before >= 1);
}
#endif

TEST_CASE("a plane truss string structure is followed without an allocation") {
  truss_string(plane, steel_cable(0.2), 6);
  check_follows_without_allocating<double>(plane);
  check_follows_without_allocating<float>(plane);
}

TEST_CASE("a spatial truss string structure is followed without an allocation") {
  space_truss_string(space, steel_cable(0.2), 4);
  check_follows_without_allocating<double>(space);
  check_follows_without_allocating<float>(space);
}

TEST_CASE("saddles are followed without an allocation") {
  taut::Cable<double> cable = steel_cable(0.2);
  cable.law = taut::FrictionLaw::capstan;
  rigid_saddles(plane, cable, chain_points(6));
  plane.add_load();
  check_follows_without_allocating<double>(plane);
}

TEST_CASE("a hoop on struts and springs is started without an allocation") {
  taut::Cable<double> cable = steel_cable(0.2, anchored);
  cable.prestrain = 1e-3;
  dome_ring(space, cable, 6);
  static taut::Stepwise<double, Space> solver;
  taut::Status status;
  CHECK(allocations_of([&] { status = solver.start(space); }) == 0);
  CHECK(status.ok());
}

TEST_CASE("a scene that is refused is refused without an allocation") {
  truss_string(plane, steel_cable(-1), 6);
  static taut::Stepwise<double, Plane> solver;
  taut::Status status;
  CHECK(allocations_of([&] { status = solver.start(plane); }) == 0);
  CHECK(status.code == taut::Code::negative);
}
