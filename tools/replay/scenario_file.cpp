// Writes scenarios (see scenario_file.h).
#include "tools/replay/scenario_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
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
#include "tools/report/cross_reference.h"
#include "tools/report/place_names.h"
#include "tools/scenario/recorded_nc.h"
#include "tools/scenario/words.h"

namespace rung::replay {
namespace {

using runtime::PartKind;
using runtime::Ref;
using runtime::RefKind;

// How a statement names a place: a bit, or the variable that it is a part of.
struct Named {
  std::string name; // "": nothing that has a name
  Ref place;
  bool canSet = false; // by `set`, and the value lasts
};

// What a byte of the memory block is.
struct Owner {
  uint32_t space = RUNG_NONE, byte = 0; // of a space
  uint32_t slot = RUNG_NONE;            // of internal state
};

class Names {
public:
  Names(const rung_program& program, const ir::Uses& uses)
      : program_(program), uses_(uses), control_(nc::makeControl(program.dialect)), owners_(program.memory_size) {
    for (uint32_t i = 0; i < program.slot_count; ++i)
      for (uint32_t b = 0; b < runtime::slotBytes(program.slots[i]); ++b) owners_[program.slots[i].offset + b].slot = i;
    for (uint32_t at = 0; at < program.memory_size; ++at)
      if (const auto byte = runtime::byteAt(program, at)) owners_[at] = {byte->space, byte->byte, RUNG_NONE};
  }

  const Owner& ownerOf(size_t offset) const { return owners_[offset]; }
  const Named& of(const Ref& bit) {
    const auto key = std::tuple(bit.space, bit.byte, bit.bit);
    const auto known = named_.find(key);
    return known != named_.end() ? known->second : named_.emplace(key, complete(find(bit))).first->second;
  }

private:
  Named find(const Ref& bit) const {
    if ((program_.spaces[bit.space].flags & RUNG_SPACE_HIDDEN) != 0) return {};
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
  Named complete(Named named) const {
    if (named.name.empty()) return named;
    const auto read = nc::resolve(program_, named.name);
    if (!read || !(report::bitsOf(*read) == report::bitsOf(named.place))) return {};
    const auto place = control_->writePlace(program_, named.name);
    named.canSet = place && place->kind == named.place.kind && report::bitsOf(*place) == report::bitsOf(named.place) &&
                   uses_.copiedFrom(report::bitsOf(named.place)).empty();
    return named;
  }

  const rung_program& program_;
  const ir::Uses& uses_;
  std::unique_ptr<nc::Control> control_;
  std::vector<Owner> owners_; // by offset in the block
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

// The program as a scenario has it when it begins.
struct Cold {
  explicit Cold(Past& past) : nc(past.instance().program().dialect), instance(past.flowEngine().engine(), &nc) {
    powerOn();
  }
  void powerOn() { nc.powerOn(instance, nc::PowerOn::Cold); }
  scenario::RecordedNc nc;
  runtime::Instance instance;
};

// Writes statements as the program is played: what others did before each part, and at their turns within it.
class Inputs final : public runtime::OutsideWatch {
public:
  Inputs(const Past& past, ScenarioText& to)
      : program_(past.instance().program()), names_(program_, *past.compiled().uses), to_(to),
        outputs_(outputsOf(program_, *past.compiled().uses)),
        runsInSlots_(nc::makeControl(program_.dialect)->runsInSlots()) {}

  // The program is as after this cold start, before the next part.
  void starts(const Cold& cold) {
    after_.assign(cold.instance.block().begin(), cold.instance.block().end());
    stopped_ = false;
    forces_.clear();
    asked_.clear();
    requests_ = cold.nc.requestCount();
  }
  // It is switched on again before the next part: a control leaves signals of the machine as they were.
  void startsAgain(Cold& cold) {
    flush();
    std::ranges::copy(after_, cold.instance.block().begin());
    cold.powerOn();
    before_ += "cold_start\n";
    starts(cold);
  }

  void begins(const runtime::Instance& instance, PartKind kind, uint32_t number) noexcept override {
    if (depth_++ != 0) {
      compareWithin(instance);
      rung::put(before_, "within {} task {}\n", turnNow(), scenario::asWord(program_.tasks[number].name));
      return;
    }
    kind_ = kind;
    number_ = number;
    lastTurn_ = 0;
    compareBefore(instance);
  }
  void ended(const runtime::Instance& instance) noexcept override {
    if (--depth_ != 0) return knowWithin(instance);
    faulted_ = instance.faulted();
    addPart(instance);
    after_.assign(instance.block().begin(), instance.block().end());
    nowUs_ = instance.nowUs();
  }
  void withinBegins(const runtime::Instance& instance) noexcept override {
    turns_.push_back(++lastTurn_);
    knowWithin(instance);
  }
  void withinEnded(const runtime::Instance& instance) noexcept override {
    compareWithin(instance);
    turns_.pop_back();
    knowWithin(instance);
  }
  void requested(const runtime::Instance&, const core::ServiceRequest& request,
                 const core::ServiceReply* reply) noexcept override {
    asked_[request.ticket] = ++requests_;
    if (reply != nullptr && reply->state != RUNG_SERVICE_PENDING) putReply(0, "answer", *reply);
    if (request.service < program_.service_count) return;
    rung::put(before_, "within {} request {}", turnNow(), request.service);
    for (uint32_t i = 0; i < request.argCount; ++i) rung::put(before_, " {}", request.args[i]);
    before_ += "\n";
  }
  void replied(const runtime::Instance&, const core::ServiceReply& reply) noexcept override {
    if (asked_.contains(reply.ticket))
      putReply(turnNow(), "reply", reply);
    else
      ++unknownReplies_;
  }
  void written(const runtime::Instance&, uint32_t, uint32_t) noexcept override {}
  void surroundingsChanged(const runtime::Instance&) noexcept override {}
  void changedWhole(const runtime::Instance&) noexcept override {}

  void finish() {
    flush();
    if (!faulted_) expect(true);
    const auto lacks = [&](uint64_t count, std::string_view what) {
      if (count != 0) to_.lacks.push_back(fmt::format("{}: {}", what, count));
    };
    lacks(unnamedForces_.size(), "forced bits without a name, which cannot be forced");
    lacks(unknownReplies_, "answers to requests from before the first scan");
    lacks(slicesToFast_, "slices of which only the fast task ran at once, which run whole");
  }

private:
  uint32_t turnNow() const { return turns_.empty() ? 0 : turns_.back(); }
  void putReply(uint32_t turn, std::string_view action, const core::ServiceReply& reply) {
    rung::put(before_, "within {} {} {} {}", turn, action, asked_[reply.ticket],
              reply.state == RUNG_SERVICE_ERROR ? "error" : "done");
    for (uint32_t i = 0; i < reply.resultCount; ++i) rung::put(before_, " {}", reply.results[i]);
    before_ += "\n";
  }

  // ---- parts ----

  // A part has run: counted, until something else is to be written.
  void addPart(const runtime::Instance& instance) {
    if (!before_.empty()) flush();
    switch (kind_) {
    case PartKind::Scan: return add("scan");
    case PartKind::Slot: return add("slot");
    case PartKind::Fast: return add("fast");
    case PartKind::SliceToFast: ++slicesToFast_; return;
    case PartKind::Slice:
      if (runsInSlots_) return add("slot");
      add("slice");
      scans_ += instance.atListStart() || instance.faulted() ? 1 : 0;
      sliceRest_ = instance.atListStart() || instance.faulted() ? 0 : sliceRest_ + 1;
      return;
    case PartKind::Task: return act("task " + scenario::asWord(program_.tasks[number_].name));
    case PartKind::Halt: return act(fmt::format("halt {}", number_));
    case PartKind::PowerOff: return; // the runs of tasks in it are parts themselves
    }
  }
  void act(const std::string& action) {
    flush();
    to_.text += std::exchange(before_, {});
    rung::put(to_.text, "within 0 {}\n", action);
  }
  void add(std::string_view word) {
    if (word != word_) flush();
    hasActs_ = hasActs_ || before_.find("within ") != std::string::npos;
    to_.text += std::exchange(before_, {});
    word_ = word;
    ++count_;
  }
  // Slices that make whole scans are written as these, unless the control has a turn in one of them, whose number is
  // that in the slice.
  void flush() {
    if (count_ == 0) return;
    if (word_ == "slice" && scans_ != 0 && !hasActs_) {
      rung::put(to_.text, "scan {}\n", scans_);
      count_ = sliceRest_;
    }
    if (count_ != 0) rung::put(to_.text, "{} {}\n", word_, count_);
    count_ = scans_ = sliceRest_ = 0;
    hasActs_ = false;
    if (!faulted_) expect(false);
  }
  // Outputs that have changed since the last time, or all.
  void expect(bool all) {
    const core::Memory memory(program_, after_.data());
    for (Output& output : outputs_) {
      const uint64_t now = runtime::readRaw(memory, output.place);
      if (!all && output.expected.value_or(0) == now) continue;
      output.expected = now;
      rung::put(to_.text, "expect {} {}\n", scenario::asWord(output.name), now);
    }
  }

  // ---- what others wrote ----

  void knowWithin(const runtime::Instance& instance) {
    within_.assign(instance.block().begin(), instance.block().end());
  }
  void compareWithin(const runtime::Instance& instance) { compare(within_, instance, turnNow()); }
  void compareBefore(const runtime::Instance& instance) {
    if (instance.nowUs() != nowUs_) rung::put(before_, "within 0 clock {}\n", instance.nowUs() - nowUs_);
    if (instance.stopped() != stopped_) {
      stopped_ = instance.stopped();
      rung::put(before_, "plc {}\n", stopped_ ? "stop" : "start");
    }
    if (!instance.forcedBits().empty() || !forces_.empty()) compareForces(instance);
    compare(after_, instance, 0);
  }
  void compare(const std::vector<uint8_t>& before, const runtime::Instance& instance, uint32_t turn) {
    constexpr size_t kPiece = 64;
    const std::span<const uint8_t> now = instance.block();
    std::set<std::string> done;
    for (size_t at = 0; at < now.size(); at += kPiece) {
      const size_t end = std::min(at + kPiece, now.size());
      if (std::memcmp(before.data() + at, now.data() + at, end - at) == 0) continue;
      for (size_t i = at; i < end; ++i)
        if (before[i] != now[i]) putByte(instance, i, before[i] ^ now[i], turn, done);
    }
  }
  void putByte(const runtime::Instance& instance, size_t offset, uint32_t changed, uint32_t turn,
               std::set<std::string>& done) {
    for (const core::ForcedBits& forced : instance.forcedBits())
      if (forced.offset == offset) changed &= ~uint32_t{forced.mask};
    if (changed == 0) return;
    const Owner& owner = names_.ownerOf(offset);
    if (owner.slot != RUNG_NONE) return putState(instance, program_.slots[owner.slot], turn, done);
    if (owner.space == RUNG_NONE) return; // not used between two scans
    for (uint32_t bit = 0; bit < 8; ++bit) {
      const Ref place = runtime::bitRef(owner.space, owner.byte, bit);
      const core::Place at = runtime::locate(instance.memory(), place);
      if (at.outside() || at.offset() != offset || (changed >> at.bit() & 1) == 0) continue;
      put(instance, place, turn, done);
    }
  }
  void putState(const runtime::Instance& instance, const rung_slot& slot, uint32_t turn, std::set<std::string>& done) {
    if (!done.insert(fmt::format("state {}", slot.key)).second) return;
    uint64_t value = 0;
    std::memcpy(&value, instance.block().data() + slot.offset, runtime::slotBytes(slot));
    rung::put(before_, "within {} state {} {}\n", turn, scenario::asWord(slot.key), value);
  }
  void put(const runtime::Instance& instance, const Ref& bit, uint32_t turn, std::set<std::string>& done) {
    const Named& named = names_.of(bit);
    if (named.name.empty()) {
      const char* space = program_.spaces[bit.space].name;
      if (!done.insert(fmt::format("memory {} {}", space, bit.byte)).second) return;
      rung::put(before_, "within {} memory {} {} {}\n", turn, scenario::asWord(space), bit.byte,
                instance.memory().readByte(bit.space, bit.byte));
      return;
    }
    if (!done.insert(named.name).second) return;
    const std::string name = scenario::asWord(named.name);
    const bool isReal = named.place.kind == RefKind::Real;
    const double real = isReal ? runtime::readReal(instance.memory(), named.place) : 1;
    const bool isPlain = std::isfinite(real) && (real != 0 || !std::signbit(real));
    if (turn == 0 && named.canSet && isPlain && isReal) return rung::put(before_, "set {} {}\n", name, real);
    const uint64_t bits = runtime::readRaw(instance.memory(), named.place);
    if (turn == 0 && named.canSet && isPlain) return rung::put(before_, "set {} {}\n", name, bits);
    rung::put(before_, "within {} set {} {}\n", turn, name, bits);
  }

  // Forces that begin or end, as bits.
  void compareForces(const runtime::Instance& instance) {
    std::map<std::string, bool> now;
    for (const core::ForcedBits& forced : instance.forcedBits()) {
      const Owner& owner = names_.ownerOf(forced.offset);
      for (uint32_t bit = 0; owner.space != RUNG_NONE && bit < 8; ++bit) {
        const Ref place = runtime::bitRef(owner.space, owner.byte, bit);
        const core::Place at = runtime::locate(instance.memory(), place);
        if (at.outside() || at.offset() != forced.offset || (forced.mask >> at.bit() & 1) == 0) continue;
        const Named& named = names_.of(place);
        if (named.canSet && named.place.kind == RefKind::Bit)
          now.emplace(named.name, (forced.value >> at.bit() & 1) != 0);
        else if (named.name.empty() || named.place.kind != RefKind::Bit)
          unnamedForces_.emplace(place.space, place.byte * 8 + place.bit);
      }
    }
    if (now == forces_) return;
    for (const auto& [name, value] : forces_)
      if (!now.contains(name)) rung::put(before_, "unforce {}\n", scenario::asWord(name));
    for (const auto& [name, value] : now)
      if (const auto known = forces_.find(name); known == forces_.end() || known->second != value)
        rung::put(before_, "force {} {}\n", scenario::asWord(name), value ? 1 : 0);
    forces_ = std::move(now);
  }

  const rung_program& program_;
  Names names_;
  ScenarioText& to_;
  std::vector<Output> outputs_;
  bool runsInSlots_;
  std::string before_;                 // statements before the next part
  std::vector<uint8_t> after_;         // the memory after the last part
  std::vector<uint8_t> within_;        // and at the beginning of the present turn
  std::map<std::string, bool> forces_; // by the name of the bit
  std::map<uint32_t, uint32_t> asked_; // the number of a request since the start, by its ticket
  uint32_t requests_ = 0;
  int64_t nowUs_ = 0;
  bool stopped_ = false;
  bool faulted_ = false;

  // The present part.
  PartKind kind_ = PartKind::Scan;
  uint32_t number_ = 0;
  uint32_t depth_ = 0; // of runs of tasks within turns
  uint32_t lastTurn_ = 0;
  std::vector<uint32_t> turns_; // that are not over; a fault in one is another one
  // Parts that are not written yet.
  std::string_view word_;
  uint64_t count_ = 0;
  uint64_t scans_ = 0, sliceRest_ = 0; // of slices: whole scans, and those after them
  bool hasActs_ = false;

  std::set<std::pair<uint32_t, uint32_t>> unnamedForces_;
  uint64_t unknownReplies_ = 0, slicesToFast_ = 0;
};

// Whether a mark of a session says how the program was compiled (SessionRecorder).
bool isStart(std::string_view mark) { return mark.starts_with("config ") || mark.starts_with("period "); }

// Whether a scenario in this folder has these sources without naming them.
bool isOfProject(const std::filesystem::path& folder, const std::vector<std::string>& files) {
  const auto file = compiler::findUpwards(folder.string());
  if (!file) return false;
  SourceManager sources;
  Diagnostics diagnostics;
  const auto project = compiler::load(sources, *file, diagnostics);
  const auto same = [&](const std::string& one) {
    return std::ranges::any_of(files, [&](const std::string& other) {
      std::error_code none;
      return std::filesystem::equivalent(one, other, none);
    });
  };
  return project && std::ranges::all_of(project->files, same);
}

void putProgram(const Past& past, const std::string& path, ScenarioText& to) {
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  const std::vector<std::string>& files = past.compiled().shape->files;
  if (!isOfProject(folder, files)) {
    to.text += "program";
    for (const std::string& file : files) {
      to.text += " " + scenario::asWord(std::filesystem::absolute(file).lexically_relative(folder).string());
      if (!std::filesystem::exists(file))
        to.lacks.push_back(fmt::format("the source '{}' is not on this computer, and a recording has the program only "
                                       "in compiled form: name the source in the first statement",
                                       file));
    }
    to.text += "\n";
  }
  for (const Landmark& landmark : past.contents().landmarks)
    if (landmark.kind == Landmark::Kind::Note && isStart(landmark.text)) to.text += landmark.text + "\n";
  to.text += "control recorded\n";
}

// "" or why these parts cannot be a scenario.
std::string rangeProblem(const Past& past, uint64_t from, uint64_t to) {
  for (const Landmark& landmark : past.contents().landmarks) {
    const bool isGap = landmark.kind == Landmark::Kind::Lost || landmark.kind == Landmark::Kind::Damaged;
    if (isGap && landmark.part > from && landmark.part < to)
      return fmt::format("after scan {0} events are missing, so a scenario ends there (--to {0}), and another one "
                         "begins there (--from {0})",
                         landmark.part);
  }
  return {};
}

// Why the part after which the past is, is the first of another program.
std::string otherProgramText(const Past& past) {
  return fmt::format("after scan {0} another program takes over: a scenario ends there (--to {0}), and another one "
                     "begins there (--from {0})",
                     past.part() - 1);
}

} // namespace

Result<ScenarioText> scenarioOf(Past& past, const std::string& path, uint64_t from, uint64_t to) {
  if (std::string problem = rangeProblem(past, from, to); !problem.empty()) return failure(std::move(problem));
  if (std::string problem = past.goTo(from); !problem.empty()) return failure(std::move(problem));
  // The program of the first part, which takes over there at the earliest.
  if (!past.next()) return failure(past.problem().empty() ? "the recording ends before that" : past.problem());
  const uint32_t program = past.programNumber();
  ScenarioText scenario{.text = fmt::format("# scans {} to {} of a recording\n", from + 1, to)};
  putProgram(past, path, scenario);
  Cold cold(past);
  Inputs inputs(past, scenario);
  inputs.starts(cold);
  if (std::string problem = past.goTo(from); !problem.empty()) return failure(std::move(problem));
  if (past.programNumber() == program && !past.instance().atListStart())
    return failure(fmt::format("after scan {} of the recording the program is within a scan: a scenario begins between "
                               "two",
                               from));
  const auto startsAgain = [&](uint64_t part) {
    return part != from && std::ranges::any_of(past.contents().landmarksAt(part), [](const Landmark& landmark) {
             return landmark.kind == Landmark::Kind::Start;
           });
  };
  past.watch(&inputs);
  bool same = true;
  while (same && past.part() < to) {
    if (startsAgain(past.part())) inputs.startsAgain(cold);
    if (!past.next()) break;
    same = past.programNumber() == program;
  }
  past.watch(nullptr);
  if (!same) return failure(otherProgramText(past));
  inputs.finish();
  if (past.part() < to) return failure(past.problem().empty() ? "the recording ends before that" : past.problem());
  if (past.instance().faulted()) {
    scenario.fault = past.instance().faultText();
    scenario.fault = scenario.fault.substr(0, scenario.fault.find(" (")); // a scenario names the file from its folder
    rung::put(scenario.text, "# the program stops with a fault: {}\n", past.instance().faultText());
  }
  return scenario;
}

} // namespace rung::replay
