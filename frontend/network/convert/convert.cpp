// Converts a program and reads the result back: a text with another meaning is never returned.
#include "frontend/network/convert/convert.h"

#include <algorithm>

#include <fmt/format.h>

#include "frontend/ladder/text/format.h"
#include "frontend/network/convert/drawing.h"
#include "frontend/network/convert/writers.h"
#include "frontend/network/read/gaps.h"
#include "frontend/network/read/reading.h"
#include "ir/support/check.h"
#include "ir/support/diag/ladder.h"
#include "ir/support/diag/pmc.h"

namespace rung::frontend::network {
namespace {

bool sameCommand(const Written& a, const Written& b) { return a.command == b.command && a.operand == b.operand; }

bool sameNetwork(const Network& a, const Network& b) {
  return clean(a.title) == clean(b.title) && std::ranges::equal(a.written, b.written, sameCommand);
}

bool sameUnit(const Unit& a, const Unit& b) {
  return a.kind == b.kind && a.number == b.number && std::ranges::equal(a.condition, b.condition, sameCommand) &&
         std::ranges::equal(withoutEnd(a), withoutEnd(b), sameNetwork);
}

// Positions in both texts; the converted program has the same commands in the same order.
std::vector<Origin> originsOf(const Program& program, const Program& converted) {
  std::vector<Origin> origins;
  for (size_t u = 0; u < program.units.size(); ++u) {
    for (size_t n = 0; n < withoutEnd(program.units[u]).size(); ++n) {
      const auto& written = program.units[u].networks[n].written;
      const auto& drawn = converted.units[u].networks[n].written;
      for (size_t i = 0; i < written.size(); ++i)
        if (isElement(written[i].command)) origins.push_back({drawn[i].range.begin, written[i].range.begin});
    }
  }
  std::sort(origins.begin(), origins.end(), [](const Origin& a, const Origin& b) { return a.drawn < b.drawn; });
  return origins;
}

// Reads the converted text again and checks that it is the same program.
Program readBack(const Language& language, SourceManager& sources, FileId file, const Program& program) {
  Program again = readSource(language, sources, std::span(&file, 1)).program;
  RUNG_CHECK(std::ranges::equal(program.units, again.units, sameUnit), "a converted program is the same program");
  return again;
}

bool hasDrawnOperand(Command command) {
  return isContact(command) || isCoil(command) || command == Command::Parameter || command == Command::Table;
}

// Report texts and names with characters that ladder text cannot hold.
void checkGap(const Gap& gap, Diagnostics& diagnostics) {
  for (const Item& item : gap)
    if ((item.kind == Item::Kind::Message || item.kind == Item::Kind::Data) &&
        item.value.find('"') != std::string::npos)
      diagnostics.report(diag::NoLadderText, item.range) << item.value << "quotes";
}

void checkNames(const Network& network, Diagnostics& diagnostics) {
  for (const Written& command : network.written)
    if (hasDrawnOperand(command.command) && !canBeDrawn(command.operand))
      diagnostics.report(diag::NoLadderText, command.range) << command.operand << "brackets";
}

// Reports what ladder text cannot hold, and networks that are too large to draw; false if there are errors.
bool checkDrawings(const Language& language, const SourceProgram& source, Diagnostics& diagnostics) {
  checkGap(source.preamble, diagnostics);
  checkGap(source.tail, diagnostics);
  for (const Unit& unit : source.program.units) {
    checkGap(unit.lead, diagnostics);
    for (const Network& network : withoutEnd(unit)) {
      checkGap(network.gap, diagnostics);
      checkNames(network, diagnostics);
      const DrawingSize size = sizeOf(language, network);
      if (size.lines * size.columns > kMaxDrawing)
        diagnostics.report(diag::DrawingTooLarge, network.range) << size.lines << size.columns;
    }
  }
  return !diagnostics.hasErrors();
}

// In the columns that `rungc format` chooses, which are fewer where rungs have groups in parallel at several pins.
std::string formattedLadder(const Language& language, const SourceProgram& source) {
  SourceManager sources;
  Diagnostics heard; // stays without errors
  const FileId file = sources.addBuffer("converted.lad", writeLadder(language, source));
  const std::optional<std::string> text = ladder::format(sources, file, language.findBox, heard);
  RUNG_CHECK(text.has_value(), "a converted program is ladder text");
  return *text;
}

} // namespace

std::optional<std::string> convertProgram(const Language& language, SourceManager& sources,
                                          std::span<const FileId> files, Form to, Diagnostics& diagnostics) {
  const bool toList = to == Form::List;
  SourceProgram source = readSource(language, sources, files);
  if (!toList && !checkDrawings(language, source, diagnostics)) return std::nullopt;
  if (toList) prepareForList(language, source);
  std::string text = toList ? writeList(language, source) : formattedLadder(language, source);
  SourceManager converted;
  const std::string name = fmt::format("converted{}", toList ? language.listExtensions[0] : ".lad");
  readBack(language, converted, converted.addBuffer(name, text), source.program);
  return text;
}

std::optional<LadderForm> ladderForm(const Language& language, SourceManager& sources, std::span<const FileId> files,
                                     Diagnostics& diagnostics) {
  if (std::ranges::all_of(files, [&](FileId file) { return isLadder(language, sources, file); }))
    return LadderForm{{files.begin(), files.end()}, {}, {}};
  const SourceProgram source = readSource(language, sources, files);
  if (!checkDrawings(language, source, diagnostics)) return std::nullopt;
  LadderForm form;
  for (const Unit& unit : source.program.units)
    for (const Network& network : withoutEnd(unit)) form.networks.push_back(network.range);
  form.files.push_back(sources.addBuffer("converted.lad", writeLadder(language, source)));
  form.elements = originsOf(source.program, readBack(language, sources, form.files[0], source.program));
  return form;
}

} // namespace rung::frontend::network
