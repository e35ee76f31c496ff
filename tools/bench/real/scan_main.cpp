// rung-bench-real PROGRAM.so STRAIGHT.so SEED SCANS [ours|straight FROM COUNT | cold]: runs a program and its
// straight-line form (straight.py) with the same random inputs, and compares all that the program can write after each
// scan. Seed 0: inputs and retained memory are 0 and stay so.
//   ours|straight  for callgrind, started with --collect-atstart=no: counts the scans FROM to FROM + COUNT of one of
//   both cold           each scan after a sleep of 1 ms; prints the microseconds of each, of ours and the other's
#include <dlfcn.h>
#include <valgrind/callgrind.h>

#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "rtlib/load/program_info.h"
#include "rtlib/load/so_engine.h"
#include "rtlib/run/instance.h"
#include "tools/bench/real/place.h"

namespace {

using namespace rung;

constexpr std::string_view kRetained = "KTCD", kCompared = "YGREAKTCD";
constexpr uint32_t kChangesAScan = 4, kFirstSystemRelay = 9000, kClocks = 9091, kFirstCycle = 9015;

bool isIn(std::string_view areas, char area) { return areas.find(area) != std::string_view::npos; }

template <class Type>
Type* symbol(void* library, const char* name) {
  void* found = library == nullptr ? nullptr : dlsym(library, name);
  if (found == nullptr) throw std::runtime_error(dlerror());
  return reinterpret_cast<Type*>(found);
}

// A straight-line form (straight.py).
class Straight {
public:
  // The library stays loaded: profilers look names up at exit.
  explicit Straight(const std::string& path)
      : library_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)), scan(symbol<void()>(library_, "scan")),
        places(symbol<Place>(library_, "places")), bits_(symbol<bool*()>(library_, "bits")()),
        area_(symbol<uint8_t*(char)>(library_, "area")) {}

  void put(const Place& place, uint8_t value) {
    area_(place.area)[place.byte] = value;
    for (int i = 0; i < 8 && place.inMemory == 0; ++i)
      if (place.bits[i] >= 0) bits_[place.bits[i]] = (value >> i & 1) != 0;
  }
  // `other`, with the value here of those bits that are named.
  uint8_t get(const Place& place, uint8_t other) const {
    if (place.inMemory != 0) return area_(place.area)[place.byte];
    for (int i = 0; i < 8; ++i)
      if (place.bits[i] >= 0) other = static_cast<uint8_t>((other & ~(1 << i)) | bits_[place.bits[i]] << i);
    return other;
  }

private:
  void* library_;

public:
  void (*scan)();
  const Place* places;

private:
  bool* bits_;
  uint8_t* (*area_)(char);
};

class Both {
public:
  Both(const std::string& program, const std::string& straight, uint64_t seed)
      : engine_(loaded(program)), ours_(*engine_), straight_(straight), random_(seed), quiet_(seed == 0) {
    for (const Place* place = straight_.places; place->area != 0; ++place) {
      if (place->area == 'X' || place->area == 'F') inputs_.push_back(place);
      if (isIn(kCompared, place->area) && !isOfTheControl(*place)) compared_.push_back(place);
      if (!quiet_ && isIn(kRetained, place->area)) write(*place, random_() % 4 == 0 ? byte() : 0);
    }
    for (size_t i = 0; !quiet_ && i < inputs_.size(); ++i) write(*inputs_[i], byte());
  }

  void change() {
    for (uint32_t i = 0; !quiet_ && !inputs_.empty() && i < kChangesAScan; ++i)
      write(*inputs_[random_() % inputs_.size()], byte());
  }
  void scanOurs() { ours_.scan(); }
  // Clocks and constants are those of the control.
  void passClocks(bool firstCycle) {
    constexpr uint8_t kOne = 2;
    straight_.put({'R', kClocks, 1, {}}, ours_.memory().readByte(spaceOf('R'), kClocks) | kOne);
    straight_.put({'R', kFirstCycle, 1, {}}, firstCycle ? 1 : 0);
  }
  void scanStraight() { straight_.scan(); }

  // Throws std::runtime_error at the first difference.
  void compare(size_t scan) const {
    if (ours_.faulted()) throw std::runtime_error("the program has stopped: " + ours_.faultText());
    for (const Place* place : compared_) {
      const uint8_t mine = ours_.memory().readByte(spaceOf(place->area), place->byte);
      const uint8_t theirs = straight_.get(*place, mine);
      if (mine != theirs)
        throw std::runtime_error("scan " + std::to_string(scan) + ": " + place->area + std::to_string(place->byte) +
                                 " is " + std::to_string(mine) + ", in straight-line C++ " + std::to_string(theirs));
    }
  }

private:
  static std::unique_ptr<runtime::Engine> loaded(const std::string& path) {
    std::string error;
    auto engine = runtime::SoEngine::open(path, error, {.loaded = runtime::Loaded::WithProcess, .mayLackSeal = true});
    if (engine == nullptr) throw std::runtime_error(error);
    return engine;
  }
  static bool isOfTheControl(const Place& place) { return place.area == 'R' && place.byte >= kFirstSystemRelay; }
  uint8_t byte() { return static_cast<uint8_t>(random_()); }
  uint32_t spaceOf(char area) const { return runtime::findSpace(engine_->program(), std::string(1, area).c_str()); }
  void write(const Place& place, uint8_t value) {
    ours_.memory().writeByte(spaceOf(place.area), place.byte, value);
    straight_.put(place, value);
  }

  std::unique_ptr<runtime::Engine> engine_;
  runtime::Instance ours_;
  Straight straight_;
  std::mt19937_64 random_;
  bool quiet_;
  std::vector<const Place*> inputs_, compared_;
};

struct Counted {
  bool straight = false;
  size_t from = 0, count = 0;
  bool has(size_t scan, bool isStraight) const { return isStraight == straight && scan >= from && scan < from + count; }
};

void run(Both& both, size_t scans, const Counted& counted) {
  for (size_t scan = 0; scan < scans; ++scan) {
    both.change();
    if (counted.has(scan, false)) CALLGRIND_TOGGLE_COLLECT;
    both.scanOurs();
    if (counted.has(scan, false)) CALLGRIND_TOGGLE_COLLECT;
    both.passClocks(scan == 0);
    if (counted.has(scan, true)) CALLGRIND_TOGGLE_COLLECT;
    both.scanStraight();
    if (counted.has(scan, true)) CALLGRIND_TOGGLE_COLLECT;
    if (RUNNING_ON_VALGRIND == 0 || scan + 1 == scans) both.compare(scan);
  }
}

double microseconds(std::chrono::steady_clock::duration time) {
  return std::chrono::duration<double, std::micro>(time).count();
}

template <class Scan>
double afterSleep(Scan scan) {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto begun = std::chrono::steady_clock::now();
  scan();
  return microseconds(std::chrono::steady_clock::now() - begun);
}

void runCold(Both& both, size_t scans) {
  for (size_t scan = 0; scan < scans; ++scan) {
    both.change();
    const double ours = afterSleep([&] { both.scanOurs(); });
    both.passClocks(scan == 0);
    const double theirs = afterSleep([&] { both.scanStraight(); });
    std::cout << ours << ' ' << theirs << '\n';
  }
}

} // namespace

int main(int argc, char** argv) try {
  const bool isCold = argc == 6 && std::string_view(argv[5]) == "cold";
  if (argc != 5 && argc != 8 && !isCold) {
    std::cerr << "usage: rung-bench-real PROGRAM.so STRAIGHT.so SEED SCANS [ours|straight FROM COUNT | cold]\n";
    return 2;
  }
  Counted counted;
  if (argc == 8)
    counted = {std::string(argv[5]) == "straight", std::strtoul(argv[6], nullptr, 10),
               std::strtoul(argv[7], nullptr, 10)};
  Both both(argv[1], argv[2], std::strtoull(argv[3], nullptr, 10));
  const size_t scans = std::strtoul(argv[4], nullptr, 10);
  if (isCold)
    runCold(both, scans);
  else
    run(both, scans, counted);
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "rung-bench-real: " << problem.what() << '\n';
  return 1;
}
