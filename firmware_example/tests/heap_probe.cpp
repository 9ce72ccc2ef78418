// Makes the firmware refer to the heap in one way: HEAP_PROBE is what. The link must fail.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

extern "C" void* sbrk(int by);

namespace {

volatile int amount = 3;
void* volatile kept;

struct Probe {
  Probe() {
    const auto size = static_cast<std::size_t>(amount);
    switch (HEAP_PROBE) {
      case 0:  // nothing
        kept = nullptr;
        break;
      case 1:
        kept = std::malloc(size);
        break;
      case 2:
        std::free(kept);
        break;
      case 3:
        kept = new int(amount);
        break;
      case 4:
        kept = new int[size];
        break;
      case 5:
        delete static_cast<int*>(kept);
        break;
      case 6:
        kept = sbrk(amount);
        break;
      case 7:
        kept = std::vector<int>(size).data();
        break;
      case 8:
        std::printf("%d", amount);
        break;
      case 9:
        kept = std::calloc(size, size);
        break;
      default:
        break;
    }
  }
};
const Probe probe;

}  // namespace
