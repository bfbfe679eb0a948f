#pragma once

#include <algorithm>
#include <iterator>
#include <set>
#include <string>

#include <google/protobuf/descriptor.h>

namespace fitroom::testing {

// Describes everything that a peer relies on, one fact a line: a field's number, type and label, an enum value's
// number, a method's messages and streams. Names of messages and fields count too: JSON and programs use them.
class WireLines {
 public:
  explicit WireLines(const google::protobuf::FileDescriptor& file) {
    for (int i = 0; i < file.message_type_count(); ++i) AddMessage(*file.message_type(i));
    for (int i = 0; i < file.enum_type_count(); ++i) AddEnum(*file.enum_type(i));
    for (int i = 0; i < file.service_count(); ++i) AddService(*file.service(i));
  }

  const std::set<std::string>& lines() const { return lines_; }

 private:
  void AddMessage(const google::protobuf::Descriptor& message) {
    lines_.insert("message " + message.full_name());
    for (int i = 0; i < message.field_count(); ++i) AddField(*message.field(i));
    for (int i = 0; i < message.nested_type_count(); ++i) AddMessage(*message.nested_type(i));
    for (int i = 0; i < message.enum_type_count(); ++i) AddEnum(*message.enum_type(i));
  }
  void AddField(const google::protobuf::FieldDescriptor& field) {
    std::string type = field.type_name();
    if (field.message_type() != nullptr) type = field.message_type()->full_name();
    if (field.enum_type() != nullptr) type = field.enum_type()->full_name();
    const std::string label = field.is_repeated() ? " repeated" : field.has_optional_keyword() ? " optional" : "";
    lines_.insert("field " + field.full_name() + " = " + std::to_string(field.number()) + label + " " + type);
  }
  void AddEnum(const google::protobuf::EnumDescriptor& enumeration) {
    for (int i = 0; i < enumeration.value_count(); ++i) {
      const google::protobuf::EnumValueDescriptor& value = *enumeration.value(i);
      lines_.insert("value " + enumeration.full_name() + "." + value.name() + " = " + std::to_string(value.number()));
    }
  }
  void AddService(const google::protobuf::ServiceDescriptor& service) {
    for (int i = 0; i < service.method_count(); ++i) {
      const google::protobuf::MethodDescriptor& method = *service.method(i);
      lines_.insert("method " + method.full_name() + (method.client_streaming() ? " stream " : " ") +
                    method.input_type()->full_name() + (method.server_streaming() ? " -> stream " : " -> ") +
                    method.output_type()->full_name());
    }
  }

  std::set<std::string> lines_;
};

// Returns the facts of `before` that no longer hold: each one breaks a peer.
inline std::set<std::string> BrokenLines(const std::set<std::string>& before, const std::set<std::string>& after) {
  std::set<std::string> broken;
  std::set_difference(before.begin(), before.end(), after.begin(), after.end(), std::inserter(broken, broken.end()));
  return broken;
}

}  // namespace fitroom::testing
