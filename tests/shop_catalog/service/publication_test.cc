#include "shop_catalog/service/publication.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/service/fake_garment.h"

namespace fitroom::shop_catalog {
namespace {

using ::testing::_;
using ::testing::Return;

class MockStore : public GarmentStore {
 public:
  MOCK_METHOD(Result<GarmentUpload>, StartUpload, (const GarmentUploadStatement&), (override));
  MOCK_METHOD(Result<GarmentUpload>, FindUpload, (std::string_view), (override));
  MOCK_METHOD(Result<int64_t>, AppendToUpload, (std::string_view, GarmentSide, int64_t, std::string_view), (override));
  MOCK_METHOD(Result<std::string>, ReadUpload, (std::string_view, GarmentSide), (override));
  MOCK_METHOD(Status, DropUpload, (std::string_view), (override));
  MOCK_METHOD(Result<int64_t>, DropUploadsBefore, (int64_t), (override));
  MOCK_METHOD(Status, PublishGarment, (std::string_view, const GarmentRecord&, std::span<const GarmentFile>),
              (override));
  MOCK_METHOD(Result<GarmentRecord>, FindGarment, (std::string_view), (override));
  MOCK_METHOD(Result<std::vector<GarmentRecord>>, ListGarments, (std::string_view, int), (override));
  MOCK_METHOD(Result<std::string>, ReadImage, (std::string_view, std::string_view, int64_t), (override));
};

GarmentUpload CompleteUpload(const std::string& front) {
  const GarmentUploadStatement statement = testing::GarmentStatementOf("tee", front, "");
  return {.id = "u1", .statement = statement, .committed_sizes = {std::ssize(front)}};
}

TEST(FinishPublication, KeepsTheUploadWhenTheStoreCannotReadIt) {
  const std::string front = testing::FakePhoto(1, 3000);
  for (const Status& error : {DataLoss("DATABASE_CORRUPT", "x"), ResourceExhausted("DISK_FULL", "x")}) {
    MockStore store;
    EXPECT_CALL(store, FindUpload(_)).WillOnce(Return(Result<GarmentUpload>(CompleteUpload(front))));
    EXPECT_CALL(store, ReadUpload(_, _)).WillOnce(Return(Result<std::string>(error)));
    EXPECT_CALL(store, DropUpload(_)).Times(0);
    EXPECT_EQ(FinishPublication(store, testing::FakeExtractor, "u1", {}).status().reason(), error.reason());
  }
}

TEST(FinishPublication, DropsTheUploadWhenThePhotographIsAtFault) {
  const std::string front(3000, 'x');
  MockStore store;
  EXPECT_CALL(store, FindUpload(_)).WillOnce(Return(Result<GarmentUpload>(CompleteUpload(front))));
  EXPECT_CALL(store, ReadUpload(_, _)).WillOnce(Return(Result<std::string>(front)));
  EXPECT_CALL(store, DropUpload(_)).WillOnce(Return(Status()));
  EXPECT_EQ(FinishPublication(store, testing::FakeExtractor, "u1", {}).status().reason(), "NO_GARMENT_FOUND");
}

}  // namespace
}  // namespace fitroom::shop_catalog
