// Values of pins as registers of Modbus and as bytes of memory.
#pragma once
#include <cstdint>
#include <optional>

#include "machine/io/connections/exchange.h"

namespace rung::io {

// An integer is rounded, and limited to the format.
void toRegisters(const ExchangedPin& pin, double value, uint16_t* registers) noexcept;
// Limited to the type of the pin. Nothing: what is there is not a number.
std::optional<double> fromRegisters(const ExchangedPin& pin, const uint16_t* registers) noexcept;

// The byte order is the machine's; a bit is a byte.
void toBytes(const ExchangedPin& pin, double value, uint8_t* bytes) noexcept;
std::optional<double> fromBytes(const ExchangedPin& pin, const uint8_t* bytes) noexcept;

} // namespace rung::io
