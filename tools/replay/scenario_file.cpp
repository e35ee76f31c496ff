// Writes scenarios (see scenario_file.h).
#include "tools/replay/scenario_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

#include "compiler/project.h"
#include "ir/support/put.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/nc/names/names.h"
#include "sim/simulated_nc.h"
#include "tools/report/cross_reference.h"
#include "tools/report/place_names.h"
#include "tools/scenario/words.h"

namespace rung::replay {
namespace {

using runtime::PartKind;
using runtime::Ref;
using runtime::RefKind;

// What a `set` names: a bit, or the variable that it is a part of; "": nothing that can be named.
struct Named {
  std::string name;
  Ref place;
};

class Names {
public:
  explicit Names(const rung_program& program) : program_(program) {}

  const Named& of(const Ref& bit) {
    const auto key = std::tuple(bit.space, bit.byte, bit.bit);
    const auto known = named_.find(key);
    return known != named_.end() ? known->second : named_.emplace(key, find(bit)).first->second;
  }

private:
  Named find(const Ref& bit) const {
    if (std::string name = report::writtenName(program_, bit); !name.empty()) return {std::move(name), bit};
    for (const rung_symbol& symbol : std::span(program_.symbols, program_.symbol_count)) {
      if ((symbol.flags & (RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN)) != 0) continue;
      const Ref all = runtime::refOf(symbol);
      if (all.kind == RefKind::Text || !ir::overlap(report::bitsOf(all), report::bitsOf(bit))) continue;
      Ref one = all;
      one.count = 1;
      if (all.kind != RefKind::Bit) one.byte += (bit.byte - all.byte) / (all.width / 8u) * (all.width / 8u);
      if (std::string name = report::writtenName(program_, one); !name.empty()) return {std::move(name), one};
    }
    return {};
  }

  const rung_program& program_;
  std::map<std::tuple<uint32_t, uint32_t, uint32_t>, Named> named_;
};

// What the program gives to the machine and the control: a scenario expects it, whenever it has changed.
struct Output {
  std::string name;
  Ref place;
  std::optional<uint64_t> expected;
};
std::vector<Output> outputsOf(const rung_program& program, const ir::Uses& uses) {
  std::vector<Output> outputs, written;
  for (const report::UsedPlace& used : report::usedPlaces(program, uses)) {
    const Ref place = report::refOf(used.use);
    const bool isReal = place.kind == RefKind::Real || place.width == 64; // reals are moved as 64 bits, too
    if (!used.written || isReal) continue;
    if ((program.spaces[place.space].flags & RUNG_SPACE_HIDDEN) != 0) continue;
    std::string name = report::writtenName(program, place);
    if (name.empty()) continue;
    (report::isReadByControl(program, uses, place) ? outputs : written).push_back({std::move(name), place, {}});
  }
  return outputs.empty() ? written : outputs;
}

// Writes statements as the program is played. Sees the memory at the beginning of each part, when others have written.
class Inputs final : public runtime::OutsideWatch {
public:
  Inputs(const Past& past, ScenarioText& to)
      : uses_(*past.compiled().uses), nc_(sim::makeSimulatedNc(past.instance().program().dialect)),
        names_(past.instance().program()), program_(past.instance().program()), to_(to),
        outputs_(outputsOf(program_, uses_)) {}

  void know(const runtime::Instance& instance) { known_.assign(instance.block().begin(), instance.block().end()); }
  void begins(const runtime::Instance& instance, PartKind kind, uint32_t) noexcept override {
    if (depth_++ != 0) return;
    compare(instance);
    kind_ = kind;
  }
  void ended(const runtime::Instance& instance) noexcept override {
    if (--depth_ == 0) know(instance);
  }
  void withinBegins(const runtime::Instance&) noexcept override {}
  void withinEnded(const runtime::Instance&) noexcept override {}
  void requested(const runtime::Instance&, const core::ServiceRequest&, const core::ServiceReply*) noexcept override {}
  void replied(const runtime::Instance&, const core::ServiceReply&) noexcept override {}
  void written(const runtime::Instance&, uint32_t, uint32_t) noexcept override {}
  void surroundingsChanged(const runtime::Instance&) noexcept override {}
  void changedWhole(const runtime::Instance&) noexcept override {}

  // A part has run: counted, until something else is to be written. Slices are parts of a scan or slots.
  void count(const runtime::Instance& instance) {
    faulted_ = instance.faulted();
    switch (kind_) {
    case PartKind::Scan: return add("scan");
    case PartKind::Slot: return add("slot");
    case PartKind::Fast: return add("fast");
    case PartKind::Slice:
      if (nc_->control().runsInSlots()) return add("slot");
      withinScan_ = !instance.atListStart() && !instance.faulted();
      return withinScan_ ? void() : add("scan");
    case PartKind::SliceToFast:
    case PartKind::Task:
    case PartKind::Halt:
    case PartKind::PowerOff: ++otherParts_;
    }
  }
  void flush() {
    if (count_ == 0) return;
    rung::put(to_.text, "{} {}\n", word_, count_);
    count_ = 0;
    if (!faulted_) expect(false);
  }
  void finish() {
    flush();
    if (!faulted_) expect(true);
    const auto lacks = [&](uint64_t count, std::string_view what) {
      if (count != 0) to_.lacks.push_back(fmt::format("{}: {}", what, count));
    };
    if (!unnamed_.empty()) {
      const auto& [space, bit] = *unnamed_.begin();
      to_.lacks.push_back(fmt::format("written bits without a name, which cannot be set: {}, such as {}",
                                      unnamed_.size(),
                                      nc::describe(program_, runtime::bitRef(space, bit / 8, bit % 8))));
    }
    lacks(midScan_, "values written within a scan, which are set before the scan after it");
    lacks(otherParts_, "parts other than scans and slots: of a power-off, single tasks, a stop by the host");
  }

private:
  // Outputs that have changed since the last time, or all.
  void expect(bool all) {
    const core::Memory memory(program_, known_.data());
    for (Output& output : outputs_) {
      const uint64_t now = runtime::readRaw(memory, output.place);
      if (!all && output.expected.value_or(0) == now) continue;
      output.expected = now;
      rung::put(to_.text, "expect {} {}\n", scenario::asWord(output.name), now);
    }
  }
  void add(std::string_view word) {
    if (word != word_) flush();
    word_ = word;
    ++count_;
  }
  // The bits that are others than after the last part, except those that are forced.
  void compare(const runtime::Instance& instance) {
    const rung_program& program = instance.program();
    compareForces(instance);
    std::set<std::string> done;
    const core::Memory before(program, known_.data());
    const core::Memory now = instance.memory();
    for (uint32_t s = 0; s < program.space_count; ++s) {
      const rung_space& space = program.spaces[s];
      if ((space.flags & RUNG_SPACE_HIDDEN) != 0) continue;
      for (uint32_t byte = 0; byte < space.byte_count; ++byte) {
        const uint8_t changed = before.readByte(s, byte) ^ now.readByte(s, byte);
        for (uint32_t bit = 0; changed != 0 && bit < 8; ++bit)
          if ((changed >> bit & 1) != 0) set(instance, runtime::bitRef(s, byte, bit), done);
      }
    }
  }
  static bool isForced(const runtime::Instance& instance, const Ref& bit) {
    const core::Place at = runtime::locate(instance.memory(), bit);
    return std::ranges::any_of(instance.forcedBits(), [&](const core::ForcedBits& forced) {
      return !at.outside() && forced.offset == at.offset() && (forced.mask >> at.bit() & 1) != 0;
    });
  }
  void set(const runtime::Instance& instance, const Ref& bit, std::set<std::string>& done) {
    // What is copied over, or what the control itself writes, does not last.
    const rung_program& program = instance.program();
    if (isForced(instance, bit)) return;
    if (!uses_.copiedFrom(report::bitsOf(bit)).empty() || nc_->control().writesItself(program, bit)) return;
    const Named& named = names_.of(bit);
    if (named.name.empty()) {
      unnamed_.emplace(bit.space, bit.byte * 8 + bit.bit);
      return;
    }
    if (!done.insert(named.name).second) return;
    if (withinScan_) ++midScan_;
    flush();
    rung::put(to_.text, "set {} {}\n", scenario::asWord(named.name), valueOf(instance, named.place));
  }
  static std::string valueOf(const runtime::Instance& instance, const Ref& place) {
    if (place.kind == RefKind::Real) return fmt::format("{}", runtime::readReal(instance.memory(), place));
    return fmt::format("{}", runtime::readRaw(instance.memory(), place));
  }

  // Forces that begin or end, as bits.
  void compareForces(const runtime::Instance& instance) {
    std::map<std::string, bool> now;
    for (const core::ForcedBits& forced : instance.forcedBits()) {
      const auto byte = runtime::byteAt(instance.program(), forced.offset);
      for (uint32_t bit = 0; byte && bit < 8; ++bit) {
        const Ref place = runtime::bitRef(byte->space, byte->byte, bit);
        if (!isForced(instance, place) || !uses_.copiedFrom(report::bitsOf(place)).empty()) continue;
        const std::string& name = names_.of(place).name;
        if (!name.empty() && names_.of(place).place.kind == RefKind::Bit)
          now.emplace(name, (forced.value >> runtime::locate(instance.memory(), place).bit() & 1) != 0);
        else
          unnamed_.emplace(place.space, place.byte * 8 + place.bit);
      }
    }
    if (now == forces_) return;
    flush();
    for (const auto& [name, value] : forces_)
      if (!now.contains(name)) rung::put(to_.text, "unforce {}\n", scenario::asWord(name));
    for (const auto& [name, value] : now)
      if (const auto known = forces_.find(name); known == forces_.end() || known->second != value)
        rung::put(to_.text, "force {} {}\n", scenario::asWord(name), value ? 1 : 0);
    forces_ = std::move(now);
  }

  const ir::Uses& uses_;
  std::unique_ptr<sim::SimulatedNc> nc_;
  Names names_;
  const rung_program& program_;
  ScenarioText& to_;
  std::vector<Output> outputs_;
  std::vector<uint8_t> known_;         // the memory after the last part
  std::map<std::string, bool> forces_; // by the name of the bit
  PartKind kind_ = PartKind::Scan;
  std::string_view word_;
  uint64_t count_ = 0;
  uint32_t depth_ = 0;
  bool withinScan_ = false;
  bool faulted_ = false;
  std::set<std::pair<uint32_t, uint32_t>> unnamed_;
  uint64_t midScan_ = 0, otherParts_ = 0;
};

void putProgram(const Past& past, const std::string& path, std::string& text) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  if (compiler::findUpwards(folder.string())) return;
  text += "program";
  for (const std::string& file : past.compiled().shape->files)
    text += " " + scenario::asWord(std::filesystem::absolute(file).lexically_relative(folder).string());
  text += "\n";
}

// "" or why these parts cannot be a scenario.
std::string rangeProblem(const Past& past, uint64_t from, uint64_t to) {
  bool starts = from == past.firstPart();
  for (const Landmark& landmark : past.contents().landmarks) {
    const bool within = landmark.part > from && landmark.part < to;
    switch (landmark.kind) {
    case Landmark::Kind::Start:
      starts = starts || landmark.part == from;
      if (!within) break;
      return fmt::format(
          "after scan {0} the program was started again, or another state loaded: a scenario ends "
          "there (--to {0}), and another one begins there (--from {0}), unless another program took over",
          landmark.part);
    case Landmark::Kind::Lost:
    case Landmark::Kind::Damaged:
      if (within)
        return fmt::format("after scan {0} events are missing, so a scenario ends there (--to {0})", landmark.part);
      break;
    case Landmark::Kind::Note:
    case Landmark::Kind::Fault: break;
    }
  }
  return starts ? std::string()
                : fmt::format("a scenario begins with the start of the program, and not after scan {}; `marks` lists "
                              "the starts",
                              from);
}

// Events that have no statement.
void noteEvents(const Past& past, uint64_t from, uint64_t to, std::vector<std::string>& lacks) {
  using runtime::Event;
  std::map<std::string_view, uint64_t> counts;
  const Contents contents(past.recording(), [&](Event event, uint64_t part) {
    if (part < from || part >= to) return;
    switch (event) {
    case Event::Clock: ++counts["changes of the clock outside the program"]; break;
    case Event::Stopped: ++counts["stops and starts by the operator"]; break;
    case Event::Function:
    case Event::Abort: ++counts["functions that the host began or aborted"]; break;
    case Event::Task: ++counts["runs of tasks by the control, such as those of a block of a part program"]; break;
    case Event::Answer:
    case Event::Reply: ++counts["answers to requests, which the simulated control gives in its own way"]; break;
    default: break;
    }
  });
  for (const auto& [what, count] : counts) lacks.push_back(fmt::format("{}: {}", what, count));
}

// Whether state without a name, as of timers and edges, was another one than after a cold start.
bool beginsInside(const runtime::Instance& now, const runtime::Instance& cold) {
  const rung_program& program = now.program();
  std::vector<bool> named(now.block().size(), false);
  for (uint32_t s = 0; s < program.space_count; ++s)
    for (const rung_range& range : std::span(program.spaces[s].ranges, program.spaces[s].range_count)) {
      const uint32_t step = range.repr == RUNG_REPR_BYTE_PER_BIT ? 8 : 1;
      std::fill_n(named.begin() + range.offset, size_t{step} * range.byte_count, true);
    }
  for (size_t i = 0; i < named.size(); ++i)
    if (!named[i] && now.block()[i] != cold.block()[i]) return true;
  return false;
}

} // namespace

Result<ScenarioText> scenarioOf(Past& past, const std::string& path, uint64_t from, uint64_t to) {
  if (std::string problem = rangeProblem(past, from, to); !problem.empty()) return failure(std::move(problem));
  if (std::string problem = past.goTo(from); !problem.empty()) return failure(std::move(problem));
  ScenarioText scenario{fmt::format("# scans {} to {} of a recording\n", from + 1, to), {}};
  putProgram(past, path, scenario.text);
  Inputs inputs(past, scenario);
  {
    const std::unique_ptr<nc::Control> control = nc::makeControl(past.instance().program().dialect);
    runtime::Instance cold(past.flowEngine().engine(), control.get());
    control->powerOn(cold, nc::PowerOn::Cold);
    inputs.know(cold);
    if (beginsInside(past.instance(), cold))
      scenario.lacks.emplace_back("the recording begins with timers, edges and other state without a name that a "
                                  "cold start does not have");
  }
  noteEvents(past, from, to, scenario.lacks);
  const uint32_t program = past.programNumber();
  past.watch(&inputs);
  while (past.part() < to && past.next() && past.programNumber() == program) inputs.count(past.instance());
  past.watch(nullptr);
  inputs.finish();
  if (past.programNumber() != program && past.part() == from + 1)
    return failure(fmt::format("after scan {} another program took over, with the state of the former one: a scenario "
                               "begins with power-on, so what this program does cannot be one",
                               from));
  if (past.programNumber() != program)
    return failure(
        fmt::format("after scan {0} another program takes over: a scenario ends there (--to {0})", past.part() - 1));
  if (past.part() < to) return failure(past.problem().empty() ? "the recording ends before that" : past.problem());
  if (past.instance().faulted())
    rung::put(scenario.text, "# the program stops with a fault: {}\n", past.instance().faultText());
  return scenario;
}

} // namespace rung::replay
