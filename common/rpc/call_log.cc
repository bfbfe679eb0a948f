#include "common/rpc/call_log.h"

#include <array>
#include <atomic>
#include <cstdio>
#include <exception>
#include <random>

#include <spdlog/spdlog.h>

namespace fitroom::rpc {
namespace {

constexpr size_t kRequestIdLimit = 32;

// The client's request id if it is a plain one, else an own number. Foreign text is never copied into the log as it is.
std::string RequestId(const grpc::ServerContextBase& context) {
  static std::atomic<uint64_t> counter{0};
  const auto found = context.client_metadata().find("x-request-id");
  if (found != context.client_metadata().end()) {
    const grpc::string_ref id = found->second;
    bool plain = !id.empty() && id.size() <= kRequestIdLimit;
    for (const char c : id) plain = plain && ((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || c == '-');
    if (plain) return std::string(id.data(), id.size());
  }
  return "#" + std::to_string(++counter);
}

std::string IncidentId() {
  static thread_local std::mt19937_64 generator{std::random_device{}()};
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(generator()));
  return text.data();
}

Status ReportIncident(const char* what) {
  const std::string incident = IncidentId();
  spdlog::error("incident={} exception={}", incident, what);
  return Internal("INTERNAL", "the server failed; its log tells more under incident " + incident);
}

}  // namespace

CallLog::CallLog(const grpc::ServerContextBase& context, std::string_view method)
    : request_id_(RequestId(context)), method_(method), start_(std::chrono::steady_clock::now()) {}

void CallLog::Write(const Status& status) const {
  const auto milliseconds =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start_).count();
  spdlog::info("request={} method={} code={} reason={} bytes={} ms={}", request_id_, method_,
               StatusCodeName(status.code()), status.ok() ? "-" : status.reason(), byte_count_, milliseconds);
}

Status RunGuarded(const std::function<Status()>& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    return ReportIncident(error.what());
  } catch (...) {
    return ReportIncident("not a std::exception");
  }
}

Status ServerBusy() {
  return ResourceExhausted("SERVER_BUSY", "the server has too much to do at the moment; try again in a few seconds");
}

}  // namespace fitroom::rpc
