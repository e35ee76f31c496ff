// Reads the XML files that configure the control and its PLC: the messages (Plc0.PlcErrors, man. l.5241-5330), the
// constants (*.PlcConstants, man. l.16267-16305) and the channel's configuration with its elements Plc and Connections
// (ChannelConfig, man. l.5575-5757, l.13255-13291, l.16073-16108) and those of its devices.
//
// Elements and attributes that the manual does not name are mistakes inside the elements read here; around these, in
// the channel's configuration, everything else belongs to other parts of the control and is skipped. Texts are UTF-8.
// None of this runs while a PLC program is running.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/xml_reader.h"
#include "rtlib/nc/control/technol/messages.h"

namespace rung::host {

// <PlcError No="4" Type="Err" Validity="Transient"><Text>... %d</Text></PlcError>
struct PlacedMessage : nc::technol::MessageDefinition {
  FilePlace place;
};

// <PlcParam ID="TIM_WATER" Type="Int">4</PlcParam>
enum class ParameterType : uint8_t { Int, Real, String, Binary };
struct ParameterDefinition {
  std::string id;
  ParameterType type = ParameterType::String;
  std::string value;
  FilePlace place;
};

// <Constant ID="PUMP_START" Value="12"></Constant>
struct ConstantDefinition {
  std::string id;
  std::string value; // a number, SA0INT, SA0REAL or PLCCOMMAND
  FilePlace place;
};

// <Connection Source="PLC.Output.A" Destination="PLC.Input.B" Invert="0" Scale="1.0" Offset="0.0" Connected="1">
struct ConnectionDefinition {
  std::string source, destination;
  bool invert = false;
  double scale = 1;
  double offset = 0;
  bool connected = false;
  FilePlace place;
};

// <Input ID="inLimX" Port="1" Bit="2" Invert="0" Default="0" Connected="1">, Output, AnalogInput, AnalogOutput: of
// MAP_IN, MAP_OUT, MAP_AIN, MAP_AOUT.
enum class TerminalKind : uint8_t { Input, Output, AnalogInput, AnalogOutput };
struct TerminalDefinition {
  TerminalKind kind = TerminalKind::Input;
  std::string id;
  uint32_t port = 0; // 0 to 128
  uint32_t bit = 0;  // 0 to 7
  bool invert = false;
  uint32_t physical = 0; // PhysNo, 0 to 99
  double scale = 1;
  double offset = 0;
  std::optional<double> least, most; // MinVal, MaxVal
  double otherwise = 0;              // Default; 0 or 1 for a bit
  bool connected = false;
  FilePlace place;
};

// <NCAxis No="0" RefMethod="9">, <CANChannel No="1" Active="1">, <ComChannel No="0">, <Servo No="0">: the devices of
// the machine; axes, servos and CAN channels are also numbered from 0 (l.3242-3285, l.9211-9271, l.11475-11610,
// l.21003-21039).
enum class DeviceKind : uint8_t { Axis, CanChannel, ComChannel, Servo };
struct DeviceDefinition {
  struct Attribute {
    std::string name, value; // any name; the code for the device checks it
  };
  DeviceKind kind = DeviceKind::Axis;
  uint32_t number = 0;               // 0 to 15
  std::vector<Attribute> attributes; // without No
  FilePlace place;
};

struct ControlFiles {
  std::vector<PlacedMessage> messages;
  std::vector<ParameterDefinition> parameters;
  std::vector<ConstantDefinition> constants;
  std::vector<ConnectionDefinition> connections;
  std::vector<TerminalDefinition> terminals;
  std::vector<DeviceDefinition> devices;
};

enum class ControlFileKind : uint8_t { Messages, Constants, Channel };

// Adds the contents of the file to `files`. Returns "", or the errors, one line "FILE:LINE:COLUMN: ..." each; `files`
// is then unchanged.
std::string readControlFile(ControlFileKind kind, const std::string& path, ControlFiles& files);
// The same for a text; `name` is the name of the file in messages.
std::string parseControlFile(ControlFileKind kind, std::string_view name, std::string_view text, ControlFiles& files);

} // namespace rung::host
