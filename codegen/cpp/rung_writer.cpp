// Writes operations as C++ text (see rung_writer.h).
#include "codegen/cpp/rung_writer.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "ir/core/eval.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/core/regions.h"
#include "ir/support/check.h"
#include "ir/support/put.h"

namespace rung::codegen {

using namespace ir;

namespace {

uint64_t placeKey(uint32_t space, int64_t bitOffset, bool bit) {
  return (static_cast<uint64_t>(space) << 40) | (static_cast<uint64_t>(bitOffset) << 1) | (bit ? 1u : 0u);
}

// The type of a place in the memory block whose offset is a multiple of `align`: m16, or m16u if it may be unaligned.
std::string memoryType(Type type, uint32_t align) {
  const uint32_t bits = bitWidth(type);
  RUNG_CHECK(bits >= 8, "a bit has no place of its own");
  const bool aligned = align % byteWidth(type) == 0;
  return fmt::format("m{}{}{}", type == Type::F64 ? "f" : "", bits, aligned ? "" : "u");
}

// Text for a line comment: without line ends, and without a backslash at the end, which would continue it.
std::string commentText(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c == '\n' || c == '\r' || c == '\\') c = ' ';
  return out;
}

} // namespace

std::string_view cppType(Type type) {
  switch (type) {
  case Type::Bit: return "bool";
  case Type::I8: return "u8";
  case Type::I16: return "u16";
  case Type::I32: return "u32";
  case Type::I64: return "u64";
  case Type::F64: return "double";
  case Type::None: break;
  }
  return "void";
}

std::string rungLabel(uint32_t rung) { return fmt::format("rung_{}", rung); }

PlaceNames::PlaceNames(const Module& module) {
  for (const Symbol* s : placedSymbols(module))
    if (s->space.valid())
      names_.try_emplace(placeKey(s->space.index, int64_t{s->byte} * 8 + s->bit, s->type == RUNG_TYPE_BIT), &s->name);
}

std::string_view PlaceNames::at(uint32_t space, int64_t bitOffset, bool bit) const {
  auto found = names_.find(placeKey(space, bitOffset, bit));
  return found == names_.end() ? std::string_view() : *found->second;
}

// ---- lines -------------------------------------------------------------------------------------------------------

void RungWriter::beginLine(uint32_t line, bool force) {
  if (open_ && line == line_ && !force) return;
  endLine();
  line_ = line;
  if (line != 0) put(out_, "#line {} \"{}\"\n", line, file_);
  out_ += "RUNG_LINE(\n";
  open_ = true;
}

void RungWriter::endLine() {
  if (open_) out_ += ")\n";
  open_ = false;
}

void RungWriter::statement(std::string_view text, std::string_view comment) {
  out_.append(2 + 2 * indent_, ' ');
  out_ += text;
  if (!comment.empty()) {
    out_ += " // ";
    out_ += commentText(comment);
  }
  out_ += '\n';
}

void RungWriter::write(const Rung& rung, uint32_t number, std::string_view file) {
  rung_ = &rung;
  number_ = number;
  file_ = file;
  throughMemory_ = valuesThroughMemory(rung);
  findRegions(rung, regions_);
  const bool hasStretches = isLong(rung);
  for (size_t i = 0; i < rung.ops.size(); ++i) {
    if (hasStretches && i != 0 && i % kStretch == 0) endBlock(i / kStretch);
    writeOp(rung.ops[i]);
  }
  throughMemory_.clear();
  endLine();
}

// The vectoriser and the scheduler also take time in proportion to the square of a basic block's length. This jump
// costs no instruction, but a compiler cannot know that, and begins a block at its label.
void RungWriter::endBlock(size_t stretch) {
  const std::string label = fmt::format("{}_stretch_{}", rungLabel(number_), stretch);
  statement(fmt::format("asm goto(\"\" : : : : {0}); {0}:;", label));
}

// ---- operations --------------------------------------------------------------------------------------------------

void RungWriter::declare(const Op& op, const std::string& expression, std::string_view comment) {
  const Type type = typeOf(*rung_, op.result);
  const bool through = !throughMemory_.empty() && throughMemory_[op.result.index];
  statement(fmt::format("const {}{} {} = {};", through ? "volatile " : "", cppType(type), v(op.result), expression),
            comment);
}

std::string RungWriter::placeComment(const Op& op) const {
  const Space& space = module_.spaces[op.ref];
  const std::string_view name = names_.at(op.ref, op.imm, op.type == Type::Bit);
  const int64_t unitBits = int64_t{space.unitBytes} * 8;
  std::string place = op.type == Type::Bit ? fmt::format("{}[{}.{}]", space.name, op.imm / unitBits, op.imm % unitBits)
                                           : fmt::format("{}[{}]", space.name, op.imm / unitBits);
  return name.empty() ? place : fmt::format("{} {}", name, place);
}

std::string RungWriter::load(const Op& op) const {
  if (op.type == Type::Bit) {
    const BitLocation at = layout_.bit(SpaceId{op.ref}, static_cast<uint64_t>(op.imm));
    return at.wholeByte ? fmt::format("RUNG_FLAG({})", at.offset) : fmt::format("RUNG_BIT({}, {})", at.offset, at.bit);
  }
  const uint32_t offset = layout_.byte(SpaceId{op.ref}, static_cast<uint32_t>(op.imm / 8));
  return fmt::format("RUNG_MEM({}, {})", memoryType(op.type, offset), offset);
}

void RungWriter::store(const Op& op) {
  const std::string value = a(op, 0);
  if (op.type == Type::Bit) {
    const BitLocation at = layout_.bit(SpaceId{op.ref}, static_cast<uint64_t>(op.imm));
    statement(at.wholeByte ? fmt::format("RUNG_SET_FLAG({}, {});", at.offset, value)
                           : fmt::format("RUNG_SET_BIT({}, {}, {});", at.offset, at.bit, value),
              placeComment(op));
    return;
  }
  const uint32_t offset = layout_.byte(SpaceId{op.ref}, static_cast<uint32_t>(op.imm / 8));
  statement(fmt::format("RUNG_MEM({}, {}) = {};", memoryType(op.type, offset), offset, value), placeComment(op));
}

void RungWriter::storeAt(const Op& op) {
  if (op.count == 0) return;
  const uint32_t unit = module_.spaces[op.ref].unitBytes;
  const uint32_t base = layout_.byte(SpaceId{op.ref}, static_cast<uint32_t>(op.imm / 8));
  if (op.code == OpCode::StoreBitAt)
    statement(
        fmt::format("RUNG_SET_BIT_AT({}u, {}u, {}u, {}, {}, {});", base, op.count, unit, a(op, 0), a(op, 1), a(op, 2)),
        placeComment(op));
  else
    statement(fmt::format("RUNG_SET_AT({}, {}u, {}u, {}u, {}, {});", memoryType(op.type, std::gcd(base, unit)), base,
                          op.count, unit, a(op, 0), a(op, 1)),
              placeComment(op));
}

// A value operation as a call of its function in sem.hpp, or as an operator of C++ if there is one.
std::string RungWriter::valueOf(const Op& op) {
  const auto infix = [&](std::string_view sign) { return fmt::format("{} {} {}", a(op, 0), sign, a(op, 1)); };
  const auto cast = [&](const std::string& text) { return fmt::format("static_cast<{}>({})", cppType(op.type), text); };
  const bool bit = op.type == Type::Bit;
  switch (op.code) {
  // For bits, too: && and || would ask for jumps, which compilers then keep as conditional moves.
  case OpCode::And: return bit ? infix("&") : cast(infix("&"));
  case OpCode::Or: return bit ? infix("|") : cast(infix("|"));
  case OpCode::Xor: return bit ? infix("!=") : cast(infix("^"));
  case OpCode::Not: return bit ? "!" + a(op, 0) : cast("~" + a(op, 0));
  case OpCode::Eq:
  case OpCode::FEq: return infix("==");
  case OpCode::Ne: return infix("!=");
  case OpCode::LtU:
  case OpCode::FLt: return infix("<");
  case OpCode::LeU:
  case OpCode::FLe: return infix("<=");
  case OpCode::Select: return fmt::format("{} ? {} : {}", a(op, 0), a(op, 1), a(op, 2));
  case OpCode::ZExt: return cast(a(op, 0));
  case OpCode::Trunc: return bit ? fmt::format("({} & 1) != 0", a(op, 0)) : cast(a(op, 0));
  default: return callOf(op);
  }
}

std::string RungWriter::callOf(const Op& op) {
  std::string function(opInfo(op.code).function);
  if (const size_t at = function.find("<T>"); at != std::string::npos)
    function.replace(at, 3, fmt::format("<{}>", cppType(op.type)));
  std::string args;
  for (int i = 0; i < op.argCount; ++i) args += (i == 0 ? "" : ", ") + a(op, i);
  return fmt::format("{}({})", function, args);
}

// The expression of an operation with a value and without a region.
std::string RungWriter::pure(const Op& op) {
  if (isEvaluable(opInfo(op.code))) return valueOf(op);
  const uint32_t unit = opInfo(op.code).attr == Attr::Window ? module_.spaces[op.ref].unitBytes : 0;
  const auto window = [&] { return layout_.byte(SpaceId{op.ref}, static_cast<uint32_t>(op.imm / 8)); };
  const bool bit = op.type == Type::Bit;
  switch (op.code) {
  case OpCode::Const:
    if (bit) return op.imm != 0 ? "true" : "false";
    if (op.type == Type::F64) return fmt::format("fromBits(0x{:016x}ull)", static_cast<uint64_t>(op.imm));
    return fmt::format("{}{}", static_cast<uint64_t>(op.imm), op.type == Type::I64 ? "ull" : "u");
  case OpCode::Load: return load(op);
  case OpCode::LoadAt:
    if (op.count == 0) return "0";
    return fmt::format("RUNG_AT({}, {}u, {}u, {}u, {})", memoryType(op.type, std::gcd(window(), unit)), window(),
                       op.count, unit, a(op, 0));
  case OpCode::LoadBitAt:
    if (op.count == 0) return "false";
    return fmt::format("RUNG_BIT_AT({}u, {}u, {}u, {}, {})", window(), op.count, unit, a(op, 0), a(op, 1));
  case OpCode::SlotLoad:
    return bit ? fmt::format("RUNG_FLAG({})", layout_.slot(SlotId{op.ref}))
               : fmt::format("RUNG_MEM({}, {})", memoryType(op.type, layout_.slot(SlotId{op.ref})),
                             layout_.slot(SlotId{op.ref}));
  case OpCode::Now: return "static_cast<u64>(ctx->now_us)";
  case OpCode::ServicePoll: return fmt::format("ctx->host->service_poll(ctx, {})", a(op, 0));
  case OpCode::ServiceResult:
    return fmt::format("static_cast<u64>(ctx->host->service_result(ctx, {}, {}u))", a(op, 0), op.imm);
  default: break;
  }
  RUNG_CHECK(false, "not an operation with a value");
  return {};
}

void RungWriter::writeOp(const Op& op) {
  const size_t index = static_cast<size_t>(&op - rung_->ops.data());
  beginLine(lineOf(*rung_, op), false);
  switch (op.code) {
  case OpCode::Store: return store(op);
  case OpCode::StoreAt:
  case OpCode::StoreBitAt: return storeAt(op);
  case OpCode::SlotStore: {
    const uint32_t offset = layout_.slot(SlotId{op.ref});
    const std::string value = a(op, 0);
    return statement(op.type == Type::Bit
                         ? fmt::format("RUNG_SET_FLAG({}, {});", offset, value)
                         : fmt::format("RUNG_MEM({}, {}) = {};", memoryType(op.type, offset), offset, value),
                     module_.slots[op.ref].key);
  }
  case OpCode::If: return openIf(op, index);
  case OpCode::Else:
    yield(op, rung_->ops[regions_[index].end]);
    --indent_;
    statement("} else {");
    ++indent_;
    return;
  case OpCode::EndIf:
    yield(op, op);
    --indent_;
    return statement("}");
  case OpCode::Loop: return openLoop(op);
  case OpCode::EndLoop: return closeLoop(op, index);
  case OpCode::Message:
  case OpCode::ServiceRequest:
  case OpCode::ProfEnter:
  case OpCode::ProfLeave: return host(op);
  case OpCode::Trap:
    return statement(fmt::format("RUNG_TRAP({}, {}u, {}u, {}u)", a(op, 0), op.ref, number_, lineOf(*rung_, op)),
                     module_.faults[op.ref]);
  case OpCode::Note: return statement("// " + commentText(rung_->notes[op.ref]));
  default: break;
  }
  const Attr attr = opInfo(op.code).attr;
  const bool place = attr == Attr::Place || attr == Attr::Window;
  declare(op, pure(op),
          place                         ? placeComment(op)
          : op.code == OpCode::SlotLoad ? module_.slots[op.ref].key
                                        : std::string());
}

// ---- regions: results of an endif and the carried values of a loop are variables declared before it --------------

void RungWriter::openIf(const Op& op, size_t index) {
  const Op& half = rung_->ops[regions_[index].end];
  const Op& end = half.code == OpCode::Else ? rung_->ops[regions_[regions_[index].end].end] : half;
  for (uint32_t i = 0; i < end.resultCount; ++i) {
    const ValueId id{end.result.index + i};
    statement(fmt::format("{} {};", cppType(typeOf(*rung_, id)), v(id)));
  }
  constexpr std::string_view kHints[] = {"", "[[likely]] ", "[[unlikely]] "}; // by BranchWeights
  statement(fmt::format("if ({}) {}{{", a(op, 0), kHints[op.ref]));
  ++indent_;
}

void RungWriter::yield(const Op& op, const Op& end) {
  for (uint32_t i = 0; i < end.resultCount; ++i) {
    const ValueId id{end.result.index + i};
    statement(fmt::format("{} = {};", v(id), a(op, static_cast<int>(i))));
  }
}

void RungWriter::openLoop(const Op& op) {
  const std::string pass = v(op.result);
  for (uint32_t i = 1; i < op.resultCount; ++i) {
    const ValueId id{op.result.index + i};
    statement(fmt::format("{} {} = {};", cppType(typeOf(*rung_, id)), v(id), a(op, static_cast<int>(i - 1))));
  }
  statement(fmt::format("for (u32 {0} = 0; {0} < {1}u; ++{0}) {{", pass, op.count));
  ++indent_;
}

void RungWriter::closeLoop(const Op& op, size_t index) {
  const Op& begin = rung_->ops[regions_[index].begin];
  // All next values are read before the first one is assigned.
  for (uint32_t i = 0; i < op.argCount; ++i)
    statement(fmt::format("const {} n{} = {};", cppType(typeOf(*rung_, arg(*rung_, op, static_cast<int>(i)))), i,
                          a(op, static_cast<int>(i))));
  for (uint32_t i = 0; i < op.argCount; ++i)
    statement(fmt::format("{} = n{};", v(ValueId{begin.result.index + 1 + i}), i));
  --indent_;
  statement("}");
  for (uint32_t i = 0; i < op.resultCount; ++i) {
    const ValueId id{op.result.index + i};
    statement(
        fmt::format("const {} {} = {};", cppType(typeOf(*rung_, id)), v(id), v(ValueId{begin.result.index + 1 + i})));
  }
}

// ---- host --------------------------------------------------------------------------------------------------------

void RungWriter::host(const Op& op) {
  if (op.code == OpCode::ProfEnter) return statement(fmt::format("RUNG_PROF_ENTER({}u);", number_));
  if (op.code == OpCode::ProfLeave) return statement(fmt::format("RUNG_PROF_LEAVE({}u);", number_));
  if (op.code == OpCode::Message) {
    const bool real = typeOf(*rung_, arg(*rung_, op, 3)) == Type::F64;
    return statement(fmt::format("RUNG_MESSAGE({}u, {}, {}, {}, {}, {}u, {}u)", op.ref, a(op, 0), a(op, 1), a(op, 2),
                                 real ? fmt::format("toBits({})", a(op, 3)) : a(op, 3), real ? 1 : 0, number_));
  }
  const std::string array = fmt::format("a{}", op.result.index);
  std::string values;
  for (uint32_t i = 0; i < op.argCount; ++i)
    values += fmt::format("{}static_cast<i64>({})", i == 0 ? "" : ", ", a(op, static_cast<int>(i)));
  statement(fmt::format("const i64 {}[{}] = {{{}}};", array, std::max(1u, unsigned{op.argCount}), values));
  declare(op, fmt::format("ctx->host->service_request(ctx, {}u, {}, {}u)", op.ref, array, op.argCount),
          module_.services[op.ref]);
}

// ---- exits -------------------------------------------------------------------------------------------------------

std::string RungWriter::transferTo(const Destination& to) const {
  const std::string label = to.inside() ? fmt::format("goto {};", rungLabel(to.rung)) : "";
  if (to.inside()) return to.extra == 0 ? label : fmt::format("{{ extra += {}u; {} }}", to.extra, label);
  return leaving(to.chunk == RUNG_NONE ? std::string("RUNG_RETURN;") : fmt::format("return {}u;", to.chunk));
}

// A statement that leaves the chunk.
std::string RungWriter::leaving(const std::string& how) const {
  return extraWeight_ ? fmt::format("{{ ctx->extra_weight = extra; {} }}", how) : how;
}

void RungWriter::writeExit(const Exit& exit) {
  const std::string when = exit.cond.valid() ? fmt::format("if ({}) ", v(exit.cond)) : "";
  const bool falls = exit.otherwise.inside(); // to the rung below, which follows in the text
  if (exit.kind == TransferKind::Next && falls) return;
  beginLine(rung_->transferLine != 0 ? rung_->transferLine : rung_->begin.line, true);
  switch (exit.kind) {
  case TransferKind::Next: statement(transferTo(exit.otherwise)); break;
  case TransferKind::Goto: statement(when + transferTo(exit.taken)); break;
  case TransferKind::Call:
    // A call at the end of a routine needs no return address: the callee returns to the caller.
    statement(exit.otherwise.chunk == RUNG_NONE
                  ? when + transferTo(exit.taken)
                  : when + leaving(fmt::format("RUNG_CALL({}u, {}u)", exit.otherwise.chunk, exit.taken.chunk)));
    break;
  case TransferKind::Ret: statement(when + leaving("RUNG_RETURN;")); break;
  case TransferKind::End: statement(when + leaving("return RUNG_PC_DONE;")); break;
  case TransferKind::Switch: {
    statement(fmt::format("switch ({}) {{", v(exit.value)));
    for (size_t i = 1; i < exit.targets.size(); ++i)
      statement(fmt::format("  case {}u: {}", i, transferTo(exit.targets[i])));
    statement(fmt::format("  default: {}", transferTo(exit.targets[0])));
    statement("}");
    break;
  }
  }
  if (exit.cond.valid()) {
    if (!falls) statement(transferTo(exit.otherwise));
    if (falls && exit.otherwise.extra != 0) statement(fmt::format("extra += {}u;", exit.otherwise.extra));
  }
  endLine();
}

} // namespace rung::codegen
