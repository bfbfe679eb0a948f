// What the catalog holds after the power has failed, and after the disk has failed: all that was acknowledged, and of
// the rest all or nothing.

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/sqlite/database.h"
#include "shop_catalog/store/sqlite_garment_store.h"
#include "tests/support/service/fake_garment.h"
#include "tests/support/service/faulty_disk.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::testing {
namespace {

namespace fs = std::filesystem;
using shop_catalog::GarmentStore;
using Store = std::unique_ptr<GarmentStore>;

#ifdef FITROOM_LONG_DISK_TEST
constexpr int kImagesPerEvent = 2;
constexpr int64_t kEventStride = 1;
constexpr std::array<int64_t, 3> kCallStride = {2, 3, 1};  // Of reads, writes and flushes.
#else
constexpr int kImagesPerEvent = 1;
constexpr int64_t kEventStride = 5;
constexpr std::array<int64_t, 3> kCallStride = {9, 23, 2};
#endif

constexpr size_t kPhotoSize = 90000;  // (unit: byte)
constexpr int64_t kPart = 40000;      // Of a photograph, in one call (unit: byte).

// The photograph of a garment, by the garment's id.
std::string PhotoOf(const std::string& id) { return FakePhoto(static_cast<uint32_t>(id[0]), kPhotoSize); }

// What a store holds, as far as these tests go: sizes of uploads by garment, and the garments that are published.
struct Contents {
  std::map<std::string, int64_t> uploads;  // Committed sizes (unit: byte).
  std::vector<std::string> garments;

  friend bool operator==(const Contents&, const Contents&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Contents& contents) {
    for (const std::string& garment : contents.garments) out << "garment " << garment << "; ";
    for (const auto& [garment, size] : contents.uploads) out << "upload " << garment << " of " << size << " bytes; ";
    return out;
  }
};

// One call of a store and what it must have made of the contents.
struct Step {
  std::string name;
  std::function<Status(Store& store)> act;
  Contents after;
};

// The steps of a day: uploads that are published, dropped and left, a restart, and an upload that goes on after it.
class Day {
 public:
  explicit Day(const fs::path& folder) : folder_(folder) {
    Open();
    Start("a");
    Append("a");
    Append("a");
    Append("a");
    Publish("a");
    Start("b");
    Append("b");
    Drop("b");
    Start("c");
    Append("c");
    Open();
    Append("c");
    Append("c");
    Publish("c");
  }
  const std::vector<Step>& steps() const { return steps_; }

  // Reads what a store holds and checks every byte of it against what was sent.
  static Contents Read(GarmentStore& store, const std::map<std::string, std::string>& upload_ids) {
    Contents contents;
    const Result<std::vector<GarmentRecord>> records = store.ListGarments("", 100);
    EXPECT_TRUE(records.ok()) << records.status().ToString();
    if (!records.ok()) return contents;
    for (const GarmentRecord& record : *records) {
      contents.garments.push_back(record.garment.id);
      for (const GarmentImageRecord& image : record.images) {
        const Result<std::string> bytes = store.ReadImage(record.garment.id, ImageId(image.kind, image.side), 0);
        EXPECT_TRUE(bytes.ok()) << bytes.status().ToString();
        EXPECT_TRUE(bytes.ok() && Blake2b(*bytes) == image.hash) << record.garment.id << " " << image.file_name;
      }
    }
    for (const auto& [garment, id] : upload_ids) {
      const Result<GarmentUpload> upload = store.FindUpload(id);
      if (upload.status().code() == StatusCode::kNotFound) continue;
      EXPECT_TRUE(upload.ok()) << upload.status().ToString();
      if (!upload.ok()) continue;
      const int64_t size = upload->committed_sizes[0];
      contents.uploads[garment] = size;
      const Result<std::string> bytes = store.ReadUpload(id, GarmentSide::kFront);
      EXPECT_TRUE(bytes.ok() && *bytes == PhotoOf(garment).substr(0, static_cast<size_t>(size)));
    }
    return contents;
  }
  const std::map<std::string, std::string>& upload_ids() const { return upload_ids_; }

 private:
  void Add(const std::string& name, std::function<Status(Store&)> act) {
    steps_.push_back({name, std::move(act), contents_});
  }
  void Open() {
    Add("open", [this](Store& store) -> Status {
      store.reset();
      FR_ASSIGN_OR_RETURN(store, shop_catalog::OpenSqliteGarmentStore(folder_));
      return Status();
    });
  }
  void Start(const std::string& id) {
    contents_.uploads[id] = 0;
    Add("start " + id, [this, id](Store& store) -> Status {
      FR_ASSIGN_OR_RETURN(const GarmentUpload upload, store->StartUpload(GarmentStatementOf(id, PhotoOf(id), "")));
      upload_ids_[id] = upload.id;
      return Status();
    });
  }
  void Append(const std::string& id) {
    const int64_t offset = contents_.uploads[id];
    const int64_t end = std::min(offset + kPart, static_cast<int64_t>(kPhotoSize));
    contents_.uploads[id] = end;
    Add("append " + id, [this, id, offset, end](Store& store) {
      const std::string part = PhotoOf(id).substr(static_cast<size_t>(offset), static_cast<size_t>(end - offset));
      return store->AppendToUpload(upload_ids_[id], GarmentSide::kFront, offset, part).status();
    });
  }
  void Drop(const std::string& id) {
    contents_.uploads.erase(id);
    Add("drop " + id, [this, id](Store& store) { return store->DropUpload(upload_ids_[id]); });
  }
  void Publish(const std::string& id) {
    contents_.uploads.erase(id);
    contents_.garments.push_back(id);
    Add("publish " + id, [this, id](Store& store) {
      return shop_catalog::FinishPublication(*store, FakeExtractor, upload_ids_[id], {}).status();
    });
  }

  const fs::path folder_;
  Contents contents_;
  std::map<std::string, std::string> upload_ids_;
  std::vector<Step> steps_;
};

class DiskFaults : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { FaultyDisk::Install(); }

  static void ExpectSound(const fs::path& folder) {
    Result<sqlite::Database> database =
        sqlite::Database::Open(folder / "shop_catalog.sqlite", sqlite::Access::kReadWrite);
    ASSERT_TRUE(database.ok()) << database.status().ToString();
    Result<sqlite::Statement> check = database->Prepare("PRAGMA integrity_check");
    ASSERT_TRUE(check.ok() && *check->Step());
    EXPECT_EQ(check->Text(0), "ok");
    Result<sqlite::Statement> keys = database->Prepare("PRAGMA foreign_key_check");
    ASSERT_TRUE(keys.ok());
    EXPECT_FALSE(*keys->Step()) << "a row names another that is gone";
  }

  TemporaryFolder folder_;
};

TEST_F(DiskFaults, AfterAPowerCutAllThatWasAcknowledgedIsThere) {
  Day day(folder_.path() / "day");
  std::vector<int64_t> ends;  // How many events each step had seen when it was acknowledged.
  {
    Store store;
    FaultyDisk::StartAccount();
    for (const Step& step : day.steps()) {
      const Status status = step.act(store);
      ASSERT_TRUE(status.ok()) << step.name << ": " << status.ToString();
      ends.push_back(FaultyDisk::event_count());
      ASSERT_EQ(Day::Read(*store, day.upload_ids()), step.after) << step.name;
    }
    FaultyDisk::StopAccount();
  }
  const int64_t event_count = FaultyDisk::event_count();
  ASSERT_GT(event_count, 100);
  constexpr unsigned kSeed = 20240611;
  std::mt19937 random(kSeed);
  int in_flight_kept = 0;
  std::set<int64_t> cuts;
  for (int64_t event = 0; event <= event_count; event += kEventStride) cuts.insert(event);
  for (const int64_t end : ends) cuts.insert(end - 1);  // All is written, the last flush has not come.
  for (const int64_t event : cuts) {
    // Steps that were acknowledged before the cut.
    const size_t done = static_cast<size_t>(std::upper_bound(ends.begin(), ends.end(), event) - ends.begin());
    for (int image = 0; image < kImagesPerEvent; ++image) {
      const fs::path folder = folder_.path() / "image";
      fs::remove_all(folder);
      FaultyDisk::WriteCrashImage(event, random, folder);
      const Result<Store> opened = shop_catalog::OpenSqliteGarmentStore(folder);
      ASSERT_TRUE(opened.ok()) << "event " << event << ": " << opened.status().ToString();
      const Contents found = Day::Read(**opened, day.upload_ids());
      const Contents before = done == 0 ? Contents() : day.steps()[done - 1].after;
      const bool is_next = done < day.steps().size() && found == day.steps()[done].after;
      EXPECT_TRUE(found == before || is_next)
          << "seed " << kSeed << ", event " << event << " after \""
          << (done == 0 ? "nothing" : day.steps()[done - 1].name) << "\": found " << found << "expected " << before;
      in_flight_kept += found != before ? 1 : 0;
      if (HasFailure()) return;
    }
    if (event % 7 == 0) ExpectSound(folder_.path() / "image");
  }
  EXPECT_GT(in_flight_kept, 0) << "no cut came between a step's last flush and its acknowledgement";
}

// The account itself: without its flushes the catalog does lose what it acknowledged.
TEST_F(DiskFaults, ACutImageLosesWhatWasNotFlushed) {
  const fs::path path = folder_.path() / "lazy.sqlite";
  {
    FaultyDisk::StartAccount();
    Result<sqlite::Database> database = sqlite::Database::Open(path, sqlite::Access::kReadWrite);
    ASSERT_TRUE(database.ok());
    ASSERT_TRUE(database->Execute("PRAGMA synchronous=OFF; CREATE TABLE t (x); INSERT INTO t VALUES (1)").ok());
    FaultyDisk::StopAccount();
  }
  std::mt19937 random(1);
  int lost_count = 0;
  int kept_count = 0;
  for (int image = 0; image < 40; ++image) {
    const fs::path folder = folder_.path() / "image";
    fs::remove_all(folder);
    FaultyDisk::WriteCrashImage(FaultyDisk::event_count(), random, folder);
    Result<sqlite::Database> database = sqlite::Database::Open(folder / "lazy.sqlite", sqlite::Access::kReadWrite);
    ASSERT_TRUE(database.ok()) << database.status().ToString();
    (database->Prepare("SELECT x FROM t").ok() ? kept_count : lost_count) += 1;
  }
  EXPECT_GT(lost_count, 0);
  EXPECT_GT(kept_count, 0);
}

class CallFaults : public DiskFaults, public ::testing::WithParamInterface<FaultyDisk::Call> {};

// One call to the disk fails, whichever it is: the step says so and changes nothing, and the same step succeeds after
// it.
TEST_P(CallFaults, AFailedCallChangesNothingAndIsNotTheEnd) {
  int fault_count = 0;
  bool was_reached = true;
  for (int64_t number = 0; was_reached; number += kCallStride[static_cast<size_t>(GetParam())]) {
    ASSERT_LT(number, 20000) << "the day does not end";
    was_reached = false;
    const fs::path folder = folder_.path() / ("day" + std::to_string(number));
    Day day(folder);
    Store store;
    Contents before;
    FaultyDisk::FailCall(GetParam(), number);
    for (const Step& step : day.steps()) {
      Status status = step.act(store);
      if (!status.ok()) {
        was_reached = FaultyDisk::EndFault();
        EXPECT_TRUE(was_reached) << step.name << ": " << status.ToString();
        EXPECT_FALSE(status.reason().empty());
        EXPECT_NE(status.code(), StatusCode::kInternal) << status.ToString();
        ++fault_count;
        if (store != nullptr) {
          EXPECT_EQ(Day::Read(*store, day.upload_ids()), before) << step.name << " failed at call " << number;
        }
        status = step.act(store);
        EXPECT_TRUE(status.ok()) << step.name << " after call " << number << ": " << status.ToString();
        if (!status.ok()) return;
      }
      before = step.after;
      if (GetParam() != FaultyDisk::Call::kRead) {
        EXPECT_EQ(Day::Read(*store, day.upload_ids()), before) << step.name << " at call " << number;
      }
      if (HasFailure()) return;
    }
    was_reached = FaultyDisk::EndFault() || was_reached;
    EXPECT_EQ(Day::Read(*store, day.upload_ids()), before);
    store.reset();
    ExpectSound(folder);
    fs::remove_all(folder);
    if (HasFailure()) return;
  }
  EXPECT_GT(fault_count, 1);
}

std::string CallName(const ::testing::TestParamInfo<FaultyDisk::Call>& call) {
  constexpr std::array<const char*, 3> kNames = {"Read", "Write", "Sync"};
  return kNames[static_cast<size_t>(call.param)];
}

constexpr auto kCalls = {FaultyDisk::Call::kRead, FaultyDisk::Call::kWrite, FaultyDisk::Call::kSync};
INSTANTIATE_TEST_SUITE_P(All, CallFaults, ::testing::ValuesIn(kCalls), CallName);

}  // namespace
}  // namespace fitroom::testing
