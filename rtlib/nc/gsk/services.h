// The services that a GSK25i program requests from its CNC (man. §9.3, l.8482-8945), and that its control requests for
// it (§9.2, l.7713-7803).
#pragma once
#include "rtlib/nc/pmc/services.h"
#include "rtlib/nc/service.h"

namespace rung::nc::gsk {

inline constexpr ServiceRow kServices[] = {
    {pmc::ServiceKind::ReadWindow, "windr function length number attribute -> end data"},
    {pmc::ServiceKind::WriteWindow, "windw function length number attribute data -> end"},
    {pmc::ServiceKind::MoveAxis, "AXLCTL axis command data-1 data-2"},
};
static_assert(isServiceTable(kServices));
constexpr const ServiceRow& service(pmc::ServiceKind kind) { return kServices[static_cast<size_t>(kind) - 1]; }

} // namespace rung::nc::gsk
