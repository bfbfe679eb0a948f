// One suite on both sides of the wire: what the store promises must also hold for a client that speaks to a server.

#include "tests/body_center/service/scan_keeper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/scan_record/scan_record_json.h"
#include "tests/support/service/fake_scan.h"

namespace fitroom::testing {
namespace {

using ::testing::HasSubstr;

constexpr size_t kMebibyte = size_t{1} << 20;

class ScanKeeperTest : public ::testing::TestWithParam<std::unique_ptr<ScanKeeper> (*)()> {
 protected:
  Result<ScanRecord> Register(const std::string& body, const std::string& scan, const std::string& file) {
    FR_ASSIGN_OR_RETURN(const ScanUpload upload, keeper_->Start(StatementOf(body, scan, file)));
    FR_RETURN_IF_ERROR(keeper_->Append(upload, 0, file).status());
    return keeper_->Finish(upload);
  }
  bool IsVisible(const ScanName& name) {
    const Result<std::vector<ScanRecord>> all = keeper_->List("", 100);
    EXPECT_TRUE(all.ok()) << all.status().ToString();
    const bool is_listed =
        all.ok() && std::any_of(all->begin(), all->end(), [&](const ScanRecord& scan) { return scan.name == name; });
    EXPECT_EQ(keeper_->Get(name).ok(), is_listed);
    return is_listed;
  }

  std::unique_ptr<ScanKeeper> keeper_ = GetParam()();
};

TEST_P(ScanKeeperTest, GivesBackTheBytesThatItGot) {
  for (const size_t size : {size_t{11}, size_t{960} << 10, (size_t{960} << 10) + 1, 3 * kMebibyte + 12345}) {
    const std::string file = FakeScanFile(static_cast<uint32_t>(size), size);
    const std::string scan = "s" + std::to_string(size);
    const Result<ScanRecord> registered = Register("ann", scan, file);
    ASSERT_TRUE(registered.ok()) << registered.status().ToString();
    const Result<std::string> original = keeper_->Read({"ann", scan}, ScanContent::kOriginal, 0);
    ASSERT_TRUE(original.ok()) << original.status().ToString();
    EXPECT_TRUE(*original == file);
    const Result<std::string> mesh = keeper_->Read({"ann", scan}, ScanContent::kPackedMesh, 0);
    ASSERT_TRUE(mesh.ok());
    EXPECT_EQ(Blake2b(*mesh), registered->packed_mesh_hash);
  }
}

TEST_P(ScanKeeperTest, TellsExactlyWhatTheAcceptorFound) {
  const std::string file = FakeScanFile(7, 5000);
  ScanUploadStatement statement = StatementOf("ann", "one", file);
  statement.up = "-x";
  const Result<ScanUpload> upload = keeper_->Start(statement);
  ASSERT_TRUE(upload.ok());
  ASSERT_TRUE(keeper_->Append(*upload, 0, file).ok());
  const Result<ScanRecord> finished = keeper_->Finish(*upload);
  ASSERT_TRUE(finished.ok()) << finished.status().ToString();
  const Result<body_center::AcceptedScan> truth =
      FakeAcceptor(file, "one.ase", {.up = SignedAxis{0, -1}, .facing = {}, .unit = {}}, {});
  ASSERT_TRUE(truth.ok());
  EXPECT_EQ(finished->frame.up, "-x");
  EXPECT_EQ(finished->frame.facing, truth->frame.facing);
  EXPECT_EQ(finished->frame.unit, truth->frame.unit);
  EXPECT_EQ(finished->frame.reasons, truth->frame.reasons);
  EXPECT_EQ(finished->frame.yaw_deg, truth->frame.yaw_deg);
  EXPECT_EQ(finished->vertex_count, std::ssize(truth->body.mesh.vertices));
  EXPECT_EQ(finished->measurements.stature, truth->body.measurements.stature);
  EXPECT_EQ(finished->measurements.hip.height, truth->body.measurements.hip.height);
  EXPECT_EQ(finished->leg_right.joint, truth->body.leg_right.joint);
  for (size_t i = 0; i < truth->body.landmarks.estimates.size(); ++i) {
    EXPECT_EQ(finished->landmarks.estimates[i].position, truth->body.landmarks.estimates[i].position);
    EXPECT_EQ(finished->landmarks.estimates[i].confidence, truth->body.landmarks.estimates[i].confidence);
  }
  keeper_->Reopen();
  const Result<ScanRecord> kept = keeper_->Get({"ann", "one"});
  ASSERT_TRUE(kept.ok()) << kept.status().ToString();
  EXPECT_EQ(ScanRecordToJson(*kept), ScanRecordToJson(*finished));
}

TEST_P(ScanKeeperTest, ShowsNothingBeforeItIsFinished) {
  const std::string file = FakeScanFile(1, 2 * kMebibyte);
  const Result<ScanUpload> upload = keeper_->Start(StatementOf("ann", "one", file));
  ASSERT_TRUE(upload.ok());
  EXPECT_FALSE(IsVisible({"ann", "one"}));
  ASSERT_TRUE(keeper_->Append(*upload, 0, file).ok());
  EXPECT_FALSE(IsVisible({"ann", "one"}));
  keeper_->Reopen();
  EXPECT_FALSE(IsVisible({"ann", "one"}));
  ASSERT_TRUE(keeper_->Finish(*upload).ok());
  EXPECT_TRUE(IsVisible({"ann", "one"}));
}

TEST_P(ScanKeeperTest, GoesOnWithAnUploadAfterARestart) {
  const std::string file = FakeScanFile(2, 4 * kMebibyte + 777);
  const ScanUploadStatement statement = StatementOf("ann", "one", file);
  const Result<ScanUpload> first = keeper_->Start(statement);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(first->committed_size, 0);
  ASSERT_TRUE(keeper_->Append(*first, 0, file.substr(0, 1234567)).ok());
  keeper_->Reopen();
  const Result<ScanUpload> again = keeper_->Start(statement);
  ASSERT_TRUE(again.ok()) << again.status().ToString();
  EXPECT_EQ(again->id, first->id);
  EXPECT_EQ(again->committed_size, 1234567);
  const Result<int64_t> end = keeper_->Append(*again, again->committed_size, file.substr(1234567));
  ASSERT_TRUE(end.ok()) << end.status().ToString();
  EXPECT_EQ(*end, std::ssize(file));
  ASSERT_TRUE(keeper_->Finish(*again).ok());
  const Result<std::string> original = keeper_->Read({"ann", "one"}, ScanContent::kOriginal, 0);
  ASSERT_TRUE(original.ok());
  EXPECT_TRUE(*original == file);
}

TEST_P(ScanKeeperTest, RefusesAnotherFileUnderAnUploadsName) {
  ASSERT_TRUE(keeper_->Start(StatementOf("ann", "one", FakeScanFile(1, 5000))).ok());
  EXPECT_EQ(keeper_->Start(StatementOf("ann", "one", FakeScanFile(2, 5000))).status().reason(), "UPLOAD_DIFFERS");
}

TEST_P(ScanKeeperTest, RefusesAPublishedName) {
  const std::string file = FakeScanFile(1, 100);
  ASSERT_TRUE(Register("ann", "one", file).ok());
  const Status again = keeper_->Start(StatementOf("ann", "one", file)).status();
  EXPECT_EQ(again.code(), StatusCode::kAlreadyExists);
  EXPECT_EQ(again.reason(), "SCAN_EXISTS");
  EXPECT_THAT(again.message(), HasSubstr("bodies/ann/scans/one"));
}

TEST_P(ScanKeeperTest, RefusesBytesThatDoNotStartAtTheEnd) {
  const std::string file = FakeScanFile(1, 3000);
  const Result<ScanUpload> upload = keeper_->Start(StatementOf("ann", "one", file));
  ASSERT_TRUE(upload.ok());
  ASSERT_TRUE(keeper_->Append(*upload, 0, file.substr(0, 1000)).ok());
  for (const int64_t offset : {int64_t{0}, int64_t{999}, int64_t{1001}, int64_t{-1}, int64_t{1} << 40}) {
    EXPECT_EQ(keeper_->Append(*upload, offset, file.substr(0, 10)).status().reason(), "UPLOAD_OFFSET_CONFLICT")
        << offset;
  }
  EXPECT_EQ(keeper_->Find(*upload)->committed_size, 1000);
}

TEST_P(ScanKeeperTest, RefusesMoreBytesThanWereStated) {
  const std::string file = FakeScanFile(1, 3000);
  const Result<ScanUpload> upload = keeper_->Start(StatementOf("ann", "one", file));
  ASSERT_TRUE(upload.ok());
  EXPECT_EQ(keeper_->Append(*upload, 0, file + "x").status().reason(), "UPLOAD_TOO_LONG");
  EXPECT_EQ(keeper_->Find(*upload)->committed_size, 0);
}

TEST_P(ScanKeeperTest, KeepsAnIncompleteUpload) {
  const std::string file = FakeScanFile(1, 3000);
  const Result<ScanUpload> upload = keeper_->Start(StatementOf("ann", "one", file));
  ASSERT_TRUE(keeper_->Append(*upload, 0, file.substr(0, 2999)).ok());
  EXPECT_EQ(keeper_->Finish(*upload).status().reason(), "UPLOAD_INCOMPLETE");
  ASSERT_TRUE(keeper_->Append(*upload, 2999, file.substr(2999)).ok());
  EXPECT_TRUE(keeper_->Finish(*upload).ok());
}

TEST_P(ScanKeeperTest, DropsAnUploadWhoseBytesAreNotTheStatedOnes) {
  std::string file = FakeScanFile(1, 3000);
  const Result<ScanUpload> upload = keeper_->Start(StatementOf("ann", "one", file));
  ASSERT_TRUE(upload.ok());
  file[1500] = static_cast<char>(file[1500] ^ 1);
  ASSERT_TRUE(keeper_->Append(*upload, 0, file).ok());
  const Status status = keeper_->Finish(*upload).status();
  EXPECT_EQ(status.code(), StatusCode::kDataLoss);
  EXPECT_EQ(status.reason(), "UPLOAD_HASH_MISMATCH");
  EXPECT_FALSE(IsVisible({"ann", "one"}));
  EXPECT_EQ(keeper_->Find(*upload).status().reason(), "UPLOAD_NOT_FOUND");
}

TEST_P(ScanKeeperTest, DropsWhatIsNoScanAndFreesItsName) {
  const std::string file(4000, 'z');
  const Status status = Register("ann", "one", file).status();
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(status.reason(), "NOT_A_SCAN");
  EXPECT_EQ(status.message(), "one.ase:1: does not begin like a scan");
  EXPECT_FALSE(IsVisible({"ann", "one"}));
  EXPECT_TRUE(Register("ann", "one", FakeScanFile(3, 4000)).ok());
}

TEST_P(ScanKeeperTest, ForgetsADroppedUpload) {
  const std::string file = FakeScanFile(1, 3000);
  const Result<ScanUpload> upload = keeper_->Start(StatementOf("ann", "one", file));
  ASSERT_TRUE(keeper_->Append(*upload, 0, file).ok());
  EXPECT_TRUE(keeper_->Drop(*upload).ok());
  EXPECT_TRUE(keeper_->Drop(*upload).ok());
  EXPECT_EQ(keeper_->Find(*upload).status().reason(), "UPLOAD_NOT_FOUND");
  EXPECT_EQ(keeper_->Append(*upload, 0, file).status().reason(), "UPLOAD_NOT_FOUND");
  EXPECT_EQ(keeper_->Finish(*upload).status().reason(), "UPLOAD_NOT_FOUND");
}

TEST_P(ScanKeeperTest, ListsInOrderWhateverThePage) {
  const std::vector<ScanName> names = {{"ann", "a"}, {"ann", "b-2"}, {"ann", "b-3"}, {"bea", "a"}, {"bea-x", "0"}};
  uint32_t seed = 0;
  for (const size_t i : {3u, 0u, 4u, 2u, 1u}) {
    ASSERT_TRUE(Register(names[i].body, names[i].scan, FakeScanFile(++seed, 500)).ok());
  }
  for (const int page_size : {1, 2, 5, 100}) {
    const Result<std::vector<ScanRecord>> all = keeper_->List("", page_size);
    ASSERT_TRUE(all.ok()) << all.status().ToString();
    std::vector<ScanName> listed;
    for (const ScanRecord& scan : *all) listed.push_back(scan.name);
    EXPECT_EQ(listed, names);
    EXPECT_EQ(keeper_->List("bea", page_size)->size(), 1u);
    EXPECT_EQ(keeper_->List("ann", page_size)->size(), 3u);
    EXPECT_EQ(keeper_->List("nobody", page_size)->size(), 0u);
  }
}

TEST_P(ScanKeeperTest, DownloadsFromAnyOffset) {
  const std::string file = FakeScanFile(9, 2 * kMebibyte + 3);
  ASSERT_TRUE(Register("ann", "one", file).ok());
  const int64_t size = std::ssize(file);
  for (const int64_t offset : {int64_t{1}, int64_t{262144}, int64_t{983039}, int64_t{983040}, size - 1, size}) {
    const Result<std::string> rest = keeper_->Read({"ann", "one"}, ScanContent::kOriginal, offset);
    ASSERT_TRUE(rest.ok()) << rest.status().ToString();
    EXPECT_TRUE(*rest == file.substr(static_cast<size_t>(offset))) << offset;
  }
  for (const int64_t offset : {size + 1, int64_t{-1}, int64_t{1} << 60}) {
    EXPECT_EQ(keeper_->Read({"ann", "one"}, ScanContent::kOriginal, offset).status().reason(), "OFFSET_PAST_END")
        << offset;
  }
  EXPECT_EQ(keeper_->Read({"ann", "two"}, ScanContent::kOriginal, 0).status().reason(), "SCAN_NOT_FOUND");
}

INSTANTIATE_TEST_SUITE_P(Store, ScanKeeperTest, ::testing::Values(&MakeStoreKeeper));
INSTANTIATE_TEST_SUITE_P(Wire, ScanKeeperTest, ::testing::Values(&MakeWireKeeper));

}  // namespace
}  // namespace fitroom::testing
