// Timing figures of a scan thread, counted by that thread and read by other threads.
#pragma once
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "machine/host/plc_host.h"
#include "machine/io/connections/connections.h"
#include "machine/io/host_devices.h"
#include "machine/rung-run/pins.h"
#include "rtlib/run/realtime.h"

namespace rung::rung_run {

using runtime::Step;

// Figures of all steps so far; each value is consistent, but they may be from different moments, as the thread
// continues to run.
struct StepFigures {
  uint64_t steps = 0;
  uint64_t overruns = 0; // steps that began at least a whole period late
  int64_t shortestPeriodNs = 0;
  int64_t longestPeriodNs = 0;
  int64_t late99Ns = 0; // 99 % of the steps began no later than this; at most 25 % too high
  int64_t late999Ns = 0;
  int64_t latestNs = 0;
  int64_t lastNs = 0;   // time of the last step
  int64_t meanNs = 0;   // mean time of a step
  int64_t took50Ns = 0; // half of the steps took no longer than this; at most 25 % too high
  int64_t took99Ns = 0;
  int64_t took999Ns = 0;
  struct Worst {
    int64_t tookNs = 0;
    int64_t beginNs = 0;
  };
  std::vector<Worst> worst; // the longest steps, at most three
};

class StepTimes {
public:
  // Scan thread: counts a step.
  void add(const Step& step, bool isOverrun) noexcept;
  // Any thread: the figures.
  StepFigures figures() const;
  uint64_t steps() const noexcept { return steps_.load(std::memory_order_relaxed); }

private:
  static constexpr size_t kWorst = 3;
  static constexpr size_t kClasses = 256;
  using Classes = std::array<std::atomic<uint64_t>, kClasses>; // numbers of steps, by how long something took
  static size_t classOf(int64_t ns) noexcept;
  static int64_t endOf(size_t number) noexcept;
  void addWorst(const Step& step) noexcept;
  static void count(Classes& classes, int64_t ns) noexcept;
  static int64_t quantileOf(const Classes& classes, uint64_t steps, double share, int64_t most);

  std::atomic<uint64_t> steps_{0}, overruns_{0};
  std::atomic<int64_t> shortest_{INT64_MAX}, longest_{0}, latest_{0}, last_{0}, sum_{0};
  Classes late_{}, took_{};
  struct WorstStep {
    std::atomic<int64_t> tookNs{0}, beginNs{0};
  };
  std::array<WorstStep, kWorst> worst_{}; // longest first
};

// The scan thread of a program on the computer's clock: one step of the host at each multiple of the period. Each step
// follows the reading of the connections' newest inputs and precedes the writing of their outputs.

struct ScanOptions {
  int64_t periodNs = 1'000'000;
  int64_t earlyNs = 0; // how long before a step is due the thread wakes; less than the period
  runtime::RealTimeOptions thread;
};

class ScanThread final : runtime::Steps {
public:
  ScanThread(host::PlcHost& host, const Pins& pins, io::Connections& connections, io::HostDevices& devices,
             const ScanOptions& options)
      : host_(host), pins_(pins), connections_(connections), devices_(devices), options_(options) {}
  ~ScanThread() override { end(); }
  ScanThread(const ScanThread&) = delete;
  ScanThread& operator=(const ScanThread&) = delete;

  // Returns "", or what the system does not permit.
  std::string start();
  // Ends the thread when the program needs no more steps: after a few steps at most, unless the program waits for its
  // machine.
  void end();
  // The same in two calls, because the scan thread may have to wait for the service thread.
  void beginEnd() noexcept { ending_ = true; }
  bool hasEnded() const noexcept { return ended_; }

  int64_t periodNs() const noexcept { return options_.periodNs; }
  uint64_t steps() const noexcept { return times_.steps(); } // so far
  StepFigures figures() const { return times_.figures(); }

private:
  void run(std::promise<std::string> begun);
  // Called by the step loop.
  int64_t dueAfter(int64_t dueNs, int64_t nowNs) noexcept override;
  void prepare(int64_t untilNs) noexcept override { host_.prefetch(untilNs); }
  void step(int64_t nowNs, int64_t elapsedNs) override;
  void stepped(const Step& step) override { times_.add(step, step.lateNs >= options_.periodNs); }
  bool ended() override { return ending_ && host_.powerOffDone(); }

  host::PlcHost& host_;
  const Pins& pins_;
  io::Connections& connections_;
  io::HostDevices& devices_;
  ScanOptions options_;
  std::thread thread_;
  std::atomic<bool> ending_{false};
  std::atomic<bool> ended_{false};
  StepTimes times_;
};

} // namespace rung::rung_run
