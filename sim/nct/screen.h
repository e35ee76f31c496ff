// The screen of the control: MW 70 opens its windows (man. 6.23).
#pragma once
#include <array>
#include <vector>

#include "sim/ethercat_object.h"
#include "sim/nct/topic.h"

namespace rung::sim::nct {

class Screen final : public Topic {
public:
  using Topic::Topic;
  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"display"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  void powerOn(nc::PowerOn kind) override;

  template <class Archive>
  void state(Archive& archive) {
    archive(connected_, window_);
  }

private:
  bool configured_ = true; // whether the display is connected after power-on
  bool connected_ = true;
  std::array<int32_t, 4> window_{}; // identifier, channel, parameters of the last window; 0: none was opened
};

// EtherCAT mailboxes: MR 201 and MW 202 (man. 6.28), for devices in the configuration:
//   config ethercat.1 coe+voe             device 1 and its protocols: coe, soe, voe
//   config ethercat.1.coe.0x6041.0 0x237/2   an object (index, subindex): its value and its size in bytes
//   config ethercat.2.soe.47.0 100/4      an element (IDN, drive)

class Mailbox final : public Topic {
public:
  using Topic::Topic;

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  Handled config(std::string_view key, std::string_view value) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"ethercat"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  void powerOn(nc::PowerOn kind) override;

  template <class Archive>
  void state(Archive& archive) {
    archive.each(devices_);
    archive.each(objects_);
  }

private:
  enum class Protocol : uint8_t { Coe = 3, Soe = 5, Voe = 15 }; // word 2
  static constexpr int32_t kMostBytes = 1024;
  using Buffer = std::vector<uint8_t>;

  struct Device {
    uint32_t index = 0;
    EthercatProtocols protocols;
    bool silent = false; // does not answer
    uint32_t error = 0;  // answers with this error, if not 0
    Buffer vendor;       // data last written by VoE
    template <class Archive>
    void state(Archive& archive) {
      archive(silent, error, vendor);
    }
  };
  static bool fits(int32_t protocol, int32_t amount);
  static bool speaks(const Device& device, Protocol protocol);
  Device* find(int32_t index);
  EthercatObject* find(const Device& device, Protocol protocol, uint32_t index, uint32_t sub);
  // Transfers data to or from buffer_; returns an error code of the device, 0: done.
  uint32_t exchange(bool write, Block& block, Device& device, Protocol protocol);
  uint32_t exchangeCoe(bool write, Block& block, Device& device);
  uint32_t exchangeWhole(bool write, Device& device, uint32_t index, uint32_t sub);
  uint32_t exchangeSoe(bool write, Block& block, Device& device);
  int32_t finish(bool write, Block& block, uint32_t error);
  std::string addDevice(uint32_t index, std::string_view protocols);
  std::string addObject(std::string_view place, std::string_view value);

  std::vector<Device> devices_;
  std::vector<EthercatObject> objects_;
  Buffer buffer_ = Buffer(kMostBytes); // room for the data of a request
  size_t size_ = 0;
};

} // namespace rung::sim::nct
