// The step that a chart marks is where the interpreter continues: the machines of the examples under random inputs.
#include <algorithm>
#include <cstring>
#include <map>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "frontend/dialects/dialect.h"
#include "ir/core/ops.h"
#include "ir/interp/interp.h"
#include "rtlib/run/instance.h"
#include "tools/view/drawn_program.h"
#include "tools/view/overlay.h"

namespace rung::technol_test {
namespace {

constexpr int kScans = 1000;
constexpr int kFlips = 24; // bits that change before a scan

// The rungs of one run of a scan, by their number over all routines.
class Record final : public ir::RungObserver {
public:
  explicit Record(std::vector<uint32_t>& rungs) : rungs_(rungs) {}
  void rungRan(uint32_t number, std::span<const uint64_t>) override { rungs_.push_back(number); }

private:
  std::vector<uint32_t>& rungs_;
};

class Example : public runtime::ScheduleHooks {
public:
  explicit Example(const std::vector<std::string>& paths);

  void scan(std::mt19937& random);
  void onHook(runtime::Instance& instance, uint32_t work) override;

  uint32_t resumed = 0;                                     // comparisons
  uint32_t changed = 0;                                     // a rung before the unit has moved it to its beginning
  std::map<std::string, std::map<uint32_t, uint32_t>> seen; // by unit, state: comparisons

private:
  uint32_t stateOf(const std::string& continuation) const;
  void mark();
  void expectResumed();
  uint32_t markedRung(const view::Chart& chart) const;

  SourceManager sources_;
  std::optional<view::Program> drawing_;
  std::unique_ptr<ir::Module> module_;
  std::unique_ptr<ir::Layout> layout_;
  std::unique_ptr<ir::InterpEngine> engine_;
  std::unique_ptr<runtime::Instance> instance_;
  std::vector<uint32_t> numbers_;            // by number over all routines: that of the drawing
  std::vector<ir::SpaceBit> read_;           // bits of spaces that rungs read
  std::map<uint32_t, std::string> dispatch_; // the rung that decides where a unit continues: its continuation
  std::map<std::string, uint32_t> marked_;   // by continuation: the rung of the marked step; 0: no step
  std::vector<uint32_t> ran_;
  bool block_ = false;
};

Example::Example(const std::vector<std::string>& paths) {
  std::vector<FileId> files;
  for (const std::string& path : paths) files.push_back(sources_.addFile(path).value());
  const frontend::Dialect& dialect = *frontend::findDialect("technol");
  Diagnostics diagnostics;
  drawing_ = view::drawnProgram(sources_, files, dialect, {}, diagnostics);
  module_ = dialect.compile(sources_, files, {}, diagnostics);
  layout_ = std::make_unique<ir::Layout>(*module_, ir::LayoutOptions{});
  engine_ = std::make_unique<ir::InterpEngine>(*layout_, 1);
  engine_->setObserver(std::make_unique<Record>(ran_));
  instance_ = std::make_unique<runtime::Instance>(*engine_, this);
  for (const ir::Routine& routine : module_->routines)
    for (const ir::Rung& rung : routine.rungs) {
      // A unit's switch over its states is the only one with a target for each of its points.
      if (rung.transfer.kind == ir::TransferKind::Switch)
        for (const ir::Op& op : rung.ops)
          for (const ir::Continuation& cell : module_->continuations) {
            const bool isSlot = op.code == ir::OpCode::SlotLoad && cell.slot.valid() && op.ref == cell.slot.index;
            const bool isCell = op.code == ir::OpCode::Load && !cell.slot.valid() && op.ref == cell.space.index &&
                                op.imm == int64_t{cell.byte} * 8;
            if ((isSlot || isCell) && op.result == rung.transfer.value)
              dispatch_[static_cast<uint32_t>(numbers_.size())] = cell.key;
          }
      for (const ir::Op& op : rung.ops)
        if (op.code == ir::OpCode::Load && module_->spaces[op.ref].name != "MECH" &&
            !module_->spaces[op.ref].name.starts_with('@'))
          for (uint32_t bit = 0; bit < ir::bitWidth(op.type); ++bit)
            read_.push_back({ir::SpaceId{op.ref}, static_cast<uint32_t>(op.imm) + bit});
      numbers_.push_back(rung.number);
    }
  instance_->runTask("INIT");
}

// As a page reads it: from the place in the program's table.
uint32_t Example::stateOf(const std::string& continuation) const {
  const rung_program& program = instance_->program();
  for (uint32_t i = 0; i < program.continuation_count; ++i) {
    if (program.continuations[i].key != continuation) continue;
    uint32_t state = 0;
    std::memcpy(&state, instance_->memory().block() + program.continuations[i].offset, sizeof state);
    return state;
  }
  ADD_FAILURE() << "no cell " << continuation;
  return 0;
}

uint32_t Example::markedRung(const view::Chart& chart) const {
  const auto at = std::ranges::find(chart.waits, true);
  EXPECT_EQ(std::ranges::count(chart.waits, true), 1) << chart.sequence.name;
  return at == chart.waits.end() ? 0 : chart.sequence.parts[static_cast<size_t>(at - chart.waits.begin())].first;
}

void Example::mark() {
  view::Overlay overlay;
  for (const view::Chart& chart : drawing_->charts)
    overlay.steps.push_back({chart.sequence.continuation, stateOf(chart.sequence.continuation)});
  view::lay(overlay, *drawing_);
  for (const view::Chart& chart : drawing_->charts) marked_[chart.sequence.continuation] = markedRung(chart);
}

// The first drawn rung that ran after each switch is that of the step marked before the scan.
void Example::expectResumed() {
  std::map<std::string, bool> wasRun; // a unit that runs twice in a scan has moved in between
  for (size_t i = 0; i + 1 < ran_.size(); ++i) {
    const auto at = dispatch_.find(ran_[i]);
    if (at == dispatch_.end() || std::exchange(wasRun[at->second], true)) continue;
    size_t next = i + 1;
    while (next + 1 < ran_.size() && numbers_[ran_[next]] == 0) ++next;
    const uint32_t beginning = [&] {
      for (const view::Chart& chart : drawing_->charts)
        if (chart.sequence.continuation == at->second)
          for (const frontend::chart::Part& part : chart.sequence.parts)
            if (std::ranges::find(part.states, 0u) != part.states.end()) return part.first;
      return 0u;
    }();
    const uint32_t rung = numbers_[ran_[next]];
    if (rung != marked_[at->second] && rung == beginning) {
      ++changed; // MECH_INIT
      continue;
    }
    EXPECT_EQ(rung, marked_[at->second]) << at->second;
    ++resumed;
    ++seen[at->second][rung];
  }
}

void Example::onHook(runtime::Instance& instance, uint32_t work) {
  if (work == 1 && block_) instance.runTask("BLOCK_INIT");
}

// Bits that the program reads change, sometimes a mechanism is started.
void Example::scan(std::mt19937& random) {
  const core::Memory memory = instance_->memory();
  for (int i = 0; i < kFlips; ++i) {
    const ir::SpaceBit bit = read_[random() % read_.size()];
    memory.writeBit(bit.space.index, bit.bit / 8, bit.bit % 8,
                    !memory.readBit(bit.space.index, bit.bit / 8, bit.bit % 8));
  }
  if (random() % 4 == 0) {
    const ir::SpaceId mechanisms = ir::findSpace(*module_, "MECH");
    memory.writeBit(mechanisms.index, static_cast<uint32_t>(random()) % (module_->at(mechanisms).units / 3) * 3, 0,
                    true);
  }
  block_ = random() % 8 != 0;
  mark();
  ran_.clear();
  instance_->scan();
  expectResumed();
  if (instance_->fault().code != RUNG_NONE) {
    instance_ = std::make_unique<runtime::Instance>(*engine_, this);
    instance_->runTask("INIT");
  }
}

void run(const std::string& folder, const std::vector<std::string>& names, size_t units) {
  std::vector<std::string> paths;
  for (const std::string& name : names) paths.push_back(folder + "/" + name + ".plc");
  Example example(paths);
  std::mt19937 random(20261130);
  for (int i = 0; i < kScans; ++i) {
    example.scan(random);
    if (testing::Test::HasFailure()) return;
  }
  size_t places = 0;
  for (const auto& [unit, rungs] : example.seen) places += rungs.size();
  EXPECT_GE(example.seen.size(), units) << folder;
  EXPECT_GE(places, 2 * units) << folder;
  EXPECT_GT(example.resumed, 9 * example.changed) << folder;
  fmt::print("{}: {} units in {} places, {} comparisons, {} restarts\n", folder, example.seen.size(), places,
             example.resumed, example.changed);
}

TEST(Steps, OfTheMill) { run("examples/technol-mill", {"mill", "changer"}, 5); }

TEST(Steps, OfTheMachiningCentre) {
  run("examples/technol-machining-centre",
      {"main", "supply", "axes", "spindle", "changer", "clamping", "fluids", "panel", "probe", "outputs"}, 10);
}

TEST(Steps, OfTheMagazine) {
  run("examples/technol-magazine",
      {"main", "supply", "drive", "carousel", "spindle", "changer", "tools", "barcode", "outputs"}, 8);
}

} // namespace
} // namespace rung::technol_test
