// Pulling from real servers into a cache, and what the cache gives once they are gone.

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body_center/service/body_server.h"
#include "common/base/file.h"
#include "common/garment/garment_folder.h"
#include "common/scan_record/scan_record_json.h"
#include "fit_client/cache/cache.h"
#include "fit_client/remote/pull_body.h"
#include "fit_client/remote/pull_garment.h"
#include "fit_client/remote/pull_lock.h"
#include "fit_client/remote/resumed_file.h"
#include "shop_catalog/service/shop_server.h"
#include "tests/support/service/fake_garment.h"
#include "tests/support/service/fake_scan.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::fit_client {
namespace {

namespace fs = std::filesystem;
using testing::FakePhoto;
using testing::FakeScanFile;
using ::testing::HasSubstr;
using testing::StatementOf;

class PullTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ::setenv("XDG_CACHE_HOME", folder_.path().c_str(), 1);
    cache_ = folder_.path() / "fitroom";
    auto body =
        body_center::BodyServer::Start({.data_folder = folder_.path() / "bodies", .acceptor = testing::FakeAcceptor});
    auto shop =
        shop_catalog::ShopServer::Start({.data_folder = folder_.path() / "shop", .extractor = testing::FakeExtractor});
    ASSERT_TRUE(body.ok() && shop.ok());
    body_server_ = std::move(body).value();
    shop_server_ = std::move(shop).value();
    body_ = std::make_unique<remote::BodyClient>(body_server_->address());
    shop_ = std::make_unique<remote::ShopClient>(shop_server_->address());
  }
  void TearDown() override { ::unsetenv("XDG_CACHE_HOME"); }

  void StopServers() {
    body_server_.reset();
    shop_server_.reset();
  }
  ScanRecord Register(const std::string& body, const std::string& scan, uint32_t seed) {
    const std::string file = FakeScanFile(seed, 9000);
    const Result<ScanRecord> record = body_->Register(StatementOf(body, scan, file), file, {});
    EXPECT_TRUE(record.ok()) << record.status().ToString();
    return *record;
  }
  void Publish(const std::string& id, uint32_t seed, size_t size = 400000) {
    const std::string front = FakePhoto(seed, size);
    const std::string back = FakePhoto(seed + 1, size);
    const auto record = shop_->Publish(testing::GarmentStatementOf(id, front, back), {front, back}, {});
    EXPECT_TRUE(record.ok()) << record.status().ToString();
  }

  testing::TemporaryFolder folder_;
  fs::path cache_;
  std::unique_ptr<body_center::BodyServer> body_server_;
  std::unique_ptr<shop_catalog::ShopServer> shop_server_;
  std::unique_ptr<remote::BodyClient> body_;
  std::unique_ptr<remote::ShopClient> shop_;
};

TEST_F(PullTest, ABodyIsThereWithoutTheServer) {
  const ScanRecord record = Register("ann", "one", 1);
  const Result<ScanRecord> pulled = PullBody(*body_, cache_, "bodies/ann/scans/one", {});
  ASSERT_TRUE(pulled.ok()) << pulled.status().ToString();
  StopServers();
  const Result<Body> body = LoadCachedBody("ann/one");
  ASSERT_TRUE(body.ok()) << body.status().ToString();
  const auto truth = testing::FakeAcceptor(FakeScanFile(1, 9000), "one.ase", {}, {});
  ASSERT_EQ(body->mesh.vertices.size(), truth->body.mesh.vertices.size());
  EXPECT_EQ(body->mesh.triangles, truth->body.mesh.triangles);
  for (size_t i = 0; i < body->mesh.vertices.size(); ++i) {
    EXPECT_LT((body->mesh.vertices[i] - truth->body.mesh.vertices[i]).norm(), 1e-6);
  }
  for (size_t i = 0; i < body->landmarks.estimates.size(); ++i) {
    EXPECT_EQ(body->landmarks.estimates[i].position, truth->body.landmarks.estimates[i].position);
  }
  EXPECT_EQ(body->arm_left.joint, truth->body.arm_left.joint);
  EXPECT_EQ(body->measurements.waist.girth, truth->body.measurements.waist.girth);
  EXPECT_EQ(ScanRecordToJson(*FindCachedScan("ann")), ScanRecordToJson(record));
}

TEST_F(PullTest, AGarmentIsThereWithoutTheServer) {
  Publish("tee", 3);
  ASSERT_TRUE(PullGarment(*shop_, cache_, "garments/tee", {}).ok());
  StopServers();
  const Result<fs::path> folder = CachedGarmentFolder("tee");
  ASSERT_TRUE(folder.ok()) << folder.status().ToString();
  const Result<Garment> garment = ReadGarmentFolder(*folder);
  ASSERT_TRUE(garment.ok()) << garment.status().ToString();
  EXPECT_EQ(garment->id, "tee");
  EXPECT_TRUE(*ReadFile(*folder / garment->front.photo_file, 1 << 20) == FakePhoto(3, 400000));
  EXPECT_TRUE(*ReadFile(*folder / garment->back->photo_file, 1 << 20) == FakePhoto(4, 400000));
}

TEST_F(PullTest, ChartAndSideFoldedPhotographComeAlong) {
  const std::vector<std::string> photos = {FakePhoto(1, 2000), FakePhoto(2, 2000), FakePhoto(3, 300000)};
  const std::vector<std::string_view> views(photos.begin(), photos.end());
  const GarmentUploadStatement statement = testing::TrouserStatementOf("jeans", views);
  ASSERT_TRUE(shop_->Publish(statement, views, {}).ok());
  ASSERT_TRUE(PullGarment(*shop_, cache_, "jeans", {}).ok());
  StopServers();
  const Result<fs::path> folder = CachedGarmentFolder("jeans");
  ASSERT_TRUE(folder.ok()) << folder.status().ToString();
  const Result<Garment> garment = ReadGarmentFolder(*folder);
  ASSERT_TRUE(garment.ok()) << garment.status().ToString();
  EXPECT_EQ(garment->chart, statement.stated.chart);
  EXPECT_EQ(garment->fabric, "denim");
  ASSERT_TRUE(garment->side_folded.has_value());
  EXPECT_TRUE(*ReadFile(*folder / garment->side_folded->photo_file, 1 << 20) == photos[2]);
}

TEST_F(PullTest, SaysHowToPullWhatIsMissing) {
  EXPECT_EQ(FindCachedScan("ann").status().reason(), "BODY_NOT_PULLED");
  EXPECT_THAT(LoadCachedBody("ann/one").status().message(), HasSubstr("fit_client pull bodies/ann/scans/one"));
  EXPECT_EQ(CachedGarmentFolder("tee").status().reason(), "GARMENT_NOT_PULLED");
  EXPECT_EQ(PullBody(*body_, cache_, "ann", {}).status().reason(), "BODY_NOT_FOUND");
  EXPECT_EQ(PullBody(*body_, cache_, "ann/one", {}).status().reason(), "SCAN_NOT_FOUND");
  EXPECT_EQ(PullGarment(*shop_, cache_, "tee", {}).status().reason(), "GARMENT_NOT_FOUND");
  for (const char* bad : {"", "../x", "bodies/", "ann/../bea", "ann/one/two", "Ann", "bodies/ann/scans/"}) {
    EXPECT_EQ(FindCachedScan(bad).status().reason(), "SCAN_NAME_INVALID") << bad;
  }
  for (const char* bad : {"", "../x", "garments/", "a/b", ".", "Tee"}) {
    EXPECT_EQ(CachedGarmentFolder(bad).status().reason(), "GARMENT_NAME_INVALID") << bad;
  }
}

TEST_F(PullTest, ADamagedCacheIsNoticedAndMended) {
  Register("ann", "one", 1);
  ASSERT_TRUE(PullBody(*body_, cache_, "ann", {}).ok());
  const fs::path mesh = cache_ / "bodies/ann/one/packed_mesh.bin";
  {
    std::fstream file(mesh, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(40);
    file.put('?');
  }
  EXPECT_EQ(LoadCachedBody("ann").status().reason(), "CACHE_DAMAGED");
  ASSERT_TRUE(PullBody(*body_, cache_, "ann", {}).ok());
  EXPECT_TRUE(LoadCachedBody("ann").ok());
}

TEST_F(PullTest, GoesOnWhereAnInterruptedPullStopped) {
  const std::string whole = FakeScanFile(1, 700000);
  const fs::path path = folder_.path() / "part";
  const auto stream_from = [&](int64_t stop, int64_t& first_offset) -> ByteStream {
    return [&whole, stop, &first_offset](int64_t offset, const auto& sink) -> Status {
      first_offset = offset;
      const std::string_view rest = std::string_view(whole).substr(static_cast<size_t>(offset));
      FR_RETURN_IF_ERROR(sink(rest.substr(0, static_cast<size_t>(stop - offset))));
      return stop < std::ssize(whole) ? Unavailable("STREAM_CUT", "cut") : Status();
    };
  };
  int64_t offset = -1;
  EXPECT_EQ(DownloadResumed(path, 700000, Blake2b(whole), stream_from(300000, offset), {}).reason(), "STREAM_CUT");
  EXPECT_EQ(offset, 0);
  EXPECT_TRUE(DownloadResumed(path, 700000, Blake2b(whole), stream_from(700000, offset), {}).ok());
  EXPECT_EQ(offset, 300000);
  EXPECT_TRUE(*ReadFile(path, 1 << 20) == whole);
  // A whole file is not asked for again; a wrong one is removed, so that the next try starts afresh.
  offset = -1;
  EXPECT_TRUE(DownloadResumed(path, 700000, Blake2b(whole), stream_from(700000, offset), {}).ok());
  EXPECT_EQ(offset, -1);
  EXPECT_EQ(DownloadResumed(path, 700000, Blake2b("other"), stream_from(700000, offset), {}).reason(),
            "DOWNLOAD_HASH_MISMATCH");
  EXPECT_FALSE(fs::exists(path));
}

// Both write one partial folder: one waits for the other and finds the item cached.
TEST_F(PullTest, PullsOfOneItemDoNotMeet) {
  Publish("tee", 3, 3000000);
  Register("ann", "one", 1);
  std::vector<std::thread> threads;
  std::array<Status, 6> outcomes;
  for (size_t i = 0; i < outcomes.size(); ++i) {
    threads.emplace_back([&, i] {
      outcomes[i] =
          i % 2 == 0 ? PullGarment(*shop_, cache_, "tee", {}).status() : PullBody(*body_, cache_, "ann", {}).status();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Status& outcome : outcomes) EXPECT_TRUE(outcome.ok()) << outcome.ToString();
  EXPECT_TRUE(ReadGarmentFolder(*CachedGarmentFolder("tee")).ok());
  EXPECT_TRUE(LoadCachedBody("ann").ok());
  EXPECT_EQ(ListCachedScans()->size(), 1u);
}

TEST_F(PullTest, SaysThatAnotherPullIsUnderWay) {
  const fs::path path = folder_.path() / ".lock-tee";
  {
    const Result<PullLock> first = PullLock::Take(path, std::chrono::milliseconds(0));
    ASSERT_TRUE(first.ok()) << first.status().ToString();
    EXPECT_EQ(PullLock::Take(path, std::chrono::milliseconds(0)).status().reason(), "PULL_UNDER_WAY");
  }
  EXPECT_TRUE(PullLock::Take(path, std::chrono::milliseconds(0)).ok());
}

// A reader that looks all the time finds the old folder or the new one, never none: so does one that comes after a
// process that was killed in between.
TEST_F(PullTest, AReplacedFolderIsNeverMissing) {
  const fs::path folder = folder_.path() / "item";
  const fs::path partial = folder_.path() / ".partial-item";
  const auto make = [](const fs::path& path, int version) {
    fs::create_directories(path);
    ASSERT_TRUE(WriteFileAtomically(path / "mark", std::to_string(version)).ok());
  };
  make(folder, 0);
  make(partial, 1);
  if (::renameat2(AT_FDCWD, partial.c_str(), AT_FDCWD, folder.c_str(), RENAME_EXCHANGE) != 0) {
    GTEST_SKIP() << "this file system cannot exchange two names";
  }
  std::atomic<bool> ends = false;
  std::atomic<int64_t> missing_count = 0;
  std::thread reader([&] {
    while (!ends) missing_count += ::access((folder / "mark").c_str(), F_OK) != 0 ? 1 : 0;
  });
  for (int version = 1; version <= 300; ++version) {
    make(partial, version);
    ASSERT_TRUE(ReplaceFolder(partial, folder).ok());
    ASSERT_EQ(*ReadFile(folder / "mark", 10), std::to_string(version));
    ASSERT_FALSE(fs::exists(partial));
  }
  ends = true;
  reader.join();
  EXPECT_EQ(missing_count, 0);
  fs::remove_all(folder);
  make(partial, 7);
  EXPECT_TRUE(ReplaceFolder(partial, folder).ok()) << "nothing was there before";
  EXPECT_EQ(*ReadFile(folder / "mark", 10), "7");
  EXPECT_FALSE(ReplaceFolder(partial, folder).ok()) << "nothing to put there";
  EXPECT_EQ(*ReadFile(folder / "mark", 10), "7");
}

TEST_F(PullTest, RefusesAServerThatSendsMoreThanItAnnounced) {
  const fs::path path = folder_.path() / "part";
  const ByteStream endless = [](int64_t, const auto& sink) -> Status {
    for (;;) FR_RETURN_IF_ERROR(sink(std::string(1000, 'x')));
  };
  EXPECT_EQ(DownloadResumed(path, 5000, Blake2b(""), endless, {}).reason(), "DOWNLOAD_TOO_LONG");
  EXPECT_LE(fs::file_size(path), 5000u);
}

TEST_F(PullTest, TheCacheIsItsOwnersAlone) {
  Register("ann", "one", 1);
  ASSERT_TRUE(PullBody(*body_, cache_, "ann", {}).ok());
  const fs::perms others = fs::perms::group_all | fs::perms::others_all;
  EXPECT_EQ(fs::status(cache_).permissions() & others, fs::perms::none);
  EXPECT_EQ(fs::status(cache_ / "bodies/ann/one").permissions() & others, fs::perms::none);
}

TEST(CacheFolder, FollowsTheXdgSpecification) {
  ::setenv("XDG_CACHE_HOME", "/somewhere", 1);
  EXPECT_EQ(*CacheFolder(), "/somewhere/fitroom");
  ::setenv("XDG_CACHE_HOME", "relative", 1);
  ::setenv("HOME", "/home/ann", 1);
  EXPECT_EQ(*CacheFolder(), "/home/ann/.cache/fitroom");
  ::unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(*CacheFolder(), "/home/ann/.cache/fitroom");
  ::unsetenv("HOME");
  EXPECT_EQ(CacheFolder().status().reason(), "NO_HOME");
}

}  // namespace
}  // namespace fitroom::fit_client
