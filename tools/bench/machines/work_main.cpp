// rung-bench-work SCENARIO PIECE SCANS: what a recording of a machine at work takes, and whether it is played as
// it was. The scenario runs, then the statements of PIECE again and again, with the simulated control. Beside it the
// same program runs as in a host (replay.h) up to so many scans, and records what the machine writes. Then
// the recording is played, and a hash of all outputs compared after each scan with that of the run. Prints the figures
// as JSON.
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "compiler/embedded_ir.h"
#include "ir/support/temporary_folder.h"
#include "rtlib/load/block_bytes.h"
#include "rtlib/record/recording_file.h"
#include "rtlib/record/watched_bytes.h"
#include "tools/bench/machines/recorder.h"
#include "tools/replay/growing_recording.h"
#include "tools/replay/past.h"
#include "tools/scenario/runner.h"

namespace {

using namespace rung;

scenario::Scenario read(const std::string& path) {
  Result<scenario::Scenario> scenario = scenario::readScenario(path);
  if (!scenario.ok()) throw std::runtime_error(scenario.error());
  return std::move(scenario).value();
}

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) / 1e9;
}

// The outputs of a program, whose hash is taken after each scan.
runtime::WatchedBytes outputsOf(const rung_program& program) {
  runtime::BlockBytes bytes(program.memory_size);
  for (const rung_space& space : std::span(program.spaces, program.space_count)) {
    if ((space.flags & RUNG_SPACE_OUTPUT) == 0) continue;
    for (const rung_range& range : std::span(space.ranges, space.range_count))
      runtime::mark(bytes, range.offset, range.byte_count * (range.repr == RUNG_REPR_BYTE_PER_BIT ? size_t{8} : 1));
  }
  return {program, bytes};
}

class Work {
public:
  Work(const std::string& scenario, const std::string& piece, uint64_t scans)
      : scenario_(read(scenario)), piece_(read(piece)), scans_(scans) {
    if (!temporary_.ok()) throw std::runtime_error("cannot make a folder for the recording");
  }

  // The first pieces show which bytes the machine writes alone.
  void probe() {
    bench::Recording recording;
    run([&](bench::Part&& part) { recording.parts.push_back(std::move(part)); }, {}, kProbe);
    probe_ = std::move(recording);
  }

  void record() {
    const auto started = [&](bench::Recorder& recorder, const compiler::Compiled& program) {
      watched_.emplace(outputsOf(recorder.replay().inside().program()));
      recorder.replay().record(probe_, folder_);
      recorder.replay().addProgram(program.codeHash, compiler::irText(program));
    };
    const auto each = [&](bench::Part&&) {
      outputs_.push_back(watched_->hash(recorder_->replay().inside().block().data()));
      constexpr size_t kBlock = 80; // parts, as if each took a millisecond
      if (outputs_.size() % kBlock == 0) state_ = recorder_->replay().recorded();
    };
    run(each, started, scans_);
  }

  void play() {
    Result<replay::Recording> recording = replay::readRecording(folder_);
    if (!recording.ok()) throw std::runtime_error(recording.error());
    if (!recording.value().problems.empty()) throw std::runtime_error(recording.value().problems[0]);
    auto opened = replay::Past::open(recording.value(), {.engine = compiler::EngineKind::Jit});
    if (!opened.ok()) throw std::runtime_error(opened.error());
    replay::Past& past = *opened.value();
    states_ = past.contents().states.size();
    for (const replay::Segment& segment : recording.value().segments) events_ += segment.events.size();
    for (const replay::StatePoint& state : past.contents().states) events_ -= state.ends - state.begins;
    const double begin = cpuSeconds();
    uint64_t played = past.part();
    for (; past.next(); ++played)
      if (played < outputs_.size() && watched_->hash(past.instance().block().data()) != outputs_[played])
        ++differences_;
    playedSeconds_ = cpuSeconds() - begin;
    if (!past.problem().empty()) throw std::runtime_error(past.problem());
    if (played != outputs_.size())
      throw std::runtime_error("of " + std::to_string(outputs_.size()) + " scans " + std::to_string(played) +
                               " were played");
    differences_ += past.differences().size();
  }

  nlohmann::json figures() const {
    return {{"scans", outputs_.size()},
            {"pieces", pieces_},
            {"events", events_},
            {"states", states_},
            {"packed_states", packed(runtime::BlockKind::State)},
            {"packed_events", packed(runtime::BlockKind::Events)},
            {"losses", state_.losses},
            {"differences", differences_},
            {"seconds", playedSeconds_}};
  }
  bool isGood() const { return differences_ == 0 && state_.losses == 0; }

private:
  // Bytes of the blocks of this kind, in the files.
  uint64_t packed(runtime::BlockKind kind) const {
    uint64_t sum = 0;
    for (const runtime::SegmentFile& file : runtime::segmentsIn(folder_)) {
      std::ifstream in(folder_ + "/" + file.name, std::ios::binary);
      in.seekg(sizeof(runtime::SegmentHead));
      for (runtime::BlockHead head; in.read(reinterpret_cast<char*>(&head), sizeof head);
           in.seekg(head.size, std::ios::cur))
        if (head.kind == kind) sum += sizeof head + head.size;
    }
    return sum;
  }

  static constexpr uint64_t kProbe = 6000;
  using Started = std::function<void(bench::Recorder&, const compiler::Compiled&)>;

  void run(const bench::Recorder::EachPart& each, const Started& started, uint64_t scans) {
    scenario::RunOptions options;
    options.engines = {compiler::EngineKind::Jit};
    options.marks = true;
    uint64_t parts = 0;
    pieces_ = 0;
    options.started = [&](scenario::Session& session, const compiler::Compiled& program) {
      recorder_ =
          std::make_unique<bench::Recorder>(session, program, compiler::EngineKind::Jit, [&](bench::Part&& part) {
            ++parts;
            each(std::move(part));
          });
      if (started) started(*recorder_, program);
      return std::string();
    };
    options.ended = [&](scenario::Session& session) {
      while (parts < scans && recorder_->problem().empty()) runPiece(session);
      if (started) state_ = recorder_->replay().recorded();
      if (started) recorder_->replay().endRecord();
    };
    const scenario::RunResult result = scenario::run(scenario_, options);
    if (!result.environment.empty()) throw std::runtime_error(result.environment);
    if (!result.passed) throw std::runtime_error("the scenario fails: " + scenario::textOf(result.problems[0]));
    if (!recorder_->problem().empty()) throw std::runtime_error(recorder_->problem());
    recorder_.reset();
  }

  void runPiece(scenario::Session& session) {
    for (const scenario::Statement& statement : piece_.statements)
      if (const auto problem = session.execute(statement))
        throw std::runtime_error("piece " + std::to_string(pieces_) + ": " + scenario::textOf(*problem));
    ++pieces_;
  }

  scenario::Scenario scenario_, piece_;
  uint64_t scans_;
  TemporaryFolder temporary_;
  std::string folder_ = temporary_ / "recording";
  bench::Recording probe_;
  std::unique_ptr<bench::Recorder> recorder_;
  std::optional<runtime::WatchedBytes> watched_;
  std::vector<uint32_t> outputs_; // their hash after each scan
  runtime::RecordingState state_;
  uint64_t pieces_ = 0, states_ = 0, events_ = 0, differences_ = 0;
  double playedSeconds_ = 0;
};

} // namespace

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::cerr << "usage: rung-bench-work SCENARIO PIECE SCANS\n";
    return 2;
  }
  Work work(argv[1], argv[2], std::strtoull(argv[3], nullptr, 10));
  work.probe();
  work.record();
  work.play();
  std::cout << work.figures().dump() << '\n';
  return work.isGood() ? 0 : 1;
} catch (const std::exception& problem) {
  std::cerr << "rung-bench-work: " << problem.what() << '\n';
  return 1;
}
