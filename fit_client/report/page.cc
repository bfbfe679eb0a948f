#include "fit_client/report/page.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdio>

namespace fitroom {
namespace {

constexpr size_t kColumns = 100;
constexpr size_t kNameColumns = 16;  // Of the names on the left, indent included.

}  // namespace

std::string Format(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  char buffer[256];
  const int length = std::vsnprintf(buffer, sizeof(buffer), format, arguments);
  va_end(arguments);
  return std::string(buffer, std::min(static_cast<size_t>(std::max(length, 0)), sizeof(buffer) - 1));
}

std::string Quantity(double value, int decimals, const char* unit) {
  if (!std::isfinite(value)) return "unknown";
  return Format("%.*f %s", decimals, value, unit);
}

std::string Count(int64_t value) {
  std::string digits = std::to_string(value);
  for (std::ptrdiff_t i = static_cast<std::ptrdiff_t>(digits.size()) - 3; i > (value < 0 ? 1 : 0); i -= 3) {
    digits.insert(static_cast<size_t>(i), ",");
  }
  return digits;
}

std::string Printable(std::string_view text) {
  std::string clean(text);
  for (char& c : clean) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = ' ';
  }
  // C1 control characters as UTF-8: 0xC2 0x80 … 0xC2 0x9F.
  for (size_t i = 0; i + 1 < clean.size(); ++i) {
    if (clean[i] == '\xC2' && static_cast<unsigned char>(clean[i + 1]) < 0xA0) clean[i] = clean[i + 1] = ' ';
  }
  return clean;
}

void Page::Heading(const std::string& text) {
  if (!text_.empty()) text_ += "\n";
  text_ += text + "\n";
}

void Page::Entry(const std::string& name, const std::string& value) {
  std::string line = "  " + Printable(name);
  line.resize(std::max(line.size() + 2, kNameColumns), ' ');
  Wrapped(line, Printable(value));
}

void Page::Bullet(const std::string& text) { Wrapped("  - ", Printable(text)); }

void Page::Wrapped(const std::string& first, const std::string& value) {
  const std::string indent(first.size(), ' ');
  std::string line = first;
  bool line_has_word = false;
  for (size_t start = 0; start < value.size();) {
    const size_t end = std::min(value.find(' ', start), value.size());
    const std::string word = value.substr(start, end - start);
    if (line_has_word && line.size() + 1 + word.size() > kColumns) {
      text_ += line + "\n";
      line = indent;
      line_has_word = false;
    }
    line += (line_has_word ? " " : "") + word;
    line_has_word = true;
    start = end + 1;
  }
  text_ += line + "\n";
}

}  // namespace fitroom
