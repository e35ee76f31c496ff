// Compares two instances of one program that different engines run: memory, clock, fault, waiting messages, service
// requests and tickets. Profile counters are not compared.
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

// Returns the name of a bit or of an 8-bit integer as a user would write it.
using DescribePlace = std::string (*)(const rung_program& program, const Ref& place);

// The first difference, with its place described ("D10 (COUNT): 3 here, 4 there"); nothing if the instances agree. If
// the layouts differ, only the spaces are compared, not the compiler's own slots.
std::optional<std::string> firstDifference(const Instance& here, const Instance& there, DescribePlace describe);

// A shadow: a program that is to take over runs beside the running one, on the same inputs and answers, and differences
// of its outputs are reported before anything is replaced.
//
// The scan thread records every run of a task: the memory before and after it, the requests that the program made to
// its host, and the answers that it received. Another thread runs the new program on these records. Recording copies
// the memory block twice per run and never waits: if the other thread is late by more runs than there is room for, the
// shadow ends.
//
// A shadow has no effect outside: its memory is its own, and its messages and requests go nowhere. A request that the
// running program also made, in the same run, gets the same answers; any other request stays unanswered, and is
// reported.
//
// Values written by the machine, the NC and the host appear as changes of memory between two runs; the shadow gets them
// at the same point in time, by name and address as in a replacement. So the schedules must be equal. Forced cells of
// the running program have their values in the shadow, too, before and after each run.

enum class ShadowState : uint8_t {
  Prepared, // not begun
  Running,
  Finished, // it has run the requested number of scans
  TooSlow,  // a run found no room for its record
  Stopped,  // the running program was stopped by a fault, was replaced, or its host ended the shadow
  Faulted,  // the new program has stopped with a fault
};

struct ShadowDifference {
  std::string name; // of the output; for a request that only the new program makes, of the service
  bool service = false;
  int64_t firstUs = 0; // the program's clock at the first occurrence
  uint64_t runs = 0;   // runs of tasks after which it occurred
  Ref ref;             // in the new program
  uint64_t live = 0;   // the values at the first occurrence, as readRaw returns them
  uint64_t next = 0;
};

class Shadow final : public TaskWatch {
public:
  // `live` and `next` are programs of one dialect, which outlive the shadow. The shadow ends after `scans` scans; it
  // has room for the records of `room` runs of tasks.
  Shadow(const rung_program& live, const Runnable& next, DescribePlace describe, uint32_t scans, uint32_t room,
         const Naming& naming = {});

  // Why the two cannot run side by side; "" if they can.
  const std::string& problem() const { return problem_; }
  // The transfer that gives the new program its initial state.
  const StateTransfer& transfer() const { return transfer_; }

  // ---- scan thread; nothing here allocates or waits ----

  // Begins, between two scans: the shadow becomes the instance's task watch. The results are those of
  // Instance::replace.
  ReplaceResult begin(Instance& live) noexcept;
  // Ends: the shadow is no longer the instance's task watch. Recorded runs can still be executed.
  void end(Instance& live) noexcept;
  void begins(const Instance& live, uint32_t task) override;
  void ended(const Instance& live, uint32_t task) override;
  // Records a request of the running program.
  void requested(const core::ServiceRequest& request) noexcept;

  // ---- any one thread ----

  // Executes one recorded run in the new program. False: no record waits.
  bool work();
  // The results of the runs that have been executed.
  ShadowState state() const;
  uint64_t runs() const { return runs_; }
  std::string faultText() const; // of the new program; "" without a fault
  // Sorted by name.
  std::vector<ShadowDifference> differences() const;

private:
  static constexpr uint32_t kMostRequests = 32; // requests that one run may make
  struct Request {
    core::ServiceRequest request;
    bool taken = false; // by the new program
  };
  struct Record {
    uint32_t task = 0;
    int64_t nowUs = 0;
    std::vector<uint8_t> before, after; // memory blocks of the running program
    std::vector<uint8_t> forced;        // mask of its forced bits; all 0 if `hasForced` is false
    bool hasForced = false;
    std::array<Request, kMostRequests> requests;
    uint32_t requestCount = 0;
    uint32_t refused = 0;                                                     // requests that the queue refused
    std::array<core::ServiceRecord, core::ServiceQueue::kMaxPending> answers; // received before the run
    uint32_t answerCount = 0;
    std::array<core::ServiceRecord, kMostRequests> atOnce; // answers to `requests`, after the run
  };
  // An output cell of both programs; without a name it is a byte, whose bits are compared one by one.
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
  void findOutputs(const SymbolsByName& liveSymbols);
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
  std::vector<uint32_t> tasks_;    // tasks of the new program, by task of the running one
  std::vector<bool> inParts_;      // by task of the running one
  std::vector<uint32_t> services_; // services of the running program, by service of the new one
  std::vector<Output> outputs_;
  // Most outputs of the running program are compared all at once, at their places in the new program's block.
  std::vector<uint64_t> mask_;          // by bytes of that block: those of such outputs
  std::vector<OutputByte> outputBytes_; // of these outputs, ascending
  std::vector<uint32_t> others_;        // outputs that are compared one by one
  std::vector<uint32_t> different_;     // outputs that differ after a run

  // ---- both threads ----
  std::atomic<ShadowState> recording_{ShadowState::Prepared};
  std::vector<Record> records_;
  core::SlotRing ring_;                                                 // slots of `records_`
  Record start_;                                                        // memory (`before`) and answers at the start
  std::array<core::ServiceRecord, core::ServiceQueue::kRecords> known_; // tickets as the new program sees them

  // ---- scan thread ----
  Record* current_ = nullptr;
  int64_t endUs_ = 0;
  std::array<uint32_t, core::ServiceQueue::kMaxPending> open_{}; // unanswered tickets
  uint32_t openCount_ = 0;

  // ---- the thread that calls `work` ----
  rung_host_api api_{sizeof(rung_host_api), 0, message, serviceRequest, servicePoll, serviceResult};
  rung_ctx ctx_{};
  core::Runner runner_;
  bool begun_ = false;
  bool asksAlone_ = false; // it has made a request that the running program has not made
  Record* running_ = nullptr;
  std::vector<uint8_t> former_, present_; // the running program's memory, laid out as the new program's
  std::vector<uint8_t> forced_;           // the forced bits, laid out likewise
  uint64_t runs_ = 0;
  std::map<std::string, ShadowDifference> differences_;
};

} // namespace rung::runtime
