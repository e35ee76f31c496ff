// The power that the page shows, against what the interpreter reads while it evaluates the rungs of the examples: a
// contact conducts as the bit that it read says, and a coil has power if a way from the left rail leads to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compiler/compile.h"
#include "compiler/engines.h"
#include "rtlib/load/ref.h"
#include "tools/report/place_names.h"
#include "tools/scenario/in_project.h"
#include "tools/scenario/runner.h"
#include "tools/view/drawn_program.h"
#include "tools/web/flow_observer.h"
#include "tools/web/shown_program.h"

namespace rung::web {
namespace {

using view::Cell;

constexpr uint64_t kMostScans = 1000; // that are compared, of each example

struct Counts {
  uint64_t scans = 0;
  uint64_t contacts = 0; // whose bit the rung has read where the drawing says
  uint64_t unread = 0;   // others: edges, computed addresses
  uint64_t coils = 0;
};

// Whether a way from the left rail leads to the cell, by all rows of the sheet; `states`: of its cells.
bool hasPower(const view::Sheet& sheet, const std::vector<uint8_t>& states, uint32_t cell) {
  for (const view::Row& row : sheet.rows) {
    for (size_t i = 1; i < row.stops.size(); ++i) {
      if (row.stops[i].cell != cell || !row.stops[i].joined) continue;
      const uint32_t from = row.stops[i - 1].cell;
      const Cell& before = sheet.cells[from];
      const uint8_t state = states[from];
      if (before.kind == Cell::Kind::Rail) return true;
      if (before.kind == Cell::Kind::Contact && (state & kOn) == 0) continue;
      if (before.kind == Cell::Kind::Box && (state & kResultKnown) != 0) {
        if ((state & kResult) == 0) continue;
        if ((state & kConducts) == 0) return true;
      }
      if (hasPower(sheet, states, from)) return true;
    }
  }
  return false;
}

// One program while scenarios drive it.
class Truth final : public ir::RungObserver {
public:
  Truth(const compiler::Compiled& compiled, const view::Program& drawing, Counts& counts)
      : drawing_(drawing), shown_(drawing), flow_(*compiled.module, compiled.marks, shown_), counts_(counts),
        uses_(*compiled.uses) {
    for (const ir::Routine& routine : compiled.module->routines)
      for (const ir::Rung& rung : routine.rungs) numbers_.push_back(rung.number);
  }

  void start(scenario::Session& session) {
    session_ = &session;
    const rung_program& program = session.instance().program();
    places_.assign(shown_.elementCount(), std::nullopt);
    for (uint32_t row = 0; row < shown_.rows().size(); ++row) {
      const Row& one = shown_.rows()[row];
      if (one.kind != Row::Kind::Rung) continue;
      const std::vector<Cell>& cells = drawing_.figures[one.index].sheet.cells;
      for (uint32_t i = 0; i < cells.size(); ++i) {
        if (cells[i].kind != Cell::Kind::Contact || (!cells[i].mark.empty() && cells[i].mark != "/")) continue;
        if (const auto place = session.nc().readPlace(program, cells[i].operand.name))
          places_[one.firstElement + i] = report::bitsOf(*place);
      }
    }
    for (const ShownProgram::Contact& contact : shown_.contacts())
      if (const auto place = session.nc().readPlace(program, contact.name); place && !flow_.shows(contact.element))
        flow_.setConstant(contact.element, (session.instance().read(*place) != 0) != contact.negated);
  }

  void touched(uint32_t, const ir::BitRange& place, bool writes) override {
    if (writes || place.count != 1 || session_ == nullptr) return;
    const runtime::Ref bit = runtime::bitRef(place.space.index, 0, place.first);
    reads_.try_emplace(knownAs({place.space.index, place.first}, place), session_->instance().read(bit) != 0);
  }

  void rungRan(uint32_t number, std::span<const uint64_t> values) override {
    flow_.rungRan(number, values);
    const auto row = shown_.rowOf(numbers_[number]);
    if (row && !values.empty() && session_ != nullptr && counts_.scans < kMostScans) compare(shown_.rows()[*row]);
    reads_.clear();
  }

  void scanned() {
    if (counts_.scans++ >= kMostScans) return;
    const std::vector<uint8_t> states = flow_.states();
    for (uint32_t row = 0; row < shown_.rows().size(); ++row) {
      const std::string text = shown_.flow(row, states);
      if (!text.empty()) compareCoils(shown_.rows()[row], text, states);
    }
    flow_.beginScan();
  }

private:
  using Bit = std::pair<uint32_t, uint32_t>; // space and bit

  // For a latch of the compiler, the bit that was copied to it.
  Bit knownAs(Bit bit, const ir::BitRange& place) {
    const auto [found, isNew] = known_.try_emplace(bit, bit);
    if (isNew)
      if (const auto known = report::knownPlace(session_->instance().program(), uses_, place))
        found->second = {known->space.index, known->first};
    return found->second;
  }

  // The contacts of a rung that has just run.
  void compare(const Row& row) {
    const std::vector<uint8_t> states = flow_.states();
    const std::vector<Cell>& cells = drawing_.figures[row.index].sheet.cells;
    for (uint32_t i = 0; i < cells.size(); ++i) {
      const uint8_t state = states[row.firstElement + i];
      if (cells[i].kind != Cell::Kind::Contact || (state & kEvaluated) == 0) continue;
      const auto& place = places_[row.firstElement + i];
      const auto read = place ? reads_.find({place->space.index, place->first}) : reads_.end();
      if (read == reads_.end()) {
        ++counts_.unread;
        continue;
      }
      ++counts_.contacts;
      ASSERT_EQ((state & kOn) != 0, read->second != (cells[i].mark == "/"))
          << "rung " << row.number << ", contact " << cells[i].operand.name;
    }
  }

  void compareCoils(const Row& row, const std::string& text, const std::vector<uint8_t>& all) {
    const view::Sheet& sheet = drawing_.figures[row.index].sheet;
    const std::vector<uint8_t> states(all.begin() + row.firstElement, all.begin() + row.firstElement + row.elements);
    for (uint32_t i = 0; i < sheet.cells.size(); ++i) {
      if (sheet.cells[i].kind != Cell::Kind::Coil || text[i] == '-') continue;
      ++counts_.coils;
      const bool power = hasPower(sheet, states, i);
      ASSERT_EQ(((text[i] - '0') & 1) != 0, power) << "rung " << row.number << ", coil " << sheet.cells[i].operand.name;
      ASSERT_EQ(((text[i] - '0') & 2) != 0, power) << "rung " << row.number << ", coil " << sheet.cells[i].operand.name;
    }
  }

  const view::Program& drawing_;
  const ShownProgram shown_;
  FlowObserver flow_;
  Counts& counts_;
  std::vector<uint32_t> numbers_;                   // of the source, by rung over all routines
  std::vector<std::optional<ir::BitRange>> places_; // by element
  const ir::Uses& uses_;
  std::map<Bit, Bit> known_;
  std::map<Bit, bool> reads_; // of the rung that runs
  scenario::Session* session_ = nullptr;
};

class Scans final : public scenario::Observer {
public:
  explicit Scans(Truth& truth) : truth_(truth) {}
  void scanned(const scenario::Session&) override { truth_.scanned(); }

private:
  Truth& truth_;
};

view::Program drawingOf(const compiler::Compiled& compiled) {
  SourceManager sources;
  const auto files = compiler::addFiles(sources, compiled.module->files, compiled.options.config);
  EXPECT_TRUE(files.ok());
  frontend::CompileOptions options = compiled.options;
  options.configPlaces.clear();
  Diagnostics diagnostics;
  auto drawing = view::drawnProgram(sources, files.value(), *compiled.dialect, options, diagnostics);
  EXPECT_TRUE(drawing.has_value());
  return std::move(*drawing);
}

class Forward final : public ir::RungObserver {
public:
  explicit Forward(Truth& truth) : truth_(truth) {}
  void touched(uint32_t number, const ir::BitRange& place, bool writes) override {
    truth_.touched(number, place, writes);
  }
  void rungRan(uint32_t number, std::span<const uint64_t> values) override { truth_.rungRan(number, values); }

private:
  Truth& truth_;
};

void runScenario(const std::string& path, Counts& counts) {
  auto scenario = scenario::readScenario(path);
  ASSERT_TRUE(scenario.ok());
  scenario::takeProject(scenario.value());
  std::optional<view::Program> drawing;
  std::unique_ptr<Truth> truth;
  std::unique_ptr<Scans> scans;
  scenario::RunOptions options{.engines = {compiler::EngineKind::Interp}};
  options.engine.observer = [&](const compiler::Compiled& compiled) {
    if (truth == nullptr) {
      drawing = drawingOf(compiled);
      truth = std::make_unique<Truth>(compiled, *drawing, counts);
    }
    return std::make_unique<Forward>(*truth);
  };
  options.started = [&](scenario::Session& session, const compiler::Compiled&) {
    truth->start(session);
    scans = std::make_unique<Scans>(*truth);
    session.addObserver(*scans);
    return std::string();
  };
  (void)scenario::run(scenario.value(), options);
}

class FlowOf : public testing::TestWithParam<const char*> {};

TEST_P(FlowOf, IsWhatTheRungsRead) {
  Counts counts;
  std::set<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(std::string("examples/") + GetParam()))
    if (entry.path().extension() == ".scn") paths.insert(entry.path().string());
  for (const std::string& path : paths) {
    if (counts.scans >= kMostScans) break;
    SCOPED_TRACE(path);
    runScenario(path, counts);
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(counts.scans, kMostScans);
  EXPECT_GT(counts.contacts, 10'000u);
  EXPECT_GT(counts.contacts, counts.unread);
  EXPECT_GT(counts.coils, 1000u);
}

INSTANTIATE_TEST_SUITE_P(Examples, FlowOf, testing::Values("gsk-mill", "fanuc-vmc", "nct-lathe", "nct-turning-centre"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

} // namespace
} // namespace rung::web
