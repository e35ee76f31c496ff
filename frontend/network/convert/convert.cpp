// Converts a program and reads the result back: a text that says anything else is never handed out.
#include "frontend/network/convert/convert.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/network/convert/collect.h"
#include "frontend/network/convert/drawing.h"
#include "frontend/network/convert/writers.h"
#include "ir/support/check.h"
#include "ir/support/diag/gsk.h"

namespace rung::network {
namespace {

using convert::SourceCommand;
using convert::SourceNetwork;
using convert::SourceProgram;
using convert::SourceUnit;

SourceProgram readModel(const Language& language, SourceManager& sources, std::span<const FileId> files) {
  Diagnostics heard; // all of it is reported
  Context context{.language = language, .sources = sources, .diagnostics = heard};
  std::vector<Network> networks;
  context.onNetwork = [&networks](const Network& network) { networks.push_back(network); };
  Program program(language);
  Reading reading(context, program);
  for (FileId file : files) reading.add(file);
  reading.read();
  RUNG_CHECK(!heard.hasErrors(), "the program has no errors");
  return convert::collect(context, reading, networks);
}

bool sameCommand(const SourceCommand& a, const SourceCommand& b) {
  return a.command == b.command && a.operand == b.operand;
}

bool sameNetwork(const SourceNetwork& a, const SourceNetwork& b) {
  return a.title == b.title && std::ranges::equal(a.commands, b.commands, sameCommand);
}

bool sameUnit(const SourceUnit& a, const SourceUnit& b) {
  return a.kind == b.kind && a.level == b.level && a.number == b.number &&
         std::ranges::equal(a.condition, b.condition, sameCommand) &&
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
SourceProgram readBack(const Language& language, SourceManager& sources, FileId file, const SourceProgram& model) {
  SourceProgram again = readModel(language, sources, std::span(&file, 1));
  RUNG_CHECK(std::ranges::equal(model.units, again.units, sameUnit), "a converted program is the same program");
  return again;
}

// False when a network is too large to be drawn.
bool checkDrawings(const Language& language, const SourceProgram& model, Diagnostics& diagnostics) {
  for (const SourceUnit& unit : model.units) {
    for (const SourceNetwork& network : unit.networks) {
      const convert::DrawingSize size = sizeOf(language, network);
      if (size.lines * size.columns > convert::kMaxDrawing)
        diagnostics.report(diag::DrawingTooLarge, network.range) << size.lines << size.columns;
    }
  }
  return !diagnostics.hasErrors();
}

} // namespace

std::optional<std::string> convertProgram(const Language& language, SourceManager& sources,
                                          std::span<const FileId> files, convert::Form to, Diagnostics& diagnostics) {
  const bool toList = to == convert::Form::List;
  const SourceProgram model = readModel(language, sources, files);
  if (!toList && !checkDrawings(language, model, diagnostics)) return std::nullopt;
  std::string text = toList ? writeList(language, model) : writeLadder(language, model);
  SourceManager converted;
  const std::string name = fmt::format("converted{}", toList ? language.listExtension : ".lad");
  readBack(language, converted, converted.addBuffer(name, text), model);
  return text;
}

std::optional<LadderForm> ladderForm(const Language& language, SourceManager& sources, std::span<const FileId> files,
                                     Diagnostics& diagnostics) {
  if (std::ranges::all_of(files, [&](FileId file) { return isLadder(language, sources, file); }))
    return LadderForm{{files.begin(), files.end()}, {}, {}};
  const SourceProgram model = readModel(language, sources, files);
  if (!checkDrawings(language, model, diagnostics)) return std::nullopt;
  LadderForm form;
  for (const SourceUnit& unit : model.units)
    for (const SourceNetwork& network : unit.networks) form.networks.push_back(network.range);
  form.files.push_back(sources.addBuffer("converted.lad", writeLadder(language, model)));
  form.elements = originsOf(model, readBack(language, sources, form.files[0], model));
  return form;
}

} // namespace rung::network
