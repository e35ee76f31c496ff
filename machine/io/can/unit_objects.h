// Objects of units (man. l.4390-4463, l.4567-4663); those that every node has are in sdo.h.
#pragma once
#include "machine/io/can/sdo.h"

namespace rung::io {

inline constexpr sdo::Object kTpdo2Id{0x1801, 1}, kTpdo2Type{0x1801, 2}; // COB-ID and type of transmission (CiA 301)
inline constexpr uint32_t kNotValid = 0x8000'0000;                       // of a COB-ID: the PDO is not sent
inline constexpr uint16_t kRpdoMapping = 0x1600, kTpdoMapping = 0x1A00;  // subindices 1 to 8

inline constexpr uint16_t kShortedOutput = 0x2101, kMatrixInput = 0x2108, kEncoderCounter = 0x210D, kDisplay = 0x210F,
                          kWheelKeys = 0x2111, kReadInput = 0x6000, kWriteOutput = 0x6200;
inline constexpr sdo::Object kMatrixOutputs{0x2109, 0}, kWheelMode{0x2110, 0};
// Subindices of the display (man. l.4620-4663).
inline constexpr uint8_t kDisplayInitialise = 1, kDisplayEnable = 2, kDisplayRow = 6, kDisplayColumn = 7,
                         kDisplayMask = 8, kDisplayInversion = 9, kDisplaySize = 10, kDisplayCount = 11,
                         kDisplayCharacter = 12;

} // namespace rung::io
