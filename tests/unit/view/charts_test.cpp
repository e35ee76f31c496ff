// Programs of charts: each rung of the module is drawn once, nothing of its lines is lost, nothing lies on anything
// else.
#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/view/drawn.h"
#include "tools/view/html.h"
#include "tools/view/overlay.h"
#include "tools/view/svg.h"

namespace rung::view::test {
namespace {

constexpr size_t kScenarioPrograms = 150; // at least so many have no errors and need no other file

// Instructions that a drawing shows as contacts, coils and wires.
const std::set<std::string_view> kSymbols = {"LDR",    "LDR_LIC", "LA", "LO",  "CA",  "EDGE_H",
                                             "EDGE_L", "WR",      "FL", "FL1", "MOVR"};

std::string withoutBlanks(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c != ' ' && c != '\t') result += c;
  return result;
}

// Operands at commas outside of brackets and texts.
std::vector<std::string> operandsOf(std::string_view text) {
  std::vector<std::string> operands(1);
  int depth = 0;
  bool quoted = false;
  for (const char c : withoutBlanks(text)) {
    if (c == '\'') quoted = !quoted;
    depth += quoted ? 0 : c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
    if (c == ',' && depth == 0 && !quoted)
      operands.emplace_back();
    else
      operands.back() += c;
  }
  return operands;
}

// All texts of a picture without blanks, each between line ends.
std::string textsOf(const Picture& picture) {
  std::string texts = "\n";
  for (const Text& text : picture.texts) texts += withoutBlanks(text.text) + "\n";
  return texts;
}

class Lines {
public:
  Lines(const Drawn& drawn, const frontend::Analysis& analysis) : drawn_(drawn), analysis_(analysis) {}

  // What the drawing of the rung lacks of its instructions. One that waits is in the rung that begins at its line; a
  // rung that continues one after a call begins at its line, too.
  std::string missing(const ir::Rung& rung, const Picture& picture) const {
    const Figure& figure = drawn_.program.figures[rung.number - 1];
    std::string texts = textsOf(picture);
    for (const Figure& other : drawn_.program.figures) {
      const bool isWithin = other.place.line >= rung.begin.line && other.place.line <= rung.lastLine;
      const bool isBefore = other.number + 1 == rung.number;
      if (other.place.file != figure.place.file || (!isWithin && !isBefore)) continue;
      texts += textsOf(layOut(other.sheet, 800));
      for (const std::string& comment : other.comments) texts += withoutBlanks(comment) + "\n";
    }
    const FileId file = fileOf(drawn_.module->files[rung.begin.file.index]);
    std::string wrong;
    for (uint32_t line = rung.begin.line; line <= std::max(rung.begin.line, rung.lastLine); ++line)
      wrong += missingOf(file, line, texts);
    return wrong;
  }

private:
  FileId fileOf(const std::string& name) const {
    FileId found;
    for (uint32_t i = 0; i < drawn_.sources.fileCount(); ++i)
      if (drawn_.sources.name(FileId{i}) == name) found = FileId{i};
    return found; // the last one: as the dialect has decoded it
  }
  std::string missingOf(FileId file, uint32_t line, const std::string& texts) const {
    const std::string_view text = drawn_.sources.lineText(file, line);
    const auto begin = static_cast<size_t>(text.data() - drawn_.sources.text(file).data());
    for (size_t i = 0; i < text.size(); ++i)
      if (const auto* use = analysis_.instructionAt(drawn_.sources.position(file, begin + i)))
        return missingOf(*use, text.substr(i + length(*use)), texts);
    return {};
  }
  static size_t length(const frontend::InstructionUse& use) { return use.range.end.value - use.range.begin.value; }

  static std::string missingOf(const frontend::InstructionUse& use, std::string_view rest, const std::string& texts) {
    const std::string_view group = use.instruction->group;
    if (use.instruction->mnemonic == "macro") {
      const std::string whole = withoutBlanks(rest.substr(0, commentOf(rest)));
      return texts.find(whole) == std::string::npos ? fmt::format("no macro with {}\n", whole) : "";
    }
    for (const std::string_view no : {"declaration", "module", "mechanism", "procedure", "macro"})
      if (group == no && use.instruction->mnemonic != "MECH_INIT" && use.instruction->mnemonic != "PROC_CALL")
        return {};
    std::string wrong;
    if (!kSymbols.contains(use.instruction->mnemonic) && texts.find(use.instruction->mnemonic) == std::string::npos)
      wrong += fmt::format("no {}\n", use.instruction->mnemonic);
    std::vector<std::string> operands = operandsOf(rest.substr(0, commentOf(rest)));
    if (use.instruction->mnemonic.starts_with("FL")) operands.erase(operands.begin()); // S or R
    for (std::string& operand : operands) {
      if (kSymbols.contains(use.instruction->mnemonic) && operand.starts_with('-')) operand.erase(0, 1);
      if (operand != "-" && texts.find(operand) == std::string::npos)
        wrong += fmt::format("no {} of {}\n", operand, use.instruction->mnemonic);
    }
    return wrong;
  }
  static size_t commentOf(std::string_view text) {
    bool quoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\'') quoted = !quoted;
      if (text[i] == ';' && !quoted) return i;
    }
    return text.size();
  }

  const Drawn& drawn_;
  const frontend::Analysis& analysis_;
};

void expectChart(const Chart& chart, const std::string& what) {
  const Picture picture = layOut(chart);
  EXPECT_EQ(overlaps(picture), "") << what;
  for (const Text& text : picture.texts) EXPECT_GE(picture.width, text.at.x) << what;
  std::set<uint32_t> states;
  for (const frontend::chart::Part& part : chart.sequence.parts) {
    for (const uint32_t state : part.states) EXPECT_TRUE(states.insert(state).second) << what << ", state " << state;
    for (const frontend::chart::Line& line : part.lines)
      EXPECT_EQ(line.text.starts_with("to "), line.target != frontend::chart::kNone) << what << ": " << line.text;
    EXPECT_EQ(part.otherwise.empty(), part.target == frontend::chart::kNone) << what;
  }
  // Each state is in one part: they are numbered without gaps.
  ASSERT_FALSE(states.empty()) << what;
  EXPECT_EQ(*states.rbegin() + 1, states.size()) << what;
}

void expectDrawing(const std::vector<std::string>& paths) {
  const auto drawn = drawFiles(paths);
  ASSERT_NE(drawn, nullptr);
  expectSameNumbers(*drawn);
  std::vector<FileId> files;
  for (uint32_t i = 0; i < paths.size(); ++i) files.push_back(FileId{i});
  Diagnostics discarded;
  const frontend::Dialect& dialect = *frontend::findDialect("technol");
  const auto checked = dialect.check(drawn->sources, files, {}, discarded);
  const Lines lines(*drawn, checked->analysis());
  for (const ir::Routine& routine : drawn->module->routines)
    for (const ir::Rung& rung : routine.rungs) {
      if (rung.number == 0) continue;
      const Figure& figure = drawn->program.figures[rung.number - 1];
      if (figure.chart != kNoChart) continue;
      for (const int rail : {320, 800}) {
        const Picture picture = layOut(figure.sheet, rail);
        EXPECT_EQ(overlaps(picture) + outOfBounds(picture) + lines.missing(rung, picture), "")
            << paths[rung.begin.file.index] << ", rung " << rung.number << ", rail " << rail << "\n"
            << rung.sourceText;
      }
    }
  ASSERT_EQ(drawn->program.charts.size(), drawn->module->continuations.size());
  for (const Chart& chart : drawn->program.charts) {
    expectChart(chart, paths[0] + ", " + chart.sequence.name);
    const auto& all = drawn->module->continuations;
    const auto cell = std::ranges::find(all, chart.sequence.continuation, &ir::Continuation::key);
    ASSERT_NE(cell, all.end()) << chart.sequence.name;
    size_t states = 0;
    for (const frontend::chart::Part& part : chart.sequence.parts) states += part.states.size();
    EXPECT_EQ(states, cell->points.size()) << chart.sequence.name;
  }
}

std::vector<std::string> of(const std::string& folder, const std::vector<std::string>& names) {
  std::vector<std::string> paths;
  for (const std::string& name : names) paths.push_back(folder + "/" + name + ".plc");
  return paths;
}

TEST(ViewCharts, OfTheExamples) {
  expectDrawing(of("examples/technol-mill", {"mill", "changer"}));
  expectDrawing(of("examples/technol-machining-centre", {"main", "supply", "axes", "spindle", "changer", "clamping",
                                                         "fluids", "panel", "probe", "outputs"}));
  expectDrawing(of("examples/technol-magazine",
                   {"main", "supply", "drive", "carousel", "spindle", "changer", "tools", "barcode", "outputs"}));
}

TEST(ViewCharts, OfTheProgramsOfScenarios) {
  size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("tests/scenarios/technol")) {
    if (entry.path().extension() != ".plc") continue;
    SourceManager sources;
    const Result<FileId> file = sources.addFile(entry.path());
    ASSERT_TRUE(file.ok());
    Diagnostics diagnostics;
    if (frontend::findDialect("technol")->compile(sources, std::array{file.value()}, {}, diagnostics) == nullptr)
      continue; // it needs another file, or shows an error
    ++count;
    expectDrawing({entry.path()});
  }
  EXPECT_GE(count, kScenarioPrograms);
}

constexpr std::string_view kProgram = "DATA\n DFM A,B,C,D,E,F,,\nN: DS 2\nDATA_END\n"
                                      "MODULE_INPUT\nMODULE_INPUT_END\nMODULE_BLOCK_INIT\nMODULE_BLOCK_INIT_END\n"
                                      "MODULE_BLOCK_DONE\nMODULE_BLOCK_DONE_END\nMODULE_INIT\nMODULE_INIT_END\n"
                                      "MODULE_CLEAR\nMODULE_CLEAR_END\nMODULE_HALT\nMODULE_HALT_END\n"
                                      "MODULE_MAIN\n{}MODULE_MAIN_END\nSTOP\n";

std::unique_ptr<Drawn> drawMain(const std::string& main) {
  return draw("t.plc", fmt::format(fmt::runtime(kProgram), main));
}

TEST(ViewCharts, AllCoilsOfAnInstructionShowItsCoverage) {
  const auto drawn = drawMain(" LDR A\n LA -B\n WR C,D\n");
  ASSERT_NE(drawn, nullptr);
  Overlay overlay;
  overlay.elements = {{ElementOverlay::Kind::Contact, {"t.plc", 19, 2}, true, false, true, ""},
                      {ElementOverlay::Kind::Coil, {"t.plc", 20, 2}, true, false, true, ""}};
  lay(overlay, drawn->program);
  std::string badges;
  for (const Figure& figure : drawn->program.figures)
    for (const Cell& cell : figure.sheet.cells)
      if (!cell.badge.empty()) badges += cell.operand.name + ":" + cell.badge + ";";
  EXPECT_EQ(badges, "B:never closed;C:never on;D:never on;");
}

TEST(ViewCharts, TheStepWhereAMechanismWaitsIsMarked) {
  const auto drawn = drawMain(" MECH_BEGIN M\n FL 1,A\n EX\n LDR B\n EX0\n FL 0,A\n MECH_END M\n");
  ASSERT_NE(drawn, nullptr);
  const auto chart = std::ranges::find(drawn->program.charts, "M", [](const Chart& c) { return c.sequence.name; });
  ASSERT_NE(chart, drawn->program.charts.end());
  const size_t before = renderHtml(drawn->program).find("\"st at\"");
  EXPECT_EQ(before, std::string::npos);
  Overlay overlay;
  overlay.steps = {{"MECH.M.CONT", 1}, {"MECH.NONE.CONT", 0}};
  lay(overlay, drawn->program);
  EXPECT_EQ(chart->waits, (std::vector<bool>{false, true, false, false}));
  const std::string page = renderHtml(drawn->program);
  const size_t marked = page.find("\"st at\"");
  ASSERT_NE(marked, std::string::npos);
  EXPECT_EQ(page.find("\"st at\"", marked + 1), std::string::npos);
  EXPECT_NE(page.find("data-cell=\"MECH.M.CONT\" data-states=\"1\"", marked), std::string::npos);
}

} // namespace
} // namespace rung::view::test
