// The table of parameters (see parameters.h).
#include "rtlib/nc/nct/parameters.h"

#include <algorithm>
#include <iterator>

namespace rung::nc::nct {
namespace {

constexpr auto B = ParameterFormat::Bits;
constexpr auto W = ParameterFormat::Dword;
constexpr auto D = ParameterFormat::Double;
constexpr auto kGlobal = ParameterIndex::Global;
constexpr auto kGroup = ParameterIndex::MachineGroup;
constexpr auto kChannel = ParameterIndex::Channel;
constexpr auto kAxis = ParameterIndex::Axis;
constexpr auto kSpindle = ParameterIndex::Spindle;

constexpr ParameterRow kRows[] = {
    {2, 1, W, kAxis, 0, "Axis Assign", 8467},
    {100, 1, W, kAxis, 0, "Axis Name1", 8465},
    {104, 1, B, kGroup, 0, "Unit of Measure", 3100},
    {106, 1, B, kAxis, 0, "Axis Properties", 8385},
    {110, 1, D, kAxis, 1, "Indexing Amount", 8385},
    {200, 4, D, kAxis, 0, "Reference Position 1-4", 8311},
    {305, 1, D, kAxis, 10000, "Max Feed", 9898},
    {313, 1, D, kChannel, 1, "Feed Mult", 10026},
    {316, 1, W, kChannel, 1, "Jog F Contr", 10774},
    {319, 1, D, kChannel, 100, "T Meas Feed", 10055},
    {407, 1, B, kChannel, 0, "Acc Contr", 10448},
    {500, 1, W, kAxis, 0, "Axis Input Type", 7118},
    {501, 1, W, kAxis, 0, "Axis Input Address", 4224},
    {502, 1, W, kAxis, 0, "Axis Output Type", 7098},
    {503, 1, W, kAxis, 0, "Axis Output Address", 7098},
    {514, 1, B, kAxis, 0, "Servo Control", 4257},
    {516, 1, D, kAxis, 0.01, "Inpos", 8257},
    {600, 1, W, kSpindle, 0, "Spindle Input Type", 7118},
    {601, 1, W, kSpindle, 0, "Spindle Input Address", 4224},
    {602, 1, W, kSpindle, 0, "Spindle Output Type", 7098},
    {603, 1, W, kSpindle, 0, "Spindle Output Address", 7098},
    {604, 1, W, kChannel, 1, "Default Spindle", 10624},
    {605, 2, W, kSpindle, 0, "Spindle Name2, Spindle Name3", 7156},
    {607, 1, B, kSpindle, 0, "Spindle Config", 9104},
    {609, 1, B, kSpindle, 0, "Spindle Encoder Config", 8860},
    {627, 1, D, kSpindle, 5, "S N%", 8860},
    {628, 1, D, kSpindle, 10, "S NW", 8860},
    {629, 1, D, kSpindle, 5, "S N0", 8866},
    {632, 1, D, kSpindle, 10, "S Fluct%", 8870},
    {633, 1, D, kSpindle, 20, "S FluctW", 8870},
    {642, 8, D, kSpindle, 0, "R1-R8 S Min", 9218},
    {650, 8, D, kSpindle, 6000, "R1-R8 S Max", 9218},
    {658, 8, D, kSpindle, 100, "R1-R8 S Jog Speed", 8977},
    {666, 8, D, kSpindle, 6000, "R1-R8 S Ramp Up", 8852},
    {674, 8, D, kSpindle, 6000, "R1-R8 S Ramp Down", 8852},
    {684, 1, D, kSpindle, 0, "Spindle Grid Shift", 8891},
    {685, 1, D, kSpindle, 0, "Spindle Phase Shift", 9019},
    {688, 1, D, kSpindle, 0, "Min Spindle Speed G96", 9218},
    {689, 1, W, kSpindle, 0, "Spindle M Low", 9245},
    {690, 1, W, kSpindle, 0, "Spindle M High", 9245},
    {744, 8, D, kSpindle, 0.003, "R1-R8 S Inpos", 8891},
    {785, 8, D, kSpindle, 1, "R1-R8 S Synchr K", 9019},
    {801, 8, D, kSpindle, 60, "R1-R8 S OrientSpeed", 8993},
    {821, 1, W, kSpindle, 0, "No. of M Code for Spnd. Pos", 9243},
    {822, 1, D, kSpindle, 5, "Basic Angle of Spnd. Pos.", 8932},
    {823, 1, W, kSpindle, 0, "M Code for Closing S Loop", 9133},
    {900, 1, B, kAxis, 0, "Reference Type", 8535},
    {901, 1, D, kAxis, 0, "Reference Distance", 8535},
    {1000, 1, B, kAxis, 0, "Range Enable", 10352},
    {1001, 1, B, kChannel, 0, "StrkCont", 8574},
    {1002, 1, D, kAxis, 0, "Range1A Positive", 8580},
    {1003, 1, D, kAxis, 0, "Range1A Negative", 8586},
    {1004, 1, D, kAxis, 0, "Range1B Positive", 8582},
    {1005, 1, D, kAxis, 0, "Range1B Negative", 8588},
    {1101, 32, W, kGlobal, 0, "SW1-SW32 Axis Number", 7697},
    {1133, 32, D, kGlobal, 0, "SW1-SW32 Min Pos", 7703},
    {1165, 32, D, kGlobal, 0, "SW1-SW32 Max Pos", 7709},
    {1201, 8, B, kGlobal, 0, "PLCBits0-PLCBits7", 7777},
    {1209, 32, W, kGlobal, 0, "PLC DWord1-DWord32", 7858},
    {1241, 32, D, kGlobal, 0, "PLC Double1-Double32", 7870},
    {1273, 1, D, kAxis, 0, "Lubrication Distance", 8289},
    {1274, 1, B, kGlobal, 0, "PLC PrgConfig", 4674},
    {1333, 3, W, kChannel, 0, "Aux Fu Addr_1-3", 9528},
    {1337, 1, B, kChannel, 0, "Execution Config", 9712},
    {1341, 16, W, kChannel, 0, "M GR Low 1-16", 10861},
    {1357, 16, W, kChannel, 0, "M GR High 1-16", 10861},
    {1414, 1, B, kChannel, 0, "Comp. Config on Lathes", 10390},
    {1503, 1, B, kChannel, 0, "Drilling Cycles Config.", 9133},
    {1800, 1, B, kChannel, 0, "EGB Contr", 9617},
    {1802, 1, W, kChannel, 0, "EGB Slave", 8377},
    {1804, 1, D, kAxis, 0, "Retr. Dist.", 9623},
    {2101, 1, W, kAxis, 0, "Synchronous Master", 8625},
    {2102, 1, B, kAxis, 0, "Synchron Config", 8633},
    {2104, 1, W, kAxis, 0, "Composit Axis", 8646},
    {2105, 1, B, kAxis, 0, "Composit Config", 8653},
    {2107, 1, W, kAxis, 0, "Superimposed Master", 8664},
    {2108, 1, B, kAxis, 0, "Superimposed Config", 8670},
    {2201, 1, W, kGlobal, 0, "Waiting M Codes Min", 9572},
    {2202, 1, W, kGlobal, 0, "Waiting M Codes Max", 9572},
    {2305, 1, W, kChannel, 30, "Part Count M", 9613},
    {2900, 1, B, kGlobal, 1, "Tool M. Config", 8929},
    {2901, 1, B, kGlobal, 0, "Search Config", 9273},
    {2922, 1, B, kSpindle, 3, "Spindle Magazines", 10744},
    {3012, 1, W, kChannel, 0, "Sensor Input of Tool Setter S1", 10064},
    {3013, 1, W, kChannel, 0, "Sensor Input of Tool Setter S2", 10066},
    {3014, 1, W, kChannel, 0, "Sensor Input of Workpiece Setter S1", 10084},
    {3015, 1, W, kChannel, 0, "Sensor Input of Workpiece Setter S2", 10086},
    {3016, 1, B, kChannel, 0, "Tool/WP Setter Config", 10910},
    {3200, 1, W, kChannel, 0, "Mechanical Type", 9815},
    {3201, 1, W, kChannel, 0, "Tool Axis Direction", 9813},
    {3204, 1, W, kChannel, 0, "No. of the First Rot. Ax.", 9813},
    {3208, 1, W, kChannel, 0, "No. of the Second Rot. Ax.", 9813},
    {3300, 1, B, kGlobal, 3, "Pallet Contr.", 5289},
    {3301, 1, W, kGlobal, 8, "Pallet Pool Length", 5337},
    {3302, 1, W, kGlobal, 4, "No. of Custom Columns", 5418},
};

constexpr bool sorted() {
  for (size_t i = 1; i < std::size(kRows); ++i)
    if (kRows[i].number < kRows[i - 1].number + kRows[i - 1].numbers) return false;
  return true;
}
static_assert(sorted(), "parameters are in the order of their numbers and do not overlap");

} // namespace

std::span<const ParameterRow> parameterRows() { return kRows; }

const ParameterRow* findParameter(int64_t number) {
  const auto* after =
      std::upper_bound(std::begin(kRows), std::end(kRows), number,
                       [](int64_t wanted, const ParameterRow& row) { return wanted < int64_t{row.number}; });
  if (after == std::begin(kRows)) return nullptr;
  const ParameterRow* row = std::prev(after);
  return number < row->number + row->numbers ? row : nullptr;
}

const char* formatName(ParameterFormat format) {
  switch (format) {
  case ParameterFormat::Bits: return "bit";
  case ParameterFormat::Dword: return "DWORD";
  case ParameterFormat::Double: return "double";
  }
  return "";
}

const char* indexName(ParameterIndex index) {
  switch (index) {
  case ParameterIndex::Global: return "global";
  case ParameterIndex::MachineGroup: return "machine group";
  case ParameterIndex::Channel: return "channel";
  case ParameterIndex::Axis: return "axis";
  case ParameterIndex::Spindle: return "spindle";
  }
  return "";
}

} // namespace rung::nc::nct
