// rung-bench-generated: the bench's operations on one generated program. Commands that print sources need no compiled
// program; the others take one, and straight-line forms, as shared objects.
//
//   source DIALECT KIND SIZE               the program in its language; status 4 if the control has no room for it
//   straight KIND SIZE byte|packed         the straight-line form
//   structured-text KIND SIZE              the program for other vendors' compilers; status 4 if not expressible
//   rungs, places KIND SIZE                other inputs of a peer (peer.h)
//   instructions DIALECT                   the titles of the instructions with known costs
//   instruction DIALECT NUMBER COUNT       a program of COUNT rungs of one of them
//   check DIALECT KIND SIZE PROGRAM.so [byte|packed|peer FORM.so]...
//                                          all forms side by side, compared after every scan
//   count DIALECT KIND SIZE PROGRAM.so [byte|packed|peer FORM.so]...
//                                          under callgrind: scans of each form, with a dump for each
//   touch DIALECT KIND SIZE PROGRAM.so [byte|packed|peer FORM.so]...
//                                          under callgrind: one scan of the last form, from empty caches
//   cold DIALECT KIND SIZE PROGRAM.so [byte|packed|peer FORM.so]...
//                                          one form after the other, each scan after a sleep: nanoseconds as JSON
//   count-rungs, cold-rungs DIALECT NUMBER COUNT PROGRAM.so
//                                          the same for a program of equal rungs, with the condition 1
#include <valgrind/callgrind.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <exception>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "rtlib/load/so_engine.h"
#include "rtlib/run/realtime.h"
#include "tools/bench/generated/peer.h"
#include "tools/bench/generated/side.h"
#include "tools/bench/generated/structured_text.h"

namespace {

using namespace rung;
using Words = std::vector<std::string>;

constexpr int kNoRoom = 4;
constexpr int kSettleScans = 20;   // before the measurement
constexpr int kCheckedScans = 400; // compared one by one
constexpr int kCountedScans = 40;
constexpr int kWakeUps = 2000;
constexpr int kWakeUpsForRungs = 500; // fewer, because there are a hundred programs of them
constexpr auto kSleep = std::chrono::milliseconds(1);
constexpr int64_t kEarlyNs = 250'000;    // time before a scan: the most that rung-run allows, as a share of its period
constexpr size_t kOtherBytes = 2u << 20; // bytes that other work accesses meanwhile

struct WrongUsage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class T>
T good(Result<T> result) {
  if (!result.ok()) throw std::runtime_error(result.error());
  return std::move(result).value();
}

const std::string& at(const Words& words, size_t i) {
  if (i >= words.size()) throw WrongUsage("too few words");
  return words[i];
}

uint32_t number(const std::string& text) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) throw WrongUsage(text + " is not a number");
  return value;
}

std::unique_ptr<bench::Form> form(const std::string& dialect) {
  auto form = bench::formOf(dialect);
  if (!form) throw WrongUsage(dialect + " is not a dialect");
  return form;
}

bench::Work work(const std::string& kind, const std::string& size) {
  const auto known = bench::kindFromName(kind);
  if (!known) throw WrongUsage(kind + " is not a kind of program");
  return bench::drawWork(*known, number(size));
}

bench::BitForm bitForm(const std::string& text) {
  if (text != "byte" && text != "packed") throw WrongUsage(text + " is not byte, packed or peer");
  return text == "byte" ? bench::BitForm::Byte : bench::BitForm::Packed;
}

std::unique_ptr<runtime::SoEngine> load(const std::string& path) {
  std::string error;
  auto engine = runtime::SoEngine::open(path, error, {.loaded = runtime::Loaded::WithProcess, .mayLackSeal = true});
  if (!engine) throw std::runtime_error(error);
  return engine;
}

// All forms of one work that the command line names, Rung's first.
struct Forms {
  explicit Forms(const Words& words)
      : of(work(at(words, 2), at(words, 3))), program(good(form(at(words, 1))->write(of))), engine(load(at(words, 4))) {
    sides.push_back(good(bench::Ours::make(*engine, program)));
    for (size_t i = 5; i < words.size(); i += 2) sides.push_back(other(words[i], at(words, i + 1)));
  }
  std::unique_ptr<bench::Side> other(const std::string& form, const std::string& path) const {
    if (form == "peer") return good(bench::Peer::load(path, of, program.msAScan));
    return good(bench::Straight::load(path, of, bitForm(form), program.msAScan));
  }
  bench::Ours& ours() const { return static_cast<bench::Ours&>(*sides.front()); }
  std::vector<bench::Side*> others() const {
    std::vector<bench::Side*> all;
    for (size_t i = 1; i < sides.size(); ++i) all.push_back(sides[i].get());
    return all;
  }
  void checkFault() const {
    const runtime::Instance& running = ours().instance();
    if (running.faulted()) throw std::runtime_error("the program has stopped: " + running.faultText());
  }

  bench::Work of;
  bench::Program program;
  std::unique_ptr<runtime::SoEngine> engine;
  std::vector<std::unique_ptr<bench::Side>> sides;
};

void check(const Words& words) {
  Forms forms(words);
  bench::Machine machine(forms.of);
  for (auto& side : forms.sides) side->begin(machine);
  for (int i = 0; i < kCheckedScans; ++i) {
    const bench::Change change = machine.next();
    for (auto& side : forms.sides) {
      side->apply(change);
      side->scan();
    }
    forms.checkFault();
    const bench::Values ours = forms.sides.front()->values();
    for (size_t k = 1; k < forms.sides.size(); ++k)
      if (const std::string wrong = difference(ours, forms.sides[k]->values(), forms.program); !wrong.empty())
        throw std::runtime_error(fmt::format("scan {}, form {}: {}", i, k, wrong));
  }
}

void settle(bench::Side& side, bench::Machine& machine) {
  side.begin(machine);
  for (int i = 0; i < kSettleScans; ++i) {
    side.apply(machine.next());
    side.scan();
  }
}

void count(const Words& words) {
  const Forms forms(words);
  std::vector<bench::Values> ends;
  for (const auto& side : forms.sides) {
    bench::Machine machine(forms.of);
    settle(*side, machine);
    for (int i = 0; i < kCountedScans; ++i) {
      side->apply(machine.next());
      CALLGRIND_TOGGLE_COLLECT;
      side->scan();
      CALLGRIND_TOGGLE_COLLECT;
    }
    CALLGRIND_DUMP_STATS;
    ends.push_back(side->values());
    if (const std::string wrong = difference(ends.front(), ends.back(), forms.program); !wrong.empty())
      throw std::runtime_error(wrong);
  }
  forms.checkFault();
  std::cout << kCountedScans << '\n';
}

void touch(const Words& words) {
  const Forms forms(words);
  bench::Side& side = *forms.sides.back();
  bench::Machine machine(forms.of);
  settle(side, machine);
  side.apply(machine.next());
  CALLGRIND_START_INSTRUMENTATION;
  side.scan();
  CALLGRIND_STOP_INSTRUMENTATION;
}

// Simulates the other work of the processor while a task sleeps.
class OtherWork {
public:
  OtherWork() : bytes_(kOtherBytes) {}
  void run() {
    for (size_t i = 0; i < bytes_.size(); i += 64) ++bytes_[i];
  }

private:
  std::vector<uint8_t> bytes_;
};

double timed(bench::Side& side) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  side.scan();
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

void printList(const std::vector<std::vector<double>>& lists) {
  std::cout << '[';
  for (size_t k = 0; k < lists.size(); ++k) {
    std::cout << (k == 0 ? "[" : ",[");
    for (size_t i = 0; i < lists[k].size(); ++i) std::cout << (i == 0 ? "" : ",") << fmt::format("{:.0f}", lists[k][i]);
    std::cout << ']';
  }
  std::cout << "]\n";
}

// Sleeps until shortly before the scan, then prefetches as a host does until it is due.
void sleepAndTouch(const bench::Ours& ours) {
  const int64_t due = runtime::monotonicNs() + std::chrono::nanoseconds(kSleep).count();
  runtime::sleepUntil(due - kEarlyNs);
  ours.touch(due);
  runtime::waitAwake(due);
}

// Three lists for each form, Rung's first: hot, after a sleep, after other work and a sleep. The last list is Rung's
// again: after a sleep that ends early.
template <class Apply>
void measure(bench::Ours& ours, const std::vector<bench::Side*>& others, int wakeUps, Apply apply) {
  std::vector<bench::Side*> sides = {&ours};
  sides.insert(sides.end(), others.begin(), others.end());
  std::vector<std::vector<double>> times(3 * sides.size() + 1);
  OtherWork other;
  for (int i = 0; i < wakeUps; ++i)
    for (size_t k = 0; k < sides.size(); ++k) {
      apply(*sides[k], k);
      sides[k]->scan();
      apply(*sides[k], k);
      times[3 * k].push_back(timed(*sides[k]));
    }
  for (int i = 0; i < wakeUps; ++i) {
    for (const bool disturbed : {false, true})
      for (size_t k = 0; k < sides.size(); ++k) {
        apply(*sides[k], k);
        if (disturbed) other.run();
        std::this_thread::sleep_for(kSleep);
        times[3 * k + (disturbed ? 2 : 1)].push_back(timed(*sides[k]));
      }
    apply(ours, 0);
    sleepAndTouch(ours);
    times.back().push_back(timed(ours));
  }
  printList(times);
}

void cold(const Words& words) {
  const Forms forms(words);
  std::vector<bench::Machine> machines;
  for (const auto& side : forms.sides) settle(*side, machines.emplace_back(forms.of));
  measure(forms.ours(), forms.others(), kWakeUps, [&](bench::Side& side, size_t k) { side.apply(machines[k].next()); });
  forms.checkFault();
}

std::string instructionText(const bench::Form& form, const std::string& index) {
  const auto all = form.instructions();
  const uint32_t i = number(index);
  if (i >= all.size()) throw WrongUsage("there is no instruction " + index);
  return all[i].text;
}

void onRungs(const Words& words, bool cold) {
  const auto of = form(at(words, 1));
  const bench::Program program = of->repeat(instructionText(*of, at(words, 2)), number(at(words, 3)));
  const auto engine = load(at(words, 4));
  const auto ours = good(bench::Ours::make(*engine, program));
  ours->beginWith(true);
  for (int i = 0; i < kSettleScans; ++i) ours->scan();
  if (cold) {
    measure(*ours, {}, kWakeUpsForRungs, [](bench::Side&, size_t) {});
  } else {
    for (int i = 0; i < kCountedScans; ++i) {
      CALLGRIND_TOGGLE_COLLECT;
      ours->scan();
      CALLGRIND_TOGGLE_COLLECT;
    }
    std::cout << kCountedScans << '\n';
  }
  if (ours->instance().faulted()) throw std::runtime_error("the program has stopped: " + ours->instance().faultText());
}

int printed(const Result<std::string>& text) {
  if (!text.ok()) {
    std::cerr << text.error() << '\n';
    return kNoRoom;
  }
  std::cout << text.value();
  return 0;
}

Result<std::string> sourceOf(const std::string& dialect, const bench::Work& work) {
  auto program = form(dialect)->write(work);
  if (!program.ok()) return program.failure();
  return std::move(program).value().text;
}

int run(const Words& words) {
  const std::string& command = at(words, 0);
  if (command == "source") {
    return printed(sourceOf(at(words, 1), work(at(words, 2), at(words, 3))));
  } else if (command == "structured-text") {
    return printed(structuredText(work(at(words, 1), at(words, 2))));
  } else if (command == "rungs") {
    return printed(peerRungs(work(at(words, 1), at(words, 2))));
  } else if (command == "places") {
    std::cout << peerPlaces(work(at(words, 1), at(words, 2)));
  } else if (command == "straight") {
    std::cout << straightSource(work(at(words, 1), at(words, 2)), bitForm(at(words, 3)));
  } else if (command == "instructions") {
    for (const bench::Instruction& row : form(at(words, 1))->instructions()) std::cout << row.title << '\n';
  } else if (command == "instruction") {
    const auto of = form(at(words, 1));
    std::cout << of->repeat(instructionText(*of, at(words, 2)), number(at(words, 3))).text;
  } else if (command == "check") {
    check(words);
  } else if (command == "count") {
    count(words);
  } else if (command == "touch") {
    touch(words);
  } else if (command == "cold") {
    cold(words);
  } else if (command == "count-rungs" || command == "cold-rungs") {
    onRungs(words, command == "cold-rungs");
  } else {
    throw WrongUsage(command + " is not a command");
  }
  return 0;
}

} // namespace

int main(int argc, char** argv) try { return run(Words(argv + 1, argv + argc)); } catch (const WrongUsage& wrong) {
  std::cerr << "rung-bench-generated: " << wrong.what() << '\n';
  return 2;
} catch (const std::exception& problem) {
  std::cerr << "rung-bench-generated: " << problem.what() << '\n';
  return 1;
}
