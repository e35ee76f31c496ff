// The requests of a TECHNOL program to its control and to the control's devices (man. ch. 9-13, 16-19, 23, 26, 27). A
// service of a device is named after its mnemonic, and its arguments are the operands that the instruction reads.
//
// A service that waits is polled in every run of the instruction until it is answered; all others are answered at once.
// Bytes that a program passes are read from its memory at the request; bytes that it receives are fetched by FetchBytes
// when the answer has arrived, in the same run.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "rtlib/nc/service.h"
#include "rung/program.h"

namespace rung::nc {

namespace technol {

enum class ServiceKind : uint8_t {
  Unknown,
  // Services of the control itself.
  FetchBytes,
  Configuration,
  Define,
  UpdateInput,
  // Services of devices.
  CanSend,
  CanReceive,
  CanOrder,
  CanDeleteOrder,
  CanEndOrder,
  CanReadItem,
  CanWriteItem,
  CanDrive,
  AnalogPort,
  Analog,       // of the port
  AnalogOfAxis, // of a spindle
  AnalogSpindle,
  ToSpindle,
  MainSpindle,
  ToAxis,
  RegulatorX, // and those of the next five axes
  RegulatorY,
  RegulatorZ,
  Regulator4,
  Regulator5,
  Regulator6,
  PositionInit,
  PositionReset,
  PositionMode,
  PositionControl,
  AreaRead,
  AreaWrite,
  TableGetInt,
  TableGetReal,
  TableGetText,
  TableGetBinary,
  TableSetInt,
  TableSetReal,
  TableSetText,
  TableSetBinary,
  TableColumnIndex,
  TableColumnId,
  TableColumnType,
  TableSelectedLine,
  TableSelect,
  TableChanged,
  TableLineCount,
  EthercatReadObject,
  EthercatWriteObject,
  EthercatReadIdn,
  EthercatWriteIdn,
  EthercatCommand,
  ComSend,
  ComSendText,
  ComReceive,
  ComControl,
};

enum class Device : uint8_t { None, Bytes, Can, Axes, Areas, Tables, Ethercat, Com }; // Bytes: the bytes of answers

// How a service of a device is answered.
struct DeviceAnswer {
  bool waits = false;
  // The program continues at once, and is answered later by cells of the interface (man. l.7964, l.9491).
  bool lasts = false;
  // The first results of a request without an answer: `unanswered` while a scenario only records requests, `refused` if
  // there is no such device.
  int64_t unanswered[2] = {};
  int64_t refused[2] = {};
};
struct DeviceService {
  ServiceRow service;
  Device device = Device::None; // None: a service of the control itself
  DeviceAnswer answer = {};

  constexpr ServiceKind kind() const { return static_cast<ServiceKind>(service.kind); }
};
std::span<const DeviceService> deviceServices(); // by kind, from 1
inline const DeviceService& deviceService(ServiceKind kind) { return deviceServices()[static_cast<size_t>(kind) - 1]; }
// The device for a kind of request; none for Unknown.
inline Device deviceOf(ServiceKind kind) {
  return kind == ServiceKind::Unknown ? Device::None : deviceService(kind).device;
}
// By rung_program::dialect and the kind of a request; null if it uses no device.
const DeviceService* deviceServiceOf(std::string_view dialect, uint32_t kind);
// The first service with this mnemonic; null if there is none.
const DeviceService* findDeviceService(std::string_view mnemonic);

// Words among the operands, separated by blanks, and the number that a device gets for the first of them.
inline constexpr std::string_view kLineCommandWords = "CLEAR RECEIVED STATE"; // of COM_CONTROL
inline constexpr int64_t kFirstLineCommand = 0;
inline constexpr std::string_view kSpindleWords = "S"; // of AX_SPI
inline constexpr int64_t kFirstSpindleWord = -1;       // no cell has it
std::optional<int64_t> deviceWord(std::string_view word);

// Commands of ECAT_COMMAND that query a state (man. l.18231), and the code in DR if the answer does not fit.
inline constexpr int32_t kMasterStateCommand = 20, kSlaveStateCommand = 21;
inline constexpr int64_t kNoPlaceCode = 4;

// The argument for a missing operand.
inline constexpr int64_t kNotGiven = INT64_MIN;

// Bytes of the program's memory as one argument: number of the space, count, first byte.
constexpr int64_t bytesArgument(uint32_t space, uint32_t count, uint32_t first) {
  return static_cast<int64_t>(uint64_t{space} << 48 | uint64_t{count} << 32 | first);
}
inline constexpr uint32_t kMostArgumentBytes = 0xFFFF;
struct ArgumentBytes {
  uint32_t space, count, first;
};
constexpr ArgumentBytes bytesOfArgument(int64_t argument) {
  const auto bits = static_cast<uint64_t>(argument);
  return {static_cast<uint32_t>(bits >> 48), static_cast<uint32_t>(bits >> 32 & 0xFFFF), static_cast<uint32_t>(bits)};
}

// The name of the task that runs the procedure of a packet order: this prefix, the order's argument `proc`, a dot and
// the name of the procedure, by which it is found in another program.
inline constexpr std::string_view kPacketTask = "CAN_RECV_REQ.";

// FetchBytes returns the bytes of the answer to a ticket in parts of this size, the first byte lowest in each word.
inline constexpr uint32_t kDataBytes = RUNG_MAX_SERVICE_ARGS * 8;

} // namespace technol

// Configuration queries the configuration and the constants of the machine (man. ch. 16); the control answers at once.
// A request has the kind of value and its identifier; a text is returned in parts.

enum class ConfigurationKind : uint8_t { Integer, Real, Text, Binary, Bit, Constant };

// Arguments: kind, number of the part, identifier, eight characters a word, filled up with zeros. Results: 1 if it was
// found, bytes of the whole text, then a value (the bits of a real) or the part of the text.
inline constexpr uint32_t kConfigurationHead = 2; // words before the identifier and the value
inline constexpr uint32_t kConfigurationWords = RUNG_MAX_SERVICE_ARGS - kConfigurationHead;
inline constexpr uint32_t kConfigurationBytes = kConfigurationWords * 8; // longest identifier, and a part of a text

inline constexpr uint32_t kMaxAxes = 16; // of a control, l.8085

// The licences of the hardware key that LDR_LIC queries (man. l.7631-7655): the names in programs and configurations,
// and the bits of the host cell @LICENCES, in this order from bit 0.

inline constexpr std::string_view kLicences =
    "HwKeyConnected FeaturePlc0 FeaturePlc1 FeaturePlc2 FeaturePlc3 FeaturePlc4 "
    "FeaturePlc5 FeaturePlc6 FeaturePlc7 FeaturePlc8 FeaturePlc9";
inline constexpr std::string_view kLicenceCell = "@LICENCES";

// The form in which a TECHNOL program sends a message to the control (man. ch. 14): in one rung_message, so that no
// value can be lost separately. Shared by compiler, simulation and hosts.

namespace technol {

// number: the message's number, a WORD, with these marks above it; index: subid; value: par1, and above it par2;
// channel: par3. The op is Clear if the program removes a persistent message, else ShowLog.
inline constexpr uint32_t kMessageNumber = 0xFFFF;
inline constexpr uint32_t kPersistentWanted = 1u << 16; // `set` was given, or a bit both begins and ends the message
inline constexpr uint32_t kByBit = 1u << 17;            // the message belongs to a bit of EDEF

struct MessageValues {
  uint32_t number, subId, par[3];
  bool operator==(const MessageValues&) const = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(number, subId, par[0], par[1], par[2]);
  }
};
inline MessageValues valuesOf(const rung_message& message) {
  const auto both = static_cast<uint64_t>(message.value);
  return {message.number & kMessageNumber,
          static_cast<uint32_t>(message.index),
          {static_cast<uint32_t>(both), static_cast<uint32_t>(both >> 32), static_cast<uint32_t>(message.channel)}};
}

} // namespace technol

} // namespace rung::nc
