// The power that the page shows, against what the interpreter reads while it evaluates the rungs of the examples: a
// contact conducts as the bit that it read says, and a coil has power if a way from the left rail leads to it.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "compiler/compile.h"
#include "sim/simulated_nc.h"
#include "tests/unit/web/drawing.h"
#include "tools/replay/past.h"
#include "tools/replay/record_run.h"
#include "tools/report/place_names.h"
#include "tools/scenario/in_project.h"
#include "tools/scenario/runner.h"
#include "tools/scenario/session.h"
#include "tools/scenario/statements.h"
#include "tools/scenario/words.h"
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
  uint64_t constant = 0; // whose bit never changes
  uint64_t unread = 0;   // others: edges, computed addresses
  uint64_t coils = 0;
};

// A rung with the states of its cells, and what is shown of them.
struct Shown {
  const view::Sheet& sheet;
  std::vector<uint8_t> states;
  std::string text;
};

bool leaves(const Shown& shown, uint32_t cell);

// Whether a way from the left rail leads to the cell, by all rows of the sheet.
bool hasPower(const Shown& shown, uint32_t cell) {
  for (const view::Row& row : shown.sheet.rows)
    for (size_t i = 1; i < row.stops.size(); ++i)
      if (row.stops[i].cell == cell && row.stops[i].joined && leaves(shown, row.stops[i - 1].cell)) return true;
  return false;
}

// An exclusive or has two inputs, in its first and last row, or reads a bit.
bool isExclusive(const Shown& shown, uint32_t cell) {
  std::vector<bool> inputs;
  for (const view::Row& row : shown.sheet.rows)
    for (size_t i = 1; i < row.stops.size(); ++i)
      if (row.stops[i].cell == cell && row.stops[i].joined) inputs.push_back(leaves(shown, row.stops[i - 1].cell));
  const bool bit = (shown.states[cell] & kOn) != 0;
  if (inputs.size() < 2) return (!inputs.empty() && inputs[0]) != bit;
  return inputs.front() != inputs.back();
}

// Whether power comes out of the cell. A register that an earlier rung has set is taken as shown.
bool leaves(const Shown& shown, uint32_t cell) {
  const Cell& one = shown.sheet.cells[cell];
  const uint8_t state = shown.states[cell];
  if (one.kind == Cell::Kind::Rail) return true;
  if (one.kind == Cell::Kind::Contact && one.mark == "NOT") return shown.text[cell] != '-' && !hasPower(shown, cell);
  const bool isRegister = one.operand.name == "RLO" || one.operand.name == "STACK";
  if (one.kind == Cell::Kind::Contact && isRegister)
    return shown.text[cell] != '-' && ((shown.text[cell] - '0') & 1) != 0;
  if (one.kind == Cell::Kind::Contact && (state & kOn) == 0) return false;
  if (one.kind == Cell::Kind::Box && one.mark == "=1") return isExclusive(shown, cell);
  if (one.kind == Cell::Kind::Box && (state & kResultKnown) != 0) {
    if ((state & kResult) == 0) return false;
    if ((state & kConducts) == 0) return true;
  }
  return hasPower(shown, cell);
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
      const auto& place = places_[row.firstElement + i];
      if (cells[i].kind == Cell::Kind::Contact && (state & kConstant) != 0) {
        ++counts_.constant;
        ASSERT_EQ((state & kOn) != 0, (past_.instance().read(report::refAt(*place)) != 0) != (cells[i].mark == "/"))
            << "rung " << row.number << ", constant contact " << cells[i].operand.name;
        continue;
      }
      if (cells[i].kind != Cell::Kind::Contact || (state & kEvaluated) == 0) continue;
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
    const Shown shown{sheet, {all.begin() + row.firstElement, all.begin() + row.firstElement + row.elements}, text};
    for (uint32_t i = 0; i < sheet.cells.size(); ++i) {
      if (sheet.cells[i].kind != Cell::Kind::Coil || text[i] == '-') continue;
      ++counts_.coils;
      const bool power = hasPower(shown, i);
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

void compareAll(const replay::RecordedScenario& recorded, Counts& counts, uint64_t most) {
  auto past = replay::Past::open(recorded.recording, {.engine = compiler::EngineKind::Interp});
  ASSERT_TRUE(past.ok()) << past.error();
  ASSERT_EQ(past.value()->goTo(past.value()->firstPart()), "");
  Truth truth(*past.value(), counts);
  for (uint64_t i = 0; i < most && past.value()->next() && past.value()->programNumber() == 0; ++i) {
    truth.compare();
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Scans with random bits at random inputs between them.
std::string driveAtRandom(scenario::Session& session, const compiler::Compiled& compiled, uint32_t seed) {
  std::vector<std::string> inputs;
  for (const view::NameTable& table : drawingOf(compiled).tables)
    for (const view::NameRow& row : table.rows)
      if (row.input) inputs.push_back(row.name);
  std::mt19937 random(seed);
  const auto execute = [&](const std::string& line) {
    if (const auto statement = scenario::parseStatement(line); statement.ok())
      (void)session.execute(statement.value()); // the control may refuse it
  };
  for (uint64_t scan = 0; scan < kMostScans; ++scan) {
    for (int i = 0; i < 3 && !inputs.empty(); ++i) {
      const std::string& name = inputs[random() % inputs.size()];
      execute(fmt::format("set {} {}", scenario::asWord(name), random() % 2));
    }
    execute("scan");
    if (session.instance().faulted()) execute("cold_start");
  }
  return {};
}

std::vector<std::string> scenariosOf(const std::string& example) {
  std::set<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator("examples/" + example))
    if (entry.path().extension() == ".scn") paths.insert(entry.path().string());
  return {paths.begin(), paths.end()};
}

class FlowOf : public testing::TestWithParam<const char*> {
protected:
  void record(const std::string& path, bool random) {
    SCOPED_TRACE(path);
    auto scenario = scenario::readScenario(path);
    ASSERT_TRUE(scenario.ok());
    scenario::takeProject(scenario.value());
    scenario::RunOptions options{.engines = {compiler::EngineKind::Interp}};
    if (random) {
      std::erase_if(scenario.value().statements, [](const scenario::Statement& one) {
        return scenario::StatementInfo::of(one).stage == scenario::Stage::Run;
      });
      options.started = [](scenario::Session& session, const compiler::Compiled& compiled) {
        return driveAtRandom(session, compiled, kSeed);
      };
    }
    auto recorded = replay::recordScenario(scenario.value(), options);
    ASSERT_TRUE(recorded.ok()) << recorded.error();
    compareAll(recorded.value(), counts_, kMostScans);
  }

  static constexpr uint32_t kSeed = 55;
  Counts counts_;
};

TEST_P(FlowOf, ScenariosIsWhatTheRungsRead) {
  for (const std::string& path : scenariosOf(GetParam())) {
    if (counts_.scans >= kMostScans) break;
    record(path, false);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(counts_.contacts, counts_.unread);
  EXPECT_GT(counts_.coils, 0u);
}

TEST_P(FlowOf, RandomScansIsWhatTheRungsRead) {
  record(scenariosOf(GetParam()).front(), true);
  EXPECT_GE(counts_.scans, kMostScans);
  EXPECT_GT(counts_.contacts, 10'000u);
  EXPECT_GT(counts_.contacts, counts_.unread);
  EXPECT_GT(counts_.coils, 10'000u);
}

INSTANTIATE_TEST_SUITE_P(Examples, FlowOf,
                         testing::Values("gsk-mill", "gsk-panel", "fanuc-vmc", "first-cnc", "nct-lathe",
                                         "nct-turning-centre", "technol-magazine", "technol-machining-centre",
                                         "technol-mill"),
                         [](const auto& one) {
                           std::string name = one.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

} // namespace
} // namespace rung::web
