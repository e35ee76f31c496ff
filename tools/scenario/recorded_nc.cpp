// See recorded_nc.h.
#include "tools/scenario/recorded_nc.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <utility>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/text/number.h"

namespace rung::scenario {
namespace {

using Words = std::span<const std::string>;

constexpr std::string_view kActions = "set NAME BITS, memory SPACE BYTE VALUE, state KEY BITS, task NAME, "
                                      "request SERVICE [ARGUMENT…], reply|answer REQUEST done|error [RESULT…], "
                                      "clock MICROSECONDS or halt FAULT";

// A number of 64 bits, with or without a sign.
std::optional<int64_t> bitsOf(const std::string& word) {
  if (const auto number = text::wholeIn<int64_t>(word)) return number;
  const auto large = text::wholeIn<uint64_t>(word);
  return large ? std::optional(static_cast<int64_t>(*large)) : std::nullopt;
}

bool takeNumbers(Words words, std::vector<int64_t>& into) {
  for (const std::string& word : words) {
    const auto number = bitsOf(word);
    if (!number) return false;
    into.push_back(*number);
  }
  return true;
}

const rung_slot* findSlot(const rung_program& program, const std::string& key) {
  const std::span slots(program.slots, program.slot_count);
  const auto found = std::ranges::find_if(slots, [&](const rung_slot& slot) { return slot.key == key; });
  return found == slots.end() ? nullptr : &*found;
}

core::ServiceReply replyOf(uint32_t ticket, uint32_t state, const std::vector<int64_t>& results) {
  core::ServiceReply reply{.ticket = ticket, .state = state};
  reply.resultCount = static_cast<uint32_t>(std::min<size_t>(results.size(), RUNG_MAX_SERVICE_ARGS));
  std::copy_n(results.begin(), reply.resultCount, reply.results);
  return reply;
}

} // namespace

// ---- actions -----------------------------------------------------------------------------------------------------

std::string RecordedNc::read(const rung_program& program, std::string_view action, Words words, Act& act) {
  const size_t count = words.size();
  if (action == "set" && count == 2) {
    const auto place = nc::resolve(program, words[0]);
    if (!place || place->kind == runtime::RefKind::Constant || place->kind == runtime::RefKind::Text)
      return fmt::format("'{}' is not a number or a bit of this program", words[0]);
    act.place = *place;
    return takeNumbers(words.subspan(1), act.values) ? "" : fmt::format("'{}' is not a whole number", words[1]);
  }
  if (action == "memory" && count == 3) {
    const uint32_t space = runtime::findSpace(program, words[0]);
    const auto byte = text::wholeIn<uint32_t>(words[1]);
    if (space == RUNG_NONE || !byte || *byte >= program.spaces[space].byte_count)
      return fmt::format("this program has no byte {} in a memory '{}'", words[1], words[0]);
    act.place = runtime::intRef(space, *byte, 8);
    return takeNumbers(words.subspan(2), act.values) ? "" : fmt::format("'{}' is not a whole number", words[2]);
  }
  if (action == "state" && count == 2) {
    const rung_slot* slot = findSlot(program, words[0]);
    if (slot == nullptr) return fmt::format("this program has no internal state '{}'", words[0]);
    act.what = Act::What::State;
    act.number = slot->offset;
    act.bytes = runtime::slotBytes(*slot);
    return takeNumbers(words.subspan(1), act.values) ? "" : fmt::format("'{}' is not a whole number", words[1]);
  }
  if (action == "task" && count == 1) {
    const uint32_t task = runtime::findTask(program, words[0]);
    if (task == RUNG_NONE) return fmt::format("this program has no task '{}'", words[0]);
    act.what = Act::What::Task;
    act.number = task;
    return {};
  }
  if ((action == "request" && count >= 1) || (action == "halt" && count == 1)) {
    act.what = action == "request" ? Act::What::Request : Act::What::Halt;
    const auto number = text::wholeIn<uint32_t>(words[0]);
    act.number = number.value_or(0);
    return number && takeNumbers(words.subspan(1), act.values) ? "" : "the operands are whole numbers";
  }
  if ((action == "reply" || action == "answer") && count >= 2) {
    act.what = Act::What::Reply;
    const auto number = text::wholeIn<uint32_t>(words[0]);
    act.number = number.value_or(0);
    if (words[1] != "done" && words[1] != "error") return fmt::format("expected done or error, found '{}'", words[1]);
    act.state = words[1] == "done" ? RUNG_SERVICE_DONE : RUNG_SERVICE_ERROR;
    return number && takeNumbers(words.subspan(2), act.values) ? "" : "the operands are whole numbers";
  }
  if (action == "clock" && count == 1) {
    act.what = Act::What::Clock;
    return takeNumbers(words, act.values) ? "" : fmt::format("'{}' is not a whole number", words[0]);
  }
  return fmt::format("expected {}, found '{}' with {} operands", kActions, action, count);
}

std::string RecordedNc::take(runtime::Instance& instance, uint32_t turn, std::string_view action, Words operands) {
  Act act{.turn = turn};
  if (std::string problem = read(instance.program(), action, operands, act); !problem.empty()) return problem;
  if (action == "answer") {
    answers_.push_back(std::move(act));
    return {};
  }
  if (turn == 0) {
    turn_ = 0; // a fault of a task has the first one
    return execute(instance, act);
  }
  acts_.push_back(std::move(act));
  return {};
}

std::string RecordedNc::execute(runtime::Instance& instance, const Act& act) {
  const int64_t value = act.values.empty() ? 0 : act.values[0];
  switch (act.what) {
  case Act::What::Write: runtime::writeRaw(instance.memory(), act.place, static_cast<uint64_t>(value)); return {};
  case Act::What::State: std::memcpy(instance.block().data() + act.number, &value, act.bytes); return {};
  case Act::What::Task: (void)instance.runTask(act.number); return {};
  case Act::What::Request: {
    const auto count = static_cast<uint32_t>(std::min<size_t>(act.values.size(), RUNG_MAX_SERVICE_ARGS));
    (void)instance.services().request(act.number, act.values.data(), count);
    return {};
  }
  case Act::What::Reply: return complete(instance, act);
  case Act::What::Clock: instance.advanceClock(value); return {};
  case Act::What::Halt: (void)instance.halt(act.number); return {};
  }
  return {};
}

std::string RecordedNc::complete(runtime::Instance& instance, const Act& act) const {
  if (act.number == 0 || act.number > tickets_.size())
    return fmt::format("the program has made {} requests since the start, so there is none with the number {}",
                       tickets_.size(), act.number);
  (void)instance.services().complete(replyOf(tickets_[act.number - 1], act.state, act.values));
  return {};
}

// ---- turns -------------------------------------------------------------------------------------------------------

void RecordedNc::powerOn(runtime::Instance& instance, nc::PowerOn kind) {
  acts_.clear();
  answers_.clear();
  tickets_.clear();
  problem_.clear();
  starting_ = true;
  SimulatedNc::powerOn(instance, kind);
  starting_ = false;
}

// A task that stops with a fault has another turn within this one.
void RecordedNc::haveTurn(runtime::Instance& instance) {
  const uint32_t turn = ++turn_;
  std::vector<Act> acts;
  for (Act& act : acts_)
    if (act.turn == turn) acts.push_back(std::move(act));
  std::erase_if(acts_, [turn](const Act& act) { return act.turn == turn; });
  bool replied = false;
  for (const Act& act : acts) {
    if (std::string problem = execute(instance, act); problem_.empty()) problem_ = std::move(problem);
    replied = replied || act.what == Act::What::Reply;
  }
  if (replied) instance.services().deliver();
}

void RecordedNc::afterPart(runtime::Instance&) {
  if (problem_.empty() && !acts_.empty())
    problem_ = fmt::format("the control did not get its turn {}, of which a `within` statement is", acts_[0].turn);
  if (problem_.empty() && !answers_.empty())
    problem_ = fmt::format("the program did not make request {}, of which a `within` statement has the answer",
                           answers_[0].number);
  acts_.clear();
  answers_.clear();
}

std::string RecordedNc::takeUnused() { return std::exchange(problem_, {}); }

// A request without an answer is kept, as by a control that answers it later.
bool RecordedNc::serve(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
  tickets_.push_back(request.ticket);
  if (starting_) return control_->respond(instance, request, reply);
  const auto found = std::ranges::find(answers_, tickets_.size(), &Act::number);
  reply.ticket = request.ticket;
  reply.state = RUNG_SERVICE_PENDING;
  if (found == answers_.end()) return true;
  reply = replyOf(request.ticket, found->state, found->values);
  answers_.erase(found);
  return true;
}

std::string RecordedNc::plcCommand(runtime::Instance& instance, std::string_view command) {
  if (command == "clear") return "a recorded control has no messages of its own to clear";
  instance.setStopped(command == "stop");
  return {};
}

void RecordedNc::save(core::Saver& saver) const noexcept {
  SimulatedNc::save(saver);
  saver(tickets_);
}

void RecordedNc::load(runtime::Instance& instance, core::Loader& loader) {
  SimulatedNc::load(instance, loader);
  loader(tickets_);
}

} // namespace rung::scenario
