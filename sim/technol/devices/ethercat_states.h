// The states of the simulated EtherCAT master and of its slaves (TECHNOL manual 26.3, l.17937-17955). A step takes
// 10 ms: up through the states between, down at once, BOOTSTRAP only from INIT and to it.
#pragma once
#include <optional>

#include "sim/technol/devices/ethercat_slaves.h"

namespace rung::sim::technol {

class EthercatStates {
public:
  static constexpr uint32_t kStepMs = 10;
  static constexpr uint32_t kTimeoutMs = 1000; // until a slave that is silent has not answered

  explicit EthercatStates(EthercatSlaves& slaves) : slaves_(slaves) {}

  // At a power-on, after that of the slaves: all are in INIT.
  void powerOn();
  // As the control starts its master: at once as far up as the slaves go with it.
  void start(EthercatState target);

  // A change of the master takes all slaves along; with a number it is one of that slave. One at a time.
  void begin(EthercatState target, std::optional<uint32_t> slave);
  // One millisecond of it: its code once it has ended.
  std::optional<uint32_t> tick();
  // The cable: without it all are in INIT, and changes end with kNoSlave.
  void setLink(bool isUp);

  EthercatState master() const { return master_; }
  bool hasLink() const { return link_; }
  // Process data that a slave gives and takes.
  bool givesInputs(uint32_t slave) const;
  bool takesOutputs(uint32_t slave) const;

private:
  struct Step {
    bool isRefused = false;
    bool isSilent = false; // a slave has not answered
    bool isDone = true;    // all are there
  };
  static Step stepOf(EthercatSlave& slave, EthercatState goal);
  Step step();
  Step allTo(EthercatState goal);

  EthercatSlaves& slaves_;
  EthercatState master_ = EthercatState::Init;
  EthercatState target_ = EthercatState::Init; // of the change under way
  std::optional<uint32_t> slave_;              // nothing: the master's
  uint32_t stepMs_ = 0;
  uint32_t silentMs_ = 0;
  bool link_ = true;
};

} // namespace rung::sim::technol
