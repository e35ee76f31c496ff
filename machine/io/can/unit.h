// The control's side of one unit on the CAN bus: its structure INOUTS, its errors and time-outs, and what is asked of
// it by SDO (man. l.3502-3678, l.4074-4263). All units together are CanUnits (units.h).
//
// A unit that is new, has come back after a silence or says that it has booted is taken out of the exchange of process
// data, gets the mapping of its PDOs (unit_mapping.h), in which alone CiA 301 lets it change, and is started.
#pragma once
#include "machine/io/can/inouts.h"
#include "machine/io/can/port.h"
#include "machine/io/can/sdo.h"
#include "machine/io/can/unit_message.h"

namespace rung::io {

// Groups are 1 INOUT08, 2 KLA50 and EPU, 3 handwheel (man. l.3287-3291).
inline constexpr uint32_t kUnitGroups = 3, kInOut08 = 1, kPanel = 2, kHandwheel = 3;
inline constexpr uint32_t kMostUnits[kUnitGroups] = {32, 4, 2};
inline constexpr uint32_t kFirstNode[kUnitGroups] = {0x21, 0x41, 0x45}; // of board 1
constexpr uint8_t nodeOf(uint32_t group, uint32_t board) {
  return static_cast<uint8_t>(kFirstNode[group - 1] + board - 1);
}
// In the control's configuration: the name of a unit, and the attribute that says how many there are.
struct UnitGroupNames {
  const char *unit, *count;
};
inline constexpr UnitGroupNames kUnitGroupNames[kUnitGroups] = {
    {"INOUT08", "InOut08Cnt"}, {"KLA50", "Kla50Cnt"}, {"Knob", "KnobCnt"}};
inline constexpr uint32_t kUnitOutputs = 3, kUnitInputs = 4; // ports OP0 to OP2, IP0 to IP3
// The manual does not say how long a unit may be silent (l.3534).
inline constexpr uint32_t kUnitTimeoutMs = 100;

class CanUnit {
public:
  // `board` from 1.
  CanUnit(uint32_t group, uint32_t board, uint8_t control = 0);

  uint32_t group() const { return group_; }
  uint32_t board() const { return board_; }
  uint8_t node() const { return nodeOf(group_, board_); }
  // CONTROL after a power-on.
  void setControl(uint8_t control) { control_ = control; }

  void power() { *this = CanUnit(group_, board_, control_); }
  // A millisecond: time-out, errors, mode, requests, start.
  void tick(CanPort& port, UnitMessages& messages);
  // It takes part in the exchange of process data.
  bool isStarted() const { return isStarted_; }
  // The outputs of a port as the program wants them; `errors` are the bits of ERRLI_PxOUT, which are set here for new
  // shorts, and which keep the output at 0. `zeroed`: all outputs are 0.
  void output(uint32_t port, uint8_t wanted, uint8_t& errors, bool zeroed);
  // RPDO1, as it is sent to a unit that is started with each SYNC.
  CanPacket outputPacket(const std::array<uint8_t, 8>& display);

  // A packet of the unit has come. True: the control alone was meant.
  bool take(const CanPacket& packet);

  const Inouts& data() const { return data_; }
  // CAN_SYSIO_WRITE (man. l.4333).
  void write(InoutsItem item, uint32_t value) { data_.set(item, value); }
  bool hasTimedOut() const { return timedOut_; }
  // A serious error lasts, and CONTROL does not say that it is this unit's affair alone (man. l.3541, l.3674).
  bool zeroesAll() const { return (data_.get(inouts::kErrorStatus) & kZeroAll) != 0; }

private:
  void begin();
  void start(CanPort& port);
  bool isPreparing() const;
  bool mayStart() const;
  void watch(UnitMessages& messages);
  void reportRefusal(UnitMessages& messages);
  void showErrors(UnitMessages& messages);
  void followMode();
  void showInputs();
  void ask(CanPort& port, UnitMessages& messages);
  void giveUp(UnitMessages& messages);
  void report(UnitMessages& messages, UnitMessage message) const;
  bool takeOwn(const CanPacket& packet);
  void sendRequested(CanPort& port);
  void takeInputs(const CanPacket& packet);
  void takeWheel(const CanPacket& packet);
  bool takeAnswer(const CanPacket& packet);
  void finish(const CanPacket& answer);
  void refuse(uint32_t bit, uint32_t abort);
  bool isPending(uint32_t requests) const;
  bool controls(uint8_t bit) const { return (data_.get(inouts::kControl) & bit) != 0; }

  uint32_t group_, board_;
  uint8_t control_ = 0;
  Inouts data_;
  std::array<uint8_t, 8> analogue_{};          // as they came; programs see them in the analogue mode
  std::array<uint8_t, 4> keys_{};              // and these in the matrix mode
  std::array<uint8_t, kUnitOutputs> shorts_{}; // that ERRLI_PxOUT knows
  std::array<uint8_t, kUnitOutputs> sent_{};   // outputs
  uint8_t registered_ = 0;                     // error register 1001h as the unit reported it
  uint8_t mode_ = 0;                           // to which the unit is brought
  uint32_t silentMs_ = 0; // since inputs came; a unit that is being prepared need not send any, but they end a time-out
  uint32_t unheardMs_ = 0; // since anything came
  bool timedOut_ = false;
  bool isPrepared_ = false, isStarted_ = false; // it has left, and joined, the exchange of process data
  uint32_t waiting_ = 0;                        // requests by SDO, a bit each (unit_requests.h)
  uint32_t late_ = 0;                           // those that were not answered, for the time when no other waits
  uint32_t underWay_ = 0;                       // the bit of the one that was sent
  uint32_t refused_ = 0;                        // what the unit would not write
  uint32_t askedMs_ = 0;
  bool isSdoSilent_ = false, saidSdoSilent_ = false;
  uint32_t abort_ = 0; // of the latest refusal, until it is reported
  sdo::Object aborted_, saidAborted_;
  enum class Segment : uint8_t { None, Due, Asked } segment_ = Segment::None; // of a text that is longer than 4 bytes
};

} // namespace rung::io
