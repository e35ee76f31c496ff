// The table of ranges (inventory §3.3).
#include "frontend/dialects/fanuc/areas.h"

namespace rung::frontend::fanuc {
namespace {

// F and G of all paths: path n is at +1000(n-1).
template <size_t Paths>
constexpr std::array<ByteRange, Paths> pathParts(uint32_t last) {
  std::array<ByteRange, Paths> parts{};
  for (uint32_t path = 0; path < Paths; ++path) parts[path] = {1000 * path, 1000 * path + last};
  return parts;
}

constexpr ByteRange kMachineSa[] = {{0, 127}, {1000, 1019}};
constexpr ByteRange kMachineSaOut[] = {{0, 127}, {1000, 1014}};
constexpr ByteRange kMachine[] = {{0, 127}, {200, 327}, {400, 527}, {600, 727}, {1000, 1127}};
constexpr auto kCnc2Small = pathParts<2>(255);
constexpr auto kCnc2 = pathParts<2>(767);
constexpr auto kCnc3 = pathParts<3>(767);
constexpr auto kCnc10 = pathParts<10>(767);
constexpr auto kCnc15 = pathParts<15>(767);

constexpr ByteRange kR[kPmcCount][2] = {{{0, 999}, {9000, 9099}},
                                        {{0, 1499}, {9000, 9117}},
                                        {{0, 7999}, {9000, 9499}},
                                        {{0, 1499}, {9000, 9499}},
                                        {{0, 7999}, {9000, 9499}},
                                        {{0, 15999}},
                                        {{0, 59999}}};
constexpr ByteRange kE[kPmcCount][1] = {{}, {}, {{0, 7999}}, {{0, 9999}}, {{0, 9999}}, {{0, 9999}}, {{0, 9999}}};
constexpr ByteRange kA[kPmcCount][2] = {{{0, 24}},
                                        {{0, 24}},
                                        {{0, 249}, {9000, 9249}},
                                        {{0, 249}, {9000, 9249}},
                                        {{0, 249}, {9000, 9249}},
                                        {{0, 499}, {9000, 9499}},
                                        {{0, 749}, {9000, 9749}}};
constexpr ByteRange kK[kPmcCount][2] = {{{0, 19}},
                                        {{0, 19}},
                                        {{0, 99}, {900, 919}},
                                        {{0, 19}, {900, 999}},
                                        {{0, 99}, {900, 999}},
                                        {{0, 199}, {900, 999}},
                                        {{0, 299}, {900, 999}}};
constexpr ByteRange kT[kPmcCount][2] = {{{0, 79}},
                                        {{0, 79}},
                                        {{0, 499}, {9000, 9499}},
                                        {{0, 79}, {9000, 9079}},
                                        {{0, 499}, {9000, 9499}},
                                        {{0, 999}, {9000, 9999}},
                                        {{0, 999}, {9000, 9999}}};
constexpr ByteRange kC[kPmcCount][2] = {{{0, 79}},
                                        {{0, 79}},
                                        {{0, 399}, {5000, 5199}},
                                        {{0, 79}, {5000, 5039}},
                                        {{0, 399}, {5000, 5199}},
                                        {{0, 799}, {5000, 5399}},
                                        {{0, 1199}, {5000, 5599}}};
constexpr ByteRange kD[kPmcCount][1] = {{{0, 1859}}, {{0, 1859}},  {{0, 9999}}, {{0, 2999}},
                                        {{0, 9999}}, {{0, 19999}}, {{0, 59999}}};
constexpr ByteRange kZ[kPmcCount][1] = {{}, {}, {}, {}, {}, {{0, 499}}, {{0, 499}}};
constexpr ByteRange kOthers[kPmcCount][1] = {{}, {}, {{0, 767}}, {{0, 767}}, {{0, 767}}, {{0, 767}}, {{0, 767}}};

// The parts that are there: all but empty ones at the end.
constexpr std::span<const ByteRange> present(std::span<const ByteRange> parts) {
  while (!parts.empty() && parts.back().last == 0) parts = parts.first(parts.size() - 1);
  return parts;
}

constexpr AreaInfo area(char letter, std::span<const ByteRange> parts, std::string_view doc,
                        AreaUse use = AreaUse::Memory, bool retained = false) {
  const std::span<const ByteRange> there = present(parts);
  return {.letter = letter,
          .bytes = there.empty() ? 0 : there.back().last + 1,
          .use = use,
          .retained = retained,
          .doc = doc,
          .parts = there};
}

constexpr std::span<const ByteRange> cncParts(Pmc pmc) {
  switch (pmc) {
  case Pmc::Sa1:
  case Pmc::Sa3: return kCnc2Small;
  case Pmc::Sb7: return kCnc3;
  case Pmc::MemA: return kCnc2;
  case Pmc::MemB:
  case Pmc::MemC: return kCnc10;
  case Pmc::MemD: return kCnc15;
  }
  return {};
}

constexpr std::array<AreaInfo, kAreaCount> areaTable(Pmc pmc) {
  const auto i = static_cast<size_t>(pmc);
  const bool small = pmc <= Pmc::Sa3;
  const std::span<const ByteRange> in = small ? std::span<const ByteRange>(kMachineSa) : kMachine;
  const std::span<const ByteRange> out = small ? std::span<const ByteRange>(kMachineSaOut) : kMachine;
  std::array<AreaInfo, kAreaCount> table = {
      area('X', in, "machine to PMC", AreaUse::Input),
      area('Y', out, "PMC to machine", AreaUse::Output),
      area('F', cncParts(pmc), "CNC to PMC", AreaUse::Input),
      area('G', cncParts(pmc), "PMC to CNC", AreaUse::Output),
      area('R', kR[i], "internal relays"),
      area('E', kE[i], "extra relays, shared by the PMCs of a control"),
      area('A', kA[i], "message requests"),
      area('K', kK[i], "keep relays", AreaUse::Memory, true),
      area('T', kT[i], "variable timers: set values, from T9000 on accuracies", AreaUse::Memory, true),
      area('C', kC[i], "counters: preset and value, from C5000 on values of fixed counters", AreaUse::Memory, true),
      area('D', kD[i], "data table", AreaUse::Memory, true),
      area('Z', kZ[i], "system area of the larger memories"),
      area('M', kOthers[i], "from other PMCs", AreaUse::Input),
      area('N', kOthers[i], "to other PMCs", AreaUse::Output),
  };
  table[static_cast<size_t>(areas::kA)].shown = true;
  table[static_cast<size_t>(areas::kE)].shared = true;
  const network::Address system = systemArea(pmc);
  table[static_cast<size_t>(system.area)].system = system.byte;
  table[static_cast<size_t>(areas::kA)].readOnly = kMessageState;
  return table;
}

template <size_t... I>
constexpr std::array<std::array<AreaInfo, kAreaCount>, kPmcCount> allTables(std::index_sequence<I...>) {
  return {areaTable(static_cast<Pmc>(I))...};
}
constexpr auto kTables = allTables(std::make_index_sequence<kPmcCount>());

constexpr uint32_t kResult = 9000, kStart = kResult + kStartByte, kClock = kResult + kClockByte;

constexpr ControlPlace kControlPlaces[] = {
    {areas::kR, kResult, kResult, 0, "1 if the result of the last function is zero, or its values are equal"},
    {areas::kR, kResult, kResult, 1, "1 if the result of the last function is negative, or its first value is less"},
    {areas::kR, kResult, kResult, 5, "1 if the last function had an overflow"},
    {areas::kR, kResult + 2, kResult + kResultBytes - 1, -1, "remainder of the last division"},
    {areas::kR, kStart, kStart, 0, "1 from the start of the program to the end of the first cycle of level 2"},
    {areas::kR, kClock, kClock, 0, "always 0"},
    {areas::kR, kClock, kClock, 1, "always 1"},
    {areas::kR, kClock, kClock, 2, "1 while the program runs"},
    {areas::kR, kClock, kClock, 5, "clock: 0.1 s 0, then 0.1 s 1"},
    {areas::kR, kClock, kClock, 6, "clock: 0.5 s 0, then 0.5 s 1"},
    {areas::kA, kMessageState, kMessageState + 749, -1,
     "state of the messages, read only: 1 while the message of the bit from A0 on is shown"},
    {areas::kK, 900, 917, -1, "settings of the PMC"},
    {areas::kK, 918, 919, -1, "shift of the messages to the texts of another language"},
    {areas::kK, 920, 999, -1, "settings of the PMC"},
};

static_assert([] {
  for (const auto& table : kTables)
    for (size_t i = 0; i < kAreaCount; ++i)
      if (table[i].letter != areas::kLetters[i]) return false;
  return true;
}());

} // namespace

std::span<const ControlPlace> controlPlaces() { return kControlPlaces; }

std::span<const AreaInfo> areasOf(Pmc pmc) { return kTables[static_cast<size_t>(pmc)]; }

} // namespace rung::frontend::fanuc
