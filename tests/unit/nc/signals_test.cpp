// The generated signal tables: all rows of the CSV, places, no overlaps, lookup.
#include "rtlib/nc/fanuc/signals.h"
#include "rtlib/nc/gsk/signals.h"
#include "rtlib/nc/nct/signals.h"
#include "rtlib/nc/technol/signals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace rung::nc {
namespace {

const Signal& get(const SignalTable& table, std::string_view name, std::string_view area = {}) {
  const Signal* signal = findSignal(table, name, area);
  if (signal == nullptr) throw std::runtime_error("no signal " + std::string(name));
  return *signal;
}

/// Area, byte and bit of a signal as one text.
std::string place(const Signal& s) {
  return std::string(s.area) + " " + std::to_string(s.byteOffset) + "." + std::to_string(s.bit);
}

/// Every bit that the signal covers in its area.
std::vector<uint32_t> bitsOf(const Signal& s) {
  std::vector<uint32_t> bits;
  for (uint32_t element = 0; element < s.count; ++element) {
    const bool packed = s.type == SignalType::Bit && s.strideBytes == 0;
    const uint32_t start = 8 * (s.byteOffset + element * s.strideBytes) + s.bit + (packed ? element : 0);
    const uint32_t width =
        s.type == SignalType::Bit ? 1 : 8 * (s.type == SignalType::Struct ? s.strideBytes : elementBytes(s.type));
    for (uint32_t i = 0; i < width; ++i) bits.push_back(start + i);
  }
  return bits;
}

/// Pairs of the wanted signals that share a bit of one area.
template <typename Use>
std::vector<std::string> overlaps(const SignalTable& table, Use use) {
  std::map<std::string, std::vector<const Signal*>> owners; // of each bit of an area
  std::vector<std::string> found;
  for (const Signal& s : table) {
    if (!use(s)) continue;
    std::vector<const Signal*>& owner = owners[s.area];
    for (const uint32_t bit : bitsOf(s)) {
      if (bit >= owner.size()) owner.resize(bit + 1);
      if (owner[bit] != nullptr && owner[bit] != &s)
        found.push_back(std::string(s.symbol) + " and " + owner[bit]->symbol);
      owner[bit] = &s;
    }
  }
  return found;
}

/// Lines of a table's CSV below its head.
size_t rows(const char* dialect) {
  std::ifstream in("rtlib/nc/" + std::string(dialect) + "/signals.csv");
  std::string line;
  size_t lines = 0;
  while (std::getline(in, line)) ++lines;
  if (lines == 0) throw std::runtime_error(std::string(dialect) + " has no signals.csv");
  return lines - 1;
}

TEST(Signals, EveryRowIsASignal) {
  EXPECT_EQ(fanucSignals().size(), rows("fanuc"));
  EXPECT_EQ(gskSignals().size(), rows("gsk"));
  EXPECT_EQ(nctSignals().size(), rows("nct"));
  EXPECT_EQ(technolSignals().size(), rows("technol"));
}

TEST(Signals, EveryNameIsFound) {
  for (const SignalTable* table : {&fanucSignals(), &gskSignals(), &nctSignals(), &technolSignals()}) {
    ASSERT_EQ(table->byName.size(), table->size());
    for (const Signal& s : *table) {
      const Signal* found = findSignal(*table, s.symbol, s.area);
      ASSERT_NE(found, nullptr) << s.symbol;
      EXPECT_STREQ(found->symbol, s.symbol);
    }
  }
}

TEST(Signals, NamesAreUniqueInTheirArea) {
  for (const SignalTable* table : {&fanucSignals(), &gskSignals(), &nctSignals(), &technolSignals()}) {
    std::set<std::pair<std::string, std::string>> seen;
    for (const Signal& s : *table) {
      std::string name = s.symbol;
      if (table->ignoreCase)
        std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
      EXPECT_TRUE(seen.emplace(s.area, name).second) << s.area << ' ' << s.symbol;
    }
  }
}

TEST(Signals, NotesAreNoPartOfAMeaning) {
  const Signal& stop = get(gskSignals(), "X_ESP");
  EXPECT_STREQ(stop.meaning, "emergency stop input, 0 = stop");
  EXPECT_EQ(noteOf(stop), "manual writes *ESP for both X008.4 and G008.4; symbol made unique here");
  EXPECT_EQ(meaningWithNote(stop), std::string(stop.meaning) + " (" + std::string(noteOf(stop)) + ")");
  EXPECT_EQ(noteOf(get(gskSignals(), "KEY_AUTO")), "");
  EXPECT_EQ(meaningWithNote(get(gskSignals(), "KEY_AUTO")), "panel key: automatic mode");
  EXPECT_EQ(noteOf(get(technolSignals(), "Pos6Shift_Ax")), "unit printed as mm/min");
  for (const SignalTable* table : {&fanucSignals(), &gskSignals(), &nctSignals(), &technolSignals()})
    for (const Signal& s : *table)
      for (const char* word : {"appendix", "misprint", "made unique", "symbol proposed", " // "})
        EXPECT_EQ(std::string_view(s.meaning).find(word), std::string_view::npos) << s.symbol << ": " << s.meaning;
}

TEST(Signals, UnknownNameIsNull) {
  EXPECT_EQ(findSignal(gskSignals(), "NO_SUCH_SIGNAL"), nullptr);
  EXPECT_EQ(findSignal(gskSignals(), ""), nullptr);
  EXPECT_EQ(findSignal(nctSignals(), "~~~~"), nullptr);
  EXPECT_EQ(findSignal(technolSignals(), "MPXPI", "W"), nullptr);
}

TEST(Signals, CaseMattersWhereTheDialectSays) {
  EXPECT_EQ(&get(fanucSignals(), "*esp"), &get(fanucSignals(), "*ESP"));
  EXPECT_EQ(findSignal(gskSignals(), "key_auto"), nullptr);
  EXPECT_EQ(findSignal(nctSignals(), "mb_start"), nullptr);
  EXPECT_EQ(&get(technolSignals(), "mpxpi"), &get(technolSignals(), "MPXPI"));
  EXPECT_EQ(&get(technolSignals(), "DWAXNCFEED"), &get(technolSignals(), "dwAxNcFeed"));
}

TEST(GskSignals, PrintedAddresses) {
  const SignalTable& t = gskSignals();
  EXPECT_EQ(place(get(t, "KEY_AUTO")), "X 0.0");
  EXPECT_EQ(place(get(t, "OP")), "F 0.7");
  EXPECT_EQ(place(get(t, "RST")), "F 1.1");
  EXPECT_EQ(place(get(t, "M00")), "F 10.0"); // man. l.5885
  EXPECT_EQ(place(get(t, "M31")), "F 13.7"); // man. l.5888
  EXPECT_EQ(place(get(t, "ED0")), "G 0.0");
  EXPECT_EQ(get(t, "KEY_AUTO").direction, Direction::In);
  EXPECT_EQ(get(t, "ED0").direction, Direction::Out);
  EXPECT_EQ(get(t, "KEY_AUTO").manualLine, 614u);
  EXPECT_STREQ(get(t, "KEY_AUTO").address, "X000");
}

TEST(GskSignals, AreasAndDirectionsAgree) {
  const std::map<char, uint32_t> bytes = {{'X', 128}, {'Y', 128}, {'F', 256}, {'G', 256}};
  for (const Signal& s : gskSignals()) {
    EXPECT_EQ(s.direction == Direction::In, s.area[0] == 'X' || s.area[0] == 'F') << s.symbol;
    EXPECT_LE(s.byteOffset + std::max(1u, elementBytes(s.type)), bytes.at(s.area[0])) << s.symbol;
    EXPECT_FALSE(s.inferred) << s.symbol;
  }
}

TEST(FanucSignals, Addresses) {
  const SignalTable& t = fanucSignals();
  EXPECT_EQ(place(get(t, "*ESP")), "G 8.4"); // not X8.4
  EXPECT_EQ(place(get(t, "X_ESP")), "X 8.4");
  EXPECT_EQ(place(get(t, "BF")), "F 7.7"); // not the old address
  EXPECT_EQ(place(get(t, "ESTB")), "G 2.7");
  EXPECT_EQ(place(get(t, "EBUFC")), "G 166.7"); // "as group A"
  EXPECT_EQ(place(get(t, "EBSYD")), "F 139.7");
  EXPECT_EQ(place(get(t, "SRVB")), "G 74.4");
  EXPECT_EQ(get(t, "M00~M31").type, SignalType::Dword);
  EXPECT_EQ(get(t, "*JV0~*JV15").type, SignalType::Word);
  EXPECT_EQ(get(t, "EBUFC").manualLine, 0u); // no manual is at hand
}

TEST(FanucSignals, EachSaysHowCertainItIs) {
  size_t high = 0;
  for (const Signal& s : fanucSignals()) {
    const std::string_view certainty = s.group;
    EXPECT_TRUE(certainty == "high" || certainty == "medium") << s.symbol;
    high += certainty == "high" ? 1 : 0;
    EXPECT_EQ(s.direction == Direction::In, s.area[0] == 'X' || s.area[0] == 'F') << s.symbol;
    EXPECT_LT(s.byteOffset, 768u) << s.symbol; // of path 1
  }
  EXPECT_STREQ(get(fanucSignals(), "FIN").group, "high");
  EXPECT_GT(high, 700u);
}

TEST(NctSignals, AllocationIsDense) {
  const SignalTable& t = nctSignals();
  EXPECT_EQ(areaBytes(t, "M"), 4u * (2 + 1295)); // 1,295 words from 0002 on
  EXPECT_EQ(overlaps(t, [](const Signal& s) { return s.type != SignalType::Bit; }), std::vector<std::string>{});
  EXPECT_EQ(overlaps(t, [](const Signal& s) { return s.type == SignalType::Bit; }), std::vector<std::string>{});
  std::set<uint32_t> words;
  for (const Signal& s : t)
    for (uint32_t i = 0; i < s.count; ++i)
      for (uint32_t byte = 0; byte < s.strideBytes; byte += 4)
        words.insert(s.byteOffset / 4 + i * s.strideBytes / 4 + byte / 4);
  EXPECT_EQ(words.size(), 1295u);
  EXPECT_EQ(*words.begin(), 2u);
}

TEST(NctSignals, PlacesFollowTheRule) {
  const SignalTable& t = nctSignals();
  EXPECT_EQ(place(get(t, "MKBTNS0")), "M 8.0"); // first input: word 0002
  EXPECT_EQ(get(t, "MKBTNS0").count, 4u);
  EXPECT_EQ(place(get(t, "MB_START")), "M 8.0"); // MKBTNS0.00
  EXPECT_EQ(place(get(t, "MB_B20")), "M 8.20");  // 21st row of the lower buttons
  EXPECT_TRUE(get(t, "MB_START").inferred);
  EXPECT_EQ(get(t, "INP071").byteOffset, get(t, "INP000").byteOffset + 4 * 15); // man. l.6812
  EXPECT_EQ(get(t, "OUT070").byteOffset, get(t, "OUT000").byteOffset + 4 * 7);  // man. l.6820
  EXPECT_EQ(get(t, "CN_1100").byteOffset, get(t, "CN_1132").byteOffset);        // man. l.10540
  EXPECT_EQ(get(t, "CN_1131").bit, 31u);
  EXPECT_FALSE(get(t, "CN_1131").inferred);
  EXPECT_EQ(get(t, "SP_SOVER").type, SignalType::Real);
  EXPECT_EQ(get(t, "SP_SOVER").strideBytes, 8u); // indexed by 2 words, man. l.9297
}

TEST(NctSignals, InputsStandBeforeOutputs) {
  uint32_t lastInput = 0, firstOutput = UINT32_MAX;
  for (const Signal& s : nctSignals()) {
    if (s.direction == Direction::In) lastInput = std::max(lastInput, s.byteOffset + (s.count - 1) * s.strideBytes);
    if (s.direction == Direction::Out) firstOutput = std::min(firstOutput, s.byteOffset);
  }
  EXPECT_LT(lastInput, firstOutput);
}

TEST(TechnolSignals, NothingOverlapsButBitsInTheirCell) {
  const auto hasOwnPlace = [](const Signal& s) { return std::string_view(s.area) != "W"; };
  const auto inCell = [](const std::string& pair) {
    const SignalTable& t = technolSignals();
    const Signal& a = get(t, pair.substr(0, pair.find(' ')), "I");
    const Signal& b = get(t, pair.substr(pair.rfind(' ') + 1), "I");
    return (a.type == SignalType::Bit) != (b.type == SignalType::Bit);
  };
  std::vector<std::string> pairs = overlaps(technolSignals(), hasOwnPlace);
  EXPECT_EQ(pairs.size(), 8u * 11 + 6 + 2 + 3 + 1 + 2 + 1 + 4 + 2 + 8);
  std::erase_if(pairs, inCell);
  EXPECT_EQ(pairs, std::vector<std::string>{});
}

TEST(TechnolSignals, PackedInTableOrder) {
  const SignalTable& t = technolSignals();
  EXPECT_EQ(place(get(t, "B_POL_EX")), "I 0.0");
  EXPECT_EQ(place(get(t, "B_INK_EX")), "I 128.0");
  EXPECT_EQ(place(get(t, "B_POL")), "I 256.0");
  EXPECT_EQ(get(t, "PB12").byteOffset, get(t, "PB11").byteOffset + 1); // WORD.PB11, man. l.6064
  EXPECT_EQ(get(t, "BZH10").byteOffset, get(t, "BZH09").byteOffset + 1);
  EXPECT_EQ(get(t, "P128IN").byteOffset, get(t, "P1IN").byteOffset + 127);
  EXPECT_EQ(get(t, "P95OUT").byteOffset, get(t, "P0OUT").byteOffset + 95);
  EXPECT_EQ(get(t, "PLC_MEM_BACKUP").count, 10000u);
  EXPECT_EQ(get(t, "M04PI").bit, (get(t, "M03PI").bit + 1) % 8);
}

TEST(TechnolSignals, BitsLieInTheirPrintedCell) {
  const SignalTable& t = technolSignals();
  EXPECT_EQ(get(t, "MPXPI").byteOffset, get(t, "BZH08PI").byteOffset); // man. l.6180
  EXPECT_EQ(get(t, "MP8PI").bit, 7u);
  EXPECT_EQ(get(t, "MP9PI").byteOffset, get(t, "BZH08PI2").byteOffset);
  EXPECT_EQ(get(t, "PO_OSX").byteOffset, get(t, "PB20").byteOffset);
  EXPECT_EQ(place(get(t, "EXT_AKRR_U")), "I " + std::to_string(get(t, "AKRR_CNTR").byteOffset) + ".7");
}

TEST(TechnolSignals, NoByteHasBitsOfTwoDirectionsUnlessPrinted) {
  std::map<std::pair<std::string, uint32_t>, std::set<Direction>> directions;
  for (const Signal& s : technolSignals())
    if (s.type == SignalType::Bit && !s.inferred && std::string_view(s.area) != "W")
      for (const uint32_t bit : bitsOf(s)) directions[{s.area, bit / 8}].insert(s.direction);
  for (const auto& [byte, found] : directions) EXPECT_EQ(found.size(), 1u) << byte.first << ' ' << byte.second;
}

TEST(TechnolSignals, WeightsCountFromTheirCell) {
  const SignalTable& t = technolSignals();
  EXPECT_EQ(place(get(t, "CAN_AX_READY")), "W 0.0");
  EXPECT_EQ(place(get(t, "CAN_WRN_MOTREF")), "W 1.0"); // CAN_DRIVE_MSTAT+1, man. l.9361
  EXPECT_EQ(place(get(t, "POS_STV_JEDE")), "W 0.0");
  EXPECT_EQ(place(get(t, "POS_STV_DISP")), "W 1.0");
  EXPECT_EQ(place(get(t, "AOUT_CONNECTED")), "W 0.1");
}

TEST(TechnolSignals, StructuresHaveMembersAndSizes) {
  const SignalTable& t = technolSignals();
  EXPECT_EQ(place(get(t, "TIME_INFOS.TIME_SEC")), "TIME_INFOS 3.0");
  EXPECT_EQ(areaBytes(t, "TCANMSGS"), 12u);
  EXPECT_EQ(areaBytes(t, "TOC_DISPLS"), 8u);
  EXPECT_STREQ(get(t, "DISPTOC1").structure, "TOC_DISPLS");
  EXPECT_EQ(get(t, "DISPTOC1").strideBytes, 8u);
  EXPECT_EQ(get(t, "INOUTS.RESP").byteOffset, get(t, "INOUTS.SEND").byteOffset + 12);
  for (const Signal& s : t) {
    const uint32_t bytes = s.type == SignalType::Struct ? areaBytes(t, s.structure) : elementBytes(s.type);
    EXPECT_EQ(s.strideBytes, bytes) << s.symbol;
  }
}

TEST(TechnolSignals, SameNameInTwoAreasIsToldApart) {
  const SignalTable& t = technolSignals();
  EXPECT_STREQ(get(t, "INPOS").area, "I"); // RTM.Control and SHARE have "InPos"
  EXPECT_STREQ(get(t, "INPOS", "RTM.Control").symbol, "InPos");
  EXPECT_NE(&get(t, "TouchProbe0", "RTM.Axis"), &get(t, "TouchProbe0", "RTM.Control"));
  EXPECT_STREQ(get(t, "BLK[].T").area, "BLK");
  EXPECT_STREQ(get(t, "MoveDisReq", "RTM.Servo.Edrv").group, "RTM.Servo[x].Edrv");
}

} // namespace
} // namespace rung::nc
