// Messages: ESET, ESET1, EDEF (man. ch. 14.3).
#include "frontend/dialects/technol/lower/lower_message.h"

#include <algorithm>

#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/technol/services.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

MessageParts partsOf(Memory& memory, ValueId number, const Operand& subId, std::span<const Operand> pars) {
  const ValueId par1 = valueOr0(memory, pars[0], Type::I32), par2 = valueOr0(memory, pars[1], Type::I32);
  const ValueId both = bothPars(memory.emitter().b(), par1, par2);
  return {number, valueOr0(memory, subId, Type::I32), valueOr0(memory, pars[2], Type::I32), both};
}

// Shows the message if `set` is 1 or not given; removes it if `set` is 0.
void showOrRemove(ir::RungBuilder& b, const MessageParts& m, ValueId set) {
  if (!set.valid()) return send(b, m, RUNG_MESSAGE_SHOW_LOG, 0);
  const auto give = [&](uint32_t op) { return [&, op] { send(b, m, op, nc::technol::kPersistentWanted); }; };
  b.when(set, give(RUNG_MESSAGE_SHOW_LOG), give(RUNG_MESSAGE_CLEAR));
}

} // namespace

// ESET [error],[subid],[set],[par1],[par2],[par3]; an omitted number is taken from DR (man. l.5086-5130). _ON_ESET is
// called with the number in DR when a message is shown, not when one is removed (man. l.1609, l.5132).
void lowerMessage(Lowering& l, std::span<const Operand> o, int condition) {
  ir::RungBuilder& b = l.b();
  const ValueId word = o[0].given() ? b.zextOrTrunc(Type::I16, l.memory.value(o[0])) : l.r().dr(Type::I16);
  const ValueId number = b.zextOrTrunc(Type::I32, word);
  ValueId set;
  if (o[2].given()) {
    const ValueId value = valueOr0(l.memory, o[2], Type::I32);
    set = b.ne(value, b.i32(0));
  }
  const MessageParts message = partsOf(l.memory, number, o[1], o.subspan(3, 3));
  const ValueId rlo = l.guardOf(condition);
  const bool calls =
      l.procedures.onMessage() != kNone && l.program.source.procedureOf(l.statement().unit) != l.procedures.onMessage();
  const ValueId comesUp = !set.valid() ? rlo : !rlo.valid() ? set : b.and_(rlo, set);
  if (calls) l.procedures.saveRegisters();
  b.when(rlo, [&] { showOrRemove(b, message, set); });
  if (!calls) return;
  l.r().setDr(b.zextOrTrunc(Type::I64, number));
  l.callProcedure(l.procedures.onMessage(), comesUp);
  l.procedures.restoreRegisters();
}

namespace {

constexpr uint32_t kMostEntries = 64; // per EDEF

} // namespace

// EDEF [val],bit,error,[subid],mod,[par1],[par2],[par3] (man. l.5192-5260). Executed again with the same number and
// addresses it refers to the same message, otherwise it adds another one.
void lowerBitMessage(Lowering& l, std::span<const Operand> o, int) {
  const ValueId word = l.b().zextOrTrunc(Type::I16, l.memory.value(o[2]));
  const ValueId number = l.b().zextOrTrunc(Type::I32, word), subId = valueOr0(l.memory, o[3], Type::I32);
  BitMessage message{.statement = &l.statement(), .pars = o.subspan(5, 3), .mode = static_cast<uint32_t>(o[4].value)};
  message.places[0] = l.memory.reach(o[0].given() ? o[0] : o[1]);
  message.places[0].place.bit = o[1].place.bit;
  for (size_t i = 0; i < message.pars.size(); ++i) message.places[1 + i] = l.memory.reach(message.pars[i]);
  const bool varies = !o[2].isConstant() || (o[3].given() && !o[3].isConstant()) ||
                      std::ranges::any_of(message.places, &MemoryAccess::indexed);
  message.capacity = varies ? kMostEntries : 1;
  l.bitMessages.add(message, number, subId);
}

// Bits that trigger messages.

using ir::Type;
using ir::ValueId;

namespace {

constexpr uint32_t kCountBytes = 4;
// Layout of an entry, as byte offsets. The index field holds the indices of the bit and the three values, where BX was
// added.
enum Field : uint32_t { kNumberField = 0, kSubIdField = 4, kIndexField = 8, kOldField = 24 };
constexpr uint32_t kEntryBytes = 28;
enum Edge : uint32_t { kNever, kRising, kFalling };

// Accesses the entries of one statement in the space @EDEF.
class Entries {
public:
  Entries(ir::RungBuilder& b, ir::SpaceId space, const BitMessage& message) : b_(b), space_(space), message_(message) {}

  ir::Place count() const { return {.space = space_, .byte = message_.table}; }
  ValueId load(Type type, uint32_t field, ValueId entry) const {
    if (message_.capacity == 1) return b_.load(type, fixed(field));
    return b_.loadAt(type, window(field), offset(entry));
  }
  void store(uint32_t field, ValueId entry, ValueId value) const {
    if (message_.capacity == 1)
      b_.store(fixed(field), value);
    else
      b_.storeAt(window(field), offset(entry), value);
  }

private:
  ir::Place fixed(uint32_t field) const { return {.space = space_, .byte = message_.table + kCountBytes + field}; }
  ir::Window window(uint32_t field) const {
    return {.space = space_,
            .byte = message_.table + kCountBytes + field,
            .count = (message_.capacity - 1) * kEntryBytes + 1};
  }
  ValueId offset(ValueId entry) const { return b_.mul(entry, b_.i32(static_cast<int32_t>(kEntryBytes))); }

  ir::RungBuilder& b_;
  ir::SpaceId space_;
  const BitMessage& message_;
};

} // namespace

void BitMessages::reserve(BitMessage& message) {
  ir::Module& module = emitter_.module();
  if (!space_.valid()) space_ = addSpace(module, {.name = "@EDEF", .flags = RUNG_SPACE_HIDDEN | RUNG_SPACE_ALLOCATED});
  const uint32_t bytes = kCountBytes + message.capacity * kEntryBytes;
  message.table = module.spaces[space_.index].units;
  module.spaces[space_.index].units += bytes;
  state_.nameCells("@" + instructionKey(program_, *message.statement, "EDEF"), {.space = space_, .byte = message.table},
                   Type::I8, bytes);
}

// Adds an entry. The bit is sampled now, so only later changes are edges.
void BitMessages::add(BitMessage message, ValueId number, ValueId subId) {
  reserve(message);
  ir::RungBuilder& b = emitter_.b();
  const Entries entries(b, space_, message);
  std::array<ValueId, 6> fields = {number, subId};
  for (size_t i = 0; i < message.places.size(); ++i) fields[2 + i] = message.places[i].index;
  const ValueId now = memory_.load(message.places[0], Type::Bit);
  const ValueId count = b.load(Type::I32, entries.count());
  ValueId fresh = b.eq(count, b.i32(0));
  if (message.capacity > 1) {
    const auto in = b.loop(message.capacity, std::array{b.bit(true)});
    ValueId same = b.ltU(in[0], count);
    for (size_t i = 0; i < fields.size(); ++i)
      if (fields[i].valid())
        same = b.and_(same, b.eq(entries.load(Type::I32, static_cast<uint32_t>(i) * 4, in[0]), fields[i]));
    fresh = b.endLoop(std::array{b.and_(in[1], b.not_(same))})[0];
    const ValueId full = b.leU(b.i32(static_cast<int32_t>(message.capacity)), count);
    b.trap(b.and_(fresh, full), emitter_.fault(nc::kTechnolEdef));
  }
  b.when(fresh, [&] {
    for (size_t i = 0; i < fields.size(); ++i)
      if (fields[i].valid()) entries.store(static_cast<uint32_t>(i) * 4, count, fields[i]);
    entries.store(kOldField, count, b.zextOrTrunc(Type::I8, now));
    b.store(entries.count(), b.add(count, b.i32(1)));
  });
  messages_.push_back(message);
}

void BitMessages::forget() {
  constexpr size_t kStoresPerRung = 64;
  for (size_t i = 0; i < messages_.size(); ++i) {
    if (i % kStoresPerRung == 0) emitter_.out().cut();
    emitter_.b().store({.space = space_, .byte = messages_[i].table}, emitter_.b().i32(0));
  }
}

namespace {

// Watches one bit; its edges show and remove the message.
class BitWatch {
public:
  BitWatch(Memory& memory, ir::SpaceId space, const BitMessage& message)
      : memory_(memory), b_(memory.emitter().b()), message_(message), entries_(b_, space, message) {}

  void watch() {
    const ValueId count = b_.load(Type::I32, entries_.count());
    const bool several = message_.capacity > 1;
    const ValueId entry = several ? b_.loop(message_.capacity)[0] : b_.i32(0);
    b_.when(b_.ltU(entry, count), [&] { look(entry); });
    if (several) b_.endLoop();
  }

private:
  void look(ValueId entry) {
    const ValueId bit = load(0, Type::Bit, entry);
    const ValueId now = b_.zextOrTrunc(Type::I8, bit);
    b_.when(b_.ne(now, entries_.load(Type::I8, kOldField, entry)), [&] {
      entries_.store(kOldField, entry, now);
      b_.when(bit, [&] { at(kRising, entry); }, [&] { at(kFalling, entry); });
    });
  }

  void at(uint32_t edge, ValueId entry) {
    const bool begins = (message_.mode & 3) == edge, ends = message_.mode >> 2 == edge;
    if (!begins && !ends) return;
    const MessageParts parts = partsAt(entry);
    const uint32_t marks = nc::technol::kByBit | (message_.mode >> 2 != kNever ? nc::technol::kPersistentWanted : 0);
    if (begins) send(b_, parts, RUNG_MESSAGE_SHOW_LOG, marks);
    if (ends) send(b_, parts, RUNG_MESSAGE_CLEAR, marks);
  }

  MessageParts partsAt(ValueId entry) {
    return {entries_.load(Type::I32, kNumberField, entry), entries_.load(Type::I32, kSubIdField, entry),
            valueOf(2, entry), bothPars(b_, valueOf(0, entry), valueOf(1, entry))};
  }

  // A parameter, with the current value of its cell.
  ValueId valueOf(size_t par, ValueId entry) {
    const Operand& operand = message_.pars[par];
    if (!operand.given()) return b_.i32(0);
    return b_.zextOrTrunc(Type::I32,
                          operand.isConstant() ? memory_.value(operand) : load(1 + par, operand.type, entry));
  }

  ValueId load(size_t at, Type type, ValueId entry) {
    MemoryAccess place = message_.places[at];
    if (place.indexed) place.index = entries_.load(Type::I32, kIndexField + static_cast<uint32_t>(at) * 4, entry);
    return memory_.load(place, type);
  }

  Memory& memory_;
  ir::RungBuilder& b_;
  const BitMessage& message_;
  Entries entries_;
};

} // namespace

ir::RoutineId BitMessages::makeTask(uint64_t& weight) {
  if (messages_.empty()) return {};
  const ir::RoutineId routine = emitter_.newRoutine("@EDEF");
  emitter_.open(routine);
  for (const BitMessage& message : messages_) {
    emitter_.out().cut();
    emitter_.out().statement(sourceOf(program_, *message.statement));
    BitWatch(memory_, space_, message).watch();
  }
  weight = emitter_.close();
  return routine;
}

} // namespace rung::frontend::technol
