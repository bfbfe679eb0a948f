#include "common/garment/json_reader.h"

#include <algorithm>
#include <cmath>

namespace fitroom {

int LineOf(std::string_view text, size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  return 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
}

Result<Json> ParseJsonObject(std::string_view text, size_t max_size, const std::string& reason) {
  if (text.size() > max_size) {
    return ResourceExhausted(reason + "_TOO_LARGE", "the JSON text has " + std::to_string(text.size()) +
                                                        " bytes; at most " + std::to_string(max_size) + " are read");
  }
  try {
    Json json = Json::parse(text);
    if (!json.is_object()) return InvalidArgument(reason, "the document is not an object");
    return json;
  } catch (const Json::parse_error& error) {
    const size_t offset = error.byte == 0 ? 0 : error.byte - 1;
    return InvalidArgument(reason, "the text is not valid JSON, line " + std::to_string(LineOf(text, offset)));
  } catch (const Json::exception&) {
    return InvalidArgument(reason, "the text is not valid JSON");  // For example a number that no double can hold.
  }
}

Result<const Json*> ObjectReader::Member(const char* name) const {
  if (!json_.is_object()) return Bad("is not an object");
  const auto found = json_.find(name);
  if (found == json_.end()) return BadMember(name, "is missing");
  return &*found;
}

Result<std::string> ObjectReader::String(const char* name) const {
  FR_ASSIGN_OR_RETURN(const Json* member, Member(name));
  if (!member->is_string()) return BadMember(name, "is not a string");
  return member->get<std::string>();
}

Result<double> ObjectReader::Number(const char* name) const {
  FR_ASSIGN_OR_RETURN(const Json* member, Member(name));
  if (!member->is_number()) return BadMember(name, "is not a number");
  return member->get<double>();
}

Result<int> ObjectReader::Int(const char* name) const {
  FR_ASSIGN_OR_RETURN(const double number, Number(name));
  if (number != std::floor(number) || std::abs(number) > 1e9) return BadMember(name, "is not an integer");
  return static_cast<int>(number);
}

}  // namespace fitroom
