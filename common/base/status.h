#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "common/base/check.h"

namespace fitroom {

// The sixteen codes of gRPC beside OK, with gRPC's numbers, so that an error keeps its meaning across the wire.
enum class StatusCode {
  kOk = 0,
  kCancelled = 1,
  kUnknown = 2,
  kInvalidArgument = 3,
  kDeadlineExceeded = 4,
  kNotFound = 5,
  kAlreadyExists = 6,
  kPermissionDenied = 7,
  kResourceExhausted = 8,
  kFailedPrecondition = 9,
  kAborted = 10,
  kOutOfRange = 11,
  kUnimplemented = 12,
  kInternal = 13,
  kUnavailable = 14,
  kDataLoss = 15,
  kUnauthenticated = 16,
};

// Returns the code's name as gRPC prints it, for example "INVALID_ARGUMENT".
std::string_view StatusCodeName(StatusCode code);

// The outcome of an operation that can fail for reasons outside the program.
// An error has a code for the caller, a machine-readable reason in UPPER_SNAKE_CASE and a message for a person that
// names the place and the remedy. Immutable; safe to copy between threads.
class [[nodiscard]] Status {
 public:
  Status() = default;  // OK.
  Status(StatusCode code, std::string reason, std::string message)
      : code_(code), reason_(std::move(reason)), message_(std::move(message)) {
    FR_CHECK(code != StatusCode::kOk);
  }

  bool ok() const { return code_ == StatusCode::kOk; }
  StatusCode code() const { return code_; }
  const std::string& reason() const { return reason_; }
  const std::string& message() const { return message_; }

  // Returns the same error with `place` put in front of the message ("place: message"); OK stays OK.
  Status At(std::string_view place) const;
  // Formats "CODE [REASON] message", or "OK".
  std::string ToString() const;

 private:
  StatusCode code_ = StatusCode::kOk;
  std::string reason_;
  std::string message_;
};

inline Status InvalidArgument(std::string reason, std::string message) {
  return Status(StatusCode::kInvalidArgument, std::move(reason), std::move(message));
}
inline Status NotFound(std::string reason, std::string message) {
  return Status(StatusCode::kNotFound, std::move(reason), std::move(message));
}
inline Status FailedPrecondition(std::string reason, std::string message) {
  return Status(StatusCode::kFailedPrecondition, std::move(reason), std::move(message));
}
inline Status ResourceExhausted(std::string reason, std::string message) {
  return Status(StatusCode::kResourceExhausted, std::move(reason), std::move(message));
}
inline Status Unavailable(std::string reason, std::string message) {
  return Status(StatusCode::kUnavailable, std::move(reason), std::move(message));
}
inline Status DataLoss(std::string reason, std::string message) {
  return Status(StatusCode::kDataLoss, std::move(reason), std::move(message));
}
inline Status Internal(std::string reason, std::string message) {
  return Status(StatusCode::kInternal, std::move(reason), std::move(message));
}

// A value, or the error that kept it from being made. Reading the value of an error is a bug of the caller.
template <typename T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}        // NOLINT: implicit on purpose.
  Result(Status status) : state_(std::in_place_index<1>, std::move(status)) {  // NOLINT: implicit on purpose.
    FR_CHECK(!std::get<1>(state_).ok());
  }

  bool ok() const { return state_.index() == 0; }
  Status status() const { return ok() ? Status() : std::get<1>(state_); }

  const T& value() const& {
    FR_CHECK(ok());
    return std::get<0>(state_);
  }
  T& value() & {
    FR_CHECK(ok());
    return std::get<0>(state_);
  }
  T&& value() && {
    FR_CHECK(ok());
    return std::get<0>(std::move(state_));
  }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }

 private:
  std::variant<T, Status> state_;
};

}  // namespace fitroom

#define FR_STATUS_CONCAT_INNER(a, b) a##b
#define FR_STATUS_CONCAT(a, b) FR_STATUS_CONCAT_INNER(a, b)

// Leaves the enclosing function with the error, if there is one.
#define FR_RETURN_IF_ERROR(expression)                                                    \
  do {                                                                                    \
    if (::fitroom::Status fr_status_ = (expression); !fr_status_.ok()) return fr_status_; \
  } while (false)

// Declares `declaration` from a Result's value, or leaves the enclosing function with its error.
#define FR_ASSIGN_OR_RETURN(declaration, expression) \
  FR_ASSIGN_OR_RETURN_IMPL(FR_STATUS_CONCAT(fr_result_, __LINE__), declaration, expression)
#define FR_ASSIGN_OR_RETURN_IMPL(result, declaration, expression) \
  auto result = (expression);                                     \
  if (!result.ok()) return result.status();                       \
  declaration = std::move(result).value()
