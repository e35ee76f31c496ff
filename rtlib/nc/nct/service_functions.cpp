// The list of service functions and execution codes (see service_functions.h).
#include "rtlib/nc/nct/service_functions.h"

#include <algorithm>
#include <iterator>

#include "rtlib/nc/nct/operand_block.h"

namespace rung::nc::nct {
namespace {

using enum FunctionAccess;
using enum WordUse;

// --- execution codes ------------------------------------------------------------------------------------------------
// 20-25 belong to functions that the manual does not describe. 118-137: the line of 118 + n is printed for the first
// three and the last; 341 and 342 come after them.
constexpr ExecutionCode kCodes[] = {
    {0, "normal execution", 6327},
    {1, "invalid function code", 6328},
    {2, "invalid amount of data", 6329},
    {3, "overwrite protected", 6330},
    {4, "memory checksum error", 6331},
    {6, "invalid channel number", 6332},
    {10, "array in non-volatile memory outside 0 to 1023", 6333},
    {11, "PLC address not from PLCNVRAM on", 6334},
    {12, "first variable + number of variables above 1024; MR 308, MR 309: invalid data number", 6335},
    {20, "macro variable does not exist", 6336},
    {21, "macro variable is not global (index 0)", 6337},
    {22, "macro variable is global (index above 0)", 6338},
    {23, "format of the macro variable does not fit the function", 6339},
    {24, "macro variable cannot be read", 6340},
    {25, "macro variable cannot be written", 6341},
    {30, "parameter does not exist; MW 90: axis index outside 0 to 31", 6342},
    {31, "parameter is not global (index 0)", 6343},
    {32, "parameter is global (index above 0)", 6344},
    {33, "format of the parameter does not fit the function", 6347},
    {40, "program is not in the memory", 6348},
    {41, "invalid channel number", 6349},
    {45, "file does not exist", 6350},
    {46, "a program is being run in the channel", 6351},
    {47, "no executable program on the pallet", 6352},
    {60, "invalid connection identifier", 6353},
    {61, "connection failed (word 3: error of Windows)", 6354},
    {62, "error while receiving or sending (word 5: error of Windows)", 6355},
    {63, "connection is not open", 6356},
    {64, "length of the data is 0 or above 350", 6357},
    {65, "no data received", 6358},
    {66, "wrong input parameters", 6359},
    {70, "invalid window number", 6360},
    {71, "no connection to the display", 6361},
    {80, "invalid drive address", 6362},
    {81, "invalid data type", 6363},
    {82, "invalid value of the data", 6364},
    {90, "internal error, the instruction cannot be used", 6365},
    {91, "no such axis, or its position loop is not open (AN_OPNA=0), or its encoder not disabled (AP_EFD=0)", 6366},
    {100, "cartridge (the first, the target) does not exist", 6369},
    {101, "pot (the first, of the target) does not exist", 6370},
    {102, "cartridge 2 (the source) does not exist", 6371},
    {103, "pot 2 (of the source) does not exist", 6372},
    {104, "no empty pot: the pot found is 0", 6373},
    {105, "type number does not fit into 8 decimal digits", 6374},
    {106, "tool info error", 6375},
    {107, "figure number error", 6376},
    {108, "life status error", 6377},
    {109, "life counter error", 6378},
    {110, "life error", 6379},
    {111, "notice life error", 6380},
    {112, "H greater than the compensation table", 6381},
    {113, "D greater than the compensation table", 6382},
    {114, "G greater than the compensation table", 6383},
    {115, "W greater than the compensation table", 6384},
    {116, "spindle speed error", 6385},
    {117, "feed error", 6386},
    {118, "user data 1 error", 6387},
    {119, "user data 2 error", 6388},
    {120, "user data 3 error", 6389},
    {121, "user data 4 error", 6390},
    {122, "user data 5 error", 6390},
    {123, "user data 6 error", 6390},
    {124, "user data 7 error", 6390},
    {125, "user data 8 error", 6390},
    {126, "user data 9 error", 6390},
    {127, "user data 10 error", 6390},
    {128, "user data 11 error", 6390},
    {129, "user data 12 error", 6390},
    {130, "user data 13 error", 6390},
    {131, "user data 14 error", 6390},
    {132, "user data 15 error", 6390},
    {133, "user data 16 error", 6390},
    {134, "user data 17 error", 6390},
    {135, "user data 18 error", 6390},
    {136, "user data 19 error", 6390},
    {137, "user data 20 error", 6391},
    {138, "life table is full", 6392},
    {139, "no tool in the pot", 6395},
    {140, "invalid data number", 6396},
    {141, "no match found", 6397},
    {200, "no EtherCAT device with this index", 6398},
    {201, "SoE or CoE is not supported by the device", 6399},
    {202, "PLC address or amount of the mailbox data is incorrect", 6400},
    {203, "timeout of reading", 6401},
    {204, "timeout of writing", 6402},
    {205, "error sent by the device (its code is in word 7)", 6403},
    {300, "pallet magazine (the first) does not exist", 6404},
    {301, "pallet place does not exist", 6405},
    {302, "second pallet magazine does not exist", 6406},
    {305, "pallet identifier outside 1 to 99999999", 6407},
    {306, "invalid pallet status", 6408},
    {307, "priority above 128", 6409},
    {308, "more programs executed than assigned", 6410},
    {309, "more than 64 programs", 6411},
    {339, "pallet place is empty", 6412},
    {341, "no pallet of the status searched in the magazine", 6413},
    {342, "working space is empty", 6414},
};

// --- blocks ---------------------------------------------------------------------------------------------------------
constexpr uint16_t kMost = kBlockWords - 2; // if the manual has no limit

constexpr BlockWord kNvramRead[] = {{2, 2, Input, "first variable in non-volatile memory (source), 0 to 1023"},
                                    {3, 3, Input, "first PLC address (destination), from PLCNVRAM on"},
                                    {4, 4, Input, "number of variables, 1 to 1024"}};
constexpr BlockWord kNvramWrite[] = {{2, 2, Input, "first variable in non-volatile memory (destination), 0 to 1023"},
                                     {3, 3, Input, "first PLC address (source), from PLCNVRAM on"},
                                     {4, 4, Input, "number of variables, 1 to 1024"}};

constexpr BlockWord kParameterRead[] = {{2, 2, Input, "parameter number"},
                                        {3, 3, Input, "first index; 0 global"},
                                        {4, kBlockWords - 1, Output, "values, one word each"}};
constexpr BlockWord kParameterReadReal[] = {{2, 2, Input, "parameter number"},
                                            {3, 3, Input, "first index; 0 global"},
                                            {4, kBlockWords - 1, Output, "values, a double each"}};
constexpr BlockWord kParameterWrite[] = {{2, 2, Input, "parameter number"},
                                         {3, 3, Input, "first index; 0 global"},
                                         {4, kBlockWords - 1, Input, "values, one word each"}};
constexpr BlockWord kParameterWriteReal[] = {{2, 2, Input, "parameter number"},
                                             {3, 3, Input, "first index; 0 global"},
                                             {4, kBlockWords - 1, Input, "values, a double each"}};

constexpr BlockWord kProgram[] = {{2, 2, Input, "program number"}, {3, 3, Input, "channel, 1 to 8"}};
constexpr BlockWord kPalletProgram[] = {{2, 2, Input, "identifier of the pallet in the working space"},
                                        {3, 3, Input, "channel, 1 to 8"}};

constexpr BlockWord kConnectionOpen[] = {{2, 2, Input, "connection identifier, 1"},
                                         {3, 3, Output, "error of Windows, with code 61"},
                                         {4, 4, Input, "protocol: 1 UDP, 2 TCP server, 3 TCP client"},
                                         {5, 5, Input, "IP address of the target, #$C0A8010C is 192.168.1.12"},
                                         {6, 6, Input, "port"}};
constexpr BlockWord kConnectionClose[] = {{2, 2, Input, "connection identifier, 1"}};
constexpr BlockWord kReceive[] = {
    {2, 2, Input, "connection identifier, 1"},  {3, 3, Input, "first PLC address of the data"},
    {4, 4, Input, "number of words, 1 to 350"}, {5, 5, Output, "error of Windows, with code 62"},
    {6, 6, Output, "IP address of the source"}, {7, 7, Output, "port of the source"}};
constexpr BlockWord kSend[] = {{2, 2, Input, "connection identifier, 1"},
                               {3, 3, Input, "first PLC address of the data"},
                               {4, 4, Input, "number of words, 1 to 350"},
                               {5, 5, Output, "error of Windows, with code 62"},
                               {6, 6, Optional, "IP address of the target, UDP only"},
                               {7, 7, Optional, "port of the target, UDP only"}};

constexpr BlockWord kWindow[] = {{2, 2, Input, "window identifier"},
                                 {3, 3, Input, "channel: 0 independent, 1 to 8"},
                                 {4, 4, Optional, "parameter 1"},
                                 {5, 5, Optional, "parameter 2"}};
constexpr BlockWord kDrive[] = {
    {2, 2, Input, "drive address as in N0501 or N0601"},
    {3, 3, Input,
     "data: 0 speed [1/min], 1 current [10 mA], 2 load [%], 3 bus voltage [V], 4 temperature [C], 5 power [kW]"},
    {4, 4, Input, "value"}};
constexpr BlockWord kPosition[] = {{2, 2, Input, "axis index, 0 to 31"},
                                   {3, 4, Input, "position in machine coordinates (double)"}};

constexpr BlockWord kExchange[] = {
    {2, 2, Input, "cartridge 1"}, {3, 3, Input, "pot 1"}, {4, 4, Input, "cartridge 2"}, {5, 5, Input, "pot 2"}};
constexpr BlockWord kEmptyPot[] = {{2, 2, Input, "target cartridge"},
                                   {3, 3, Input, "pot to start from"},
                                   {4, 4, Input, "direction: 0 both, 1 positive, 2 negative"},
                                   {5, 5, Input, "source cartridge"},
                                   {6, 6, Input, "source pot"},
                                   {7, 7, Output, "pot found"},
                                   {8, 8, Output, "rotation: 1 positive, 2 negative"}};

constexpr std::array<BlockWord, 18> toolRecord(WordUse use) {
  return {{{2, 2, Input, "cartridge"},
           {3, 3, Input, "pot"},
           {4, 4, use, "type number, 1 to 99999999"},
           {5, 5, use, "tool info: bits 0 valid, 1 life by time, 2 large, 3 locked, 4 searchable"},
           {6, 6, use, "figure number"},
           {7, 7, use, "life status: 0 not performed, 1 not used, 2 used, 3 expired, 4 broken"},
           {8, 8, use, "life counter"},
           {9, 9, use, "life"},
           {10, 10, use, "notice life"},
           {11, 11, use, "H"},
           {12, 12, use, "D"},
           {13, 13, use, "G"},
           {14, 14, use, "W"},
           {15, 15, use, "S"},
           {16, 17, use, "F (double)"},
           {18, 18, use, "user data 1 (8 bits)"},
           {19, 20, use, "user data 2 (double)"},
           {21, 56, use, "user data 3 to 20 (a double each)"}}};
}
constexpr auto kToolRead = toolRecord(Output);
constexpr auto kToolWrite = toolRecord(Input);

constexpr BlockWord kPot[] = {{2, 2, Input, "cartridge"}, {3, 3, Input, "pot"}};
constexpr std::string_view kToolData =
    "data number: 1 type number, 2 tool info, 3 figure, 4 life status, 5 life counter, 6 life, 7 notice life, 8 H, 9 "
    "D, "
    "10 G, 11 W, 12 S, 13 F (double), 14 user data 1, 15 to 33 user data 2 to 20 (double)";
constexpr BlockWord kToolDatumWrite[] = {{2, 2, Input, "cartridge"},
                                         {3, 3, Input, "pot"},
                                         {4, 4, Input, kToolData},
                                         {5, 6, Input, "value, one word or a double"}};
constexpr BlockWord kToolDatumRead[] = {{2, 2, Input, "cartridge"},
                                        {3, 3, Input, "pot"},
                                        {4, 4, Input, kToolData},
                                        {5, 6, Output, "value, one word or a double"}};
constexpr BlockWord kToolSearch[] = {{2, 2, Output, "cartridge found"},
                                     {3, 3, Output, "pot found"},
                                     {4, 4, Input, "data number: 14 user data 1, 15 to 33 user data 2 to 20 (double)"},
                                     {5, 6, Input, "value searched, one word or a double"}};

constexpr BlockWord kInterchange[] = {{2, 2, Input, "pallet magazine 1: 1, 10, 11"},
                                      {3, 3, Input, "place 1"},
                                      {4, 4, Input, "pallet magazine 2: 0, 10, 11"}};
constexpr std::array<BlockWord, 11> palletRecord(WordUse use) {
  return {{{2, 2, Input, "pallet magazine"},
           {3, 3, Input, "place; 1 in magazines 10 and 11"},
           {4, 4, use, "pallet identifier, 1 to 99999999"},
           {5, 5, use, "status"},
           {6, 6, use, "priority, up to 128"},
           {7, 7, use, "programs executed"},
           {8, 8, use, "programs assigned, up to 64"},
           {9, 9, use, "custom 1 (8 bits)"},
           {10, 11, use, "custom 2 (double)"},
           {12, 13, use, "custom 3 (double)"},
           {14, 15, use, "custom 4 (double)"}}};
}
constexpr auto kPalletRead = palletRecord(Output);
constexpr auto kPalletWrite = palletRecord(Input);
constexpr std::string_view kPalletData = "data number: 1 identifier, 2 status, 3 priority, 4 programs executed, 5 "
                                         "programs assigned, 6 program identifiers, 7 "
                                         "custom 1, 8 to 10 custom 2 to 4 (double)";
constexpr BlockWord kPalletDatumWrite[] = {{2, 2, Input, "pallet magazine"},
                                           {3, 3, Input, "place; 1 in magazines 10 and 11"},
                                           {4, 4, Input, kPalletData},
                                           {5, 68, Input, "value: one word, a double, or a word a program"}};
constexpr BlockWord kPalletDatumRead[] = {{2, 2, Input, "pallet magazine"},
                                          {3, 3, Input, "place; 1 in magazines 10 and 11"},
                                          {4, 4, Input, kPalletData},
                                          {5, 68, Output, "value: one word, a double, or a word a program"}};
constexpr BlockWord kPalletSearch[] = {
    {2, 2, Input, kPalletData},           {3, 3, Input, "value searched"},
    {4, 4, Input, "place to start from"}, {5, 5, Input, "direction: 0 both, 1 positive, 2 negative"},
    {6, 6, Output, "place found"},        {7, 7, Output, "rotation: 1 positive, 2 negative"}};
constexpr BlockWord kPalletColumn[] = {{2, 2, Input, kPalletData},
                                       {3, 3, Input, "pallet magazine"},
                                       {4, 4, Input, "place to start from"},
                                       {5, kBlockWords - 1, Output, "values, going round the magazine"}};

constexpr BlockWord kMailboxRead[] = {
    {2, 2, Input, "protocol: 3 CoE, 5 SoE, 15 VoE"},
    {3, 3, Input, "device index"},
    {4, 4, Input, "amount of data in bytes"},
    {5, 5, Input, "PLC address to which the data go"},
    {6, 6, Input, "CoE: index (bits 0 to 15), subindex (16 to 23); SoE: IDN (0 to 15), drive index (16 to 23)"},
    {7, 7, Output, "error code of the device"},
    {8, 8, Input, "CoE: CompleteAccess 0 or 1; SoE: ElementFlags"}};
constexpr BlockWord kMailboxWrite[] = {
    {2, 2, Input, "protocol: 3 CoE, 5 SoE, 15 VoE"},
    {3, 3, Input, "device index"},
    {4, 4, Input, "amount of data in bytes"},
    {5, 5, Input, "PLC address from which the data come"},
    {6, 6, Input, "CoE: index (bits 0 to 15), subindex (16 to 23); SoE: IDN (0 to 15), drive index (16 to 23)"},
    {7, 7, Output, "error code of the device"},
    {8, 8, Input, "CoE: CompleteAccess 0 or 1; SoE: ElementFlags"}};

// --- functions ------------------------------------------------------------------------------------------------------
using Ranges3 = std::array<NumberRange, 3>;
using Ranges5 = std::array<NumberRange, 5>;

constexpr NumberRange one(uint16_t n) { return {n, n}; }
constexpr Ranges3 only(uint16_t n) { return {one(n)}; }
constexpr Ranges3 kToolAmounts = {{{3, 14}, {16, 17}, {19, 55, 2}}};
constexpr Ranges3 kPalletAmounts = {{{3, 8}, {10, 14, 2}}};

// Misprints of the sections: MW 40 "not 1", though 2 is required (l.3923), MR 201 and MW 202 "not 3" (l.6132, l.6316).
// MW 40 has no code for a channel that does not exist: 41 of the list is used.
constexpr ServiceFunction kFunctions[] = {
    {10, Read, "read variables from non-volatile memory", only(3), kNvramRead, Ranges5{{{0, 2}, one(4), {10, 12}}},
     "6.19.1", 3563},
    {11, Write, "write variables to non-volatile memory", only(3), kNvramWrite, Ranges5{{{0, 2}, {10, 12}}}, "6.19.2",
     3604},
    {31, Read, "read DWORD parameters", Ranges3{{{3, kMost}}}, kParameterRead, Ranges5{{{0, 2}, one(4), {30, 33}}},
     "6.20.1", 3674},
    {32, Read, "read double parameters", Ranges3{{{4, kMost, 2}}}, kParameterReadReal,
     Ranges5{{{0, 2}, one(4), {30, 33}}}, "6.20.2", 3728},
    {34, Write, "write DWORD parameters", Ranges3{{{3, kMost}}}, kParameterWrite, Ranges5{{{0, 2}, {30, 33}}}, "6.20.3",
     3786},
    {35, Write, "write double parameters", Ranges3{{{4, kMost, 2}}}, kParameterWriteReal,
     Ranges5{{{0, 2}, one(4), {30, 33}}}, "6.20.4", 3837},
    {40, Write, "assign a program by its number", only(2), kProgram, Ranges5{{{0, 2}, {40, 41}}}, "6.21.1", 3897},
    {60, Write, "open a network connection", only(5), kConnectionOpen, Ranges5{{{0, 2}, {60, 61}, one(66)}}, "6.22.1",
     3942},
    {61, Write, "close a network connection", only(1), kConnectionClose, Ranges5{{{0, 2}, one(60)}}, "6.22.2", 3986},
    {62, Read, "receive network data", Ranges3{{{3, 6}}}, kReceive, Ranges5{{{0, 2}, one(60), {62, 65}}}, "6.22.3",
     4019},
    {63, Write, "send network data", Ranges3{{{3, 6}}}, kSend, Ranges5{{{0, 2}, one(60), {62, 64}}}, "6.22.4", 4066},
    {70, Write, "open a window on the screen", Ranges3{{{2, 4}}}, kWindow, Ranges5{{{0, 2}, one(6), {70, 71}}}, "6.23",
     4114},
    {81, Write, "hand over drive data", only(3), kDrive, Ranges5{{{0, 2}, {80, 82}}}, "6.24", 4218},
    {90, Write, "write the position of an axis", only(3), kPosition, Ranges5{{{0, 2}, one(30), {90, 91}}}, "6.25",
     4265},
    {100, Write, "exchange the data numbers of two pots", only(4), kExchange, Ranges5{{{0, 3}, {100, 103}}}, "6.26.4",
     4617},
    {101, Read, "search an empty pot", only(7), kEmptyPot, Ranges5{{{0, 3}, {100, 104}}}, "6.26.5", 4668},
    {102, Write, "register a new tool", kToolAmounts, kToolWrite, Ranges5{{{0, 3}, {100, 101}, {105, 138}}}, "6.26.6",
     4723},
    {103, Write, "write the data of a tool", kToolAmounts, kToolWrite,
     Ranges5{{{0, 3}, {100, 101}, {105, 137}, one(139)}}, "6.26.7", 4838},
    {104, Read, "read the data of a tool", kToolAmounts, kToolRead, Ranges5{{{0, 2}, {100, 101}, one(139)}}, "6.26.8",
     4949},
    {105, Write, "delete the data of a tool", only(2), kPot, Ranges5{{{0, 3}, {100, 101}, one(139)}}, "6.26.9", 5035},
    {106, Write, "write one datum of a tool", Ranges3{{{4, 5}}}, kToolDatumWrite,
     Ranges5{{{0, 3}, {100, 101}, {105, 137}, {139, 140}}}, "6.26.10", 5074},
    {107, Read, "read one datum of a tool", Ranges3{{{4, 5}}}, kToolDatumRead,
     Ranges5{{{0, 2}, {100, 101}, {139, 140}}}, "6.26.11", 5164},
    {108, Read, "search a tool by user data", Ranges3{{{4, 5}}}, kToolSearch, Ranges5{{{0, 2}, {140, 141}}}, "6.26.12",
     5235},
    {300, Write, "interchange two pallets", only(3), kInterchange, Ranges5{{{0, 3}, {300, 302}}}, "6.27.2", 5432},
    {303, Write, "write the data of a pallet", kPalletAmounts, kPalletWrite,
     Ranges5{{{0, 3}, {300, 301}, {305, 309}, one(339)}}, "6.27.3", 5495},
    {304, Read, "read the data of a pallet", kPalletAmounts, kPalletRead, Ranges5{{{0, 3}, {300, 301}, one(339)}},
     "6.27.4", 5569},
    {306, Write, "write one datum of a pallet", Ranges3{{{4, 67}}}, kPalletDatumWrite,
     Ranges5{{{0, 3}, {300, 301}, {305, 309}, one(339)}}, "6.27.5", 5636},
    {307, Read, "read one datum of a pallet", Ranges3{{{4, 67}}}, kPalletDatumRead,
     Ranges5{{{0, 3}, {300, 301}, one(339)}}, "6.27.6", 5710},
    {308, Read, "search a pallet", only(6), kPalletSearch, Ranges5{{{0, 2}, one(12), one(301), one(339), one(341)}},
     "6.27.7", 5775},
    {309, Read, "read a column of a pallet magazine", Ranges3{{{4, kMost}}}, kPalletColumn,
     Ranges5{{{0, 2}, one(12), {300, 301}, one(339)}}, "6.27.8", 5824},
    {41, Write, "assign a program by its pallet", only(2), kPalletProgram,
     Ranges5{{{0, 2}, one(41), {45, 47}, one(342)}}, "6.27.9", 5888},
    {201, Read, "read data of an EtherCAT mailbox", Ranges3{{{4, 7}}}, kMailboxRead,
     Ranges5{{{0, 2}, {200, 203}, one(205)}}, "6.28.1", 5954},
    {202, Write, "write data of an EtherCAT mailbox", Ranges3{{{4, 7}}}, kMailboxWrite,
     Ranges5{{{0, 2}, {200, 202}, {204, 205}}}, "6.28.2", 6144},
};

template <size_t kSize>
constexpr bool anyContains(const std::array<NumberRange, kSize>& ranges, int64_t n) {
  for (size_t i = 0; i < kSize; ++i)
    if ((i == 0 || ranges[i].first != 0) && ranges[i].contains(n)) return true;
  return false;
}

constexpr bool codesAreSound() {
  for (size_t i = 1; i < std::size(kCodes); ++i)
    if (kCodes[i].code <= kCodes[i - 1].code) return false;
  return true;
}
static_assert(codesAreSound(), "execution codes are out of order");

constexpr bool isSound(const ServiceFunction& f) {
  if (f.title.empty() || f.section.empty() || f.line == 0 || f.amounts[0].first == 0 || f.codes[0].last < 2)
    return false;
  uint16_t next = 2;
  for (const BlockWord& word : f.words) {
    if (word.first != next || word.last < word.first || word.last >= kBlockWords) return false;
    next = static_cast<uint16_t>(word.last + 1);
  }
  return true;
}
constexpr bool functionsAreSound() {
  for (const ServiceFunction& f : kFunctions) {
    if (!isSound(f)) return false;
    for (const ServiceFunction& other : kFunctions)
      if (&other != &f && other.code == f.code) return false;
  }
  return true;
}
static_assert(functionsAreSound(), "a service function appears twice, lacks its place in the manual or a word");

} // namespace

bool ServiceFunction::allowsAmount(int64_t amount) const { return amount > 0 && anyContains(amounts, amount); }
bool ServiceFunction::hasCode(uint32_t executionCode) const { return anyContains(codes, executionCode); }

std::span<const ExecutionCode> executionCodes() { return kCodes; }

const ExecutionCode* findExecutionCode(uint32_t code) {
  const auto found = std::ranges::lower_bound(kCodes, code, {}, &ExecutionCode::code);
  return found != std::end(kCodes) && found->code == code ? &*found : nullptr;
}

std::span<const ServiceFunction> serviceFunctions() { return kFunctions; }

const ServiceFunction* findServiceFunction(int64_t code) {
  const auto found = std::ranges::find_if(kFunctions, [&](const ServiceFunction& f) { return f.code == code; });
  return found == std::end(kFunctions) ? nullptr : &*found;
}

} // namespace rung::nc::nct
