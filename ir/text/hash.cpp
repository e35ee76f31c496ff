// The hash of a module (see text.h) over everything that its text shows, without making the text. Structs are
// decomposed into all of their members, so that an added member cannot be forgotten here.
#include <concepts>

#include "ir/support/hash.h"
#include "ir/text/text.h"

namespace rung::ir {
namespace {

class Hasher {
public:
  uint64_t of(const Module& module) {
    const auto& [name, dialect, files, spaces, slots, continuations, timers, symbols, inits, retains, safeSpans, faults,
                 services, messages, routines, tasks, mainTask, fastTask, scan, fast, slices, instrumented] = module;
    all(name, dialect, files, spaces, slots, continuations, timers, symbols, inits, retains, safeSpans, faults,
        services, messages, routines, tasks, mainTask, fastTask, scan, fast, slices, instrumented);
    return hash_;
  }

private:
  template <class... Parts>
  void all(const Parts&... parts) {
    (add(parts), ...);
  }
  void number(uint64_t number) { hash_ = hashNumber(number, hash_); }

  template <std::integral Number>
  void add(Number value) {
    number(static_cast<uint64_t>(value));
  }
  template <class Tag>
  void add(Id<Tag> id) {
    number(id.index);
  }
  void add(const std::string& text) { hash_ = hashText(text, hash_); }
  template <class Item>
  void add(const std::vector<Item>& items) {
    number(items.size());
    for (const Item& item : items) add(item);
  }

  // ---- declarations

  void add(const Space& space) {
    const auto& [name, unitBytes, units, flags, packedOnly] = space;
    all(name, unitBytes, units, flags, packedOnly);
  }
  void add(const Slot& slot) {
    const auto& [type, init, transient, key] = slot;
    all(static_cast<uint32_t>(type), init, transient, key);
  }
  void add(const Continuation& continuation) {
    const auto& [key, slot, space, byte, points] = continuation;
    all(key, slot, points);
    if (!slot.valid()) all(space, byte);
  }
  void add(const TimerCell& cell) {
    const auto& [type, slot, space, byte] = cell;
    number(static_cast<uint32_t>(type));
    if (type == Type::None) return;
    add(slot);
    if (!slot.valid()) all(space, byte);
  }
  void add(const Timer& timer) {
    const auto& [name, flags, time, timeUs, running, preset, constant, unit, unitsUs] = timer;
    all(name, flags, time, timeUs, running, preset, constant, unit, unitsUs);
  }
  void add(const Symbol& symbol) {
    const auto& [name, comment, space, byte, bit, type, count, flags, value] = symbol;
    all(name, comment, space, byte, bit, type, count, flags, value);
  }
  void add(const SpaceSpan& span) {
    const auto& [space, byte, size] = span;
    all(space, byte, size);
  }
  void add(const Copy& copy) {
    const auto& [masked, from, to, toByte, mask, maskByte] = copy;
    all(masked, from, to, toByte, mask, maskByte);
  }
  void add(const Init& init) {
    const auto& [space, byte, data] = init;
    all(space, byte, data);
  }
  void add(const Task& task) {
    const auto& [name, entry, periodUs, budget, budgetFault, begin, end, parts, borders] = task;
    all(name, entry, periodUs, budget, budgetFault, begin, end, parts, borders);
  }
  void add(const Step& step) {
    const auto& [op, task, arg] = step;
    all(op, task, arg);
  }
  void add(const MessageText& message) {
    const auto& [number, text] = message;
    all(number, text);
  }

  // ---- rungs

  void add(const Routine& routine) {
    const auto& [name, rungs] = routine;
    all(name, rungs);
  }
  void add(const Rung& rung) {
    const auto& [number, title, sourceText, begin, lastLine, key, copy, weight, constantBits, ops, args, values, notes,
                 transfer, transferLine, origin] = rung;
    all(number, title, sourceText, begin, lastLine, key, copy, weight, constantBits, ops, args, values, notes, transfer,
        transferLine, origin);
  }
  void add(const SpaceBit& read) {
    const auto& [space, bit] = read;
    all(space, bit);
  }
  void add(const Location& location) {
    const auto& [file, line, column] = location;
    all(file, line, column);
  }
  void add(const Origin& origin) {
    const auto& [routine, index] = origin;
    add(index);
    if (index != RUNG_NONE) add(routine);
  }
  void add(const Transfer& transfer) {
    const auto& [kind, cond, value, target, callee, targets] = transfer;
    all(static_cast<uint32_t>(kind), cond, value, target, callee, targets);
  }

  // Most of a module is operations. Their operands and results follow those of the operation before, and the number of
  // results is determined by the row and the operands.
  void add(const Op& op) {
    const auto& [code, type, argCount, resultCount, firstArg, result, ref, count, imm, line] = op;
    number(uint64_t{line} << 32 | uint64_t{argCount} << 16 | static_cast<uint64_t>(code) << 8 |
           static_cast<uint64_t>(type));
    number(uint64_t{ref} << 32 | count);
    number(static_cast<uint64_t>(imm));
  }
  void add(const std::vector<ValueId>& values) {
    number(values.size());
    for (size_t i = 0; i + 1 < values.size(); i += 2) number(uint64_t{values[i].index} << 32 | values[i + 1].index);
    if (values.size() % 2 != 0) number(values.back().index);
  }
  void add(const std::vector<Type>& types) { bytes(types); }
  void add(const std::vector<uint8_t>& data) { bytes(data); }
  template <class Byte>
  void bytes(const std::vector<Byte>& bytes) {
    static_assert(sizeof(Byte) == 1);
    hash_ = hashText({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, hash_);
  }

  uint64_t hash_ = kHashSeed;
};

} // namespace

uint64_t hashOf(const Module& module) { return Hasher().of(module); }

} // namespace rung::ir
