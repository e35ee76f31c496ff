// PLC tables in a thread of the host, which has their files, too: what the program asks are tickets that go there by a
// ring, and answers come back by another (man. l.18671: the instructions take several scans).
#pragma once
#include <array>
#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "machine/io/device_call.h"
#include "machine/io/tables/table_files.h"
#include "machine/io/tables/table_requests.h"
#include "rtlib/core/handover.h"

namespace rung::io {

class TableService {
public:
  // The longest that a request waits for the thread: the scan does not wake it.
  static constexpr int kPauseMs = 2;

  TableService() = default;
  ~TableService() { end(); }
  TableService(const TableService&) = delete;
  TableService& operator=(const TableService&) = delete;

  // ---- before start; "" or what is wrong, a line each
  std::string setDefinition(uint32_t table, const std::string& path) { return files_.setDefinition(table, path); }
  std::string setTable(uint32_t table, const std::string& path);
  std::string load() { return files_.load(tables_); }
  bool isEmpty() const { return !any_; } // no table is configured

  // ---- the thread that starts and ends the host
  void start();
  // What was asked is done, and what has changed is on disk; why not, unless it was said before, is the next
  // takeProblem.
  void end();
  // What went wrong with the files since the last call; "": nothing new. Any thread but the scan's.
  std::string takeProblem();

  // ---- the scan; nothing waits, allocates or locks
  // At a power-on: answers to earlier requests are dropped.
  void powerOn() noexcept { ++generation_; }
  // Within the instruction. False: no room for the request.
  bool ask(const DeviceCall& call) noexcept;
  // Between two scans. True: there were answers, which are to be delivered.
  bool takeAnswers(core::ServiceQueue& services, AnswerBytes& bytes) noexcept;

private:
  // A request and its answer, which go to the thread and come back.
  struct Slot {
    uint32_t generation = 0;
    core::ServiceRequest given;
    core::ServiceReply reply;
    uint32_t count = 0; // bytes of the program, then those of the answer
    std::array<uint8_t, nc::technol::kMostArgumentBytes> bytes{};
  };
  static constexpr uint32_t kSlots = core::ServiceQueue::kMaxPending; // no more can be unanswered
  class BytesOf;                                                      // of an answer

  void run() noexcept;
  void serve() noexcept;
  void note(std::string problem) noexcept;

  TableFiles files_;
  PlcTables tables_; // the thread's, from start to end
  bool any_ = false;
  uint32_t generation_ = 0;            // the scan's
  std::vector<Slot> slots_;            // none before the start
  std::array<uint8_t, kSlots> free_{}; // the scan's
  uint32_t freeCount_ = 0;
  core::FixedRing<uint8_t, kSlots> asked_, answered_; // numbers of slots
  std::atomic<bool> ending_{false};
  std::thread thread_;
  std::mutex mutex_; // never the scan's
  std::string problem_, noted_;
};

} // namespace rung::io
