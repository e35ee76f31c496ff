// The configuration of the machine and the constants of the PLC, which a program reads by identifiers (man. ch. 16).
#pragma once
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "machine/host/control_files.h"
#include "rtlib/core/queues.h"

namespace rung::sim::technol {

class Configuration {
public:
  // Sets `config KEY VALUE`: a parameter; with `const.` before its identifier, a constant; with `licence.` before its
  // name, a licence. Returns "", or the error.
  std::string set(std::string_view key, std::string_view value);
  // Adds the definitions in the control's files. Returns "", or the error with its position.
  std::string define(std::span<const host::ParameterDefinition> parameters,
                     std::span<const host::ConstantDefinition> constants);
  // Answers a request of kind Configuration. Allocates nothing.
  void respond(const core::ServiceRequest& request, core::ServiceReply& reply) const;
  // `id` is in UTF-8.
  std::optional<int64_t> constant(std::string_view id) const;
  // One bit for each of kLicences.
  uint32_t licences() const { return licences_; }

private:
  std::optional<int64_t> constantInMemory(std::string_view id) const;
  std::string setConstant(std::string_view id, std::string_view value);
  std::string setLicence(std::string_view name, std::string_view value);
  int64_t nextCommand();

  // Identifiers and texts in the encoding of the program's memory (rtlib/nc/technol/code_page.h).
  std::map<std::string, std::string, std::less<>> parameters_;
  std::map<std::string, int64_t, std::less<>> constants_;
  std::set<int64_t> commands_; // numbers used by constants
  uint32_t licences_ = 0;
  int64_t nextOffset_ = 0; // in shared area 0
  int64_t nextCommand_ = 1;
};

} // namespace rung::sim::technol
