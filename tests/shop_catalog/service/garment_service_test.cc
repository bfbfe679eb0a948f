// The shop over the wire: client, server, store and publication together, with an extractor that needs no photographs.

#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/garment/garment_json.h"
#include "common/remote/shop_client.h"
#include "common/remote/shop_convert.h"
#include "common/rpc/client.h"
#include "common/rpc/status_conversion.h"
#include "common/transfer/chunk.h"
#include "fitroom/shop/v1/garment_service.grpc.pb.h"
#include "shop_catalog/service/shop_server.h"
#include "tests/support/sample_garment.h"
#include "tests/support/service/fake_garment.h"
#include "tests/support/temporary_folder.h"

namespace fitroom::testing {
namespace {

class GarmentServiceTest : public ::testing::Test {
 protected:
  void SetUp() override { Serve(); }

  void Serve() {
    server_.reset();
    auto server = shop_catalog::ShopServer::Start({.data_folder = folder_.path() / "data", .extractor = FakeExtractor});
    ASSERT_TRUE(server.ok()) << server.status().ToString();
    server_ = std::move(server).value();
    client_ = std::make_unique<remote::ShopClient>(server_->address());
  }

  Result<GarmentRecord> Publish(const std::string& id, const std::string& front, const std::string& back) {
    std::vector<std::string_view> photos = {front};
    if (!back.empty()) photos.push_back(back);
    return client_->Publish(GarmentStatementOf(id, front, back), photos, {});
  }

  std::string Download(const std::string& id, const std::string& image, int64_t offset) {
    std::string bytes;
    const Status status = client_->DownloadImage(id, image, offset, [&](std::string_view part) {
      bytes += part;
      return Status();
    });
    return status.ok() ? bytes : status.reason();
  }

  TemporaryFolder folder_;
  std::unique_ptr<shop_catalog::ShopServer> server_;
  std::unique_ptr<remote::ShopClient> client_;
};

TEST_F(GarmentServiceTest, GivesBackPhotographsBitForBit) {
  const std::string front = FakePhoto(1, 3000000);
  const std::string back = FakePhoto(2, 70000);
  const Result<GarmentRecord> record = Publish("tee", front, back);
  ASSERT_TRUE(record.ok()) << record.status().ToString();
  EXPECT_EQ(record->images.size(), 7u);
  EXPECT_TRUE(Download("tee", "front-photo", 0) == front);
  EXPECT_TRUE(Download("tee", "back-photo", 0) == back);
  EXPECT_TRUE(Download("tee", "front-texture", 0) == "texture of " + front);
  EXPECT_EQ(Download("tee", "extraction", 0), "drawing");
  EXPECT_TRUE(Download("tee", "front-photo", 1048576) == front.substr(1048576));
  EXPECT_EQ(Download("tee", "front-photo", 3000000), "");
  EXPECT_EQ(Download("tee", "front-photo", 3000001), "OFFSET_PAST_END");
  EXPECT_EQ(Download("tee", "front-photo", -1), "OFFSET_PAST_END");
  EXPECT_EQ(Download("tee", "side-photo", 0), "IMAGE_NOT_FOUND");
  EXPECT_EQ(Download("skirt", "front-photo", 0), "IMAGE_NOT_FOUND");
}

TEST_F(GarmentServiceTest, GivesBackTheGarmentThatWasExtracted) {
  const std::string front = FakePhoto(1, 1000);
  const std::string back = FakePhoto(2, 1000);
  ASSERT_TRUE(Publish("tee", front, back).ok());
  Serve();
  const Result<GarmentRecord> record = client_->GetGarment("tee");
  ASSERT_TRUE(record.ok()) << record.status().ToString();
  const shop_catalog::ExtractionRequest request{.id = "tee",
                                                .title = "Garment tee",
                                                .length = 0.68,
                                                .front_photo = front,
                                                .back_photo = back,
                                                .is_cancelled = {}};
  EXPECT_EQ(GarmentToJson(record->garment), GarmentToJson(FakeExtractor(request)->garment));
  for (const GarmentImageRecord& image : record->images) {
    const std::string bytes = Download("tee", ImageId(image.kind, image.side), 0);
    EXPECT_EQ(std::ssize(bytes), image.size) << image.file_name;
    EXPECT_EQ(Blake2b(bytes), image.hash) << image.file_name;
  }
}

// What a shop states and the third photograph come back as they were sent, from a database on the disk.
TEST_F(GarmentServiceTest, KeepsChartFabricMeasuresAndSideFoldedPhotograph) {
  const std::string front = FakePhoto(1, 2000);
  const std::string back = FakePhoto(2, 3000);
  const std::string folded = FakePhoto(3, 400000);
  const GarmentUploadStatement statement = TrouserStatementOf("jeans", {front, back, folded});
  const Result<GarmentUpload> upload = client_->StartUpload(statement);
  ASSERT_TRUE(upload.ok()) << upload.status().ToString();
  Serve();
  EXPECT_EQ(client_->StartUpload(statement)->id, upload->id) << "a restarted server knows the statement again";
  ASSERT_TRUE(client_->Publish(statement, {front, back, folded}, {}).ok());
  Serve();
  const Result<GarmentRecord> record = client_->GetGarment("jeans");
  ASSERT_TRUE(record.ok()) << record.status().ToString();
  Garment expected = MakeSampleTrousers();
  expected.id = "jeans";
  expected.title = "Trousers jeans";
  EXPECT_EQ(record->garment.chart, expected.chart);
  EXPECT_EQ(record->garment.fabric, "denim");
  EXPECT_EQ(FindMeasure(record->garment.measures, "front_rise")->provenance, Provenance::kStated);
  EXPECT_EQ(FindMeasure(record->garment.measures, "front_rise")->value, 0.245);
  EXPECT_EQ(FindMeasure(record->garment.measures, "back_rise")->provenance, Provenance::kRuled);
  EXPECT_EQ(FindMeasure(record->garment.measures, "thigh_width")->provenance, Provenance::kUnknown);
  ASSERT_TRUE(record->garment.side_folded.has_value());
  EXPECT_EQ(record->garment.side_folded->outline, expected.side_folded->outline);
  EXPECT_EQ(record->images.size(), 10u);
  EXPECT_TRUE(Download("jeans", "side-folded-photo", 0) == folded);
  EXPECT_TRUE(Download("jeans", "side-folded-texture", 0) == "texture of " + folded);
  EXPECT_TRUE(client_->Publish(statement, {front, back, folded}, {}).ok()) << "the same again is the same garment";
  GarmentUploadStatement other = statement;
  other.stated.chart.sizes.back().measures[0].value += 0.01;
  EXPECT_EQ(client_->Publish(other, {front, back, folded}, {}).status().reason(), "GARMENT_EXISTS");
}

TEST_F(GarmentServiceTest, AListNamesTheSizesAlone) {
  const std::string front = FakePhoto(1, 2000);
  ASSERT_TRUE(client_->Publish(TrouserStatementOf("jeans", {front}), {front}, {}).ok());
  const Result<std::vector<GarmentRecord>> records = client_->ListAllGarments();
  ASSERT_TRUE(records.ok() && records->size() == 1);
  const SizeChart& chart = records->front().garment.chart;
  ASSERT_EQ(chart.sizes.size(), 3u);
  EXPECT_EQ(chart.sizes[0].name, "S");
  EXPECT_EQ(chart.photographed_size, "M");
  EXPECT_TRUE(chart.sizes[0].measures.empty() && chart.sizes[0].body.empty());
}

TEST_F(GarmentServiceTest, RefusesWhatAShopCannotState) {
  const std::string front = FakePhoto(1, 2000);
  const auto reason_of = [&](const std::function<void(GarmentUploadStatement&)>& spoil) {
    GarmentUploadStatement statement = TrouserStatementOf("jeans", {front, front, front});
    spoil(statement);
    return client_->StartUpload(statement).status().reason();
  };
  EXPECT_EQ(reason_of([](auto& s) { s.stated.chart.photographed_size = "XL"; }), "CHART_PHOTOGRAPHED_SIZE");
  EXPECT_EQ(reason_of([](auto& s) { s.stated.chart.sizes.resize(41); }), "CHART_SIZE_COUNT");
  EXPECT_EQ(reason_of([](auto& s) { s.stated.chart.sizes[1].measures[0].value = std::nan(""); }), "CHART_MEASURE");
  EXPECT_EQ(reason_of([](auto& s) { s.stated.measures[0].value = 24.5; }), "GARMENT_MEASURE");
  EXPECT_EQ(reason_of([](auto& s) {
              s.kind = GarmentKind::kSkirt;
              s.stated = {};
            }),
            "FIELD_INVALID");
  // Only the photographs tell that the chart's widths are girths; the name is free again.
  GarmentUploadStatement girths = TrouserStatementOf("jeans", {front});
  for (GarmentSize& size : girths.stated.chart.sizes) {
    for (GarmentMeasure& measure : size.measures) measure.value *= 2;
  }
  EXPECT_EQ(client_->Publish(girths, {front}, {}).status().reason(), "CHART_CONTRADICTS_PHOTOGRAPH");
  EXPECT_TRUE(client_->Publish(TrouserStatementOf("jeans", {front}), {front}, {}).ok());
}

TEST(ShopConvert, GivesBackAGarmentAndAStatement) {
  GarmentRecord record;
  record.garment = MakeSampleTrousers();
  for (const GarmentSide side : {GarmentSide::kFront, GarmentSide::kBack, GarmentSide::kSideFolded}) {
    const std::string base(GarmentSideName(side));
    record.images.push_back({GarmentImageKind::kPhoto, side, base + ".png", 5, Blake2b(base)});
    record.images.push_back({GarmentImageKind::kMask, side, base + "_mask.png", 6, Blake2b(base)});
    record.images.push_back({GarmentImageKind::kTexture, side, base + "_texture.png", 7, Blake2b(base)});
  }
  shop::v1::Garment message;
  remote::ToProto(record, message);
  const Result<GarmentRecord> read = remote::GarmentRecordFromProto(message);
  ASSERT_TRUE(read.ok()) << read.status().ToString();
  EXPECT_EQ(GarmentToJson(read->garment), GarmentToJson(record.garment));
  EXPECT_EQ(read->images, record.images);

  const GarmentUploadStatement statement = TrouserStatementOf("jeans", {"a", "b", "c"});
  shop::v1::StartGarmentUploadRequest request;
  remote::ToProto(statement, request);
  const Result<GarmentUploadStatement> stated = remote::StatementFromProto(request);
  ASSERT_TRUE(stated.ok()) << stated.status().ToString();
  EXPECT_TRUE(*stated == statement);
}

// An older catalog knows neither provenance nor fabric nor chart.
TEST(ShopConvert, ReadsWhatAnOlderCatalogSends) {
  GarmentRecord record;
  record.garment = MakeSampleTShirt();
  shop::v1::Garment message;
  remote::ToProto(record, message);
  message.clear_fabric();
  for (auto& measure : *message.mutable_measures()) measure.clear_provenance();
  const Result<GarmentRecord> read = remote::GarmentRecordFromProto(message);
  ASSERT_TRUE(read.ok()) << read.status().ToString();
  EXPECT_EQ(read->garment.fabric, "jersey");
  EXPECT_EQ(read->garment.measures, record.garment.measures);
  EXPECT_TRUE(read->garment.chart.sizes.empty());
}

TEST_F(GarmentServiceTest, AGarmentMayHaveNoBack) {
  const Result<GarmentRecord> record = Publish("tee", FakePhoto(1, 1000), "");
  ASSERT_TRUE(record.ok()) << record.status().ToString();
  EXPECT_FALSE(record->garment.back.has_value());
  EXPECT_EQ(record->images.size(), 4u);
}

TEST_F(GarmentServiceTest, ShowsNothingOfWhatIsRefused) {
  const Status status = Publish("tee", std::string(5000, 'x'), "").status();
  EXPECT_EQ(status.code(), StatusCode::kFailedPrecondition);
  EXPECT_EQ(status.reason(), "NO_GARMENT_FOUND");
  EXPECT_EQ(client_->GetGarment("tee").status().reason(), "GARMENT_NOT_FOUND");
  EXPECT_TRUE(client_->ListAllGarments()->empty());
  EXPECT_TRUE(Publish("tee", FakePhoto(1, 1000), "").ok()) << "the name must be free again";
}

TEST_F(GarmentServiceTest, ShowsNothingBeforeItIsFinishedAndGoesOnAfterARestart) {
  const std::string front = FakePhoto(1, 500000);
  const std::string back = FakePhoto(2, 400000);
  const GarmentUploadStatement statement = GarmentStatementOf("tee", front, back);
  const Result<GarmentUpload> upload = client_->StartUpload(statement);
  ASSERT_TRUE(upload.ok()) << upload.status().ToString();
  ASSERT_TRUE(client_->SendBytes(*upload, GarmentSide::kBack, 0, back.substr(0, 123456)).ok());
  EXPECT_EQ(client_->FinishUpload(*upload).status().reason(), "UPLOAD_INCOMPLETE");
  Serve();
  EXPECT_TRUE(client_->ListAllGarments()->empty());
  const Result<GarmentUpload> again = client_->StartUpload(statement);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->id, upload->id);
  EXPECT_EQ(again->committed_sizes, (std::vector<int64_t>{0, 123456}));
  EXPECT_EQ(client_->SendBytes(*upload, GarmentSide::kBack, 1, "abc").status().reason(), "UPLOAD_OFFSET_CONFLICT");
  EXPECT_TRUE(Publish("tee", front, back).ok());
  EXPECT_TRUE(Download("tee", "back-photo", 0) == back);
}

TEST_F(GarmentServiceTest, RefusesPhotographsThatAreNotTheStatedOnes) {
  const std::string front = FakePhoto(1, 5000);
  const Result<GarmentUpload> upload = client_->StartUpload(GarmentStatementOf("tee", front, ""));
  ASSERT_TRUE(upload.ok());
  EXPECT_EQ(client_->SendBytes(*upload, GarmentSide::kBack, 0, "abc").status().reason(), "PHOTO_NOT_STATED");
  EXPECT_EQ(client_->SendBytes(*upload, GarmentSide::kFront, 0, front + "x").status().reason(), "UPLOAD_TOO_LONG");
  ASSERT_TRUE(client_->SendBytes(*upload, GarmentSide::kFront, 0, FakePhoto(2, 5000)).ok());
  EXPECT_EQ(client_->FinishUpload(*upload).status().reason(), "UPLOAD_HASH_MISMATCH");
  EXPECT_EQ(client_->GetUpload(*upload).status().reason(), "UPLOAD_NOT_FOUND");
}

TEST_F(GarmentServiceTest, PublishingTwiceIsOneGarment) {
  const std::string front = FakePhoto(1, 5000);
  ASSERT_TRUE(Publish("tee", front, "").ok());
  EXPECT_TRUE(Publish("tee", front, "").ok());
  EXPECT_EQ(Publish("tee", FakePhoto(2, 5000), "").status().reason(), "GARMENT_EXISTS");
  EXPECT_EQ(client_->ListAllGarments()->size(), 1u);
}

TEST_F(GarmentServiceTest, ListsInOrderWhateverThePage) {
  for (const char* id : {"c", "a", "b-2", "b"}) ASSERT_TRUE(Publish(id, FakePhoto(1, 100), "").ok());
  for (const int page_size : {1, 2, 3, 100}) {
    std::vector<std::string> ids;
    std::string token;
    do {
      const Result<remote::GarmentPage> page = client_->ListGarments(page_size, token);
      ASSERT_TRUE(page.ok()) << page.status().ToString();
      for (const GarmentRecord& record : page->garments) {
        ids.push_back(record.garment.id);
        EXPECT_TRUE(record.garment.front.outline.empty()) << "a list is not for outlines";
      }
      token = page->next_page_token;
    } while (!token.empty());
    EXPECT_EQ(ids, (std::vector<std::string>{"a", "b", "b-2", "c"}));
  }
  EXPECT_EQ(client_->ListGarments(1, "bodies/a").status().reason(), "PAGE_TOKEN_INVALID");
}

TEST_F(GarmentServiceTest, RefusesStatementsOutOfRange) {
  const auto refused = [this](const std::function<void(GarmentUploadStatement&)>& spoil) {
    GarmentUploadStatement statement = GarmentStatementOf("tee", FakePhoto(1, 100), "");
    spoil(statement);
    return client_->StartUpload(statement).status().code() == StatusCode::kInvalidArgument;
  };
  EXPECT_TRUE(refused([](auto& s) { s.id = "Tee"; }));
  EXPECT_TRUE(refused([](auto& s) { s.id = ""; }));
  EXPECT_TRUE(refused([](auto& s) { s.id = "../tee"; }));
  EXPECT_TRUE(refused([](auto& s) { s.title = ""; }));
  EXPECT_TRUE(refused([](auto& s) { s.title = std::string(201, 't'); }));
  EXPECT_TRUE(refused([](auto& s) { s.length = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.length = 68; }));
  EXPECT_TRUE(refused([](auto& s) { s.length = std::nan(""); }));
  EXPECT_TRUE(refused([](auto& s) { s.photos.clear(); }));
  EXPECT_TRUE(refused([](auto& s) { s.photos.push_back(s.photos[0]); }));
  EXPECT_TRUE(refused([](auto& s) { s.photos[0].side = GarmentSide::kBack; }));
  EXPECT_TRUE(refused([](auto& s) { s.photos[0].size = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.photos[0].size = kMaxPhotoSize + 1; }));
  EXPECT_TRUE(refused([](auto& s) { s.annotation_json = std::string(kMaxAnnotationSize + 1, ' '); }));
  EXPECT_FALSE(refused([](auto&) {}));
}

TEST_F(GarmentServiceTest, RefusesAnAnnotationThatIsNone) {
  const std::string front = FakePhoto(1, 100);
  GarmentUploadStatement statement = GarmentStatementOf("tee", front, "");
  statement.annotation_json = "{\"front\": 7";
  const Status status = client_->Publish(statement, {front}, {}).status();
  EXPECT_EQ(status.code(), StatusCode::kInvalidArgument) << status.ToString();
  EXPECT_EQ(client_->GetGarment("tee").status().reason(), "GARMENT_NOT_FOUND");
}

TEST_F(GarmentServiceTest, RefusesDamagedChunks) {
  const std::string front = FakePhoto(1, 5000);
  const Result<GarmentUpload> upload = client_->StartUpload(GarmentStatementOf("tee", front, ""));
  ASSERT_TRUE(upload.ok());
  const auto stub = shop::v1::GarmentService::NewStub(rpc::OpenChannel(server_->address()));
  const auto context = rpc::MakeClientContext(std::chrono::seconds(10));
  shop::v1::UploadPhotoResponse response;
  const auto writer = stub->UploadPhoto(context.get(), &response);
  shop::v1::UploadPhotoRequest request;
  request.set_upload("uploads/" + upload->id);
  request.set_side(shop::v1::GARMENT_SIDE_FRONT);
  transfer::FillChunk(0, front, *request.mutable_chunk());
  request.mutable_chunk()->mutable_data()->back() ^= 1;
  writer->Write(request);
  writer->WritesDone();
  EXPECT_EQ(rpc::FromGrpcStatus(writer->Finish(), "shop").reason(), "CHUNK_CHECKSUM_MISMATCH");
}

TEST_F(GarmentServiceTest, ListensOnLoopbackOnly) {
  const auto server = shop_catalog::ShopServer::Start({.data_folder = folder_.path() / "other", .listen = "0.0.0.0:0"});
  ASSERT_FALSE(server.ok());
  EXPECT_EQ(server.status().reason(), "LISTEN_NOT_LOOPBACK");
}

}  // namespace
}  // namespace fitroom::testing
