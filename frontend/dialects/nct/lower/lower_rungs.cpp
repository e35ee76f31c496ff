// Lowers rungs (see lower_rungs.h).
#include "frontend/dialects/nct/lower/lower_rungs.h"

#include <algorithm>
#include <ranges>

#include <fmt/format.h>

#include "frontend/dialects/nct/check/structure.h"
#include "frontend/dialects/nct/lower/lower.h"
#include "ir/support/check.h"
#include "ir/support/hash.h"
#include "rung/types.hpp"

namespace rung::frontend::nct {
namespace {

using ir::ValueId;

// A JMP, SBS or RET of the rung. They take effect after the whole rung has been evaluated, in the order of their
// execution (chapter 4, 9).
struct Leave {
  Flow flow;
  uint32_t number;
  ValueId cond;
};

// A jump whose target rung is known only when its body is complete.
struct OpenJump {
  uint32_t rung;
  uint32_t number;
};

// The rung of a label or the body of a subroutine, which must exist.
uint32_t existing(const std::optional<uint32_t>& target) {
  RUNG_CHECK(target.has_value(), "a module with a jump or call to nowhere is not lowered");
  return *target;
}

// Name of an element within its rung, stable across versions of the program: instruction and operands. The first
// operand suffices if only one instance with it may exist.
std::string identityOf(const Row& row, std::span<const Operand> operands) {
  std::string text(row.info.mnemonic);
  for (const Operand& operand : operands) {
    text += ' ';
    if (operand.edge != 0) text += operand.edge;
    text += operand.source->text;
    if (row.reservation == Reservation::Once) break;
  }
  return text;
}

class BodyLowering {
public:
  BodyLowering(LoweringContext& context, const TypedModule& module, const std::vector<ir::RoutineId>& routines,
               const std::vector<RunTime>& times, uint32_t body)
      : context_(context), source_(module), routines_(routines), times_(times), body_(module.bodies[body]),
        id_(routines[body]), routine_(context.module.routines[routines[body].index]),
        slots_(context.module, routine_.name), shared_(context.module, id_, context.given) {}

  void run() {
    routine_.rungs.reserve(body_.end - body_.first);
    for (uint32_t i = body_.first; i < body_.end; ++i) {
      place_.push_back(static_cast<uint32_t>(routine_.rungs.size()));
      time_ = times_[i];
      lowerRung(source_.rungs[i]);
    }
    // A module may be empty, but a routine may not.
    if (routine_.rungs.empty()) routine_.rungs.emplace_back().key = hashBytes(routine_.name);
    for (const OpenJump& jump : jumps_)
      routine_.rungs[jump.rung].transfer.target = place_[existing(source_.labels[jump.number]) - body_.first];
  }

private:
  void lowerRung(const TypedRung& typed);
  void describe(ir::Rung& rung, const TypedRung& typed);
  void lowerElement(ir::RungBuilder& b, Memory& memory, const TypedRung& typed, size_t index);
  void mark(ir::MarkKind kind, ValueId value, const ladder::Element& element, std::string_view more = {});
  void markInputs(const TypedRung& typed, const ladder::Element& element);
  void markOutput(const ladder::Element& element, ValueId condition, ValueId output);
  void leave(ir::RungBuilder& b, const Leave& leave);
  void addHelpers(const std::vector<ir::SlotId>& conditions, const TypedRung& typed, uint64_t text, uint32_t copy);

  LoweringContext& context_;
  const TypedModule& source_;
  const std::vector<ir::RoutineId>& routines_; // per body
  const std::vector<RunTime>& times_;          // per rung of the module
  const Body& body_;
  ir::RoutineId id_;
  ir::Routine& routine_;
  SlotMaker slots_;
  Shared shared_;
  std::vector<uint32_t> place_; // IR rung of each rung of the body
  std::vector<OpenJump> jumps_;
  // State of the current rung.
  RunTime time_;
  std::vector<ValueId> power_; // per net; invalid if nothing has driven it yet, and for the rail
  std::vector<ValueId> pins_;
  std::vector<Leave> leaves_;
};

void BodyLowering::describe(ir::Rung& rung, const TypedRung& typed) {
  const ladder::Rung& drawing = *typed.rung;
  rung.number = typed.number;
  rung.title = drawing.comment;
  rung.sourceText = context_.sources.text(drawing.range);
  rung.begin = {.file = context_.files.at(typed.file->file.index), .line = drawing.firstLine, .column = 1};
  rung.lastLine = drawing.lastLine;
  rung.weight = std::max<uint32_t>(1, static_cast<uint32_t>(typed.elements.size()));
  const uint64_t text = hashBytes(rung.sourceText, hashBytes(routine_.name));
  rung.copy = context_.sameText[text]++;
  rung.key = rungKey(text, rung.copy);
}

void BodyLowering::mark(ir::MarkKind kind, ValueId value, const ladder::Element& element, std::string_view more) {
  std::string text(context_.sources.text(element.range));
  context_.marks->add(id_, static_cast<uint32_t>(routine_.rungs.size() - 1),
                      {kind, value, element.line, element.column, text.append(more)});
}

// Marks the power at the inputs of coils and boxes; that of the left rail is constant.
void BodyLowering::markInputs(const TypedRung& typed, const ladder::Element& element) {
  if (context_.marks == nullptr || element.kind == ladder::ElementKind::Contact) return;
  const bool coil = element.kind == ladder::ElementKind::Coil;
  const std::span<const ladder::Pin> pins = typed.rung->pinsOf(element);
  for (size_t i = 0; i < pins_.size(); ++i)
    if (pins_[i].valid())
      mark(coil ? ir::MarkKind::Coil : ir::MarkKind::Input, pins_[i], element,
           pins[i].name.empty() ? std::string() : fmt::format(" {}", pins[i].name));
}

// Marks an output. A box that only passes on the power at a pin gets no mark.
void BodyLowering::markOutput(const ladder::Element& element, ValueId condition, ValueId output) {
  if (context_.marks == nullptr || !output.valid()) return;
  if (std::find(pins_.begin(), pins_.end(), output) != pins_.end()) return;
  const bool contact = element.kind == ladder::ElementKind::Contact;
  mark(contact ? ir::MarkKind::Contact : ir::MarkKind::Result, condition.valid() ? condition : output, element);
}

void BodyLowering::lowerElement(ir::RungBuilder& b, Memory& memory, const TypedRung& typed, size_t index) {
  const TypedElement& typedElement = typed.elements[index];
  const ladder::Element& element = *typedElement.element;
  const Row& row = *typedElement.row;
  b.setLine(element.line);
  pins_.clear();
  for (const ladder::Pin& pin : typed.rung->pinsOf(element)) pins_.push_back(power_[pin.input.index]);
  markInputs(typed, element);
  ValueId output;
  if (row.lower != nullptr) {
    if (element.kind == ladder::ElementKind::Box) b.note(row.info.mnemonic);
    const std::span<const Operand> operands = typed.operandsOf(typedElement);
    slots_.setElement(identityOf(row, operands));
    Lowering box{.b = b,
                 .memory = memory,
                 .slots = slots_,
                 .shared = shared_,
                 .time = time_,
                 .operands = operands,
                 .pins = pins_,
                 .variant = row.variant,
                 .edge = operands.empty() ? '\0' : operands[0].edge};
    output = row.lower(box);
    markOutput(element, box.condition, output);
  } else if (row.flow == Flow::Jump || row.flow == Flow::Call || row.flow == Flow::Return) {
    leaves_.push_back({row.flow, typedElement.label.value_or(0), pins_[0]});
  }
  if (!element.output.valid()) return;
  ValueId& net = power_[element.output.index];
  net = net.valid() ? b.or_(net, output) : output;
}

void BodyLowering::lowerRung(const TypedRung& typed) {
  ir::Rung& rung = routine_.rungs.emplace_back();
  describe(rung, typed);
  const uint64_t text = textOfKey(rung.key, rung.copy);
  const uint32_t copy = rung.copy;
  ir::RungBuilder b(context_.module, rung);
  Memory memory(b, context_.config, context_.spaces, context_.written);
  power_.assign(typed.rung->nets.size(), ValueId{});
  leaves_.clear();
  for (size_t i = 0; i < typed.elements.size(); ++i) lowerElement(b, memory, typed, i);
  if (leaves_.empty()) return;
  // All conditions but the first are kept in slots for the helper rungs that follow.
  std::vector<ir::SlotId> conditions;
  slots_.setElement("leave");
  for (size_t i = 1; i < leaves_.size(); ++i) {
    conditions.push_back(slots_.make(fmt::format("{}", i), ir::Type::Bit, 0, true));
    b.slotStore(conditions.back(), leaves_[i].cond);
  }
  leave(b, leaves_[0]);
  addHelpers(conditions, typed, text, copy);
}

void BodyLowering::addHelpers(const std::vector<ir::SlotId>& conditions, const TypedRung& typed, uint64_t text,
                              uint32_t copy) {
  for (size_t i = 0; i < conditions.size(); ++i) {
    ir::Rung& helper = routine_.rungs.emplace_back();
    helper.number = typed.number;
    helper.title = typed.rung->comment;
    helper.begin = {.file = context_.files.at(typed.file->file.index), .line = typed.rung->firstLine, .column = 1};
    helper.lastLine = typed.rung->lastLine;
    helper.key = rungKey(hashBytes(fmt::format("leave{}", i + 1), text), copy);
    helper.copy = copy;
    ir::RungBuilder b(context_.module, helper);
    Leave then = leaves_[i + 1];
    then.cond = b.slotLoad(conditions[i]);
    leave(b, then);
  }
}

void BodyLowering::leave(ir::RungBuilder& b, const Leave& leave) {
  switch (leave.flow) {
  case Flow::Jump:
    jumps_.push_back({static_cast<uint32_t>(routine_.rungs.size() - 1), leave.number});
    return b.gotoRung(0, leave.cond);
  case Flow::Call: return b.call(routines_[existing(source_.subroutines[leave.number])], leave.cond);
  case Flow::Return: return b.ret(leave.cond);
  case Flow::None:
  case Flow::End:
  case Flow::Label:
  case Flow::Subroutine:
  case Flow::Section: return;
  }
}

bool hasTimer(const TypedRung& rung) {
  return std::ranges::any_of(rung.elements, [](const TypedElement& e) { return e.row->lower == lowerTimer; });
}

// For each rung of the module, how its timers get the elapsed time. If any of them can use the run's time, the module
// begins with a rung that takes it.
std::vector<RunTime> takeTime(LoweringContext& context, const TypedModule& module, ir::Routine& routine) {
  std::vector<RunTime> times(module.rungs.size());
  if (!context.config.runsAtWholeMs() || context.given != nullptr) return times;
  const std::vector<bool> once = evaluatedOncePerRun(module);
  const auto asks = [&](uint32_t i) { return once[i] && hasTimer(module.rungs[i]); };
  if (std::ranges::none_of(std::views::iota(0u, static_cast<uint32_t>(once.size())), asks)) return times;
  ir::Rung& rung = routine.rungs.emplace_back();
  const TypedRung& first = module.rungs.front();
  rung.begin = {.file = context.files.at(first.file->file.index), .line = first.rung->firstLine, .column = 1};
  rung.lastLine = rung.begin.line;
  rung.key = hashBytes("time", hashBytes(routine.name));
  ir::RungBuilder b(context.module, rung);
  SlotMaker slots(context.module, routine.name);
  slots.setElement("time");
  const RunTime time = lowerRunTime(b, slots);
  for (uint32_t i = 0; i < times.size(); ++i)
    if (once[i]) times[i] = time;
  return times;
}

} // namespace

ir::RoutineId lowerModule(LoweringContext& context, const TypedModule& module) {
  std::vector<ir::RoutineId> routines;
  for (const Body& body : module.bodies)
    routines.push_back(frontend::addRoutine(
        context.module, body.number ? fmt::format("{}.SBN{}", module.name, *body.number) : std::string(module.name)));
  const std::vector<RunTime> times = takeTime(context, module, context.module.routines[routines.front().index]);
  for (uint32_t i = 0; i < module.bodies.size(); ++i) BodyLowering(context, module, routines, times, i).run();
  return routines.front();
}

} // namespace rung::frontend::nct
