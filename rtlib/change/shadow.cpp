// Records the running program, and runs the new one on the records.
#include "rtlib/change/shadow.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include "rtlib/load/program_info.h"
#include "rung/types.hpp"

namespace rung::runtime {

namespace {

// Ticket of a request that the running program did not make: it stays unanswered.
constexpr uint32_t kUnanswered = UINT32_MAX;

std::span<const rung_step> stepsOf(const rung_step* steps, uint32_t count) { return {steps, count}; }

// The difference between two lists of steps, or "".
std::string differentSteps(const rung_program& a, std::span<const rung_step> stepsA, const rung_program& b,
                           std::span<const rung_step> stepsB) {
  const auto same = [&](const rung_step& x, const rung_step& y) {
    const bool sameTask = x.task == RUNG_NONE || y.task == RUNG_NONE
                              ? x.task == y.task
                              : std::strcmp(a.tasks[x.task].name, b.tasks[y.task].name) == 0;
    return x.op == y.op && x.arg == y.arg && sameTask;
  };
  return std::ranges::equal(stepsA, stepsB, same) ? "" : "the schedule of the new program is another one";
}

// Whether a scan of the schedule ends all runs that it begins: the shadow begins with a scan, so its runs must begin
// there, too.
bool hasWholeRuns(const rung_program& program, std::span<const rung_step> steps) {
  std::vector<uint64_t> parts(program.task_count);
  for (const rung_step& step : steps)
    if (step.op == RUNG_STEP_PART) ++parts[step.task];
  for (uint32_t t = 0; t < program.task_count; ++t)
    if (parts[t] % std::max(1u, program.tasks[t].part_count) != 0) return false;
  return true;
}

} // namespace

// ---- before -------------------------------------------------------------------------------------------------------

Shadow::Shadow(const rung_program& live, const Runnable& next, DescribePlace describe, uint32_t scans, uint32_t room,
               const Naming& naming)
    : live_(live), next_(next), transfer_(live, next.program, naming), describe_(describe),
      lengthUs_(static_cast<int64_t>(scanPeriodUs(live)) * scans), problem_(compareSchedules()), records_(room),
      ring_(room), runner_(next.program, next_.block.get(), ctx_, next_.parts.data(), next.engine) {
  ctx_.host = &api_;
  ctx_.host_data = this;
  ctx_.prof = next_.counters();
  start_.before.resize(live.memory_size);
  for (Record& record : records_) {
    record.before.resize(live.memory_size);
    record.after.resize(live.memory_size);
    record.forced.resize(live.memory_size);
  }
  former_.assign(next_.block.get(), next_.block.get() + next.program.memory_size);
  present_ = former_;
  forced_.resize(former_.size());
  for (uint32_t t = 0; t < live.task_count; ++t) tasks_.push_back(findTask(next.program, live.tasks[t].name));
  inParts_.resize(live.task_count);
  for (const auto& steps : {stepsOf(live.scan, live.scan_count), stepsOf(live.slices, live.slice_count)})
    for (const rung_step& step : steps)
      if (step.op == RUNG_STEP_PART) inParts_[step.task] = true;
  for (uint32_t s = 0; s < next.program.service_count; ++s)
    services_.push_back(findService(live, next.program.services[s]));
  findOutputs({live, naming});
}

std::string Shadow::compareSchedules() const {
  const rung_program& next = *next_.program;
  for (uint32_t t = 0; t < live_.task_count; ++t) {
    const uint32_t task = findTask(next, live_.tasks[t].name);
    if (task == RUNG_NONE || next.tasks[task].part_count != live_.tasks[t].part_count)
      return "the new program has no task '" + std::string(live_.tasks[t].name) + "', or another number of its parts";
  }
  std::string wrong =
      differentSteps(live_, stepsOf(live_.scan, live_.scan_count), next, stepsOf(next.scan, next.scan_count));
  if (!wrong.empty()) return wrong;
  if (!hasWholeRuns(live_, stepsOf(live_.scan, live_.scan_count)))
    return "a scan of their schedule is not a whole number of runs";
  return differentSteps(live_, stepsOf(live_.slices, live_.slice_count), next, stepsOf(next.slices, next.slice_count));
}

// Finds the names of both programs in the spaces of outputs, and bits of these spaces without a name. If the dialect
// marks no space as output, all names count.
void Shadow::findOutputs(const SymbolsByName& liveSymbols) {
  const rung_program& next = *next_.program;
  const std::span<const rung_space> spaces(next.spaces, next.space_count);
  const auto isOutput = [](const rung_space& space) { return (space.flags & RUNG_SPACE_OUTPUT) != 0; };
  const bool marked = std::ranges::any_of(spaces, isOutput);
  std::set<std::pair<uint32_t, uint32_t>> named; // bytes of the new program
  for (const rung_symbol& symbol : std::span(next.symbols, next.symbol_count)) {
    if ((symbol.flags & (RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN)) != 0 || symbol.type == RUNG_TYPE_TEXT) continue;
    if (marked && !isOutput(spaces[symbol.space])) continue;
    const rung_symbol* live = liveSymbols.find(symbol.name);
    if (live == nullptr || live->type != symbol.type || (live->flags & RUNG_SYMBOL_CONST) != 0) continue;
    const Ref ref = refOf(symbol);
    const Ref there = refOf(*live);
    for (uint32_t i = 0; i < std::min(ref.count, there.count); ++i) {
      const std::string name = ref.count == 1 ? symbol.name : symbol.name + ("[" + std::to_string(i) + "]");
      outputs_.push_back(
          {.live = element(there, i).value_or(there), .next = element(ref, i).value_or(ref), .name = name});
    }
    for (uint32_t byte = 0; byte < std::max(1u, ref.width / 8u) * ref.count; ++byte)
      named.insert({symbol.space, ref.byte + byte});
  }
  for (uint32_t s = 0; marked && s < next.space_count; ++s) {
    const uint32_t live = findSpace(live_, next.spaces[s].name);
    if (!isOutput(spaces[s]) || live == RUNG_NONE) continue;
    for (uint32_t byte = 0; byte < std::min(spaces[s].byte_count, live_.spaces[live].byte_count); ++byte)
      if (!named.contains({s, byte}))
        outputs_.push_back({.live = intRef(live, byte, 8), .next = intRef(s, byte, 8), .name = {}});
  }
  indexOutputs();
}

// Finds the outputs that the transfer of state copies completely to the new program's block, where they are compared
// together.
void Shadow::indexOutputs() {
  const rung_program& next = *next_.program;
  const core::Memory memory(next, nullptr);
  const std::vector<bool> written = transfer_.written(next.memory_size);
  mask_.resize((next.memory_size + sizeof(uint64_t) - 1) / sizeof(uint64_t));
  std::vector<OutputByte> bytes;
  for (uint32_t i = 0; i < outputs_.size(); ++i) {
    const Ref& ref = outputs_[i].next;
    bytes.clear();
    for (uint32_t b = 0; b < std::max(1u, ref.width / 8u); ++b) {
      const rung_range& range = *memory.rangeOf(ref.space, ref.byte + b);
      const uint32_t scale = bytesPerByte(range.repr);
      const uint32_t first = range.offset + scale * (ref.byte + b - range.first_byte);
      for (uint32_t k = 0; k < scale; ++k) bytes.push_back({first + k, i});
    }
    if (!std::ranges::all_of(bytes, [&](const OutputByte& byte) { return written[byte.offset]; })) {
      others_.push_back(i);
      continue;
    }
    for (const OutputByte& byte : bytes) reinterpret_cast<uint8_t*>(mask_.data())[byte.offset] = 0xFF;
    outputBytes_.insert(outputBytes_.end(), bytes.begin(), bytes.end());
  }
  std::ranges::sort(outputBytes_, {}, &OutputByte::offset);
}

// ---- the scan thread ---------------------------------------------------------------------------------------------

ReplaceResult Shadow::begin(Instance& live) noexcept {
  if (&live.program() != &live_ || recording_ != ShadowState::Prepared) return ReplaceResult::OtherProgram;
  if (!live.atListStart()) return ReplaceResult::WithinScan;
  const std::span<const uint8_t> block = std::as_const(live).block();
  if (transfer_.waiting(block.data()) != nullptr) return ReplaceResult::MechanismWaits;
  std::memcpy(start_.before.data(), block.data(), block.size());
  start_.nowUs = live.nowUs();
  endUs_ = live.nowUs() + lengthUs_;
  for (uint32_t i = 0; i < core::ServiceQueue::kRecords; ++i) {
    known_[i] = live.services().record(i);
    if (known_[i].state == RUNG_SERVICE_PENDING) open_[openCount_++] = known_[i].ticket;
  }
  live.setTaskWatch(this);
  recording_.store(ShadowState::Running, std::memory_order_release);
  return ReplaceResult::Replaced;
}

void Shadow::end(Instance& live) noexcept {
  live.setTaskWatch(nullptr);
  finish(ShadowState::Stopped);
}

void Shadow::finish(ShadowState state) noexcept {
  ShadowState running = ShadowState::Running;
  recording_.compare_exchange_strong(running, state);
}

void Shadow::begins(const Instance& live, uint32_t task) {
  current_ = nullptr;
  if (recording_ != ShadowState::Running) return;
  if (&live.program() != &live_) return finish(ShadowState::Stopped);
  if (live.nowUs() > endUs_) return finish(ShadowState::Finished);
  const std::optional<size_t> slot = ring_.back();
  if (!slot) return finish(ShadowState::TooSlow);
  current_ = &records_[*slot];
  current_->task = task;
  current_->nowUs = live.nowUs();
  current_->requestCount = 0;
  current_->refused = live.services().refused();
  current_->answerCount = 0;
  for (uint32_t i = 0; i < openCount_;) {
    const core::ServiceRecord& record = live.services().record(open_[i] % core::ServiceQueue::kRecords);
    if (record.ticket == open_[i] && record.state == RUNG_SERVICE_PENDING) {
      ++i;
      continue;
    }
    current_->answers[current_->answerCount++] = record;
    open_[i] = open_[--openCount_];
  }
  noteForced(live);
  std::memcpy(current_->before.data(), live.block().data(), live_.memory_size);
}

void Shadow::noteForced(const Instance& live) noexcept {
  std::vector<uint8_t>& forced = current_->forced;
  if (current_->hasForced) std::memset(forced.data(), 0, forced.size());
  current_->hasForced = live.forced();
  for (const core::ForcedBits& bits : live.forcedBits()) forced[bits.offset] = bits.mask;
}

void Shadow::requested(const core::ServiceRequest& request) noexcept {
  if (current_ == nullptr) return;
  if (current_->requestCount == kMostRequests) {
    current_ = nullptr; // this run is not recorded, and none after it
    return finish(ShadowState::TooSlow);
  }
  current_->requests[current_->requestCount++] = {.request = request};
}

void Shadow::ended(const Instance& live, uint32_t) {
  if (current_ == nullptr) return;
  if (live.fault().code != RUNG_NONE) return finish(ShadowState::Stopped);
  current_->refused = live.services().refused() - current_->refused;
  for (uint32_t i = 0; i < current_->requestCount; ++i) {
    const uint32_t ticket = current_->requests[i].request.ticket;
    current_->atOnce[i] = live.services().record(ticket % core::ServiceQueue::kRecords);
    if (current_->atOnce[i].state == RUNG_SERVICE_PENDING && openCount_ < open_.size()) open_[openCount_++] = ticket;
  }
  std::memcpy(current_->after.data(), live.block().data(), live_.memory_size);
  ring_.push();
}

// ---- the other thread --------------------------------------------------------------------------------------------

bool Shadow::work() {
  if (runner_.faulted()) return false;
  if (!begun_) {
    if (recording_.load(std::memory_order_acquire) == ShadowState::Prepared) return false;
    transfer_.run(start_.before.data(), next_.block.get());
    transfer_.run(start_.before.data(), former_.data());
    runner_.advance(start_.nowUs - runner_.nowUs());
    begun_ = true;
  }
  const std::optional<size_t> slot = ring_.front();
  if (!slot) return false;
  Record& record = records_[*slot];
  takeChanges(record);
  holdForced(record, present_);
  runTask(record);
  transfer_.run(record.after.data(), former_.data());
  holdForced(record, former_);
  if (!runner_.faulted()) compare(record);
  ++runs_;
  ring_.pop();
  return true;
}

// Applies changes by other writers between the end of the last run and the beginning of this one.
void Shadow::takeChanges(const Record& record) {
  transfer_.run(record.before.data(), present_.data());
  uint8_t* block = next_.block.get();
  for (size_t i = 0; i < present_.size(); ++i) {
    const auto changed = static_cast<uint8_t>(former_[i] ^ present_[i]);
    block[i] = static_cast<uint8_t>((block[i] & ~changed) | (present_[i] & changed));
  }
  for (uint32_t i = 0; i < record.answerCount; ++i)
    known_[record.answers[i].ticket % core::ServiceQueue::kRecords] = record.answers[i];
}

// Forces the bits to the running program's `values`, laid out as the new program's block.
void Shadow::holdForced(const Record& record, const std::vector<uint8_t>& values) {
  if (!record.hasForced) return;
  std::ranges::fill(forced_, uint8_t{0});
  transfer_.run(record.forced.data(), forced_.data());
  uint8_t* block = next_.block.get();
  for (size_t i = 0; i < forced_.size(); ++i)
    block[i] = static_cast<uint8_t>((block[i] & ~forced_[i]) | (values[i] & forced_[i]));
}

void Shadow::runTask(Record& record) {
  running_ = &record;
  runner_.advance(record.nowUs - runner_.nowUs());
  const uint32_t task = tasks_[record.task];
  if (inParts_[record.task])
    runner_.runPart(task);
  else
    runner_.runTask(task);
  running_ = nullptr;
}

// Compares with the running program's memory after its run, which is in `former_` in the new program's layout.
void Shadow::compare(const Record& record) {
  different_.clear();
  const uint8_t* block = next_.block.get();
  for (size_t word = 0; word < mask_.size(); ++word) {
    if (mask_[word] == 0) continue;
    const size_t at = word * sizeof(uint64_t);
    const size_t bytes = std::min(sizeof(uint64_t), former_.size() - at);
    uint64_t a = 0, b = 0;
    std::memcpy(&a, former_.data() + at, bytes);
    std::memcpy(&b, block + at, bytes);
    if (((a ^ b) & mask_[word]) == 0) continue;
    auto output = std::ranges::lower_bound(outputBytes_, at, {}, &OutputByte::offset);
    for (; output != outputBytes_.end() && output->offset < at + bytes; ++output) different_.push_back(output->output);
  }
  std::ranges::sort(different_);
  const auto twice = std::ranges::unique(different_);
  different_.erase(twice.begin(), twice.end());
  for (const uint32_t output : different_) compareOutput(record, outputs_[output]);
  for (const uint32_t output : others_) compareOutput(record, outputs_[output]);
}

void Shadow::compareOutput(const Record& record, const Output& output) {
  // The blocks are only read here.
  const uint64_t live = readRaw(core::Memory(live_, const_cast<uint8_t*>(record.after.data())), output.live);
  const uint64_t next = readRaw(core::Memory(*next_.program, next_.block.get()), output.next);
  if (live == next) return;
  if (!output.name.empty()) return note(output.name, false, record, output.next, live, next);
  compareBits(record, output, live, next);
}

void Shadow::compareBits(const Record& record, const Output& output, uint64_t live, uint64_t next) {
  for (uint32_t bit = 0; bit < 8; ++bit) {
    const uint64_t a = live >> bit & 1, b = next >> bit & 1;
    if (a == b) continue;
    const Ref ref = bitRef(output.next.space, output.next.byte, bit);
    note(describe_(*next_.program, ref), false, record, ref, a, b);
  }
}

void Shadow::note(const std::string& name, bool service, const Record& record, const Ref& ref, uint64_t live,
                  uint64_t next) {
  ShadowDifference& difference = differences_[name];
  if (difference.runs++ > 0) return;
  difference.name = name;
  difference.service = service;
  difference.firstUs = record.nowUs;
  difference.ref = ref;
  difference.live = live;
  difference.next = next;
}

ShadowState Shadow::state() const {
  if (runner_.faulted()) return ShadowState::Faulted;
  const ShadowState state = recording_;
  return state != ShadowState::Prepared && !ring_.empty() ? ShadowState::Running : state;
}

std::string Shadow::faultText() const { return runtime::faultText(*next_.program, runner_.fault()); }

std::vector<ShadowDifference> Shadow::differences() const {
  std::vector<ShadowDifference> all;
  for (const auto& [name, difference] : differences_) all.push_back(difference);
  return all;
}

// ---- requests of the new program ---------------------------------------------------------------------------------

const core::ServiceRecord* Shadow::recordOf(uint32_t ticket) const {
  const core::ServiceRecord& record = known_[ticket % core::ServiceQueue::kRecords];
  return ticket != 0 && record.ticket == ticket ? &record : nullptr;
}

uint32_t Shadow::serviceRequest(rung_ctx* ctx, uint32_t service, const int64_t* args, uint32_t count) {
  Shadow& self = of(ctx);
  Record& record = *self.running_;
  const uint32_t live = self.services_[service];
  for (uint32_t i = 0; i < record.requestCount; ++i) {
    Request& request = record.requests[i];
    const std::span<const int64_t> theirs(request.request.args, request.request.argCount);
    if (request.taken || request.request.service != live || !std::ranges::equal(theirs, std::span(args, count)))
      continue;
    request.taken = true;
    self.known_[record.atOnce[i].ticket % core::ServiceQueue::kRecords] = record.atOnce[i];
    return record.atOnce[i].ticket;
  }
  if (record.refused > 0) return --record.refused, 0;
  self.note(std::string(serviceName(*self.next_.program, service)), true, record, {}, 0, 0);
  self.asksAlone_ = true;
  return kUnanswered;
}

uint32_t Shadow::servicePoll(rung_ctx* ctx, uint32_t ticket) {
  if (ticket == kUnanswered && of(ctx).asksAlone_) return RUNG_SERVICE_PENDING;
  const core::ServiceRecord* record = of(ctx).recordOf(ticket);
  return record != nullptr ? record->state : uint32_t{RUNG_SERVICE_NONE};
}

int64_t Shadow::serviceResult(rung_ctx* ctx, uint32_t ticket, uint32_t index) {
  const core::ServiceRecord* record = of(ctx).recordOf(ticket);
  return record != nullptr && index < record->resultCount ? record->results[index] : 0;
}

// Comparison of instances: fast if all is equal (one memcmp), detailed if not.

namespace {

using Difference = std::optional<std::string>;

std::string values(uint64_t here, uint64_t there) {
  return ": " + std::to_string(here) + " here, " + std::to_string(there) + " there";
}

// Names the byte, or the bit if only one differs.
std::string byteDifference(const rung_program& program, LogicalByte at, uint8_t here, uint8_t there,
                           DescribePlace describe) {
  const uint32_t changed = here ^ there;
  for (uint32_t bit = 0; bit < 8; ++bit)
    if (changed == 1u << bit)
      return describe(program, bitRef(at.space, at.byte, bit)) + values((here >> bit) & 1, (there >> bit) & 1);
  return describe(program, intRef(at.space, at.byte, 8)) + values(here, there);
}

Difference rawDifference(const Instance& here, const Instance& there, DescribePlace describe) {
  const auto a = here.block();
  const auto b = there.block();
  if (std::memcmp(a.data(), b.data(), a.size()) == 0) return std::nullopt;
  const auto place = std::mismatch(a.begin(), a.end(), b.begin());
  const auto offset = static_cast<uint32_t>(place.first - a.begin());
  if (const std::optional<LogicalByte> at = byteAt(here.program(), offset)) {
    const uint8_t valueHere = here.memory().readByte(at->space, at->byte);
    const uint8_t valueThere = there.memory().readByte(at->space, at->byte);
    if (valueHere != valueThere) return byteDifference(here.program(), *at, valueHere, valueThere, describe);
  }
  // The byte belongs to a slot of the compiler, or to an expanded bit that is neither 0 nor 1.
  return "memory at offset " + std::to_string(offset) + values(a[offset], b[offset]);
}

Difference logicalDifference(const Instance& here, const Instance& there, DescribePlace describe) {
  const rung_program& p = here.program();
  if (p.space_count != there.program().space_count) return "the programs have different spaces";
  for (uint32_t s = 0; s < p.space_count; ++s) {
    if (p.spaces[s].byte_count != there.program().spaces[s].byte_count)
      return "space " + std::string(p.spaces[s].name) + " has different sizes";
    for (uint32_t byte = 0; byte < p.spaces[s].byte_count; ++byte) {
      const uint8_t a = here.memory().readByte(s, byte);
      const uint8_t b = there.memory().readByte(s, byte);
      if (a != b) return byteDifference(p, {s, byte}, a, b, describe);
    }
  }
  return std::nullopt;
}

// Rungs are compared by key, because compilers may order them differently.
uint64_t rungKey(const Instance& instance, uint32_t rung) {
  return rung < instance.program().rung_count ? instance.program().rungs[rung].key : 0;
}

Difference faultDifference(const Instance& here, const Instance& there) {
  const rung_fault& a = here.fault();
  const rung_fault& b = there.fault();
  if (here.faulted() == there.faulted() && a.code == b.code && a.line == b.line && a.task == b.task &&
      rungKey(here, a.rung) == rungKey(there, b.rung))
    return std::nullopt;
  const auto text = [](const Instance& i) { return i.faulted() ? i.faultText() : std::string("no fault"); };
  return "fault: " + text(here) + " here, " + text(there) + " there";
}

bool sameText(const rung_message& a, const rung_message& b) {
  return a.op == b.op && a.number == b.number && a.channel == b.channel && a.index == b.index && a.value == b.value &&
         a.real == b.real;
}

Difference messageDifference(const Instance& one, const Instance& other) {
  const core::MessageQueue& here = one.messages();
  const core::MessageQueue& there = other.messages();
  if (here.size() != there.size()) return "waiting messages" + values(here.size(), there.size());
  if (here.lost() != there.lost()) return "lost messages" + values(here.lost(), there.lost());
  for (uint32_t i = 0; i < here.size(); ++i) {
    const rung_message& a = *here.peek(i);
    const rung_message& b = *there.peek(i);
    if (a.number != b.number) return "number of message " + std::to_string(i) + values(a.number, b.number);
    if (!sameText(a, b) || rungKey(one, a.rung) != rungKey(other, b.rung))
      return "message " + std::to_string(a.number) + ": contents differ";
  }
  return std::nullopt;
}

Difference serviceDifference(const Instance& here, const Instance& there) {
  const core::ServiceQueue& a = here.services();
  const core::ServiceQueue& b = there.services();
  if (a.waiting() != b.waiting()) return "waiting service requests" + values(a.waiting(), b.waiting());
  if (a.refused() != b.refused()) return "refused service requests" + values(a.refused(), b.refused());
  for (uint32_t i = 0; i < a.waiting(); ++i)
    if (*a.peek(i) != *b.peek(i))
      return "service request " + std::to_string(i) + " (" +
             std::string(serviceName(here.program(), a.peek(i)->service)) + "): contents differ";
  for (uint32_t i = 0; i < core::ServiceQueue::kRecords; ++i)
    if (a.record(i) != b.record(i))
      return "service ticket " + std::to_string(a.record(i).ticket) + ": state or results differ";
  return std::nullopt;
}

} // namespace

std::optional<std::string> firstDifference(const Instance& here, const Instance& there, DescribePlace describe) {
  const bool sameLayout = here.program().layout_hash == there.program().layout_hash &&
                          here.program().memory_size == there.program().memory_size;
  if (Difference d = faultDifference(here, there)) return d;
  if (Difference d = sameLayout ? rawDifference(here, there, describe) : logicalDifference(here, there, describe))
    return d;
  if (here.nowUs() != there.nowUs())
    return "clock: " + std::to_string(here.nowUs()) + " us here, " + std::to_string(there.nowUs()) + " us there";
  if (Difference d = messageDifference(here, there)) return d;
  return serviceDifference(here, there);
}

} // namespace rung::runtime
