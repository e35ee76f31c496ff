// Accesses to places, for access_count_test.py to count their instructions: access_count none|read|signed|write ROUNDS
#include <array>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "rtlib/core/memory.h"
#include "tests/unit/rtlib/test_program.h"

namespace {

using rung::core::Memory;
using rung::core::Place;

constexpr size_t kPlaces = 16;
using Places = std::array<Place, kPlaces>;

// The compiler knows nothing of `value` afterwards.
template <class T>
void hide(T& value) {
  asm volatile("" : "+r"(value));
}

// The loop is not unrolled, as the compiler does not know how far it goes.
template <class Access>
[[gnu::noinline]] void repeat(const Places& places, long rounds, Access access) {
  for (long round = 0; round < rounds; ++round)
    for (const Place* place = places.begin(); place != places.end(); ++place) {
      auto value = static_cast<uint64_t>(round);
      hide(place);
      hide(value);
      access(*place, value);
    }
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string_view work = argv[1];
  const long rounds = std::atol(argv[2]);
  rung::test::TestProgram test;
  test.addSpace("D", 4, {{0, 100, 0, RUNG_REPR_PACKED}, {100, 8, 100, RUNG_REPR_BYTE_PER_BIT}});
  test.link();
  std::vector<uint8_t> block(test.memorySize);
  const Memory memory(test.program, block.data());
  Places places;
  constexpr uint32_t kSizes[] = {1, 2, 4, 8};
  for (uint32_t i = 0; i < kPlaces; ++i)
    places[i] = i % 2 == 0 ? memory.locate(0, 5 * i, kSizes[i / 2 % 4]) : memory.locateBit(0, 7 * i, i % 8);
  const auto read = [memory](const Place& place, uint64_t) {
    uint64_t value = memory.read(place);
    hide(value);
  };
  const auto readSigned = [memory](const Place& place, uint64_t) {
    int64_t value = memory.readSigned(place);
    hide(value);
  };
  if (work == "none") repeat(places, rounds, [](const Place&, uint64_t) {});
  if (work == "read") repeat(places, rounds, read);
  if (work == "signed") repeat(places, rounds, readSigned);
  if (work == "write") repeat(places, rounds, [memory](const Place& p, uint64_t value) { memory.write(p, value); });
  return 0;
}
