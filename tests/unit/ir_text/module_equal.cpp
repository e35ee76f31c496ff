// Field by field comparison of modules (see module_equal.h).
#include "tests/unit/ir_text/module_equal.h"

#include <algorithm>

namespace rung::ir {
namespace {

template <class T>
bool equalAll(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const T& x, const T& y) { return equal(x, y); });
}

} // namespace

bool equal(const Location& a, const Location& b) {
  const auto& [file, line, column] = a;
  return file == b.file && line == b.line && column == b.column;
}

bool equal(const Op& a, const Op& b) {
  const auto& [code, type, argCount, resultCount, firstArg, result, ref, count, imm, line] = a;
  return code == b.code && type == b.type && argCount == b.argCount && resultCount == b.resultCount &&
         firstArg == b.firstArg && result == b.result && ref == b.ref && count == b.count && imm == b.imm &&
         line == b.line;
}

bool equal(const Transfer& a, const Transfer& b) {
  const auto& [kind, cond, value, target, callee, targets] = a;
  return kind == b.kind && cond == b.cond && value == b.value && target == b.target && callee == b.callee &&
         targets == b.targets;
}

bool equal(const Rung& a, const Rung& b) {
  const auto& [number, title, sourceText, begin, lastLine, key, copy, weight, constantBits, ops, args, values, notes,
               transfer, transferLine, origin] = a;
  return number == b.number && title == b.title && sourceText == b.sourceText && equal(begin, b.begin) &&
         lastLine == b.lastLine && key == b.key && copy == b.copy && weight == b.weight &&
         constantBits == b.constantBits && equalAll(ops, b.ops) && args == b.args && values == b.values &&
         notes == b.notes && equal(transfer, b.transfer) && transferLine == b.transferLine && origin == b.origin;
}

bool equal(const Routine& a, const Routine& b) {
  const auto& [name, rungs] = a;
  return name == b.name && equalAll(rungs, b.rungs);
}

bool equal(const Space& a, const Space& b) {
  const auto& [name, unitBytes, units, flags, packedOnly] = a;
  return name == b.name && unitBytes == b.unitBytes && units == b.units && flags == b.flags &&
         packedOnly == b.packedOnly;
}

bool equal(const Slot& a, const Slot& b) {
  const auto& [type, init, transient, key] = a;
  return type == b.type && init == b.init && transient == b.transient && key == b.key;
}

bool equal(const Symbol& a, const Symbol& b) {
  const auto& [name, comment, space, byte, bit, type, count, flags, value] = a;
  return name == b.name && comment == b.comment && space == b.space && byte == b.byte && bit == b.bit &&
         type == b.type && count == b.count && flags == b.flags && value == b.value;
}

bool equal(const SpaceSpan& a, const SpaceSpan& b) {
  const auto& [space, byte, size] = a;
  return space == b.space && byte == b.byte && size == b.size;
}

bool equal(const Copy& a, const Copy& b) {
  const auto& [masked, from, to, toByte, mask, maskByte] = a;
  return masked == b.masked && equal(from, b.from) && to == b.to && toByte == b.toByte && mask == b.mask &&
         maskByte == b.maskByte;
}

bool equal(const Continuation& a, const Continuation& b) {
  const auto& [key, slot, space, byte, points] = a;
  return key == b.key && slot == b.slot && space == b.space && byte == b.byte && points == b.points;
}

bool equal(const TimerCell& a, const TimerCell& b) {
  const auto& [type, slot, space, byte] = a;
  return type == b.type && slot == b.slot && space == b.space && byte == b.byte;
}

bool equal(const Timer& a, const Timer& b) {
  const auto& [name, flags, time, timeUs, running, preset, constant, unit, unitsUs] = a;
  return name == b.name && flags == b.flags && equal(time, b.time) && timeUs == b.timeUs && running == b.running &&
         equal(preset, b.preset) && constant == b.constant && equal(unit, b.unit) && unitsUs == b.unitsUs;
}

bool equal(const Init& a, const Init& b) {
  const auto& [space, byte, data] = a;
  return space == b.space && byte == b.byte && data == b.data;
}

bool equal(const Task& a, const Task& b) {
  const auto& [name, entry, periodUs, budget, budgetFault, begin, end, parts, borders] = a;
  return name == b.name && entry == b.entry && periodUs == b.periodUs && budget == b.budget &&
         budgetFault == b.budgetFault && equalAll(begin, b.begin) && equalAll(end, b.end) && parts == b.parts &&
         borders == b.borders;
}

bool equal(const Step& a, const Step& b) {
  const auto& [op, task, arg] = a;
  return op == b.op && task == b.task && arg == b.arg;
}

bool equal(const MessageText& a, const MessageText& b) {
  const auto& [number, text] = a;
  return number == b.number && text == b.text;
}

bool equal(const Module& a, const Module& b) {
  const auto& [name, dialect, files, spaces, slots, continuations, timers, symbols, inits, retains, safeSpans, faults,
               services, messages, routines, tasks, mainTask, fastTask, scan, fast, slices, instrumented] = a;
  return name == b.name && dialect == b.dialect && files == b.files && equalAll(spaces, b.spaces) &&
         equalAll(slots, b.slots) && equalAll(continuations, b.continuations) && equalAll(timers, b.timers) &&
         equalAll(symbols, b.symbols) && equalAll(inits, b.inits) && equalAll(retains, b.retains) &&
         equalAll(safeSpans, b.safeSpans) && faults == b.faults && services == b.services &&
         equalAll(messages, b.messages) && equalAll(routines, b.routines) && equalAll(tasks, b.tasks) &&
         mainTask == b.mainTask && fastTask == b.fastTask && equalAll(scan, b.scan) && equalAll(fast, b.fast) &&
         equalAll(slices, b.slices) && instrumented == b.instrumented;
}

} // namespace rung::ir
