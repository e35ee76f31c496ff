// An element of a PLC table: how it lies in memory, and how a file or an operator writes it.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "machine/io/tables/plc_table_files.h"
#include "rtlib/nc/technol/services.h"

namespace rung::io {

using host::ColumnType;

struct PlcTable;

// Of a text or binary element, in bytes. The manual has no limit; what a program hands over at once has no more.
inline constexpr uint32_t kElementBytes = nc::technol::kMostArgumentBytes;

constexpr bool isText(ColumnType type) { return type == ColumnType::Text || type == ColumnType::Binary; }
// INT: 4 bytes, REAL: 8, STRING and BINARY: where its bytes lie and how many they are (PlcTable::textOf).
constexpr uint32_t elementSize(ColumnType type) { return type == ColumnType::Int ? 4 : 8; }

// Whether XML can hold the bytes of a text: no control characters but tab, LF and CR.
bool isWritable(std::string_view text) noexcept;

// A text in UTF-8 as the memory has it (Windows-1250); false where a character has no byte there.
bool toMemory(std::string_view utf8, std::string& bytes);

// The text that a file or an operator writes: INT -2147483648 to 4294967295, also 0x0C (a DWORD: from 2147483648 on
// they are the negative numbers), REAL 1.5, STRING as it is, in UTF-8, BINARY pairs of hexadecimal digits, with blanks
// between them or without. "" or what is wrong: "is 'x', expected ..."; the element is then as before.
std::string readElement(PlcTable& table, ColumnType type, std::string_view written, uint8_t* element);
std::string readElement(PlcTable& table, ColumnType type, double number, uint8_t* element);
// The text that reads as the same element.
std::string writtenElement(const PlcTable& table, ColumnType type, const uint8_t* element);

} // namespace rung::io
