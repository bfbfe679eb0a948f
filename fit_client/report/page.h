#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fitroom {

// Formats like printf, at most 255 bytes.
[[gnu::format(printf, 1, 2)]] std::string Format(const char* format, ...);

// Returns a number with its unit; a number that is none says so.
std::string Quantity(double value, int decimals, const char* unit);

// Returns 12345 as "12,345".
std::string Count(int64_t value);

// Returns a string from outside without anything that could steer a terminal.
std::string Printable(std::string_view text);

// Collects the lines of a text report: a name on the left, and text that is wrapped beside it, 100 columns.
class Page {
 public:
  // Begins a section; an empty line before all but the first.
  void Heading(const std::string& text);
  void Line(const std::string& text) { text_ += text + "\n"; }
  // Both are made printable.
  void Entry(const std::string& name, const std::string& value);
  void Bullet(const std::string& text);
  const std::string& text() const { return text_; }

 private:
  // Writes `first` and then the words of `value`, on as many lines as they need.
  void Wrapped(const std::string& first, const std::string& value);
  std::string text_;
};

}  // namespace fitroom
