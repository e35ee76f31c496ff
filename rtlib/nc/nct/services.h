// The services that an NCT program requests from its NC: functions of MR and MW (man. §6.18), macro variables
// (l.8070-8125), blocks of movement (l.3082-3145), quantities of the scope (l.3323-3388).
#pragma once
#include "rtlib/nc/service.h"

namespace rung::nc::nct {

enum class ServiceKind : uint8_t { Unknown, ReadArray, WriteArray, ReadMacro, WriteMacro, ReadScope, MoveAxis };

// `block`: the first word of an operand block (operand_block.h).
inline constexpr ServiceRow kServices[] = {
    {ServiceKind::ReadArray, "MR function address block -> code"},
    {ServiceKind::WriteArray, "MW function address block -> code"},
    {ServiceKind::ReadMacro, "MACR variable channel -> value:f"},
    {ServiceKind::WriteMacro, "MACW variable channel value:f ->"},
    {ServiceKind::ReadScope, "SCP symbol p1 p2 -> value:f"},
    {ServiceKind::MoveAxis, "MOVCMND axis code speed:f distance:f"},
};
static_assert(isServiceTable(kServices));
constexpr const ServiceRow& service(ServiceKind kind) { return kServices[static_cast<size_t>(kind) - 1]; }

} // namespace rung::nc::nct
