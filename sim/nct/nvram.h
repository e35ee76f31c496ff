// The 1024 non-volatile double words of controls that do not keep PLCNVRAM by themselves: MR 10 and MW 11 (man. 6.19).
#pragma once
#include <array>

#include "sim/nct/topic.h"

namespace rung::sim::nct {

inline constexpr int32_t kNvramWords = 1024;

class Nvram final : public Topic {
public:
  explicit Nvram(Links& links);

  bool serves(bool write, uint32_t function) const override;
  std::optional<int32_t> service(uint32_t function, Block& block) override;
  std::span<const std::string_view> events() const override {
    static constexpr std::string_view kEvents[] = {"damage_nvram"};
    return kEvents;
  }
  Handled event(std::string_view name, const std::vector<NcArgument>& keys) override;
  std::optional<double> quantity(std::string_view name) const override;
  Handled setQuantity(std::string_view name, double value) override;
  void powerOn(nc::PowerOn kind) override;
  void keep(Kept& kept) override;

private:
  std::array<int32_t, kNvramWords> words_{};
  uint32_t checksum_ = 0;
};

} // namespace rung::sim::nct
