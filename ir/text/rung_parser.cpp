// The parser of rungs (see rung_parser.h).
#include "ir/text/rung_parser.h"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

#include "ir/core/op_info.h"
#include "ir/text/keywords.h"

namespace rung::ir {

uint32_t parseReference(Scanner& scanner, const NameIndex& names, std::string_view kind) {
  if (scanner.accept('-')) return RUNG_NONE;
  if (scanner.accept('#')) return scanner.u32();
  const std::string name = scanner.name();
  auto found = names.find(name);
  if (found != names.end()) return found->second;
  scanner.fail(fmt::format("there is no {} '{}'", kind, name));
  return RUNG_NONE;
}

ParsedPlace parsePlace(Scanner& scanner, const Module& module, const NameIndex& spaces, PlaceForm form) {
  ParsedPlace place;
  place.space = parseReference(scanner, spaces, "space");
  const uint32_t declared = place.space < module.spaces.size() ? module.spaces[place.space].unitBytes : 1;
  const int64_t unit = declared == 0 ? 1 : declared;
  scanner.expect('[');
  if (scanner.accept('!')) {
    place.bitOffset = scanner.i64();
  } else {
    // Wraps around only for offsets that no space has.
    place.bitOffset = static_cast<int64_t>(scanner.u64() * static_cast<uint64_t>(unit) * 8);
    if (form == PlaceForm::Bit) {
      scanner.expect('.');
      place.bitOffset = static_cast<int64_t>(static_cast<uint64_t>(place.bitOffset) + scanner.u32());
    } else if (scanner.accept('+')) {
      place.bitOffset = static_cast<int64_t>(static_cast<uint64_t>(place.bitOffset) + uint64_t{scanner.u32()} * 8);
    }
  }
  if (form == PlaceForm::Window) {
    scanner.expectWord("count");
    place.count = scanner.u32();
  }
  scanner.expect(']');
  return place;
}

Type parseType(Scanner& scanner) {
  const std::string_view name = scanner.word();
  if (const auto type = typeFromName(name)) return *type;
  scanner.fail(fmt::format("there is no type '{}'", name));
  return Type::None;
}

int64_t parseLiteral(Scanner& scanner, Type type) {
  if (scanner.acceptWord("bits")) {
    scanner.expect('(');
    const uint64_t bits = scanner.u64();
    scanner.expect(')');
    return static_cast<int64_t>(bits);
  }
  if (type == Type::F64) return std::bit_cast<int64_t>(scanner.real());
  const auto value = static_cast<uint64_t>(scanner.i64());
  const uint32_t width = bitWidth(type);
  return static_cast<int64_t>(width >= 64 ? value : value & ((1ull << width) - 1));
}

void RungParser::parseBody() {
  bool first = true;
  while (scanner_.ok() && scanner_.acceptWord("source")) {
    parseSource(first);
    first = false;
  }
  while (scanner_.ok() && scanner_.acceptWord("reads")) {
    const ParsedPlace place = parsePlace(scanner_, module_, names_.spaces, PlaceForm::Bit);
    rung_.constantBits.push_back({SpaceId{place.space}, static_cast<uint32_t>(place.bitOffset)});
    scanner_.endLine();
  }
  while (scanner_.ok() && !scanner_.peek('}')) parseOp();
  scanner_.expect('}');
}

void RungParser::parseSource(bool first) {
  if (!first) rung_.sourceText += '\n';
  rung_.sourceText += scanner_.text();
  scanner_.endLine();
}

void RungParser::parseOp() {
  Op op;
  op.firstArg = static_cast<uint32_t>(rung_.args.size());
  parseResults(op);
  parseName(op);
  if (!scanner_.ok()) return;
  parseOperands(op, parseAttribute(op));
  if (scanner_.accept('@')) op.line = scanner_.u32();
  scanner_.endLine();
  if (scanner_.ok()) rung_.ops.push_back(op);
}

void RungParser::parseResults(Op& op) {
  if (!scanner_.peek('%')) return;
  do {
    const ValueId id = parseValue();
    if (id.index != rung_.values.size()) scanner_.fail(fmt::format("the next value is %{}", rung_.values.size()));
    if (op.resultCount == UINT16_MAX) scanner_.fail("too many results");
    scanner_.expect(':');
    rung_.values.push_back(parseType(scanner_));
    if (op.resultCount++ == 0) op.result = id;
  } while (scanner_.ok() && scanner_.accept(','));
  scanner_.expect('=');
}

// If the type is not written, it is that of the only result.
void RungParser::parseName(Op& op) {
  const std::string_view word = scanner_.word();
  const size_t dot = word.find('.');
  const OpInfo* info = findOp(word.substr(0, dot));
  if (info == nullptr) return scanner_.fail(fmt::format("there is no operation '{}'", word));
  op.code = info->code;
  if (dot != std::string_view::npos) {
    const auto type = typeFromName(word.substr(dot + 1));
    if (!type) return scanner_.fail(fmt::format("there is no type '{}'", word.substr(dot + 1)));
    op.type = *type;
  } else if (info->types != kNoTypes) {
    if (op.resultCount != 1) return scanner_.fail(fmt::format("'{}' needs a type", word));
    op.type = rung_.values.back();
  }
}

bool RungParser::parseAttribute(Op& op) {
  switch (opInfo(op.code).attr) {
  case Attr::None: return false;
  case Attr::Literal: op.imm = parseLiteral(scanner_, op.type); break;
  case Attr::Place:
  case Attr::Window: {
    const bool window = opInfo(op.code).attr == Attr::Window;
    const PlaceForm form = window ? PlaceForm::Window : op.type == Type::Bit ? PlaceForm::Bit : PlaceForm::Byte;
    const ParsedPlace place = parsePlace(scanner_, module_, names_.spaces, form);
    op.ref = place.space;
    op.imm = place.bitOffset;
    op.count = place.count;
    break;
  }
  case Attr::Slot:
    scanner_.expect('$');
    op.ref = scanner_.u32();
    break;
  case Attr::Count: op.count = scanner_.u32(); break;
  case Attr::MessageOp: {
    if (scanner_.accept('#')) {
      op.ref = scanner_.u32();
      break;
    }
    const std::string_view word = scanner_.word();
    const Keyword* keyword = findKeyword(kMessageOps, word);
    if (keyword != nullptr)
      op.ref = keyword->value;
    else
      scanner_.fail(fmt::format("unknown kind of message '{}'", word));
    break;
  }
  case Attr::Service: op.ref = parseReference(scanner_, names_.services, "service"); break;
  case Attr::ResultNo: op.imm = scanner_.i64(); break;
  case Attr::Fault: op.ref = parseReference(scanner_, names_.faults, "fault"); break;
  case Attr::BranchWeights: {
    const Keyword* branchWeights =
        std::ranges::find_if(kWeights, [&](const Keyword& k) { return scanner_.acceptWord(k.word); });
    if (branchWeights == std::end(kWeights)) return false;
    op.ref = branchWeights->value;
    break;
  }
  case Attr::Text:
    op.ref = static_cast<uint32_t>(rung_.notes.size());
    rung_.notes.push_back(scanner_.text());
    break;
  }
  return true;
}

void RungParser::parseOperands(Op& op, bool comma) {
  if (comma ? !scanner_.accept(',') : !scanner_.peek('%')) return;
  do {
    if (op.argCount == UINT16_MAX) scanner_.fail("too many operands");
    rung_.args.push_back(parseValue());
    ++op.argCount;
  } while (scanner_.ok() && scanner_.accept(','));
}

ValueId RungParser::parseValue() {
  scanner_.expect('%');
  return ValueId{scanner_.u32()};
}

std::string RungParser::parseTransfer() {
  Transfer& transfer = rung_.transfer;
  std::string callee;
  if (scanner_.acceptWord("goto")) {
    transfer.kind = TransferKind::Goto;
    transfer.target = scanner_.u32();
  } else if (scanner_.acceptWord("call")) {
    transfer.kind = TransferKind::Call;
    if (scanner_.peekName())
      callee = scanner_.name();
    else
      transfer.callee = RoutineId{parseReference(scanner_, names_.routines, "routine")};
  } else if (scanner_.acceptWord("ret")) {
    transfer.kind = TransferKind::Ret;
  } else if (scanner_.acceptWord("end")) {
    transfer.kind = TransferKind::End;
  } else if (scanner_.acceptWord("switch")) {
    transfer.kind = TransferKind::Switch;
    transfer.value = parseValue();
    scanner_.expect('[');
    do {
      if (scanner_.peekNumber()) transfer.targets.push_back(scanner_.u32());
    } while (scanner_.ok() && scanner_.accept(','));
    scanner_.expect(']');
  }
  if (scanner_.acceptWord("if")) transfer.cond = parseValue();
  if (scanner_.accept('@')) rung_.transferLine = scanner_.u32();
  return callee;
}

} // namespace rung::ir
