// What the bytes of the process data of units are. The units have eight fields of eight bits in RPDO1 and in TPDO1,
// whose number is fixed, and fields without use have to be mapped, too (man. l.4705-4714, l.4780-4790); the control
// maps them by the objects 1600h and 1A00h. TPDO2 is fixed: what the unit's analogue inputs are.
//
// The manual names the objects (unit_objects.h) and the structures of programs (l.4074-4185, l.7492-7503), but not
// which byte is what: the control decides that.
#pragma once
#include "machine/io/can/inouts.h"
#include "machine/io/can/unit_objects.h"

namespace rung::io {

inline constexpr uint32_t kPdoFields = 8;

inline constexpr uint16_t kUnusedField = 0x0005; // the unsigned byte of CiA 301 that is mapped where nothing is

// The value of a mapping object: index, subindex, bits.
constexpr uint32_t mappingOf(sdo::Object field) { return uint32_t{field.index} << 16 | field.subindex << 8 | 8u; }

using PdoFields = std::array<sdo::Object, kPdoFields>;

inline constexpr sdo::Object kNoField{kUnusedField, 0};

// OUT0 to OUT2.
inline constexpr PdoFields kOutputFields = {
    {{kWriteOutput, 1}, {kWriteOutput, 2}, {kWriteOutput, 3}, kNoField, kNoField, kNoField, kNoField, kNoField}};
// IN0 to IN3, TL0 to TL3.
inline constexpr PdoFields kInputFields = {{{kReadInput, 1},
                                            {kReadInput, 2},
                                            {kReadInput, 3},
                                            {kReadInput, 4},
                                            {kMatrixInput, 1},
                                            {kMatrixInput, 2},
                                            {kMatrixInput, 3},
                                            {kMatrixInput, 4}}};
// TOC_DISPLS (man. l.7492-7503).
inline constexpr PdoFields kWheelOutputFields = {{{kDisplay, kDisplayRow},
                                                  {kDisplay, kDisplayColumn},
                                                  {kDisplay, kDisplayCharacter},
                                                  {kDisplay, kDisplayCharacter + 1},
                                                  {kDisplay, kDisplayCharacter + 2},
                                                  {kDisplay, kDisplayCharacter + 3},
                                                  {kDisplay, kDisplaySize},
                                                  {kDisplay, kDisplayInversion}}};
// IN0, IN1; the low bytes of IRC0 and IRC1, for a field has no more bits.
inline constexpr PdoFields kWheelInputFields = {{{kWheelKeys, 1},
                                                 {kWheelKeys, 2},
                                                 {kEncoderCounter, 1},
                                                 {kEncoderCounter, 2},
                                                 kNoField,
                                                 kNoField,
                                                 kNoField,
                                                 kNoField}};

} // namespace rung::io
