// Random operations (see random_rung.h).
#include "tests/random/random_rung.h"

#include <algorithm>

#include "ir/core/eval.h"
#include "ir/core/op_info.h"

namespace rung::ir {
namespace {

constexpr uint32_t kMaxDepth = 3;
constexpr uint32_t kFirstHidden =
    6; // spaces from here on belong to copies: read and written like the others, but rarely

} // namespace

void RandomRung::fill() {
  for (uint32_t n = random_.between(1, options_.ops); n > 0; --n) addOp(0);
  if (options_.known && random_.chance(50)) addKnownIf();
  // What was computed shows in memory.
  for (uint32_t n = random_.between(1, 4); n > 0 && !visible_.empty(); --n) {
    const ValueId id = random_.pick(visible_);
    builder_.store(place(builder_.typeOf(id)), id);
  }
}

void RandomRung::addOp(uint32_t depth) {
  const uint32_t dice = random_.below(100);
  if (random_.chance(10)) builder_.setLine(builder_.rung().begin.line + random_.below(5));
  if (dice < 50)
    addPlain();
  else if (dice < 75)
    addAccess();
  else if (dice < 87)
    addSlotAccess();
  else if (dice < 90)
    addHost();
  else if (dice < 92)
    addIndexed();
  else if (options_.regions && depth < kMaxDepth)
    addRegion(depth);
}

ValueId RandomRung::constant(Type type) {
  const uint64_t bits = random_.chance(70) ? random_.pick(boundaryValues(type)) : random_.next() & valueMask(type);
  return builder_.constant(type, static_cast<int64_t>(bits));
}

ValueId RandomRung::value(Type type) {
  // Recent values first, so that chains grow.
  for (uint32_t tries = 0; tries < 6 && !visible_.empty(); ++tries) {
    const auto count = static_cast<uint32_t>(visible_.size());
    const ValueId id = visible_[count - 1 - random_.below(random_.chance(50) ? std::min(count, 6u) : count)];
    if (builder_.typeOf(id) == type) return id;
  }
  if (random_.chance(40)) return constant(type);
  const ValueId id = builder_.load(type, place(type));
  remember(id);
  return id;
}

Type RandomRung::someType(TypeSet set) {
  if (!options_.floats) set = static_cast<TypeSet>(set & ~kFloat);
  for (;;) {
    const Type type = static_cast<Type>(random_.below(kTypeCount));
    if (contains(set, type)) return type;
    if ((set & kAllTypes) == 0) return Type::None;
  }
}

Type RandomRung::operandType(Constraint constraint, Type own) {
  TypeSet set = 0;
  for (Type type : {Type::Bit, Type::I8, Type::I16, Type::I32, Type::I64, Type::F64})
    if (satisfies(constraint, own, type)) set = static_cast<TypeSet>(set | setOf(type));
  return set == 0 || (!options_.floats && set == kFloat) ? Type::None : someType(set);
}

// Places lie close together, at any alignment; in the spaces X and Y there are only bits.
Place RandomRung::place(Type type) {
  const bool bit = type == Type::Bit;
  const uint32_t first = bit ? 0 : 2;
  const auto spaces = static_cast<uint32_t>(builder_.module().spaces.size());
  const SpaceId space{random_.chance(80) ? random_.between(first, kFirstHidden - 1)
                                         : random_.between(std::max(first, kFirstHidden - 1), spaces - 1)};
  const uint32_t bytes = std::max(1u, byteWidth(type));
  const Space& chosen = builder_.module().at(space);
  const uint32_t last = chosen.units * chosen.unitBytes - bytes;
  uint32_t byte = random_.chance(70) ? random_.below(std::min(last + 1, 12u)) : random_.below(last + 1);
  if (random_.chance(50)) byte -= byte % bytes;
  return {space, byte, bit ? random_.below(8) : 0};
}

Window RandomRung::window(Type type) {
  const SpaceId space{random_.between(2, kFirstHidden - 1)};
  const Space& chosen = builder_.module().at(space);
  const uint32_t bytes = type == Type::Bit ? chosen.unitBytes : byteWidth(type);
  const uint32_t count = random_.between(1, 5);
  const uint32_t last = chosen.units * chosen.unitBytes - bytes - (count - 1) * chosen.unitBytes;
  return {space, random_.chance(60) ? random_.below(std::min(last + 1, 8u)) : random_.below(last + 1), count};
}

// Nearly a whole space.
Window RandomRung::wideWindow(Type type) {
  const SpaceId space{random_.between(2, kFirstHidden - 1)};
  const Space& chosen = builder_.module().at(space);
  const uint32_t bytes = type == Type::Bit ? chosen.unitBytes : byteWidth(type);
  const uint32_t room = chosen.units * chosen.unitBytes - bytes;
  const uint32_t begin = random_.below(std::min(room + 1, 8u));
  return {space, begin, (room - begin) / chosen.unitBytes + 1};
}

// An operation without an attribute or a region, by its row alone.
void RandomRung::addPlain() {
  const OpInfo& info = random_.pick(allOps());
  if (info.attr != Attr::None || !isPure(info)) return;
  const Type type = someType(info.types);
  if (type == Type::None) return;
  ValueId args[4];
  int count = 0;
  for (Constraint constraint : info.operands) {
    if (constraint == Constraint::None) break;
    const Type wanted = operandType(constraint, type);
    if (wanted == Type::None) return;
    // Counts near the width are the interesting ones.
    if (constraint == Constraint::I32 && random_.chance(50))
      args[count++] = builder_.i32(static_cast<int64_t>(random_.pick(boundaryCounts())));
    else
      args[count++] = value(wanted);
  }
  switch (count) {
  case 0: remember(builder_.op(info.code, type, {})); break;
  case 1: remember(builder_.op(info.code, type, {args[0]})); break;
  case 2: remember(builder_.op(info.code, type, {args[0], args[1]})); break;
  default: remember(builder_.op(info.code, type, {args[0], args[1], args[2]})); break;
  }
}

void RandomRung::addAccess() {
  const uint32_t dice = random_.below(10);
  const Type type = someType(kAllTypes);
  if (dice < 4) return remember(builder_.load(type, place(type)));
  if (dice < 7) {
    const ValueId stored = value(type);
    return builder_.store(place(type), stored);
  }
  ValueId index = value(Type::I32);
  if (random_.chance(75)) index = builder_.and_(index, builder_.i32(7));
  const bool load = dice < 9;
  if (type == Type::Bit) {
    ValueId bit = value(Type::I32);
    if (random_.chance(75)) bit = builder_.and_(bit, builder_.i32(63));
    const ValueId stored = value(Type::Bit);
    if (load)
      remember(builder_.loadBitAt(window(type), index, bit));
    else
      builder_.storeBitAt(window(type), index, bit, stored);
    return;
  }
  const ValueId stored = value(type);
  if (load)
    remember(builder_.loadAt(type, window(type), index));
  else
    builder_.storeAt(window(type), index, stored);
}

// As programs do it: a number is put into a cell, or several places are accessed by the number there, each with a
// comparison with the window's end.
void RandomRung::addIndexed() {
  constexpr SpaceId kWords{4};
  const Place at{.space = kWords, .byte = 4 * random_.below(2)};
  if (random_.chance(30)) return builder_.store(at, builder_.i32(random_.below(4)));
  const ValueId cell = builder_.load(Type::I32, random_.chance(80) ? at : place(Type::I32));
  for (uint32_t n = random_.between(1, 4); n > 0; --n) {
    const Type type = someType(kAllTypes);
    const Window all = wideWindow(type);
    const ValueId index = builder_.add(cell, builder_.i32(int64_t{random_.below(8)} - 2));
    const ValueId inside = builder_.ltU(index, builder_.i32(all.count));
    remember(inside);
    const ValueId stored = value(type);
    if (type == Type::Bit) {
      const ValueId bit = random_.chance(50) ? cell : builder_.i32(random_.below(8));
      remember(builder_.and_(inside, builder_.loadBitAt(all, index, bit)));
      builder_.storeBitAt(all, index, bit, stored);
    } else {
      remember(builder_.loadAt(type, all, index));
      builder_.storeAt(all, index, stored);
    }
  }
}

void RandomRung::addSlotAccess() {
  const SlotId slot = random_.pick(slots_);
  if (random_.chance(50)) return remember(builder_.slotLoad(slot));
  const ValueId stored = value(builder_.module().at(slot).type);
  builder_.slotStore(slot, stored);
}

void RandomRung::addHost() {
  if (random_.chance(20)) return builder_.note("a remark");
  if (options_.traps && random_.chance(10)) {
    // Seldom true.
    const ValueId x = value(Type::I16);
    const FaultId fault{random_.between(1, 2)};
    return builder_.trap(builder_.eq(x, builder_.constant(Type::I16, 0x7FFF)), fault);
  }
  if (!options_.host) return;
  switch (random_.below(4)) {
  case 0: {
    const ValueId number = value(Type::I32);
    const ValueId channel = value(Type::I32);
    const ValueId index = value(Type::I32);
    const ValueId shown = value(options_.floats && random_.chance(50) ? Type::F64 : Type::I64);
    return builder_.message(random_.below(RUNG_MESSAGE_LOG + 1), number, channel, index, shown);
  }
  case 1: {
    std::vector<ValueId> args;
    for (uint32_t n = random_.below(4); n > 0; --n) args.push_back(value(Type::I64));
    return remember(builder_.serviceRequest(ServiceId{random_.below(2)}, args));
  }
  case 2: {
    const ValueId ticket = value(Type::I32);
    return remember(builder_.servicePoll(ticket));
  }
  default: {
    const ValueId ticket = value(Type::I32);
    return remember(builder_.serviceResult(ticket, random_.below(3)));
  }
  }
}

void RandomRung::addRegion(uint32_t depth) {
  if (random_.chance(65))
    addIf(depth);
  else
    addLoop(depth);
}

void RandomRung::addIf(uint32_t depth) {
  std::vector<Type> types;
  const bool hasElse = random_.chance(60);
  if (hasElse)
    for (uint32_t n = random_.below(3); n > 0; --n) types.push_back(someType(kAllTypes));
  const auto yield = [&] {
    std::vector<ValueId> yields;
    const size_t outside = visible_.size();
    for (uint32_t n = random_.below(5); n > 0; --n) addOp(depth + 1);
    for (Type type : types) yields.push_back(value(type));
    visible_.resize(outside);
    return yields;
  };
  builder_.if_(value(Type::Bit));
  const std::vector<ValueId> first = yield();
  if (hasElse) {
    builder_.else_(first);
    for (ValueId id : builder_.endIf(yield())) remember(id);
  } else {
    builder_.endIf();
  }
}

ValueId RandomRung::known() {
  const Place cell{.space = kKnownSpace, .byte = 0, .bit = random_.below(kKnownCells)};
  const ValueId any = value(Type::Bit);
  builder_.store(cell, builder_.and_(any, builder_.not_(any)));
  return builder_.load(Type::Bit, cell);
}

void RandomRung::addKnownIf() {
  const size_t outside = visible_.size();
  builder_.if_(known());
  for (uint32_t n = random_.between(1, 6); n > 0; --n) addAccess();
  visible_.resize(outside);
  builder_.endIf();
}

void RandomRung::addLoop(uint32_t depth) {
  std::vector<ValueId> carried;
  for (uint32_t n = random_.below(3); n > 0; --n) carried.push_back(value(someType(kAllTypes)));
  const std::vector<ValueId> begin = builder_.loop(random_.below(4), carried);
  const size_t outside = visible_.size();
  for (ValueId id : begin) remember(id);
  for (uint32_t n = random_.below(5); n > 0; --n) addOp(depth + 1);
  std::vector<ValueId> next;
  // Carried values may change places.
  for (size_t i = 1; i < begin.size(); ++i) next.push_back(value(builder_.typeOf(begin[i])));
  visible_.resize(outside);
  for (ValueId id : builder_.endLoop(next)) remember(id);
}

} // namespace rung::ir
