#include "body_center/service/registration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/service/fake_scan.h"

namespace fitroom::body_center {
namespace {

using ::testing::_;
using ::testing::Return;

class MockStore : public BodyStore {
 public:
  MOCK_METHOD(Result<ScanUpload>, StartUpload, (const ScanUploadStatement&), (override));
  MOCK_METHOD(Result<ScanUpload>, FindUpload, (std::string_view), (override));
  MOCK_METHOD(Result<int64_t>, AppendToUpload, (std::string_view, int64_t, std::string_view), (override));
  MOCK_METHOD(Result<std::string>, ReadUpload, (std::string_view), (override));
  MOCK_METHOD(Status, DropUpload, (std::string_view), (override));
  MOCK_METHOD(Result<int64_t>, DropUploadsBefore, (int64_t), (override));
  MOCK_METHOD(Status, PublishScan, (std::string_view, const ScanRecord&, std::string_view), (override));
  MOCK_METHOD(Result<ScanRecord>, FindScan, (const ScanName&), (override));
  MOCK_METHOD(Result<std::vector<ScanRecord>>, ListScans, (std::string_view, const ScanName&, int), (override));
  MOCK_METHOD(Result<std::string>, ReadContent, (const ScanName&, ScanContent, int64_t), (override));
};

ScanUpload CompleteUpload(const std::string& file) {
  const ScanUploadStatement statement = testing::StatementOf("ann", "one", file);
  return {.id = "u1", .statement = statement, .committed_size = statement.size};
}

TEST(FinishRegistration, KeepsTheUploadWhenTheStoreCannotReadIt) {
  const std::string file = testing::FakeScanFile(1, 3000);
  for (const Status& error : {DataLoss("DATABASE_CORRUPT", "x"), ResourceExhausted("DISK_FULL", "x")}) {
    MockStore store;
    EXPECT_CALL(store, FindUpload(_)).WillOnce(Return(Result<ScanUpload>(CompleteUpload(file))));
    EXPECT_CALL(store, ReadUpload(_)).WillOnce(Return(Result<std::string>(error)));
    EXPECT_CALL(store, DropUpload(_)).Times(0);
    EXPECT_EQ(FinishRegistration(store, testing::FakeAcceptor, "u1", {}).status().reason(), error.reason());
  }
}

TEST(FinishRegistration, DropsTheUploadWhenTheScanIsAtFault) {
  const std::string file(3000, 'z');
  MockStore store;
  EXPECT_CALL(store, FindUpload(_)).WillOnce(Return(Result<ScanUpload>(CompleteUpload(file))));
  EXPECT_CALL(store, ReadUpload(_)).WillOnce(Return(Result<std::string>(file)));
  EXPECT_CALL(store, DropUpload(_)).WillOnce(Return(Status()));
  EXPECT_EQ(FinishRegistration(store, testing::FakeAcceptor, "u1", {}).status().reason(), "NOT_A_SCAN");
}

}  // namespace
}  // namespace fitroom::body_center
