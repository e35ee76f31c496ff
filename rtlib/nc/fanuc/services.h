// The services that a program of the FANUC PMC requests from its CNC (WINDR, WINDW), and that its control requests for
// it (AXCTL).
//
// Data are handed over as words of four bytes, low byte first, as they lie in the control block: `data` is the first of
// them, `data-2` the next. The length says how many bytes count; what is beyond it, and the sign of a word, do not.
#pragma once
#include "rtlib/nc/pmc/services.h"
#include "rtlib/nc/service.h"

namespace rung::nc::fanuc {

inline constexpr uint32_t kWindowWords = 12; // at most, so that all axes of a path fit
inline constexpr uint32_t kWindowMaxLength = 4 * kWindowWords;
inline constexpr uint32_t kReadDataAt = 2;  // index of the first word among the results of windr
inline constexpr uint32_t kWriteDataAt = 4; // among the arguments of windw

inline constexpr ServiceRow kServices[] = {
    {pmc::ServiceKind::ReadWindow,
     "windr function length number attribute -> end length data data-2 data-3 data-4 data-5 "
     "data-6 data-7 data-8 data-9 data-10 data-11 data-12"},
    {pmc::ServiceKind::WriteWindow,
     "windw function length number attribute data data-2 data-3 data-4 data-5 data-6 data-7 "
     "data-8 data-9 data-10 data-11 data-12 -> end"},
    {pmc::ServiceKind::MoveAxis, "AXCTL axis command data-1 data-2"},
};
static_assert(isServiceTable(kServices));
constexpr const ServiceRow& service(pmc::ServiceKind kind) { return kServices[static_cast<size_t>(kind) - 1]; }
static_assert(service(pmc::ServiceKind::ReadWindow).results.count() == kReadDataAt + kWindowWords);
static_assert(service(pmc::ServiceKind::WriteWindow).arguments.count() == kWriteDataAt + kWindowWords);

} // namespace rung::nc::fanuc
