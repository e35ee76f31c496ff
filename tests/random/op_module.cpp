// A module for each operation (see random.h).
#include <fmt/format.h>

#include "ir/core/builder.h"
#include "ir/core/eval.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "tests/random/random.h"

namespace rung::ir {
namespace {

constexpr SpaceId kIn{0};         // the operands, as initial values
constexpr SpaceId kOut{1};        // results that are no bits
constexpr SpaceId kFlags{2};      // results that are bits: expanded by the layout
constexpr SpaceId kFirstTable{3}; // spaces with units of 1, 2, 4, 8 bytes, for computed indices
constexpr uint32_t kTableUnits = 12;
constexpr uint32_t kMaxPairs = 14; // of f64 operands

constexpr Type kTypes[] = {Type::Bit, Type::I8, Type::I16, Type::I32, Type::I64, Type::F64};

class OpModule {
public:
  explicit OpModule(OpCode code) : code_(code), info_(opInfo(code)) {
    module_.name = fmt::format("operation {}", info_.name);
    module_.dialect = "operations";
    module_.files = {"operations.rir"};
    module_.faults = {"budget", "stopped"};
    module_.services = {"WORK"};
    const auto add = [&](std::string name, uint32_t unit, uint32_t units) {
      module_.spaces.push_back({.name = std::move(name), .unitBytes = unit, .units = units});
    };
    add("IN", 1, 0);
    add("OUT", 1, 0);
    add("FLAGS", 1, 0);
    for (uint32_t unit = 1; unit <= 8; unit *= 2) add(fmt::format("T{}", unit), unit, kTableUnits);
    module_.routines.push_back({.name = "MAIN", .rungs = {}});
  }

  Module run() {
    fill();
    finish();
    return std::move(module_);
  }

private:
  void fill() {
    if (isEvaluable(info_)) return eachType([&](Type type) { evaluable(type); });
    switch (code_) {
    case OpCode::Const: return eachType([&](Type type) { constants(type); });
    case OpCode::Load: return eachType([&](Type type) { loads(type); });
    case OpCode::Store: return eachType([&](Type type) { stores(type); });
    case OpCode::LoadAt:
    case OpCode::StoreAt: return eachType([&](Type type) { dynamic(type); });
    case OpCode::LoadBitAt:
    case OpCode::StoreBitAt: return dynamicBits();
    case OpCode::SlotLoad:
    case OpCode::SlotStore: return eachType([&](Type type) { slots(type); });
    case OpCode::Now: return inRung([&](RungBuilder& b) { result(b, b.now()); });
    case OpCode::If:
    case OpCode::Else:
    case OpCode::EndIf: return ifs();
    case OpCode::Loop:
    case OpCode::EndLoop: return loops();
    case OpCode::Message: return messages();
    case OpCode::ServiceRequest:
    case OpCode::ServicePoll:
    case OpCode::ServiceResult: return services();
    case OpCode::Trap: return traps();
    case OpCode::Note: return inRung([&](RungBuilder& b) { b.note("a remark"), result(b, b.i32(1)); });
    case OpCode::ProfEnter:
    case OpCode::ProfLeave: return profile();
#define RUNG_OP(...)
#define RUNG_VALUE_OP(code, ...) case OpCode::code:
#include "ir/core/ops.def"
      break; // see above
    }
  }

  template <class Visit>
  void eachType(Visit visit) {
    for (Type type : kTypes)
      if (contains(info_.types, type)) visit(type);
  }
  template <class Fill>
  void inRung(Fill fillRung) {
    Rung rung;
    rung.begin = {.file = FileIndex{0}, .line = static_cast<uint32_t>(module_.routines[0].rungs.size() + 1)};
    rung.lastLine = rung.begin.line;
    rung.key = rung.begin.line;
    RungBuilder builder(module_, rung);
    fillRung(builder);
    module_.routines[0].rungs.push_back(std::move(rung));
  }

  // ---- operands and results ----------------------------------------------------------------------------------------

  // A value from memory, so that nothing can be folded.
  ValueId operand(RungBuilder& b, Type type, uint64_t value) {
    const uint32_t byte = module_.spaces[kIn.index].units;
    if (type == Type::Bit) {
      addInput(value << 3, 1);
      return b.load(type, {kIn, byte, 3});
    }
    addInput(value, byteWidth(type));
    return b.load(type, {kIn, byte});
  }
  void addInput(uint64_t value, uint32_t bytes) {
    for (uint32_t i = 0; i < bytes; ++i) input_.push_back(static_cast<uint8_t>(value >> (8 * i)));
    module_.spaces[kIn.index].units += bytes;
  }
  std::vector<ValueId> operands(RungBuilder& b, Type type, std::span<const uint64_t> values) {
    std::vector<ValueId> ids;
    for (uint64_t value : values) ids.push_back(operand(b, type, value));
    return ids;
  }
  ValueId input(RungBuilder& b, Type type) { return operand(b, type, boundaryValues(type).back()); }

  // A place of its own for a result.
  Place newPlace(Type type) {
    if (type == Type::Bit) {
      const uint32_t bit = flags_++;
      module_.spaces[kFlags.index].units = bit / 8 + 1;
      return {kFlags, bit / 8, bit % 8};
    }
    const uint32_t byte = module_.spaces[kOut.index].units;
    module_.spaces[kOut.index].units += byteWidth(type);
    return {kOut, byte};
  }
  void result(RungBuilder& b, ValueId id) { b.store(newPlace(b.typeOf(id)), id); }

  // ---- operations without effects ----------------------------------------------------------------------------------

  void evaluable(Type type) {
    if (info_.code == OpCode::Select) return inRung([&](RungBuilder& b) { selects(b, type); });
    for (Type first : kTypes) {
      if (!satisfies(info_.operands[0], type, first)) continue;
      inRung([&](RungBuilder& b) {
        if (info_.fixed == 1)
          unary(b, type, first);
        else
          binary(b, type, first);
      });
    }
  }

  void unary(RungBuilder& b, Type type, Type first) {
    for (ValueId a : operands(b, first, boundaryValues(first))) result(b, b.op(code_, type, {a}));
  }

  void binary(RungBuilder& b, Type type, Type first) {
    const bool counts = info_.operands[1] == Constraint::I32;
    std::span<const uint64_t> left = boundaryValues(first);
    std::span<const uint64_t> right = counts ? boundaryCounts() : left;
    const std::vector<ValueId> as = operands(b, first, left);
    const std::vector<ValueId> bs = operands(b, counts ? Type::I32 : first, right);
    // Of the many pairs of f64, each value with itself and with the rarest ones.
    for (size_t i = 0; i < as.size(); ++i)
      for (size_t k = 0; k < bs.size(); ++k)
        if (first != Type::F64 || i == k || (i * as.size() + k) % kMaxPairs < 4)
          result(b, b.op(code_, type, {as[i], bs[k]}));
  }

  void selects(RungBuilder& b, Type type) {
    const std::vector<ValueId> conds = operands(b, Type::Bit, boundaryValues(Type::Bit));
    const std::vector<ValueId> values = operands(b, type, boundaryValues(type));
    for (ValueId cond : conds)
      for (size_t i = 0; i < values.size(); ++i) result(b, b.select(cond, values[i], values[(i + 1) % values.size()]));
  }

  void constants(Type type) {
    inRung([&](RungBuilder& b) {
      for (uint64_t value : boundaryValues(type)) result(b, b.constant(type, static_cast<int64_t>(value)));
    });
  }

  // ---- memory ------------------------------------------------------------------------------------------------------

  void loads(Type type) {
    inRung([&](RungBuilder& b) {
      for (ValueId id : operands(b, type, boundaryValues(type))) result(b, id);
      if (type == Type::Bit) { // from bytes of their own
        const Place flag = newPlace(Type::Bit);
        b.store(flag, input(b, Type::Bit));
        result(b, b.load(Type::Bit, flag));
      }
    });
  }

  // Beside and over one another.
  void stores(Type type) {
    inRung([&](RungBuilder& b) {
      for (ValueId id : operands(b, type, boundaryValues(type))) result(b, id);
      if (type == Type::Bit) {
        for (uint32_t bit = 0; bit < 8; bit += 3) b.store({kFirstTable, 0, bit}, input(b, type));
        b.store({kFirstTable, 1, 5}, operand(b, type, 0));
        return;
      }
      b.store({kFirstTable, 1}, input(b, type));
      b.store({kFirstTable, 3}, operand(b, type, 0));
    });
    // What is stored over: all ones.
    if (module_.inits.empty())
      module_.inits.push_back({.space = kFirstTable, .byte = 0, .data = std::vector<uint8_t>(kTableUnits, 0xFF)});
  }

  // Windows in spaces of every unit, element 0 not at the beginning; the last legal index and those beyond.
  template <class Visit>
  void eachWindow(uint32_t bytes, Visit visit) {
    for (uint32_t i = 0; i < 4; ++i) {
      const uint32_t unit = 1u << i;
      const uint32_t count = kTableUnits - 2 - (bytes > unit ? (bytes - 1) / unit : 0);
      visit(Window{SpaceId{kFirstTable.index + i}, unit, count}, count);
    }
    if (!module_.inits.empty()) return;
    for (uint32_t i = 0; i < 4; ++i) {
      Init init{.space = SpaceId{kFirstTable.index + i}, .byte = 0, .data = {}};
      for (uint32_t k = 0; k < kTableUnits << i; ++k) init.data.push_back(static_cast<uint8_t>(k * 37 + 129));
      module_.inits.push_back(std::move(init));
    }
  }

  void dynamic(Type type) {
    eachWindow(byteWidth(type), [&](Window window, uint32_t count) {
      inRung([&](RungBuilder& b) {
        for (uint64_t index : {uint64_t{0}, uint64_t{1}, uint64_t{count} - 1, uint64_t{count}, uint64_t{0x80000000},
                               uint64_t{0xFFFFFFFF}}) {
          const ValueId i = operand(b, Type::I32, index);
          if (code_ == OpCode::LoadAt)
            result(b, b.loadAt(type, window, i));
          else
            b.storeAt(window, i, operand(b, type, boundaryValues(type)[index % 3 + 1]));
        }
      });
    });
  }

  void dynamicBits() {
    eachWindow(1, [&](Window window, uint32_t count) {
      inRung([&](RungBuilder& b) {
        const std::vector<ValueId> bits = operands(b, Type::I32, boundaryCounts());
        for (uint64_t index : {uint64_t{0}, uint64_t{count} - 1, uint64_t{count}, uint64_t{0xFFFFFFFF}}) {
          const ValueId i = operand(b, Type::I32, index);
          for (size_t k = 0; k < bits.size(); ++k) {
            if (code_ == OpCode::LoadBitAt)
              result(b, b.loadBitAt(window, i, bits[k]));
            else
              b.storeBitAt(window, i, bits[k], operand(b, Type::Bit, k % 2));
          }
        }
      });
    });
  }

  void slots(Type type) {
    const auto first = static_cast<uint32_t>(module_.slots.size());
    for (uint64_t value : boundaryValues(type)) {
      const bool odd = module_.slots.size() % 2 != 0;
      module_.slots.push_back({.type = type,
                               .init = odd ? static_cast<int64_t>(value) : 0,
                               .key = fmt::format("slot {}", module_.slots.size())});
    }
    inRung([&](RungBuilder& b) {
      uint32_t slot = first;
      for (ValueId id : operands(b, type, boundaryValues(type))) {
        result(b, b.slotLoad(SlotId{slot})); // the initial value, later what was stored
        b.slotStore(SlotId{slot++}, id);
      }
    });
  }

  // ---- regions -----------------------------------------------------------------------------------------------------

  void ifs() {
    inRung([&](RungBuilder& b) {
      for (uint64_t chosen : boundaryValues(Type::Bit)) {
        const ValueId cond = operand(b, Type::Bit, chosen);
        std::vector<ValueId> first;
        std::vector<ValueId> second;
        for (Type type : kTypes) {
          first.push_back(operand(b, type, boundaryValues(type)[0]));
          second.push_back(input(b, type));
        }
        b.if_(cond);
        result(b, b.i32(1));
        b.else_(first);
        result(b, b.i32(2));
        for (ValueId id : b.endIf(second)) result(b, id);
        b.if_(cond);
        result(b, b.i32(3));
        b.endIf();
      }
    });
  }

  // Carried values of every type, two of them changing places; memory written in each pass.
  void loops() {
    for (uint32_t count : {0u, 1u, 5u})
      inRung([&](RungBuilder& b) {
        std::vector<ValueId> carried{operand(b, Type::I32, 0x11), operand(b, Type::I32, 0x22)};
        for (Type type : kTypes) carried.push_back(operand(b, type, boundaryValues(type)[1]));
        const std::vector<ValueId> in = b.loop(count, carried);
        b.storeAt({SpaceId{kFirstTable.index + 2}, 0, kTableUnits}, in[0], in[1]);
        std::vector<ValueId> next{in[2], b.add(in[1], in[0])};
        for (size_t i = 3; i < in.size(); ++i) {
          const Type type = b.typeOf(in[i]);
          next.push_back(type == Type::F64 ? b.fAdd(in[i], in[i]) : b.not_(in[i]));
        }
        for (ValueId id : b.endLoop(next)) result(b, id);
        b.loop(count);
        const Place sum = newPlace(Type::I32);
        const ValueId before = b.load(Type::I32, sum);
        b.store(sum, b.add(before, b.i32(3)));
        b.endLoop();
      });
  }

  // ---- host --------------------------------------------------------------------------------------------------------

  void messages() {
    inRung([&](RungBuilder& b) {
      for (uint32_t kind = RUNG_MESSAGE_CLEAR; kind <= RUNG_MESSAGE_LOG; ++kind)
        for (Type type : {Type::I64, Type::F64}) {
          const ValueId number = operand(b, Type::I32, 70 + kind);
          const ValueId channel = operand(b, Type::I32, 1);
          const ValueId index = operand(b, Type::I32, 0xFFFFFFFF);
          const ValueId value = operand(b, type, boundaryValues(type)[3]);
          b.message(kind, number, channel, index, value);
        }
    });
  }

  void services() {
    inRung([&](RungBuilder& b) {
      const ValueId args[] = {operand(b, Type::I64, 5), operand(b, Type::I64, ~0ull),
                              operand(b, Type::I64, 1ull << 40)};
      for (size_t count : {size_t{0}, size_t{1}, size_t{3}}) {
        const ValueId ticket = b.serviceRequest(ServiceId{0}, std::span(args, count));
        result(b, ticket);
        result(b, b.servicePoll(ticket));
        result(b, b.serviceResult(ticket, 1));
      }
      const ValueId unknown = operand(b, Type::I32, 0xFFFFFF);
      result(b, b.servicePoll(unknown));
      result(b, b.serviceResult(unknown, 0));
    });
  }

  void traps() {
    inRung([&](RungBuilder& b) {
      b.trap(operand(b, Type::Bit, 0), FaultId{0});
      result(b, b.i32(1));
      b.setLine(7);
      b.trap(operand(b, Type::Bit, 1), FaultId{1});
      result(b, b.i32(2));
    });
  }

  void profile() {
    module_.instrumented = true;
    inRung([&](RungBuilder& b) {
      b.op(OpCode::ProfEnter, Type::None, {});
      result(b, input(b, Type::I32));
      b.op(OpCode::ProfLeave, Type::None, {});
    });
  }

  void finish() {
    // Empty spaces have no places to look at; one unit makes them whole.
    for (Space& space : module_.spaces) space.units = space.units == 0 ? 1 : space.units;
    if (!input_.empty()) module_.inits.push_back({.space = kIn, .byte = 0, .data = std::move(input_)});
    module_.tasks.push_back({.name = "MAIN", .entry = RoutineId{0}, .periodUs = 1000, .budgetFault = FaultId{0}});
    module_.mainTask = TaskId{0};
    module_.scan = {{RUNG_STEP_ADVANCE, {}, 1000}, {RUNG_STEP_RUN, TaskId{0}, 1}, {RUNG_STEP_SLOT, {}, 0}};
  }

  const OpCode code_;
  const OpInfo& info_;
  Module module_;
  std::vector<uint8_t> input_;
  uint32_t flags_ = 0;
};

} // namespace

Module moduleForOp(OpCode code) { return OpModule(code).run(); }

} // namespace rung::ir
