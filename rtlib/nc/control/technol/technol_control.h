// The control of a TECHNOL PLC: the life of the program, part-program blocks, messages, names of the interface (man.
// ch. 3.17, 5, 14).
#pragma once
#include "rtlib/nc/control/control.h"
#include "rtlib/nc/control/technol/backup.h"
#include "rtlib/nc/control/technol/blocks.h"
#include "rtlib/nc/control/technol/messages.h"
#include "rtlib/nc/control/technol/operation.h"
#include "rtlib/nc/control/technol/program_life.h"
#include "rtlib/nc/control/technol/technol_functions.h"

namespace rung::nc {

class TechnolControl final : public Control {
public:
  void prepare(runtime::Instance& instance, PowerOn kind) override;
  void start(runtime::Instance& instance) override { life_.powerOn(instance); }

  void onHook(runtime::Instance& instance, uint32_t work) override;
  uint32_t works() const override;
  void onFault(runtime::Instance& instance) override;
  std::unique_ptr<Places> locate(const rung_program& program) const override;
  void beforeSlice(runtime::Instance& instance) override;
  void afterSlice(runtime::Instance& instance) override;

  bool define(const DefinedMessage& message) override;
  rung_message outward(const rung_message& message) const noexcept override { return messages_.outward(message); }
  void accept(const rung_message& message) override { messages_.accept(message); }
  std::vector<ShownMessage> messages(const runtime::Instance&) const override { return messages_.shown(); }
  bool shows(const runtime::Instance&, std::span<const ShownMessage> these) const noexcept override {
    return messages_.shows(these);
  }
  size_t describe(const rung_program& program, const rung_message& message,
                  std::span<char> out) const noexcept override;
  // As in a line of the log.
  std::string text(const ShownMessage& message) const override;

  // A character is one byte, Windows-1250; the last byte of a text is its terminator.
  std::string shownText(std::string_view inMemory) const override;
  std::string memoryText(std::string_view shown, uint32_t bytes) const override;

  TechnolFunctions* functions(uint32_t channel) override { return channel == 0 ? &functions_ : nullptr; }

  void save(core::Saver& saver) const noexcept override { saver(*this); }
  void load(core::Loader& loader) override { loader(*this); }
  template <class Archive>
  void state(Archive& archive) {
    archive(blocks_, operation_, driven_, functions_, life_, messages_);
  }

  bool savesOnRequest() const override { return true; }
  void setStored(bool stored) override { backup_.setStored(stored); }
  bool asksToSave(const runtime::Instance& instance) const override { return backup_.asked(instance); }
  void saved(runtime::Instance& instance) override { backup_.saved(instance); }

  // For the simulation, which acts as operator and part program.
  technol::ProgramLife& life() { return life_; }
  technol::Messages& list() { return messages_; }
  const technol::Messages& list() const { return messages_; }
  technol::Blocks& blocks() { return blocks_; }

  bool beginPowerOff(runtime::Instance& instance) override { return life_.powerOff(instance); }
  bool endsLater(const runtime::Instance& instance) const override { return life_.donePending(instance); }

protected:
  void usePlaces(runtime::Instance& instance, Places& places) noexcept override;
  std::optional<runtime::Ref> signal(const rung_program& program, std::string_view name) const override;

private:
  technol::Blocks blocks_;
  technol::Operation operation_{blocks_};
  bool driven_ = false; // the host calls beforeSlice
  TechnolFunctions functions_{blocks_};
  technol::ProgramLife life_;
  technol::Messages messages_;
  technol::Backup backup_;
};

} // namespace rung::nc
