// Bits that make messages (see bit_messages.h).
#include "frontend/dialects/technol/lower/bit_messages.h"

#include "frontend/dialects/technol/lower/message_parts.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/technol/services.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

constexpr uint32_t kCountBytes = 4;
// What an entry holds, by the byte where it begins in it. The index of a bit and of three values, where BX was added.
enum Field : uint32_t { kNumberField = 0, kSubIdField = 4, kIndexField = 8, kOldField = 24 };
constexpr uint32_t kEntryBytes = 28;
enum Edge : uint32_t { kNever, kRising, kFalling };

// Reaches the entries of one statement in the space @EDEF.
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

// The bit is sampled when it is tied: what comes later is an edge.
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

// Looks at one bit; its edges show and remove the message.
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

  // By reference: as the cell is now.
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
