// The power that the page shows, against what the interpreter reads while it evaluates the rungs of the examples: a
// contact conducts as the bit that it read says, and a coil has power if a way from the left rail leads to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "sim/simulated_nc.h"
#include "tools/replay/past.h"
#include "tools/replay/record_run.h"
#include "tools/report/place_names.h"
#include "tools/scenario/in_project.h"
#include "tools/scenario/runner.h"
#include "tools/view/drawn_program.h"
#include "tools/web/element_states.h"
#include "tools/web/paced_source.h"
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

// The past of one scenario.
class Truth {
public:
  Truth(replay::Past& past, Counts& counts)
      : past_(past), nc_(sim::makeSimulatedNc(past.instance().program().dialect)), drawing_(drawingOf(past.compiled())),
        shown_(drawing_), states_(past.flowEngine(), shown_), names_(shown_, past.instance(), *nc_, states_),
        counts_(counts), places_(shown_.elementCount()) {
    for (uint32_t row = 0; row < shown_.rows().size(); ++row) {
      const Row& one = shown_.rows()[row];
      if (one.kind != Row::Kind::Rung) continue;
      const std::vector<Cell>& cells = drawing_.figures[one.index].sheet.cells;
      for (uint32_t i = 0; i < cells.size(); ++i) {
        if (cells[i].kind != Cell::Kind::Contact || (!cells[i].mark.empty() && cells[i].mark != "/")) continue;
        if (const auto place = nc_->readPlace(past.instance().program(), cells[i].operand.name))
          places_[one.firstElement + i] = report::bitsOf(*place);
      }
    }
  }

  // The part that has led to the present position.
  void compare() {
    const replay::Flow* flow = past_.flow();
    if (flow == nullptr) return;
    ++counts_.scans;
    const std::vector<uint8_t> states = states_.of(*flow, past_.flowInstance().block());
    std::vector<const replay::RungFlow*> last(past_.flowEngine().elements().rungs().size(), nullptr);
    for (const replay::RungFlow& run : flow->runs())
      if (const uint32_t rung = past_.flowEngine().elements().rungOf(run.lowered); rung != replay::kNone)
        last[rung] = &run;
    for (uint32_t rung = 0; rung < last.size(); ++rung) {
      const replay::SourceRung& source = past_.flowEngine().elements().rungs()[rung];
      const auto row = shown_.rowOf(source.number);
      if (last[rung] == nullptr || !row) continue;
      if (source.lowered.size() == 1) compareContacts(shown_.rows()[*row], states, flow->accesses(*last[rung]));
      compareCoils(shown_.rows()[*row], shown_.flow(*row, states), states);
      if (testing::Test::HasFatalFailure()) return;
    }
  }

private:
  // The bit of the place when the run read it.
  std::optional<bool> readOf(std::span<const ir::Access> accesses, const ir::BitRange& place) {
    for (const ir::Access& access : accesses) {
      const auto known = access.writes ? std::nullopt : past_.flowEngine().knownPlace(access);
      if (known && known->space == place.space && known->first == place.first && known->count == place.count)
        return access.value != 0;
    }
    return std::nullopt;
  }

  void compareContacts(const Row& row, const std::vector<uint8_t>& states, std::span<const ir::Access> accesses) {
    const std::vector<Cell>& cells = drawing_.figures[row.index].sheet.cells;
    for (uint32_t i = 0; i < cells.size(); ++i) {
      const uint8_t state = states[row.firstElement + i];
      if (cells[i].kind != Cell::Kind::Contact || (state & kEvaluated) == 0) continue;
      const auto& place = places_[row.firstElement + i];
      const auto read = place ? readOf(accesses, *place) : std::nullopt;
      if (!read) {
        ++counts_.unread;
        continue;
      }
      ++counts_.contacts;
      ASSERT_EQ((state & kOn) != 0, *read != (cells[i].mark == "/"))
          << "rung " << row.number << ", contact " << cells[i].operand.name;
    }
  }

  void compareCoils(const Row& row, const std::string& text, const std::vector<uint8_t>& all) {
    if (text.empty()) return;
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

  replay::Past& past_;
  const std::unique_ptr<sim::SimulatedNc> nc_;
  const view::Program drawing_;
  const ShownProgram shown_;
  ElementStates states_;
  const NamePlaces names_;
  Counts& counts_;
  std::vector<std::optional<ir::BitRange>> places_; // by element
};

void runScenario(const std::string& path, Counts& counts) {
  auto scenario = scenario::readScenario(path);
  ASSERT_TRUE(scenario.ok());
  scenario::takeProject(scenario.value());
  auto recorded = replay::recordScenario(scenario.value(), {.engines = {compiler::EngineKind::Interp}});
  ASSERT_TRUE(recorded.ok()) << recorded.error();
  auto past = replay::Past::open(recorded.value().recording, {.engine = compiler::EngineKind::Interp});
  ASSERT_TRUE(past.ok()) << past.error();
  ASSERT_EQ(past.value()->goTo(past.value()->firstPart()), "");
  Truth truth(*past.value(), counts);
  while (counts.scans < kMostScans && past.value()->next() && past.value()->programNumber() == 0) {
    truth.compare();
    if (testing::Test::HasFatalFailure()) return;
  }
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
