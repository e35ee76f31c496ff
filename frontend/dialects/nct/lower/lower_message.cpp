// MSG MSGF ALR ALRF REM REMF (man. §6.13, l.2775-2852).
//
// A rising edge of the input sends the message, a falling edge removes the message that was sent, even if the operands
// have changed since. The NC reports in a word of the box which of its messages is on the screen (or in the log), see
// rtlib/nc/nct/messages.h.
#include "frontend/dialects/nct/lower/lower.h"
#include "rtlib/nc/nct/messages.h"

namespace rung::frontend::nct {

using ir::RungBuilder;
using ir::Type;
using ir::ValueId;

namespace {

// Adds to `valid` that an operand known only at run time is between `least` and `most`.
ValueId inRange(Lowering& box, const Operand& operand, ValueId value, uint32_t least, uint32_t most, ValueId valid) {
  if (operand.form == Form::Constant) return valid;
  RungBuilder& b = box.b;
  const ValueId distance = least == 0 ? value : b.sub(value, b.i32(least));
  return box.memory.both(valid, b.leU(distance, b.i32(most - least)));
}

class MessageLowering {
public:
  explicit MessageLowering(Lowering& box)
      : box_(box), b_(box.b), before_(box.slots.make("before", Type::Bit)),
        words_(box.shared.words(nc::nct::kMessageSpace, nc::nct::kMessageWords, box.slots.key("shown"))) {}

  ValueId run() {
    const ValueId input = box_.power();
    const ValueId before = frontend::exchange(b_, before_, input);
    b_.when(frontend::edge(b_, before, input, kRising), [&] { send(); });
    b_.when(frontend::edge(b_, before, input, kFalling), [&] { remove(); });
    return b_.and_(input, b_.ne(b_.load(Type::I32, place(nc::nct::kShownWord)), b_.i32(0)));
  }

private:
  uint32_t logCell() const { return box_.variant & kMessageOnScreen ? 0 : nc::nct::kLogCell; }
  bool takesReal() const { return (box_.variant & kMessageOfReal) != 0; }
  ir::Place place(uint32_t word) const { return {.space = words_.space, .byte = (words_.first + word) * 4, .bit = 0}; }
  void setWanted(ValueId code) { b_.store(place(nc::nct::kWantedWord), code); }
  uint32_t operation() const {
    if ((box_.variant & kMessageOnScreen) == 0) return RUNG_MESSAGE_LOG;
    return (box_.variant & kMessageToLog) != 0 ? RUNG_MESSAGE_SHOW_LOG : RUNG_MESSAGE_SHOW;
  }

  ValueId variable(ValueId& valid) {
    if (box_.operands.size() < 4) return takesReal() ? b_.real(0) : b_.constant(Type::I64, 0);
    if (takesReal()) return box_.memory.real(box_.operands[3], valid);
    return b_.sextOrTrunc(Type::I64, box_.memory.integer(box_.operands[3], valid));
  }

  // Sends the message. An operand out of range at run time sets FL_ER, and nothing is sent.
  void send() {
    ValueId valid;
    const ValueId number = box_.memory.integer(box_.operands[0], valid);
    const ValueId channel = box_.memory.integer(box_.operands[1], valid);
    const ValueId index = box_.memory.integer(box_.operands[2], valid);
    const ValueId value = variable(valid);
    valid = inRange(box_, box_.operands[0], number, 1, nc::nct::kMessages, valid);
    valid = inRange(box_, box_.operands[1], channel, 0, nc::nct::kMostIndex, valid);
    valid = inRange(box_, box_.operands[2], index, 0, nc::nct::kMostIndex, valid);
    guarded(box_, valid, [&] {
      b_.message(operation(), number, channel, index, value);
      const ValueId code = b_.add(b_.add(b_.mul(channel, b_.i32(1'000'000)), b_.mul(number, b_.i32(100))), index);
      setWanted(b_.or_(code, b_.i32(logCell())));
      return ValueId{};
    });
  }

  void remove() {
    const ValueId code = b_.load(Type::I32, place(nc::nct::kWantedWord));
    if (logCell() == 0) {
      const auto digits = [&](uint32_t unit, uint32_t count) {
        const ValueId above = b_.divU(code, b_.i32(unit));
        return b_.remU(above, b_.i32(count));
      };
      b_.when(b_.ne(code, b_.i32(0)), [&] {
        b_.message(RUNG_MESSAGE_CLEAR, digits(100, 1000), digits(1'000'000, 100), digits(1, 100),
                   b_.constant(Type::I64, 0));
      });
    }
    setWanted(b_.i32(0));
    b_.store(place(nc::nct::kShownWord), b_.i32(0));
  }

  Lowering& box_;
  RungBuilder& b_;
  ir::SlotId before_;
  SharedWords words_; // words shared with the NC, for this box
};

} // namespace

ValueId lowerMessage(Lowering& box) { return MessageLowering(box).run(); }

} // namespace rung::frontend::nct
