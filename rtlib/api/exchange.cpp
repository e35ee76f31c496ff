// Messages, service requests, and functions of a part program.
#include <span>

#include "rtlib/api/error.h"
#include "rtlib/api/running.h"
#include "rtlib/load/program_info.h"

namespace rung::api {

rung_request shown(const core::ServiceRequest& request, const nc::Control& control) noexcept {
  const core::ServiceName name = request.service == nc::Control::kOwnService ? control.ownService() : *request.name;
  rung_request out{.size = sizeof out,
                   .ticket = request.ticket,
                   .service = name.text,
                   .arg_count = request.argCount,
                   .kind = name.kind};
  std::memcpy(out.args, request.args, sizeof out.args);
  return out;
}

core::ServiceReply taken(const rung_reply& reply) noexcept {
  core::ServiceReply out{.ticket = reply.ticket,
                         .state = reply.error != 0 ? RUNG_SERVICE_ERROR : RUNG_SERVICE_DONE,
                         .resultCount = std::min(reply.result_count, RUNG_MAX_SERVICE_ARGS)};
  std::memcpy(out.results, reply.results, sizeof out.results);
  return out;
}

void say(rung_instance& instance, const rung_message& message) noexcept {
  Generation& now = instance.now();
  now.refer();
  if (!instance.messages.push({message, &now})) now.forget();
}

namespace {

nc::Functions* functionsOf(rung_instance& instance, uint32_t channel) noexcept {
  return channel < 32 ? instance.control->functions(channel) : nullptr;
}

// The control has taken it.
int32_t configure(rung_instance& instance, const Configured& what) {
  instance.configured.push_back(what);
  if (instance.recorder) instance.recorder->changedWhole();
  return RUNG_OK;
}

int32_t failChannel(uint32_t channel) noexcept {
  return fail(RUNG_NOT_FOUND, "the control has no functions in a channel %u", channel);
}

int32_t checkFunction(rung_instance& instance, uint32_t channel, int32_t kind, uint32_t code) noexcept {
  if (kind < RUNG_FUNCTION_M || kind > RUNG_FUNCTION_KEY)
    return fail(RUNG_BAD_ARGUMENT, "%d is not an enum rung_function_kind", kind);
  const nc::Functions* functions = functionsOf(instance, channel);
  if (functions == nullptr) return failChannel(channel);
  if (functions->supports(static_cast<nc::FunctionKind>(kind), code)) return RUNG_OK;
  const std::string_view name = nc::kFunctionKinds[kind];
  return fail(RUNG_NOT_FOUND, "the dialect has no signals for %.*s%u", static_cast<int>(name.size()), name.data(),
              code);
}

} // namespace
} // namespace rung::api

using namespace rung;
using namespace rung::api;

int32_t rung_instance_next_message(rung_instance* instance, rung_message_info* message) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  Said next;
  if (message == nullptr || !hasSize(message)) return failSize("rung_message_info");
  if (!handle->messages.pop(next)) return RUNG_EMPTY;
  const rung_message seen = handle->control->outward(next.message);
  rung_message_info out{.op = seen.op,
                        .number = seen.number,
                        .channel = seen.channel,
                        .index = seen.index,
                        .real = seen.real,
                        .value = {.integer = seen.value}};
  if (seen.op != RUNG_MESSAGE_CLEAR) { // which has no values
    char line[sizeof out.text];        // one byte more, to see whether the last character is whole
    putText(out.text, {line, handle->control->describe(next.by->program(), next.message, line)});
  }
  next.by->forget();
  return giveStruct(message, out);
}

int32_t rung_instance_define_message(rung_instance* instance, uint32_t number, uint32_t flags, const char* text) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (text == nullptr) return fail(RUNG_BAD_ARGUMENT, "the text of message %u is null", number);
  constexpr uint32_t kFlags = RUNG_MESSAGE_LASTS | RUNG_MESSAGE_LOGGED_ONLY;
  if ((flags & ~kFlags) != 0) return fail(RUNG_BAD_ARGUMENT, "the flags %u of message %u are unknown", flags, number);
  if (call->wasOn) return fail(RUNG_WRONG_STATE, "what messages are is said before the first power-on");
  return contained([&] {
    const bool taken = call->control->define({.number = number,
                                              .lasts = (flags & RUNG_MESSAGE_LASTS) != 0,
                                              .loggedOnly = (flags & RUNG_MESSAGE_LOGGED_ONLY) != 0,
                                              .text = text});
    if (taken) return configure(*call, {.kind = Configured::Kind::Message, .a = number, .b = flags, .text = text});
    return fail(RUNG_NOT_FOUND, "the dialect has the texts of its messages in the program");
  });
}

int32_t rung_instance_shown(const rung_instance* instance, uint32_t index, rung_message_info* message) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  return contained([&] {
    const std::vector<nc::ShownMessage> all = call->control->messages(call->running);
    if (index >= all.size()) return int32_t{RUNG_EMPTY};
    const nc::ShownMessage& shownNow = all[index];
    rung_message_info out{.op = RUNG_MESSAGE_SHOW,
                          .number = shownNow.number,
                          .channel = shownNow.channel,
                          .index = shownNow.index,
                          .real = shownNow.real ? 1u : 0u,
                          .value = {.integer = shownNow.value}};
    putText(out.text, call->control->text(shownNow));
    return giveStruct(message, out);
  });
}

int32_t rung_instance_next_request(rung_instance* instance, rung_request* request) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  if (request == nullptr || !hasSize(request)) return failSize("rung_request");
  core::ServiceRequest next;
  if (!handle->running.services().take(next)) return RUNG_EMPTY;
  return giveStruct(request, shown(next, *handle->control));
}

int32_t rung_instance_answer(rung_instance* instance, const rung_reply* reply) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  rung_reply given{};
  if (reply == nullptr || !takeStruct(reply, given)) return failSize("rung_reply");
  if (given.result_count > RUNG_MAX_SERVICE_ARGS)
    return fail(RUNG_BAD_ARGUMENT, "a reply has at most %u results, not %u", RUNG_MAX_SERVICE_ARGS, given.result_count);
  return handle->running.services().complete(taken(given)) ? RUNG_OK : RUNG_LATER;
}

int32_t rung_instance_begin_function(rung_instance* instance, uint32_t channel, int32_t kind, uint32_t code,
                                     uint32_t* function) {
  const Call call(instance, When::On);
  if (!call.ok()) return call.status();
  if (function == nullptr) return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the handle of a function is null");
  if (const int32_t status = checkFunction(*call, channel, kind, code); status != RUNG_OK) return status;
  const auto of = static_cast<nc::FunctionKind>(kind);
  if (call->recorder) call->recorder->functionBegins(channel, kind, code);
  const std::optional<uint32_t> started = functionsOf(*call, channel)->start(of, code);
  if (!started) {
    if (call->recorder) call->recorder->functionRefused();
    return RUNG_LATER;
  }
  call->functionChannels |= 1u << channel;
  *function = *started;
  return RUNG_OK;
}

int32_t rung_instance_function_done(rung_instance* instance, uint32_t channel, uint32_t function) {
  const Call call(instance, When::On);
  if (!call.ok()) return call.status();
  nc::Functions* functions = functionsOf(*call, channel);
  if (functions == nullptr) return failChannel(channel);
  return functions->busy(function) ? RUNG_LATER : RUNG_OK;
}

int32_t rung_instance_abort_functions(rung_instance* instance, uint32_t channel) {
  const Call call(instance, When::On);
  if (!call.ok()) return call.status();
  nc::Functions* functions = functionsOf(*call, channel);
  if (functions == nullptr) return failChannel(channel);
  if (call->recorder) call->recorder->aborts(channel);
  functions->abort();
  return RUNG_OK;
}

int32_t rung_instance_supports_function(const rung_instance* instance, uint32_t channel, int32_t kind, uint32_t code) {
  const Call call(instance);
  return call.ok() ? checkFunction(*call, channel, kind, code) : call.status();
}

int32_t rung_instance_group_function(rung_instance* instance, uint32_t channel, uint32_t code, uint32_t group) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  nc::Functions* functions = functionsOf(*call, channel);
  if (functions == nullptr) return failChannel(channel);
  return contained([&] {
    if (functions->setGroup(code, group))
      return configure(*call, {.kind = Configured::Kind::Group, .a = channel, .b = code, .c = group});
    return fail(RUNG_NOT_FOUND, "M%u cannot be in a group %u that the machine chooses", code, group);
  });
}

int32_t rung_instance_axis_group(rung_instance* instance, uint32_t axis, uint32_t group) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (call->control->setAxisGroup(axis, group))
    return contained([&] { return configure(*call, {.kind = Configured::Kind::AxisGroup, .a = axis, .b = group}); });
  return fail(RUNG_NOT_FOUND, "the dialect has no axis %u, or no group %u, both from 0", axis, group);
}

int32_t rung_instance_high_speed_functions(rung_instance* instance, uint32_t channel) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  nc::Functions* functions = functionsOf(*call, channel);
  if (functions == nullptr) return failChannel(channel);
  if (!functions->useHighSpeed()) return fail(RUNG_NOT_FOUND, "the dialect has no high-speed handshake");
  return contained([&] { return configure(*call, {.kind = Configured::Kind::HighSpeed, .a = channel}); });
}

int32_t rung_instance_serving(rung_instance* instance, int32_t is_served) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  call->control->setServed(is_served != 0);
  if (call->recorder) call->recorder->served(is_served != 0);
  return RUNG_OK;
}
