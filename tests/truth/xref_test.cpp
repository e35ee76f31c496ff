// `rungc xref` against accesses that the interpreter sees, in the scenarios of the examples and in drawn programs: what
// a rung reads or writes is listed for that rung and that side, under the address of the variable; and what is listed
// of a rung is named in its lines.
#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <unordered_set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "ir/image/program_image.h"
#include "ir/support/hash.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/nc/signals.h"
#include "rtlib/run/loaded_program.h"
#include "rtlib/text/letters.h"
#include "tests/truth/programs.h"
#include "tools/report/cross_reference.h"
#include "tools/report/place_names.h"
#include "tools/scenario/runner.h"

namespace rung::truth {
namespace {

using Json = nlohmann::json;
using ir::BitRange;

// Where a program's memory is in a space that a user knows, by the tables that the program runs with.
std::optional<BitRange> variableAt(const rung_program& program, const BitRange& place) {
  const runtime::Ref ref = report::refAt(place);
  if ((program.spaces[place.space.index].flags & RUNG_SPACE_HIDDEN) == 0) return place;
  const std::optional<runtime::Ref> source = runtime::Overwritten(program).source(ref); // a latch of an input
  if (!source || (program.spaces[source->space].flags & RUNG_SPACE_HIDDEN) != 0) return std::nullopt;
  return report::bitsOf(*source);
}

// Of NCT's time-slice memory the variable without `!`.
BitRange withoutMark(const rung_program& program, const BitRange& place) {
  const uint32_t slices = runtime::findSpace(program, "TS");
  const bool marked = std::string_view(program.dialect) == "nct" && place.space.index == slices;
  return marked ? BitRange{ir::SpaceId{runtime::findSpace(program, "M")}, place.first, place.count} : place;
}

// What `xref --place` prints of a program's variables.
class Listing {
public:
  explicit Listing(const compiler::Compiled& compiled)
      : image_(*compiled.layout, compiled.codeHash),
        reference_(image_.program(), *compiled.uses, compiled.dialect->shownSpaces) {}

  const rung_program& program() const { return image_.program(); }
  bool has(uint32_t rung, const BitRange& place, bool writes) {
    const Json& entry = entryOf(place);
    const char* side = writes ? "written" : "read";
    const rung_info& info = program().rungs[rung];
    const bool isControls = info.number == 0 && info.file != RUNG_NONE; // the control's, before the rung at its lines
    if (isControls) return !writes || entry.value("control_writes", false);
    return isIn(entry[side], rung) || isIn(entry[std::string("perhaps_") + side], rung);
  }
  // The direct accesses: rung, place as its address says, and what is printed.
  template <class Visit>
  void forDirect(Visit visit) {
    for (const Json& entry : Json::parse(report::shownAsJson(reference_, reference_.all(), false)))
      for (const char* side : {"written", "read"})
        for (const Json& access : entry[side])
          if (!access.value("indexed", false)) visit(access);
  }

private:
  const Json& entryOf(const BitRange& place) {
    const auto [at, isNew] = entries_.try_emplace({place.space.index, place.first, place.count});
    if (isNew)
      at->second = Json::parse(report::shownAsJson(reference_, {reference_.of(report::refAt(place))}, true))[0];
    return at->second;
  }
  bool isIn(const Json& list, uint32_t rung) const {
    const rung_info& info = program().rungs[rung];
    const std::string file = info.file == RUNG_NONE ? "" : program().files[info.file];
    return std::ranges::any_of(list, [&](const Json& access) {
      return access["rung"] == info.number && access["line"] == info.first_line && access["file"] == file;
    });
  }

  const ir::ProgramImage image_;
  const report::CrossReference reference_;
  std::map<std::tuple<uint32_t, uint32_t, uint32_t>, Json> entries_;
};

// The lines of rungs.
class Lines {
public:
  Lines() = default;
  explicit Lines(const Text& text) { split(text.file, text.text); }

  std::string of(const std::string& file, uint32_t first, uint32_t last) {
    if (!files_.contains(file)) {
      std::ostringstream text;
      text << std::ifstream(file).rdbuf();
      split(file, text.str());
    }
    std::string text;
    for (uint32_t line = first; line <= last && line <= files_[file].size(); ++line)
      text += files_[file][line - 1] + "\n";
    return text;
  }

private:
  void split(const std::string& file, const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) files_[file].push_back(line);
  }

  std::map<std::string, std::vector<std::string>> files_;
};

struct Found {
  std::set<std::string> wrong;
  uint64_t held = 0; // accesses that were compared
};

// A coil that sets or resets reads its bit to keep it, which is no use of it; FL_ER of NCT is raised so.
bool keeps(const rung_program& program, const BitRange& place, const std::string& lines) {
  if (std::string_view(program.dialect) == "nct" && place.first < 32) return true;
  return std::ranges::any_of(std::initializer_list<std::string_view>{"SET", "RST", "(S ", "(R "},
                             [&](std::string_view coil) { return lines.find(coil) != std::string::npos; });
}

class Witness final : public ir::RungObserver {
public:
  Witness(const compiler::Compiled& compiled, Lines lines, Found& found)
      : listing_(compiled), lines_(std::move(lines)), found_(found) {}

  void rungRan(uint32_t, std::span<const uint64_t>) override {}
  void accessed(const ir::Access& access) override {
    if (!access.slot.valid()) touched(access.rung, access.place, access.writes);
  }

private:
  void touched(uint32_t rung, const BitRange& place, bool writes) {
    const uint64_t where = hashNumber(uint64_t{place.space.index} << 32 | place.first, kHashSeed);
    if (!seen_.insert(hashNumber(uint64_t{rung} << 32 | place.count << 1 | (writes ? 1 : 0), where)).second) return;
    const rung_program& program = listing_.program();
    const std::optional<BitRange> variable = variableAt(program, place);
    if (!variable) return;
    check(rung, *variable, writes);
    const BitRange unmarked = withoutMark(program, *variable);
    if (unmarked != *variable) check(rung, unmarked, writes);
  }
  void check(uint32_t rung, const BitRange& place, bool writes) {
    const rung_program& program = listing_.program();
    ++found_.held;
    if (listing_.has(rung, place, writes)) return;
    const rung_info& info = program.rungs[rung];
    const std::string file = info.file == RUNG_NONE ? "" : program.files[info.file];
    if (!writes && listing_.has(rung, place, true) &&
        keeps(program, place, lines_.of(file, info.first_line, info.last_line)))
      return;
    found_.wrong.insert(fmt::format("{}: {} {} ({} bits)", runtime::rungText(program, rung),
                                    writes ? "writes" : "reads", nc::address(program, report::refAt(place)),
                                    place.count));
  }

  Listing listing_;
  Lines lines_;
  Found& found_;
  std::unordered_set<uint64_t> seen_; // each access once
};

void expectNothing(const Found& found) {
  size_t shown = 0;
  for (const std::string& wrong : found.wrong)
    if (shown++ < 20) ADD_FAILURE() << wrong;
  if (shown > 20) ADD_FAILURE() << "and " << shown - 20 << " more";
}

// ---- what runs do is listed ----------------------------------------------------------------------------------------

std::vector<std::string> scenarios() {
  if (!isLarge())
    return {"examples/fanuc-vmc/tool-change.scn", "examples/gsk-mill/tool-change.scn", "examples/nct-lathe/probe.scn",
            "examples/nct-turning-centre/turret.scn", "examples/technol-machining-centre/homing.scn"};
  std::vector<std::string> files;
  for (const char* folder : {"examples", "tests/scenarios"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".scn") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

TEST(Xref, ListsWhatScenariosDo) {
  for (const std::string& file : scenarios()) {
    SCOPED_TRACE(file);
    const Result<scenario::Scenario> scenario = scenario::readScenario(file);
    ASSERT_TRUE(scenario.ok()) << scenario.error();
    Found found;
    scenario::RunOptions options{.engines = {compiler::EngineKind::Interp}};
    options.engine.observer = [&](const compiler::Compiled& compiled) {
      return std::make_unique<Witness>(compiled, Lines(), found);
    };
    scenario::run(scenario.value(), options);
    expectNothing(found);
    if (!isLarge()) {
      EXPECT_GT(found.held, 300u);
    }
  }
}

TEST(Xref, ListsWhatDrawnProgramsDo) {
  uint64_t held = 0;
  for (const Text& text : drawnTexts()) {
    SCOPED_TRACE(text.file);
    const std::unique_ptr<Program> program = Program::of(text);
    if (!program) continue;
    Found found;
    compiler::EngineOptions options;
    options.observer = [&](const compiler::Compiled& compiled) {
      return std::make_unique<Witness>(compiled, Lines(text), found);
    };
    const auto engine = compiler::makeEngine(compiler::EngineKind::Interp, program->compiled(), options);
    ASSERT_TRUE(engine.ok()) << engine.error();
    runtime::Instance instance(*engine.value());
    ir::RandomSource random(11);
    for (int i = 0; i < 6; ++i) {
      if (instance.faulted()) instance.coldStart();
      scatter(instance, random);
      instance.scan();
    }
    expectNothing(found);
    held += found.held;
  }
  EXPECT_GT(held, 2500u);
}

// ---- what is listed stands in the rung -----------------------------------------------------------------------------

// Of a word as a program has it: a name, an address, a signal of the control, in capitals or not.
std::optional<runtime::Ref> placeOf(const rung_program& program, std::string_view word) {
  const nc::NameFallback signals = [&](std::string_view name) -> std::optional<runtime::Ref> {
    const nc::Signal* signal = nc::findSignal(*nc::signalsOf(program.dialect), name);
    if (signal == nullptr) return std::nullopt;
    const uint32_t space = runtime::findSpace(program, signal->area);
    const bool isBit = signal->type == nc::SignalType::Bit;
    return isBit ? runtime::bitRef(space, signal->byteOffset, signal->bit)
                 : runtime::intRef(space, signal->byteOffset, 8);
  };
  for (const std::string& form : {std::string(word), text::upper(word)})
    if (const auto place = nc::resolve(program, form, signals); place && place->kind != runtime::RefKind::Constant)
      return place;
  return std::nullopt;
}

// Places that the words of a rung name.
std::vector<BitRange> namedIn(const rung_program& program, const std::string& lines) {
  std::vector<BitRange> places;
  const auto take = [&](std::string_view word) {
    if (const auto place = placeOf(program, word)) places.push_back(report::bitsOf(*place));
  };
  size_t begin = 0;
  for (size_t i = 0; i <= lines.size(); ++i) {
    const bool ends =
        i == lines.size() || std::string_view(" \t\n\r[](){}|;\"'").find(lines[i]) != std::string_view::npos;
    if (!ends) continue;
    std::string_view word = std::string_view(lines).substr(begin, i - begin);
    begin = i + 1;
    while (!word.empty() && std::string_view("/@%-").find(word.front()) != std::string_view::npos)
      word.remove_prefix(1);
    for (std::string_view rest = word; !rest.empty();) {
      take(rest); // NAME,#1 as a whole, then its parts
      rest = rest.substr(0, rest.find_last_of(",:") == std::string_view::npos ? 0 : rest.find_last_of(",:"));
    }
    if (const size_t comma = word.find(','); comma != std::string_view::npos)
      for (std::string_view rest = word; !rest.empty(); rest.remove_prefix(std::min(rest.find(',') + 1, rest.size()))) {
        take(rest.substr(0, rest.find(',')));
        if (rest.find(',') == std::string_view::npos) break;
      }
  }
  return places;
}

// Cells that instructions use without naming them: flags, results, the table of a numbered timer, signals of an axis
// that the program moves, requests.
bool isImplicit(const rung_program& program, const BitRange& place, const std::string& lines) {
  const std::string_view dialect = program.dialect;
  const std::string_view space = program.spaces[place.space.index].name;
  if (dialect == "nct") return place.first < 32;
  if (dialect == "technol") return space == "NCI";
  const auto has = [&](std::string_view word) { return lines.find(word) != std::string::npos; };
  const bool hasAxis = has("AXLCTL") || has("FUNC 46") || has("AXCTL") || has("SUB 53");
  const uint32_t results = dialect == "fanuc" ? 9000 * 8 : 1000 * 8;
  return (space == "R" && place.first >= results && place.first < results + 6 * 8) || space == "T" || space == "C" ||
         (hasAxis && (space == "F" || space == "G"));
}

// A mechanism's own variable, NAME_LINE, which instructions in it write.
bool isOfMechanism(const std::string& address, const std::string& program) {
  return address.ends_with("_LINE") &&
         program.find("MECH_BEGIN " + address.substr(0, address.size() - 5)) != std::string::npos;
}

// How many direct accesses were compared.
uint64_t expectNamed(const compiler::Compiled& compiled, Lines lines) {
  Listing listing(compiled);
  const rung_program& program = listing.program();
  Found found;
  listing.forDirect([&](const Json& access) {
    const std::string address = access["address"];
    const std::optional<runtime::Ref> ref = nc::resolve(program, address);
    if (access["rung"] == 0) return; // the compiler's
    ++found.held;
    if (!ref) {
      found.wrong.insert(address + " cannot be written in " + program.dialect);
      return;
    }
    BitRange place = withoutMark(program, report::bitsOf(*ref));
    place.count = access["bits"];
    const uint32_t line = access["line"];
    const auto rung = std::ranges::find_if(std::span(program.rungs, program.rung_count), [&](const rung_info& info) {
      return info.number == access["rung"] && info.first_line == line;
    });
    if (rung == std::span(program.rungs, program.rung_count).end()) {
      found.wrong.insert(fmt::format("line {} is that of no rung", line));
      return;
    }
    const std::string text = lines.of(access["file"], line, rung->last_line);
    const std::vector<BitRange> named = namedIn(program, text);
    const bool implied =
        isImplicit(program, place, text) || isOfMechanism(address, lines.of(access["file"], 1, UINT32_MAX));
    const bool isNamed = implied || std::ranges::any_of(named, [&](BitRange word) {
                           word = withoutMark(program, word);
                           if (word.count > 1) word.count += 8 * 256; // functions work on more than the first cell
                           return ir::overlap(word, place);
                         });
    if (!isNamed) found.wrong.insert(fmt::format("{}:{}: {} is not named", std::string(access["file"]), line, address));
  });
  expectNothing(found);
  return found.held;
}

TEST(Xref, ListsWhatRungsName) {
  uint64_t held = 0;
  for (const Text& text : drawnTexts()) {
    SCOPED_TRACE(text.file);
    if (const std::unique_ptr<Program> program = Program::of(text))
      held += expectNamed(program->compiled(), Lines(text));
  }
  EXPECT_GT(held, 2500u);
}

} // namespace
} // namespace rung::truth
