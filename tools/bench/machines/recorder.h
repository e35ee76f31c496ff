// Makes a recording of a scenario.
#pragma once
#include <functional>
#include <memory>

#include "compiler/engines.h"
#include "tools/bench/machines/recording.h"
#include "tools/bench/machines/replay.h"
#include "tools/scenario/session.h"

namespace rung::bench {

// Observes the scenario while it runs, and runs the same program beside it without the simulation: whatever must be
// written into that copy so that it begins each part with the same memory is what the machine has written. The
// recording ends where the scenario switches the program on again.
class Recorder final : public scenario::Observer, public runtime::TaskWatch {
public:
  // After it has run; its hash is not computed.
  using EachPart = std::function<void(Part&& part)>;
  // `engine`: of the copy. Throws std::runtime_error if the program cannot run alone.
  Recorder(scenario::Session& session, const compiler::Compiled& program, compiler::EngineKind engine, EachPart each);
  ~Recorder() override;
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  Replay& replay(); // the copy
  // "" or why the recording cannot be used.
  const std::string& problem() const;

  void started(scenario::Session& session) override;
  void scanned(const scenario::Session& session) override;
  void begins(const runtime::Instance& instance, uint32_t task) override;
  void ended(const runtime::Instance&, uint32_t) override {}

private:
  struct Beside;
  std::unique_ptr<Beside> beside_;
};

} // namespace rung::bench
