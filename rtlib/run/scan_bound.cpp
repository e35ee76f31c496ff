// The weight of slices, and the cost of code and copies (see scan_bound.h).
#include "rtlib/run/scan_bound.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include "rtlib/core/float_environment.h"
#include "rtlib/core/queues.h"
#include "rtlib/core/runner.h"
#include "rtlib/load/program_info.h"
#include "rtlib/run/realtime.h"

namespace rung::runtime {
namespace {

constexpr int kSweeps = 3;            // the fastest one counts, to exclude interruptions
constexpr uint32_t kPieceWeight = 64; // enough to make the cost of reading the clock negligible

struct Slice {
  uint64_t weight = 0;
  int64_t periodNs = 0;
  bool loops = false;
};

uint64_t timesOf(const rung_step& step, const rung_task& task) {
  return step.op == RUNG_STEP_RUN ? uint64_t{task.part_count} * step.arg : 1;
}

// The slices run by a real clock, from one ADVANCE to the next. Steps before the first ADVANCE directly follow the last
// slice.
std::vector<Slice> slicesOf(const rung_program& program) {
  std::span<const rung_step> list(program.slices, program.slice_count);
  if (list.empty()) list = {program.scan, program.scan_count};
  std::vector<Slice> slices;
  std::vector<int64_t> delays;
  Slice before;
  for (const rung_step& step : list) {
    if (step.op == RUNG_STEP_ADVANCE) {
      slices.emplace_back();
      delays.push_back(int64_t{step.arg} * 1000);
    }
    if (step.op != RUNG_STEP_RUN && step.op != RUNG_STEP_PART) continue;
    const rung_task& task = program.tasks[step.task];
    Slice& slice = slices.empty() ? before : slices.back();
    const uint64_t times = timesOf(step, task);
    slice.weight += task.longest * times;
    slice.loops = slice.loops || task.loops != 0;
  }
  if (slices.empty()) {
    before.periodNs = static_cast<int64_t>(scanPeriodUs(program)) * 1000;
    return {before};
  }
  slices.back().weight += before.weight;
  slices.back().loops = slices.back().loops || before.loops;
  for (size_t i = 0; i < slices.size(); ++i) slices[i].periodNs = delays[(i + 1) % delays.size()];
  return slices;
}

// Consecutive chunks whose total weight is large enough to be measured.
struct Piece {
  uint32_t first = 0;
  uint32_t end = 0;
  double nsPerWeight = std::numeric_limits<double>::max(); // in the fastest sweep
};

class Measurement {
public:
  explicit Measurement(const Runnable& runnable)
      : program_(runnable.program), loaded_({runnable.program, runnable.engine}) {
    ctx_.host = &core::hostApi();
    ctx_.host_data = port_.get();
    ctx_.prof = loaded_.counters();
    ctx_.engine = runnable.engine;
  }

  // The piece with the highest cost per weight, with initial contents and with arbitrary ones.
  Piece dearest() {
    const core::FloatEnvironment environment(defaultFloats_);
    Piece most{.nsPerWeight = 0};
    for (const bool scattered : {false, true}) {
      loaded_.clear();
      if (scattered) scatter();
      std::vector<Piece> pieces = cut();
      for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (Piece& piece : pieces) piece.nsPerWeight = std::min(piece.nsPerWeight, run(piece));
      for (const Piece& piece : pieces)
        if (piece.nsPerWeight > most.nsPerWeight) most = piece;
    }
    return most;
  }

  // The time of a slice without its chunks: process-image copies and schedule.
  int64_t longestRest() {
    const std::vector<rung_chunk_fn> idle(program_.chunk_count,
                                          [](uint8_t*, rung_ctx*, uint32_t) -> uint32_t { return RUNG_PC_DONE; });
    loaded_.clear();
    core::Runner runner(program_, loaded_.block.get(), ctx_, loaded_.parts.data());
    runner.force({.functions = idle.data(), .engine = nullptr}, {});
    std::vector<int64_t> fastest;
    for (int pass = 0; pass < kSweeps; ++pass) {
      for (size_t slice = 0; slice == 0 || !runner.atListStart(); ++slice) {
        const int64_t begin = monotonicNs();
        runner.slice();
        const int64_t ns = monotonicNs() - begin;
        if (slice == fastest.size()) fastest.push_back(ns);
        fastest[slice] = std::min(fastest[slice], ns);
        if (runner.faulted()) return std::ranges::max(fastest); // a chunk exceeds its task's budget
      }
    }
    return std::ranges::max(fastest);
  }

private:
  std::vector<Piece> cut() const {
    std::vector<Piece> pieces;
    uint32_t weight = kPieceWeight;
    for (uint32_t chunk = 0; chunk < program_.chunk_count; ++chunk) {
      if (weight >= kPieceWeight) {
        pieces.push_back({.first = chunk});
        weight = 0;
      }
      pieces.back().end = chunk + 1;
      weight += program_.chunks[chunk].weight;
    }
    if (pieces.size() < 2 || weight >= kPieceWeight) return pieces;
    pieces[pieces.size() - 2].end = pieces.back().end;
    pieces.pop_back();
    return pieces;
  }

  // Runs each chunk separately, as if it had been called.
  double run(const Piece& piece) {
    uint64_t weight = 0;
    const int64_t begin = monotonicNs();
    for (uint32_t chunk = piece.first; chunk < piece.end; ++chunk) {
      ctx_.stack[0] = RUNG_PC_DONE;
      ctx_.sp = 1;
      ctx_.extra_weight = 0;
      program_.chunk_fns[chunk](loaded_.block.get(), &ctx_, chunk);
      weight += program_.chunks[chunk].weight + ctx_.extra_weight;
    }
    const int64_t ns = monotonicNs() - begin;
    port_->messages.drop();
    port_->services.restart();
    return static_cast<double>(ns) / static_cast<double>(weight);
  }

  // Fills the spaces with arbitrary contents, which are always the same.
  void scatter() {
    uint32_t random = 1;
    for (const rung_space& space : std::span(program_.spaces, program_.space_count))
      for (const rung_range& range : std::span(space.ranges, space.range_count)) {
        const bool bits = range.repr == RUNG_REPR_BYTE_PER_BIT;
        for (uint32_t i = 0; i < range.byte_count * (bits ? 8 : 1); ++i) {
          random = random * 1664525 + 1013904223;
          loaded_.block.get()[range.offset + i] = static_cast<uint8_t>(bits ? random >> 31 : random >> 24);
        }
      }
  }

  const rung_program& program_;
  LoadedProgram loaded_;
  std::unique_ptr<core::HostPort> port_ = std::make_unique<core::HostPort>();
  rung_ctx ctx_{};
  bool defaultFloats_ = false;
};

std::string shownTime(double ns) {
  const char* unit = "ns";
  for (const char* next : {"us", "ms", "s"}) {
    if (ns < 1000) break;
    ns /= 1000;
    unit = next;
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %s", ns, unit);
  return text;
}

} // namespace

ScanBound measureBound(const Runnable& runnable) {
  const rung_program& program = runnable.program;
  Measurement measurement(runnable);
  const Piece dearest = measurement.dearest();
  const int64_t rest = measurement.longestRest();
  ScanBound bound;
  double fullest = -1;
  for (const Slice& slice : slicesOf(program)) {
    const double ns = static_cast<double>(slice.weight) * dearest.nsPerWeight + static_cast<double>(rest);
    bound.loops = bound.loops || slice.loops;
    const double full = slice.periodNs == 0 ? 0 : ns / static_cast<double>(slice.periodNs);
    if (full <= fullest) continue;
    fullest = full;
    bound = {.weight = slice.weight,
             .nsPerWeight = dearest.nsPerWeight,
             .rung = program.chunk_count == 0 ? uint32_t{RUNG_NONE} : program.chunks[dearest.first].first_rung,
             .ns = static_cast<int64_t>(ns),
             .periodNs = slice.periodNs,
             .loops = bound.loops};
  }
  return bound;
}

std::string boundText(const ScanBound& bound, const rung_program& program) {
  std::string text = shownTime(static_cast<double>(bound.ns)) + ": " + std::to_string(bound.weight) + " steps of " +
                     shownTime(bound.nsPerWeight) + " at most";
  if (bound.rung < program.rung_count) text += " (" + rungText(program, bound.rung) + ")";
  if (bound.periodNs > 0) text += ", and the period is " + shownTime(static_cast<double>(bound.periodNs));
  return text;
}

} // namespace rung::runtime
