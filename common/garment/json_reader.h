#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "common/base/status.h"

// How this room reads JSON from outside: no exception of the library gets out, every error names its place. Not for
// other rooms.
namespace fitroom {

using Json = nlohmann::ordered_json;

// Returns the line, counted from 1, in which byte `offset` of a text stands.
int LineOf(std::string_view text, size_t offset);

// Parses an object. INVALID_ARGUMENT `reason` names the line where the text is no JSON; RESOURCE_EXHAUSTED
// `reason`_TOO_LARGE above `max_size` bytes.
Result<Json> ParseJsonObject(std::string_view text, size_t max_size, const std::string& reason);

// Reads members of one JSON object and remembers its place for messages. Each getter fails with INVALID_ARGUMENT
// `reason` where the member is absent or of another type. The JSON must outlive the reader.
class ObjectReader {
 public:
  ObjectReader(const Json& json, std::string place, std::string reason = "GARMENT_JSON")
      : json_(json), place_(std::move(place)), reason_(std::move(reason)) {}

  // An error at this object.
  Status Bad(const std::string& what) const { return InvalidArgument(reason_, place_ + " " + what); }
  // An error at one of its members; the name is shortened.
  Status BadMember(std::string_view name, const std::string& what) const {
    return InvalidArgument(reason_, place_ + "." + std::string(name.substr(0, 40)) + " " + what);
  }

  bool Has(const char* name) const { return json_.is_object() && json_.contains(name); }
  Result<const Json*> Member(const char* name) const;
  Result<std::string> String(const char* name) const;
  Result<double> Number(const char* name) const;
  Result<int> Int(const char* name) const;

  const Json& json() const { return json_; }
  const std::string& place() const { return place_; }
  const std::string& reason() const { return reason_; }

 private:
  const Json& json_;
  std::string place_;
  std::string reason_;
};

}  // namespace fitroom
