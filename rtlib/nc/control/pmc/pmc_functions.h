// The handshake of the family's auxiliary functions M, S, T, B (GSK's man. §7, l.5732-6131): codes in one slot, strobes
// in the next, then the answer of the PLC. All share the answer FIN, which rises and falls, so functions that begin in
// one slot end together, and others wait. In the high-speed mode every function has a completion signal of its own,
// which takes the level of its strobe, and functions do not wait for others.
//
// The control evaluates the level of FIN (l.5755-5756): if it is still 1 from an earlier function, it ends a function
// that the program has not seen. On a real machine an answer counts only after it has been seen absent since the
// strobe.
#pragma once
#include <array>
#include <optional>

#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/pmc/signals_io.h"
#include "rtlib/nc/pmc/model.h"

namespace rung::nc {

class PmcFunctions final : public Functions {
public:
  using Line = pmc::FunctionLine;
  static constexpr uint32_t kLines = pmc::kFunctionLines;

  enum class Answer : uint8_t { ByLevel, AfterAbsence };
  // The model outlives it.
  explicit PmcFunctions(const pmc::Model& model, Answer counts = Answer::AfterAbsence)
      : model_(&model), counts_(counts) {}

  // At power-on. F keeps its contents, so functions started before are aborted.
  void powerOn() {
    if (handedOver_ && io_) abort(*io_);
  }
  // The signals of the program that runs now.
  void use(const pmc::SignalsIo& io) { io_ = io; }

  // Takes effect for functions started from now on.
  void setHighSpeed(bool on) { highSpeed_ = on; }
  // Writes the code to F. False: the function has to wait.
  bool start(const pmc::SignalsIo& io, Line line, uint32_t code);
  void step(const pmc::SignalsIo& io);
  // Strobes fall at once, and M codes are cleared (l.5257).
  void abort(const pmc::SignalsIo& io);
  bool busy() const;

  template <class Archive>
  void state(Archive& archive) {
    archive(running_, handedOver_, highSpeed_);
  }

  bool useHighSpeed() override {
    setHighSpeed(true);
    return true;
  }
  bool supports(FunctionKind kind, uint32_t) const override { return kind <= FunctionKind::B; }
  // Nothing before the first power-on.
  std::optional<uint32_t> start(FunctionKind kind, uint32_t code) override;
  void step() override {
    if (io_) step(*io_);
  }
  bool busy(uint32_t line) const override { return line < kLines && running_[line].phase != Phase::Idle; }
  void abort() override {
    if (io_) abort(*io_);
  }

private:
  enum class Phase : uint8_t { Idle, Code, Strobe, Release };
  struct Running {
    Phase phase = Phase::Idle;
    bool fast = false;   // started in high-speed mode
    bool absent = false; // the answer was 0 at some time since the strobe
    template <class Archive>
    void state(Archive& archive) {
      archive(phase, fast, absent);
    }
  };

  void giveStrobe(const pmc::SignalsIo& io, uint32_t line);
  bool answered(const pmc::SignalsIo& io, uint32_t line) const;
  void end(const pmc::SignalsIo& io, uint32_t line);
  void putCode(const pmc::SignalsIo& io, uint32_t line, uint32_t code) const;
  void dropCodes(const pmc::SignalsIo& io) const;

  const pmc::Model* model_;
  std::array<Running, kLines> running_ = {}; // by Line
  std::optional<pmc::SignalsIo> io_;
  Answer counts_;
  bool handedOver_ = false; // a function was started since the object was made
  bool highSpeed_ = false;
};

} // namespace rung::nc
