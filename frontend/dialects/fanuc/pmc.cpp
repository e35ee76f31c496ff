// See pmc.h.
#include "frontend/dialects/fanuc/pmc.h"

#include <algorithm>
#include <iterator>

#include "rtlib/text/letters.h"

namespace rung::frontend::fanuc {
namespace {

// A part of the type's text that decides, the first that is found.
struct Mark {
  std::string_view text;
  Pmc pmc;
};
constexpr Mark kMarks[] = {
    {"MEM-A", Pmc::MemA},     {"MEM-B", Pmc::MemB},     {"MEM-C", Pmc::MemC},     {"MEM-D", Pmc::MemD},
    {"MEM-E", Pmc::MemD},     {"DCS", Pmc::MemB},       {"PMC/L", Pmc::MemA},     {"PMC-SA1", Pmc::Sa1},
    {"PMC-SA3", Pmc::Sa3},    {"PMC-SA5", Pmc::Sa3},    {"PMC-SB5", Pmc::Sb7},    {"PMC-SB6", Pmc::Sb7},
    {"PMC-SB7", Pmc::Sb7},    {"30I-A PMC", Pmc::MemB}, {"31I-A PMC", Pmc::MemB}, {"32I-A PMC", Pmc::MemB},
    {"35I-B PMC", Pmc::MemB}, {"0I-D PMC", Pmc::MemB},  {"0I-F PMC", Pmc::MemB},
};

// The rows TMRB, edges and P of the table of ranges.
constexpr PmcLimits kLimits[] = {
    {.timers = 100, .edges = 256, .subprograms = 0, .hasMilliseconds = false, .hasEnd = false},
    {.timers = 100, .edges = 256, .subprograms = 512, .hasMilliseconds = false},
    {.timers = 500, .edges = 1000, .subprograms = 2000, .hasMilliseconds = false},
    {.timers = 500, .edges = 256, .subprograms = 512},
    {.timers = 500, .edges = 1000, .subprograms = 5000},
    {.timers = 1000, .edges = 2000, .subprograms = 5000},
    {.timers = 1500, .edges = 3000, .subprograms = 5000},
};
static_assert(std::size(kLimits) == kPmcCount);

} // namespace

std::optional<Pmc> pmcNamed(std::string_view text) {
  const std::string upper = text::upper(text);
  const auto* const found =
      std::ranges::find_if(kMarks, [&](const Mark& mark) { return upper.find(mark.text) != std::string::npos; });
  return found == std::end(kMarks) ? std::nullopt : std::optional(found->pmc);
}

const PmcLimits& limitsOf(Pmc pmc) { return kLimits[static_cast<size_t>(pmc)]; }

} // namespace rung::frontend::fanuc
