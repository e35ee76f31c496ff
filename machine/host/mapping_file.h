// The contents of a mapping file: the HAL pins, and the names of the PLC program to which they refer. The file is TOML;
// docs/mapping-file.md describes its tables. This header knows only the file; binding.h looks up the names in a
// program.
#pragma once
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/text/name_parts.h"
#include "rtlib/text/position.h"
#include "rtlib/text/similar.h"
#include "rung/runtime.h"

namespace rung::host {

enum class PinType : uint8_t { Bit, S32, U32, Float };

inline constexpr std::string_view kFunctionKinds[] = {"M", "S", "T", "B", "H", "key"}; // indexed by rung_function_kind

enum class Direction : uint8_t {
  In,        // HAL to the program
  Out,       // the program to HAL
  Io,        // both: each side reads the value that the other has written last
  Parameter, // set by a user, read by the program
};

inline bool toProgram(Direction direction) { return direction != Direction::Out; }
inline bool fromProgram(Direction direction) { return direction == Direction::Out || direction == Direction::Io; }

// A HAL pin or parameter to create. A pin that is named in several entries is created once.
struct Pin {
  std::string name;
  PinType type = PinType::Bit;
  Direction direction = Direction::In;
  text::Position at;   // position of the first of these entries
  double safe = 0;     // value while the program does not run: before its first scan, after a fault, at the end
  bool holds = false;  // keeps its last value instead
  bool ofHost = false; // read and written by the host itself, also while the program does not run
};

// in, out, io, param: the pin and the name are the same quantity.
struct Link {
  uint32_t pin = 0; // index into File::pins
  std::string name;
  double scale = 1; // float: program units per HAL unit; finite, not 0
  // If not empty: pins for the bits of the cell, lowest first; `pin` is the first.
  std::vector<uint32_t> bits;
  std::optional<double> value; // initial value of a parameter; if empty, and for io pins, the program's value
  text::Position at;           // position of the name
};

// The name in an entry with other errors: it is looked up, too, so that all errors are reported at once.
struct NamedOnly {
  std::string where; // key of the entry, for messages
  std::string name;
  text::Position at;
  Direction direction = Direction::In;
};

// An entry of [const]: true and false are bits; negative integers are S32, others U32.
struct Constant {
  PinType type = PinType::Bit;
  std::string name;
  double value = 0; // holds every 32-bit integer exactly; finite
  text::Position at;
};

// A pin that changes to a level.
struct Edge {
  uint32_t pin = 0; // index into File::pins
  bool rising = true;
};

// send: an edge of a pin passes a function to the program.
struct Send {
  Edge edge;
  rung_function_kind kind = RUNG_FUNCTION_M;
  uint32_t channel = 0; // of the control, from 0; the map counts from 1
  int32_t code = 0;
  std::optional<uint32_t> codePin; // instead of `code`
  std::optional<uint32_t> donePin;
  text::Position at;
};

// m-groups: the group of an M function on this machine.
struct Group {
  uint32_t code = 0;
  uint32_t group = 0;
  text::Position at; // position of the code
};

// PlcErrors: a file of the control that contains texts of messages.
struct MessageFile {
  std::string path;
  text::Position at;
};

// axis-groups: the signals by which the program commands an axis; both count from 0.
struct AxisGroup {
  uint32_t axis = 0;
  uint32_t group = 0;
  text::Position at; // position of the axis
};

// rungctl: what clients are permitted to do while the program runs.
enum class Remote : uint8_t { Set, Force, Reload, Start, Stop, Reset, Profile, Serve };
inline constexpr std::string_view kRemoteNames[] = {"set",  "force", "reload",  "start",
                                                    "stop", "reset", "profile", "serve"}; // indexed by Remote

// rungctl: a cell that clients can neither set nor force.
struct Protected {
  std::string name;
  text::Position at;
};

// The kind of address of a pin's value at the other side of a connection.
enum class Area : uint8_t { Coil, DiscreteInput, HoldingRegister, InputRegister, Memory };

// The format of the value at that address.
enum class Format : uint8_t {
  Bit, // a byte of memory: 0 or 1
  S16, // a register
  U16,
  S32, // two registers, or four bytes of memory
  U32,
  F32,
  F64, // eight bytes of memory
};
uint32_t registersOf(Format format); // 1 or 2
uint32_t bytesOf(Format format);     // in memory; 0: only for registers

struct ConnectedPin {
  uint32_t pin = 0; // index into File::pins
  Area area = Area::Coil;
  uint32_t place = 0; // address; Modbus: from 0; memory: in bytes
  Format format = Format::Bit;
  bool lowFirst = false; // the first of two registers has the low-order bits
  double safe = 0;       // value of an input while the connection is silent
  bool holds = false;    // the input keeps its last value instead
  text::Position at;     // position of the address
};

// modbus-client, modbus-server, shared-memory: a connection that carries values of pins. Only rung-run serves
// connections.
struct Connection {
  enum class Kind : uint8_t { ModbusClient, ModbusServer, SharedMemory };
  Kind kind = Kind::ModbusClient;
  std::string host = "127.0.0.1"; // IP address: of the device, or at which the server listens
  uint16_t port = 502;
  uint8_t unit = 1;                  // of the device
  std::string name;                  // of the shared memory
  int64_t periodNs = 10'000'000;     // client and shared memory: between two exchanges
  int64_t timeoutNs = 1'000'000'000; // a connection that is silent for longer is lost
  uint32_t connections = 8;          // accepted by a server at the same time
  uint32_t requests = 1000;          // answered by a server per second and connection
  std::optional<uint32_t> statusPin; // index into File::pins: an input bit that is on unless the connection is lost
  std::vector<ConnectedPin> pins;
  text::Position at;

  // "modbus-client 192.168.0.10:502"
  std::string title() const;
};
std::string_view kindName(Connection::Kind kind); // name of the table

// devices: the devices of a TECHNOL program on this machine (machine/io). The host checks keys and values; paths are
// relative to the folder of the file.
struct DeviceSetting {
  enum class Kind : uint8_t {
    Can,  // a channel and its network interface
    Com,  // a port and its device
    Axis, // an axis that the program positions, and the prefix of its pin names
    SharedFile,
    Config, // a key of the control's configuration and its value
  };
  Kind kind = Kind::Config;
  std::string key;
  std::string value;
  text::Position at; // position of the value
};

// recording: what the host does to its program is recorded.
struct RecordingSetting {
  bool off = false;
  std::string folder;      // "": beside the retained memory
  uint64_t limitBytes = 0; // 0: the default
  uint64_t keptBytes = 0;
};

// A mapping file with the files that it includes; all entries are in the order of the text.
struct File {
  std::vector<std::string> paths; // the file and those that it includes; Position::file is an index into them
  std::vector<Pin> pins;
  std::vector<Link> links;
  std::vector<NamedOnly> namedOnly;
  std::vector<Constant> constants;
  std::vector<Send> sends;
  std::vector<Group> groups;
  std::vector<MessageFile> messageFiles;
  std::vector<AxisGroup> axisGroups;
  bool permissions[std::size(kRemoteNames)] = {}; // indexed by Remote
  std::vector<Protected> protectedCells;
  std::vector<Connection> connections;
  std::vector<DeviceSetting> devices;
  RecordingSetting recording;
  std::vector<Edge> aborts;                // edges that end every function: reset, emergency stop
  int64_t timeoutNs = 0;                   // timeout of a function; 0: none
  std::optional<text::Position> highSpeed; // position of `high-speed = true`

  // "PATH:LINE:COLUMN: what"
  std::string message(text::Position at, std::string_view what) const;
};

// Reads the text of a file; throws std::exception with the reason: "cannot read PATH: …".
using ReadFile = std::function<std::string(const std::string& path)>;

// Whether the name of a path is that of a mapping file, not of a program.
bool isNamedAsMap(std::string_view path);

// Reads regular files of at most 1 MB from the disk.
std::string readFromDisk(const std::string& path);

// Each entry of `errors` is PATH:LINE:COLUMN with what was found, what was expected and how to fix it, in the order of
// the files; the result has the entries without errors. If a text is not TOML, the result is empty, and there is one
// error, the first of its syntax. `read` reads included files.
File parseMap(std::string_view text, const std::string& path, std::vector<std::string>& errors,
              const ReadFile& read = readFromDisk);
// The same for a file, which is also read by `read`.
File loadMap(const std::string& path, std::vector<std::string>& errors, const ReadFile& read = readFromDisk);

// For hosts without connections: reports each connection as an error.
void refuseConnections(const File& map, std::string_view host, std::vector<std::string>& errors);
// For hosts that move no axes: reports each axis as an error.
void refuseAxes(const File& map, std::string_view host, std::vector<std::string>& errors);

std::string_view pinTypeName(PinType type);
std::string_view tableName(Direction direction); // "in"

// An error in an entry of a file that refers to a program.

// The parts of the message, in its order.
struct Mistake {
  std::string found;
  std::string expected;
  std::string fix;

  std::string text() const { return "found " + found + ", expected " + expected + "; " + fix; }
};

// Suggestions for names that a program does not have.

// The name, with a symbol of the program that is close to it; "" if none is.
template <class Symbols, class NameOf = std::identity>
std::string meantName(std::string_view name, Symbols&& symbols, NameOf nameOf = {}) {
  const std::string_view head = text::headOf(name);
  const std::string_view symbol = text::mostSimilar(head, symbols, nameOf);
  if (symbol.empty()) return {};
  std::string meant(name);
  meant.replace(static_cast<size_t>(head.data() - name.data()), head.size(), symbol);
  return meant;
}

} // namespace rung::host
