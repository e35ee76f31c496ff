// The window between PLC and CNC, what the dialects of the family have in common: the description of a function, and
// the control block. Each dialect has its table of functions and its end codes (DIALECT/window_functions.h). Line
// numbers (l.) are of GSK's manual.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace rung::nc::pmc {

enum class WindowAccess : uint8_t { Read, Write };

// High speed: answered in the scan of the call. Low speed: in a later one (man. l.8501-8513).
enum class WindowSpeed : uint8_t { High, Low };

enum class WindowStatus : uint8_t {
  Open,
  ClosedInList,    // "not open" in the list: the PLC refuses it with end code 6 (P49)
  ClosedInSection, // only its own section says "not open yet": the request reaches the CNC, which refuses it
};

// The control block: words, low byte first, and the data after them (tables l.8688-8945).
inline constexpr uint32_t kWindowFunctionAt = 0;
inline constexpr uint32_t kWindowEndAt = 2;
inline constexpr uint32_t kWindowLengthAt = 4;
inline constexpr uint32_t kWindowNumberAt = 6;
inline constexpr uint32_t kWindowAttributeAt = 8;
inline constexpr uint32_t kWindowDataAt = 10;

// The number M or the attribute N. Without `meaning` the field is not used (man. l.8661).
struct WindowField {
  std::string_view meaning;
  uint16_t min = 0;
  uint16_t max = 0; // kNoLimit: the manual gives none
};
inline constexpr uint16_t kNoLimit = UINT16_MAX;

struct WindowFunction {
  uint16_t code = 0;
  std::string_view title;
  WindowAccess access = WindowAccess::Read;
  WindowSpeed speed = WindowSpeed::Low;
  WindowStatus status = WindowStatus::Open;
  WindowField number = {};
  WindowField attribute = {};
  uint32_t scale = 0;            // data = value x scale; 0: no section describes the data
  bool wholeOnly = false;        // written data must be a multiple of the scale
  uint16_t listLine = 0;         // in Table 5-49
  std::string_view section = {}; // of Part II; "" if the manual has none
  uint16_t line = 0;             // of the section
};

// Null for a code that is not in the table, whose rows are in the order of their codes.
const WindowFunction* findWindowFunction(std::span<const WindowFunction> table, uint64_t code);

} // namespace rung::nc::pmc
