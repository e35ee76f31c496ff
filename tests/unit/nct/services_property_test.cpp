// MR and MW with random EN signals, blocks and answers against a small model of the protocol (man. 6.18): every scan
// the requests, outputs and all words of the user memory, on every engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include <fmt/format.h>

#include "rtlib/nc/control/nct/nct_control.h"
#include "rtlib/nc/nct/operand_block.h"
#include "rtlib/nc/nct/service_functions.h"
#include "tests/unit/nct/machines.h"

namespace rung::frontend::nct::test {
namespace {

constexpr uint32_t kEnables = 7000; // bit n: EN of box n
constexpr uint32_t kOutputs = 7001;
constexpr uint32_t kFirstIndex = 7010; // register of box n
constexpr uint32_t kFirstFunction = 7020;
constexpr uint32_t kFirstOutput = 900; // words below may be inputs, which the NC writes again in every cycle
constexpr uint32_t kMemoryEnd = 10000;

struct Box {
  bool write;
  uint32_t base;
  bool indexed;
  int32_t function; // 0: in a word
};
constexpr Box kBoxes[] = {{false, 7100, false, 10}, {true, 7200, false, 34},  {false, 7300, true, 31},
                          {true, 7400, true, 0},    {false, 7500, false, 0},  {false, 9990, false, 309},
                          {true, 9999, false, 61},  {false, 7100, false, 104}};
constexpr size_t kBoxCount = std::size(kBoxes);

std::string program() {
  std::string text;
  for (uint32_t n = 0; n < kBoxCount; ++n) {
    const Box& box = kBoxes[n];
    const std::string index = box.indexed ? fmt::format(",{}", kFirstIndex + n) : "";
    const std::string function =
        box.function != 0 ? fmt::format("#{}", box.function) : fmt::format("{}", kFirstFunction + n);
    text += fmt::format("rung\n|--[{}.{:02}]--{{{} {}{} {}}}--({}.{:02})\n", kEnables, n, box.write ? "MW" : "MR",
                        box.base, index, function, kOutputs, n);
  }
  return text;
}

using Memory = std::vector<uint32_t>;

struct Answer {
  int32_t code = 0;
  std::map<uint32_t, uint32_t> words;
};

// What one box does, as the manual and the rules of the dialect tell it.
class BoxModel {
public:
  struct Request {
    int32_t function;
    uint32_t first;
    std::vector<uint32_t> words;
  };

  explicit BoxModel(uint32_t number) : number_(number), box_(kBoxes[number]) {}
  // Gives the output; a new request goes to `asked`.
  bool evaluate(Memory& memory, bool& failed, std::optional<Request>& asked);
  void answer(Answer answer) { answer_ = std::move(answer); }

private:
  enum class State { Idle, Pending, Done, Dropped };
  bool begin(Memory& memory, bool& failed, std::optional<Request>& asked);

  uint32_t number_;
  const Box& box_;
  State state_ = State::Idle;
  uint32_t first_ = 0;
  std::optional<Answer> answer_; // visible now
};

bool BoxModel::evaluate(Memory& memory, bool& failed, std::optional<Request>& asked) {
  const bool enabled = (memory[kEnables] >> number_ & 1) != 0;
  if (!enabled && state_ == State::Pending) state_ = State::Dropped;
  if (state_ == State::Dropped && answer_) {
    answer_.reset();
    state_ = State::Idle;
  }
  if (!enabled) {
    if (state_ == State::Done) state_ = State::Idle;
    return false;
  }
  if (state_ == State::Idle) return begin(memory, failed, asked);
  if (state_ == State::Pending && answer_) {
    for (const auto& [word, value] : answer_->words)
      if (first_ + word < kMemoryEnd) memory[first_ + word] = value;
    memory[first_] = static_cast<uint32_t>(answer_->code);
    answer_.reset();
    state_ = State::Done;
  }
  return state_ == State::Done;
}

bool BoxModel::begin(Memory& memory, bool& failed, std::optional<Request>& asked) {
  const int64_t offset = box_.indexed ? static_cast<int32_t>(memory[kFirstIndex + number_]) : 0;
  const int64_t first = box_.base + offset;
  if (first < 1 || first >= kMemoryEnd) {
    failed = true;
    return false;
  }
  first_ = static_cast<uint32_t>(first);
  const int32_t code = box_.function != 0 ? box_.function : static_cast<int32_t>(memory[kFirstFunction + number_]);
  const nc::nct::ServiceFunction* function = nc::nct::findServiceFunction(code);
  const auto wanted = box_.write ? nc::nct::FunctionAccess::Write : nc::nct::FunctionAccess::Read;
  std::optional<uint32_t> refusal;
  if (first_ + 1 >= kMemoryEnd || uint64_t{first_} + 1 + memory[first_ + 1] >= kMemoryEnd) refusal = 2;
  if (function == nullptr || function->access != wanted) refusal = 1;
  if (refusal) {
    memory[first_] = *refusal;
    state_ = State::Done;
    return true;
  }
  Request request{code, first_, {}};
  for (uint32_t n = 0; n < 16; ++n) request.words.push_back(first_ + n < kMemoryEnd ? memory[first_ + n] : 0);
  asked = request;
  state_ = State::Pending;
  return false;
}

// One engine's requests, in their order.
std::vector<core::ServiceRequest> takeAll(runtime::Instance& instance) {
  std::vector<core::ServiceRequest> all;
  core::ServiceRequest request;
  while (instance.services().take(request)) all.push_back(request);
  return all;
}

runtime::Ref bufferWord(const runtime::Instance& instance, const core::ServiceRequest& request, uint32_t n) {
  const uint32_t space = runtime::findSpace(instance.program(), nc::nct::kBlockSpace);
  return runtime::intRef(space, (static_cast<uint32_t>(request.args[2]) + n) * 4, 32);
}

void writeAnswer(runtime::Instance& instance, const core::ServiceRequest& request, const Answer& answer) {
  std::vector<uint32_t> words(nc::nct::kBlockStride);
  for (uint32_t n = 0; n < words.size(); ++n)
    words[n] = static_cast<uint32_t>(instance.read(bufferWord(instance, request, n)));
  nc::nct::Block block(words);
  for (const auto& [n, value] : answer.words) block.setWord(n, static_cast<int32_t>(value));
  for (uint32_t n = 0; n < words.size(); ++n)
    runtime::writeRaw(instance.memory(), bufferWord(instance, request, n), words[n]);
  core::ServiceReply reply{.ticket = request.ticket, .resultCount = 1};
  reply.results[0] = answer.code;
  EXPECT_TRUE(instance.services().complete(reply));
}

class Protocol {
public:
  Protocol() : machines_(program()), memory_(kMemoryEnd) {
    for (uint32_t n = 0; n < kBoxCount; ++n) boxes_.emplace_back(n);
  }
  void step();
  bool hasAsked(uint32_t box) const { return asked_ >> box & 1; }

private:
  // A request that every engine has made and nobody has answered.
  struct Open {
    uint32_t box;
    std::vector<core::ServiceRequest> byMachine;
  };
  uint32_t below(uint32_t n) { return std::uniform_int_distribution<uint32_t>(0, n - 1)(random_); }
  void set(uint32_t word, uint32_t value) {
    memory_[word] = value;
    for (Machine& machine : machines_.all()) machine.setWord(word, value);
  }
  void disturb();
  void answerSome();
  void checkRequests(const std::vector<std::pair<uint32_t, BoxModel::Request>>& expected);

  std::mt19937 random_{20};
  Machines machines_;
  Memory memory_;
  std::vector<BoxModel> boxes_;
  std::vector<Open> open_;
  std::vector<std::pair<uint32_t, Answer>> delivered_; // visible in the next scan
  uint32_t asked_ = 0;
};

void Protocol::disturb() {
  for (uint32_t n = 0; n < kBoxCount; ++n) {
    if (below(3) == 0) set(kEnables, memory_[kEnables] ^ 1u << n);
    constexpr int32_t kIndices[] = {0, 0, 4, 9, -300, 2600, 2690, -6400, -7400, 100000};
    if (below(4) == 0) set(kFirstIndex + n, static_cast<uint32_t>(kIndices[below(std::size(kIndices))]));
    constexpr int32_t kFunctions[] = {10, 11, 31, 34, 309, 202, 0, -1, 12, 65536 + 10};
    if (below(4) == 0) set(kFirstFunction + n, static_cast<uint32_t>(kFunctions[below(std::size(kFunctions))]));
    constexpr uint32_t kAmounts[] = {0, 3, 7, 8, 9, 14, 2700, 0xFFFFFFFF, 0x7FFFFFFF};
    const uint32_t base = kBoxes[n].base;
    if (base + 1 < kMemoryEnd && below(2) == 0) set(base + 1, kAmounts[below(std::size(kAmounts))]);
    if (base + 9 < kMemoryEnd && below(2) == 0) set(base + 2 + below(8), static_cast<uint32_t>(random_()));
  }
}

void Protocol::answerSome() {
  while (!open_.empty() && below(3) != 0) {
    const uint32_t choice = below(static_cast<uint32_t>(open_.size()));
    Answer answer{.code = static_cast<int32_t>(below(400)), .words = {}};
    for (uint32_t i = below(5); i > 0; --i) answer.words[1 + below(14)] = static_cast<uint32_t>(random_());
    for (size_t i = 0; i < machines_.all().size(); ++i)
      writeAnswer(machines_.all()[i].instance(), open_[choice].byMachine[i], answer);
    delivered_.emplace_back(open_[choice].box, std::move(answer));
    open_.erase(open_.begin() + choice);
  }
}

void Protocol::checkRequests(const std::vector<std::pair<uint32_t, BoxModel::Request>>& expected) {
  std::vector<std::vector<core::ServiceRequest>> taken;
  for (Machine& machine : machines_.all()) {
    taken.push_back(takeAll(machine.instance()));
    ASSERT_EQ(taken.back().size(), expected.size()) << machine.name();
    for (size_t i = 0; i < expected.size(); ++i) {
      const BoxModel::Request& request = expected[i].second;
      EXPECT_EQ(taken.back()[i].args[0], request.function);
      EXPECT_EQ(taken.back()[i].args[1], request.first);
      for (uint32_t n = 0; n < request.words.size(); ++n)
        ASSERT_EQ(machine.instance().read(bufferWord(machine.instance(), taken.back()[i], n)), request.words[n])
            << machine.name() << " box " << expected[i].first << " word " << n << " of the block at " << request.first;
    }
  }
  for (size_t i = 0; i < expected.size(); ++i) {
    Open& open = open_.emplace_back(Open{expected[i].first, {}});
    for (const auto& requests : taken) open.byMachine.push_back(requests[i]);
  }
}

void Protocol::step() {
  disturb();
  answerSome();
  for (auto& [box, answer] : delivered_) boxes_[box].answer(std::move(answer));
  delivered_.clear();
  std::vector<std::pair<uint32_t, BoxModel::Request>> expected;
  bool failed = (memory_[0] & 1) != 0; // nothing clears FL_ER here
  for (uint32_t n = 0; n < kBoxCount; ++n) {
    std::optional<BoxModel::Request> asked;
    const bool output = boxes_[n].evaluate(memory_, failed, asked);
    memory_[kOutputs] = (memory_[kOutputs] & ~(1u << n)) | uint32_t{output} << n;
    if (!asked) continue;
    expected.emplace_back(n, *asked);
    asked_ |= 1u << n;
  }
  memory_[0] = failed ? 1 : 0;
  for (Machine& machine : machines_.all()) machine.instance().scan();
  const Machine& first = machines_.all().front();
  for (uint32_t word = 0; word < kMemoryEnd; ++word)
    if (word == 0 || word >= kFirstOutput) {
      ASSERT_EQ(first.word(word), memory_[word]) << word;
    }
  ASSERT_EQ(machines_.difference(), "");
  checkRequests(expected);
}

TEST(NctServices, FollowTheProtocolWhateverTheTiming) {
  Protocol protocol;
  for (int i = 0; i < 4000; ++i) {
    SCOPED_TRACE(i);
    protocol.step();
    if (::testing::Test::HasFatalFailure() || ::testing::Test::HasFailure()) return;
  }
  // 9999 has no room for an amount.
  for (uint32_t n = 0; n < kBoxCount; ++n) EXPECT_EQ(protocol.hasAsked(n), n != 6) << n;
}

TEST(NctServices, WaitForRoomInTheQueue) {
  constexpr uint32_t kMany = core::ServiceQueue::kMaxPending + 6;
  std::string text;
  for (uint32_t n = 0; n < kMany; ++n)
    text += fmt::format("rung\n|--[7000.00]--{{MW {} #61}}--({}.00)\n", 8000 + 4 * n, 7100 + n);
  Machines machines(text, Machines::interpreterAndJit());
  for (Machine& machine : machines.all()) {
    runtime::Instance& instance = machine.instance();
    machine.setWord(7000, 1);
    for (uint32_t n = 0; n < kMany; ++n) machine.setWord(8000 + 4 * n + 1, 1);
    instance.scan();
    std::vector<core::ServiceRequest> requests = takeAll(instance);
    ASSERT_EQ(requests.size(), core::ServiceQueue::kMaxPending);
    EXPECT_EQ(instance.services().refused(), 6u);
    instance.scan();
    ASSERT_TRUE(takeAll(instance).empty());
    for (const core::ServiceRequest& request : requests) writeAnswer(instance, request, {.code = 60, .words = {}});
    instance.scan();
    EXPECT_TRUE(machine.bit(7100, 0));
    EXPECT_EQ(machine.word(8000), 60u);
    EXPECT_FALSE(machine.bit(7100 + kMany - 1, 0));
    requests = takeAll(instance);
    ASSERT_EQ(requests.size(), 6u);
    EXPECT_EQ(requests.back().args[1], 8000 + 4 * (kMany - 1));
    for (const core::ServiceRequest& request : requests) writeAnswer(instance, request, {.code = 0, .words = {}});
    instance.scan();
    for (uint32_t n = 0; n < kMany; ++n) EXPECT_TRUE(machine.bit(7100 + n, 0)) << n;
    instance.scan();
    EXPECT_TRUE(takeAll(instance).empty());
  }
}

// A host without an NC: at once, or when it comes to it.
class Refusing final : public runtime::ScheduleHooks {
public:
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override {
    return control.respond(instance, request, reply);
  }
  nc::NctControl control;
};

TEST(NctServices, EndWhereNobodyAnswers) {
  const std::string text =
      "rung\n|--[7000.00]--{MR 7100 #10}--(7001.00)\nrung\n|--[7000.01]--{MACR 7200 #500 #0}--(7001.01)\n"
      "rung\n|--[7000.02]--{MACW #500 7200 #0}--(7001.02)\n"
      "rung\n|--[7000.03]--{SCP 7200 ActPosAx #1 #0}--(7001.03)\n";
  Refusing hooks;
  for (const bool later : {false, true}) {
    Machines machines(text, Machines::interpreterAndJit());
    for (Machine& machine : machines.all()) {
      if (!later) machine.instance().setHooks(&hooks);
      const auto scan = [&] {
        machine.instance().scan();
        for (const core::ServiceRequest& request : takeAll(machine.instance()))
          machine.instance().services().complete(hooks.control.refuse(request));
      };
      machine.setWord(7101, 3);
      machine.setReal(7200, 1.5);
      machine.setWord(7000, 1);
      scan();
      EXPECT_EQ(machine.word(7001), 0u);
      scan();
      EXPECT_EQ(machine.word(7001), 1u);
      EXPECT_EQ(machine.word(7100), 1u);
      EXPECT_FALSE(machine.bit(0, 0));
      for (const uint32_t box : {1u, 2u, 3u}) {
        machine.setWord(7000, 1u << box);
        scan();
        scan();
        EXPECT_EQ(machine.word(7001), 0u) << box;
        EXPECT_TRUE(machine.bit(0, 0)) << box;
        EXPECT_EQ(machine.real(7200), 1.5) << box;
        machine.setWord(0, 0);
        machine.setWord(7000, 0);
        scan();
      }
    }
  }
}

// The command is written or not, there and then.
TEST(NctServices, AxisCommandsAreRefusedAtOnce) {
  const std::string text =
      "rung\n|--[7000.00]--(AP_PLCR)\nrung\n|--[7000.01]--(AN_PLCA)\nrung\n|--[7000.01]--(AN_BEPTY)\n"
      "rung\n|--[7000.00]--{MOVCMND #0 #0 *0.0 *1.0}--(7001.00)\n";
  Refusing hooks;
  Machines machines(text, Machines::interpreterAndJit());
  for (Machine& machine : machines.all()) {
    machine.setWord(7000, 3);
    machine.instance().scan();
    EXPECT_TRUE(machine.bit(7001, 0));
    EXPECT_FALSE(machine.bit(0, 0));
    machine.instance().setHooks(&hooks);
    machine.instance().scan();
    EXPECT_FALSE(machine.bit(7001, 0));
    EXPECT_TRUE(machine.bit(0, 0));
  }
}

} // namespace
} // namespace rung::frontend::nct::test
