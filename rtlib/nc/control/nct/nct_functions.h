// The handshake of one channel's M, S, T and auxiliary functions in NCT (man. l.9440-9535, 10241-10317): the NC writes
// the code and sets the strobe for one PLC cycle, in which the program resets its acknowledge; the program sets it
// again when the function is finished, and CP_FIN when all functions are.
//
// Acknowledges are 1 at rest (l.10271). The program resets one for a code that it knows (l.9494, 10259-10263), and may
// set it again in the same cycle, so the NC need not see it at 0. The level counts once the program has run a whole PLC
// cycle with the strobe, not before.
#pragma once
#include <array>

#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/nct/signal_memory.h"
#include "rtlib/run/instance.h"

namespace rung::nc {

class NctFunctions final : public Functions {
public:
  // Lines: M 1 to 8, S, T, auxiliary 1 to 3.
  static constexpr uint32_t kCodes = 8;
  static constexpr uint32_t kSpeed = 8;
  static constexpr uint32_t kTool = 9;
  static constexpr uint32_t kAuxiliary = 10;
  static constexpr uint32_t kLines = 13;
  static constexpr int32_t kFirstRange = 11; // CN_RNGREQ, 11 to 18 (l.10650-10652, 10666)

  explicit NctFunctions(uint32_t channel) : channel_(channel) {} // from 0

  // At power-on. The instance outlives this object's use.
  void powerOn(runtime::Instance& instance);
  // The signals of the program that runs now.
  void use(const nct::SignalMemory& signals) { signals_ = signals; }

  // Direct access to the signals, for an NC that manages its blocks itself. At the beginning of a PLC cycle:
  void dropStrobes(const nct::SignalMemory& signals); // resets the strobes of the last cycle
  void issue(const nct::SignalMemory& signals, uint32_t line, int32_t code);
  bool acknowledged(const nct::SignalMemory& signals, uint32_t line) const {
    return signals.get(acknowledge_[line], channel_);
  }

  // Functions of a real machine start as they come. A line is free when its acknowledge is 1: after an abort the
  // program may still be busy with its last function. M codes start in order, one in each PLC cycle. For S and T the
  // caller sets the spindle (CN_SSEL), its range (CN_RNGREQ) and the place of the tool; if it does not, spindle 1 and
  // range 11 apply.
  bool supports(FunctionKind kind, uint32_t) const override { return kind <= FunctionKind::B; }
  std::optional<uint32_t> start(FunctionKind kind, uint32_t code) override;
  void step() override;
  bool busy(uint32_t line) const override { return line < kLines && phases_[line] != Phase::Idle; }
  void abort() override;

  template <class Archive>
  void state(Archive& archive) {
    archive(phases_, strobes_);
  }

private:
  enum class Phase : uint8_t { Idle, Strobe, Open };

  bool free(uint32_t line) const { return phases_[line] == Phase::Idle && acknowledged(signals_, line); }
  std::optional<uint32_t> freeLine(FunctionKind kind) const;
  void selectSpindle() const;

  uint32_t channel_;
  const runtime::Instance* instance_ = nullptr;
  nct::SignalMemory signals_;
  std::array<Phase, kLines> phases_ = {};
  uint32_t strobes_ = 0; // one bit for each line

  nct::BitSignal strobe_[kLines] = {
      nct::BitSignal("CN_M1STB"),  nct::BitSignal("CN_M2STB"),   nct::BitSignal("CN_M3STB"),
      nct::BitSignal("CN_M4STB"),  nct::BitSignal("CN_M5STB"),   nct::BitSignal("CN_M6STB"),
      nct::BitSignal("CN_M7STB"),  nct::BitSignal("CN_M8STB"),   nct::BitSignal("CN_SSTB"),
      nct::BitSignal("CN_TSTB"),   nct::BitSignal("CN_AUX1STB"), nct::BitSignal("CN_AUX2STB"),
      nct::BitSignal("CN_AUX3STB")};
  nct::BitSignal acknowledge_[kLines] = {
      nct::BitSignal("CP_M1ACK"),  nct::BitSignal("CP_M2ACK"),   nct::BitSignal("CP_M3ACK"),
      nct::BitSignal("CP_M4ACK"),  nct::BitSignal("CP_M5ACK"),   nct::BitSignal("CP_M6ACK"),
      nct::BitSignal("CP_M7ACK"),  nct::BitSignal("CP_M8ACK"),   nct::BitSignal("CP_SACK"),
      nct::BitSignal("CP_TACK"),   nct::BitSignal("CP_AUX1ACK"), nct::BitSignal("CP_AUX2ACK"),
      nct::BitSignal("CP_AUX3ACK")};
  nct::WordSignal code_[kLines] = {nct::WordSignal("CN_M1C"),  nct::WordSignal("CN_M2C"),   nct::WordSignal("CN_M3C"),
                                   nct::WordSignal("CN_M4C"),  nct::WordSignal("CN_M5C"),   nct::WordSignal("CN_M6C"),
                                   nct::WordSignal("CN_M7C"),  nct::WordSignal("CN_M8C"),   nct::WordSignal("CN_SC"),
                                   nct::WordSignal("CN_TC"),   nct::WordSignal("CN_AUX1C"), nct::WordSignal("CN_AUX2C"),
                                   nct::WordSignal("CN_AUX3C")};
  nct::WordSignal spindle_{"CN_SSEL"}, range_{"CN_RNGREQ"};
  nct::BitSignal finished_{"CP_FIN"};
};

} // namespace rung::nc
