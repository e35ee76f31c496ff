// Part programs of the simulated NCT control: parses the text of `event program` and `event mdi` into blocks.
//
//   block := ["/" [1-8]] { word | assignment | jump | "(" comment ")" }
//   word  := letter value | "S" digits "=" value
//   assignment := "#" number "=" value
//   jump  := [["IF"] "#" number ("EQ"|"NE"|"GT"|"LT"|"GE"|"LE") value] "GOTO" number
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/nc/control/nct/nct_functions.h"
#include "rtlib/nc/control/nct/signal_memory.h"
#include "sim/nct/parameters.h"
#include "sim/nct/topic.h"
#include "sim/part_program.h"

namespace rung::sim::nct {

inline constexpr uint32_t kCodesOfABlock = 8; // M codes, l.9470

struct ProgramWord {
  char letter = 0;
  uint32_t spindle = 0; // for S3=1000; otherwise 0
  ProgramValue value;

  template <class Archive>
  void state(Archive& archive) {
    archive(letter, spindle, value);
  }
};

struct ProgramAssignment {
  uint32_t variable = 0;
  ProgramValue value;

  template <class Archive>
  void state(Archive& archive) {
    archive(variable, value);
  }
};

struct ProgramJump {
  enum class Test : uint8_t { Always, Eq, Ne, Gt, Lt, Ge, Le };
  Test test = Test::Always;
  uint32_t variable = 0;
  ProgramValue value;
  uint32_t target = 0; // N

  template <class Archive>
  void state(Archive& archive) {
    archive(test, variable, value, target);
  }
};

struct ProgramBlock {
  uint32_t condition = 0; // "/n": skipped while CP_CNDBK_n=1; 0: always executed
  uint32_t sequence = 0;  // N; 0: none
  std::vector<ProgramWord> words;
  std::vector<ProgramAssignment> assignments;
  std::optional<ProgramJump> jump;

  bool empty() const { return sequence == 0 && words.empty() && assignments.empty() && !jump; }

  template <class Archive>
  void state(Archive& archive) {
    archive(condition, sequence, words, assignments, jump);
  }
};

struct ChannelProgram {
  int32_t number = 0; // O
  std::vector<ProgramBlock> blocks;

  template <class Archive>
  void state(Archive& archive) {
    archive(number, blocks);
  }
};

// Returns "" and the program, or the error in the text.
std::string readChannelProgram(std::string_view text, ChannelProgram& program);

// The signals and parameters of the channels (man. 7.15), looked up once.

// Modes, in the order of Mode.
inline constexpr uint32_t kModes = 7;
// Conditions that a request toggles (l.9800-9905), in the order of Toggle.
inline constexpr uint32_t kToggles = 4;

struct ChannelSignals {
  BitSignal modeRequest[kModes] = {BitSignal("CP_JOG"),  BitSignal("CP_INCR"), BitSignal("CP_HNDL"),
                                   BitSignal("CP_REFP"), BitSignal("CP_EDIT"), BitSignal("CP_AUTO"),
                                   BitSignal("CP_MDI")};
  BitSignal mode[kModes] = {BitSignal("CN_JOG"),  BitSignal("CN_INCR"), BitSignal("CN_HNDL"), BitSignal("CN_REFP"),
                            BitSignal("CN_EDIT"), BitSignal("CN_AUTO"), BitSignal("CN_MDI")};
  BitSignal toggleRequest[kToggles] = {BitSignal("CP_TEST"), BitSignal("CP_MLCK"), BitSignal("CP_DRRUN"),
                                       BitSignal("CP_FLCK")};
  BitSignal toggle[kToggles] = {BitSignal("CN_TEST"), BitSignal("CN_MLCK"), BitSignal("CN_DRRUN"),
                                BitSignal("CN_FLCK")};

  BitSignal startRequest{"CP_START"}, stopRequest{"CP_STOP"}, start{"CN_START"}, stop{"CN_STOP"};
  BitSignal interrupted{"CN_INTD"}, buffered{"CN_BKBUF"}, waiting{"CN_WTNG"};
  BitSignal restartRequest{"CP_BKRST"}, returnRequest{"CP_BKRET"}, restart{"CN_BKRST"}, returning{"CN_BKRET"};
  BitSignal singleBlock{"CP_SGLBK"}, conditionalStop{"CP_CNDSP"}, noWait{"CP_NOWT"}, finished{"CP_FIN"};
  BitSignal condition[8] = {BitSignal("CP_CNDBK_1"), BitSignal("CP_CNDBK_2"), BitSignal("CP_CNDBK_3"),
                            BitSignal("CP_CNDBK_4"), BitSignal("CP_CNDBK_5"), BitSignal("CP_CNDBK_6"),
                            BitSignal("CP_CNDBK_7"), BitSignal("CP_CNDBK_8")};
  BitSignal automaticForbidden{"P_RUNAUT"}, mdiForbidden{"P_RUNMDI"}, machineOn{"P_MONREQ"};

  BitSignal lengthMeasuring{"CP_TLCM"}, offsetMeasuring{"CP_WPCM"};
  BitSignal wheelOffsetRequest{"CP_AHND"}, wheelOffset{"CN_AHND"};
  BitSignal misalignedRequest{"CP_WMCAXF"}, misaligned{"CN_WMCAXF"};
  // Manual modes of five-axis machines (l.9811-9870).
  BitSignal toolRequest[4] = {BitSignal("CP_TAXF"), BitSignal("CP_TRGAF"), BitSignal("CP_TTCRF"), BitSignal("CP_TBLB")};
  BitSignal toolMode[4] = {BitSignal("CN_TAXF"), BitSignal("CN_TRGAF"), BitSignal("CN_TTCRF"), BitSignal("CN_TBLB")};

  BitSignal stopped{"CN_IPSTP"}, empty{"CN_IPEPTY"}, feedRequest{"CN_CBFR"}, feedEnabled{"CP_CBFEN"};
  BitSignal hold{"CP_HOLD"}, holdAll{"P_HOLD0"}, rapidKey{"CP_JOGRAP"};
  BitSignal overrideDisabled{"CN_OVDIS"}, thread{"CN_THRD"}, threadCycle{"CN_THRDC"}, tapping{"CN_TAP"};
  BitSignal rigidTapping{"CN_RTAP"}, reference{"CN_REFPG"}, dwell{"CN_DWELL"}, skip{"CN_SKIP"}, perTurn{"CN_FREV"};
  BitSignal inPositionCheck{"CN_POSCHK"}, surfaceSpeed{"CN_CSURFS"}, polygon{"CN_POLYT"}, inch{"CN_INCH"};
  BitSignal highSpeed{"CN_HSHP"}, gearBox{"CN_EGBMD"}, partsDone{"CN_WPCNT"};
  RealSignal feedOverride{"CP_FOVER"};
  WordSignal machiningSpindle{"CP_SINP"}, surfaceSpindle{"CN_CTSPN"}, speedLimit{"CN_NMAX"};

  // Masks of bits in one word that are read or written together.
  uint32_t modeRequests = BitSignal::masks(modeRequest), toggleRequests = BitSignal::masks(toggleRequest),
           conditions = BitSignal::masks(toolMode) | BitSignal::masks({wheelOffset, misaligned});
  uint32_t pathBits = BitSignal::masks({feedRequest, overrideDisabled, thread, threadCycle, tapping, rigidTapping,
                                        reference, skip, dwell, perTurn, inPositionCheck}),
           modalBits = BitSignal::masks({surfaceSpeed, polygon, inch, highSpeed, gearBox}),
           stateBits =
               BitSignal::masks(mode) | BitSignal::masks(toggle) | BitSignal::masks({start, stop, restart, returning}),
           runBits = BitSignal::masks({interrupted, buffered, waiting}),
           motionBits = BitSignal::masks({stopped, empty});
};

struct ChannelParameters {
  ParameterPlace maxFeed{305}, feedFactor{313}, defaultSpindle{604};
  ParameterPlace rangeEnd[8] = {ParameterPlace(650), ParameterPlace(651), ParameterPlace(652), ParameterPlace(653),
                                ParameterPlace(654), ParameterPlace(655), ParameterPlace(656), ParameterPlace(657)};
  ParameterPlace auxiliary[3] = {ParameterPlace(1333), ParameterPlace(1334), ParameterPlace(1335)};
  ParameterPlace execution{1337}, waitingFirst{2201}, waitingLast{2202}, partCode{2305}, mechanics{3200};
  ParameterPlace axisName{100}, reference1{200};
};

// Transfers the M, S, T and auxiliary functions of a block from the channel handler to the PLC (man. l.9440-9560,
// 10500-10772) with the control's handshake; S includes the range of the spindle, T the place of the tool.

// The functions of one block; a function that is not in the block is negative.
struct BlockFunctions {
  std::array<int32_t, kCodesOfABlock> codes{};
  int32_t speed = -1;
  uint32_t spindle = 0; // CN_SSEL, from 1
  int32_t tool = -1;
  std::array<int32_t, 3> auxiliary{};

  BlockFunctions() {
    codes.fill(-1);
    auxiliary.fill(-1);
  }
  bool has(int32_t code) const;
  bool any() const;

  template <class Archive>
  void state(Archive& archive) {
    archive(codes, speed, spindle, tool, auxiliary);
  }
};

class ChannelFunctions {
public:
  ChannelFunctions(Links& links, uint32_t channel) : links_(links), channel_(channel), handshake_(channel) {}

  // Masks have one bit per line of the handshake.
  static constexpr uint32_t kSpeed = 1 << nc::NctFunctions::kSpeed;
  static constexpr uint32_t kTool = 1 << nc::NctFunctions::kTool;
  static uint32_t mask(const BlockFunctions& functions);

  // Sets codes and strobes of the functions in the mask.
  void issue(const BlockFunctions& functions, uint32_t mask, bool turning);
  // At the beginning of a PLC cycle: drops the strobes of the previous one.
  void dropStrobes() { handshake_.dropStrobes(links_.signals); }
  // The functions in the mask whose acknowledge is 0.
  uint32_t unacknowledged(uint32_t mask) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(handshake_);
  }

private:
  int32_t codeOf(const BlockFunctions& functions, uint32_t line, bool turning) const;
  void selectRange(const BlockFunctions& functions);
  void showPlace(int32_t type);

  Links& links_;
  uint32_t channel_;
  nc::NctFunctions handshake_;
  WordSignal spindle_{"CN_SSEL"}, range_{"CN_RNGREQ"}, magazine_{"CN_MGZNO"}, pot_{"CN_POTNO"};
  BitSignal toolExpired_{"CN_TLLE"};
  ChannelParameters parameters_;
};

} // namespace rung::sim::nct
