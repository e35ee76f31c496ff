// A message of the control about a unit on the CAN bus. The manual assigns no numbers to these (l.9615-9653 are for
// drives).
#pragma once
#include <bit>
#include <string>

#include "machine/io/can/channel.h"
#include "machine/io/can/drives.h"

namespace rung::io {

struct UnitMessage {
  enum class Kind : uint8_t {
    Silent,     // time-out
    Answers,    // after a time-out
    Error,      // `code` is the unit's error register 1001h
    SilentSdo,  // no answer to the request for `object`
    RefusesSdo, // the unit has rejected that request: `code` is the SDO abort code (CiA 301)
  };
  Kind kind = Kind::Silent;
  uint8_t group = 0, board = 0; // from 1
  sdo::Object object;
  uint32_t code = 0;

  bool operator==(const UnitMessage&) const = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(kind, group, board, object, code);
  }
};
using UnitMessages = BoundedQueue<UnitMessage, 64>; // of more than 64, the newest are lost

// The sentence for the log.
std::string textOf(const UnitMessage& message);

// The control's side of one unit on the CAN bus: its structure INOUTS, its errors and time-outs, and its SDO requests
// (man. l.3502-3678, l.4074-4263). CanUnits (units.h) has all units.
//
// A unit that is new, returns after a silence or reports that it has booted is taken out of the exchange of process
// data, gets the mapping of its PDOs, which CiA 301 permits only in that state, and is started.

// Groups: 1 INOUT08, 2 KLA50 and EPU, 3 handwheel (man. l.3287-3291).
inline constexpr uint32_t kUnitGroups = 3, kInOut08 = 1, kPanel = 2, kHandwheel = 3;
inline constexpr uint32_t kMostUnits[kUnitGroups] = {32, 4, 2};
inline constexpr uint32_t kFirstNode[kUnitGroups] = {0x21, 0x41, 0x45}; // node of board 1
constexpr uint8_t nodeOf(uint32_t group, uint32_t board) {
  return static_cast<uint8_t>(kFirstNode[group - 1] + board - 1);
}
// Names in the control's configuration: of a unit, and of the attribute with the number of units.
struct UnitGroupNames {
  const char *unit, *count;
};
inline constexpr UnitGroupNames kUnitGroupNames[kUnitGroups] = {
    {"INOUT08", "InOut08Cnt"}, {"KLA50", "Kla50Cnt"}, {"Knob", "KnobCnt"}};
inline constexpr uint32_t kUnitOutputs = 3, kUnitInputs = 4; // ports OP0 to OP2, IP0 to IP3
// The manual does not specify how long a unit may be silent (l.3534).
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
  // One millisecond: time-out, errors, mode, requests, start.
  void tick(CanPort& port, UnitMessages& messages);
  // Whether the unit takes part in the exchange of process data.
  bool isStarted() const { return isStarted_; }
  // Sets the outputs of a port to the program's values. `errors` are the bits of ERRLI_PxOUT: set here for new shorts,
  // they keep the outputs at 0. `zeroed`: all outputs are 0.
  void output(uint32_t port, uint8_t wanted, uint8_t& errors, bool zeroed);
  // RPDO1, sent to a started unit with each SYNC.
  CanPacket outputPacket(const std::array<uint8_t, 8>& display);

  // Processes a packet of the unit. Returns true if the packet is only for the control.
  bool take(const CanPacket& packet);

  const Inouts& data() const { return data_; }
  // CAN_SYSIO_WRITE (man. l.4333).
  void write(InoutsItem item, uint32_t value) { data_.set(item, value); }
  bool hasTimedOut() const { return timedOut_; }
  // Whether a serious error is present that CONTROL does not limit to this unit (man. l.3541, l.3674).
  bool zeroesAll() const { return (data_.get(inouts::kErrorStatus) & kZeroAll) != 0; }

  template <class Archive>
  void state(Archive& archive) {
    archive(data_, analogue_, keys_, shorts_, sent_, registered_, mode_, silentMs_, unheardMs_, timedOut_, isPrepared_,
            isStarted_, waiting_, late_, underWay_, refused_, askedMs_, isSdoSilent_, saidSdoSilent_, abort_, aborted_,
            saidAborted_, segment_);
    archive.require((waiting_ | late_ | underWay_) >> 31 == 0 && std::popcount(underWay_) <= 1);
  }

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
  std::array<uint8_t, 8> analogue_{};          // as received; shown to programs only in analogue mode
  std::array<uint8_t, 4> keys_{};              // as received; those of an INOUT08 only in matrix mode
  std::array<uint8_t, kUnitOutputs> shorts_{}; // already reported in ERRLI_PxOUT
  std::array<uint8_t, kUnitOutputs> sent_{};   // outputs as sent
  uint8_t registered_ = 0;                     // error register 1001h as the unit reported it
  uint8_t mode_ = 0;                           // the mode requested from the unit
  uint32_t silentMs_ = 0;  // since the last inputs; not required from a unit in preparation, but they end a time-out
  uint32_t unheardMs_ = 0; // since any packet was received
  bool timedOut_ = false;
  bool isPrepared_ = false, isStarted_ = false; // it has left, and has joined, the exchange of process data
  uint32_t waiting_ = 0;                        // waiting SDO requests, one bit each (units.cpp)
  uint32_t late_ = 0;                           // unanswered requests, repeated when no other waits
  uint32_t underWay_ = 0;                       // bit of the request in progress
  uint32_t refused_ = 0;                        // requests that the unit has rejected
  uint32_t askedMs_ = 0;
  bool isSdoSilent_ = false, saidSdoSilent_ = false;
  uint32_t abort_ = 0; // abort code of the latest rejection, until it is reported
  sdo::Object aborted_, saidAborted_;
  enum class Segment : uint8_t { None, Due, Asked } segment_ = Segment::None; // of a text that is longer than 4 bytes
};

// Objects of units (man. l.4390-4463, l.4567-4663); drives.h has those of every node.

inline constexpr sdo::Object kTpdo2Id{0x1801, 1}, kTpdo2Type{0x1801, 2}; // COB-ID and transmission type (CiA 301)
inline constexpr uint32_t kNotValid = 0x8000'0000;                       // bit of a COB-ID: the PDO is not sent
inline constexpr uint16_t kRpdoMapping = 0x1600, kTpdoMapping = 0x1A00;  // subindices 1 to 8

inline constexpr uint16_t kShortedOutput = 0x2101, kMatrixInput = 0x2108, kEncoderCounter = 0x210D, kDisplay = 0x210F,
                          kWheelKeys = 0x2111, kReadInput = 0x6000, kWriteOutput = 0x6200;
inline constexpr sdo::Object kMatrixOutputs{0x2109, 0}, kWheelMode{0x2110, 0};
// Subindices of the display (man. l.4620-4663).
inline constexpr uint8_t kDisplayInitialise = 1, kDisplayEnable = 2, kDisplayRow = 6, kDisplayColumn = 7,
                         kDisplayMask = 8, kDisplayInversion = 9, kDisplaySize = 10, kDisplayCount = 11,
                         kDisplayCharacter = 12;

// The bytes in the process data of units. RPDO1 and TPDO1 of a unit always have eight fields of eight bits, and unused
// fields must be mapped, too (man. l.4705-4714, l.4780-4790); the control maps them with the objects 1600h and 1A00h.
// TPDO2 is fixed: the unit's analogue inputs.
//
// The manual names the objects and the structures of programs (l.4074-4185, l.7492-7503), but not the order of the
// bytes: the control decides it.

inline constexpr uint32_t kPdoFields = 8;

inline constexpr uint16_t kUnusedField = 0x0005; // dummy object of CiA 301 (unsigned byte), mapped to unused fields

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
// IN0, IN1; the low bytes of IRC0 and IRC1, because a field has only eight bits.
inline constexpr PdoFields kWheelInputFields = {{{kWheelKeys, 1},
                                                 {kWheelKeys, 2},
                                                 {kEncoderCounter, 1},
                                                 {kEncoderCounter, 2},
                                                 kNoField,
                                                 kNoField,
                                                 kNoField,
                                                 kNoField}};

} // namespace rung::io
