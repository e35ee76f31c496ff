// A program runs every millisecond on one thread; another thread prepares replacements and hands them over. After the
// first scan that follows each, every retained and every counting cell is compared with a model: not before it, as that
// would warm and cool caches.
//
//   rung_replace FOLDER COUNT [--bounds]
//
// FOLDER has what rung_replace_programs has built. Prints what the replacements have cost the scan thread in processor
// time: the call alone, and the pause, which is the call with the first scan of the new program, less a usual scan of
// that program; the same quantile of both is compared. With --bounds the pause may not be longer than a usual pass, in
// the median and in 99 %: a ratio, which a slower machine has, too. Processor time is not free of what else the machine
// does: that empties caches. So there are kTries runs at most, of which one has to keep the bounds. 1: it was none, or
// the state was wrong in one.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <sched.h>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "ir/support/temporary_folder.h"
#include "rung/runtime.hpp"
#include "tests/replace/model.h"
#include "tests/replace/programs.h"

namespace rung::test {
namespace {

constexpr int64_t kTickNs = 1'000'000;
constexpr int kTries = 3;

int64_t nsOf(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now.tv_sec * INT64_C(1'000'000'000) + now.tv_nsec;
}
int64_t processorNs() { return nsOf(CLOCK_THREAD_CPUTIME_ID); }

void sleepUntil(int64_t ns) {
  const timespec until{static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

// As a thread in real time does: the last one that it may use.
void stayOnOneProcessor() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  int last = CPU_SETSIZE - 1;
  while (last > 0 && !CPU_ISSET(last, &allowed)) --last;
  CPU_ZERO(&allowed);
  CPU_SET(last, &allowed);
  (void)sched_setaffinity(0, sizeof allowed, &allowed);
}

class Times {
public:
  void add(int64_t ns) { ns_.push_back(ns); }
  size_t count() const { return ns_.size(); }
  // The quantile; 0 of none.
  double us(double share) const {
    if (ns_.empty()) return 0;
    std::vector<int64_t> sorted = ns_;
    std::ranges::sort(sorted);
    const auto last = static_cast<double>(sorted.size() - 1);
    return static_cast<double>(sorted[static_cast<size_t>(share * last)]) / 1000;
  }
  void print(const char* what) const {
    std::printf("%-28s median %6.1f us, 99 %% %6.1f us, most %6.1f us\n", what, us(0.5), us(0.99), us(1));
  }
  // Adds the times of others, less one that would have passed anyway.
  void addBeyond(const Times& others, double usualUs) {
    for (const int64_t ns : others.ns_) add(ns - static_cast<int64_t>(usualUs * 1000));
  }

private:
  std::vector<int64_t> ns_;
};

struct Figures {
  Times call; // rung_instance_replace
  // By the program that runs:
  Times first[kPrograms]; // the call and the scan that follows
  Times usual[kPrograms]; // other scans
};

// The running program and its machine, on a thread of their own.
class Machine {
public:
  Machine(const Image& image, const std::string& retained, Figures& figures) : plc_(image), figures_(figures) {
    for (const char* name : {"INP000", "INP001", "INP010", "INP011"}) plc_.bindInput(name, inputs_[bound_++]);
    plc_.bindOutput("OUT000", outputs_[0]);
    plc_.bindOutput("OUT010", outputs_[1]);
    plc_.keep(retained);
    plc_.powerOn(Power::Cold);
    for (const std::string& name : Model::names()) cells_.push_back(plc_.find(name));
    for (uint32_t i = 0; i < Model::writable(); ++i) writable_.push_back(plc_.find(Model::names()[i], Access::Write));
    values_.resize(cells_.size());
    thread_ = std::thread([this] { work(); });
  }
  ~Machine() { stop(); }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  Instance& plc() { return plc_; }
  // Which is the program number `next`. False: something was wrong, and the thread has ended.
  bool replace(const Replacement& replacement, uint32_t next) {
    next_ = next;
    handed_.store(replacement.handle());
    while (handed_.load() != nullptr && !failed_) std::this_thread::sleep_for(std::chrono::microseconds(100));
    return !failed_;
  }
  bool stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    return !failed_;
  }

private:
  void work() {
    stayOnOneProcessor();
    int64_t next = nsOf(CLOCK_MONOTONIC);
    while (!stop_ && !failed_) {
      next = std::max(next + kTickNs, nsOf(CLOCK_MONOTONIC)); // what is late is not caught up
      sleepUntil(next);
      const int64_t begin = processorNs();
      const int32_t status = plc_.runDue(kTickNs);
      spentNs_ += processorNs() - begin;
      if (status != RUNG_OK) fail("the program does not run", status);
      if (const rung_state state = plc_.state(); state.scans != scans_) scanEnded(state);
    }
  }

  void scanEnded(const rung_state& state) {
    scans_ = state.scans;
    model_.scan(state.now_us);
    (replaced_ ? figures_.first : figures_.usual)[program_].add(spentNs_);
    spentNs_ = 0;
    if (replaced_) compare();
    replaced_ = false;
    while (plc_.nextMessage()) {
    }
    live();
    if (rung_replacement* replacement = handed_.load(); replacement != nullptr) takeOver(replacement);
  }

  // What the machine and its operator do.
  void live() {
    if (random_() % 4 == 0) inputs_[random_() % bound_] = static_cast<int32_t>(random_());
    const auto cell = static_cast<uint32_t>(random_() % Model::writable());
    const int64_t value = Model::fitting(cell, static_cast<uint32_t>(random_()));
    plc_.write(writable_[cell], value);
    model_.write(cell, value);
  }

  void takeOver(rung_replacement* replacement) {
    const int64_t begin = processorNs();
    const int32_t status = rung_instance_replace(plc_.handle(), replacement);
    const int64_t ns = processorNs() - begin;
    if (status == RUNG_LATER) return;
    if (status != RUNG_OK) return fail(rung_error_text(), status);
    figures_.call.add(ns);
    spentNs_ = ns;
    program_ = next_;
    replaced_ = true;
    handed_ = nullptr;
  }

  void compare() {
    check(rung_instance_read_all(plc_.handle(), cells_.data(), static_cast<uint32_t>(cells_.size()), values_.data()));
    const std::vector<int64_t> wanted = model_.values();
    for (size_t i = 0; i < wanted.size(); ++i) {
      if (values_[i].integer == wanted[i]) continue;
      std::printf("%s, scan %llu: %s is %lld, not %lld\n", kNames[program_], static_cast<unsigned long long>(scans_),
                  Model::names()[i].c_str(), static_cast<long long>(values_[i].integer),
                  static_cast<long long>(wanted[i]));
      failed_ = true;
    }
  }
  void fail(const char* what, int32_t status) {
    std::printf("scan %llu: %s (%d)\n", static_cast<unsigned long long>(scans_), what, status);
    failed_ = true;
  }

  Instance plc_;
  Figures& figures_;
  int32_t inputs_[4] = {};
  int32_t outputs_[2] = {};
  uint32_t bound_ = 0;
  std::vector<rung_cell> cells_, writable_;
  std::vector<rung_value> values_;
  Model model_;
  std::mt19937 random_{3};
  uint64_t scans_ = 0;
  int64_t spentNs_ = 0; // in the scan that runs
  uint32_t program_ = 0;
  bool replaced_ = false;
  uint32_t next_ = 0; // the number of `handed_`
  std::atomic<rung_replacement*> handed_ = nullptr;
  std::atomic<bool> stop_ = false;
  std::atomic<bool> failed_ = false;
  std::thread thread_;
};

using Images = std::vector<std::unique_ptr<Image>>;

// Every program takes over from every other one.
constexpr uint32_t kOrder[] = {1, 2, 3, 0, 2, 1, 3, 1, 0, 3, 2, 0};

// False: the state was wrong.
bool run(const Images& images, uint32_t count, Figures& figures) {
  const TemporaryFolder folder;
  Machine machine(*images[0], (folder / "retained").string(), figures);
  const rung_cell watched[] = {machine.plc().find("SCANS"), machine.plc().find("OUT000")};
  Watch watch(machine.plc(), watched);
  uint64_t bytes = 0;
  uint32_t former = 0;
  bool good = true;
  for (uint32_t i = 0; good && i < count; ++i) {
    const uint32_t next = kOrder[i % std::size(kOrder)];
    Replacement replacement(machine.plc(), *images[next]);
    replacement.allowLate(); // under valgrind and sanitizers every program may be
    bytes += replacement.report().bytes;
    good = machine.replace(replacement, next);
    if (i % 8 == 7) good = good && machine.replace(replacement, former) && machine.replace(replacement, next);
    former = next;
    (void)watch.newest();
  }
  good = machine.stop() && good;
  std::printf("%zu replacements, of %llu bytes of state on average\n", figures.call.count(),
              static_cast<unsigned long long>(bytes / std::max(count, 1u)));
  return good;
}

double pauseUs(const Figures& figures, double share) {
  Times pause;
  for (uint32_t i = 0; i < kPrograms; ++i) pause.addBeyond(figures.first[i], figures.usual[i].us(share));
  return pause.us(share);
}

// Of the program with the shortest one.
double usualUs(const Figures& figures, double share) {
  double shortest = figures.usual[0].us(share);
  for (uint32_t i = 1; i < kPrograms; ++i) shortest = std::min(shortest, figures.usual[i].us(share));
  return shortest;
}

bool withinBounds(const Figures& figures) {
  for (uint32_t i = 0; i < kPrograms; ++i)
    figures.usual[i].print(("a usual scan of " + std::string(kNames[i])).c_str());
  figures.call.print("the call");
  const double median = pauseUs(figures, 0.5), percentile = pauseUs(figures, 0.99);
  std::printf("%-28s median %6.1f us, 99 %% %6.1f us\n", "the pause", median, percentile);
  return median <= usualUs(figures, 0.5) && percentile <= usualUs(figures, 0.99);
}

int main(const std::string& folder, uint32_t count, bool bounds) {
  Images images;
  for (const char* name : kNames) images.push_back(std::make_unique<Image>(folder + "/" + name + ".so"));
  for (int left = bounds ? kTries : 1; left > 0; --left) {
    Figures figures;
    if (!run(images, count, figures)) return 1;
    if (withinBounds(figures) || !bounds) return 0;
    std::printf("the pause is longer than a usual pass, in the median or in 99 %%\n");
  }
  return 1;
}

} // namespace
} // namespace rung::test

int main(int argc, char** argv) {
  const bool bounds = argc == 4 && std::string_view(argv[3]) == "--bounds";
  if (argc != 3 && !bounds) return 2;
  return rung::test::main(argv[1], static_cast<uint32_t>(std::atoi(argv[2])), bounds);
}
