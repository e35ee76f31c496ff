// Checks the program as the compiler does, converts it, and reads the result back: a text that says anything else is
// never handed out.
#include "frontend/dialects/gsk/convert/convert.h"

#include <algorithm>

#include "frontend/dialects/gsk/config.h"
#include "frontend/dialects/gsk/convert/collect.h"
#include "frontend/dialects/gsk/convert/drawing.h"
#include "frontend/dialects/gsk/convert/writers.h"
#include "frontend/dialects/gsk/gsk.h"
#include "ir/support/check.h"

namespace rung::gsk {
namespace {

using convert::SourceCommand;
using convert::SourceNetwork;
using convert::SourceProgram;
using convert::SourceUnit;

std::optional<SourceProgram> readModel(SourceManager& sources, std::span<const FileId> files, Machine machine,
                                       Diagnostics& diagnostics) {
  Context context{.sources = sources, .diagnostics = diagnostics};
  context.machine = machine;
  std::vector<Network> networks;
  context.onNetwork = [&networks](const Network& network) { networks.push_back(network); };
  Program program;
  Reading reading(context, program);
  for (FileId file : files) reading.add(file);
  reading.read();
  if (diagnostics.hasErrors()) return std::nullopt;
  return convert::collect(context, reading, networks);
}

bool sameCommand(const SourceCommand& a, const SourceCommand& b) {
  return a.command == b.command && a.operand == b.operand;
}

bool sameNetwork(const SourceNetwork& a, const SourceNetwork& b) {
  return a.title == b.title && std::ranges::equal(a.commands, b.commands, sameCommand);
}

bool sameUnit(const SourceUnit& a, const SourceUnit& b) {
  return a.kind == b.kind && a.number == b.number && std::ranges::equal(a.condition, b.condition, sameCommand) &&
         std::ranges::equal(a.networks, b.networks, sameNetwork);
}

// Of a program and what it was converted to: the same commands in the same order.
std::vector<Origin> originsOf(const SourceProgram& model, const SourceProgram& converted) {
  std::vector<Origin> origins;
  for (size_t u = 0; u < model.units.size(); ++u) {
    for (size_t n = 0; n < model.units[u].networks.size(); ++n) {
      const auto& written = model.units[u].networks[n].commands;
      const auto& drawn = converted.units[u].networks[n].commands;
      for (size_t i = 0; i < written.size(); ++i)
        if (convert::isElement(written[i].command)) origins.push_back({drawn[i].range.begin, written[i].range.begin});
    }
  }
  std::sort(origins.begin(), origins.end(), [](const Origin& a, const Origin& b) { return a.drawn < b.drawn; });
  return origins;
}

// What the model was converted to, read again.
SourceProgram readBack(SourceManager& sources, FileId file, const SourceProgram& model, Machine machine) {
  Diagnostics diagnostics;
  auto again = readModel(sources, std::span(&file, 1), machine, diagnostics);
  RUNG_CHECK(again.has_value(), "a converted program has no errors");
  RUNG_CHECK(std::ranges::equal(model.units, again->units, sameUnit), "a converted program is the same program");
  return std::move(*again);
}

// False when a network is too large to be drawn.
bool checkDrawings(const SourceProgram& model, Diagnostics& diagnostics) {
  for (const SourceUnit& unit : model.units) {
    for (const SourceNetwork& network : unit.networks) {
      const convert::DrawingSize size = sizeOf(network);
      if (size.lines * size.columns > convert::kMaxDrawing)
        diagnostics.report(Diag::DrawingTooLarge, network.range) << size.lines << size.columns;
    }
  }
  return !diagnostics.hasErrors();
}

} // namespace

std::optional<std::string> convertProgram(SourceManager& sources, std::span<const FileId> files,
                                          const frontend::CompileOptions& options, convert::Form to,
                                          Diagnostics& diagnostics) {
  if (kGsk.compile(sources, files, options, diagnostics) == nullptr) return std::nullopt;
  Diagnostics heard; // all of it is reported
  const Machine machine = configuredMachine(options, heard);
  const auto model = readModel(sources, files, machine, heard);
  RUNG_CHECK(model.has_value(), "the program has no errors");
  if (to == convert::Form::Ladder && !checkDrawings(*model, diagnostics)) return std::nullopt;
  std::string text = to == convert::Form::List ? writeList(*model) : writeLadder(*model);
  SourceManager converted;
  readBack(converted, converted.addBuffer(to == convert::Form::List ? "converted.pmc" : "converted.lad", text), *model,
           machine);
  return text;
}

std::optional<LadderForm> ladderForm(SourceManager& sources, std::span<const FileId> files,
                                     const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  if (std::all_of(files.begin(), files.end(), [&](FileId file) { return isLadder(sources, file); }))
    return LadderForm{{files.begin(), files.end()}, {}, {}};
  Diagnostics heard; // all of it is reported
  const Machine machine = configuredMachine(options, heard);
  const auto model = readModel(sources, files, machine, heard);
  RUNG_CHECK(model.has_value(), "the program has no errors");
  if (!checkDrawings(*model, diagnostics)) return std::nullopt;
  LadderForm form;
  for (const SourceUnit& unit : model->units)
    for (const SourceNetwork& network : unit.networks) form.networks.push_back(network.range);
  form.files.push_back(sources.addBuffer("converted.lad", writeLadder(*model)));
  form.elements = originsOf(*model, readBack(sources, form.files[0], *model, machine));
  return form;
}

} // namespace rung::gsk
