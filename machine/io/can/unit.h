// What the control says about a unit on the CAN bus. The manual has no numbers for that (l.9615-9653 are of drives).
#pragma once
#include <string>

#include "machine/io/can/channel.h"
#include "machine/io/can/drives.h"

namespace rung::io {

struct UnitMessage {
  enum class Kind : uint8_t {
    Silent,     // time-out
    Answers,    // again
    Error,      // `code` is its error register 1001h
    SilentSdo,  // it does not answer the request for `object`
    RefusesSdo, // nor carry it out: `code` is that of the abort (CiA 301)
  };
  Kind kind = Kind::Silent;
  uint8_t group = 0, board = 0; // from 1
  sdo::Object object;
  uint32_t code = 0;

  bool operator==(const UnitMessage&) const = default;
};
using UnitMessages = BoundedQueue<UnitMessage, 64>; // of more the newest are lost

// As the log has it.
std::string textOf(const UnitMessage& message);

// The control's side of one unit on the CAN bus: its structure INOUTS, its errors and time-outs, and what is asked of
// it by SDO (man. l.3502-3678, l.4074-4263). All units together are CanUnits (units.h).
//
// A unit that is new, has come back after a silence or says that it has booted is taken out of the exchange of process
// data, gets the mapping of its PDOs, in which alone CiA 301 lets it change, and is started.

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
  uint32_t waiting_ = 0;                        // requests by SDO, a bit each (units.cpp)
  uint32_t late_ = 0;                           // those that were not answered, for the time when no other waits
  uint32_t underWay_ = 0;                       // the bit of the one that was sent
  uint32_t refused_ = 0;                        // what the unit would not write
  uint32_t askedMs_ = 0;
  bool isSdoSilent_ = false, saidSdoSilent_ = false;
  uint32_t abort_ = 0; // of the latest refusal, until it is reported
  sdo::Object aborted_, saidAborted_;
  enum class Segment : uint8_t { None, Due, Asked } segment_ = Segment::None; // of a text that is longer than 4 bytes
};

// Objects of units (man. l.4390-4463, l.4567-4663); those that every node has are in drives.h.

inline constexpr sdo::Object kTpdo2Id{0x1801, 1}, kTpdo2Type{0x1801, 2}; // COB-ID and type of transmission (CiA 301)
inline constexpr uint32_t kNotValid = 0x8000'0000;                       // of a COB-ID: the PDO is not sent
inline constexpr uint16_t kRpdoMapping = 0x1600, kTpdoMapping = 0x1A00;  // subindices 1 to 8

inline constexpr uint16_t kShortedOutput = 0x2101, kMatrixInput = 0x2108, kEncoderCounter = 0x210D, kDisplay = 0x210F,
                          kWheelKeys = 0x2111, kReadInput = 0x6000, kWriteOutput = 0x6200;
inline constexpr sdo::Object kMatrixOutputs{0x2109, 0}, kWheelMode{0x2110, 0};
// Subindices of the display (man. l.4620-4663).
inline constexpr uint8_t kDisplayInitialise = 1, kDisplayEnable = 2, kDisplayRow = 6, kDisplayColumn = 7,
                         kDisplayMask = 8, kDisplayInversion = 9, kDisplaySize = 10, kDisplayCount = 11,
                         kDisplayCharacter = 12;

// What the bytes of the process data of units are. The units have eight fields of eight bits in RPDO1 and in TPDO1,
// whose number is fixed, and fields without use have to be mapped, too (man. l.4705-4714, l.4780-4790); the control
// maps them by the objects 1600h and 1A00h. TPDO2 is fixed: what the unit's analogue inputs are.
//
// The manual names the objects and the structures of programs (l.4074-4185, l.7492-7503), but not
// which byte is what: the control decides that.

inline constexpr uint32_t kPdoFields = 8;

inline constexpr uint16_t kUnusedField = 0x0005; // the unsigned byte of CiA 301 that is mapped where nothing is

// The value of a mapping object: index, subindex, bits.
constexpr uint32_t mappingOf(sdo::Object field) { return uint32_t{field.index} << 16 | field.subindex << 8 | 8u; }

using PdoFields = std::array<sdo::Object, kPdoFields>;

inline constexpr sdo::Object kNoField{kUnusedField, 0};

// OUT0 to OUT2.
inline constexpr PdoFields kOutputFields = {
    {{kWriteOutput, 1}, {kWriteOutput, 2}, {kWriteOutput, 3}, kNoField, kNoField, kNoField, kNoField, kNoField}};
// IN0 to IN3, TL0 to TL3.
inline constexpr PdoFields kInputFields = {{{kReadInput, 1},
                                            {kReadInput, 2},
                                            {kReadInput, 3},
                                            {kReadInput, 4},
                                            {kMatrixInput, 1},
                                            {kMatrixInput, 2},
                                            {kMatrixInput, 3},
                                            {kMatrixInput, 4}}};
// TOC_DISPLS (man. l.7492-7503).
inline constexpr PdoFields kWheelOutputFields = {{{kDisplay, kDisplayRow},
                                                  {kDisplay, kDisplayColumn},
                                                  {kDisplay, kDisplayCharacter},
                                                  {kDisplay, kDisplayCharacter + 1},
                                                  {kDisplay, kDisplayCharacter + 2},
                                                  {kDisplay, kDisplayCharacter + 3},
                                                  {kDisplay, kDisplaySize},
                                                  {kDisplay, kDisplayInversion}}};
// IN0, IN1; the low bytes of IRC0 and IRC1, for a field has no more bits.
inline constexpr PdoFields kWheelInputFields = {{{kWheelKeys, 1},
                                                 {kWheelKeys, 2},
                                                 {kEncoderCounter, 1},
                                                 {kEncoderCounter, 2},
                                                 kNoField,
                                                 kNoField,
                                                 kNoField,
                                                 kNoField}};

} // namespace rung::io
