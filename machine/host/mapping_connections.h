// Reads the tables modbus-client, modbus-server and shared-memory of a mapping file.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/mapping_reading.h"

namespace rung::host {

class ConnectionReader {
public:
  explicit ConnectionReader(Reading& reading) : reading_(reading) {}

  // Reads one table, or a list of tables. Returns false if it is neither.
  bool read(const toml::node& node, Connection::Kind kind);
  // To be called once all pins are known: looks up the pins of the connections and adds these to File::connections.
  void resolve();

private:
  // A pin and its address at the other side, as written in the file.
  struct PinRow {
    Place pin;
    Area area = Area::Coil;
    uint32_t place = 0;
    text::Position placeAt;
    std::optional<Format> format;
    text::Position formatAt;
    std::optional<bool> lowFirst;
    text::Position orderAt;
    std::optional<Number> safe;
    bool holds = false;
    text::Position safeAt;
  };
  struct Row {
    Connection connection;
    std::optional<Place> status;
    text::Position timeoutAt;
    std::vector<PinRow> pins;
  };
  template <class Of>
  using Key = text::TomlKey<ConnectionReader, Of>;

  static const Key<Row> kHost, kPort, kPeriod, kTimeout, kStatus;
  static const Key<Row> kCoils, kDiscreteInputs, kHoldingRegisters, kInputRegisters;
  static const Key<Row> kClientKeys[10], kServerKeys[10], kMemoryKeys[5];
  static const Key<PinRow> kAt, kSafe, kBitKeys[2], kRegisterKeys[4];

  void readTable(const toml::table& table, Connection::Kind kind);

  // Keys of a connection.
  bool takeHost(const toml::node& node, Row& row);
  bool takePort(const toml::node& node, Row& row);
  bool takeUnit(const toml::node& node, Row& row);
  bool takeName(const toml::node& node, Row& row);
  bool takePeriod(const toml::node& node, Row& row);
  bool takeTimeout(const toml::node& node, Row& row);
  bool takeConnections(const toml::node& node, Row& row);
  bool takeRequests(const toml::node& node, Row& row);
  bool takeStatus(const toml::node& node, Row& row);
  bool takeCoils(const toml::node& node, Row& row) { return takePins(node, Area::Coil, row); }
  bool takeDiscreteInputs(const toml::node& node, Row& row) { return takePins(node, Area::DiscreteInput, row); }
  bool takeHoldingRegisters(const toml::node& node, Row& row) { return takePins(node, Area::HoldingRegister, row); }
  bool takeInputRegisters(const toml::node& node, Row& row) { return takePins(node, Area::InputRegister, row); }
  bool takeMemory(const toml::node& node, Row& row) { return takePins(node, Area::Memory, row); }
  bool takePins(const toml::node& node, Area area, Row& row);
  bool readPin(const toml::node& node, const std::string& where, PinRow& pin);

  // Keys of a pin.
  bool takeAt(const toml::node& node, PinRow& pin);
  bool takeFormat(const toml::node& node, PinRow& pin);
  bool takeOrder(const toml::node& node, PinRow& pin);
  bool takeSafe(const toml::node& node, PinRow& pin);

  // These run once all pins are known.
  void resolve(Row& row);
  void resolveStatus(const Place& status, Connection& connection);
  void resolvePin(const PinRow& row, Connection& connection);
  std::optional<uint32_t> find(const Place& pin, const std::string& where);
  bool checkDirection(const PinRow& row, const Connection& connection, const Pin& pin, const std::string& where);
  std::optional<Format> formatFor(const PinRow& row, const Pin& pin, const std::string& where);
  bool checkSafe(const PinRow& row, const Pin& pin, const std::string& where);
  bool checkOrder(const PinRow& row, Format format, const std::string& where);
  bool checkPlace(const ConnectedPin& pin, const Connection& connection, const std::string& where);
  bool reserve(uint32_t pin, text::Position at, const std::string& where);

  Reading& reading_;
  std::vector<Row> rows_;
  std::vector<std::optional<text::Position>> sources_; // by pin: position of the entry that feeds this input
};

} // namespace rung::host
