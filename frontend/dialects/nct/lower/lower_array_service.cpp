// MR and MW: reading and writing arrays of the NC (man. §6.18, l.3390-3542), and what boxes share with the NC.
//
// A request takes several cycles (l.3414). The box copies its block into its own buffer and sends the request; from
// then on the program may use the block again. The answer is taken in the first evaluation with power that finds it.
// The output stays on while EN is TRUE, and the box sends another request only after EN was FALSE. If EN becomes FALSE
// before the answer, the answer is discarded and the buffer becomes free when it arrives.
#include <algorithm>

#include "frontend/dialects/nct/lower/lower.h"
#include "frontend/lower/operations.h"
#include "ir/support/diag/nct.h"
#include "rtlib/nc/nct/operand_block.h"
#include "rtlib/nc/nct/service_functions.h"

namespace rung::frontend::nct {

using ir::RungBuilder;
using ir::SlotId;
using ir::Type;
using ir::ValueId;
using nc::nct::FunctionAccess;

SharedWords Shared::words(std::string_view space, uint32_t count, const std::string& key) {
  ir::SpaceId id = ir::findSpace(module_, space);
  if (!id.valid())
    id = frontend::addSpace(module_, {.name = std::string(space),
                                      .unitBytes = 4,
                                      .flags = RUNG_SPACE_HIDDEN | RUNG_SPACE_ALLOCATED,
                                      .packedOnly = true});
  const SharedWords words{.space = id, .first = module_.spaces[id.index].units};
  module_.spaces[id.index].units += count;
  frontend::nameCells(module_, "@" + key, {.space = id, .byte = words.first * 4}, Type::I32, count);
  return words;
}

ValueId Shared::number(RungBuilder& b, Type type, const SharedWords& words) {
  const ValueId number = b.constant(type, words.first);
  if (given_ != nullptr)
    given_->add(routine_, static_cast<uint32_t>(module_.routines[routine_.index].rungs.size() - 1),
                {.value = number, .space = words.space, .byte = words.first * 4});
  return number;
}

namespace {

using enum frontend::RequestState;

// Result of one evaluation: the output and the new state.
struct Step {
  ValueId output, state;
};

class ArrayServiceLowering {
public:
  explicit ArrayServiceLowering(Lowering& box)
      : box_(box), b_(box.b), state_(box.slots.make("state", Type::I8)), ticket_(box.slots.make("ticket", Type::I32)),
        buffer_(box.shared.words(nc::nct::kBlockSpace, nc::nct::kBlockStride, box.slots.key("block"))),
        function_(box.operands[1]) {}

  ValueId run();

private:
  FunctionAccess access() const { return box_.variant == kWriteArray ? FunctionAccess::Write : FunctionAccess::Read; }
  ValueId is(uint8_t state) { return b_.constant(Type::I8, state); }
  ValueId answered() { return frontend::isAnswered(b_, b_.slotLoad(ticket_)); }
  Step rest(uint8_t state, bool output = false) { return {b_.bit(output), is(state)}; }

  uint32_t blockWords() const;
  WordRange block(const Place& place) const;
  ir::Window words() const { return buffer_.window(0, nc::nct::kBlockWords); }
  ir::Window mask() const { return buffer_.window(nc::nct::kBlockWords, nc::nct::kMaskWords); }
  ValueId isKnown(ValueId function);
  ValueId fits(const WordRange& range, const Place& place);

  ValueId freed(ValueId enable, ValueId state);
  Step evaluate(ValueId enable, ValueId state);
  Step begin();
  Step start(const Place& place, ValueId function);
  Step ask(const WordRange& range, const Place& place, ValueId function);
  Step await();
  void takeAnswer(const WordRange& range);

  Lowering& box_;
  RungBuilder& b_;
  SlotId state_, ticket_;
  SlotId first_{}; // for a computed block: its first word at the time of the request
  SharedWords buffer_;
  const Operand& function_;
};

// Lowers the box. While it is idle it costs one comparison.
ValueId ArrayServiceLowering::run() {
  if (!box_.operands[0].address.isFixed()) first_ = box_.slots.make("first", Type::I32);
  const ValueId enable = box_.power();
  const ValueId state = b_.slotLoad(state_);
  const auto work = [&] {
    const Step step = evaluate(enable, freed(enable, state));
    b_.slotStore(state_, step.state);
    return step.output;
  };
  return b_.choose(b_.or_(enable, b_.ne(state, is(kIdle))), work, [&] { return b_.bit(false); });
}

// The state after an unwanted answer has been discarded.
ValueId ArrayServiceLowering::freed(ValueId enable, ValueId state) {
  const ValueId given = b_.and_(b_.eq(state, is(kPending)), b_.not_(enable));
  return b_.choose(
      b_.or_(given, b_.eq(state, is(kAbandoned))), [&] { return b_.select(answered(), is(kIdle), is(kAbandoned)); },
      [&] { return state; });
}

Step ArrayServiceLowering::evaluate(ValueId enable, ValueId state) {
  const ValueId done = b_.eq(state, is(kDone));
  return b_.choose(
      enable,
      [&] {
        return b_.choose(
            b_.eq(state, is(kIdle)), [&] { return begin(); },
            [&] {
              return b_.choose(b_.eq(state, is(kPending)), [&] { return await(); }, [&] { return Step{done, state}; });
            });
      },
      [&] { return Step{b_.bit(false), b_.select(done, is(kIdle), state)}; });
}

// --- a request ------------------------------------------------------------------------------------------------------

// Number of words of the program's block that may matter; for a constant function code the table gives it.
uint32_t ArrayServiceLowering::blockWords() const {
  constexpr uint32_t kLeast = 16;
  if (function_.form != Form::Constant) return nc::nct::kBlockWords;
  const nc::nct::ServiceFunction* function = nc::nct::findServiceFunction(function_.constant.integer);
  return function == nullptr ? kLeast : std::max<uint32_t>(kLeast, function->words.back().last + 1u);
}

// The block in memory. Words beyond the end of memory read 0, and writes to them are ignored.
WordRange ArrayServiceLowering::block(const Place& place) const {
  WordRange range;
  range.mostWords = blockWords();
  if (!place.fixed) {
    range.window = {.space = place.space, .byte = 0, .count = kWords};
    range.first = place.wordNo;
    return range;
  }
  range.window = {
      .space = place.space, .byte = place.word * 4, .count = std::min(range.mostWords, kWords - place.word)};
  return range;
}

ValueId ArrayServiceLowering::isKnown(ValueId function) {
  ValueId known = b_.bit(false);
  for (const nc::nct::ServiceFunction& f : nc::nct::serviceFunctions())
    if (f.access == access()) known = b_.or_(known, b_.eq(function, b_.i32(f.code)));
  return known;
}

// Whether the last word, (amount + 1) words after the first, is still in memory (l.3457, l.3532).
ValueId ArrayServiceLowering::fits(const WordRange& range, const Place& place) {
  const ValueId amount = box_.memory.loadIn(range, b_.i32(nc::nct::kAmountWord));
  const ValueId after = place.fixed ? b_.i32(kWords - 1 - place.word) : b_.sub(b_.i32(kWords - 1), place.wordNo);
  return b_.ltU(amount, after);
}

Step ArrayServiceLowering::begin() {
  const Place place = box_.memory.word(box_.operands[0].address, AccessBound::Write);
  ValueId valid = place.valid;
  const ValueId function = box_.memory.integer(function_, valid);
  if (!valid.valid()) return start(place, function);
  return b_.choose(
      valid, [&] { return start(place, function); },
      [&] { // no valid block that could take an execution code
        box_.memory.setErrorFlag(true);
        return rest(kIdle);
      });
}

// Starts a request. One that cannot be sent is answered at once with an error code.
Step ArrayServiceLowering::start(const Place& place, ValueId function) {
  const WordRange range = block(place);
  const ValueId refusal = b_.select(
      isKnown(function), b_.select(fits(range, place), b_.i32(nc::nct::kExecuted), b_.i32(nc::nct::kBadAmount)),
      b_.i32(nc::nct::kBadFunction));
  return b_.choose(
      b_.eq(refusal, b_.i32(nc::nct::kExecuted)), [&] { return ask(range, place, function); },
      [&] {
        box_.memory.storeIn(range, b_.i32(nc::nct::kCodeWord), refusal);
        return rest(kDone, true);
      });
}

Step ArrayServiceLowering::ask(const WordRange& range, const Place& place, ValueId function) {
  const ValueId word = b_.loop(range.mostWords).front();
  b_.storeAt(words(), word, box_.memory.loadIn(range, word));
  b_.endLoop();
  const ValueId i = b_.loop(nc::nct::kMaskWords).front();
  b_.storeAt(mask(), i, b_.i32(0));
  b_.endLoop();
  const ValueId first = place.fixed ? b_.i32(place.word) : place.wordNo;
  if (first_.valid()) b_.slotStore(first_, first);
  const ValueId args[] = {b_.sextOrTrunc(Type::I64, function), b_.sextOrTrunc(Type::I64, first),
                          box_.shared.number(b_, Type::I64, buffer_)};
  const auto kind =
      access() == FunctionAccess::Write ? nc::nct::ServiceKind::WriteArray : nc::nct::ServiceKind::ReadArray;
  const ValueId ticket = b_.serviceRequest(box_.shared.service(kind), args);
  b_.slotStore(ticket_, ticket);
  const ValueId queueFull = b_.eq(ticket, b_.i32(0));
  return {b_.bit(false), b_.select(queueFull, is(kIdle), is(kPending))};
}

// --- its answer -----------------------------------------------------------------------------------------------------

Step ArrayServiceLowering::await() {
  return b_.choose(
      answered(),
      [&] {
        Place place = box_.memory.word(box_.operands[0].address, AccessBound::Write);
        if (first_.valid()) place.wordNo = b_.slotLoad(first_);
        takeAnswer(block(place));
        return rest(kDone, true);
      },
      [&] { return rest(kPending); });
}

// Stores the answer in the block. A host without an NC answers with an error: the function counts as unknown.
void ArrayServiceLowering::takeAnswer(const WordRange& range) {
  const ValueId word = b_.loop(range.mostWords).front();
  const ValueId bits = b_.loadAt(Type::I32, mask(), b_.shrU(word, b_.i32(5)));
  const ValueId bit = b_.shrU(bits, b_.and_(word, b_.i32(31)));
  b_.when(b_.zextOrTrunc(Type::Bit, bit),
          [&] { box_.memory.storeIn(range, word, b_.loadAt(Type::I32, words(), word)); });
  b_.endLoop();
  const ValueId code = b_.sextOrTrunc(Type::I32, b_.serviceResult(b_.slotLoad(ticket_), 0));
  const ValueId done = frontend::isExecuted(b_, b_.slotLoad(ticket_));
  box_.memory.storeIn(range, b_.i32(nc::nct::kCodeWord), b_.select(done, code, b_.i32(nc::nct::kBadFunction)));
}

void checkFunction(const Operand& function, FunctionAccess access, Diagnostics& diagnostics) {
  if (function.form != Form::Constant) return;
  const nc::nct::ServiceFunction* known = nc::nct::findServiceFunction(function.constant.integer);
  if (known != nullptr && known->access == access) return;
  DiagBuilder report = diagnostics.report(diag::UnknownFunctionCode, function.source->range);
  report << function.source->text << nc::nct::mnemonicOf(access);
  if (known != nullptr)
    report.note(std::string(function.source->text) + " is a function of " +
                std::string(nc::nct::mnemonicOf(known->access)));
}

} // namespace

ValueId lowerArrayService(Lowering& box) { return ArrayServiceLowering(box).run(); }

void checkReadFunction(std::span<const Operand> operands, const Config&, Diagnostics& diagnostics) {
  checkFunction(operands[1], FunctionAccess::Read, diagnostics);
}

void checkWriteFunction(std::span<const Operand> operands, const Config&, Diagnostics& diagnostics) {
  checkFunction(operands[1], FunctionAccess::Write, diagnostics);
}

} // namespace rung::frontend::nct
