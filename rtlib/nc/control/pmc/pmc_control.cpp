// Power-on, names and requests of the family (see pmc_control.h).
#include "rtlib/nc/control/pmc/pmc_control.h"

#include "rtlib/load/program_info.h"
#include "rtlib/text/number.h"

namespace rung::nc {
namespace {

std::vector<uint8_t> readArea(const runtime::Instance& instance, const char* area) {
  const uint32_t space = runtime::findSpace(instance.program(), area);
  std::vector<uint8_t> bytes(space == RUNG_NONE ? 0 : instance.program().spaces[space].byte_count);
  for (uint32_t i = 0; i < bytes.size(); ++i) bytes[i] = instance.memory().readByte(space, i);
  return bytes;
}

void writeArea(runtime::Instance& instance, const char* area, const std::vector<uint8_t>& bytes) {
  const uint32_t space = runtime::findSpace(instance.program(), area);
  for (uint32_t i = 0; i < bytes.size(); ++i) instance.memory().writeByte(space, i, bytes[i]);
}

struct PmcPlaces final : Places {
  PmcPlaces(const rung_program& program, pmc::MessageRule rule) : areas(program), messages(program, rule) {}

  pmc::Areas areas;
  PmcMessages::Places messages;
};

} // namespace

std::unique_ptr<Places> PmcControl::locate(const rung_program& program) const {
  return std::make_unique<PmcPlaces>(program, model_->messages);
}

void PmcControl::usePlaces(runtime::Instance& instance, Places& places) noexcept {
  const auto& own = static_cast<const PmcPlaces&>(places);
  io_.emplace(instance, own.areas);
  functions_.use(*io_);
  messages_.use(instance.block().data(), own.messages);
}

void PmcControl::prepare(runtime::Instance& instance, PowerOn kind) {
  const std::vector<uint8_t> machine = readArea(instance, "X");
  const std::vector<uint8_t> cnc = readArea(instance, "F");
  Control::prepare(instance, kind);
  writeArea(instance, "X", machine);
  writeArea(instance, "F", cnc);
  functions_.powerOn();
  axes_.powerOn();
  messages_.powerOn();
}

size_t PmcControl::describe(const rung_program& program, const rung_message& message,
                            std::span<char> out) const noexcept {
  const bool listed = model_->messages == pmc::MessageRule::ByTextList;
  return listed ? PmcMessages::describe(program, message, out) : Control::describe(program, message, out);
}

std::string PmcControl::text(const ShownMessage& message) const {
  const bool listed = model_->messages == pmc::MessageRule::ByTextList;
  return listed ? PmcMessages::text(message) : Control::text(message);
}

namespace {

// NC.MPOS.N, the machine position of axis N in 0.001 mm; only in programs that read positions (PSGNL, PSGN2).
std::optional<runtime::Ref> position(const rung_program& program, std::string_view number) {
  constexpr uint32_t kBytes = 4;
  const uint32_t space = runtime::findSpace(program, "@MPOS");
  const uint32_t axis = text::numberIn<uint32_t>(number).value_or(0);
  if (space == RUNG_NONE || axis == 0 || axis > program.spaces[space].byte_count / kBytes) return std::nullopt;
  return runtime::intRef(space, kBytes * (axis - 1), 8 * kBytes);
}

} // namespace

std::optional<runtime::Ref> PmcControl::signal(const rung_program& program, std::string_view name) const {
  constexpr std::string_view kPositions = "NC.MPOS.";
  if (name.starts_with(kPositions)) return position(program, name.substr(kPositions.size()));
  const Signal* found = findSignal(model_->signals(), name);
  if (found == nullptr) return std::nullopt;
  const uint32_t space = runtime::findSpace(program, found->area);
  if (space == RUNG_NONE) return std::nullopt;
  if (found->type == SignalType::Bit) return runtime::bitRef(space, found->byteOffset, found->bit);
  const uint32_t bytes = elementBytes(found->type);
  if (bytes == 0) return std::nullopt;
  return runtime::intRef(space, found->byteOffset, bytes * 8);
}

bool PmcControl::isConstant(const rung_program& program, const runtime::Ref& place) const {
  const pmc::ConstantRelays& constants = model_->constants;
  const uint32_t larger = runtime::findSpace(program, "Z");
  const bool isInZ = larger != RUNG_NONE && program.spaces[larger].byte_count > constants.inZ;
  const uint32_t byte = isInZ ? constants.inZ : constants.inR;
  if (constants.mask == 0 || place.space != (isInZ ? larger : runtime::findSpace(program, "R"))) return false;
  if (place.kind == runtime::RefKind::Bit) return place.byte == byte && (constants.mask >> place.bit & 1) != 0;
  return place.byte <= byte && byte < place.byte + place.width / 8u;
}

core::ServiceReply PmcControl::refuse(const core::ServiceRequest& request) const noexcept {
  const auto kind = static_cast<pmc::ServiceKind>(request.name->kind);
  if (kind != pmc::ServiceKind::ReadWindow && kind != pmc::ServiceKind::WriteWindow) return Control::refuse(request);
  return {.ticket = request.ticket,
          .state = RUNG_SERVICE_DONE,
          .resultCount = model_->service(kind).results.count(),
          .results = {model_->windowRefused}};
}

} // namespace rung::nc
