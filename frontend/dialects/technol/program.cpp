// Queries about a program that has been read (see program.h).
#include "frontend/dialects/technol/program.h"

#include <algorithm>

#include "ir/support/diag/technol.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::frontend::technol {

uint32_t Declarations::bytesOf(ir::SpaceId space) const {
  // Computed once: this function is called for each operand.
  static const uint32_t interfaceBytes = nc::areaBytes(nc::technolSignals(), "I");
  static const uint32_t blockBytes = nc::areaBytes(nc::technolSignals(), "BLK");
  uint32_t bytes = 0;
  if (space == kInterfaceSpace) bytes = interfaceBytes;
  if (space == kDataSpace) bytes = dataBytes;
  if (space == kMechanismSpace) bytes = mechanismBytes;
  if (space == kRegisterSpace) bytes = kRegisterBytes;
  if (space == kBlockSpace) bytes = blockBytes * kQueuedBlocks;
  if (space == kExchangeSpace) bytes = exchangedBytes;
  return std::max(1u, bytes);
}

UnitId SourceProgram::owner(UnitId unit) const {
  while (unit.valid() && at(unit).kind == UnitKind::Timed) unit = at(unit).parent;
  return unit;
}

uint32_t SourceProgram::procedureOf(UnitId unit) const {
  while (unit.valid() && at(unit).kind != UnitKind::Procedure) unit = at(unit).parent;
  return unit.valid() ? at(unit).index : kNone;
}

bool SourceProgram::inMechanism(UnitId unit) const {
  const UnitId nearest = owner(unit);
  return nearest.valid() && at(nearest).kind == UnitKind::Mechanism;
}

bool SourceProgram::mayWait(UnitId unit) const {
  const UnitId nearest = owner(unit);
  if (!nearest.valid()) return false;
  const Unit& u = at(nearest);
  if (u.kind == UnitKind::Module) return u.module == ModuleKind::BlockInit || u.module == ModuleKind::BlockDone;
  return u.kind == UnitKind::Mechanism;
}

int64_t SourceProgram::filesWith(bool SourceFile::* statement) const {
  uint64_t mask = 0;
  for (size_t i = 0; i < files.size(); ++i)
    if (files[i].*statement) mask |= uint64_t{1} << i;
  return static_cast<int64_t>(mask);
}

uint32_t SourceProgram::procedureNamed(std::string_view name) const {
  for (uint32_t i = 0; i < procedures.size(); ++i)
    if (symbolKey(procedures[i].name) == name) return i;
  return kNone;
}

std::vector<std::span<const Token>> splitOperands(std::span<const Token> tokens) {
  std::vector<std::span<const Token>> operands;
  if (tokens.empty()) return operands;
  int depth = 0;
  size_t first = 0;
  for (size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].is('(') || tokens[i].is('[') || tokens[i].is('<')) ++depth;
    if (tokens[i].is(')') || tokens[i].is(']') || tokens[i].is('>')) --depth;
    if (!tokens[i].is(',') || depth > 0) continue;
    operands.push_back(tokens.subspan(first, i - first));
    first = i + 1;
  }
  operands.push_back(tokens.subspan(first));
  return operands;
}

SourceRange rangeOf(const SourceManager& sources, std::span<const Token> tokens, SourceRange otherwise) {
  if (tokens.empty()) return otherwise;
  const SourceRange first = tokens.front().range(), last = tokens.back().range();
  const bool inOrder = first.begin <= last.begin && first.end <= last.end;
  return inOrder && sources.fileOf(first.begin) == sources.fileOf(last.begin) ? join(first, last) : first;
}

bool takeSign(std::span<const Token> tokens, Diagnostics& diagnostics) {
  const bool isSign = tokens.size() > 1 && (tokens[0].is('-') || tokens[0].is('+'));
  if (!isSign || tokens[1].kind != TokenKind::Name) return false;
  diagnostics.report(diag::BadIdentifier, join(tokens[0].range(), tokens[1].range()))
          .note("a sign before a name negates its value: write " + std::string(tokens[1].text))
      << spelled(tokens.first(2));
  return true;
}

bool isOneWord(std::span<const Token> tokens) {
  if (tokens.empty() || tokens[0].kind == TokenKind::Punct) return false;
  for (size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].kind == TokenKind::Text) return false;
    if (i > 0 && tokens[i - 1].range().end != tokens[i].pos) return false;
  }
  return true;
}

std::string spelled(std::span<const Token> tokens) {
  std::string text;
  for (size_t i = 0; i < tokens.size(); ++i) {
    if (i > 0 && tokens[i - 1].range().end < tokens[i].pos) text += ' ';
    const bool quoted = tokens[i].kind == TokenKind::Text;
    text.append(quoted ? "'" : "").append(tokens[i].text).append(quoted ? "'" : "");
  }
  return text;
}

} // namespace rung::frontend::technol
