// Whether two instances of one program, run by different engines, are in the same state: memory, clock, fault, messages
// that wait, service requests and tickets. Profile counters do not count.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rtlib/change/state_transfer.h"
#include "rtlib/core/queues.h"
#include "rtlib/core/runner.h"
#include "rtlib/run/instance.h"
#include "rtlib/run/loaded_program.h"

namespace rung::runtime {

// How a reader would write a bit, or the byte that an integer of 8 bits lies in.
using DescribePlace = std::string (*)(const rung_program& program, const Ref& place);

// The first difference, with the place described ("D10 (COUNT): 3 here, 4 there"); nothing when there is none. Layouts
// may differ; then only the spaces are compared, not the compiler's own slots.
std::optional<std::string> firstDifference(const Instance& here, const Instance& there, DescribePlace describe);

// A program that is to take over runs beside the one that it would replace, on what that one reads and is answered, and
// where its outputs differ is reported: before anything is replaced.
//
// The thread that scans records every run of a task: what the memory held before and after it, what the program asked
// its host and which answers came. Another thread runs the new program on that. Recording copies the memory block twice
// a run and never waits: where the other thread is late by more runs than there is room for, the shadow ends.
//
// Nothing of the shadow gets out: its memory is its own, messages and requests go nowhere. A request that the running
// program has made as well, in the same run, has that one's answers; any other stays unanswered, and is reported.
//
// What the machine, the NC and the host have written shows as what changed in memory between two runs; the shadow gets
// it at the same place in time, by name and address as a replacement would. So the schedules must be the same. What a
// person forces in the running program has its value in the shadow, too, before and after each run.

enum class ShadowState : uint8_t {
  Prepared, // not begun
  Running,
  Finished, // all passes are over
  TooSlow,  // there was no room for a run
  Stopped,  // the running program was stopped by a fault, was replaced, or its host ended the shadow
  Faulted,  // the new program
};

struct ShadowDifference {
  std::string name; // of the output; of a request that the new program alone makes: the service
  bool service = false;
  int64_t firstUs = 0; // the program's clock when it was seen first
  uint64_t runs = 0;   // of tasks after which it was seen
  Ref ref;             // in the new program
  uint64_t live = 0;   // the values that were seen first: bits, as readRaw gives them
  uint64_t next = 0;
};

class Shadow final : public TaskWatch {
public:
  // `live` and `next` are programs of one dialect and outlive the shadow. It ends after `passes` of the schedule;
  // `room`: for so many runs of tasks.
  Shadow(const rung_program& live, const Runnable& next, DescribePlace describe, uint32_t passes, uint32_t room);

  // Why the two cannot run side by side; "" when they can.
  const std::string& problem() const { return problem_; }
  // Which state the new program begins with.
  const StateTransfer& transfer() const { return transfer_; }

  // ---- the thread that scans; nothing here allocates or waits ----

  // Between two passes; the instance's task watch is the shadow from now on. Like a replacement.
  ReplaceResult begin(Instance& live) noexcept;
  // It stops being that. What is recorded can still be run.
  void end(Instance& live) noexcept;
  void begins(const Instance& live, uint32_t task) override;
  void ended(const Instance& live, uint32_t task) override;
  // The running program makes a request.
  void requested(const core::ServiceRequest& request) noexcept;

  // ---- one other thread, or the same ----

  // Runs what was recorded of one run. False: nothing waits.
  bool work();
  // Of what has been run.
  ShadowState state() const;
  uint64_t runs() const { return runs_; }
  std::string faultText() const; // of the new program; "" without a fault
  // By name.
  std::vector<ShadowDifference> differences() const;

private:
  static constexpr uint32_t kMostRequests = 32; // that one run makes
  struct Request {
    core::ServiceRequest request;
    bool taken = false; // by the new program
  };
  struct Record {
    uint32_t task = 0;
    int64_t nowUs = 0;
    std::vector<uint8_t> before, after; // memory blocks of the running program
    std::vector<uint8_t> forced;        // bits of it that a person holds; all 0 where `hasForced` is false
    bool hasForced = false;
    std::array<Request, kMostRequests> requests;
    uint32_t requestCount = 0;
    uint32_t refused = 0;                                                     // requests, beside those
    std::array<core::ServiceRecord, core::ServiceQueue::kMaxPending> answers; // that came before the run
    uint32_t answerCount = 0;
    std::array<core::ServiceRecord, kMostRequests> atOnce; // of the requests, after the run
  };
  // A cell that both programs have; without a name a byte, whose bits are compared.
  struct Output {
    Ref live, next;
    std::string name;
  };
  // A byte of the new program's block, and an output that lies there.
  struct OutputByte {
    uint32_t offset = 0;
    uint32_t output = 0;
  };

  std::string compareSchedules() const;
  void findOutputs();
  void finish(ShadowState state) noexcept;
  void noteForced(const Instance& live) noexcept;
  void takeChanges(const Record& record);
  void holdForced(const Record& record, const std::vector<uint8_t>& values);
  void runTask(Record& record);
  void indexOutputs();
  void compare(const Record& record);
  void compareOutput(const Record& record, const Output& output);
  void compareBits(const Record& record, const Output& output, uint64_t live, uint64_t next);
  void note(const std::string& name, bool service, const Record& record, const Ref& ref, uint64_t live, uint64_t next);

  static Shadow& of(rung_ctx* ctx) { return *static_cast<Shadow*>(ctx->host_data); }
  static void message(rung_ctx*, const rung_message*) {}
  static uint32_t serviceRequest(rung_ctx* ctx, uint32_t service, const int64_t* args, uint32_t count);
  static uint32_t servicePoll(rung_ctx* ctx, uint32_t ticket);
  static int64_t serviceResult(rung_ctx* ctx, uint32_t ticket, uint32_t index);
  const core::ServiceRecord* recordOf(uint32_t ticket) const;

  const rung_program& live_;
  LoadedProgram next_;
  StateTransfer transfer_;
  DescribePlace describe_;
  int64_t lengthUs_;
  std::string problem_;
  std::vector<uint32_t> tasks_;    // of the new program, by those of the running one
  std::vector<bool> inParts_;      // by those of the running one
  std::vector<uint32_t> services_; // of the running program, by those of the new one
  std::vector<Output> outputs_;
  // Most outputs of the running program can be compared where they come to lie in the new one's block: all at once.
  std::vector<uint64_t> mask_;          // of that block: bytes of such outputs
  std::vector<OutputByte> outputBytes_; // of these, ascending
  std::vector<uint32_t> others_;        // outputs that are compared one by one
  std::vector<uint32_t> different_;     // of a run

  // ---- both threads ----
  std::atomic<ShadowState> recording_{ShadowState::Prepared};
  std::vector<Record> records_;
  core::SlotRing ring_;                                                 // of `records_`
  Record start_;                                                        // `before`: where it began; its answers: all
  std::array<core::ServiceRecord, core::ServiceQueue::kRecords> known_; // what the new program knows of tickets

  // ---- the thread that scans ----
  Record* current_ = nullptr;
  int64_t endUs_ = 0;
  std::array<uint32_t, core::ServiceQueue::kMaxPending> open_{}; // tickets that are not answered
  uint32_t openCount_ = 0;

  // ---- the other ----
  rung_host_api api_{sizeof(rung_host_api), 0, message, serviceRequest, servicePoll, serviceResult};
  rung_ctx ctx_{};
  core::Runner runner_;
  bool begun_ = false;
  bool asksAlone_ = false; // has made a request that the running program has not made
  Record* running_ = nullptr;
  std::vector<uint8_t> former_, present_; // the running program's memory, as the new program's
  std::vector<uint8_t> forced_;           // the same of the bits that are forced
  uint64_t runs_ = 0;
  std::map<std::string, ShadowDifference> differences_;
};

} // namespace rung::runtime
