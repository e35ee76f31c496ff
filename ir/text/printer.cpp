// The printer of the text form (see text.h). It assumes nothing: invalid modules can be printed, too.
#include <bit>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unordered_map>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/support/put.h"
#include "ir/text/keywords.h"
#include "ir/text/text.h"
#include "rtlib/text/letters.h"

namespace rung::ir {
namespace {

void putQuoted(std::string& out, std::string_view text) {
  out += '"';
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += '\\', out += c;
    else if (c == '\n')
      out += "\\n";
    else if (c == '\r')
      out += "\\r";
    else if (c == '\t')
      out += "\\t";
    else if (byte < 0x20 || byte == 0x7F)
      rung::put(out, "\\x{:02X}", byte);
    else
      out += c;
  }
  out += '"';
}

std::string inQuotes(std::string_view text) {
  std::string out;
  putQuoted(out, text);
  return out;
}

bool isWord(std::string_view name) {
  if (name.empty() || text::isDigit(name[0])) return false;
  for (char c : name)
    if (!isNameChar(c)) return false;
  return true;
}

std::string nameText(std::string_view name) { return isWord(name) ? std::string(name) : inQuotes(name); }

// Names of one kind for references: the name if it is unique, otherwise the index.
class References {
public:
  void add(std::string_view name) {
    const auto number = static_cast<uint32_t>(texts_.size());
    const auto [first, isNew] = first_.try_emplace(name, number);
    texts_.push_back(isNew ? nameText(name) : fmt::format("#{}", number));
    if (!isNew) texts_[first->second] = fmt::format("#{}", first->second);
  }
  std::string text(uint32_t index) const {
    if (index == RUNG_NONE) return "-";
    return index < texts_.size() ? texts_[index] : fmt::format("#{}", index);
  }

private:
  std::vector<std::string> texts_;
  std::unordered_map<std::string_view, uint32_t> first_; // the first item with each name
};

// The key of a place's name, for comments.
struct PlaceKey {
  uint32_t space;
  int64_t bitOffset;
  bool bit;
  bool operator==(const PlaceKey&) const = default;
};
struct PlaceKeyHash {
  size_t operator()(const PlaceKey& key) const {
    return std::hash<uint64_t>()((static_cast<uint64_t>(key.space) << 40) ^
                                 (static_cast<uint64_t>(key.bitOffset) << 1) ^ (key.bit ? 1 : 0));
  }
};

class Printer {
public:
  explicit Printer(const Module& module) : module_(module) {
    for (const std::string& file : module.files) files_.add(file);
    for (const Space& space : module.spaces) spaces_.add(space.name);
    for (const std::string& fault : module.faults) faults_.add(fault);
    for (const std::string& service : module.services) services_.add(service);
    for (const Routine& routine : module.routines) routines_.add(routine.name);
    for (const Task& task : module.tasks) tasks_.add(task.name);
    for (const Symbol* s : placedSymbols(module))
      symbols_.try_emplace({s->space.index, int64_t{s->byte} * 8 + s->bit, s->type == RUNG_TYPE_BIT}, s->name);
  }

  void printModule() {
    put("module {} dialect {}{}\n", inQuotes(module_.name), inQuotes(module_.dialect),
        module_.instrumented ? " instrumented" : "");
    for (const std::string& file : module_.files) put("file {}\n", inQuotes(file));
    printMemory();
    for (const std::string& fault : module_.faults) put("fault {}\n", nameText(fault));
    for (const std::string& service : module_.services) put("service {}\n", nameText(service));
    for (const MessageText& message : module_.messages) put("message {} {}\n", message.number, inQuotes(message.text));
    for (const Routine& routine : module_.routines) {
      put("\nroutine {} {{\n", nameText(routine.name));
      for (uint32_t i = 0; i < routine.rungs.size(); ++i) printRung(routine.rungs[i], i, {});
      put("}}\n");
    }
    if (!module_.tasks.empty()) put("\n");
    for (const Task& task : module_.tasks) printTask(task);
    put("schedule main {} fast {}\n", tasks_.text(module_.mainTask.index), tasks_.text(module_.fastTask.index));
    for (const StepList& list : kStepLists)
      for (const Step& step : module_.*list.steps) printStep(list.keyword, step);
  }

  void printRung(const Rung& rung, uint32_t number, const Remark& remark);
  std::string take() { return std::move(out_); }

private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    rung::put(out_, format, std::forward<Args>(args)...);
  }
  // Most of the text is operations, which are therefore not formatted by fmt.
  void add(std::string_view text) { out_ += text; }
  void add(uint64_t number) {
    char text[20];
    out_.append(text, std::to_chars(text, text + sizeof text, number).ptr);
  }

  void printMemory();
  void printFlags(std::span<const Keyword> list, uint32_t flags);
  std::string timerCell(const TimerCell& cell) const;
  void printTimer(const Timer& timer);
  void printTask(const Task& task);
  void printCopy(std::string_view when, const Copy& copy);
  void printStep(std::string_view list, const Step& step) {
    const Keyword* op = findKeyword(kStepOps, step.op);
    put("step {} {} {} {}\n", list, op != nullptr ? std::string(op->word) : fmt::format("#{}", step.op),
        tasks_.text(step.task.index), step.arg);
  }

  uint32_t unitOf(uint32_t space) const {
    const uint32_t unit = space < module_.spaces.size() ? module_.spaces[space].unitBytes : 1;
    return unit == 0 ? 1 : unit;
  }
  std::string bytePlace(uint32_t space, uint64_t byte, std::string_view more = {}) const {
    const uint32_t unit = unitOf(space);
    const uint64_t rest = byte % unit;
    const std::string tail = rest == 0 ? "" : "+" + std::to_string(rest);
    return (spaces_.text(space) + "[").append(std::to_string(byte / unit)).append(tail).append(more).append("]");
  }
  std::string bitPlace(uint32_t space, uint64_t bitOffset) const {
    const uint64_t unitBits = uint64_t{unitOf(space)} * 8;
    return (spaces_.text(space) + "[")
        .append(std::to_string(bitOffset / unitBits))
        .append(".")
        .append(std::to_string(bitOffset % unitBits))
        .append("]");
  }
  std::string place(const Op& op, bool window) const {
    const std::string more = window ? " count " + std::to_string(op.count) : "";
    const bool bit = op.type == Type::Bit && !window;
    if (op.imm < 0 || (!bit && op.imm % 8 != 0)) return fmt::format("{}[!{}{}]", spaces_.text(op.ref), op.imm, more);
    const auto offset = static_cast<uint64_t>(op.imm);
    return bit ? bitPlace(op.ref, offset) : bytePlace(op.ref, offset / 8, more);
  }
  std::string literal(Type type, int64_t bits) const;
  std::string attribute(const Rung& rung, const Op& op) const;
  std::string_view comment(const Op& op) const;
  void printResults(const Rung& rung, const Op& op);
  void printOp(const Rung& rung, const Op& op);
  void printOps(const Rung& rung, const Remark& remark);
  void printTransfer(const Rung& rung);
  void printRemark(const Remark& remark, size_t index, size_t indent);

  const Module& module_;
  References files_, spaces_, faults_, services_, routines_, tasks_;
  std::unordered_map<PlaceKey, std::string_view, PlaceKeyHash> symbols_;
  std::string out_;
};

// ---- declarations --------------------------------------------------------------------------------------------------

void Printer::printFlags(std::span<const Keyword> list, uint32_t flags) {
  for (const Keyword& keyword : list) {
    if ((flags & keyword.value) != 0) put(" {}", keyword.word);
    flags &= ~keyword.value;
  }
  if (flags != 0) put(" #{}", flags);
}

std::string Printer::timerCell(const TimerCell& cell) const {
  return fmt::format("{} {}", typeName(cell.type),
                     cell.slot.valid() ? fmt::format("${}", cell.slot.index) : bytePlace(cell.space.index, cell.byte));
}

void Printer::printTimer(const Timer& timer) {
  put("timer {}", inQuotes(timer.name));
  printFlags(kTimerFlags, timer.flags);
  put(" time {} by {}", timerCell(timer.time), timer.timeUs);
  if (timer.running.valid()) put(" running ${}", timer.running.index);
  put(" preset {}",
      timer.preset.type == Type::None ? fmt::format("const {}", timer.constant) : timerCell(timer.preset));
  if (timer.unit.type != Type::None) put(" unit {}", timerCell(timer.unit));
  put(" of {}\n", fmt::join(timer.unitsUs, ","));
}

void Printer::printMemory() {
  for (const Space& space : module_.spaces) {
    put("space {} unit {} units {}", nameText(space.name), space.unitBytes, space.units);
    printFlags(kSpaceFlags, space.flags);
    put("{}\n", space.packedOnly ? " packed" : "");
  }
  for (size_t i = 0; i < module_.slots.size(); ++i) {
    const Slot& slot = module_.slots[i];
    put("slot ${} {} init {}{} {}\n", i, typeName(slot.type), literal(slot.type, slot.init),
        slot.transient ? " transient" : "", inQuotes(slot.key));
  }
  for (const Continuation& c : module_.continuations) {
    put("continuation {} {} points", inQuotes(c.key),
        c.slot.valid() ? fmt::format("${}", c.slot.index) : bytePlace(c.space.index, c.byte));
    for (const std::string& point : c.points) put(" {}", inQuotes(point));
    put("\n");
  }
  for (const Timer& timer : module_.timers) printTimer(timer);
  for (const Symbol& s : module_.symbols) {
    const Keyword* type = findKeyword(kSymbolTypes, s.type);
    const bool bit = s.type == RUNG_TYPE_BIT;
    put("symbol {} {} {} count {}", nameText(s.name),
        type != nullptr ? std::string(type->word) : fmt::format("#{}", s.type),
        bit ? bitPlace(s.space.index, uint64_t{s.byte} * 8 + s.bit) : bytePlace(s.space.index, s.byte), s.count);
    printFlags(kSymbolFlags, s.flags);
    put(" value {} {}\n", s.value, inQuotes(s.comment));
  }
  for (const Init& init : module_.inits) {
    put("init {} ", bytePlace(init.space.index, init.byte));
    for (uint8_t byte : init.data) put("{:02X}", byte);
    put("\n");
  }
  for (const SpaceSpan& span : module_.retains)
    put("retain {} size {}\n", bytePlace(span.space.index, span.byte), span.size);
  for (const SpaceSpan& span : module_.safeSpans)
    put("safe {} size {}\n", bytePlace(span.space.index, span.byte), span.size);
}

void Printer::printTask(const Task& task) {
  put("task {} entry {} period {} budget {} fault {} parts {}", nameText(task.name), routines_.text(task.entry.index),
      task.periodUs, task.budget, faults_.text(task.budgetFault.index), task.parts);
  for (const uint32_t rung : task.borders) put(" at {}", rung);
  put(" {{\n");
  for (const Copy& copy : task.begin) printCopy("begin", copy);
  for (const Copy& copy : task.end) printCopy("end", copy);
  put("}}\n");
}

void Printer::printCopy(std::string_view when, const Copy& copy) {
  put("  {} {} -> {} size {}", when, bytePlace(copy.from.space.index, copy.from.byte),
      bytePlace(copy.to.index, copy.toByte), copy.from.size);
  if (copy.masked) put(" masked {}", bytePlace(copy.mask.index, copy.maskByte));
  put("\n");
}

// ---- rungs ---------------------------------------------------------------------------------------------------------

std::string Printer::literal(Type type, int64_t bits) const {
  const auto raw = static_cast<uint64_t>(bits);
  if (type == Type::F64) {
    const double value = std::bit_cast<double>(raw);
    if (!std::isfinite(value)) return fmt::format("bits(0x{:016X})", raw);
    char text[40];
    return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
  }
  const uint32_t width = bitWidth(type);
  if (width >= 64 || width <= 1) return std::to_string(bits);
  const uint64_t sign = 1ull << (width - 1);
  if ((raw >> width) != 0) return fmt::format("bits(0x{:X})", raw); // more bits than the type has
  return std::to_string(static_cast<int64_t>((raw ^ sign) - sign));
}

std::string Printer::attribute(const Rung& rung, const Op& op) const {
  switch (opInfo(op.code).attr) {
  case Attr::None: return {};
  case Attr::Literal: return literal(op.type, op.imm);
  case Attr::Place: return place(op, false);
  case Attr::Window: return place(op, true);
  case Attr::Slot: return "$" + std::to_string(op.ref);
  case Attr::Count: return std::to_string(op.count);
  case Attr::MessageOp: {
    const Keyword* keyword = findKeyword(kMessageOps, op.ref);
    return keyword != nullptr ? std::string(keyword->word) : fmt::format("#{}", op.ref);
  }
  case Attr::Service: return services_.text(op.ref);
  case Attr::ResultNo: return std::to_string(op.imm);
  case Attr::Fault: return faults_.text(op.ref);
  case Attr::BranchWeights: {
    const Keyword* keyword = findKeyword(kWeights, op.ref);
    return keyword != nullptr ? std::string(keyword->word) : std::string();
  }
  case Attr::Text: return op.ref < rung.notes.size() ? inQuotes(rung.notes[op.ref]) : fmt::format("#{}", op.ref);
  }
  return {};
}

// The name of the accessed place; empty if there is none.
std::string_view Printer::comment(const Op& op) const {
  const Attr attr = opInfo(op.code).attr;
  if (attr == Attr::Slot)
    return op.ref < module_.slots.size() ? std::string_view(module_.slots[op.ref].key) : std::string_view();
  if (attr != Attr::Place && attr != Attr::Window) return {};
  auto found = symbols_.find({op.ref, op.imm, attr == Attr::Place && op.type == Type::Bit});
  return found == symbols_.end() ? std::string_view() : found->second;
}

void Printer::printResults(const Rung& rung, const Op& op) {
  for (uint32_t i = 0; i < op.resultCount; ++i) {
    const uint32_t id = op.result.index + i;
    add(i == 0 ? "%" : ", %");
    add(id);
    add(":");
    add(id < rung.values.size() ? typeName(rung.values[id]) : "none");
  }
  if (op.resultCount != 0) add(" = ");
}

void Printer::printOp(const Rung& rung, const Op& op) {
  printResults(rung, op);
  const bool typed =
      op.resultCount == 1 && op.result.index < rung.values.size() && rung.values[op.result.index] == op.type;
  const OpInfo& info = opInfo(op.code);
  add(info.name);
  if (op.type != Type::None && !typed) {
    add(".");
    add(typeName(op.type));
  }
  std::string_view lead = " %";
  if (const std::string text = attribute(rung, op); !text.empty()) {
    add(" ");
    add(text);
    lead = ", %";
  }
  for (uint32_t i = 0; i < op.argCount; ++i, lead = ", %") {
    const uint64_t at = uint64_t{op.firstArg} + i;
    add(lead);
    if (at < rung.args.size())
      add(rung.args[at].index);
    else
      add("?");
  }
  if (op.line != 0) {
    add(" @");
    add(op.line);
  }
  if (const std::string_view name = comment(op); !name.empty()) {
    add(" ; ");
    putQuoted(out_, name);
  }
  add("\n");
}

void Printer::printTransfer(const Rung& rung) {
  const Transfer& transfer = rung.transfer;
  put("  }}");
  switch (transfer.kind) {
  case TransferKind::Next: break;
  case TransferKind::Goto: put(" goto {}", transfer.target); break;
  case TransferKind::Call: put(" call {}", routines_.text(transfer.callee.index)); break;
  case TransferKind::Ret: put(" ret"); break;
  case TransferKind::End: put(" end"); break;
  case TransferKind::Switch: put(" switch %{} [{}]", transfer.value.index, fmt::join(transfer.targets, ", ")); break;
  }
  if (transfer.cond.valid()) put(" if %{}", transfer.cond.index);
  if (rung.transferLine != 0) put(" @{}", rung.transferLine);
  put("\n");
}

void Printer::printRemark(const Remark& remark, size_t index, size_t indent) {
  if (!remark) return;
  std::string text = remark(index);
  if (text.empty()) return;
  for (char& c : text)
    if (c == '\n' || c == '\r') c = ' ';
  put("{:{}}; ^ {}\n", "", indent, text);
}

void Printer::printOps(const Rung& rung, const Remark& remark) {
  size_t indent = 4;
  for (size_t i = 0; i < rung.ops.size(); ++i) {
    const OpCode code = rung.ops[i].code;
    const bool closes = code == OpCode::Else || code == OpCode::EndIf || code == OpCode::EndLoop;
    if (closes && indent > 4) indent -= 2;
    out_.append(indent, ' ');
    printOp(rung, rung.ops[i]);
    printRemark(remark, i, indent);
    if (code == OpCode::If || code == OpCode::Else || code == OpCode::Loop) indent += 2;
  }
}

void Printer::printRung(const Rung& rung, uint32_t number, const Remark& remark) {
  const Origin& origin = rung.origin;
  const std::string from =
      origin.index == RUNG_NONE ? "" : fmt::format("from {} {} ", nameText(origin.routine), origin.index);
  const std::string drawn = rung.number == 0 ? "" : fmt::format("drawn {} ", rung.number);
  const std::string copy = rung.copy == 0 ? "" : fmt::format("copy {} ", rung.copy);
  put("  rung {} {}{}{} loc({}:{}:{}-{}) key(0x{:016X}) {}weight {} {{\n", number, from, drawn, inQuotes(rung.title),
      files_.text(rung.begin.file.index), rung.begin.line, rung.begin.column, rung.lastLine, rung.key, copy,
      rung.weight);
  std::string_view source = rung.sourceText;
  for (bool more = !source.empty(); more;) {
    const size_t end = source.find('\n');
    put("    source {}\n", inQuotes(source.substr(0, end)));
    more = end != std::string_view::npos;
    source.remove_prefix(more ? end + 1 : source.size());
  }
  for (const SpaceBit& read : rung.constantBits) put("    reads {}\n", bitPlace(read.space.index, read.bit));
  printOps(rung, remark);
  printTransfer(rung);
  printRemark(remark, rung.ops.size(), 2);
}

} // namespace

std::string print(const Module& module) {
  Printer printer(module);
  printer.printModule();
  return printer.take();
}

std::string printRung(const Module& module, RoutineId routine, uint32_t rung, const Remark& remark) {
  Printer printer(module);
  printer.printRung(module.at(routine).rungs[rung], rung, remark);
  return printer.take();
}

} // namespace rung::ir
