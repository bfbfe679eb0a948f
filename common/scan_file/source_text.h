#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "common/base/status.h"

namespace fitroom {

// The text of a file that is being read, and where in it an error lies. Borrows both views.
class SourceText {
 public:
  SourceText(std::string_view text, std::string_view file_name);

  std::string_view text() const { return text_; }
  const char* begin() const { return text_.data(); }
  const char* end() const { return text_.data() + text_.size(); }
  // The byte that ends a line: LF, or CR in a file whose first line ends in CR alone.
  char line_end() const { return line_end_; }

  // From `position` on the file is binary: errors there name the byte instead of the line.
  void SetBinaryFrom(const char* position) { binary_from_ = position; }

  // Returns the number of the line that holds `position`, from 1. Counts from the start: for errors only.
  int64_t LineOf(const char* position) const;
  // Returns INVALID_ARGUMENT with the message "file:line: message", or "file:byte offset: message" in a binary part.
  Status ErrorAt(const char* position, std::string reason, std::string_view message) const;
  // Returns RESOURCE_EXHAUSTED with the message "file:line: message".
  Status TooMuchAt(const char* position, std::string reason, std::string_view message) const;
  // Returns up to 40 printable characters from `position` to the end of its line, in quotes, for a message.
  std::string QuoteAt(const char* position) const;

 private:
  std::string Place(const char* position, std::string_view message) const;
  std::string_view text_;
  std::string_view file_name_;
  char line_end_ = '\n';
  const char* binary_from_ = nullptr;
};

// Returns foreign text as UTF-8 (bytes that are not are taken as Latin-1), control characters replaced by '?', cut to
// at most 255 bytes.
std::string CleanText(std::string_view text);

// Finds the next occurrence of one byte for a cursor that only moves forward, each stretch searched once: keeps the
// whole search linear however often it is asked.
class ByteFinder {
 public:
  explicit ByteFinder(char byte) : byte_(byte) {}

  // Returns the first occurrence in [position, end), or `end`. Positions must not decrease from call to call.
  const char* Find(const char* position, const char* end) {
    if (next_ != nullptr && next_ >= position) return next_;
    if (position == end) return end;
    const void* found = std::memchr(position, byte_, static_cast<size_t>(end - position));
    next_ = found != nullptr ? static_cast<const char*>(found) : end;
    return next_;
  }

 private:
  char byte_;
  const char* next_ = nullptr;
};

inline bool IsBlank(char c) { return c == ' ' || c == '\t'; }
inline bool IsDigit(char c) { return c >= '0' && c <= '9'; }
inline bool IsSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

inline const char* SkipBlanks(const char* position, const char* end) {
  while (position < end && IsBlank(*position)) ++position;
  return position;
}
inline const char* SkipSpace(const char* position, const char* end) {
  while (position < end && IsSpace(*position)) ++position;
  return position;
}

// A number read from text and the position behind it; nullptr where there was none.
template <typename T>
struct ParsedNumber {
  const char* next = nullptr;
  T value = 0;
};

// The long way of ParseDouble(): exponents, many digits, "inf" and "nan". `number` stands behind the sign.
ParsedNumber<double> ParseDoubleSlowly(const char* number, const char* end, bool negative);

// Parses a decimal number after blanks, correctly rounded. Up to 15 digits with at most 15 behind the point, as every
// exporter writes, take the short way: an integer below 2^53 divided by an exact power of ten rounds once (Clinger
// 1990).
inline ParsedNumber<double> ParseDouble(const char* position, const char* end) {
  static constexpr double kPowersOfTen[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                            1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  position = SkipBlanks(position, end);
  const char* p = position;
  const bool negative = p < end && *p == '-';
  if (p < end && (*p == '-' || *p == '+')) ++p;
  const char* const number = p;
  uint64_t digits = 0;
  while (p < end && IsDigit(*p)) digits = digits * 10 + static_cast<uint64_t>(*p++ - '0');
  int64_t digit_count = p - number;
  int64_t decimal_count = 0;
  if (p < end && *p == '.') {
    const char* const decimals = ++p;
    while (p < end && IsDigit(*p)) digits = digits * 10 + static_cast<uint64_t>(*p++ - '0');
    decimal_count = p - decimals;
    digit_count += decimal_count;
  }
  const bool has_exponent = p < end && (*p == 'e' || *p == 'E');
  if (digit_count > 0 && digit_count <= 15 && !has_exponent) {
    const double size = static_cast<double>(digits) / kPowersOfTen[decimal_count];
    return {p, negative ? -size : size};
  }
  return ParseDoubleSlowly(number, end, negative);
}

// Parses a decimal integer of at most 18 digits after blanks; a longer one is no number.
inline ParsedNumber<int64_t> ParseInt(const char* position, const char* end) {
  const char* p = SkipBlanks(position, end);
  const bool negative = p < end && *p == '-';
  if (negative) ++p;
  const char* const number = p;
  int64_t value = 0;
  while (p < end && IsDigit(*p) && p - number < 18) value = value * 10 + (*p++ - '0');
  if (p == number || (p < end && IsDigit(*p))) return {};
  return {p, negative ? -value : value};
}

}  // namespace fitroom
