#include "common/scan_file/source_text.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace fitroom {
namespace {

// Returns the length of the valid UTF-8 sequence at the front of `text`, 0 if there is none.
size_t Utf8SequenceLength(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto follows = [&](size_t i, unsigned low, unsigned high) {
    return i < text.size() && byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1, 0x80, 0xBF) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const unsigned low = first == 0xE0 ? 0xA0 : 0x80;
    const unsigned high = first == 0xED ? 0x9F : 0xBF;  // No surrogates.
    return follows(1, low, high) && follows(2, 0x80, 0xBF) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const unsigned low = first == 0xF0 ? 0x90 : 0x80;
    const unsigned high = first == 0xF4 ? 0x8F : 0xBF;
    return follows(1, low, high) && follows(2, 0x80, 0xBF) && follows(3, 0x80, 0xBF) ? 4 : 0;
  }
  return 0;
}

}  // namespace

SourceText::SourceText(std::string_view text, std::string_view file_name) : text_(text), file_name_(file_name) {
  const size_t first_end = text.find_first_of("\r\n");
  if (first_end == std::string_view::npos || text[first_end] == '\n') return;
  if (!text.substr(first_end + 1).starts_with('\n')) line_end_ = '\r';
}

int64_t SourceText::LineOf(const char* position) const { return 1 + std::count(begin(), position, line_end_); }

std::string SourceText::Place(const char* position, std::string_view message) const {
  const bool is_binary = binary_from_ != nullptr && position >= binary_from_;
  const std::string place = is_binary ? "byte " + std::to_string(position - begin()) : std::to_string(LineOf(position));
  return std::string(file_name_) + ":" + place + ": " + std::string(message);
}

Status SourceText::ErrorAt(const char* position, std::string reason, std::string_view message) const {
  return InvalidArgument(std::move(reason), Place(position, message));
}

Status SourceText::TooMuchAt(const char* position, std::string reason, std::string_view message) const {
  return ResourceExhausted(std::move(reason), Place(position, message));
}

std::string SourceText::QuoteAt(const char* position) const {
  std::string quoted = "\"";
  for (const char* p = position; p < end() && quoted.size() <= 40 && *p != '\n' && *p != '\r'; ++p) {
    quoted += *p == '\t' ? ' ' : (*p >= 0x20 && *p < 0x7F ? *p : '?');
  }
  return quoted + '"';
}

std::string CleanText(std::string_view text) {
  constexpr size_t kMaxSize = 255;
  std::string clean;
  while (!text.empty()) {
    const size_t length = Utf8SequenceLength(text);
    std::string next(text.substr(0, std::max<size_t>(length, 1)));
    text.remove_prefix(next.size());
    const auto byte = static_cast<unsigned char>(next[0]);
    if (length == 0) next = {static_cast<char>(0xC0 | (byte >> 6)), static_cast<char>(0x80 | (byte & 0x3F))};
    if (byte < 0x20 || byte == 0x7F) next = "?";
    if (clean.size() + next.size() > kMaxSize) break;
    clean += next;
  }
  return clean;
}

ParsedNumber<double> ParseDoubleSlowly(const char* number, const char* end, bool negative) {
  if (number == end || *number == '-') return {};
  double value = 0;
  const auto [next, error] = std::from_chars(number, end, value);
  if (error == std::errc::invalid_argument) return {};
  if (error == std::errc::result_out_of_range) {
    // std::from_chars does not say on which side: a number too small to be told from 0 has a negative exponent.
    const char* exponent = std::find_if(number, next, [](char c) { return c == 'e' || c == 'E'; });
    const bool is_tiny = next - exponent > 1 && exponent[1] == '-';
    value = is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return {next, negative ? -value : value};
}

}  // namespace fitroom
