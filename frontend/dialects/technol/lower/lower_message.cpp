// Messages: ESET, ESET1, EDEF (man. ch. 14.3).
#include "frontend/dialects/technol/lower/lower.h"
#include "frontend/dialects/technol/lower/lowering.h"

#include "rtlib/nc/faults.h"
#include "rtlib/nc/technol/messages.h"

namespace rung::frontend::technol {

using ir::Type;
using ir::ValueId;

namespace {

// As rtlib/nc/technol/messages.h joins them.
struct MessageParts {
  ValueId number; // i32
  ValueId subId, par3;
  ValueId pars; // par1 and above it par2
};

ValueId valueOr0(Lowering& l, const Operand& operand, Type type) {
  return operand.given() ? l.b().zextOrTrunc(type, l.value(operand)) : l.b().constant(type, 0);
}

MessageParts partsOf(Lowering& l, ValueId number, const Operand& subId, std::span<const Operand> pars) {
  ir::RungBuilder& b = l.b();
  const auto wide = [&](const Operand& par) { return b.zextOrTrunc(Type::I64, valueOr0(l, par, Type::I32)); };
  const ValueId low = wide(pars[0]);
  const ValueId high = b.op(ir::OpCode::Shl, Type::I64, {wide(pars[1]), b.i32(32)});
  return {number, valueOr0(l, subId, Type::I32), valueOr0(l, pars[2], Type::I32), b.or_(low, high)};
}

void send(ir::RungBuilder& b, const MessageParts& m, uint32_t op, uint32_t marks) {
  b.message(op, b.or_(m.number, b.i32(static_cast<int32_t>(marks))), m.par3, m.subId, m.pars);
}

// `set` 1 shows and 0 removes; without it the message is shown.
void showOrRemove(ir::RungBuilder& b, const MessageParts& m, ValueId set) {
  if (!set.valid()) return send(b, m, RUNG_MESSAGE_SHOW_LOG, 0);
  b.if_(set);
  send(b, m, RUNG_MESSAGE_SHOW_LOG, nc::technol::kPersistentWanted);
  b.else_();
  send(b, m, RUNG_MESSAGE_CLEAR, nc::technol::kPersistentWanted);
  b.endIf();
}

} // namespace

// ESET [error],[subid],[set],[par1],[par2],[par3]; the number is in DR where it is not given (man. l.5086-5130).
// _ON_ESET is called with the number in DR when a message comes up, not when one is removed (man. l.1609, l.5132).
void lowerMessage(Lowering& l, std::span<const Operand> o, int condition) {
  ir::RungBuilder& b = l.b();
  const ValueId word = o[0].given() ? b.zextOrTrunc(Type::I16, l.value(o[0])) : l.r().dr(Type::I16);
  const ValueId number = b.zextOrTrunc(Type::I32, word);
  ValueId set;
  if (o[2].given()) {
    const ValueId value = valueOr0(l, o[2], Type::I32);
    set = b.ne(value, b.i32(0));
  }
  const MessageParts message = partsOf(l, number, o[1], o.subspan(3, 3));
  const ValueId rlo = condition == kIfRlo ? l.r().rlo() : ValueId{};
  const bool calls = l.onMessage() != kNone && l.currentProcedure() != l.onMessage();
  const ValueId comesUp = !set.valid() ? rlo : !rlo.valid() ? set : b.and_(rlo, set);
  if (calls) l.saveRegisters();
  if (rlo.valid()) b.if_(rlo);
  showOrRemove(b, message, set);
  if (rlo.valid()) b.endIf();
  if (!calls) return;
  l.r().setDr(b.zextOrTrunc(Type::I64, number));
  l.callProcedure(l.onMessage(), comesUp);
  l.restoreRegisters();
}

// ---- EDEF -----------------------------------------------------------------------------------------------------------

namespace {

constexpr uint32_t kCountBytes = 4;
// What an entry holds, by the byte where it begins in it. The index of a bit and of three values, where BX was added.
enum Field : uint32_t { kNumberField = 0, kSubIdField = 4, kIndexField = 8, kOldField = 24 };
constexpr uint32_t kEntryBytes = 28;
constexpr uint32_t kMostEntries = 64; // of one statement
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

// EDEF [val],bit,error,[subid],mod,[par1],[par2],[par3] (man. l.5192-5260). Carried out again it is the same message
// while number and addresses are the same, else one more.
void lowerBitMessage(Lowering& l, std::span<const Operand> o, int) {
  BitMessage message;
  message.statement = &l.statement();
  message.mode = static_cast<uint32_t>(o[4].value);
  message.bit = o[1];
  if (o[0].given()) {
    message.bit = o[0];
    message.bit.form = Operand::Form::Bit;
    message.bit.type = Type::Bit;
    message.bit.place.bit = o[1].place.bit;
  }
  bool varies = !o[2].isConstant() || (o[3].given() && !o[3].isConstant()) || message.bit.indexed;
  for (size_t i = 0; i < message.pars.size(); ++i) {
    message.pars[i] = o[5 + i];
    varies = varies || o[5 + i].indexed;
  }
  message.capacity = varies ? kMostEntries : 1;
  const ValueId word = l.b().zextOrTrunc(Type::I16, l.value(o[2]));
  l.addBitMessage(message, l.b().zextOrTrunc(Type::I32, word), valueOr0(l, o[3], Type::I32));
}

// The bit is sampled when it is tied: what comes later is an edge.
void Lowering::addBitMessage(BitMessage message, ValueId number, ValueId subId) {
  if (!bitMessageSpace_.valid()) {
    bitMessageSpace_ = {static_cast<uint32_t>(module_.spaces.size())};
    module_.spaces.push_back(
        {.name = "@EDEF", .unitBytes = 1, .units = 0, .flags = RUNG_SPACE_HIDDEN | RUNG_SPACE_ALLOCATED});
  }
  uint32_t& bytes = module_.spaces[bitMessageSpace_.index].units;
  const uint32_t tableBytes = kCountBytes + message.capacity * kEntryBytes;
  message.table = bytes;
  bytes += tableBytes;
  nameCells("@" + instructionKey("EDEF"), bitMessageSpace_, message.table, Type::I8, tableBytes);

  ir::RungBuilder& builder = b();
  const Entries entries(builder, bitMessageSpace_, message);
  std::array<ValueId, 6> fields = {number, subId};
  const auto index = [&](const Operand& operand, size_t at) {
    const Access access = operand.indexed ? reach(operand) : Access{};
    message.windows[at] = access.window;
    fields[2 + at] = access.indexed ? access.index : ValueId{};
    return access;
  };
  const Access bitAccess = index(message.bit, 0);
  for (size_t i = 0; i < message.pars.size(); ++i) index(message.pars[i], 1 + i);
  const ValueId now = message.bit.indexed ? load(bitAccess, Type::Bit) : builder.load(Type::Bit, message.bit.place);
  const ValueId count = builder.load(Type::I32, entries.count());
  ValueId fresh = builder.eq(count, builder.i32(0));
  if (message.capacity > 1) {
    const auto in = builder.loop(message.capacity, std::array{builder.bit(true)});
    ValueId same = builder.ltU(in[0], count);
    for (size_t i = 0; i < fields.size(); ++i)
      if (fields[i].valid())
        same = builder.and_(same, builder.eq(entries.load(Type::I32, static_cast<uint32_t>(i) * 4, in[0]), fields[i]));
    fresh = builder.endLoop(std::array{builder.and_(in[1], builder.not_(same))})[0];
    const ValueId full = builder.leU(builder.i32(static_cast<int32_t>(message.capacity)), count);
    builder.trap(builder.and_(fresh, full), fault(nc::kTechnolEdef));
  }
  builder.if_(fresh);
  for (size_t i = 0; i < fields.size(); ++i)
    if (fields[i].valid()) entries.store(static_cast<uint32_t>(i) * 4, count, fields[i]);
  entries.store(kOldField, count, builder.zextOrTrunc(Type::I8, now));
  builder.store(entries.count(), builder.add(count, builder.i32(1)));
  builder.endIf();
  bitMessages_.push_back(message);
}

// At each start the bits are tied anew.
void Lowering::forgetBitMessages() {
  constexpr size_t kStoresPerRung = 64;
  for (size_t i = 0; i < bitMessages_.size(); ++i) {
    if (i % kStoresPerRung == 0) out_->cut();
    b().store({.space = bitMessageSpace_, .byte = bitMessages_[i].table}, b().i32(0));
  }
}

namespace {

// Looks at one bit; its edges show and remove the message.
class BitWatch {
public:
  BitWatch(ir::RungBuilder& b, ir::SpaceId space, const BitMessage& message)
      : b_(b), message_(message), entries_(b, space, message) {}

  void watch() {
    const ValueId count = b_.load(Type::I32, entries_.count());
    const bool several = message_.capacity > 1;
    const ValueId entry = several ? b_.loop(message_.capacity)[0] : b_.i32(0);
    b_.if_(b_.ltU(entry, count));
    look(entry);
    b_.endIf();
    if (several) b_.endLoop();
  }

private:
  void look(ValueId entry) {
    const Operand& operand = message_.bit;
    const ValueId bit = operand.indexed ? b_.loadBitAt(message_.windows[0], indexOf(entry, 0),
                                                       b_.i32(static_cast<int32_t>(operand.place.bit)))
                                        : b_.load(Type::Bit, operand.place);
    const ValueId now = b_.zextOrTrunc(Type::I8, bit);
    b_.if_(b_.ne(now, entries_.load(Type::I8, kOldField, entry)));
    entries_.store(kOldField, entry, now);
    b_.if_(bit);
    at(kRising, entry);
    b_.else_();
    at(kFalling, entry);
    b_.endIf();
    b_.endIf();
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
    const auto wide = [&](size_t par) { return b_.zextOrTrunc(Type::I64, valueOf(par, entry)); };
    const ValueId high = b_.op(ir::OpCode::Shl, Type::I64, {wide(1), b_.i32(32)});
    return {entries_.load(Type::I32, kNumberField, entry), entries_.load(Type::I32, kSubIdField, entry),
            valueOf(2, entry), b_.or_(wide(0), high)};
  }

  // By reference: as the cell is now.
  ValueId valueOf(size_t par, ValueId entry) {
    const Operand& operand = message_.pars[par];
    if (!operand.given()) return b_.i32(0);
    const ValueId value = operand.isConstant() ? b_.constant(operand.type, operand.value)
                          : operand.indexed
                              ? b_.loadAt(operand.type, message_.windows[1 + par], indexOf(entry, 1 + par))
                              : b_.load(operand.type, operand.place);
    return b_.zextOrTrunc(Type::I32, value);
  }

  ValueId indexOf(ValueId entry, size_t at) {
    return entries_.load(Type::I32, kIndexField + static_cast<uint32_t>(at) * 4, entry);
  }

  ir::RungBuilder& b_;
  const BitMessage& message_;
  Entries entries_;
};

} // namespace

void Lowering::makeBitMessages() {
  if (bitMessages_.empty()) return;
  bitMessageTask_.routine = newRoutine("@EDEF");
  out_ = newBuilder(bitMessageTask_.routine);
  for (const BitMessage& message : bitMessages_) {
    out_->cut();
    out_->statement(sourceOf(*message.statement));
    BitWatch(b(), bitMessageSpace_, message).watch();
  }
  out_->finish();
  bitMessageTask_.weight = out_->weight();
}

} // namespace rung::frontend::technol
