// A program runs every millisecond on one thread; another thread prepares replacements and hands them over. After each
// replacement, and after the first scan that follows, every retained and every counting cell is compared with a model.
//
//   rung_replace FOLDER COUNT [--bounds]
//
// FOLDER has what rung_replace_programs has built. Prints what the replacements have cost the scan thread in processor
// time. 1: the state was wrong, or with --bounds the bounds were missed in all of kTries runs: what else the machine
// does shows in processor time, too, by its caches.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
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
constexpr double kMedianUs = 20, kPercentileUs = 50;
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

// Of sorted or unsorted times; 0 of none.
class Times {
public:
  void add(int64_t ns) { ns_.push_back(ns); }
  double us(double share) const {
    if (ns_.empty()) return 0;
    std::vector<int64_t> sorted = ns_;
    std::ranges::sort(sorted);
    const auto last = static_cast<double>(sorted.size() - 1);
    return static_cast<double>(sorted[static_cast<size_t>(share * last)]) / 1000;
  }
  void print(const char* what) const {
    std::printf("%-42s median %6.1f us, 99 %% %6.1f us, most %6.1f us\n", what, us(0.5), us(0.99), us(1));
  }
  // Less a time that would have passed anyway.
  Times beyond(double normalUs) const {
    Times out;
    for (const int64_t ns : ns_) out.add(ns - static_cast<int64_t>(normalUs * 1000));
    return out;
  }

private:
  std::vector<int64_t> ns_;
};

struct Figures {
  Times call;  // rung_instance_replace
  Times pass;  // the call and the pass that follows
  Times usual; // other passes
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
  // False: something was wrong, and the thread has ended.
  bool replace(const Replacement& replacement) {
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
    int64_t next = nsOf(CLOCK_MONOTONIC);
    while (!stop_ && !failed_) {
      next = std::max(next + kTickNs, nsOf(CLOCK_MONOTONIC)); // what is late is not caught up
      sleepUntil(next);
      const int64_t begin = processorNs();
      const int32_t status = plc_.runDue(kTickNs);
      spentNs_ += processorNs() - begin;
      if (status != RUNG_OK) fail("the program does not run", status);
      if (const rung_state state = plc_.state(); state.passes != passes_) passEnded(state);
    }
  }

  void passEnded(const rung_state& state) {
    passes_ = state.passes;
    model_.scan(state.now_us);
    (replaced_ ? figures_.pass : figures_.usual).add(spentNs_);
    spentNs_ = 0;
    if (replaced_) compare("after the first pass of the new program");
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
    replaced_ = true;
    compare("after the replacement");
    handed_ = nullptr;
  }

  void compare(const char* when) {
    check(rung_instance_read_all(plc_.handle(), cells_.data(), static_cast<uint32_t>(cells_.size()), values_.data()));
    const std::vector<int64_t> wanted = model_.values();
    for (size_t i = 0; i < wanted.size(); ++i) {
      if (values_[i].integer == wanted[i]) continue;
      std::printf("%s, pass %llu: %s is %lld, not %lld\n", when, static_cast<unsigned long long>(passes_),
                  Model::names()[i].c_str(), static_cast<long long>(values_[i].integer),
                  static_cast<long long>(wanted[i]));
      failed_ = true;
    }
  }
  void fail(const char* what, int32_t status) {
    std::printf("pass %llu: %s (%d)\n", static_cast<unsigned long long>(passes_), what, status);
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
  uint64_t passes_ = 0;
  int64_t spentNs_ = 0; // in the pass that runs
  bool replaced_ = false;
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
  bool good = true;
  for (uint32_t i = 0; good && i < count; ++i) {
    const Replacement replacement(machine.plc(), *images[kOrder[i % std::size(kOrder)]]);
    bytes += replacement.report().bytes;
    good = machine.replace(replacement);
    if (i % 8 == 7) good = good && machine.replace(replacement) && machine.replace(replacement); // back, and again
    (void)watch.newest();
  }
  good = machine.stop() && good;
  std::printf("%u replacements, each of %llu bytes of state on an average\n", count,
              static_cast<unsigned long long>(bytes / std::max(count, 1u)));
  return good;
}

bool withinBounds(const Figures& figures) {
  const double usual = figures.usual.us(0.5);
  const Times pause = figures.pass.beyond(usual);
  figures.usual.print("a pass of the schedule");
  figures.call.print("the call that replaces");
  pause.print("call and next pass, beyond a usual pass");
  return pause.us(0.5) <= kMedianUs && pause.us(0.99) <= kPercentileUs;
}

int main(const std::string& folder, uint32_t count, bool bounds) {
  Images images;
  for (const char* name : kNames) images.push_back(std::make_unique<Image>(folder + "/" + name + ".so"));
  for (int left = bounds ? kTries : 1; left > 0; --left) {
    Figures figures;
    if (!run(images, count, figures)) return 1;
    if (withinBounds(figures) || !bounds) return 0;
    std::printf("the bounds are %.0f us in the median and %.0f us in 99 %%\n", kMedianUs, kPercentileUs);
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
