// Keeps the conventions of the wire and its promise to peers, by walking the descriptors of all .proto files.

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include "tests/contract/wire_lines.h"

namespace fitroom {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;
using google::protobuf::FileDescriptorProto;
using google::protobuf::FileDescriptorSet;
using google::protobuf::MethodDescriptor;
using google::protobuf::ServiceDescriptor;
using google::protobuf::SourceLocation;

// The contract as protoc understood it, with comments.
class Contract {
 public:
  Contract() {
    std::ifstream stream(FITROOM_DESCRIPTOR_SET, std::ios::binary);
    FileDescriptorSet set;
    if (!set.ParseFromIstream(&stream)) return;
    for (const FileDescriptorProto& file : set.file()) {
      const FileDescriptor* built = pool_.BuildFile(file);
      if (built != nullptr && built->package().starts_with("fitroom.")) files_.push_back(built);
    }
  }

  const std::vector<const FileDescriptor*>& files() const { return files_; }

  std::vector<const Descriptor*> Messages() const {
    std::vector<const Descriptor*> messages;
    const std::function<void(const Descriptor*)> add = [&](const Descriptor* message) {
      if (message->options().map_entry()) return;
      messages.push_back(message);
      for (int i = 0; i < message->nested_type_count(); ++i) add(message->nested_type(i));
    };
    for (const FileDescriptor* file : files_) {
      for (int i = 0; i < file->message_type_count(); ++i) add(file->message_type(i));
    }
    return messages;
  }

  std::vector<const MethodDescriptor*> Methods() const {
    std::vector<const MethodDescriptor*> methods;
    for (const FileDescriptor* file : files_) {
      for (int i = 0; i < file->service_count(); ++i) {
        for (int j = 0; j < file->service(i)->method_count(); ++j) methods.push_back(file->service(i)->method(j));
      }
    }
    return methods;
  }

  std::vector<const EnumDescriptor*> Enums() const {
    std::vector<const EnumDescriptor*> enums;
    for (const FileDescriptor* file : files_) {
      for (int i = 0; i < file->enum_type_count(); ++i) enums.push_back(file->enum_type(i));
    }
    return enums;
  }

  std::set<std::string> Lines() const {
    std::set<std::string> lines;
    for (const FileDescriptor* file : files_) lines.merge(std::set<std::string>(testing::WireLines(*file).lines()));
    return lines;
  }

 private:
  google::protobuf::DescriptorPool pool_;
  std::vector<const FileDescriptor*> files_;
};

const Contract& TheContract() {
  static const Contract contract;
  return contract;
}

template <typename Thing>
bool HasComment(const Thing& thing) {
  SourceLocation location;
  return thing.GetSourceLocation(&location) && location.leading_comments.size() > 3;
}

TEST(WireContract, HasAllFiles) {
  std::set<std::string> names;
  for (const FileDescriptor* file : TheContract().files()) names.insert(file->name());
  EXPECT_EQ(names, (std::set<std::string>{"fitroom/common/v1/rpc_status.proto", "fitroom/common/v1/chunk.proto",
                                          "fitroom/body/v1/scan.proto", "fitroom/body/v1/scan_service.proto",
                                          "fitroom/shop/v1/garment.proto", "fitroom/shop/v1/garment_service.proto"}));
}

TEST(WireContract, PackagesAreTheirFoldersAndHaveAVersion) {
  for (const FileDescriptor* file : TheContract().files()) {
    std::string folder = file->package();
    for (char& c : folder) c = c == '.' ? '/' : c;
    EXPECT_EQ(file->name().substr(0, file->name().rfind('/')), folder);
    EXPECT_TRUE(folder.ends_with("/v1")) << folder;
  }
}

TEST(WireContract, EverythingHasAComment) {
  for (const FileDescriptor* file : TheContract().files()) {
    for (int i = 0; i < file->service_count(); ++i) {
      EXPECT_TRUE(HasComment(*file->service(i))) << file->service(i)->full_name();
      EXPECT_TRUE(file->service(i)->name().ends_with("Service")) << file->service(i)->full_name();
    }
  }
  for (const MethodDescriptor* method : TheContract().Methods())
    EXPECT_TRUE(HasComment(*method)) << method->full_name();
  for (const EnumDescriptor* enumeration : TheContract().Enums()) {
    EXPECT_TRUE(HasComment(*enumeration)) << enumeration->full_name();
    for (int i = 0; i < enumeration->value_count(); ++i) {
      EXPECT_TRUE(HasComment(*enumeration->value(i))) << enumeration->value(i)->full_name();
    }
  }
  for (const Descriptor* message : TheContract().Messages()) {
    EXPECT_TRUE(HasComment(*message)) << message->full_name();
    for (int i = 0; i < message->field_count(); ++i) {
      EXPECT_TRUE(HasComment(*message->field(i))) << message->field(i)->full_name();
    }
  }
}

TEST(WireContract, RequestFieldsSayWhetherTheyAreRequired) {
  for (const MethodDescriptor* method : TheContract().Methods()) {
    for (int i = 0; i < method->input_type()->field_count(); ++i) {
      SourceLocation location;
      ASSERT_TRUE(method->input_type()->field(i)->GetSourceLocation(&location));
      const std::string& comment = location.leading_comments;
      EXPECT_TRUE(comment.find("Required") != std::string::npos || comment.find("Optional") != std::string::npos)
          << method->input_type()->field(i)->full_name();
    }
  }
}

TEST(WireContract, EachMethodHasItsOwnRequestAndResponse) {
  ASSERT_EQ(TheContract().Methods().size(), 16u);
  for (const MethodDescriptor* method : TheContract().Methods()) {
    EXPECT_EQ(method->input_type()->name(), method->name() + "Request");
    EXPECT_EQ(method->output_type()->name(), method->name() + "Response");
  }
}

TEST(WireContract, ListsComeInPages) {
  int list_count = 0;
  for (const MethodDescriptor* method : TheContract().Methods()) {
    if (!method->name().starts_with("List")) continue;
    ++list_count;
    const FieldDescriptor* size = method->input_type()->FindFieldByName("page_size");
    const FieldDescriptor* token = method->input_type()->FindFieldByName("page_token");
    const FieldDescriptor* next = method->output_type()->FindFieldByName("next_page_token");
    ASSERT_TRUE(size != nullptr && token != nullptr && next != nullptr) << method->full_name();
    EXPECT_EQ(size->type(), FieldDescriptor::TYPE_INT32);
    EXPECT_EQ(token->type(), FieldDescriptor::TYPE_STRING);
    EXPECT_EQ(next->type(), FieldDescriptor::TYPE_STRING);
  }
  EXPECT_EQ(list_count, 2);
}

TEST(WireContract, EnumsStartUnspecifiedAndCarryTheirName) {
  for (const EnumDescriptor* enumeration : TheContract().Enums()) {
    std::string prefix;  // "ScanContent" becomes "SCAN_CONTENT_".
    for (const char c : enumeration->name()) {
      if (std::isupper(static_cast<unsigned char>(c)) != 0 && !prefix.empty()) prefix += '_';
      prefix += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    ASSERT_NE(enumeration->FindValueByNumber(0), nullptr);
    EXPECT_EQ(enumeration->FindValueByNumber(0)->name(), prefix + "_UNSPECIFIED");
    for (int i = 0; i < enumeration->value_count(); ++i) {
      EXPECT_TRUE(enumeration->value(i)->name().starts_with(prefix + "_")) << enumeration->value(i)->full_name();
    }
  }
}

TEST(WireContract, NumbersAreSignedAndSayTheirUnit) {
  const std::vector<std::string> units = {"_m",     "_px",   "_deg",   "_bytes",    "_count",     "_size",
                                          "_pixel", "_unit", "crc32c", "page_size", "confidence", "code"};
  for (const Descriptor* message : TheContract().Messages()) {
    for (int i = 0; i < message->field_count(); ++i) {
      const FieldDescriptor* field = message->field(i);
      const FieldDescriptor::CppType type = field->cpp_type();
      EXPECT_NE(type, FieldDescriptor::CPPTYPE_UINT32) << field->full_name();
      EXPECT_NE(type, FieldDescriptor::CPPTYPE_UINT64) << field->full_name();
      const bool is_number = type == FieldDescriptor::CPPTYPE_INT32 || type == FieldDescriptor::CPPTYPE_INT64 ||
                             type == FieldDescriptor::CPPTYPE_DOUBLE || type == FieldDescriptor::CPPTYPE_FLOAT;
      if (!is_number) continue;
      const bool has_unit = std::any_of(units.begin(), units.end(),
                                        [&](const std::string& unit) { return field->name().ends_with(unit); });
      EXPECT_TRUE(has_unit) << field->full_name();
    }
  }
}

// All fields that can be reached from a message.
void CollectFields(const Descriptor* message, std::set<const Descriptor*>& seen,
                   std::vector<const FieldDescriptor*>& fields) {
  if (!seen.insert(message).second) return;
  for (int i = 0; i < message->field_count(); ++i) {
    fields.push_back(message->field(i));
    if (message->field(i)->message_type() != nullptr) CollectFields(message->field(i)->message_type(), seen, fields);
  }
}

// Words that would name a person's body or the person. "point" and "side" are a garment's too.
const std::vector<std::string> kBodyWords = {"body", "bodies",   "scan",   "girth", "stature", "bust",     "landmark",
                                             "limb", "mesh",     "person", "user",  "email",   "customer", "consumer",
                                             "neck", "shoulder", "crotch", "waist", "hip",     "weight",   "height_m"};

TEST(WireContract, TheShopNeverGetsBodyData) {
  int method_count = 0;
  for (const MethodDescriptor* method : TheContract().Methods()) {
    if (method->file()->package() != "fitroom.shop.v1") continue;
    ++method_count;
    std::set<const Descriptor*> seen;
    std::vector<const FieldDescriptor*> fields;
    CollectFields(method->input_type(), seen, fields);
    CollectFields(method->output_type(), seen, fields);
    for (const FieldDescriptor* field : fields) {
      for (const std::string& word : kBodyWords) {
        EXPECT_EQ(field->name().find(word), std::string::npos) << field->full_name();
      }
    }
    for (const Descriptor* message : seen) {
      EXPECT_FALSE(message->full_name().starts_with("fitroom.body.")) << message->full_name();
    }
  }
  EXPECT_EQ(method_count, 8);
  for (const FileDescriptor* file : TheContract().files()) {
    if (file->package() != "fitroom.shop.v1") continue;
    for (int i = 0; i < file->dependency_count(); ++i) {
      EXPECT_FALSE(file->dependency(i)->name().starts_with("fitroom/body/")) << file->name();
    }
  }
}

std::set<std::string> PromisedLines() {
  std::ifstream stream(FITROOM_WIRE_SNAPSHOT);
  std::set<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line[0] != '#') lines.insert(line);
  }
  return lines;
}

// Nothing that was promised is removed, renumbered, renamed or retyped. What is new may be appended to the snapshot:
//   wire_contract_test --print-lines
TEST(WireContract, KeepsEveryPromise) {
  const std::set<std::string> promised = PromisedLines();
  ASSERT_GT(promised.size(), 150u) << "the snapshot is missing: " << FITROOM_WIRE_SNAPSHOT;
  for (const std::string& line : testing::BrokenLines(promised, TheContract().Lines())) {
    ADD_FAILURE() << "a peer relies on: " << line;
  }
}

// The guard itself: each kind of break is seen, and an addition is none.
TEST(WireContract, SeesEachKindOfBreak) {
  FileDescriptorProto before;
  before.set_name("a.proto");
  before.set_package("a.v1");
  before.set_syntax("proto3");
  auto* field = before.add_message_type();
  field->set_name("M");
  auto* x = field->add_field();
  x->set_name("x_m");
  x->set_number(1);
  x->set_type(google::protobuf::FieldDescriptorProto::TYPE_DOUBLE);
  x->set_label(google::protobuf::FieldDescriptorProto::LABEL_OPTIONAL);
  const auto lines_of = [](const FileDescriptorProto& file) {
    google::protobuf::DescriptorPool pool;
    return testing::WireLines(*pool.BuildFile(file)).lines();
  };
  const std::set<std::string> promised = lines_of(before);
  ASSERT_EQ(promised.size(), 2u);
  const auto broken_by = [&](const std::function<void(google::protobuf::DescriptorProto&)>& change) {
    FileDescriptorProto after = before;
    change(*after.mutable_message_type(0));
    return testing::BrokenLines(promised, lines_of(after)).size();
  };
  EXPECT_EQ(broken_by([](auto& m) { m.mutable_field(0)->set_number(2); }), 1u);
  EXPECT_EQ(broken_by([](auto& m) { m.mutable_field(0)->set_name("y_m"); }), 1u);
  EXPECT_EQ(
      broken_by([](auto& m) { m.mutable_field(0)->set_type(google::protobuf::FieldDescriptorProto::TYPE_FLOAT); }), 1u);
  EXPECT_EQ(
      broken_by([](auto& m) { m.mutable_field(0)->set_label(google::protobuf::FieldDescriptorProto::LABEL_REPEATED); }),
      1u);
  EXPECT_EQ(broken_by([](auto& m) { m.clear_field(); }), 1u);
  EXPECT_EQ(broken_by([](auto& m) { m.set_name("N"); }), 2u);
  EXPECT_EQ(broken_by([&](auto& m) {
              auto* added = m.add_field();
              *added = *x;
              added->set_name("z_m");
              added->set_number(3);
            }),
            0u);
}

}  // namespace

// Prints the lines for the snapshot.
void PrintWireLines() {
  for (const std::string& line : TheContract().Lines()) std::printf("%s\n", line.c_str());
}

}  // namespace fitroom

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  if (argc > 1 && std::string(argv[1]) == "--print-lines") {
    fitroom::PrintWireLines();
    return 0;
  }
  return RUN_ALL_TESTS();
}
